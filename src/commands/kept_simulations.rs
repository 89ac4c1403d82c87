//! Simulations that studies keep, each by what it hangs on.

use crate::commands::kept::KeptResults;
use crate::commands::signals::stop;
use crate::design::Design;
use crate::fidelity::choose;
use crate::pipeline::simulate_cases;
use crate::scene::event::RunControl;
use crate::simulated::{Detail, RunError, Simulated};
use crate::studies::sizing::mechanics;
use crate::terminal;

/// What simulations of a design with so many packings show, kept or made. What only its checks ask of it makes no difference.
pub fn simulated(kept: &KeptResults, design: &Design, starts: u32) -> Result<Simulated, RunError> {
    let bare = mechanics(design);
    let of = format!("{bare:?} {:?} {starts}", choose(&bare));
    if let Some(kept) = kept.get::<Simulated>(&[of.as_bytes()]) {
        return Ok(Simulated { fidelity: choose(design), ..kept });
    }
    let watch = RunControl { progress: &|_| (), stop: stop(), store: None };
    let simulated = simulate_cases(design, starts, Detail::Observed, &watch)?;
    // What cannot be kept is made again.
    if let Err(error) = kept.put(&[of.as_bytes()], &simulated) {
        terminal::warn(format_args!("note: a result could not be kept: {error}"));
    }
    Ok(simulated)
}
