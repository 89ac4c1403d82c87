//! Mass held by the barrier against the least share the design asks for.

use crate::checks::height::left_by_sag;
use crate::checks::outcome::{CheckName, CheckVerdict, Kind, OpenReason, Outcome};
use crate::demand::Demands;
use crate::design::{BarrierDesign, Design, Flow, RetainedOf};
use crate::guideline::{event_fill, flows, guideline, height_over_bed, held, held_below, input};
use crate::larger::larger_or_nan;
use crate::loads::fill::Surface;
use crate::loads::input::GuidelineInput;
use crate::quantities::mass;
use crate::quantities::quantity::Unit;
use crate::sources::DESIGN_LIMIT;
use crate::text::Text;

pub(crate) const TEXTS: &[Text] = &[Text {
    id: "retained_mass",
    meaning: "The share of the released mass that the barrier holds at the end of the simulation. Its utilisation is what is missing over what may be missing.",
    formula: "(1 − m/m₀)/(1 − limit) ≤ 1",
    source: DESIGN_LIMIT,
}];

pub fn check(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let title = match design.limits.retained_of {
        RetainedOf::Mixture => "Mass retained by the barrier",
        RetainedOf::Grains => "Mass of grains retained by the barrier",
    };
    let name = CheckName::new("retained_mass", title, Unit::Share, DESIGN_LIMIT);
    let mut outcome = Outcome::at_least(name, demands.one(&mass::RETAINED), design.limits.retained_mass);
    outcome.kind = Kind::MassHeld;
    if matches!(outcome.verdict, CheckVerdict::Pass | CheckVerdict::Warn)
        && let Some(why) = unseen(design, demands.one(&mass::RETAINED).simulation)
    {
        outcome.leave_open(why);
    }
    vec![outcome]
}

/// What the simulation cannot have seen get lost: grains that were made too coarse for mesh and gap, and surges that were not simulated.
fn unseen(design: &Design, held_in_simulation: Option<f64>) -> Option<OpenReason> {
    unseen_fluid(design, held_in_simulation)
        .or_else(|| unseen_fines(design, held_in_simulation))
        .or_else(|| unseen_volume(design))
}

/// The simulated mixture is held as a whole, but its fluid runs through a net.
fn unseen_fluid(design: &Design, held_in_simulation: Option<f64>) -> Option<OpenReason> {
    let (BarrierDesign::FlexibleNet(_), RetainedOf::Mixture) = (&design.barrier, design.limits.retained_of) else {
        return None;
    };
    let fluid = design.flow.pore_fluid?;
    let share = (1.0 - design.flow.solid_share()) * fluid.density / design.flow.bulk_density;
    let held = held_in_simulation.unwrap_or(1.0);
    // Asked as "enough", so that what is not a number is not.
    let enough = held * (1.0 - share) >= design.limits.retained_mass;
    (!enough).then(|| {
        OpenReason::NotGiven(format!(
            "{:.0} % of the mass are the pore fluid with its fines, which runs through a net, and the simulation holds it with the grains: {:.0} % of the mass are held for certain (limits.retained_of: grains asks for the share of the grains alone)",
            100.0 * share,
            100.0 * held * (1.0 - share)
        ))
    })
}

fn unseen_fines(design: &Design, held_in_simulation: Option<f64>) -> Option<OpenReason> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return None };
    let flow = &design.flow;
    let surges: Vec<Flow> = (0..flow.surges()).map(|number| flow.alone(number)).collect();
    // Of all surges together.
    let share = |of: &dyn Fn(&Flow) -> f64| {
        surges.iter().map(|surge| of(surge) * surge.volume()).sum::<f64>() / flow.volume_of_all()
    };
    let allowed = 1.0 - design.limits.retained_mass;
    let lost = 1.0 - held_in_simulation.unwrap_or(1.0);
    let opening = net.opening().max(net.bottom.gap());
    let finer = share(&|surge| surge.cut.as_ref().map_or(0.0, |cut| cut.whole.finer_than(opening)));
    // A modelled ring runs straight from contact to contact, and holds what a round one would let through.
    // What is not given is told apart.
    let unknown = share(&|surge| surge.known_from);
    let held_alone = |surge: &Flow| {
        let finest = surge.sizes.finer_than(net.mesh_opening).max(surge.known_from);
        (surge.sizes.finer_than(net.opening()) - finest).max(0.0)
    };
    let doubtful = share(&held_alone);
    let within = doubtful + finer + unknown + lost <= allowed + 1e-9;
    if doubtful > 0.0 && !within {
        return Some(OpenReason::NotGiven(format!(
            "{:.0} % of the simulated flow are stones that a ring of the net lets through alone and the model of straight sides holds, so that with the {:.0} % that are finer, not given or lost in the simulation more may be lost than the {:.0} % allowed (smaller rings; a finer mesh hung before them is not modelled)",
            100.0 * doubtful,
            100.0 * (finer + unknown + lost),
            100.0 * allowed
        )));
    }
    // Asked as "within", so that what is not a number is not.
    let within = finer + lost <= allowed;
    if flow.cut.is_some() && !within {
        return Some(OpenReason::NotGiven(format!(
            "{:.0} % of the real flow is finer than the openings of the net and was not simulated as it is (simulation.coarsen), so that what of it gets through is not known",
            100.0 * finer
        )));
    }
    // All of it may pass, beside what the simulation shows to be lost.
    let within = unknown + lost <= allowed + 1e-9;
    if unknown > 0.0 && !within {
        return Some(OpenReason::NotGiven(format!(
            "the finest {:.0} % of the flow are not given, and finer grains pass a net: with the {:.1} % lost in the simulation more may be lost than the {:.0} % allowed (give flow.grain_sizes.curve from its fine end, as d5 or d1{})",
            100.0 * unknown,
            100.0 * lost,
            100.0 * allowed,
            if flow.later.iter().any(|later| later.own.is_some()) { ", and so those of each surge" } else { "" }
        )));
    }
    let none_passes = |surge: &Flow| surge.cut.is_none() && surge.sizes.quantile(0.1) > net.opening();
    surges.iter().any(none_passes).then(|| {
        OpenReason::NotGiven(
            "nine tenths of the simulated grains are larger than the mesh and cannot pass it, and whether the real flow has finer ones is not said (give the whole curve, with simulation.coarsen: auto where it has too many grains)".into(),
        )
    })
}

fn unseen_volume(design: &Design) -> Option<OpenReason> {
    let flow = &design.flow;
    // What the barrier does not store is held by friction upstream of it, as long as the flow is no wetter than the simulated one.
    let behind = stored(design);
    if behind.is_none() && design.channel.profile.is_some() {
        return Some(OpenReason::NotGiven(
            "the surface of the deposit does not meet the bed in the part of the channel that is known, so that what the barrier stores is not known (a terrain: raise channel.terrain.upstream, or put the ends further apart; a level reach: give the slope that follows it)".to_string(),
        ));
    }
    let behind = behind.unwrap_or(0.0);
    // Asked as "suffices", so that what is not a number does not.
    let suffices = behind >= design.limits.retained_mass * flow.volume_of_all();
    if !suffices {
        return Some(OpenReason::NotGiven(format!(
            "the barrier stores {behind:.0} m³ of its {:.0} m³, with the slope of the deposit that the design counts on, and the rest is held by friction upstream: a wetter flow of that volume would go over it (a higher barrier, or loads.deposit_slope and filled_height as they are known to be)",
            flow.volume_of_all()
        )));
    }
    if !flow.is_part_of_its_event() {
        return None;
    }
    let reach = |flow: &GuidelineInput| event_fill(design, flow).reach();
    let heaped = flows(design, input(design)).iter().map(reach).fold(0.0, larger_or_nan);
    if heaped > height_over_bed(design) {
        return Some(OpenReason::NotGiven(format!(
            "{} was simulated, and the last of the event's {:.0} m³ may run up to {heaped:.1} m, from what the others leave, over the barrier's {:.1} m, so that what of the later surges is held is not known",
            simulated_part(flow),
            flow.event_volume,
            height_over_bed(design)
        )));
    }
    // To a level surface at the height that the filled barrier keeps: what it holds for certain; nothing is known on a level bed.
    let level = held_below(design, Surface::Plane(0.0)).map(|held| held.volume);
    let holds = level.is_some_and(|level| level >= design.limits.retained_mass * flow.event_volume);
    let level = level.map_or("an unknown volume".to_string(), |level| format!("{level:.0} m³"));
    (!holds).then(|| {
        OpenReason::NotGiven(format!(
            "{} was simulated, and to a level surface the barrier holds {level} of the event's {:.0} m³, so that what of the later surges is held is not known",
            simulated_part(flow),
            flow.event_volume
        ))
    })
}

/// What of its event is simulated, in words.
fn simulated_part(flow: &Flow) -> String {
    match flow.surges() {
        1 => format!("one surge of {:.0} m³", flow.volume()),
        several => format!("a part of {:.0} m³ in {several} surges", flow.volume_of_all()),
    }
}

/// Volume behind the barrier (m³), where the deposit ends in the part of the channel that is known, with the design's slope of the deposit, and no more of its height than the top rope's sag leaves.
fn stored(design: &Design) -> Option<f64> {
    let mut sagged = design.clone();
    if let Some(left) = left_by_sag(design, &guideline(design)) {
        sagged.loads.filled_height = design.loads.filled_height.min(left);
    }
    held(&sagged).map(|held| held.volume)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::demand::Demand;
    use crate::design::read::read_design;
    use crate::design::{Bottom, PoreFluid};
    use crate::quantities::mass;

    #[test]
    fn an_event_that_more_than_fills_the_barrier_is_not_held_because_one_surge_is() {
        let mut design = read_design("x", include_bytes!("../../designs/small_net.yaml")).unwrap().design;
        let retained = Demand { simulation: Some(1.0), ..Demand::default() };
        let demands = Demands::default().with(&mass::RETAINED, &[retained]);
        assert_eq!(check(&design, &demands)[0].verdict, CheckVerdict::Pass);
        design.flow.event_volume = 40.0 * design.flow.volume();
        assert_eq!(check(&design, &demands)[0].verdict, CheckVerdict::Open);
        // Whatever slope of the deposit the design counts on.
        design.loads.deposit_slope = 0.99;
        assert_eq!(check(&design, &demands)[0].verdict, CheckVerdict::Open);
        // On a level bed nothing is known of what is held.
        (design.channel.slope, design.flow.event_volume) = (0.0, 2.0 * design.flow.volume());
        assert_eq!(check(&design, &demands)[0].verdict, CheckVerdict::Open);
    }

    /// Grains are (1850 − 1300)/(2650 − 1300) = 40.7 % of the volume; the fluid is 0.593 · 1300/1850 = 41.6 % of the mass.
    #[test]
    fn a_fluid_runs_through_a_net() {
        let wet = |of: RetainedOf, limit: f64| {
            let flow = |design: &mut Design| {
                (design.flow.bulk_density, design.flow.solid_density) = (1850.0, 2650.0);
                let fluid = PoreFluid { density: 1300.0, pressure_ratio: 0.72, drains_in: 60.0, drains_to: 0.72 };
                (design.flow.pore_fluid, design.flow.event_volume) = (Some(fluid), design.flow.volume());
                (design.limits.retained_of, design.limits.retained_mass) = (of, limit);
            };
            verdict(flow, 1.0)
        };
        assert_eq!([0.58, 0.59].map(|limit| wet(RetainedOf::Mixture, limit)), [CheckVerdict::Pass, CheckVerdict::Open]);
        assert_eq!(wet(RetainedOf::Grains, 0.9), CheckVerdict::Pass);
    }

    /// Verdict of `small_net`, of whose flow 10 % may be lost, after a change and with a share held in the simulation.
    fn verdict(change: impl Fn(&mut Design), held: f64) -> CheckVerdict {
        let mut design = read_design("x", include_bytes!("../../designs/small_net.yaml")).unwrap().design;
        (design.limits.retained_mass, design.flow.known_from) = (0.9, 0.0);
        change(&mut design);
        let retained = Demand { simulation: Some(held), ..Demand::default() };
        check(&design, &Demands::default().with(&mass::RETAINED, &[retained]))[0].verdict
    }

    /// Of the whole flow 6 % are finer than the mesh, or than the gap below the net where that is wider.
    #[test]
    fn what_was_made_coarser_than_the_mesh_may_be_lost_beside_what_is() {
        use crate::design::CurveCut;
        let cut = |widest: f64, through_gap: bool| {
            move |design: &mut Design| {
                let whole = design.flow.sizes.clone();
                let opening = widest * whole.quantile(0.06);
                design.flow.cut = Some(CurveCut { share: 0.06, whole });
                let BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
                net.mesh_opening = opening;
                if through_gap {
                    (net.mesh_opening, net.bottom) = (0.5 * opening, Bottom::Opening(opening));
                }
            }
        };
        for through_gap in [false, true] {
            assert_eq!(verdict(cut(1.0, through_gap), 0.97), CheckVerdict::Pass);
            assert_eq!(verdict(cut(1.0, through_gap), 0.95), CheckVerdict::Open);
        }
    }

    /// What is not given may be lost whole, beside what is seen to be lost: 10 % + 0.1 % of 10.2 %.
    #[test]
    fn the_finest_part_that_is_not_given_may_be_lost_beside_what_is() {
        let known = |from: f64, least: f64, held: f64| {
            verdict(|design| (design.flow.known_from, design.limits.retained_mass) = (from, least), held)
        };
        assert_eq!(known(0.1, 0.898, 0.999), CheckVerdict::Pass);
        assert_eq!(known(0.1, 0.9, 0.999), CheckVerdict::Open);
        assert_eq!(known(0.1, 0.9, 1.0), CheckVerdict::Pass);
        assert_eq!(known(0.0, 0.98, 0.999), CheckVerdict::Pass);
        assert_eq!(known(0.05, 0.9, 0.94), CheckVerdict::Open);
        assert_eq!(known(0.05, 0.9, 0.96), CheckVerdict::Pass);
    }

    /// Rings of 300 mm, whose model holds stones of 212 mm: 10 % of the flow are not given, and a tenth is between; together more than 15 % may
    /// pass, and less than 25 %.
    #[test]
    fn stones_that_pass_a_ring_count_beside_what_is_not_given() {
        let text = include_str!("../../designs/ring_net.yaml");
        let (from, to) = (text.find("      d10:").unwrap(), text.find("  grain_aspect").unwrap());
        let curve = "      d10: 208 mm\n      d20: 300 mm\n      d50: 330 mm\n      d90: 370 mm\n    \n";
        let verdict = |limit: &str| {
            let text = text
                .replace(&text[from..to], curve)
                .replace("curve:  ", "curve: ")
                .replace("retained_mass: 85 %", limit);
            let design = read_design("x", text.as_bytes()).unwrap_or_else(|problems| panic!("{problems}")).design;
            let retained = Demand { simulation: Some(0.991), ..Demand::default() };
            check(&design, &Demands::default().with(&mass::RETAINED, &[retained]))[0].verdict
        };
        assert_eq!(verdict("retained_mass: 85 %"), CheckVerdict::Open);
        assert_eq!(verdict("retained_mass: 75 %"), CheckVerdict::Pass);
    }

    #[test]
    fn grains_that_are_all_wider_than_the_mesh_say_nothing_of_finer_ones() {
        let mesh = |opening: f64| {
            verdict(
                |design| {
                    let finest = design.flow.sizes.quantile(0.1);
                    let BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
                    net.mesh_opening = opening * finest;
                },
                1.0,
            )
        };
        assert_eq!((mesh(1.01), mesh(0.99)), (CheckVerdict::Pass, CheckVerdict::Open));
    }

    /// An event of several surges is held for certain where it heaps up no higher than the barrier, which decides where it is fast, and then
    /// to a level surface: of V/0.9 the barrier is asked for the V that it holds so.
    #[test]
    fn of_an_event_of_several_surges_a_level_deposit_that_stays_below_the_top_is_held_for_certain() {
        let event = |velocity: f64, volume: &dyn Fn(&Design) -> f64| {
            verdict(
                |design| {
                    let crate::design::Arrival::Surge(surge) = &mut design.flow.arrival else { panic!("a surge") };
                    // A net that sinks in far holds little to a level surface.
                    (surge.velocity, design.loads.filled_height) = (velocity, if velocity < 1.0 { 0.4 } else { 1.0 });
                    design.channel.side_friction = 0.0;
                    design.flow.mass *= 0.1;
                    design.flow.event_volume = volume(design);
                },
                1.0,
            )
        };
        // The event that heaps up to the top, found by halving.
        let heaps = |design: &Design| {
            let (mut low, mut high) = (design.flow.volume(), 100.0 * design.flow.volume());
            for _ in 0..60 {
                let mut with = design.clone();
                with.flow.event_volume = 0.5 * (low + high);
                let over = event_fill(&with, &input(&with)).reach() > height_over_bed(&with);
                if over { high = with.flow.event_volume } else { low = with.flow.event_volume }
            }
            low
        };
        let fast = |share: f64| event(9.0, &|design| share * heaps(design));
        assert_eq!((fast(0.99), fast(1.01)), (CheckVerdict::Pass, CheckVerdict::Open));
        let level = |design: &Design| held_below(design, Surface::Plane(0.0)).expect("a deposit").volume / 0.9;
        let slow = |share: f64| event(0.1, &|design| share * level(design));
        assert_eq!((slow(0.99), slow(1.01)), (CheckVerdict::Pass, CheckVerdict::Open));
        // An event that is larger by less than a thousandth is the one flow.
        let same = |more: f64| {
            verdict(
                |design| {
                    design.flow.event_volume = more * design.flow.volume();
                },
                1.0,
            )
        };
        assert_eq!((same(1.0005), same(1.002)), (CheckVerdict::Pass, CheckVerdict::Open));
    }

    /// What the barrier does not store is held by friction upstream, whatever the simulation shows: 90 % of the flow must go behind it.
    #[test]
    fn what_the_barrier_does_not_store_is_not_held_by_it() {
        let on = |friction: f64, share: f64| {
            let change = |design: &mut Design| {
                (design.channel.slope, design.channel.base_friction) =
                    (20_f64.to_radians(), libm::tan(friction.to_radians()));
                design.flow.mass *= share * stored(design).unwrap() / 0.9 / design.flow.volume();
                design.flow.event_volume = design.flow.volume();
            };
            verdict(change, 1.0)
        };
        for friction in [22.0, 18.0, 12.0] {
            assert_eq!((on(friction, 0.99), on(friction, 1.01)), (CheckVerdict::Pass, CheckVerdict::Open));
        }
        // Nothing is known of what is stored on a level bed.
        let level = verdict(|design| design.channel.slope = 0.0, 1.0);
        assert_eq!(level, CheckVerdict::Open);
    }

    /// A top rope that sags by half of the net's height leaves less of it than is counted on.
    #[test]
    fn a_net_stores_no_more_than_its_sag_leaves() {
        let mut design = read_design("x", include_bytes!("../../designs/small_net.yaml")).unwrap().design;
        design.loads.filled_height = 1.0;
        let BarrierDesign::FlexibleNet(net) = &mut design.barrier else { panic!("a net") };
        net.dissipators.as_mut().expect("dissipators").plateau = 70e3;
        let left = left_by_sag(&design, &guideline(&design)).expect("a load");
        let whole = held(&design).expect("a deposit").volume;
        assert!(left < 0.95, "{left}");
        assert!((stored(&design).unwrap() / (whole * left * left) - 1.0).abs() < 1e-9);
    }
}
