//! A boulder or a log: a point load at the height that the designer gives, or at the surface of the flow that brings it. It comes with every
//! surge of the envelope; the report shows it with the last.

use crate::loads::cases::later_surge;
use crate::loads::cases::load_case::{Certainty, Hit, LoadCase};
use crate::loads::input::GuidelineInput;

pub fn case(input: &GuidelineInput, hit: Hit) -> LoadCase {
    let last = later_surge::last(input);
    LoadCase {
        id: "point_load",
        title: "Last surge with a boulder or log",
        point: Some(hit.over(last.deposit, input.barrier_height)),
        not_simulated: Some("the point load"),
        certainty: Certainty::Given,
        source: "point load: design file",
        ..last
    }
}
