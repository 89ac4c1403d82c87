//! How the simulated flow arrives, surge by surge, against what the design says of it: a flow that arrives otherwise tells nothing of the design
//! flow.

use crate::design::{Arrival, Design};
use crate::larger::larger_or_nan;
use crate::quantities::incoming;
use crate::quantities::observed::Observed;
use crate::section::Section;
use crate::simulated::{Simulated, Start};
use crate::starts::Spread;

/// Share of the velocity, and of the momentum flux h v², that the design gives below which the simulated flow is another one.
const SLOWEST: f64 = 0.8;
const LEAST_FLUX: f64 = 0.55;

/// How one surge arrives, as means over the packings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrives {
    /// m/s
    pub velocity: f64,
    /// At bulk density (m); 0 of a later surge, which is not gauged.
    pub depth: f64,
    /// Momentum flux over the one that the design gives; 1 where it gives none.
    pub flux_share: f64,
}

/// Of one surge, counted from 0; `led` is the design led by it. The first is gauged just upstream of the barrier, a later one where it comes to
/// what those before it have left, which slows it from there on.
pub fn of_surge(led: &Design, simulated: &Simulated, number: usize) -> Arrives {
    if number == 0 {
        let velocity = simulated.spread_of_first(velocity_at_barrier).mean;
        let depth = simulated.spread_of_first(|seen| seen.incoming.depth).mean;
        let flux = simulated.spread_of_first(|seen| seen.incoming.flux).mean;
        let given = given_flux(led).filter(|_| led.flow.hydrograph.is_none());
        return Arrives { velocity, depth, flux_share: given.map_or(1.0, |given| flux / given) };
    }
    let [velocity, flux] = on_deposit(&simulated.starts, number);
    Arrives { velocity, depth: 0.0, flux_share: given_flux(led).map_or(f64::NAN, |given| flux / given) }
}

/// What is doubtful of a run because its flow does not arrive as the design says.
pub fn doubts(design: &Design, simulated: &Simulated) -> Vec<String> {
    let later = (1..design.flow.surges())
        .filter_map(|number| later_surge_that_falls_short(&design.led_by(number), simulated, number));
    first_surge_that_falls_short(design, simulated).into_iter().chain(later).collect()
}

fn velocity_at_barrier(seen: &Observed) -> f64 {
    larger_or_nan(seen.incoming.velocity, seen.known(&incoming::FRONT).unwrap_or(0.0))
}

/// Velocity and momentum flux of a later surge where it comes to the deposit; NaN where it does not in every packing.
fn on_deposit(starts: &[Start], number: usize) -> [f64; 2] {
    [&incoming::ON_DEPOSIT, &incoming::FLUX_ON_DEPOSIT].map(|quantity| {
        let seen = |start: &Start| start.surges.get(number).map_or(f64::NAN, |seen| seen.one(quantity));
        Spread::of(&starts.iter().map(seen).collect::<Vec<_>>()).mean
    })
}

/// A simulated flow that arrives more slowly, or thinner, than the design says.
fn first_surge_that_falls_short(design: &Design, simulated: &Simulated) -> Option<String> {
    let velocity = simulated.spread_of_first(velocity_at_barrier).mean;
    let flux = simulated.spread_of_first(|seen| seen.incoming.flux).mean;
    if velocity.is_nan() || flux.is_nan() {
        return Some("the velocity with which the simulated flow arrives is not a number".into());
    }
    // What comes in is what the table says; how it arrives is a part of the answer.
    if design.flow.hydrograph.is_some() {
        return None;
    }
    let (depth, given) = given_arrival(&design.flow.arrival)?;
    (!like_the_design(given_flux(design), given, velocity, flux)).then(|| {
        let seen = simulated.starts[0].first_surge().incoming;
        format!(
            "the simulated flow arrives {:.2} m deep with {:.2} m/s where the design says {}{given:.2} m/s, so that its loads are not those of the design flow; release it so that it arrives as it should",
            seen.depth,
            seen.velocity,
            depth.map_or(String::new(), |depth| format!("{depth:.2} m with "))
        )
    })
}

/// A later surge, counted from 0, that was not simulated or does not come to the deposit as the design says; `led` is the design led by it.
fn later_surge_that_falls_short(led: &Design, simulated: &Simulated, number: usize) -> Option<String> {
    let name = number + 1;
    let mut all = simulated.all();
    if all.any(|start| start.surges.len() <= number) {
        return Some(format!("surge {name} was not simulated"));
    }
    let [velocity, flux] = on_deposit(&simulated.starts, number);
    if velocity.is_nan() || flux.is_nan() {
        return Some(format!(
            "surge {name} stops before it comes to what the surges before it have left, so that its loads are not those of the design flow; give it a shorter run_in"
        ));
    }
    let (depth, given) = given_arrival(&led.flow.arrival)?;
    (!like_the_design(given_flux(led), given, velocity, flux)).then(|| {
        format!(
            "surge {name} comes to what the surges before it have left with {velocity:.2} m/s and {:.0} % of the momentum flux h v² that the design gives it, {}{given:.2} m/s, so that its loads are not those of the design flow; give it a shorter run_in",
            100.0 * flux / given_flux(led).unwrap_or(f64::NAN),
            depth.map_or(String::new(), |depth| format!("{depth:.2} m deep with "))
        )
    })
}

/// Depth (m) and velocity (m/s) with which the design says that the flow arrives; nothing where it gives no velocity.
fn given_arrival(arrival: &Arrival) -> Option<(Option<f64>, f64)> {
    match arrival {
        Arrival::Surge(surge) => Some((Some(surge.depth), surge.velocity)),
        Arrival::DamBreak(block) => Some((block.depth_at_barrier, block.velocity_at_barrier?)),
    }
}

/// Momentum flux (m³/s²) with which the design says that the flow arrives, where it gives depth and velocity: h v², or A v² over the mean width
/// of the section.
fn given_flux(design: &Design) -> Option<f64> {
    let (depth, velocity) = given_arrival(&design.flow.arrival)?;
    let depth = match design.channel.section() {
        Section::Rectangle { .. } => depth?,
        section @ Section::Surveyed(_) => section.area(depth?) / design.channel.width,
    };
    Some(depth * velocity * velocity)
}

/// Whether a flow with a velocity (m/s) and a momentum flux (m³/s²) is the one of a given flux and velocity, or more than it.
fn like_the_design(given_flux: Option<f64>, given: f64, velocity: f64, flux: f64) -> bool {
    let wanted = given_flux.map_or(0.0, |given_flux| LEAST_FLUX * given_flux);
    // Asked as "like", so that what is not a number is not.
    velocity >= SLOWEST * given && flux >= wanted
}

#[cfg(test)]
pub mod tests {
    use super::*;
    use crate::design::read::read_design;
    use crate::quantities::counts::Counts;

    pub fn small_net() -> Design {
        read_design("x", include_bytes!("../designs/small_net.yaml")).unwrap().design
    }

    /// Starts from seed 7 on, each with what it showed.
    pub fn simulated(observed: Vec<Observed>) -> Simulated {
        let starts = observed.into_iter().zip(7..).map(|(observed, seed)| Start { seed, observed, surges: Vec::new() });
        Simulated { starts: starts.collect(), ..Simulated::default() }
    }

    /// What was seen of a flow that arrives with a velocity (m/s) and a momentum flux (m³/s²).
    pub fn arriving(velocity: f64, flux: f64) -> Observed {
        let mut seen = Observed::of_nothing(Counts { ropes: 3, ..Counts::default() });
        (seen.incoming.velocity, seen.incoming.flux, seen.incoming.depth) = (velocity, flux, 0.4);
        seen
    }

    #[test]
    fn a_flow_that_arrives_slowly_or_thinly_is_not_the_one_of_the_design() {
        // 25 m³/s² of momentum flux, as of a flow 1 m deep with 5 m/s.
        let like = |velocity: f64, flux: f64| like_the_design(Some(25.0), 5.0, velocity, flux);
        assert!(like(5.0, 25.0) && like(7.0, 40.0) && like(4.1, 14.0));
        assert!(!like(3.9, 25.0), "slow");
        assert!(!like(5.0, 13.5), "thin");
        assert!(!like(f64::NAN, 25.0) && !like(5.0, f64::NAN));
        // Where no flux is given the velocity alone tells.
        assert!(like_the_design(None, 5.0, 4.1, 0.0) && !like_the_design(None, 5.0, 3.9, 99.0));
    }

    /// `small_net` is hit 0.6 m deep with 4.6 m/s: 12.7 m³/s².
    #[test]
    fn a_flow_slower_than_the_design_s_is_told_with_both() {
        let design = small_net();
        let told = |observed: Vec<Observed>| first_surge_that_falls_short(&design, &simulated(observed));
        assert_eq!(given_arrival(&design.flow.arrival), Some((Some(0.6), 4.6)));
        assert_eq!(told(vec![arriving(4.6, 10.6)]), None);
        // The mean of the packings counts, and the front where it is faster.
        assert_eq!(told(vec![arriving(3.0, 10.6), arriving(4.8, 10.6)]), None);
        assert_eq!(told(vec![arriving(3.0, 10.6).with(&incoming::FRONT, &[4.0])]), None);
        let slow = told(vec![arriving(3.0, 10.6)]).expect("a doubt");
        assert!(slow.contains("0.40 m deep with 3.00 m/s where the design says 0.60 m with 4.60 m/s"), "{slow}");
        assert!(told(vec![arriving(4.6, 5.0)]).is_some(), "thin");
        for unknown in [arriving(f64::NAN, 10.6), arriving(4.6, f64::NAN)] {
            assert!(told(vec![unknown]).is_some_and(|why| why.contains("not a number")));
        }
        let block = read_design("x", include_bytes!("../designs/rigid_wall.yaml")).unwrap().design;
        assert_eq!(given_arrival(&block.flow.arrival), Some((Some(0.97), 8.85)));
        let Arrival::DamBreak(mut block) = block.flow.arrival else { panic!("a block") };
        block.velocity_at_barrier = None;
        assert_eq!(given_arrival(&Arrival::DamBreak(block)), None);
    }

    /// The later surges of the example come 0.6 m deep with 4.6 m/s and 0.5 m deep with 4 m/s: 12.7 and 8 m³/s².
    #[test]
    fn a_later_surge_that_is_slow_stops_or_is_missing_is_a_doubt() {
        let design = read_design("x", include_bytes!("../designs/three_surges.yaml")).unwrap().design;
        let told = |later: &[Option<[f64; 2]>]| {
            let first = arriving(4.6, 10.6);
            let on_deposit = |seen: &Option<[f64; 2]>| {
                let value = |index: usize| seen.map(|seen| seen[index]);
                let seen = first.clone().with(&incoming::ON_DEPOSIT, value(0).as_slice());
                seen.with(&incoming::FLUX_ON_DEPOSIT, value(1).as_slice())
            };
            let surges: Vec<Observed> = std::iter::once(first.clone()).chain(later.iter().map(on_deposit)).collect();
            let mut simulated = simulated(vec![first.clone()]);
            simulated.starts[0].surges = surges;
            (doubts(&design, &simulated), of_surge(&design.led_by(1), &simulated, 1))
        };
        let (none, second) = told(&[Some([4.6, 12.7]), Some([3.3, 5.0])]);
        assert_eq!((none.len(), second.velocity), (0, 4.6));
        assert!((second.flux_share - 1.0).abs() < 1e-3, "{second:?}");
        let (slow, _) = told(&[Some([2.3, 12.7]), Some([4.0, 8.0])]);
        assert!(slow.len() == 1 && slow[0].contains("surge 2 comes to") && slow[0].contains("2.30 m/s"), "{slow:?}");
        let (thin, second) = told(&[Some([4.6, 6.35]), Some([4.0, 8.0])]);
        assert!(thin.len() == 1 && thin[0].contains("50 % of the momentum flux"), "{thin:?}");
        assert!((second.flux_share - 0.5).abs() < 1e-3);
        let (stopped, second) = told(&[None, Some([4.0, 8.0])]);
        assert!(stopped.len() == 1 && stopped[0].contains("surge 2 stops before"), "{stopped:?}");
        assert!(second.velocity.is_nan() && second.flux_share.is_nan());
        assert_eq!(told(&[Some([4.6, 12.7])]).0, ["surge 3 was not simulated"]);
    }
}
