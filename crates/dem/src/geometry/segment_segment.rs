//! Nearest points of two segments.

use crate::Vec3;

/// Where two segments come nearest to each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BetweenSegments {
    /// On the first and on the second.
    pub points: [Vec3; 2],
    /// 0 at a segment's first end, 1 at its second.
    pub shares: [f64; 2],
    /// Whether the nearest point is strictly between the ends of each.
    pub inside: [bool; 2],
}

/// Sine of the angle, squared, below which segments count as parallel: the middle of what they share is taken then.
const PARALLEL: f64 = 1e-12;

/// Nearest points of the segments from `a[0]` to `a[1]` and from `b[0]` to `b[1]`.
///
/// With a, b the two lines, D₀ the way between their first ends and Δ = |a|²|b|² − (a·b)², the nearest points of the unbounded lines lie
/// at m = [(a·b)(b·D₀) − |b|²(a·D₀)]/Δ and n = [|a|²(b·D₀) − (a·b)(a·D₀)]/Δ with D₀ = a₀ − b₀ (Albaba 2015, Eqs 4.13 to 4.15, with
/// the squares that are missing there). Clamped to one segment, the other's point follows, and once more.
pub fn nearest_of_segments(a: [&Vec3; 2], b: [&Vec3; 2]) -> BetweenSegments {
    let (along_a, along_b, between) = (a[1] - a[0], b[1] - b[0], a[0] - b[0]);
    let (aa, bb, ab) = (along_a.norm_squared(), along_b.norm_squared(), along_a.dot(&along_b));
    let (ad, bd) = (along_a.dot(&between), along_b.dot(&between));
    let determinant = aa * bb - ab * ab;
    // Share on one segment of the point nearest to a point of the other; the first end of a segment without length.
    let on_a = |n: f64| if aa > 0.0 { (n * ab - ad) / aa } else { 0.0 };
    let on_b = |m: f64| if bb > 0.0 { (m * ab + bd) / bb } else { 0.0 };
    let raw = if determinant > PARALLEL * aa * bb {
        (ab * bd - bb * ad) / determinant
    } else {
        // The middle of the stretch of `a` that lies beside `b`.
        let (first, last) = (on_a(0.0), on_a(1.0));
        0.5 * (first.min(last).clamp(0.0, 1.0) + first.max(last).clamp(0.0, 1.0))
    };
    let raw_n = on_b(raw.clamp(0.0, 1.0));
    let n = raw_n.clamp(0.0, 1.0);
    let raw_m = on_a(n);
    let m = raw_m.clamp(0.0, 1.0);
    let strictly = |share: f64| share > 0.0 && share < 1.0;
    // Between parallel segments any point beside the other is as near; what was chosen above stays.
    let (m, raw_m) = if determinant > PARALLEL * aa * bb { (m, raw_m) } else { (raw.clamp(0.0, 1.0), raw) };
    BetweenSegments {
        points: [a[0] + along_a * m, b[0] + along_b * n],
        shares: [m, n],
        inside: [strictly(raw_m), strictly(raw_n)],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn distance(found: &BetweenSegments) -> f64 {
        (found.points[0] - found.points[1]).norm()
    }

    /// Case D23.
    #[test]
    fn finds_the_tabulated_points() {
        let a = [Vec3::zeros(), Vec3::new(2.0, 0.0, 0.0)];
        let b = [Vec3::new(0.5, -1.0, 0.3), Vec3::new(0.5, 2.0, 0.3)];
        let found = nearest_of_segments([&a[0], &a[1]], [&b[0], &b[1]]);
        assert_relative_eq!(found.shares[0], 0.25, epsilon = 1e-12);
        assert_relative_eq!(found.shares[1], 1.0 / 3.0, epsilon = 1e-12);
        assert_relative_eq!(distance(&found), 0.3, epsilon = 1e-12);
    }

    /// No pair of points on the two segments is nearer, for crossing, clamped, parallel and pointlike segments.
    #[test]
    fn nothing_is_nearer() {
        let mut random = fastrand::Rng::with_seed(9);
        for round in 0..400 {
            let mut point = || Vec3::from_fn(|_, _| random.f64() - 0.5);
            let (a0, line, b0) = (point(), point(), point());
            let b1 = match round % 4 {
                0 | 1 => point(),
                2 => b0 + line * (0.2 + 0.005 * f64::from(round)),
                _ => b0,
            };
            let a1 = a0 + line;
            let found = nearest_of_segments([&a0, &a1], [&b0, &b1]);
            let mut least = f64::INFINITY;
            for i in 0..=60 {
                let on_a = a0 + (a1 - a0) * (f64::from(i) / 60.0);
                let nearest = crate::geometry::point_segment::nearest_on_segment(&on_a, &b0, &b1).point;
                least = least.min((on_a - nearest).norm());
            }
            assert!(distance(&found) <= least + 1e-12, "round {round}: {} against {least}", distance(&found));
            assert!(found.shares.iter().all(|share| (0.0..=1.0).contains(share)));
        }
    }
}
