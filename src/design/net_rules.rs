//! Contradictions between values of a flexible net; listed in [`super::rules`].

use crate::design::MeshShape;
use crate::design::channel_entries::{height_of_barrier, section};
use crate::design::entries::Entries;
use crate::design::net_rings::{net_rings, ring_key};
use crate::design::rope_entries::{LEVELS, breaks, levels};
use crate::design::show::{at, length};
use crate::lattice::Lattice;
use crate::problem::Problem;
use crate::units::Dimension;

pub fn bolts_have_one_resistance(e: &Entries) -> Option<Problem> {
    let [of_all, of_one] = ["bed_resistance", "bed_bolt_resistance"].map(|key| at(&format!("anchors.{key}")));
    (e.mentions(&of_all) && e.mentions(&of_one)).then(|| {
        Problem::new(
            of_all,
            "the resistance of all bolts and that of one",
            "either bed_resistance or bed_bolt_resistance",
        )
        .hint("keep bed_bolt_resistance, the resistance of one bolt")
    })
}

pub fn bolts_have_their_distance(e: &Entries) -> Option<Problem> {
    let path = at("anchors.bed_bolt_resistance");
    (e.mentions(&path) && !e.mentions(&at("anchors.bed_bolt_spacing"))).then(|| {
        Problem::new(path, "a resistance of one bolt without their distance", "anchors.bed_bolt_spacing beside it")
            .hint("the load of a bolt follows from how far apart they are")
    })
}

/// The lattice of the net as its keys tell it.
pub struct TypedLattice {
    /// The key that tells its size.
    pub path: String,
    pub lattice: Lattice,
    /// Opening of the mesh, or diameter of the ring (m).
    size: f64,
    rings: bool,
}

impl TypedLattice {
    /// Nothing where it is not told.
    pub fn of(e: &Entries) -> Option<Self> {
        if e.mentions(&at("net")) {
            let rings = net_rings(e)?;
            return Some(Self {
                path: ring_key("diameter"),
                lattice: rings.lattice(),
                size: rings.diameter,
                rings: true,
            });
        }
        let mesh = e.number(&at("mesh_opening"))?;
        let lattice = MeshShape::of(e).lattice(mesh);
        Some(Self { path: at("mesh_opening"), lattice, size: mesh, rings: false })
    }

    /// Width of a period across the barrier, and height of one along it (m).
    pub fn across(&self) -> f64 {
        self.lattice.period()[0]
    }

    pub fn along(&self) -> f64 {
        self.lattice.period()[1]
    }

    fn shown(&self) -> String {
        format!("{} of {}", if self.rings { "rings" } else { "a mesh" }, length(self.size))
    }

    /// What is as wide as a period.
    pub fn wide(&self) -> &'static str {
        match self.lattice {
            Lattice::Diamonds { .. } => "mesh diagonal",
            Lattice::Hexagons { .. } => "mesh opening",
            Lattice::FourContacts { .. } | Lattice::SixContacts { .. } => "ring",
        }
    }

    /// What is as tall as a period.
    pub fn tall(&self) -> &'static str {
        match self.lattice {
            Lattice::Diamonds { .. } => "mesh diagonal",
            Lattice::Hexagons { .. } => "pair of rows of hexagons",
            Lattice::FourContacts { .. } => "ring",
            Lattice::SixContacts { .. } => "row of rings",
        }
    }
}

pub fn mesh_within_the_barrier(e: &Entries) -> Option<Problem> {
    let (lattice, height) = (TypedLattice::of(e)?, e.number(&at("height"))?);
    (lattice.along() > height).then(|| {
        let found = format!("{} in a barrier {} high", lattice.shown(), length(height));
        let allowed = if lattice.rings {
            "rings that fit the barrier's height".to_string()
        } else {
            format!("a {} no taller than the barrier", lattice.tall())
        };
        Problem::new(lattice.path, found, allowed)
    })
}

pub fn main_ropes_counted_once(e: &Entries) -> Option<Problem> {
    let path = at("main_ropes");
    let ways = ["count", "heights", "levels"];
    let given: Vec<&str> = ways.into_iter().filter(|key| e.mentions(&at(&format!("main_ropes.{key}")))).collect();
    let found = match given[..] {
        [] if e.has_section(&path) => "none of count, heights and levels".to_string(),
        [] | [_] => return None,
        _ => given.join(" and "),
    };
    Some(Problem::new(path, found, "one of count, heights and levels"))
}

/// Heights of the main ropes along the barrier, whichever way they were given.
pub fn rope_heights(e: &Entries) -> Option<Vec<f64>> {
    if let Some(heights) = listed_heights(e) {
        return Some(heights.1);
    }
    let (count, height) = (e.number(&at("main_ropes.count"))? as usize, e.number(&at("height"))?);
    Some((0..count).map(|rope| height * rope as f64 / (count - 1) as f64).collect())
}

/// Heights that are typed, and where.
fn listed_heights(e: &Entries) -> Option<(String, Vec<f64>)> {
    let path = at("main_ropes.heights");
    if let Some(heights) = e.numbers(&path) {
        return Some((path, heights.to_vec()));
    }
    let levels = levels(e);
    let heights: Option<Vec<f64>> = levels.iter().map(|level| e.number(&at(&format!("{level}.height")))).collect();
    heights.filter(|heights| !heights.is_empty()).map(|heights| (at(LEVELS), heights))
}

pub fn rope_heights_increase(e: &Entries) -> Option<Problem> {
    let (path, heights) = listed_heights(e)?;
    let pair = heights.windows(2).find(|pair| pair[1] <= pair[0])?;
    Some(Problem::new(path, format!("{} after {}", length(pair[1]), length(pair[0])), "heights that increase"))
}

pub fn rope_heights_span_the_barrier(e: &Entries) -> Option<Problem> {
    let ((path, heights), height) = (listed_heights(e)?, e.number(&at("height"))?);
    let (first, last) = (heights[0], heights[heights.len() - 1]);
    (heights.len() < 2 || first != 0.0 || (last - height).abs() > 1e-6 * height).then(|| {
        let found = format!("{} height(s) from {} to {}", heights.len(), length(first), length(last));
        let allowed = format!("two heights or more, from 0 m to the barrier's height {}", length(height));
        Problem::new(path, found, allowed).hint("the lowest rope is at 0 m, the uppermost at the height of the barrier")
    })
}

pub fn ropes_leave_room_for_the_mesh(e: &Entries) -> Option<Problem> {
    let (lattice, heights) = (TypedLattice::of(e)?, rope_heights(e)?);
    let (tall, name) = (lattice.along(), lattice.tall());
    let bay = heights.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
    (bay > 0.0 && bay < 0.6 * tall).then(|| {
        let found = format!("ropes {} apart with a {name} of {}", length(bay), length(tall));
        Problem::new(at("main_ropes"), found, format!("at least one {name} between two main ropes"))
    })
}

pub fn mesh_within_the_channel(e: &Entries) -> Option<Problem> {
    let (lattice, width) = (TypedLattice::of(e)?, section(e)?.width(height_of_barrier(e)?));
    (3.0 * lattice.across() > width).then(|| {
        let found = format!("{} across a channel of {}", lattice.shown(), length(width));
        let allowed = format!("at least three {}s across the channel", lattice.wide());
        Problem::new(lattice.path, found, allowed)
    })
}

pub fn rings_match_the_mesh(e: &Entries) -> Option<Problem> {
    let (spacing, lattice) = (e.number(&at("main_ropes.rings.spacing"))?, TypedLattice::of(e)?);
    let (diagonal, wide) = (lattice.lattice.along_a_rope(), lattice.wide());
    ((spacing / diagonal - 1.0).abs() > 0.1).then(|| {
        let (found, allowed) = if lattice.rings {
            (
                format!(
                    "a spacing of {} with rings of the net that hang on the rope every {}",
                    length(spacing),
                    length(diagonal)
                ),
                match lattice.lattice {
                    Lattice::SixContacts { .. } => {
                        "half of the distance of the net's rings, each of which hangs on the rope in two places (to 10 %)"
                    }
                    _ => "the diameter of the net's rings, each of which hangs on the rope (to 10 %)",
                },
            )
        } else {
            (
                format!("rings every {} with a {wide} of {}", length(spacing), length(diagonal)),
                "one ring to each mesh along the rope, as wide as that is (to 10 %)",
            )
        };
        Problem::new(at("main_ropes.rings.spacing"), found, allowed)
    })
}

/// Most cylinders of main ropes, beyond which a run takes hours.
const MOST_CYLINDERS: f64 = 10_000.0;

fn has_cylinders(e: &Entries) -> bool {
    e.text("simulation.barrier_model") == Some("cylinders")
}

pub fn cylinders_are_bearable(e: &Entries) -> Option<Problem> {
    let ropes =
        listed_heights(e).map_or(e.number(&at("main_ropes.count")), |(_, heights)| Some(heights.len() as f64))?;
    let (piece, width) = (e.number(&at("main_ropes.element_length"))?, section(e)?.breadth());
    let count = ropes * width / piece;
    (has_cylinders(e) && count > MOST_CYLINDERS).then(|| {
        let found = format!("{} for {ropes} ropes of {}: {count:.0} cylinders", length(piece), length(width));
        Problem::new(
            at("main_ropes.element_length"),
            found,
            format!("at most {MOST_CYLINDERS:.0} cylinders of main ropes"),
        )
        .hint("longer cylinders: a few to each ring are enough")
    })
}

pub fn cylinders_have_no_slack(e: &Entries) -> Option<Problem> {
    let slack = e.number(&at("net_slack"))?;
    (has_cylinders(e) && slack > 0.0).then(|| {
        let found = format!("`{}` with barrier_model cylinders", e.typed(&at("net_slack")));
        Problem::new(at("net_slack"), found, "0 % with cylinders, which are straight at rest")
            .hint("use barrier_model sliding_ropes for a slack net")
    })
}

pub fn net_rope_draws_out_or_breaks(e: &Entries) -> Option<Problem> {
    draws_out_or_breaks(e, "net_rope")
}

pub fn main_rope_draws_out_or_breaks(e: &Entries) -> Option<Problem> {
    draws_out_or_breaks(e, "main_ropes")
}

pub fn lateral_rope_draws_out_or_breaks(e: &Entries) -> Option<Problem> {
    draws_out_or_breaks(e, "lateral_ropes")
}

/// A rope that draws out at constant tension never reaches its breaking load.
fn draws_out_or_breaks(e: &Entries, part: &str) -> Option<Problem> {
    let path = at(&format!("{part}.elastic_limit"));
    let elastic = e.number(&path)?;
    // Ropes of single levels draw out at the same limit.
    let of = |part: &str| e.number(&at(&format!("{part}.breaking_load")));
    let own = if part == "main_ropes" { levels(e) } else { Vec::new() };
    let breaking = own.iter().map(String::as_str).chain([part]).filter_map(of).reduce(f64::min)?;
    if elastic >= breaking {
        let found =
            format!("{} with a breaking load of {}", Dimension::Force.show(elastic), Dimension::Force.show(breaking));
        return Some(Problem::new(path, found, "less than the breaking load"));
    }
    breaks(e, &at(&format!("{part}.at_breaking_load")))?.then(|| {
        Problem::new(path, "an elastic limit and `at_breaking_load: breaks`", "one of the two")
            .hint("a rope that draws out at its elastic limit never reaches its breaking load")
    })
}

pub fn opening_below_the_barrier(e: &Entries) -> Option<Problem> {
    let (opening, height) = (e.number(&at("bottom.opening"))?, e.number(&at("height"))?);
    (opening >= height).then(|| {
        let found = format!("an opening of {} below a barrier of {}", length(opening), length(height));
        Problem::new(at("bottom.opening"), found, "less than the barrier's height")
    })
}

pub fn lateral_ropes_have_their_dissipators(e: &Entries) -> Option<Problem> {
    let path = at("lateral_ropes.tied_to");
    (e.text(&path) == Some("dissipators") && !e.mentions(&at("dissipators"))).then(|| {
        Problem::new(
            path,
            "`dissipators` in a barrier without dissipators",
            "rope_ends or anchors, or a section dissipators",
        )
    })
}

/// Knots of the net beyond which a run would take hours.
const MOST_KNOTS: f64 = 50_000.0;

pub fn knots_are_bearable(e: &Entries) -> Option<Problem> {
    let (lattice, height) = (TypedLattice::of(e)?, e.number(&at("height"))?);
    let of_one = lattice.across() * lattice.along() / lattice.lattice.knots();
    let knots = section(e)?.mean_width(height_of_barrier(e)?) * height / of_one;
    (knots > MOST_KNOTS).then(|| {
        let what = if lattice.rings { "contacts" } else { "knots" };
        let found = format!("{} with about {knots:.0} {what}", lattice.shown());
        Problem::new(lattice.path, found, format!("at most {MOST_KNOTS:.0} {what}")).hint("is the unit right?")
    })
}
