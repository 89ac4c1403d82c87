//! Space-filling order of the grains, so that neighbours in space are neighbours in memory.

use crate::Vec3;

/// Position of a point along a Morton (Z-order) curve through cells of the given edge length (m).
pub fn morton_code(point: &Vec3, low: &Vec3, cell: f64) -> u64 {
    let spread = |value: f64| -> u64 {
        // 21 bits per axis, two zero bits between each.
        let mut x = (value.max(0.0) as u64) & 0x1f_ffff;
        x = (x | (x << 32)) & 0x1f_0000_0000_ffff;
        x = (x | (x << 16)) & 0x1f_0000_ff00_00ff;
        x = (x | (x << 8)) & 0x100f_00f0_0f00_f00f;
        x = (x | (x << 4)) & 0x10c3_0c30_c30c_30c3;
        (x | (x << 2)) & 0x1249_2492_4924_9249
    };
    let place = (point - low) / cell;
    spread(place.x) | (spread(place.y) << 1) | (spread(place.z) << 2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn interleaves_the_bits() {
        let code = |x, y, z| morton_code(&Vec3::new(x, y, z), &Vec3::zeros(), 1.0);
        assert_eq!(code(1.0, 0.0, 0.0), 1);
        assert_eq!(code(0.0, 1.0, 0.0), 2);
        assert_eq!(code(0.0, 0.0, 1.0), 4);
        assert_eq!(code(3.0, 0.0, 0.0), 9);
        assert_eq!(code(2.0, 2.0, 2.0), 56);
    }
}
