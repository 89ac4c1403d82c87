//! What a reviewer should know before the numbers, each with what to do about it. One function for each warning.

use schemars::JsonSchema;
use serde::Serialize;

use crate::checks::credibility::ESCAPED_LIMIT;
use crate::checks::detailing::{Bearing, rules};
use crate::checks::implausible::implausible;
use crate::checks::not_covered::largest_grain::hit_on_a_metre;
use crate::checks::outcome::{CheckVerdict, Kind, Outcome};
use crate::checks::range::rope_outside;
use crate::demand::USED_UP;
use crate::design::{Arrival, BarrierDesign, FidelityWish, FlexibleNet};
use crate::fidelity::ladder::rung_of;
use crate::guideline::height_over_bed;
use crate::loads::run_up;
use crate::pipeline::Run;
use crate::quantities::quantity::Unit;
use crate::quantities::{incoming, mass, rope_damage, total_force};
use crate::report::numbers::{figures, with_unit};
use crate::report::row::{in_a_line, is_share, lower_first};
use crate::report::validation::Kept;
use crate::section::Section;
use dem::recorders::of_dissipators;

type Warning = fn(&Run) -> Option<String>;

/// All warnings with their ids, in the order of the report.
const WARNINGS: &[(&str, Warning)] = &[
    ("inputs_far_from_usual", inputs_far_from_usual),
    ("flow_not_stopped", flow_not_stopped),
    ("flow_that_stopped_upstream", flow_that_stopped_upstream),
    ("slows_on_its_way", slows_on_its_way),
    ("event_larger_than_the_flow", event_larger_than_the_flow),
    ("discharge_and_volume", discharge_and_volume),
    ("grains_that_hide_losses", grains_that_hide_losses),
    ("grains_scaled_to_the_mass", grains_scaled_to_the_mass),
    ("coarsest_grains_not_given", coarsest_grains_not_given),
    ("stone_on_the_wall", stone_on_the_wall),
    ("escaped", escaped),
    ("run_up_over_the_banks", run_up_over_the_banks),
    ("level_over_the_barrier", level_over_the_barrier),
    ("storage_without_an_end", storage_without_an_end),
    ("gully_turns", gully_turns),
    ("force_beyond_the_guideline", force_beyond_the_guideline),
    ("faster_flow_than_the_guideline_was_given", faster_flow_than_the_guideline_was_given),
    ("dissipators_used_up", dissipators_used_up),
    ("ropes_broken", ropes_broken),
    ("sag_beyond_the_equations", sag_beyond_the_equations),
    ("formulas_that_stand", formulas_that_stand),
    ("parts_that_no_check_sees", parts_that_no_check_sees),
    ("loads_without_factor", loads_without_factor),
    ("rope_ends_that_hold_all", rope_ends_that_hold_all),
    ("soft_ropes", soft_ropes),
    ("validation_case_like_this", validation_case_like_this),
];

/// What is allowed, but mostly a slip.
fn inputs_far_from_usual(run: &Run) -> Option<String> {
    let odd: Vec<String> = implausible(&run.file.design)
        .iter()
        .map(|input| {
            let [least, most] = input.range.map(|value| with_unit(value, input.unit));
            format!("{} is {} (usually {least} to {most})", input.what, with_unit(input.found, input.unit))
        })
        .collect();
    (!odd.is_empty()).then(|| {
        format!("Inputs far from what such barriers usually have; check the number and its unit: {}.", odd.join("; "))
    })
}

/// What the design lets stand that would be open otherwise, with why.
fn formulas_that_stand(run: &Run) -> Option<String> {
    let reasons = |one: &Outcome| {
        let reasons: Vec<&str> = one.stands_despite.iter().map(|why| why.words()).collect();
        (!reasons.is_empty()).then(|| format!("{} ({})", lower_first(&one.title), reasons.join("; ")))
    };
    let stand: Vec<String> = run.outcomes.iter().filter_map(reasons).collect();
    (!stand.is_empty()).then(|| {
        format!("limits.outside_range: warn lets checks stand that would be open otherwise: {}.", stand.join("; "))
    })
}

/// Parts of which the design says so much that a check holds, and no more.
fn parts_that_no_check_sees(run: &Run) -> Option<String> {
    match &run.file.design.barrier {
        BarrierDesign::RigidWall(wall) => match (wall.resistance, wall.stability) {
            (Some(_), None) => Some("The wall is checked against the resistances that the design gives for the total force and for the moment at its foot: the sliding, overturning and bearing resistance of its foundation are in those numbers or are not checked (barrier.rigid_wall.stability checks them for a wall that stands by its weight).".into()),
            (None, Some(_)) => Some("The wall is checked as a block that stands by its weight: its own strength in bending and shear is not checked (barrier.rigid_wall.resistance, moment_resistance).".into()),
            _ => None,
        },
        BarrierDesign::FlexibleNet(net) => net.side_extension.map(|extension| {
            format!(
                "The strips along the side walls are held by {} at each knot, as the design says: whether wall and deposit hold that is not checked.",
                with_unit(extension.holding_force, "N")
            )
        }),
    }
}

/// Clips and bends hold less than the rope.
fn rope_ends_that_hold_all(run: &Run) -> Option<String> {
    net(run)?;
    (!run.file.entries.given("factors.rope_end")).then(|| {
        "factors.rope_end is not given: the ends of the ropes are taken to hold the whole breaking load, as sockets do; ferrules and grips hold less (0.8 to 0.9, from memory).".into()
    })
}

/// A warning as a report tells it.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Told {
    /// `barrier-check explain` knows it by this.
    pub id: &'static str,
    pub text: String,
}

pub fn warnings(run: &Run) -> Vec<Told> {
    WARNINGS.iter().filter_map(|(id, warning)| Some(Told { id, text: warning(run)? })).collect()
}

/// Of all warnings that there are.
#[cfg(test)]
pub fn ids() -> impl Iterator<Item = &'static str> {
    WARNINGS.iter().map(|(id, _)| *id)
}

fn net(run: &Run) -> Option<&FlexibleNet> {
    match &run.file.design.barrier {
        BarrierDesign::FlexibleNet(net) => Some(net),
        BarrierDesign::RigidWall(_) => None,
    }
}

fn listed(titles: &[String]) -> String {
    const MOST: usize = 4;
    let shown: Vec<String> = titles.iter().take(MOST).map(|title| lower_first(title)).collect();
    let more = match titles.len().saturating_sub(MOST) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    shown.join("; ") + &more
}

/// Largest force of the simulation over the guideline's from which it is worth a word.
const WORTH_A_WORD: f64 = 1.1;

/// Share of the mass lost from which the barrier has not stopped the flow.
const LEAK: f64 = 0.1;

/// What of the flow went past the barrier comes before all forces: they are those of the rest.
fn flow_not_stopped(run: &Run) -> Option<String> {
    let seen = run.simulated.as_ref()?;
    let all = seen.all().map(|start| &start.observed);
    let worst = all.max_by(|a, b| a.lost().iter().sum::<f64>().total_cmp(&b.lost().iter().sum::<f64>()))?;
    let lost: f64 = worst.lost().iter().sum();
    let ways = mass::WAYS.iter().map(|(way, _)| way).zip(worst.lost()).filter(|(_, share)| *share > 0.0005);
    let ways = ways.map(|(way, share)| format!("{} {way} it", with_unit(share, "-"))).collect::<Vec<_>>().join(", ");
    (lost > LEAK).then(|| {
        format!(
            "The barrier does not stop the flow: {} of the mass went past it ({ways}). All forces, strokes and tensions of the simulation below are those of a flow that was not stopped; a flow that is stopped would load the barrier more.",
            with_unit(lost, "-")
        )
    })
}

/// Share of the mass that stopped upstream from which it is worth a word.
const STOPPED: f64 = 0.02;

fn flow_that_stopped_upstream(run: &Run) -> Option<String> {
    let stopped = run.simulated.as_ref()?.first().one(&mass::STOPPED_UPSTREAM);
    (stopped > STOPPED).then(|| {
        format!(
            "{} of the mass came to rest upstream and never leant on the barrier. The mass held is counted of the rest alone, and no force is of the whole flow.",
            with_unit(stopped, "-")
        )
    })
}

/// The flow may run up higher than the survey tells of.
fn run_up_over_the_banks(run: &Run) -> Option<String> {
    let (channel, input) = (&run.file.design.channel, &run.guideline.input);
    let higher = run_up::by_jump(input, &run.guideline.section);
    (channel.survey.is_some() && higher > channel.wall_height).then(|| {
        format!(
            "By the momentum jump the flow runs up to {} in front of the barrier, and the lower end of the surveyed section is {} high (both normal to the bed): beyond it nothing is known of the ground, and nothing is modelled.",
            with_unit(higher, "m"),
            with_unit(channel.wall_height, "m")
        )
    })
}

/// A deposit whose surface never meets the bed has no volume that could be told.
/// Many barriers are meant to be overtopped; that this one is must be wanted.
fn level_over_the_barrier(run: &Run) -> Option<String> {
    let design = &run.file.design;
    let (level, height) = (run.guideline.level, height_over_bed(design));
    if design.limits.freeboard.is_some() {
        return None;
    }
    if !run.guideline.level_is_known {
        return Some("The deposit of the event reaches beyond what is known of the channel upstream: its level at the barrier is not known, nor whether it goes over, and no check asks about that (limits.freeboard has it checked).".to_string());
    }
    // Asked as "below", so that what is not a number is not.
    let below = level <= height;
    (!below).then(|| {
        format!(
            "By the equations the event reaches {}, measured normal to the bed, and the barrier is {} high: it is overtopped by run-up or deposit, and no check asks about that (limits.freeboard has it checked).",
            with_unit(level, "m"),
            with_unit(height, "m")
        )
    })
}

fn storage_without_an_end(run: &Run) -> Option<String> {
    let design = &run.file.design;
    let ends = run.guideline.retention.is_some();
    let reaches = design.channel.profile.is_some();
    (!ends && reaches).then(|| {
        "The surface of the deposit (loads.deposit_slope) does not meet the bed in the part of the channel that is known: the volume held behind the barrier is not told, and no check rests on it. A level reach has no end: give the slope that follows it. A deposit that comes to the edge of a terrain needs more of it: raise channel.terrain.upstream, or put the ends further apart.".to_string()
    })
}

/// Angle from which a bend of a gully is worth a word (rad): 15 degrees.
const BEND: f64 = 0.262;

/// Slopes and velocities are told square to the barrier, along which a bent gully does not run.
fn gully_turns(run: &Run) -> Option<String> {
    let turned = run.file.design.channel.relief.as_ref()?.most_turned();
    (turned > BEND).then(|| {
        format!(
            "The lowest line of the terrain turns up to {:.0}° aside from the square to the barrier: slopes, distances and the velocity at the release are told along that square, so that a bent gully counts as steeper and shorter than it is. The ground of the simulation is not affected.",
            turned.to_degrees()
        )
    })
}

/// A surge on a bed that holds it back: its velocity is that of the release, not of the arrival.
fn slows_on_its_way(run: &Run) -> Option<String> {
    let design = &run.file.design;
    let Arrival::Surge(surge) = design.flow.arrival else { return None };
    // What comes in through an inlet is told there, and arrives as the bed lets it.
    if design.flow.hydrograph.is_some() {
        return None;
    }
    let acts = design.flow.effective(design.channel.base_friction);
    let (slope, friction) = (design.channel.slope, libm::atan(acts));
    // On the whole of its way to the barrier.
    let slows = match &design.channel.profile {
        Some(profile) => profile.gain(surge.run_in, acts) < 0.0,
        None => friction > slope,
    };
    let seen = run.simulated.as_ref().map_or(String::new(), |seen| {
        let front = seen
            .first()
            .known(&incoming::FRONT)
            .map_or(String::new(), |front| format!("its front arrives with {}, ", with_unit(front, "m/s")));
        format!(
            " ({front}its densest part with {}, given were {})",
            with_unit(seen.first().incoming.velocity, "m/s"),
            with_unit(surge.velocity, "m/s")
        )
    });
    slows.then(|| {
        format!(
            "The bed's friction of {:.1}° holds back a flow on a slope of {:.1}°{}: the surge slows on its way. Its front is released faster, so that a body which slides from there would arrive with the velocity that was given{seen}; the front of a surge that spreads may be faster, and its tail arrives slower, or not at all.",
            friction.to_degrees(),
            slope.to_degrees(),
            if design.channel.profile.is_some() { " at the barrier" } else { "" }
        )
    })
}

fn event_larger_than_the_flow(run: &Run) -> Option<String> {
    let flow = &run.file.design.flow;
    flow.is_part_of_its_event().then(|| {
        format!(
            "The event of {} is more than the design flow of {}: {} of {}. Further surges onto the deposit are in the equations alone.",
            with_unit(flow.event_volume, "m³"),
            with_unit(flow.volume_of_all(), "m³"),
            if run.simulated.is_some() { "the simulation is" } else { "a simulation would be" },
            match flow.surges() {
                1 => "one surge on the empty barrier".to_string(),
                several => format!("{several} surges, the first on the empty barrier"),
            }
        )
    })
}

/// The rule on the discharge, where it is broken: told first, because then the design flow itself is in doubt.
fn discharge_and_volume(run: &Run) -> Option<String> {
    let rule = rules(&run.file.design, &run.guideline)
        .into_iter()
        .find(|rule| rule.bearing == Bearing::Flow && !rule.holds())?;
    let [least, most] = [rule.least, rule.most].map(|limit| limit.map_or(String::new(), figures));
    Some(format!("{} is {} (usually {least} to {most}): {}", rule.title, figures(rule.found), rule.advice))
}

/// Grains larger than the mesh cannot show what finer ones would do.
fn grains_that_hide_losses(run: &Run) -> Option<String> {
    run.simulated.as_ref()?;
    let flow = &run.file.design.flow;
    let mesh = net(run).map(FlexibleNet::opening);
    if let Some(cut) = &flow.cut {
        let through = mesh.map_or(String::new(), |mesh| {
            format!(
                " {:.0} % of the real flow is finer than the mesh of {}.",
                100.0 * cut.whole.finer_than(mesh),
                with_unit(mesh, "m")
            )
        });
        return Some(format!(
            "The finest {:.0} % of the mass is simulated as grains of {}, so that the run takes minutes (simulation.coarsen).{through}",
            100.0 * cut.share,
            with_unit(flow.sizes.quantile(0.0), "m")
        ));
    }
    let (finest, mesh) = (flow.sizes.quantile(0.1), mesh?);
    (finest > mesh).then(|| {
        format!(
            "Nine tenths of the simulated grains ({} and more) are larger than the mesh of {} and cannot pass it: if the real flow has finer ones, \"mass held\" is unsafe. Give the whole curve, with simulation.coarsen: auto where it has too many grains.",
            with_unit(finest, "m"),
            with_unit(mesh, "m")
        )
    })
}

/// Share by which the grains may be other than the curve says without a word.
const SCALED: f64 = 0.01;

/// A mass that is no whole number of grains of the given sizes.
fn grains_scaled_to_the_mass(run: &Run) -> Option<String> {
    run.simulated.as_ref()?;
    let flow = &run.file.design.flow;
    let (grains, scale) = flow.sizes.whole_grains(flow.mass, flow.grain_density());
    let many = if grains.len() == 1 { "grain".to_string() } else { format!("{} grains", grains.len()) };
    ((scale - 1.0).abs() > SCALED).then(|| {
        format!(
            "The mass makes no whole number of grains of the given sizes: the {many} nearest to it are simulated, {:.1} % {} in diameter.",
            100.0 * (scale - 1.0).abs(),
            if scale > 1.0 { "larger" } else { "smaller" }
        )
    })
}

/// A curve that is continued beyond what is given of it.
fn coarsest_grains_not_given(run: &Run) -> Option<String> {
    let flow = &run.file.design.flow;
    let sizes = &flow.sizes;
    let share = sizes.continued_from().filter(|_| !flow.tells_the_largest())?;
    Some(format!(
        "The grain sizes are given up to D{:.0} = {}: the curve is continued from there, and the largest grain is taken to be {}.",
        100.0 * share,
        with_unit(sizes.quantile(share), "m"),
        with_unit(sizes.quantile(1.0), "m")
    ))
}

/// What a share of the elastic force, given as a number alone, makes of the hit of a stone.
fn stone_on_the_wall(run: &Run) -> Option<String> {
    let design = &run.file.design;
    let BarrierDesign::RigidWall(_) = &design.barrier else { return None };
    let [force, used] = hit_on_a_metre(design, &run.guideline)?;
    Some(format!(
        "The largest stone of the flow may hit a metre of the wall with {}, which would then use {:.0} % of what it holds. That rests on loads.impact_reduction of {}, whose source belongs with this report.",
        with_unit(force, "N"),
        100.0 * used,
        figures(design.loads.impact_reduction?)
    ))
}

fn escaped(run: &Run) -> Option<String> {
    let numerics = &run.simulated.as_ref()?.numerics;
    (numerics.escaped > 0).then(|| {
        format!(
            "{} of the grains, {:.2} % of the mass, have gone through the bed or a {}. They count as lost; up to {:.1} % of the mass this leaves the verdict alone.",
            numerics.escaped,
            100.0 * numerics.escaped_share,
            run.file.design.channel.sides(),
            100.0 * ESCAPED_LIMIT
        )
    })
}

fn force_beyond_the_guideline(run: &Run) -> Option<String> {
    let (design, simulated) = (&run.file.design, run.simulated.as_ref()?);
    let simulated = simulated.spread_of_first(|seen| seen.one(&total_force::PUSH)).mean;
    let guideline = run.guideline.first_surge();
    let ratio = simulated / guideline;
    let later = if design.loads.to_the_top {
        " Surges over a deposit are in the equations alone, which are asked again with the λ that pushes as hard: what would fail then is left open."
    } else {
        ""
    };
    (ratio > WORTH_A_WORD).then(|| {
        format!(
            "The simulated surge pushes {ratio:.2} times as hard along the bed as the guideline's first surge on the empty barrier ({} against {}, without partial factors): λ = {} is low for this flow.{later} Compare K and λ with those that the simulation shows.",
            with_unit(simulated, "N"),
            with_unit(guideline, "N"),
            figures(run.guideline.input.dynamic_pressure)
        )
    })
}

fn faster_flow_than_the_guideline_was_given(run: &Run) -> Option<String> {
    let seen = run.simulated.as_ref()?.first();
    let given = run.guideline.input.velocity;
    let velocity = seen.incoming.velocity;
    // What is hit of the section.
    let moves = |depth: f64| match &run.guideline.section {
        Section::Rectangle { .. } => depth,
        section @ Section::Surveyed(_) => section.area(depth),
    };
    (given > 0.0 && seen.incoming.depth > 0.0 && velocity > 1.05 * given).then(|| {
        let front = seen.known(&incoming::FRONT).map_or(String::new(), |front| format!(" (its front with {})", with_unit(front, "m/s")));
        format!(
            "The front of the simulated flow speeds up and thins on its way: just upstream of the barrier it has {}{front} and a depth of {}, while the guideline calculation uses {} and {}. With the simulated values the pressure λρv² would be {:.0} % higher and the thrust {} {}.",
            with_unit(velocity, "m/s"),
            with_unit(seen.incoming.depth, "m"),
            with_unit(given, "m/s"),
            with_unit(run.guideline.input.depth, "m"),
            100.0 * ((velocity / given).powi(2) - 1.0),
            if run.file.design.channel.survey.is_some() { "λρv²A" } else { "λρv²h" },
            compared(moves(seen.incoming.depth) * velocity * velocity, moves(run.guideline.input.depth) * given * given)
        )
    })
}

/// A value against another in words: "12 % lower".
fn compared(value: f64, other: f64) -> String {
    let ratio = value / other;
    if ratio >= 1.0 {
        format!("{:.0} % higher", 100.0 * (ratio - 1.0))
    } else {
        format!("{:.0} % lower", 100.0 * (1.0 - ratio))
    }
}

/// When the dissipators of a rope were used up in the first start, and when the force was largest.
fn dissipators_used_up(run: &Run) -> Option<String> {
    let (seen, dissipators) = (run.simulated.as_ref()?, net(run)?.dissipators.as_ref()?);
    let used_up =
        seen.histories.barrier.rows(&of_dissipators::STROKE).iter().enumerate().filter_map(|(rope, strokes)| {
            let at = strokes.iter().position(|stroke| *stroke >= USED_UP * dissipators.stroke)?;
            Some((rope + 1, *seen.histories.time.get(at)?))
        });
    let (rope, time) = used_up.min_by(|a, b| a.1.total_cmp(&b.1))?;
    let peak = seen.first().one(&total_force::PEAK_TIME);
    let after = if peak > time {
        format!(
            "; the largest force follows {:.2} s later, when this rope stops what still moves, not when the front hits: λ from the largest force is no measure of the front then",
            peak - time
        )
    } else {
        String::new()
    };
    Some(format!(
        "The dissipators of main rope {rope} are used up after {time:.2} s{after}. From there on nothing limits the load of its anchors: more stroke, a higher yield force or more ropes would."
    ))
}

fn sag_beyond_the_equations(run: &Run) -> Option<String> {
    let ropes = run.guideline.ropes.iter().enumerate();
    let (worst, _) = ropes.max_by(|a, b| a.1.state.tension.total_cmp(&b.1.state.tension))?;
    let outside = rope_outside(&run.file.design, &run.guideline, worst)?;
    Some(format!("By the guideline {outside}. Its tension, stroke and anchor loads are an order of magnitude only."))
}

/// From when on ropes have broken in the first start.
fn ropes_broken(run: &Run) -> Option<String> {
    let first = run.simulated.as_ref()?.first().known(&rope_damage::FIRST_BREAK)?;
    Some(format!(
        "From {first:.2} s on ropes have broken: what the simulation shows later is no load of the barrier as it was designed. Strengthen what broke first and run again."
    ))
}

fn loads_without_factor(run: &Run) -> Option<String> {
    (run.file.design.factors.load == 1.0).then(|| {
        "Loads carry no partial factor (factors.load: 1): choose the set of factors of your design standard (factors.set), unless the design flow already includes the safety margin.".to_string()
    })
}

/// Modulus below which a wire rope would be unusually soft (Pa).
const SOFT: f64 = 20e9;

fn soft_ropes(run: &Run) -> Option<String> {
    let net = net(run)?;
    let of_net = net.rings.is_none().then_some(("net", net.net_rope.modulus));
    let main = net.main_ropes.levels.iter().map(|level| level.rope.modulus).fold(f64::INFINITY, f64::min);
    let ropes = [("main", main), ("lateral", net.lateral_rope.modulus)].into_iter().chain(of_net);
    let soft: Vec<&str> = ropes.filter(|(_, modulus)| *modulus < SOFT).map(|(name, _)| name).collect();
    (!soft.is_empty()).then(|| {
        format!(
            "Ropes with a modulus below {} ({}): wire ropes have several times as much. A softer rope sags more and is loaded less; state the source of the value.",
            with_unit(SOFT * 1e-9, "GPa"),
            soft.join(", ")
        )
    })
}

/// Validation cases that fail, for designs with what they fail in.
fn validation_case_like_this(run: &Run) -> Option<String> {
    run.simulated.as_ref()?;
    net(run)?.dissipators.as_ref()?;
    let kept = Kept::of_this_version()?;
    let case = kept.cases.iter().find(|case| case.id == "FS1" && !case.held)?;
    Some(format!(
        "Validation: for Albaba's published barrier with dissipators (case {}, not passed) the program reproduces forces and mean rope tensions within 15 %, but overestimates dissipator strokes by 25 to 50 % and retains 7 percentage points less of the mass. Expect strokes and losses that are too large; the cause is probably in properties of the published flow that are not documented.",
        case.id
    ))
}

/// What is left in the check that uses most by the simulation; nothing where it fails one. What a dissipator caps does not
/// grow, and is left out: its stroke tells.
pub fn left_by_simulation(run: &Run) -> Option<String> {
    run.simulated.as_ref()?;
    let judged = run.outcomes.iter().filter(|outcome| !matches!(outcome.verdict, CheckVerdict::Info));
    let used: Vec<(&Outcome, f64)> =
        judged.filter_map(|outcome| Some((outcome, used_by_simulation(outcome)?))).collect();
    if used.iter().any(|(_, used)| *used > 1.0) {
        return None;
    }
    let (most, share) = used.into_iter().filter(|(_, used)| *used > 0.0).max_by(|a, b| a.1.total_cmp(&b.1))?;
    let grow = match most.unit {
        // Between bolts a rope is pulled by the load to the power of two thirds.
        _ if matches!(most.kind, Kind::Bolts | Kind::BetweenBolts) => {
            format!(": its demand could increase by {:.0} % before it fails", 100.0 * (1.0 / share - 1.0))
        }
        Unit::Newton | Unit::NewtonPerMetre | Unit::NewtonMetrePerMetre => format!(
            ": its demand could increase by {:.0} % before it fails (the velocity by {:.0} %, if the demand grows with its square)",
            100.0 * (1.0 / share - 1.0),
            100.0 * ((1.0 / share).sqrt() - 1.0)
        ),
        _ => String::new(),
    };
    Some(format!("By the simulation the check nearest to its limit is {}{grow}.", in_a_line_by(most, share)))
}

/// The check with what the simulation alone uses of it.
fn in_a_line_by(outcome: &Outcome, share: f64) -> String {
    if is_share(outcome) {
        in_a_line(outcome)
    } else {
        let under = outcome.scaled.map_or(String::new(), |scaled| {
            format!(" under {} times the load that was simulated, which the guideline has", figures(scaled.more))
        });
        format!("{} ({:.0} %{under})", lower_first(&outcome.title), 100.0 * share)
    }
}

/// Demand of the simulation over capacity; of a least share, what is missing over what may be missing.
fn used_by_simulation(outcome: &Outcome) -> Option<f64> {
    let (simulation, capacity) = (outcome.demand.simulation?, outcome.capacity?);
    if outcome.utilisation.is_none() || outcome.demand.cap.is_some_and(|cap| simulation >= 0.99 * cap) {
        return None;
    }
    match outcome.resistance {
        Some(_) if outcome.scaled.is_some() => outcome.used(),
        Some(_) => Some(simulation / capacity),
        None => Some((1.0 - simulation) / (1.0 - capacity).max(1e-9)),
    }
}

/// Why a run as fine as this is enough, or what a finer one could change, where the design pins the fineness.
pub fn pinned_fidelity(run: &Run) -> Option<String> {
    let seen = run.simulated.as_ref().filter(|_| run.climb.is_empty())?;
    let rung = rung_of(&run.file.design, seen.starts.len());
    let open = rung.open(&run.outcomes);
    let band = &rung.band;
    let known = format!(
        "for the verdict the simulated demands are also taken with an allowance for the scatter between runs and for the error of this level of model, from the largest differences between runs and between levels on the example designs: forces {:.0} % and strokes {:.0} % more, retained mass and height {:.0} percentage points less",
        100.0 * band.force,
        100.0 * band.stroke,
        100.0 * band.share
    );
    let verdict = if open.is_empty() {
        "no check changes its result with that; the tables show the values without it".to_string()
    } else {
        format!("with that {} may pass or fail", listed(&open))
    };
    let asked = match run.file.design.simulation.fidelity {
        FidelityWish::Fast => "fast",
        FidelityWish::Standard => "standard",
        FidelityWish::Fine => "fine",
        FidelityWish::Auto => "auto",
    };
    Some(format!("fidelity: {asked} is set in the design file; {known}: {verdict}"))
}
