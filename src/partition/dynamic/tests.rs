use super::*;
use crate::comm::{Communicator, run_threads};
use crate::partition::rcb;
use proptest::prelude::*;

/// A point: where it is, its id and its weight.
type Point = ([f64; 3], u32, u32);

/// Runs [`balance`] on `size` ranks, the points dealt out by `rank_of`; the cuts, the owner of each id and the number
/// of collective calls, after checking that all ranks agree.
fn balanced(
    points: &[Point],
    size: usize,
    rank_of: impl Fn(usize) -> usize + Sync,
    axes: Axes,
    previous: Option<&Bisection>,
) -> (Bisection, Vec<(u32, u32)>, u32) {
    let body = |comm: &mut dyn Communicator| {
        let rank = comm.rank();
        let own: Vec<Point> = (0..points.len()).filter(|i| rank_of(*i) % size == rank).map(|i| points[i]).collect();
        let positions: Vec<_> = own.iter().map(|point| point.0).collect();
        let ids: Vec<_> = own.iter().map(|point| point.1).collect();
        let weights: Vec<_> = own.iter().map(|point| point.2).collect();
        let found = balance(&positions, &ids, &weights, axes, previous, comm);
        for (at, (id, owner)) in positions.iter().zip(ids.iter().zip(&found.owners)) {
            assert_eq!(found.bisection.owner(*at, *id), *owner);
        }
        Ok::<_, ()>((found.bisection, ids.into_iter().zip(found.owners).collect::<Vec<_>>(), found.collectives))
    };
    let results = run_threads(size, body).unwrap_or_else(|_| panic!("a rank failed"));
    let (bisection, _, collectives) = results[0].clone();
    assert!(results.iter().all(|result| result.0 == bisection && result.2 == collectives));
    let mut owners: Vec<_> = results.into_iter().flat_map(|result| result.1).collect();
    owners.sort_unstable();
    (bisection, owners, collectives)
}

/// The same on one list: `partition::rcb` with points in the order of their ids.
fn serial(points: &[Point], size: usize) -> Vec<(u32, u32)> {
    let mut sorted = points.to_vec();
    sorted.sort_unstable_by_key(|point| point.1);
    let positions: Vec<_> = sorted.iter().map(|point| point.0.map(|x| x + 0.0)).collect();
    // rcb scales weights to a largest one of 2^31: as it is a power of two here, it changes nothing.
    let weights: Vec<_> = sorted.iter().map(|point| f64::from(point.2)).collect();
    sorted.iter().map(|point| point.1).zip(rcb(&positions, &weights, size)).collect()
}

fn sizes(owners: &[(u32, u32)], size: usize) -> Vec<usize> {
    let mut sizes = vec![0; size];
    owners.iter().for_each(|(_, rank)| sizes[*rank as usize] += 1);
    sizes
}

fn evenly_shared(owners: &[(u32, u32)], size: usize) -> bool {
    let (least, most) = (owners.len() / size, owners.len().div_ceil(size));
    sizes(owners, size).iter().all(|count| (least..=most).contains(count))
}

/// Coordinates with many ties, zeros of both signs, and clusters of all scales.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        (-4i32..4).prop_map(f64::from),
        Just(-0.0),
        -1e3..1e3,
        (-300i32..300).prop_map(|power| 10f64.powi(power)),
        (0.0..1e-12).prop_map(|x| 1.0 + x),
    ]
}

fn points(weight: impl Strategy<Value = u32>, count: std::ops::Range<usize>) -> impl Strategy<Value = Vec<Point>> {
    let point = ([coordinate(), coordinate(), coordinate()], weight);
    (prop::collection::vec(point, count), any::<u32>()).prop_map(|(points, salt)| {
        // Distinct ids in no order: an odd factor permutes the integers.
        let id = |i: u32| (i ^ salt).wrapping_mul(0x9e37_79b1);
        points.into_iter().zip(0..).map(|((at, weight), i)| (at, id(i), weight)).collect()
    })
}

fn size() -> impl Strategy<Value = usize> {
    prop_oneof![4 => 1usize..12, 1 => 12usize..=64]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn equal_weights_balance_within_one_and_as_on_one_list(points in points(Just(7u32), 0..200), size in size()) {
        let (_, owners, _) = balanced(&points, size, |i| i * 7919, Axes::Longest, None);
        prop_assert!(evenly_shared(&owners, size), "{:?}", sizes(&owners, size));
        let equal: Vec<Point> = points.iter().map(|point| (point.0, point.1, 1)).collect();
        prop_assert_eq!(owners, serial(&equal, size));
    }

    #[test]
    fn weighted_points_fall_as_on_one_list(
        points in points(prop_oneof![Just(0u32), 0u32..9, Just(1 << 31)], 1..150), size in size(),
    ) {
        let mut points = points;
        points[0].2 = 1 << 31;
        let (_, owners, _) = balanced(&points, size, |i| i / 3, Axes::Longest, None);
        prop_assert_eq!(owners, serial(&points, size));
    }

    #[test]
    fn only_the_points_matter(
        points in points(0u32..5, 0..150), size in size(), deal in any::<usize>(), shift in coordinate(),
        axes in prop_oneof![Just(Axes::Longest), Just(Axes::One)],
    ) {
        let one = balanced(&points, size, |_| 0, axes, None);
        let mut other = points.clone();
        other.reverse();
        other.iter_mut().for_each(|point| point.0 = point.0.map(|x| x * 0.5 + shift));
        let previous = balanced(&other, size, |i| i, axes, None).0;
        other.iter_mut().zip(points.iter().rev()).for_each(|(point, original)| point.0 = original.0);
        let dealt = balanced(&other, size, |i| (i + 1).wrapping_mul(deal | 1) >> 7, axes, Some(&previous));
        prop_assert_eq!((&one.0, &one.1), (&dealt.0, &dealt.1));
        let warm = balanced(&points, size, |i| i, axes, Some(&one.0));
        prop_assert_eq!((&one.0, &one.1), (&warm.0, &warm.1));
    }
}
