//! Contradictions between values of a ring net; listed in [`super::rules`].

use crate::design::channel_entries::{height_of_barrier, section};
use crate::design::entries::Entries;
use crate::design::net_rings::{Contacts, net_rings, ring_key, tested_chain, wires};
use crate::design::net_rules::rope_heights;
use crate::design::show::{NET, at};
use crate::problem::Problem;
use crate::units::Dimension;

/// A net is of rings, or of ropes in square meshes.
pub fn net_is_of_one_kind(e: &Entries) -> Option<Problem> {
    if !e.has_section(NET) {
        return None;
    }
    let given = |key: &str| e.mentions(&at(key));
    let [rings, mesh, rope] = [given("net"), given("mesh_opening"), given("net_rope")];
    let found = match (rings, mesh, rope) {
        (true, false, false) | (false, true, true) => return None,
        (true, ..) => "rings and a mesh of ropes",
        (false, true, false) => "a mesh_opening without a net_rope",
        (false, false, true) => "a net_rope without a mesh_opening",
        (false, false, false) => "neither a mesh of ropes nor rings",
    };
    Some(
        Problem::new(NET, found, "mesh_opening and net_rope, or net.rings")
            .hint("mesh_opening and net_rope describe meshes of rope; net: {rings: ...} a ring net"),
    )
}

pub fn chain_test_has_its_two_points(e: &Entries) -> Option<Problem> {
    let path = ring_key("chain_test");
    let points = e.points(&path)?;
    let allowed = "two points, [[elongation, force] where bending ends, [elongation, force] at the break]";
    let hint = "the elongation is told over the length of the chain, as 57 %";
    let problem = |found: String| Some(Problem::new(path.clone(), found, allowed).hint(hint));
    let [[bent, knee], [broken, force]] = *points else { return problem(format!("{} points", points.len())) };
    let show = |force: f64| Dimension::Force.show(force);
    if broken <= bent {
        return problem(format!("a break at {:.1} % after {:.1} %", 100.0 * broken, 100.0 * bent));
    }
    // A way round four contacts on a circle is 2 √2 D, and one round two that are taut 2 D (1 + e).
    if 1.0 + bent < std::f64::consts::SQRT_2 {
        return Some(
            Problem::new(path, format!("the end of bending at {:.1} %", 100.0 * bent), "41.5 % or more")
                .hint("earlier the rings of the net would be taut as they hang; the elongation is that of the whole chain over its length"),
        );
    }
    // Else it would be no stiffer when it is taut.
    (force / broken <= knee / bent)
        .then(|| problem(format!("{} at the break after {}, no steeper than it bends", show(force), show(knee))))
        .flatten()
}

/// Share of the strength of all wires of both legs that no chain of rings comes near to: tests use 0.36 to 0.45, and a ring between four others
/// 0.56.
const NEVER_USED: f64 = 0.6;

/// No chain holds nearly as much as its wires pulled straight.
pub fn chain_is_no_stronger_than_its_wires(e: &Entries) -> Option<Problem> {
    let (wires, chain) = (wires(e)?, tested_chain(e)?);
    let most = NEVER_USED * 2.0 * wires.breaking_load();
    (chain[1][1] > most).then(|| {
        let found = format!("a break at {}", Dimension::Force.show(chain[1][1]));
        let allowed = format!("at most {}, 0.6 of the strength of all wires of both legs", Dimension::Force.show(most));
        Problem::new(ring_key("chain_test"), found, allowed).hint("look at the units, at windings and at wire_diameter")
    })
}

pub fn rings_are_thinner_than_they_are_wide(e: &Entries) -> Option<Problem> {
    let (wires, diameter) = (wires(e)?, e.number(&ring_key("diameter"))?);
    (wires.bundle() > 0.25 * diameter).then(|| {
        let [bundle, ring] = [wires.bundle(), diameter].map(|length| Dimension::Length.show(length));
        let found = format!("a bundle of about {bundle} in a ring of {ring}");
        Problem::new(ring_key("windings"), found, "a bundle of wires no thicker than a quarter of the ring")
            .hint("look at the units of wire_diameter and diameter")
    })
}

/// How far rings may be stretched where a whole number of them does not fit.
const MOST_STRETCHED: f64 = 1.1;

/// Rings hang side by side: where they do not fit they would be stretched before anything comes.
pub fn rings_fit_between_ropes(e: &Entries) -> Option<Problem> {
    let (rings, heights) = (net_rings(e)?, rope_heights(e)?);
    let (diameter, [wide, tall]) = (rings.diameter, rings.lattice().period());
    let over = |length: f64, period: f64| length / (period * (length / period).round().max(1.0));
    let stretched = |bay: f64| over(bay, tall);
    let bays = heights.windows(2).map(|pair| pair[1] - pair[0]);
    let worst = bays.filter(|bay| *bay > 0.0).max_by(|a, b| stretched(*a).total_cmp(&stretched(*b)))?;
    // Between the banks, at the height of the barrier.
    let across = section(e).zip(height_of_barrier(e)).map(|(section, height)| section.width(height));
    if let Some(width) = across.filter(|width| over(*width, wide) > MOST_STRETCHED) {
        let [width, ring] = [width, diameter].map(|length| Dimension::Length.show(length));
        return Some(
            Problem::new(
                ring_key("diameter"),
                format!("rings of {ring} across {width}"),
                "rings that fit the width, stretched by 10 % at most",
            )
            .hint("choose rings of which a whole number is about as wide as the barrier"),
        );
    }
    (stretched(worst) > MOST_STRETCHED).then(|| {
        let [bay, ring] = [worst, diameter].map(|length| Dimension::Length.show(length));
        let (more, count) = (100.0 * (stretched(worst) - 1.0), (worst / tall).round().max(1.0));
        let found = format!("{count} row(s) of rings of {ring} between ropes {bay} apart, stretched by {more:.0} %");
        let row = Dimension::Length.show(tall);
        let allowed = format!("ropes about a whole number of rows of {row} apart, at most 10 % more");
        Problem::new(at("main_ropes"), found, allowed).hint("move the ropes, or choose other rings")
    })
}

/// What tells the shape of a mesh of ropes has no place beside rings.
pub fn rings_have_no_shape_of_mesh(e: &Entries) -> Option<Problem> {
    let given = ["mesh_angle", "mesh_shape"].into_iter().find(|key| e.mentions(&at(key)))?;
    e.mentions(&at("net")).then(|| {
        Problem::new(at(given), "the shape of a mesh beside rings", "rings without it")
            .hint("net.rings.contacts tells whether each ring meets four others or six")
    })
}

/// A hexagon is regular.
pub fn hexagons_have_no_angle(e: &Entries) -> Option<Problem> {
    let path = at("mesh_angle");
    (e.mentions(&path) && e.text(&at("mesh_shape")) == Some("hexagons")).then(|| {
        Problem::new(path, "an angle of the mesh beside hexagons", "mesh_shape: hexagons without it")
            .hint("hexagons are taken as regular; mesh_angle makes a square a diamond")
    })
}

/// The strips go on with the pattern of squares or diamonds.
pub fn hexagons_have_no_side_extension(e: &Entries) -> Option<Problem> {
    let path = at("side_extension");
    (e.has_section(&path) && e.text(&at("mesh_shape")) == Some("hexagons")).then(|| {
        Problem::new(path, "side extensions of a net of hexagons", "squares or diamonds with side extensions")
            .hint("leave them out; what passes beside the net is then on the high side")
    })
}

pub fn rings_meet_four_or_six(e: &Entries) -> Option<Problem> {
    let path = ring_key("contacts");
    let contacts = e.number(&path)?;
    (contacts == 5.0).then(|| {
        Problem::new(path, "5 contacts to each ring", "4 or 6")
            .hint("rings lie in squares and meet four others, or in triangles and meet six")
    })
}

/// Six contacts lie on the ring as it hangs: it is not taut before anything comes.
pub fn rings_of_six_contacts_hang_slack(e: &Entries) -> Option<Problem> {
    let rings = net_rings(e).filter(|rings| rings.contacts == Contacts::Six)?;
    let ([[bent, _], _], hangs) = (rings.chain, 3.0 * rings.spacing());
    let least = hangs / (2.0 * rings.diameter) - 1.0;
    (rings.law().taut_from < hangs).then(|| {
        Problem::new(
            ring_key("chain_test"),
            format!("the end of bending at {:.1} %", 100.0 * bent),
            format!("{:.1} % or more for these rings with six contacts", 100.0 * least),
        )
        .hint("earlier the rings of the net would be taut as they hang")
    })
}

/// What belongs to ropes between knots.
pub fn ring_nets_have_no_sides(e: &Entries) -> Option<Problem> {
    if !e.mentions(&at("net")) {
        return None;
    }
    let slack = at("net_slack");
    if e.number(&slack).is_some_and(|slack| slack > 0.0) {
        let found = format!("`{}` with a ring net", e.typed(&slack));
        return Some(Problem::new(slack, found, "0 % with rings, whose slack follows from their diameter"));
    }
    let pieces = at("net_pieces");
    if e.mentions(&pieces) {
        return Some(
            Problem::new(
                pieces,
                "pieces of the sides of a mesh, in a ring net",
                "nothing: a ring slides through its contacts",
            )
            .hint("leave it out"),
        );
    }
    let strips = at("side_extension");
    if e.has_section(&strips) {
        return Some(
            Problem::new(strips, "side extensions of a ring net", "nothing: they are known for meshes of rope alone")
                .hint("leave them out; what passes beside the net is then on the high side"),
        );
    }
    let model = "simulation.barrier_model";
    (e.text(model) == Some("cylinders")).then(|| {
        Problem::new(model, "cylinders with a ring net", "sliding_ropes or pinned_ropes")
            .hint("a ring net is modelled of rings that slide, and its ropes of segments")
    })
}
