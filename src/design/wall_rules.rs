//! Contradictions between values of a rigid wall; listed in [`super::rules`].

use crate::design::channel_entries::{height_of_barrier, section};
use crate::design::entries::Entries;
use crate::design::show::length;
use crate::problem::Problem;
use crate::section::Section;
use crate::units::Dimension;

pub fn wall_segments_fill_the_wall(e: &Entries) -> Option<Problem> {
    let path = "barrier.rigid_wall.segments";
    let (parts, height) = (e.numbers(path)?, e.number("barrier.rigid_wall.height")?);
    let sum: f64 = parts.iter().sum();
    ((sum - height).abs() > 1e-6 * height).then(|| {
        Problem::new(
            path,
            format!("parts that add up to {}", length(sum)),
            format!("parts that add up to the height {}", length(height)),
        )
    })
}

const STABILITY: &str = "barrier.rigid_wall.stability";

pub fn wall_base_carries_the_wall(e: &Entries) -> Option<Problem> {
    let path = format!("{STABILITY}.base_width");
    let (base, thickness) = (e.number(&path)?, e.number(&format!("{STABILITY}.thickness"))?);
    (base < thickness).then(|| {
        Problem::new(
            path,
            format!("a base of {}", length(base)),
            format!("at least the thickness, {}", length(thickness)),
        )
        .hint("the base reaches from the wall's upstream face downstream")
    })
}

pub fn wall_base_no_steeper_than_the_bed(e: &Entries) -> Option<Problem> {
    let path = format!("{STABILITY}.base_slope");
    let (base, bed) = (e.number(&path)?, e.number("channel.slope")?);
    (base > bed).then(|| {
        let show = |angle| Dimension::Angle.show(angle);
        Problem::new(
            path,
            format!("a base of {}", show(base)),
            format!("no more than the slope of the bed, {}", show(bed)),
        )
        .hint("on a steeper base the load would lift the wall, which is not checked")
    })
}

/// Two blocks at the least have half a wall between them. In a section a block beside the lowest point is lower than the wall is there, which no
/// check knows, so that the wall has to be one.
pub fn wall_block_is_one_of_the_wall(e: &Entries) -> Option<Problem> {
    let path = format!("{STABILITY}.block_length");
    let block = e.number(&path)?;
    let allowed = match section(e)? {
        Section::Rectangle { width } => (block < width && block > 0.5 * width).then(|| {
            format!("{} or more for a wall without joints, or at most {} with them", length(width), length(0.5 * width))
        }),
        section => {
            let top = section.width(height_of_barrier(e)?);
            (block < top)
                .then(|| format!("{} or more, a wall without joints, where the section is no rectangle", length(top)))
        }
    };
    allowed.map(|allowed| {
        Problem::new(path, format!("a shortest block of {}", length(block)), allowed)
            .hint("leave it out where that is not so: what the wall's base bears of a point load then stays open")
    })
}

/// Angle by which a given face may be off the normal of the base (rad): the balance of the wall takes it as upright on its base.
const OFF_UPRIGHT: f64 = 0.1;

pub fn wall_face_stands_on_its_base(e: &Entries) -> Option<Problem> {
    let path = "barrier.rigid_wall.tilt";
    let (tilt, base) = (e.number(path)?, e.number(&format!("{STABILITY}.base_slope"))?);
    // Positive leans upstream; a base that falls downstream leans the wall downstream.
    ((tilt + base).abs() > OFF_UPRIGHT).then(|| {
        let show = |angle| Dimension::Angle.show(angle);
        let found = format!("a face {} from vertical on a base of {}", show(tilt), show(base));
        Problem::new(
            path,
            found,
            format!("a face upright on its base: {} to {}", show(-base - OFF_UPRIGHT), show(-base + OFF_UPRIGHT)),
        )
        .hint("sliding and overturning are worked out for a wall of even thickness that stands upright on its base")
    })
}
