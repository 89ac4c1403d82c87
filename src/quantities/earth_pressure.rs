//! K and λ back-calculated from the simulation. Those that are reported are left out where the deposit or the flow is thinner than two
//! grains, because no depth can be measured there.

use crate::loads::pressure::Diagram;
use crate::quantities::coefficients::{Coefficients, STANDING};
use crate::quantities::quantity::Unit::Number;
use crate::quantities::quantity::{Of, Quantity, Told};
use crate::quantities::reading::Reading;
use crate::section::Section;
use dem::recorders::histories::tail_mean;

/// K that the force along the bed at rest means for the depth of the deposit.
pub const AT_REST: Quantity =
    Quantity::new("k_effective", "K at rest", Number, Of::RunIfKnown, |run| k_at_rest(run).into_iter().collect())
        .json("k_effective")
        .meaning("K that the residual force means for the depth of the deposit.")
        .told(Told::WhereKnown);

/// K at rest of a deposit of any depth. Where the deposit is thin the value is rough: it is not reported, and only keeps the equations
/// from being relied on with too small a K.
pub const OF_ANY_DEPTH: Quantity =
    Quantity::new("k_of_any_depth", "K at rest of a deposit of any depth", Number, Of::RunIfKnown, |run| {
        k_of_deposit(run, 0.0).into_iter().collect()
    });

/// λ that the largest force along the bed means for the incoming flow, with the design's K for the static part.
pub const DYNAMIC: Quantity =
    Quantity::new("lambda_effective", "λ from the largest force", Number, Of::RunIfKnown, |run| {
        lambda(run).into_iter().collect()
    })
    .json("lambda_effective")
    .meaning("lambda that the peak force means for the incoming flow.")
    .told(Told::WhereKnown);

/// The same by the split into grains at rest and moving ones.
pub const K_SPLIT: Quantity = Quantity::new(
    "k_split",
    "K back-calculated from the grains at rest, at their peak force F₁",
    Number,
    Of::RunIfKnown,
    |run| {
        let told = &run.coefficients;
        Coefficients::at_peak_of(&told.earth_pressure, &told.force_dead).into_iter().collect()
    },
)
.told(Told::WhereKnown);
pub const LAMBDA_UPSTREAM: Quantity = Quantity::new(
    "lambda_split_upstream",
    "λ back-calculated from the moving grains, with the approach velocity",
    Number,
    Of::RunIfKnown,
    |run| {
        let told = &run.coefficients;
        Coefficients::at_peak_of(&told.dynamic_upstream, &told.force_moving).into_iter().collect()
    },
)
.told(Told::WhereKnown);
pub const LAMBDA_MEAN: Quantity = Quantity::new(
    "lambda_split_mean",
    "λ back-calculated from the moving grains, with the mean velocity of all grains",
    Number,
    Of::RunIfKnown,
    |run| {
        let told = &run.coefficients;
        Coefficients::at_peak_of(&told.dynamic_mean, &told.force_moving).into_iter().collect()
    },
)
.told(Told::WhereKnown);

/// Weight of the flow over a unit of depth, normal to the bed (N/m³).
fn unit_weight(run: &Reading) -> f64 {
    run.guideline.input.density * run.guideline.input.gravity_normal
}

fn k_at_rest(run: &Reading) -> Option<f64> {
    k_of_deposit(run, run.thin())
}

/// Nothing where the deposit is no deeper than this (m).
fn k_of_deposit(run: &Reading, thin: f64) -> Option<f64> {
    let depth = run.histories.barrier_depth.last().copied().unwrap_or(0.0);
    let deep = depth > thin;
    deep.then(|| {
        let along: Vec<f64> = run.histories.force.iter().map(|force| force.x).collect();
        let at_rest = tail_mean(&along, run.samples.tail);
        // What stands above the barrier's top presses on what is below it.
        let top = depth.min(run.guideline.input.barrier_height);
        match &run.guideline.section {
            Section::Rectangle { width } => 2.0 * at_rest / width / (unit_weight(run) * top * (2.0 * depth - top)),
            section @ Section::Surveyed(_) => {
                let fluid = Diagram { unit: unit_weight(run), surface: depth, top, ..Diagram::default() };
                at_rest / fluid.force_over(section, 0.0, top)
            }
        }
    })
}

fn lambda(run: &Reading) -> Option<f64> {
    let flows = run.incoming.depth > 0.5 * run.thin() && run.incoming.at_rest <= STANDING && run.largest_flux > 0.0;
    flows.then(|| {
        let standing = run.histories.barrier_depth.get(run.at_push).copied().unwrap_or(0.0);
        let unit = run.guideline.input.earth_pressure * unit_weight(run);
        match &run.guideline.section {
            Section::Rectangle { width } => {
                let fixed = 0.5 * unit * standing.powi(2);
                (run.push / width - fixed) / (run.guideline.input.density * run.largest_flux)
            }
            section @ Section::Surveyed(_) => {
                // The flux is told on the width of the channel, which is its mean width up to the barrier's top.
                let width = run.guideline.width;
                let fixed = unit * section.moment(standing);
                (run.push - fixed) / (run.guideline.input.density * run.largest_flux * width)
            }
        }
    })
}
