//! Height the barrier keeps against the least share the design asks for.

use crate::checks::outcome::{CheckName, Kind, OpenReason, Outcome};
use crate::demand::Demands;
use crate::design::{BarrierDesign, Design};
use crate::guideline::{Guideline, guideline};
use crate::quantities::height;
use crate::quantities::quantity::Unit;
use crate::sources::DESIGN_LIMIT;
use crate::text::Text;

pub(crate) const TEXTS: &[Text] = &[Text {
    id: "residual_height",
    meaning: "The height of a net at the end of the simulation over its height before it.",
    formula: "(1 − h/h₀)/(1 − limit) ≤ 1",
    source: DESIGN_LIMIT,
}];

/// A net sags and is pulled out; a rigid wall keeps its height.
pub fn check(design: &Design, demands: &Demands) -> Vec<Outcome> {
    if matches!(design.barrier, BarrierDesign::RigidWall(_)) {
        return Vec::new();
    }
    let name = CheckName::new("residual_height", "Residual height / initial height", Unit::Share, DESIGN_LIMIT);
    let mut outcome = Outcome::at_least(name, demands.one(&height::RESIDUAL), design.limits.residual_height);
    if let Some(left) = left_by_sag(design, &guideline(design))
        && outcome.holds()
    {
        // Asked as "enough", so that what is not a number is not.
        let enough = left >= design.limits.residual_height;
        if !enough {
            outcome.leave_open(OpenReason::Contradicted(format!(
                "by the guideline the top rope sags so far downstream that a net which does not stretch keeps {:.0} % of its height (a stiffer rope, a shorter span, or a higher net)",
                100.0 * left
            )));
        }
    }
    vec![Outcome { kind: Kind::HeightLeft, ..outcome }]
}

/// Height that a net of the height H keeps whose foot is held and whose top rope sags by f, over H: √(1 − (f/H)²); nothing where the
/// guideline puts no load on that rope.
pub fn left_by_sag(design: &Design, guideline: &Guideline) -> Option<f64> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return None };
    let top = guideline.ropes.last().filter(|rope| rope.load > 0.0)?;
    let over = top.state.sag / net.height;
    // Asked so that what is not a number stays so.
    Some(if over >= 1.0 { 0.0 } else { (1.0 - over * over).sqrt() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::outcome::CheckVerdict;
    use crate::demand::Demand;
    use crate::design::read::read_design;

    /// `small_net`: a sag of 0.476 m or so on 1.8 m keeps 96 %; three times the span sags nine times as far under the same pull, and no height
    /// is left.
    #[test]
    fn a_top_rope_that_sags_further_than_the_net_is_high_leaves_no_height() {
        let mut design = read_design("x", include_bytes!("../../designs/small_net.yaml")).unwrap().design;
        let seen = Demand { simulation: Some(0.9), ..Demand::default() };
        let verdict = |design: &Design| check(design, &Demands::default().with(&height::RESIDUAL, &[seen]))[0].verdict;
        assert!(left_by_sag(&design, &guideline(&design)).is_some_and(|left| left > 0.95));
        assert_eq!(verdict(&design), CheckVerdict::Pass);
        design.channel.width *= 3.5;
        assert_eq!(left_by_sag(&design, &guideline(&design)), Some(0.0));
        assert_eq!(verdict(&design), CheckVerdict::Open);
    }
}
