//! The choices of the model that a study turns, each alone.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::design::{BarrierDesign, BarrierModel, Design};
use crate::fidelity::{Fidelity, choose, step_share};

/// A knob of the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Knob {
    /// Share of the critical time step.
    Step,
    /// Factor on the contact modulus of the grains.
    Stiffness,
    /// Factor on the size of the grains, whose mass in all stays.
    CoarseGraining,
    /// Length over width of the grains; 1 is a sphere.
    Aspect,
    /// Reach of the neighbour lists over the mean radius.
    Skin,
    /// Model of the barrier: 1 pinned ropes, 2 sliding ropes, 3 cylinders.
    BarrierModel,
    /// Length of the elements of main ropes (m), of the model of cylinders.
    ElementLength,
}

impl Knob {
    /// As a study file names it.
    pub fn key(self) -> &'static str {
        match self {
            Self::Step => "step",
            Self::Stiffness => "stiffness",
            Self::CoarseGraining => "coarse_graining",
            Self::Aspect => "aspect",
            Self::Skin => "skin",
            Self::BarrierModel => "barrier_model",
            Self::ElementLength => "element_length",
        }
    }

    pub fn title(self) -> &'static str {
        match self {
            Self::Step => "time step over critical",
            Self::Stiffness => "contact modulus, factor",
            Self::CoarseGraining => "grain size, factor",
            Self::Aspect => "length over width of grains",
            Self::Skin => "reach of lists over radius",
            Self::BarrierModel => "model of the barrier",
            Self::ElementLength => "rope element (m)",
        }
    }

    /// Values that make sense; the models of the barrier are whole numbers.
    pub fn range(self) -> [f64; 2] {
        match self {
            Self::Step => [0.005, 2.0],
            Self::Stiffness => [0.01, 100.0],
            Self::CoarseGraining => [0.3, 5.0],
            Self::Aspect => [1.0, 2.0],
            Self::Skin => [0.05, 3.0],
            Self::BarrierModel => [1.0, 3.0],
            Self::ElementLength => [0.01, 10.0],
        }
    }

    /// Whether a value makes sense. Asked so that what is not a number does not.
    pub fn takes(self, value: f64) -> bool {
        let [least, most] = self.range();
        (least..=most).contains(&value) && (self != Self::BarrierModel || value.fract() == 0.0)
    }

    /// What the design itself has.
    pub fn default_of(self, design: &Design) -> f64 {
        match (self, &design.barrier) {
            (Self::Step, _) => step_share(design.simulation.fidelity).1,
            (Self::Stiffness | Self::CoarseGraining, _) => 1.0,
            (Self::Aspect, _) => design.flow.aspect,
            (Self::Skin, _) => choose(design).skin_share,
            (Self::BarrierModel, _) => match design.simulation.barrier_model {
                BarrierModel::PinnedRopes => 1.0,
                BarrierModel::SlidingRopes => 2.0,
                BarrierModel::Cylinders => 3.0,
            },
            (Self::ElementLength, BarrierDesign::FlexibleNet(net)) => net.main_ropes.element_length,
            (Self::ElementLength, BarrierDesign::RigidWall(_)) => f64::NAN,
        }
    }

    /// Whether the scene has this knob at all.
    pub fn turns(self, design: &Design) -> bool {
        match self {
            Self::BarrierModel => matches!(design.barrier, BarrierDesign::FlexibleNet(_)),
            Self::ElementLength => {
                matches!(design.barrier, BarrierDesign::FlexibleNet(_))
                    && design.simulation.barrier_model == BarrierModel::Cylinders
            }
            _ => true,
        }
    }

    /// Puts the knob to `value` in the design, where it is one of the design's.
    fn change(self, design: &mut Design, value: f64) {
        match self {
            Self::Step | Self::Skin => {}
            Self::Stiffness => design.flow.modulus *= value,
            Self::CoarseGraining => design.flow.coarsen(value),
            Self::Aspect => design.flow.aspect = value,
            Self::BarrierModel => design.simulation.barrier_model = model_of(value),
            Self::ElementLength => {
                if let BarrierDesign::FlexibleNet(net) = &mut design.barrier {
                    net.main_ropes.element_length = value;
                }
            }
        }
    }

    /// Puts the knob to `value` in how finely the design is modelled, where it is one of that.
    fn refine(self, fidelity: &mut Fidelity, design: &Design, value: f64) {
        match self {
            Self::Step => {
                let finer = value / step_share(design.simulation.fidelity).1;
                fidelity.time_step *= finer;
                fidelity.barrier_step *= finer;
            }
            Self::Skin => fidelity.skin_share = value,
            _ => {}
        }
    }

    /// A value as a person reads it.
    pub fn word(self, value: f64) -> String {
        match self {
            Self::BarrierModel => match model_of(value) {
                BarrierModel::PinnedRopes => "pinned ropes".into(),
                BarrierModel::SlidingRopes => "sliding ropes".into(),
                BarrierModel::Cylinders => "cylinders".into(),
            },
            _ => format!("{value}"),
        }
    }
}

/// The design and how finely it is modelled with all the knobs put to their values.
pub fn turn(design: &Design, knobs: &[(Knob, f64)]) -> (Design, Fidelity) {
    let mut design = design.clone();
    knobs.iter().for_each(|(knob, value)| knob.change(&mut design, *value));
    let mut fidelity = choose(&design);
    knobs.iter().for_each(|(knob, value)| knob.refine(&mut fidelity, &design, *value));
    (design, fidelity)
}

fn model_of(value: f64) -> BarrierModel {
    match value {
        value if value < 1.5 => BarrierModel::PinnedRopes,
        value if value < 2.5 => BarrierModel::SlidingRopes,
        _ => BarrierModel::Cylinders,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::read::read_design;

    #[test]
    fn knobs_turn_together_in_any_order() {
        let design = read_design("x", include_bytes!("../../designs/rigid_wall.yaml")).unwrap().design;
        let both = [(Knob::Step, 0.1), (Knob::Stiffness, 4.0)];
        let (stiff, fine) = turn(&design, &both);
        assert_eq!(turn(&design, &[both[1], both[0]]), (stiff.clone(), fine.clone()));
        assert_eq!(stiff.flow.modulus, 4.0 * design.flow.modulus);
        // A quarter of the share, and half of the critical step: both are read to two digits.
        let ratio = choose(&design).time_step / fine.time_step;
        assert!((ratio / 8.0 - 1.0).abs() < 0.1, "{ratio}");
    }
}
