//! E5: a rectangle told as the points of a section.

use crate::design::Design;
use crate::quantities::observed::Observed;
use crate::quantities::{bed, earth_pressure, height, mass, total_force};
use crate::section::Survey;
use crate::simulated::Simulated;
use crate::starts::Spread;
use crate::validation::barrier::full_scale::run_changed;
use crate::validation::case::{Broken, Case, Cost, Finding, Suite, Tier};

pub const RECTANGLE: Case = Case {
    id: "E5",
    suite: Suite::Net,
    title: "A rectangular channel given as the points of a section shows what the channel given by its width shows",
    source: "the same design with `width`, within the scatter of its packings",
    tier: Tier::ClosedForm,
    weakness: "one small net; side walls lean by 1e-4",
    cost: Cost::Long,
    run: rectangle,
};

const DESIGN: &str = include_str!("../../../designs/small_net.yaml");
/// Packings on either side.
const STARTS: u32 = 8;
/// Standard deviations of the difference of two means within which they are the same.
const SAME: f64 = 3.0;

/// A quantity of a run.
type Measured = fn(&Observed) -> f64;

fn rectangle() -> Result<Vec<Finding>, Broken> {
    let given_by_width = run_changed(DESIGN, STARTS, |_| ())?;
    let as_points = |design: &mut Design| {
        let channel = &mut design.channel;
        channel.survey = Some(Survey::between_walls(channel.width, channel.wall_height));
    };
    let given_by_points = run_changed(DESIGN, STARTS, as_points)?;
    let measured: [(&str, Measured); 7] = [
        ("largest force (kN)", |seen| seen.one(&total_force::PEAK) * 1e-3),
        ("force at rest (kN)", |seen| seen.one(&total_force::RESIDUAL) * 1e-3),
        ("worst bolt (kN)", |seen| seen.one(&bed::BOLT) * 1e-3),
        ("share retained", |seen| seen.one(&mass::RETAINED)),
        ("height left", |seen| seen.one(&height::RESIDUAL)),
        ("K at rest", |seen| seen.known(&earth_pressure::AT_REST).unwrap_or(f64::NAN)),
        ("λ", |seen| seen.known(&earth_pressure::DYNAMIC).unwrap_or(f64::NAN)),
    ];
    let finding = |(name, of): (&str, Measured)| {
        let spread =
            |run: &Simulated| Spread::of(&run.starts.iter().map(|start| of(&start.observed)).collect::<Vec<_>>());
        let [width, points] = [spread(&given_by_width), spread(&given_by_points)];
        let error = |spread: &Spread| spread.deviation * spread.deviation / spread.starts as f64;
        let tolerance = SAME * (error(&width) + error(&points)).sqrt();
        Finding::close(format!("{name}, mean of {STARTS} packings"), points.mean, width.mean, tolerance)
    };
    Ok(measured.into_iter().map(finding).collect())
}
