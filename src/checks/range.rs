//! Formulas used outside the range they are known for: a check that such a formula governs stays open, unless the design asks for a
//! warning alone (`limits.outside_range`).
//!
//! A check fails all the same: outside its range a formula may say too little, and what fails by it is not saved by that.

use crate::checks::detailing::{Bearing, rules};
use crate::checks::outcome::{CheckVerdict, Opening, Outcome};
use crate::demand::from_loads::Guideline;
use crate::design::{BarrierDesign, Design, OutsideRange};

/// Sag over span, and strain, up to which a main rope's parabola with small strains is known to hold.
pub const LARGEST_SAG: f64 = 0.3;
pub const LARGEST_STRAIN: f64 = 0.1;

/// Leaves open what would hold by a formula that is used outside its range.
pub fn leave_open_outside_range(design: &Design, guideline: &Guideline, outcomes: &mut [Outcome]) {
    if design.limits.outside_range == OutsideRange::Warn {
        return;
    }
    let broken =
        rules(design, guideline).into_iter().filter(|rule| rule.bearing == Bearing::Pressures && !rule.holds());
    let of_pressures: Option<String> =
        broken.map(|rule| rule.title.to_lowercase()).reduce(|all, more| format!("{all}, {more}"));
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.resistance.is_some()) {
        let holds = matches!(outcome.verdict, CheckVerdict::Pass | CheckVerdict::Warn);
        if !holds || outcome.utilisation.is_none() || !outcome.governed_by_equations() {
            continue;
        }
        let of_rope = outcome.rope.and_then(|rope| rope_outside(design, guideline, rope));
        let pressures = of_pressures.as_ref().filter(|_| outcome.rests_on_pressures);
        let why = of_rope.or_else(|| {
            pressures.map(|titles| format!("its pressures are used outside the range they are known for ({titles})"))
        });
        if let Some(why) = why {
            outcome.leave_open(Opening::OutOfRange(format!(
                "the equations govern it and {why} (limits.outside_range: warn would let it stand)"
            )));
        }
    }
}

/// Why the parabola of a main rope is no longer known to hold, if so.
pub fn rope_outside(design: &Design, guideline: &Guideline, rope: usize) -> Option<String> {
    let BarrierDesign::FlexibleNet(net) = &design.barrier else { return None };
    let state = &guideline.ropes.get(rope)?.state;
    let line = net.main_ropes.rope;
    let axial = line.modulus * std::f64::consts::FRAC_PI_4 * line.diameter.powi(2);
    let (sag, strain) = (state.sag / design.channel.width, state.tension / axial);
    let within = sag <= LARGEST_SAG && strain <= LARGEST_STRAIN;
    (!within).then(|| {
        format!(
            "main rope {} sags {:.0} % of its span and stretches {:.0} %, beyond the {:.0} % and {:.0} % up to which a parabola with small strains holds",
            rope + 1,
            100.0 * sag,
            100.0 * strain,
            100.0 * LARGEST_SAG,
            100.0 * LARGEST_STRAIN
        )
    })
}
