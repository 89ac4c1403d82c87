//! Contradictions between values, each rule one function. A rule whose values are missing or wrong keeps
//! silent: that was already reported.

use crate::design::channel_entries::{height_of_barrier, height_of_sides, profile, section};
use crate::design::entries::Entries;
use crate::design::flow_entries::{MOST_CUT, coarsened, flow_volume, grain_count, size_curve, solid_share};
use crate::design::hydrograph_entries::HYDROGRAPH;
use crate::design::schema::SCHEMA_VERSION;
use crate::design::show::{NET, at, length};
use crate::design::surge_entries::{SURGES, of_the_first, volume_of_all};
use crate::design::{
    anchor_rules, boulder_rules, channel_rules, hydrograph_rules, net_ring_rules, net_rules, post_rules, rope_rules,
    size_rules, surge_rules, wall_rules,
};
use crate::problem::Problem;
use crate::units::Dimension;

type Rule = fn(&Entries) -> Option<Problem>;

/// Rules that every design keeps, in the order of the file.
pub const RULES: &[Rule] = &[
    schema_version_is_known,
    channel_rules::width_section_or_terrain,
    channel_rules::slope_is_given,
    channel_rules::terrain_tells_the_reaches,
    channel_rules::terrain_takes_a_plumb_barrier,
    channel_rules::terrain_takes_a_surge,
    channel_rules::terrain_goes_far_enough_downstream,
    channel_rules::terrain_goes_far_enough_upstream,
    channel_rules::walls_belong_to_a_width,
    channel_rules::bed_is_told_of_points,
    channel_rules::points_are_three,
    channel_rules::points_go_to_the_right,
    channel_rules::points_are_apart,
    channel_rules::both_banks_are_there,
    channel_rules::section_has_a_width,
    channel_rules::barrier_within_the_section,
    channel_rules::strips_lie_on_vertical_walls,
    channel_rules::ropes_of_cylinders_are_straight,
    channel_rules::lowest_rope_has_a_length,
    channel_rules::second_rope_above_the_bed,
    channel_rules::ropes_hang_clear_of_the_ground,
    surge_rules::surge_within_the_section,
    channel_rules::profile_has_a_reach,
    channel_rules::reaches_upstream_follow,
    channel_rules::reaches_downstream_follow,
    mass_or_volume,
    event_is_no_less_than_the_flow,
    solid_is_denser_than_bulk,
    size_rules::sizes_have_an_order,
    size_rules::curve_has_two_quantiles,
    size_rules::curve_increases,
    dam_break_height_agrees,
    surge_length_agrees,
    surge_rules::surges_have_one_size,
    surge_rules::surges_make_the_flow,
    surge_rules::first_surge_comes_first,
    boulder_rules::boulders_come_with_a_surge,
    boulder_rules::boulders_have_a_density,
    hydrograph_rules::table_is_there,
    hydrograph_rules::rows_are_told_one_way,
    hydrograph_rules::columns_are_equally_long,
    hydrograph_rules::times_rise,
    hydrograph_rules::values_are_within_bounds,
    hydrograph_rules::discharges_are_carried,
    hydrograph_rules::something_comes,
    hydrograph_rules::deepest_row_within_the_channel,
    surge_rules::surge_within_side_walls,
    surge_rules::surges_have_sound_sizes,
    wall_rules::wall_segments_fill_the_wall,
    wall_rules::wall_base_carries_the_wall,
    wall_rules::wall_base_no_steeper_than_the_bed,
    wall_rules::wall_face_stands_on_its_base,
    wall_rules::wall_block_is_one_of_the_wall,
    point_load_on_the_barrier,
    self_weight_of_a_net,
    freeboard_is_of_an_emptied_barrier,
    freeboard_within_the_barrier,
    overflow_has_friction_and_length,
    net_ring_rules::net_is_of_one_kind,
    net_ring_rules::chain_test_has_its_two_points,
    net_ring_rules::chain_is_no_stronger_than_its_wires,
    net_ring_rules::rings_are_thinner_than_they_are_wide,
    net_ring_rules::rings_have_no_shape_of_mesh,
    net_ring_rules::hexagons_have_no_angle,
    net_ring_rules::hexagons_have_no_side_extension,
    net_ring_rules::rings_meet_four_or_six,
    net_ring_rules::rings_of_six_contacts_hang_slack,
    net_ring_rules::ring_nets_have_no_sides,
    net_ring_rules::rings_fit_between_ropes,
    net_rules::mesh_within_the_barrier,
    net_rules::main_ropes_counted_once,
    net_rules::rope_heights_increase,
    net_rules::rope_heights_span_the_barrier,
    net_rules::ropes_leave_room_for_the_mesh,
    net_rules::mesh_within_the_channel,
    net_rules::rings_match_the_mesh,
    net_rules::bolts_have_one_resistance,
    net_rules::bolts_have_their_distance,
    net_rules::opening_below_the_barrier,
    barrier_leans_within_reach,
    slope_lets_a_dam_break_flow,
    dam_break_clears_the_barrier,
    net_rules::lateral_ropes_have_their_dissipators,
    net_rules::cylinders_have_no_slack,
    net_rules::net_rope_draws_out_or_breaks,
    net_rules::main_rope_draws_out_or_breaks,
    net_rules::lateral_rope_draws_out_or_breaks,
    rope_rules::net_rope_is_described,
    rope_rules::main_ropes_are_described,
    rope_rules::lateral_ropes_are_described,
    rope_rules::a_level_tells_its_rope,
    rope_rules::ropes_side_by_side_are_modelled,
    rope_rules::every_rope_is_one,
    anchor_rules::anchors_have_one_resistance,
    anchor_rules::an_axis_dips,
    anchor_rules::single_anchors_are_there,
    post_rules::retaining_ropes_are_described,
    post_rules::posts_stand_one_beside_the_other,
    post_rules::posts_stand_between_the_banks,
    post_rules::posts_stand_on_low_ground,
    post_rules::retaining_ropes_run_clear_of_the_ground,
    post_rules::posts_have_one_strength,
    post_rules::posts_have_a_possible_section,
    post_rules::posts_belong_to_models_of_ropes,
];

/// Rules that only a simulation needs.
pub const GRAIN_RULES: &[Rule] = &[
    packing_is_possible,
    mixture_is_possible,
    pressure_falls_as_it_drains,
    grains_fit_the_channel,
    grain_count_is_bearable,
    block_larger_than_the_grains,
    surge_rules::later_surges_larger_than_their_grains,
    hydrograph_rules::flow_longer_than_its_grains,
    boulder_rules::boulders_are_a_part_of_the_flow,
    boulder_rules::boulders_fit_across,
    boulder_rules::spread_boulders_lie_within_the_flow,
    boulder_rules::front_boulders_have_room,
    net_rules::knots_are_bearable,
    net_rules::cylinders_are_bearable,
];

fn schema_version_is_known(e: &Entries) -> Option<Problem> {
    let version = e.number("schema_version")?;
    (version != SCHEMA_VERSION).then(|| {
        let hint =
            if version > SCHEMA_VERSION { "a newer barrier-check is needed" } else { "there never was such a version" };
        Problem::new("schema_version", format!("version {version}"), format!("version {SCHEMA_VERSION}")).hint(hint)
    })
}

fn mass_or_volume(e: &Entries) -> Option<Problem> {
    let found = match (e.mentions("flow.mass"), e.mentions("flow.volume")) {
        (true, true) => format!("mass `{}` and volume `{}`", e.typed("flow.mass"), e.typed("flow.volume")),
        (false, false) if e.has_section("flow") && !e.mentions(SURGES) && !e.mentions(HYDROGRAPH) => {
            "neither mass nor volume".to_string()
        }
        _ => return None,
    };
    Some(Problem::new("flow", found, "either mass or volume").hint("the bulk density gives the other"))
}

fn event_is_no_less_than_the_flow(e: &Entries) -> Option<Problem> {
    let (event, flow) = (e.number("flow.event_volume")?, volume_of_all(e).or_else(|| flow_volume(e))?);
    let show = |volume| Dimension::Volume.show(volume);
    (event < 0.999 * flow).then(|| {
        Problem::new("flow.event_volume", show(event), format!("no less than the flow itself, {}", show(flow)))
            .hint("the flow is one surge of the event, or all of it")
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
    if e.has_section("flow.pore_fluid") {
        return None;
    }
    let share = solid_share(e)?;
    (MOST_SOLID..1.0).contains(&share).then(|| {
        let found = format!("bulk over solid density {share:.2}, a packing of {:.0} % grains", 100.0 * share);
        let hint =
            "a mixture with water in its pores is denser than grains alone can pack: describe it with flow.pore_fluid";
        Problem::new("flow.bulk_density", found, "at most 63 % of the solid density").hint(hint)
    })
}

/// What drains does not rise.
fn pressure_falls_as_it_drains(e: &Entries) -> Option<Problem> {
    let path = "flow.pore_fluid.drains_to";
    let (to, from) = (e.number(path)?, e.number("flow.pore_fluid.pressure_ratio")?);
    (to > from).then(|| {
        Problem::new(
            path,
            format!("`{to}`, above the pressure_ratio `{from}`"),
            "at most flow.pore_fluid.pressure_ratio",
        )
    })
}

/// Largest share of grains that can be packed, and the smallest of a mixture whose grains touch.
const MOST_SOLID: f64 = 0.63;
const LEAST_SOLID: f64 = 0.4;

/// With a fluid in all pores.
fn mixture_is_possible(e: &Entries) -> Option<Problem> {
    let fluid = e.number("flow.pore_fluid.density")?;
    let (bulk, solid) = (e.number("flow.bulk_density")?, e.number("flow.solid_density")?);
    let share = solid_share(e)?;
    if fluid < bulk && bulk < solid && (LEAST_SOLID..MOST_SOLID).contains(&share) {
        return None;
    }
    let path = "flow.pore_fluid.density";
    let show = |density: f64| Dimension::Density.show(density);
    if fluid >= bulk {
        let found = format!("{} in a flow of {}", show(fluid), show(bulk));
        return Some(Problem::new(path, found, "less than flow.bulk_density"));
    }
    let fluid_of = |share: f64| (bulk - share * solid) / (1.0 - share);
    let (found, hint) = (
        format!("a mixture of {:.0} % grains, (ρ − ρ_f)/(ρ_s − ρ_f)", 100.0 * share),
        match share >= MOST_SOLID {
            true => format!(
                "grains alone cannot be packed so densely: the fines in suspension belong to the fluid, which then has {} or more",
                show(fluid_of(MOST_SOLID).ceil())
            ),
            false => format!(
                "so few grains do not touch each other: a mud is no flow of grains; a fluid of {} or less leaves more of them",
                show(fluid_of(LEAST_SOLID).floor())
            ),
        },
    );
    (bulk < solid).then(|| Problem::new(path, found, "40 to 63 % grains").hint(hint))
}

/// Width of the surface of the flow as it is let go (m).
fn width_of_the_flow(e: &Entries) -> Option<f64> {
    let section = section(e)?;
    let depth = of_the_first(e, "depth")
        .map(|(_, depth)| depth)
        .or_else(|| Some(section.depth_of(flow_volume(e)?, e.number("flow.arrival.dam_break.length")?)));
    Some(section.width(depth?))
}

fn grains_fit_the_channel(e: &Entries) -> Option<Problem> {
    let (largest, width) = (size_curve(e)?.quantile(1.0), width_of_the_flow(e)?);
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
        .hint(match (e.text("simulation.coarsen"), curve.quantile(0.0) < curve.quantile(1.0)) {
            (_, false) => "give a coarser grain size, or a smaller flow: all grains have one size, so that no fine end can be cut".to_string(),
            (Some("auto"), true) => format!("`simulation.coarsen: auto` cuts {:.0} % of the mass at the most, and that leaves too many: give a coarser curve, or a smaller flow", 100.0 * MOST_CUT),
            (_, true) => "`simulation.coarsen: auto` cuts the fine end of the curve, and the report says where".to_string(),
        }),
    )
}

fn dam_break_height_agrees(e: &Entries) -> Option<Problem> {
    let path = "flow.arrival.dam_break";
    let length_m = e.number(&format!("{path}.length"))?;
    let needed = section(e)?.depth_of(flow_volume(e)?, length_m);
    let wall = height_of_sides(e)?;
    if let Some(height) = e.number(&format!("{path}.height")).filter(|height| (height / needed - 1.0).abs() > 0.05) {
        let found = format!("{}, while the volume needs {}", length(height), length(needed));
        return Some(
            Problem::new(format!("{path}.height"), found, "the height that fits the volume to 5 %")
                .hint("leave the height out"),
        );
    }
    (needed > wall).then(|| {
        let (between, allowed) = match e.mentions("channel.section") {
            true => ("banks", "a block lower than the lower bank of channel.section"),
            false => ("walls", "a block lower than channel.wall_height"),
        };
        let found = format!("a block {} high between {between} of {}", length(needed), length(wall));
        Problem::new(format!("{path}.length"), found, allowed).hint("make the block longer")
    })
}

fn surge_length_agrees(e: &Entries) -> Option<Problem> {
    let path = "flow.arrival.surge";
    let needed = flow_volume(e)? / section(e)?.area(e.number(&format!("{path}.depth"))?);
    let typed = e.number(&format!("{path}.length"))?;
    ((typed / needed - 1.0).abs() > 0.05).then(|| {
        let found = format!("{}, while the volume needs {}", length(typed), length(needed));
        Problem::new(format!("{path}.length"), found, "the length that fits the volume to 5 %")
            .hint("leave the length out")
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

/// Over a barrier that earlier events have filled every surge goes.
fn freeboard_is_of_an_emptied_barrier(e: &Entries) -> Option<Problem> {
    let path = "limits.freeboard";
    (e.mentions(path) && e.text("loads.filling") == Some("to_the_top")).then(|| {
        Problem::new(
            path,
            "a freeboard of a barrier that is filled to its top (loads.filling: to_the_top)",
            "this key beside `loads.filling: one_event` only",
        )
        .hint("surges go over a barrier that is full: say loads.filling: one_event if it is cleared after each event, or leave the freeboard out")
    })
}

fn freeboard_within_the_barrier(e: &Entries) -> Option<Problem> {
    let path = "limits.freeboard";
    let (freeboard, height) = (e.number(path)?, height_of_barrier(e)?);
    (freeboard >= height).then(|| {
        Problem::new(
            path,
            length(freeboard),
            format!("less than the barrier's height over the bed, {}", length(height)),
        )
        .hint("is the unit right?")
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
    let (slope, whole) = (e.number("channel.slope")?, e.number("channel.base_friction")?);
    let acts = 1.0 - e.number("flow.pore_fluid.pressure_ratio").unwrap_or(0.0);
    let friction = libm::atan(acts * libm::tan(whole));
    if let Some(bed) = profile(e) {
        let value = |key: &str| e.number(&format!("flow.arrival.dam_break.{key}"));
        let stops = bed.gain(value("distance")? + 0.5 * value("length")?, libm::tan(friction)) <= 0.0;
        return stops.then(|| {
            let found =
                format!("reaches on which a base friction of {} stops the block", Dimension::Angle.show(friction));
            Problem::new(
                "channel.profile",
                found,
                "a bed that is on the whole steeper than the base friction from the block to the barrier",
            )
            .hint("give the flow as a surge with its velocity instead of a dam break")
        });
    }
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
    let (volume, section) = (flow_volume(e)?, section(e)?);
    let (typed_path, typed, other) = match of_the_first(e, "depth") {
        Some((path, depth)) => (path, depth, volume / section.area(depth)),
        None => {
            let length = e.number("flow.arrival.dam_break.length")?;
            ("flow.arrival.dam_break.length".to_string(), length, section.depth_of(volume, length))
        }
    };
    let smaller = typed.min(other);
    (smaller < 1.2 * largest).then(|| {
        let found = format!("a block {} by {} of grains up to {}", length(typed), length(other), length(largest));
        Problem::new(typed_path, found, "a block longer and deeper than 1.2 times its largest grains").hint(
            if typed < other {
                "grains cannot be packed into a layer thinner than themselves: give more here, or smaller grains"
            } else {
                "what is given here leaves the flow too thin the other way: give less here, or more volume"
            },
        )
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
