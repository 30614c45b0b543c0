//! Numbering along Hilbert's curve: points that are near in space get numbers that are near.

/// Bits per axis of the grid through which the curve runs; three axes fill 63 bits of a key.
const BITS: u32 = 21;

/// The points' indices in the order in which Hilbert's curve through their bounding cube meets them; points that
/// fall into one cell of the grid of 2^21 cells per edge come by index. NaN counts as the cube's low side.
pub fn space_filling_order(points: &[[f64; 3]]) -> Vec<u32> {
    let mut low = [f64::INFINITY; 3];
    let mut high = [f64::NEG_INFINITY; 3];
    for point in points {
        for axis in 0..3 {
            low[axis] = low[axis].min(point[axis]);
            high[axis] = high[axis].max(point[axis]);
        }
    }
    let edge = (0..3).map(|axis| high[axis] - low[axis]).fold(0.0, f64::max);
    let cells = f64::from(1u32 << BITS);
    // A float becomes the nearest integer of the target's range, and NaN (of a cube without extent) zero.
    let cell = |x: f64, low: f64| (((x - low) / edge * cells) as u32).min((1 << BITS) - 1);
    let mut keys: Vec<(u64, u32)> = points
        .iter()
        .zip(0..)
        .map(|(point, index)| (hilbert_index([0, 1, 2].map(|axis| cell(point[axis], low[axis]))), index))
        .collect();
    keys.sort_unstable();
    keys.into_iter().map(|(_, index)| index).collect()
}

/// Place of a grid cell on the curve, by J. Skilling, "Programming the Hilbert curve", AIP Conf. Proc. 707 (2004)
/// 381: undo the rotations from the coarsest level down, Gray-decode, interleave the bits.
fn hilbert_index(mut cell: [u32; 3]) -> u64 {
    for level in (1..BITS).rev() {
        let bit = 1 << level;
        let below = bit - 1;
        for axis in 0..3 {
            if cell[axis] & bit != 0 {
                cell[0] ^= below;
            } else {
                let exchange = (cell[0] ^ cell[axis]) & below;
                cell[0] ^= exchange;
                cell[axis] ^= exchange;
            }
        }
    }
    cell[1] ^= cell[0];
    cell[2] ^= cell[1];
    let flip = (1..BITS).filter(|level| cell[2] & 1 << level != 0).fold(0, |flip, level| flip ^ ((1 << level) - 1));
    cell.iter().fold(0, |key, axis| key << 1 | spread(axis ^ flip))
}

/// Bit `i` of the low 21 moved to bit `3 i`.
fn spread(x: u32) -> u64 {
    let mut x = u64::from(x) & 0x1f_ffff;
    x = (x | x << 32) & 0x001f_0000_0000_ffff;
    x = (x | x << 16) & 0x001f_0000_ff00_00ff;
    x = (x | x << 8) & 0x100f_00f0_0f00_f00f;
    x = (x | x << 4) & 0x10c3_0c30_c30c_30c3;
    (x | x << 2) & 0x1249_2492_4924_9249
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All cells of a cube of `n`³, corner points half a cell inside.
    fn grid(n: usize) -> Vec<[f64; 3]> {
        let at = |i: usize| i as f64;
        (0..n * n * n).map(|i| [at(i % n), at(i / n % n), at(i / n / n)]).collect()
    }

    #[test]
    fn neighbours_on_the_curve_are_neighbours_in_space() {
        let points = grid(16);
        let order = space_filling_order(&points);
        for pair in order.windows(2) {
            let (a, b) = (points[pair[0] as usize], points[pair[1] as usize]);
            let steps: f64 = (0..3).map(|axis| (a[axis] - b[axis]).abs()).sum();
            assert_eq!(steps, 1.0, "{a:?} {b:?}");
        }
    }

    #[test]
    fn every_point_comes_once_and_equal_points_by_index() {
        let mut order = space_filling_order(&grid(5));
        order.sort_unstable();
        assert!(order.into_iter().eq(0..125));
        assert_eq!(space_filling_order(&[[3.0; 3]; 4]), [0, 1, 2, 3]);
        assert_eq!(space_filling_order(&[]), [0u32; 0]);
        assert_eq!(space_filling_order(&[[1e308, 0.0, 0.0], [-1e308, 0.0, 0.0]]).len(), 2);
    }
}
