//! Mean and scatter over the packings, of the quantities that tell them.

use crate::quantities::QUANTITIES;
use crate::quantities::quantity::{Of, Quantity, Told};
use crate::quantities::{quantity::Unit, wall};
use crate::simulated::Simulated;
use crate::starts::Spread;

/// A quantity that is compared over packings.
pub struct Observable {
    pub id: String,
    pub title: String,
    pub unit: Unit,
}

/// Main quantities with their mean and scatter; those of ropes rope by rope.
pub fn over_packings(run: &Simulated) -> Vec<(Observable, Spread)> {
    let told: Vec<&Quantity> = QUANTITIES.iter().copied().filter(|quantity| quantity.told != Told::Never).collect();
    let of_ropes = |one: &&Quantity, other: &&Quantity| one.of == Of::EachRope && other.of == Of::EachRope;
    let mut list = Vec::new();
    for alike in told.chunk_by(of_ropes) {
        let most = alike.iter().map(|quantity| run.first().each(quantity).len()).max().unwrap_or(0);
        for index in 0..most {
            list.extend(alike.iter().filter_map(|quantity| spread(run, quantity, index)));
        }
    }
    list
}

fn spread(run: &Simulated, quantity: &Quantity, index: usize) -> Option<(Observable, Spread)> {
    let first = *run.first().each(quantity).get(index)?;
    let values: Vec<f64> =
        run.starts.iter().filter_map(|start| start.observed.each(quantity).get(index).copied()).collect();
    let tells = match quantity.told {
        Told::Never => false,
        Told::Always => true,
        Told::WhereLoaded => first > 0.0,
        Told::OfWalls => !run.first().each(&wall::SEGMENT).is_empty(),
        Told::WhereKnown => values.len() == run.starts.len(),
    };
    let id = match quantity.of {
        Of::Run | Of::RunIfKnown => quantity.id.to_string(),
        Of::EachRope | Of::EachSegment | Of::EachPost | Of::EachAnchor => format!("{}_{}", quantity.id, index + 1),
    };
    let observable = || Observable { id, title: quantity.title_of(index), unit: quantity.unit };
    tells.then(|| (observable(), Spread::of(&values)))
}
