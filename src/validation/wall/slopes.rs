//! C9: a flume at steeper and steeper slopes.

use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};
use crate::validation::scenes::side_by_side;
use crate::validation::wall::laboratory::{Variant, run_variant};

pub const CASE: Case = Case {
    id: "C9",
    suite: Suite::Wall,
    title: "The largest force rises with the slope",
    source: "Moriguchi et al. 2009 (sand flume, 45 to 65°), the trend only",
    tier: Tier::SecondHand,
    weakness: "the published set-up is not at hand: the laboratory flume stands in for it",
    cost: Cost::Long,
    run,
};

fn run() -> Result<Vec<Finding>, Broken> {
    let slopes = [45.0_f64, 50.0, 55.0, 60.0, 65.0];
    let runs = side_by_side(slopes.len(), |index| {
        let slope = slopes[index].to_radians();
        run_variant(&Variant { slope, coarser: 1.3, ..Variant::calibration(1) })
    });
    let mut findings = Vec::new();
    let mut before = 0.0;
    for (slope, run) in slopes.into_iter().zip(runs) {
        let run = run?;
        findings.push(Finding::between(
            format!("{slope}°: largest force (N/m), above the one before"),
            run.peak(),
            before,
            1e5,
        ));
        before = run.peak();
    }
    Ok(findings)
}
