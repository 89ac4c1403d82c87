//! A hydrograph that ends while much still flows: what follows is not known, and it is the event all the same.

use super::context::CheckContext;
use crate::checks::outcome::{OpenReason, Outcome};

/// Share of the largest discharge below which the last of a table is its end.
const ENDED: f64 = 0.05;

/// Share of it below which its peak is past.
const FALLS: f64 = 0.5;

pub fn leave_open(CheckContext { design, .. }: CheckContext, outcomes: &mut [Outcome]) {
    let Some(hydrograph) = &design.flow.hydrograph else { return };
    let section = design.channel.section();
    let mut discharges = hydrograph.rows.iter().map(|row| section.area(row.depth) * row.velocity);
    let largest = discharges.clone().fold(0.0, f64::max);
    let last = discharges.next_back().unwrap_or(0.0);
    // Asked as "ended", so that what is not a number has not.
    let ended = last <= ENDED * largest;
    // A larger event is told of by its volume, and what comes later has rules of its own; but no volume tells of a peak that is still to come.
    let falls = last <= FALLS * largest;
    if ended || falls && design.flow.is_part_of_its_event() {
        return;
    }
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.holds()) {
        outcome.leave_open(OpenReason::NotGiven(format!(
            "the table of the hydrograph ends while {last:.1} m³/s still flow, {:.0} % of its largest discharge, so that the rest of the event is not known (add rows until the flow ends, or until half of the largest discharge and give flow.event_volume)",
            100.0 * last / largest
        )));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::check_all;
    use crate::checks::outcome::CheckVerdict;
    use crate::demand::Demands;
    use crate::design::hydrograph::{Hydrograph, HydrographPoint};
    use crate::design::read::read_design;
    use crate::guideline::guideline;

    /// A table that ends with a twentieth of the largest discharge has ended, one with a tenth has not, unless the event is said to be larger.
    #[test]
    fn a_table_that_is_cut_at_its_peak_is_open() {
        let verdict = |last: f64, event: f64| {
            let mut design = read_design("x", include_bytes!("../../../designs/gravity_wall.yaml")).unwrap().design;
            let row = |time: f64, depth: f64| HydrographPoint { time, depth, velocity: 2.0 };
            let rows = vec![row(0.0, 0.1), row(3.0, 0.6), row(9.0, 0.6 * last)];
            design.flow.hydrograph = Some(Hydrograph::new(rows, &design.channel.section()));
            design.flow.event_volume = event * design.flow.volume();
            let guideline = guideline(&design);
            let mut outcomes = check_all(&design, &Demands::by_equations(&guideline, &design.factors));
            let outcome = outcomes.iter_mut().find(|outcome| outcome.id == "wall_sliding").expect("a check");
            (outcome.verdict, outcome.open) = (CheckVerdict::Pass, None);
            leave_open(CheckContext { design: &design, guideline: &guideline, seen: None }, &mut outcomes);
            outcomes.iter().find(|outcome| outcome.id == "wall_sliding").expect("it").verdict
        };
        assert_eq!([0.0, 0.05].map(|last| verdict(last, 1.0)), [CheckVerdict::Pass; 2]);
        assert_eq!([0.1, 1.0].map(|last| verdict(last, 1.0)), [CheckVerdict::Open; 2]);
        assert_eq!(
            [0.5, 0.6, 1.0].map(|last| verdict(last, 3.0)),
            [CheckVerdict::Pass, CheckVerdict::Open, CheckVerdict::Open]
        );
    }
}
