//! A boulder or a log: a point load that the designer gives, at the height given. It comes with every surge of the envelope; the
//! report shows it with the last.

use crate::loads::cases::later_surge;
use crate::loads::cases::load_case::{Certainty, LoadCase, PointLoad};
use crate::loads::input::GuidelineInput;

pub fn case(input: &GuidelineInput, point: PointLoad) -> LoadCase {
    LoadCase {
        id: "point_load",
        title: "Last surge with a boulder or log",
        point: Some(point),
        not_simulated: Some("the point load"),
        certainty: Certainty::Given,
        source: "point load: design file",
        ..later_surge::last(input)
    }
}
