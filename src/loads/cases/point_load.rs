//! A boulder or a log: a point load at the height that the designer gives, or at the surface of the flow that brings it. It comes with every
//! surge of the envelope; the report shows it with the last.

use crate::loads::cases::later_surge;
use crate::loads::cases::load_case::{Certainty, Hit, LoadCase};
use crate::loads::input::GuidelineInput;
use crate::text::Text;

pub(crate) const TEXTS: &[Text] = &[Text {
    id: "point_load",
    meaning: "A boulder or log hits at one place together with the last surge: the force of loads.point_load, or on a wall the reduced Hertz force of the largest boulder of the flow. It is carried by the rope or the metres of wall that are hit, and by the block that stands on its base.",
    formula: "of boulders F = loads.impact_reduction · F_Hertz(r, m, v)",
    source: "Hertz contact; the reduction is a value of the design file",
}];

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
