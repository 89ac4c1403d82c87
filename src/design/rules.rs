//! Contradictions between values, each rule one function. A rule whose values are missing or wrong keeps
//! silent: that was already reported.

use crate::design::entries::Entries;
use crate::design::rope_rules::{lateral_rope_is_one, main_rope_is_one, net_rope_is_one};
use crate::design::schema::SCHEMA_VERSION;
use crate::design::sizes::SizeCurve;
use crate::problem::Problem;
use crate::units::Dimension;

type Rule = fn(&Entries) -> Option<Problem>;

/// Rules that every design keeps, in the order of the file.
pub const RULES: &[Rule] = &[
    schema_version_is_known,
    mass_or_volume,
    event_is_no_less_than_the_flow,
    solid_is_denser_than_bulk,
    sizes_have_an_order,
    curve_has_two_quantiles,
    curve_increases,
    dam_break_height_agrees,
    surge_length_agrees,
    flow_within_side_walls,
    wall_segments_fill_the_wall,
    wall_base_carries_the_wall,
    wall_base_no_steeper_than_the_bed,
    wall_face_stands_on_its_base,
    point_load_on_the_barrier,
    self_weight_of_a_net,
    overflow_has_friction_and_length,
    mesh_within_the_barrier,
    main_ropes_counted_once,
    rope_heights_increase,
    rope_heights_span_the_barrier,
    ropes_leave_room_for_the_mesh,
    mesh_within_the_channel,
    rings_match_the_mesh,
    bolts_have_one_resistance,
    bolts_have_their_distance,
    opening_below_the_barrier,
    barrier_leans_within_reach,
    slope_lets_a_dam_break_flow,
    dam_break_clears_the_barrier,
    lateral_ropes_have_their_dissipators,
    dissipators_are_stiff,
    cylinders_have_no_slack,
    net_rope_draws_out_or_breaks,
    main_rope_draws_out_or_breaks,
    lateral_rope_draws_out_or_breaks,
    net_rope_is_one,
    main_rope_is_one,
    lateral_rope_is_one,
];

/// Rules that only a simulation needs.
pub const GRAIN_RULES: &[Rule] = &[
    packing_is_possible,
    grains_fit_the_channel,
    grain_count_is_bearable,
    block_larger_than_the_grains,
    knots_are_bearable,
    cylinders_are_bearable,
];

const NET: &str = "barrier.flexible_net";

fn schema_version_is_known(e: &Entries) -> Option<Problem> {
    let version = e.number("schema_version")?;
    (version != SCHEMA_VERSION).then(|| {
        let hint =
            if version > SCHEMA_VERSION { "a newer barrier-check is needed" } else { "there never was such a version" };
        Problem::new("schema_version", format!("version {version}"), format!("version {SCHEMA_VERSION}")).hint(hint)
    })
}

pub fn at(name: &str) -> String {
    format!("{NET}.{name}")
}

pub fn length(value: f64) -> String {
    Dimension::Length.show(value)
}

/// Volume of the flow with pores, from whichever of mass and volume was given.
pub fn flow_volume(entries: &Entries) -> Option<f64> {
    entries.number("flow.volume").or_else(|| Some(entries.number("flow.mass")? / entries.number("flow.bulk_density")?))
}

fn mass_or_volume(e: &Entries) -> Option<Problem> {
    let found = match (e.mentions("flow.mass"), e.mentions("flow.volume")) {
        (true, true) => format!("mass `{}` and volume `{}`", e.typed("flow.mass"), e.typed("flow.volume")),
        (false, false) if e.has_section("flow") => "neither mass nor volume".to_string(),
        _ => return None,
    };
    Some(Problem::new("flow", found, "either mass or volume").hint("the bulk density gives the other"))
}

fn event_is_no_less_than_the_flow(e: &Entries) -> Option<Problem> {
    let (event, flow) = (e.number("flow.event_volume")?, flow_volume(e)?);
    let show = |volume| Dimension::Volume.show(volume);
    (event < 0.999 * flow).then(|| {
        Problem::new("flow.event_volume", show(event), format!("no less than the flow itself, {}", show(flow)))
            .hint("the flow is one surge of the event, or all of it")
    })
}

fn bolts_have_one_resistance(e: &Entries) -> Option<Problem> {
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

fn bolts_have_their_distance(e: &Entries) -> Option<Problem> {
    let path = at("anchors.bed_bolt_resistance");
    (e.mentions(&path) && !e.mentions(&at("anchors.bed_bolt_spacing"))).then(|| {
        Problem::new(path, "a resistance of one bolt without their distance", "anchors.bed_bolt_spacing beside it")
            .hint("the load of a bolt follows from how far apart they are")
    })
}

fn solid_is_denser_than_bulk(e: &Entries) -> Option<Problem> {
    let (bulk, solid) = (e.number("flow.bulk_density")?, e.number("flow.solid_density")?);
    (bulk >= solid).then(|| {
        let found = format!(
            "`{}`, not below the solid density `{}`",
            e.typed("flow.bulk_density"),
            e.typed("flow.solid_density")
        );
        Problem::new("flow.bulk_density", found, "less than flow.solid_density")
    })
}

fn packing_is_possible(e: &Entries) -> Option<Problem> {
    let share = e.number("flow.bulk_density")? / e.number("flow.solid_density")?;
    (0.63..1.0).contains(&share).then(|| {
        let found = format!("bulk over solid density {share:.2}, a packing of {:.0} % grains", 100.0 * share);
        let hint = "a mixture with water in its pores is denser than grains alone can pack: raise flow.solid_density to \
                    bulk density over 0.6, so that mass and volume stay right";
        Problem::new("flow.bulk_density", found, "at most 63 % of the solid density").hint(hint)
    })
}

fn sizes_have_an_order(e: &Entries) -> Option<Problem> {
    let (low, high) = ("flow.grain_sizes.uniform.min", "flow.grain_sizes.uniform.max");
    (e.number(low)? > e.number(high)?).then(|| {
        Problem::new(
            low,
            format!("`{}`, above max `{}`", e.typed(low), e.typed(high)),
            "at most flow.grain_sizes.uniform.max",
        )
    })
}

/// (share of the mass, diameter) of the quantiles that were typed.
pub fn quantiles(e: &Entries) -> Vec<(f64, f64)> {
    (1..=9)
        .filter_map(|tenth| Some((f64::from(tenth) / 10.0, e.number(&format!("flow.grain_sizes.curve.d{tenth}0"))?)))
        .collect()
}

fn curve_has_two_quantiles(e: &Entries) -> Option<Problem> {
    let path = "flow.grain_sizes.curve";
    (e.has_section(path) && quantiles(e).len() < 2)
        .then(|| Problem::new(path, format!("{} quantile(s)", quantiles(e).len()), "two or more of d10 … d90"))
}

fn curve_increases(e: &Entries) -> Option<Problem> {
    let points = quantiles(e);
    let pair = points.windows(2).find(|pair| pair[1].1 <= pair[0].1)?;
    let name = |share: f64| format!("d{:.0}", 100.0 * share);
    let found =
        format!("{} = {}, not above {} = {}", name(pair[1].0), length(pair[1].1), name(pair[0].0), length(pair[0].1));
    Some(Problem::new(
        format!("flow.grain_sizes.curve.{}", name(pair[1].0)),
        found,
        "diameters that increase with the share",
    ))
}

/// The size curve of the design, ends included, if it is sound.
pub fn size_curve(e: &Entries) -> Option<SizeCurve> {
    let uniform = |key: &str| e.number(&format!("flow.grain_sizes.uniform.{key}"));
    if let (Some(smallest), Some(largest)) = (uniform("min"), uniform("max")) {
        return (smallest <= largest).then_some(SizeCurve::ByNumber { smallest, largest });
    }
    let points = quantiles(e);
    let rises = points.windows(2).all(|pair| pair[0].1 < pair[1].1);
    (points.len() >= 2 && rises).then(|| SizeCurve::through(&points))
}

/// The lowest share of the mass of which the design gives a size.
pub fn curve_known_from(e: &Entries) -> f64 {
    quantiles(e).first().map_or(0.0, |(share, _)| *share)
}

fn grains_fit_the_channel(e: &Entries) -> Option<Problem> {
    let (largest, width) = (size_curve(e)?.quantile(1.0), e.number("channel.width")?);
    (3.0 * largest > width).then(|| {
        let found = format!("grains of {} in a channel {} wide", length(largest), length(width));
        Problem::new("flow.grain_sizes", found, "grains of at most a third of the channel's width")
    })
}

/// Grains beyond which a run would take hours.
const MOST_GRAINS: f64 = 400_000.0;

fn grain_count_is_bearable(e: &Entries) -> Option<Problem> {
    let curve = size_curve(e)?;
    let count = grain_count(e, &curve)?;
    if count <= MOST_GRAINS || coarsened(e, &curve).is_some() {
        return None;
    }
    let finest = length(curve.quantile(0.0));
    Some(
        Problem::new(
            "flow.grain_sizes",
            format!("about {count:.2e} grains, the finest {finest}"),
            format!("at most {MOST_GRAINS:.0} grains"),
        )
        .hint("`simulation.coarsen: auto` cuts the fine end of the curve, and the report says where"),
    )
}

fn grain_count(e: &Entries, curve: &SizeCurve) -> Option<f64> {
    let solid = flow_volume(e)? * e.number("flow.bulk_density")? / e.number("flow.solid_density")?;
    Some(curve.count(solid))
}

/// Grains to which `coarsen: auto` cuts a curve down: what runs in minutes.
const COARSENED: f64 = 20_000.0;
/// Largest share of the mass that it cuts.
const MOST_CUT: f64 = 0.9;

/// Below which share of the mass the curve is cut, where the design asks for that and has more grains than run in minutes; nothing
/// where it does not, or where no cut is enough.
pub fn coarsened(e: &Entries, curve: &SizeCurve) -> Option<f64> {
    if e.text("simulation.coarsen") != Some("auto") || grain_count(e, curve)? <= COARSENED {
        return None;
    }
    let enough = |share: f64| grain_count(e, &curve.cut_below(share)).is_some_and(|count| count <= COARSENED);
    let (mut low, mut high) = (0.0, MOST_CUT);
    if !enough(high) {
        return None;
    }
    for _ in 0..30 {
        let middle = 0.5 * (low + high);
        if enough(middle) { high = middle } else { low = middle }
    }
    Some(high)
}

fn dam_break_height_agrees(e: &Entries) -> Option<Problem> {
    let path = "flow.arrival.dam_break";
    let length_m = e.number(&format!("{path}.length"))?;
    let needed = flow_volume(e)? / (length_m * e.number("channel.width")?);
    let wall = e.number("channel.wall_height")?;
    if let Some(height) = e.number(&format!("{path}.height")).filter(|height| (height / needed - 1.0).abs() > 0.05) {
        let found = format!("{}, while the volume needs {}", length(height), length(needed));
        return Some(
            Problem::new(format!("{path}.height"), found, "the height that fits the volume to 5 %")
                .hint("leave the height out"),
        );
    }
    (needed > wall).then(|| {
        let found = format!("a block {} high between walls of {}", length(needed), length(wall));
        Problem::new(format!("{path}.length"), found, "a block lower than channel.wall_height")
            .hint("make the block longer")
    })
}

fn surge_length_agrees(e: &Entries) -> Option<Problem> {
    let path = "flow.arrival.surge";
    let needed = flow_volume(e)? / (e.number(&format!("{path}.depth"))? * e.number("channel.width")?);
    let typed = e.number(&format!("{path}.length"))?;
    ((typed / needed - 1.0).abs() > 0.05).then(|| {
        let found = format!("{}, while the volume needs {}", length(typed), length(needed));
        Problem::new(format!("{path}.length"), found, "the length that fits the volume to 5 %")
            .hint("leave the length out")
    })
}

fn flow_within_side_walls(e: &Entries) -> Option<Problem> {
    let (depth, wall) = (e.number("flow.arrival.surge.depth")?, e.number("channel.wall_height")?);
    (depth > wall).then(|| {
        let found = format!("a flow {} deep between walls of {}", length(depth), length(wall));
        Problem::new("flow.arrival.surge.depth", found, "at most channel.wall_height")
    })
}

fn wall_segments_fill_the_wall(e: &Entries) -> Option<Problem> {
    let path = "barrier.rigid_wall.segments";
    let (parts, height) = (e.numbers(path)?, e.number("barrier.rigid_wall.height")?);
    let sum: f64 = parts.iter().sum();
    ((sum - height).abs() > 1e-6 * height).then(|| {
        Problem::new(
            path,
            format!("parts that add up to {}", length(sum)),
            format!("parts that add up to the height {}", length(height)),
        )
    })
}

const STABILITY: &str = "barrier.rigid_wall.stability";

fn wall_base_carries_the_wall(e: &Entries) -> Option<Problem> {
    let path = format!("{STABILITY}.base_width");
    let (base, thickness) = (e.number(&path)?, e.number(&format!("{STABILITY}.thickness"))?);
    (base < thickness).then(|| {
        Problem::new(
            path,
            format!("a base of {}", length(base)),
            format!("at least the thickness, {}", length(thickness)),
        )
        .hint("the base reaches from the wall's upstream face downstream")
    })
}

fn wall_base_no_steeper_than_the_bed(e: &Entries) -> Option<Problem> {
    let path = format!("{STABILITY}.base_slope");
    let (base, bed) = (e.number(&path)?, e.number("channel.slope")?);
    (base > bed).then(|| {
        let show = |angle| Dimension::Angle.show(angle);
        Problem::new(
            path,
            format!("a base of {}", show(base)),
            format!("no more than the slope of the bed, {}", show(bed)),
        )
        .hint("on a steeper base the load would lift the wall, which is not checked")
    })
}

/// Angle by which a given face may be off the normal of the base (rad): the balance of the wall takes it as upright on its base.
const OFF_UPRIGHT: f64 = 0.1;

fn wall_face_stands_on_its_base(e: &Entries) -> Option<Problem> {
    let path = "barrier.rigid_wall.tilt";
    let (tilt, base) = (e.number(path)?, e.number(&format!("{STABILITY}.base_slope"))?);
    // Positive leans upstream; a base that falls downstream leans the wall downstream.
    ((tilt + base).abs() > OFF_UPRIGHT).then(|| {
        let show = |angle| Dimension::Angle.show(angle);
        let found = format!("a face {} from plumb on a base of {}", show(tilt), show(base));
        Problem::new(
            path,
            found,
            format!("a face upright on its base: {} to {}", show(-base - OFF_UPRIGHT), show(-base + OFF_UPRIGHT)),
        )
        .hint("sliding and overturning are worked out for a wall of even thickness that stands upright on its base")
    })
}

fn point_load_on_the_barrier(e: &Entries) -> Option<Problem> {
    let path = "loads.point_load.height";
    let height = e.number(path)?;
    let wall = e.number("barrier.rigid_wall.height").zip(e.number("channel.slope")).map(|(height, slope)| {
        e.number("barrier.rigid_wall.tilt").map_or(height, |tilt| height * libm::cos(slope + tilt))
    });
    let top = wall.or_else(|| {
        let lean = e.number("channel.slope")? + e.number(&at("tilt"))?;
        Some(e.number(&at("height"))? * libm::cos(lean) + e.number(&at("bottom.opening")).unwrap_or(0.0))
    })?;
    (height > top).then(|| {
        let allowed = format!("no more than the barrier's top, {} above the bed and normal to it", length(top));
        Problem::new(path, length(height), allowed)
    })
}

fn self_weight_of_a_net(e: &Entries) -> Option<Problem> {
    let path = "loads.self_weight";
    (e.mentions(path) && e.has_section("barrier.rigid_wall")).then(|| {
        Problem::new(path, "the weight of a rigid wall".to_string(), "this key for a net only")
            .hint("a wall's weight follows from barrier.rigid_wall.stability")
    })
}

fn overflow_has_friction_and_length(e: &Entries) -> Option<Problem> {
    let [friction, stretch] = ["loads.overflow_friction", "loads.overflow_length"];
    let (given, missing) = match (e.mentions(friction), e.mentions(stretch)) {
        (true, false) => (friction, stretch),
        (false, true) => (stretch, friction),
        _ => return None,
    };
    Some(
        Problem::new(given, format!("no `{missing}`"), "both or neither")
            .hint("the drag of an overtopping flow is its weight on that length times tan of that angle"),
    )
}

fn mesh_within_the_barrier(e: &Entries) -> Option<Problem> {
    let (mesh, height) = (e.number(&at("mesh_opening"))?, e.number(&at("height"))?);
    (mesh * std::f64::consts::SQRT_2 > height).then(|| {
        let found = format!("a mesh of {} in a barrier {} high", length(mesh), length(height));
        Problem::new(at("mesh_opening"), found, "a mesh whose diagonal fits the barrier's height")
    })
}

fn main_ropes_counted_once(e: &Entries) -> Option<Problem> {
    let path = at("main_ropes");
    let (count, heights) = (at("main_ropes.count"), at("main_ropes.heights"));
    let found = match (e.mentions(&count), e.mentions(&heights)) {
        (true, true) => "both count and heights",
        (false, false) if e.has_section(&path) => "neither count nor heights",
        _ => return None,
    };
    Some(Problem::new(path, found, "either count or heights"))
}

/// Heights of the main ropes along the barrier, whichever way they were given.
pub fn rope_heights(e: &Entries) -> Option<Vec<f64>> {
    if let Some(heights) = e.numbers(&at("main_ropes.heights")) {
        return Some(heights.to_vec());
    }
    let (count, height) = (e.number(&at("main_ropes.count"))? as usize, e.number(&at("height"))?);
    Some((0..count).map(|rope| height * rope as f64 / (count - 1) as f64).collect())
}

fn rope_heights_increase(e: &Entries) -> Option<Problem> {
    let path = at("main_ropes.heights");
    let heights = e.numbers(&path)?;
    let pair = heights.windows(2).find(|pair| pair[1] <= pair[0])?;
    Some(Problem::new(path, format!("{} after {}", length(pair[1]), length(pair[0])), "heights that increase"))
}

fn rope_heights_span_the_barrier(e: &Entries) -> Option<Problem> {
    let path = at("main_ropes.heights");
    let (heights, height) = (e.numbers(&path)?, e.number(&at("height"))?);
    let (first, last) = (heights[0], heights[heights.len() - 1]);
    (heights.len() < 2 || first != 0.0 || (last - height).abs() > 1e-6 * height).then(|| {
        let found = format!("{} rope(s) from {} to {}", heights.len(), length(first), length(last));
        Problem::new(path, found, format!("two ropes or more, from 0 m to the barrier's height {}", length(height)))
    })
}

fn ropes_leave_room_for_the_mesh(e: &Entries) -> Option<Problem> {
    let (mesh, heights) = (e.number(&at("mesh_opening"))?, rope_heights(e)?);
    let diagonal = mesh * std::f64::consts::SQRT_2;
    let bay = heights.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
    (bay > 0.0 && bay < 0.6 * diagonal).then(|| {
        let found = format!("ropes {} apart with a mesh diagonal of {}", length(bay), length(diagonal));
        Problem::new(at("main_ropes"), found, "at least one mesh diagonal between two main ropes")
    })
}

fn mesh_within_the_channel(e: &Entries) -> Option<Problem> {
    let (mesh, width) = (e.number(&at("mesh_opening"))?, e.number("channel.width")?);
    (3.0 * mesh * std::f64::consts::SQRT_2 > width).then(|| {
        let found = format!("a mesh of {} across a channel of {}", length(mesh), length(width));
        Problem::new(at("mesh_opening"), found, "at least three mesh diagonals across the channel")
    })
}

fn rings_match_the_mesh(e: &Entries) -> Option<Problem> {
    let (spacing, mesh) = (e.number(&at("main_ropes.rings.spacing"))?, e.number(&at("mesh_opening"))?);
    let diagonal = mesh * std::f64::consts::SQRT_2;
    ((spacing / diagonal - 1.0).abs() > 0.1).then(|| {
        let found = format!("rings every {} with a mesh diagonal of {}", length(spacing), length(diagonal));
        Problem::new(
            at("main_ropes.rings.spacing"),
            found,
            "one ring to each mesh along the rope (the diagonal to 10 %)",
        )
    })
}

/// Most cylinders of main ropes, beyond which a run takes hours.
const MOST_CYLINDERS: f64 = 10_000.0;

fn has_cylinders(e: &Entries) -> bool {
    e.text("simulation.barrier_model") == Some("cylinders")
}

fn cylinders_are_bearable(e: &Entries) -> Option<Problem> {
    let ropes =
        e.numbers(&at("main_ropes.heights")).map_or(e.number(&at("main_ropes.count")), |h| Some(h.len() as f64))?;
    let (piece, width) = (e.number(&at("main_ropes.element_length"))?, e.number("channel.width")?);
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

fn cylinders_have_no_slack(e: &Entries) -> Option<Problem> {
    let slack = e.number(&at("net_slack"))?;
    (has_cylinders(e) && slack > 0.0).then(|| {
        let found = format!("`{}` with barrier_model cylinders", e.typed(&at("net_slack")));
        Problem::new(at("net_slack"), found, "0 % with cylinders, which are straight at rest")
            .hint("use barrier_model sliding_ropes for a slack net")
    })
}

fn net_rope_draws_out_or_breaks(e: &Entries) -> Option<Problem> {
    draws_out_or_breaks(e, "net_rope")
}

fn main_rope_draws_out_or_breaks(e: &Entries) -> Option<Problem> {
    draws_out_or_breaks(e, "main_ropes")
}

fn lateral_rope_draws_out_or_breaks(e: &Entries) -> Option<Problem> {
    draws_out_or_breaks(e, "lateral_ropes")
}

/// A rope that draws out at constant tension never reaches its breaking load.
fn draws_out_or_breaks(e: &Entries, part: &str) -> Option<Problem> {
    let path = at(&format!("{part}.elastic_limit"));
    let (elastic, breaking) = (e.number(&path)?, e.number(&at(&format!("{part}.breaking_load")))?);
    if elastic >= breaking {
        let found =
            format!("{} with a breaking load of {}", Dimension::Force.show(elastic), Dimension::Force.show(breaking));
        return Some(Problem::new(path, found, "less than the breaking load"));
    }
    (e.text(&at(&format!("{part}.at_breaking_load")))? == "breaks").then(|| {
        Problem::new(path, "an elastic limit and `at_breaking_load: breaks`", "one of the two")
            .hint("a rope that draws out at its elastic limit never reaches its breaking load")
    })
}

fn opening_below_the_barrier(e: &Entries) -> Option<Problem> {
    let (opening, height) = (e.number(&at("bottom.opening"))?, e.number(&at("height"))?);
    (opening >= height).then(|| {
        let found = format!("an opening of {} below a barrier of {}", length(opening), length(height));
        Problem::new(at("bottom.opening"), found, "less than the barrier's height")
    })
}

fn barrier_leans_within_reach(e: &Entries) -> Option<Problem> {
    let wall = "barrier.rigid_wall.tilt".to_string();
    let path = if e.mentions(&wall) { wall } else { at("tilt") };
    let (tilt, slope) = (e.number(&path)?, e.number("channel.slope")?);
    let lean = tilt + slope;
    (!(-0.35..1.31).contains(&lean)).then(|| {
        let found = format!("a barrier {} against the bed's normal", Dimension::Angle.show(lean));
        let allowed = "slope plus tilt from -20 deg (leaning downstream of the bed's normal) to 75 deg (upstream)";
        Problem::new(path, found, allowed)
    })
}

fn slope_lets_a_dam_break_flow(e: &Entries) -> Option<Problem> {
    if !e.has_section("flow.arrival.dam_break") {
        return None;
    }
    let (slope, friction) = (e.number("channel.slope")?, e.number("channel.base_friction")?);
    (slope <= friction).then(|| {
        let found = format!(
            "a slope of {} and a base friction of {}",
            Dimension::Angle.show(slope),
            Dimension::Angle.show(friction)
        );
        Problem::new("channel.slope", found, "a slope steeper than the base friction, or the block stops on its way")
            .hint("give the flow as a surge with its velocity instead of a dam break")
    })
}

fn block_larger_than_the_grains(e: &Entries) -> Option<Problem> {
    let largest = size_curve(e)?.quantile(1.0);
    let area = flow_volume(e)? / e.number("channel.width")?;
    let (typed_path, typed) = match e.number("flow.arrival.surge.depth") {
        Some(depth) => ("flow.arrival.surge.depth", depth),
        None => ("flow.arrival.dam_break.length", e.number("flow.arrival.dam_break.length")?),
    };
    let smaller = typed.min(area / typed);
    (smaller < 1.2 * largest).then(|| {
        let found =
            format!("a block {} by {} of grains up to {}", length(typed), length(area / typed), length(largest));
        Problem::new(typed_path, found, "a block longer and deeper than 1.2 times its largest grains")
            .hint("grains cannot be packed into a layer thinner than themselves")
    })
}

fn dam_break_clears_the_barrier(e: &Entries) -> Option<Problem> {
    let distance = e.number("flow.arrival.dam_break.distance")?;
    let barrier = if e.has_section(NET) { NET } else { "barrier.rigid_wall" };
    let of_barrier = |key: &str| e.number(&format!("{barrier}.{key}"));
    let lean = of_barrier("tilt").map_or(0.0, |tilt| tilt + e.number("channel.slope").unwrap_or(0.0));
    let reach = (of_barrier("height")? * libm::sin(lean)).max(0.0) + 0.5 * size_curve(e)?.quantile(1.0);
    (distance < reach).then(|| {
        let found =
            format!("a gate {} from the foot of a barrier that reaches {} upstream", length(distance), length(reach));
        Problem::new("flow.arrival.dam_break.distance", found, "a gate upstream of the whole barrier")
    })
}

/// Elastic travel of a dissipator before it yields, over its stroke, up to which it can be left out of the stroke.
const ELASTIC_TRAVEL: f64 = 0.25;

fn dissipators_are_stiff(e: &Entries) -> Option<Problem> {
    let [plateau, stroke, stiffness] =
        ["plateau_force", "stroke", "stiffness"].map(|key| e.number(&at(&format!("dissipators.{key}"))));
    let (travel, stroke) = (plateau? / stiffness?, stroke?);
    (travel > ELASTIC_TRAVEL * stroke).then(|| {
        let found =
            format!("an elastic travel of {} up to the plateau, with a stroke of {}", length(travel), length(stroke));
        Problem::new(at("dissipators.stiffness"), found, "a plateau that is reached within a quarter of the stroke")
            .hint("the stroke is the travel at the plateau; elastic travel does not count to it")
    })
}

fn lateral_ropes_have_their_dissipators(e: &Entries) -> Option<Problem> {
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

fn knots_are_bearable(e: &Entries) -> Option<Problem> {
    let (mesh, height) = (e.number(&at("mesh_opening"))?, e.number(&at("height"))?);
    let knots = e.number("channel.width")? * height / (mesh * mesh);
    (knots > MOST_KNOTS).then(|| {
        let found = format!("a mesh of {} with about {knots:.0} knots", length(mesh));
        Problem::new(at("mesh_opening"), found, format!("at most {MOST_KNOTS:.0} knots")).hint("is the unit right?")
    })
}
