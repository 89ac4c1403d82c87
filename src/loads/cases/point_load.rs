//! A boulder or a log: a point load that the designer gives, added to the first surge.

use crate::loads::cases::{Certainty, LoadCase, PointLoad, first_surge};
use crate::loads::input::GuidelineInput;

pub fn case(input: &GuidelineInput, point: PointLoad) -> LoadCase {
    LoadCase {
        id: "point_load",
        title: "First surge with a boulder or log",
        point: Some(point),
        certainty: Certainty::Given,
        source: "point load: design file",
        ..first_surge::case(input)
    }
}
