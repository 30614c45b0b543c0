//! Recursive coordinate bisection (Berger and Bokhari 1987): cut the points across the axis along which they are spread
//! most so that both halves weigh what their ranks should bear, then cut the halves.

use super::spread::{Frame, Moments};
use std::cmp::Ordering;

/// The weight that a point of greatest weight gets. Integer weights have exact sums, so that the cuts do not
/// depend on the order of the points.
const HEAVIEST: f64 = (1u32 << 31) as f64;

struct Point {
    at: [f64; 3],
    weight: u32,
    index: u32,
}

/// The part, 0 ≤ part < `parts`, of each point, with weights shared out as evenly as cuts between points allow.
///
/// Points of equal weight are shared out to within one point; no part stays empty while there are points enough.
/// Points of equal coordinate fall to the lower part by index, and nothing else depends on the points' order.
/// `weights` has one number per point; those that are not positive count as zero, and all as equal when none is.
/// The cost is O(n log `parts`).
pub fn rcb(centroids: &[[f64; 3]], weights: &[f64], parts: usize) -> Vec<u32> {
    let mut points = weigh(centroids, weights);
    let mut part_of = vec![0; centroids.len()];
    bisect(&mut points, 0, parts, &mut part_of);
    part_of
}

fn weigh(centroids: &[[f64; 3]], weights: &[f64]) -> Vec<Point> {
    let heaviest = weights.iter().copied().fold(0.0, f64::max);
    let scaled = |weight: f64| if heaviest > 0.0 { (weight / heaviest * HEAVIEST).round() as u32 } else { 1 };
    (centroids.iter().zip(weights).zip(0..))
        .map(|((at, weight), index)| Point { at: *at, weight: scaled(*weight), index })
        .collect()
}

fn bisect(points: &mut [Point], first: u32, parts: usize, part_of: &mut [u32]) {
    if parts <= 1 || points.is_empty() {
        points.iter().for_each(|point| part_of[point.index as usize] = first);
        return;
    }
    let (left_parts, right_parts) = (parts / 2, parts - parts / 2);
    let axis = widest_axis(points);
    let order = |a: &Point, b: &Point| a.at[axis].total_cmp(&b.at[axis]).then(a.index.cmp(&b.index));
    let cut = weighted_cut(points, left_parts, parts, order);
    // At least one point for each part while there are enough, at most one for each while there are not.
    let (a, b) = (left_parts, points.len().saturating_sub(right_parts));
    let allowed = cut.clamp(a.min(b), a.max(b)).min(points.len());
    if allowed != cut && allowed < points.len() {
        points.select_nth_unstable_by(allowed, order);
    }
    let (left, right) = points.split_at_mut(allowed);
    bisect(left, first, left_parts, part_of);
    bisect(right, first + left_parts as u32, right_parts, part_of);
}

/// The axis along which the points are spread most.
fn widest_axis(points: &[Point]) -> usize {
    let (mut low, mut high) = ([f64::MAX; 3], [f64::MIN; 3]);
    for point in points {
        low = [0, 1, 2].map(|axis| low[axis].min(point.at[axis]));
        high = [0, 1, 2].map(|axis| high[axis].max(point.at[axis]));
    }
    let (frame, mut moments) = (Frame::new(low, high), Moments::default());
    points.iter().for_each(|point| moments.add(&frame, point.at));
    moments.widest(points.len() as u64, &frame, None)
}

/// Orders `points` about a cut and returns it, the number of points before it, such that they weigh as nearly as
/// can be `part / parts` of all. A selection by halves: O(n).
fn weighted_cut(
    points: &mut [Point],
    part: usize,
    parts: usize,
    order: impl Fn(&Point, &Point) -> Ordering + Copy,
) -> usize {
    let weight = |points: &[Point]| points.iter().map(|point| u64::from(point.weight)).sum::<u64>();
    // In units of 1/parts, so that the target is whole.
    let target = i128::from(weight(points)) * part as i128;
    let (mut start, mut end, mut before) = (0, points.len(), 0);
    while end - start > 1 {
        let middle = (end - start) / 2;
        points[start..end].select_nth_unstable_by(middle, order);
        let with = before + i128::from(weight(&points[start..start + middle])) * parts as i128;
        if with <= target {
            before = with;
            start += middle;
        } else {
            end = start + middle;
        }
    }
    let with = before + i128::from(points[start].weight) * parts as i128;
    if with - target < target - before { start + 1 } else { start }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn sizes(part_of: &[u32], parts: usize) -> Vec<usize> {
        let mut sizes = vec![0; parts];
        part_of.iter().for_each(|part| sizes[*part as usize] += 1);
        sizes
    }

    fn points(count: std::ops::Range<usize>) -> impl Strategy<Value = Vec<[f64; 3]>> {
        let coordinate = || prop_oneof![(-4i32..4).prop_map(f64::from), -1e3..1e3];
        prop::collection::vec([coordinate(), coordinate(), coordinate()], count)
    }

    proptest! {
        #[test]
        fn equal_weights_balance_within_one(points in points(0..300), parts in 1usize..70, weight in 0.0..9.0) {
            let part_of = rcb(&points, &vec![weight; points.len()], parts);
            let sizes = sizes(&part_of, parts);
            let (least, most) = (points.len() / parts, points.len().div_ceil(parts));
            prop_assert!(sizes.iter().all(|size| (least..=most).contains(size)), "{:?}", sizes);
        }

        #[test]
        fn order_of_distinct_points_does_not_matter(
            weighted in prop::collection::vec(([-1e3..1e3, -1e3..1e3, -1e3..1e3], 0.0..5.0), 1..200),
            order in any::<u64>(),
            parts in 1usize..20,
        ) {
            let (points, weights): (Vec<[f64; 3]>, Vec<f64>) = weighted.into_iter().unzip();
            let mut shuffled: Vec<usize> = (0..points.len()).collect();
            shuffled.sort_by_key(|i| (*i as u64 + 1).wrapping_mul(order | 1));
            let pick = |i: &usize| (points[*i], weights[*i]);
            let (other_points, other_weights): (Vec<_>, Vec<_>) = shuffled.iter().map(pick).unzip();
            let (one, other) = (rcb(&points, &weights, parts), rcb(&other_points, &other_weights, parts));
            prop_assert!(shuffled.iter().zip(&other).all(|(i, part)| one[*i] == *part));
        }

        #[test]
        fn no_part_is_empty_whatever_the_weights(
            points in points(1..100),
            weights in prop::collection::vec(prop_oneof![Just(0.0), Just(1e9), Just(-1.0), Just(f64::NAN), 0.0..1.0], 100),
            parts in 1usize..50,
        ) {
            let sizes = sizes(&rcb(&points, &weights[..points.len()], parts), parts);
            let filled = sizes.iter().filter(|size| **size > 0).count();
            prop_assert_eq!(filled, parts.min(points.len()));
        }

        #[test]
        fn halves_differ_by_at_most_the_point_at_the_cut(
            points in points(2..200), weights in prop::collection::vec(0.5..2.0, 200),
        ) {
            let part_of = rcb(&points, &weights[..points.len()], 2);
            let weight = |part| -> f64 { part_of.iter().zip(&weights).filter(|(p, _)| **p == part).map(|(_, w)| w).sum() };
            prop_assert!((weight(0) - weight(1)).abs() <= 2.0 + 1e-6);
        }
    }

    #[test]
    fn a_long_box_is_cut_across() {
        let points: Vec<[f64; 3]> =
            (0..400).map(|i| [f64::from(i / 4), f64::from(i % 2), f64::from(i / 2 % 2)]).collect();
        let part_of = rcb(&points, &[1.0; 400], 5);
        assert!((0..400).all(|i| part_of[i] == i as u32 / 80));
    }

    #[test]
    fn equal_points_are_shared_out_by_index() {
        assert_eq!(rcb(&[[1.0; 3]; 6], &[1.0; 6], 3), [0, 0, 1, 1, 2, 2]);
        assert_eq!(rcb(&[], &[], 3), [0u32; 0]);
        assert_eq!(rcb(&[[0.0; 3]; 2], &[1.0; 2], 64).iter().filter(|part| **part < 64).count(), 2);
    }
}
