//! Nearest point of a segment to a point.

use crate::Vec3;

/// Where on a segment the nearest point lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnSegment {
    pub point: Vec3,
    /// 0 at the first end, 1 at the second.
    pub share: f64,
    /// Whether the nearest point is strictly between the ends.
    pub inside: bool,
}

/// Nearest point to `point` on the segment from `a` to `b`; a segment without length is its first end.
pub fn nearest_on_segment(point: &Vec3, a: &Vec3, b: &Vec3) -> OnSegment {
    let along = b - a;
    let length_squared = along.norm_squared();
    let raw = if length_squared > 0.0 { (point - a).dot(&along) / length_squared } else { 0.0 };
    let share = raw.clamp(0.0, 1.0);
    OnSegment { point: a + along * share, share, inside: raw > 0.0 && raw < 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clamps_to_the_ends() {
        let (a, b) = (Vec3::zeros(), Vec3::new(2.0, 0.0, 0.0));
        assert_eq!(nearest_on_segment(&Vec3::new(0.5, 1.0, 0.0), &a, &b).share, 0.25);
        assert!(!nearest_on_segment(&Vec3::new(-1.0, 1.0, 0.0), &a, &b).inside);
        assert_eq!(nearest_on_segment(&Vec3::new(9.0, 1.0, 0.0), &a, &b).point, b);
        assert_eq!(nearest_on_segment(&Vec3::new(9.0, 1.0, 0.0), &a, &a).point, a);
    }
}
