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
    followed(points, size, rank_of, axes, previous, 0.0)
}

/// [`balanced`], where cuts may be kept with some slack.
fn followed(
    points: &[Point],
    size: usize,
    rank_of: impl Fn(usize) -> usize + Sync,
    axes: Axes,
    previous: Option<&Bisection>,
    slack: f64,
) -> (Bisection, Vec<(u32, u32)>, u32) {
    let body = |comm: &mut dyn Communicator| {
        let rank = comm.rank();
        let own: Vec<Point> = (0..points.len()).filter(|i| rank_of(*i) % size == rank).map(|i| points[i]).collect();
        let positions: Vec<_> = own.iter().map(|point| point.0).collect();
        let ids: Vec<_> = own.iter().map(|point| point.1).collect();
        let weights: Vec<_> = own.iter().map(|point| point.2).collect();
        let earlier = previous.map(|cuts| Earlier { cuts, slack });
        let found = balance(&positions, &ids, &weights, axes, earlier, comm);
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

/// The lower and upper sides of a rank's region, infinite where nothing was cut. Points of a side belong to this
/// region or to its neighbour, by id. Where there were no points to cut between, `low` is +∞: nothing is inside.
fn region(bisection: &Bisection, rank: usize) -> ([f64; 3], [f64; 3]) {
    let (mut low, mut high) = ([f64::NEG_INFINITY; 3], [f64::INFINITY; 3]);
    let mut ranks = bisection.all();
    while ranks.parts > 1 {
        let cut = &bisection.cuts[ranks.cut()];
        let [left, right] = ranks.halves();
        if rank < right.first {
            high[cut.axis] = high[cut.axis].min(cut.end.coordinate());
            ranks = left;
        } else {
            low[cut.axis] = low[cut.axis].max(cut.end.coordinate());
            ranks = right;
        }
    }
    (low, high)
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

/// A brick of `n` nodes, 1/32 apart, along each side, and what a step of some `amount` makes of it: a turn, a stretch, a flight.
fn brick(n: u32, amount: f64) -> Vec<Point> {
    let place = |i: u32| [i % n, i / n % n, i / (n * n)].map(|k| f64::from(k) / 32.0);
    let moved = |[x, y, z]: [f64; 3]| [x + amount * (1.0 - y), y + amount * x, z + amount * (z + 3.0)];
    (0..n * n * n).map(|i| (moved(place(i)), i, 1)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn equal_weights_balance_within_one_and_as_on_one_list(points in points(Just(7u32), 0..200), size in size()) {
        let (_, owners, _) = balanced(&points, size, |i| i * 7919, Axes::Widest, None);
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
        let (_, owners, _) = balanced(&points, size, |i| i / 3, Axes::Widest, None);
        prop_assert_eq!(owners, serial(&points, size));
    }

    #[test]
    fn only_the_points_matter(
        points in points(0u32..5, 0..150), size in size(), deal in any::<usize>(), shift in coordinate(),
        axes in prop_oneof![Just(Axes::Widest), Just(Axes::One)],
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

    #[test]
    fn points_lie_in_the_regions_of_their_owners(points in points(Just(1u32), 0..100), size in size()) {
        let (bisection, owners, _) = balanced(&points, size, |i| i, Axes::Widest, None);
        for (at, id, _) in &points {
            let owner = owners[owners.partition_point(|(other, _)| other < id)].1;
            prop_assert_eq!(owner, bisection.owner(*at, *id));
            let (low, high) = region(&bisection, owner as usize);
            prop_assert!((0..3).all(|k| low[k] <= at[k] && at[k] <= high[k]));
        }
    }

    #[test]
    fn any_numbers_have_an_owner(
        raw in prop::collection::vec([any::<u64>(), any::<u64>(), any::<u64>()], 0..60), size in size(), at in any::<u64>(),
    ) {
        // Bit patterns of all kinds: NaN, infinities, subnormal numbers.
        let special = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
        let points: Vec<Point> = (raw.iter().zip(0..))
            .map(|([x, y, z], i)| ([f64::from_bits(*x), special[(*y % 3) as usize], f64::from_bits(*z)], i, 1))
            .collect();
        let (bisection, owners, _) = balanced(&points, size, |i| i, Axes::Widest, None);
        prop_assert!(evenly_shared(&owners, size));
        prop_assert!(owners.iter().all(|(id, rank)| bisection.owner(points[*id as usize].0, *id) == *rank));
        prop_assert!((bisection.owner([f64::from_bits(at); 3], 7) as usize) < size);
    }
}

#[test]
fn degenerate_points_are_shared_out_evenly() {
    let equal: Vec<Point> = (0..501).map(|i| ([0.3; 3], i * 1000, 2)).collect();
    let line: Vec<Point> = (0..501).map(|i| ([0.0, f64::from(i % 5), 0.0], i, 2)).collect();
    let weightless: Vec<Point> = line.iter().map(|point| (point.0, point.1, 0)).collect();
    let few: Vec<Point> = equal[..5].to_vec();
    for points in [&equal, &line, &weightless, &few, &Vec::new()] {
        for size in [1, 2, 3, 7, 16, 31, 64] {
            for axes in [Axes::Widest, Axes::One] {
                let (_, owners, _) = balanced(points, size, |i| i * i, axes, None);
                assert!(evenly_shared(&owners, size), "{size}: {:?}", sizes(&owners, size));
            }
        }
    }
}

#[test]
fn an_id_on_many_points_does_no_harm() {
    let points: Vec<Point> = (0..300).map(|i| ([1.0, 0.0, f64::from(i / 100)], 5, 1)).collect();
    let (bisection, owners, _) = balanced(&points, 6, |i| i, Axes::Widest, None);
    assert_eq!(owners.len(), 300);
    assert_eq!(bisection, balanced(&points, 6, |i| i / 9, Axes::Widest, Some(&bisection)).0);
}

#[test]
fn slices_have_cuts_along_one_axis() {
    let points: Vec<Point> = (0..2000).map(|i| ([f64::from(i % 10), f64::from(i / 10), 0.0], i, 1)).collect();
    let (slices, owners, _) = balanced(&points, 8, |i| i, Axes::One, None);
    assert!(owners.iter().all(|(id, rank)| *rank == id / 250));
    for rank in 0..8 {
        let (low, high) = region(&slices, rank);
        assert!([0, 2].iter().all(|axis| low[*axis] == f64::NEG_INFINITY && high[*axis] == f64::INFINITY));
    }
    let (compact, ..) = balanced(&points, 64, |i| i, Axes::Widest, None);
    assert!((0..64).any(|rank| region(&compact, rank).0[0].is_finite()));
}

/// Trials put the point of a cut into a bin of its own within a few rounds. While points keep their order the cuts are
/// known beforehand: a call for the beginning, and three for each level, of its boxes, axes and cuts.
#[test]
fn few_calls_find_the_cuts() {
    for (size, levels) in [(2, 1), (5, 3), (16, 4), (64, 6)] {
        let still = brick(22, 0.0);
        let (cuts, _, fresh) = balanced(&still, size, |i| i, Axes::Widest, None);
        let (_, _, again) = balanced(&still, size, |i| i, Axes::Widest, Some(&cuts));
        let shifted: Vec<Point> = still.iter().map(|(at, id, _)| (at.map(|x| 1.25 * x + 7.0), *id, 1)).collect();
        let (_, _, carried) = balanced(&shifted, size, |i| i, Axes::Widest, Some(&cuts));
        assert!(fresh <= 1 + 9 * levels, "{fresh}");
        assert_eq!((again, carried), (1 + 3 * levels, 1 + 3 * levels));
        for amount in [1e-9, 1e-6, 1e-4, 1e-2] {
            let (_, _, moved) = balanced(&brick(22, amount), size, |i| i, Axes::Widest, Some(&cuts));
            assert!(moved <= 1 + 9 * levels, "{moved}");
        }
    }
}

/// Points that each go their own way, a little. Kept cuts leave no part of more than its share and the slack, or one
/// point; they are known after a call for the beginning and three for each level, or two where the axis is given, which
/// exact ones are not.
#[test]
fn cuts_are_kept_within_their_slack() {
    let mixed = |i: u32, salt: u32| f64::from((i ^ salt).wrapping_mul(0x9e37_79b1) >> 8) / f64::from(1 << 24);
    let place = |i: u32, t: f64| [0, 1, 2].map(|k| f64::from(3 - k) * mixed(i, 91 * k) + t * mixed(i, 7 + 57 * k));
    let at = |t: f64| -> Vec<Point> { (0..6400).map(|i| (place(i, t), i, 1)).collect() };
    for (size, levels) in [(4, 2), (5, 3), (16, 4)] {
        for axes in [Axes::Widest, Axes::One] {
            let (cuts, ..) = balanced(&at(0.0), size, |i| i, axes, None);
            let (_, owners, calls) = followed(&at(0.01), size, |i| i, axes, Some(&cuts), 0.05);
            let (_, _, exact) = balanced(&at(0.01), size, |i| i, axes, Some(&cuts));
            assert_eq!(calls, if axes == Axes::One { 2 + 2 * levels } else { 1 + 3 * levels });
            assert!(exact > calls);
            let most = 6400.0 / size as f64 * f64::powi(1.05, levels as i32) + 1.0;
            assert!(sizes(&owners, size).iter().all(|count| (*count as f64) < most), "{:?}", sizes(&owners, size));
            assert!(!evenly_shared(&owners, size), "no cut has drifted");
            let dealt = followed(&at(0.01), size, |i| i / 3, axes, Some(&cuts), 0.05);
            assert_eq!(owners, dealt.1);
            // What has gone too far is exact again.
            let (_, owners, _) = followed(&at(9.0), size, |i| i, axes, Some(&cuts), 1e-9);
            assert!(evenly_shared(&owners, size));
        }
    }
}

/// Coordinates that double from point to point are the worst for even trials. Each round leaves at most a fourth of the
/// places, so that the 2⁹⁶ that there are take at most 48 rounds, after a call for boxes and one for axes.
#[test]
fn crowded_coordinates_end_within_the_bound() {
    let crowded = |i: u32| [f64::from_bits(1u64 << (i % 63)), 0.0, 0.0];
    let points: Vec<Point> = (0..1000).map(|i| (crowded(i), i.wrapping_mul(0x9e37_79b1), 1)).collect();
    let (_, owners, calls) = balanced(&points, 32, |i| i, Axes::Widest, None);
    assert!(evenly_shared(&owners, 32));
    assert!(calls <= 1 + 5 * 50, "{calls}");
}

/// Points travel to their owners, and each rank then holds just its share.
#[test]
fn parcels_bring_points_to_their_owners() {
    let all = brick(9, 1e-3);
    let results = run_threads(5, |comm| {
        let own: Vec<Point> = all.iter().skip(comm.rank()).step_by(5).copied().collect();
        let (positions, ids): (Vec<_>, Vec<_>) = own.iter().map(|point| (point.0, point.1)).unzip();
        let found = balance(&positions, &ids, &[], Axes::Widest, None, comm);
        let mut parcels = Parcels::new(&*comm, 3);
        for (i, owner) in found.owners.iter().enumerate() {
            parcels.add(*owner, ids[i], &positions[i]);
        }
        let records = parcels.exchange(comm);
        assert!(
            records
                .senders
                .iter()
                .all(|(from, range)| records.ids[range.clone()].iter().all(|id| *id as usize % 5 == *from))
        );
        let arrived =
            records.by_id().into_iter().map(|r| (records.ids[r as usize], records.values(r as usize).to_vec()));
        Ok::<_, ()>((found.bisection, arrived.collect::<Vec<_>>()))
    });
    let results = results.unwrap_or_else(|_| panic!("a rank failed"));
    for (rank, (bisection, arrived)) in results.iter().enumerate() {
        let expected = all.iter().filter(|point| bisection.owner(point.0, point.1) as usize == rank);
        assert_eq!(*arrived, expected.map(|point| (point.1, point.0.to_vec())).collect::<Vec<_>>());
    }
}
