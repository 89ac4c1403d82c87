//! A wall that stands by its weight: sliding along its base, overturning about the downstream edge. Per metre of width.

use crate::checks::outcome::{CheckName, Outcome, Resistance};
use crate::demand::{Demand, Demands};
use crate::design::{BarrierDesign, Design, Stability};
use crate::loads::wall::WallInput;
use crate::sources::WALL_BALANCE;

pub fn check(design: &Design, demands: &Demands) -> Vec<Outcome> {
    let (Some(input), Some(stability)) = (wall_of(design), stability_of(design)) else { return Vec::new() };
    let with_own = |demand: Demand, own: f64| Demand {
        guideline: demand.guideline.map(|value| value + own),
        simulation: demand.simulation.map(|value| value + own),
        characteristic: demand.characteristic.map(|value| value + own),
        cap: None,
    };
    let [holds_back, pull] = input.sliding();
    let [holds_up, tilt] = input.overturning();
    let sliding = CheckName::new("wall_sliding", "Sliding of the wall, per width", "N/m", WALL_BALANCE);
    let overturning = CheckName::new("wall_overturning", "Overturning of the wall, per width", "N m/m", WALL_BALANCE);
    vec![
        Outcome::at_most(
            sliding,
            with_own(demands.wall_force.times(input.load_share()), pull),
            Resistance { characteristic: holds_back, factor: stability.sliding_factor },
            1.0,
        ),
        Outcome::at_most(
            overturning,
            with_own(demands.wall_moment, tilt),
            Resistance { characteristic: holds_up, factor: stability.overturning_factor },
            1.0,
        ),
    ]
}

fn stability_of(design: &Design) -> Option<Stability> {
    match &design.barrier {
        BarrierDesign::RigidWall(wall) => wall.stability,
        BarrierDesign::FlexibleNet(_) => None,
    }
}

/// The wall of the design, if it stands by its weight.
pub fn wall_of(design: &Design) -> Option<WallInput> {
    let BarrierDesign::RigidWall(wall) = &design.barrier else { return None };
    let stability = wall.stability?;
    let (base_slope, bed_slope) = (stability.base_slope, design.channel.slope);
    Some(WallInput {
        height: wall.height / (bed_slope - base_slope).cos(),
        thickness: stability.thickness,
        base_width: stability.base_width,
        density: stability.density,
        base_friction: stability.base_friction,
        base_slope,
        bed_slope,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::check_all;
    use crate::checks::outcome::CheckVerdict;
    use crate::design::read::read_design;

    #[test]
    fn a_wall_without_resistance_and_stability_is_open_and_one_with_either_is_not() {
        let read = |text: &str| read_design("x", text.as_bytes()).unwrap().design;
        let open = |design: &Design| {
            let guideline = crate::demand::from_loads::guideline(design);
            let outcomes = check_all(design, &Demands::by_equations(&guideline, &design.factors));
            outcomes.iter().any(|outcome| outcome.id == "total_force" && outcome.verdict == CheckVerdict::Open)
        };
        let mut design = read(include_str!("../../designs/wall_section_5_2.yaml"));
        assert!(!open(&design));
        if let BarrierDesign::RigidWall(wall) = &mut design.barrier {
            wall.stability = None;
        }
        assert!(open(&design));
        assert!(!open(&read(include_str!("../../designs/rigid_wall.yaml"))));
    }
}
