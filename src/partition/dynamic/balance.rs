//! Sharing points out evenly, all ranks together: one level of the tree of cuts after the other, and all cuts of a
//! level at once, so that the number of messages grows with the depth of the tree only.

use super::bisection::{Bisection, Cut, Ranks};
use super::median::{Found, Goal, Guess, Mass, Median, TALLY, tally};
use super::place::{Place, coordinate_key};
use crate::comm::Communicator;
use crate::comm::reduce::number;
use crate::partition::spread::{Frame, Moments};
use std::ops::Range;

/// Which axes are cut across.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axes {
    /// That along which the points to be cut are spread most: compact regions.
    Widest,
    /// That along which all points are, in all cuts: slices.
    One,
}

/// The cuts of an earlier time, the same on all ranks.
#[derive(Debug, Clone, Copy)]
pub struct Earlier<'a> {
    /// The cuts.
    pub cuts: &'a Bisection,
    /// A cut through the same point as then is kept while neither side has more than this part of its share too much,
    /// and its axis while the points' variance along another is not twice as great; with 0 all cuts are exact.
    pub slack: f64,
}

/// What [`balance`] finds.
#[derive(Debug, Clone, PartialEq)]
pub struct Balanced {
    /// The cuts, the same on all ranks.
    pub bisection: Bisection,
    /// The new owner of each point given on this rank.
    pub owners: Vec<u32>,
    /// How many collective calls it took, the same on all ranks.
    pub collectives: u32,
}

/// One local point.
#[derive(Debug, Clone, Copy)]
struct Point {
    /// Keys of its coordinates.
    keys: [u64; 3],
    id: u32,
    weight: u32,
    index: u32,
}

impl Point {
    fn place(&self, axis: usize) -> Place {
        Place::at(self.keys[axis], self.id)
    }
}

/// A subset of the points, to be cut between its ranks.
#[derive(Debug, Clone)]
struct Subset {
    ranks: Ranks,
    all: Mass,
    /// Where its points of this rank are.
    local: Range<usize>,
}

/// A cut that is being searched for.
#[derive(Debug)]
struct Cutting {
    subset: Subset,
    axis: usize,
    median: Median,
    /// Where the local points of the bracket are; what comes before is below it.
    bracket: Range<usize>,
}

/// The box of a subset's points, and the range of their ids.
#[derive(Debug, Clone, Copy)]
struct Extent {
    /// Keys of coordinates.
    low: [u64; 3],
    high: [u64; 3],
    ids: [u32; 2],
}

/// Cuts space so that each rank gets its share of the points of all ranks; every rank calls it.
///
/// `points` and `ids` are the points of this rank, in any number and order; no id may be on two of them all.
/// `weights` are theirs, or empty when all weigh one; they count as equal when they are zero everywhere. Weights are
/// shared out as evenly as cuts between points allow, equal ones to within one point, and no rank stays without a
/// point while there are enough. What is found depends only on positions, ids and weights of all points: not on
/// where they are, nor on `earlier`, from whose cuts the search starts when they are for the same number of ranks,
/// unless these may be kept with some slack. Coordinates that are not finite count as the largest finite
/// ones, and NaN as the lowest.
///
/// It is the algorithm of Attaway et al. 1996, figure 7, except that points stay where they are until all cuts are
/// known, and that a round tries many places at once. It takes one collective call for the beginning and, for each
/// level of the tree, one for boxes, one for axes unless all are given, and one per round: one round where the point at
/// the previous cut still is the point at the cut, whatever its motion, or is kept, and about five otherwise.
pub fn balance(
    points: &[[f64; 3]],
    ids: &[u32],
    weights: &[u32],
    axes: Axes,
    earlier: Option<Earlier>,
    comm: &mut dyn Communicator,
) -> Balanced {
    let size = comm.size();
    let mut work = Work {
        points: gather(points, ids, weights),
        axes,
        earlier: earlier.filter(|earlier| earlier.cuts.size() == size),
        guesses: Vec::new(),
        bisection: Bisection::uncut(size),
        comm,
        collectives: 0,
    };
    let mut owners = vec![0; points.len()];
    if size > 1 {
        let mut level = vec![work.begin()];
        while !level.is_empty() {
            level = work.cut(level, &mut owners);
        }
    }
    Balanced { bisection: work.bisection, owners, collectives: work.collectives }
}

fn gather(points: &[[f64; 3]], ids: &[u32], weights: &[u32]) -> Vec<Point> {
    let weights = weights.iter().copied().chain(std::iter::repeat(1));
    (points.iter().zip(ids).zip(weights).zip(0..))
        .map(|(((at, id), weight), index)| Point { keys: at.map(coordinate_key), id: *id, weight, index })
        .collect()
}

struct Work<'a> {
    points: Vec<Point>,
    axes: Axes,
    earlier: Option<Earlier<'a>>,
    /// Where the points at the previous cuts are now, or the cuts if these points are gone.
    guesses: Vec<Place>,
    bisection: Bisection,
    comm: &'a mut dyn Communicator,
    collectives: u32,
}

impl Work<'_> {
    fn sum(&mut self, values: &mut [u64]) {
        self.comm.all_sum(values);
        self.collectives += 1;
    }

    /// Counts the points of all ranks, and asks where those at the previous cuts have gone: bodies move, but their
    /// points hardly change their order.
    fn begin(&mut self) -> Subset {
        let cuts = self.earlier.map_or(&[][..], |earlier| &earlier.cuts.cuts);
        let mut at_cuts: Vec<(u32, usize)> = cuts.iter().zip(0..).map(|(cut, index)| (cut.point, index)).collect();
        at_cuts.sort_unstable();
        let mut sums = vec![0; 2 + 2 * cuts.len()];
        sums[0] = self.points.len() as u64;
        for point in &self.points {
            sums[1] += u64::from(point.weight);
            let first = at_cuts.partition_point(|(id, _)| *id < point.id);
            for (_, cut) in at_cuts[first..].iter().take_while(|(id, _)| *id == point.id) {
                sums[2 + 2 * cut] += 1;
                sums[3 + 2 * cut] = sums[3 + 2 * cut].wrapping_add(point.keys[cuts[*cut].axis]);
            }
        }
        self.sum(&mut sums);
        let moved = cuts.iter().zip(sums[2..].chunks_exact(2));
        self.guesses =
            moved.map(|(cut, sums)| if sums[0] == 1 { Place::at(sums[1], cut.point) } else { cut.end }).collect();
        if sums[1] == 0 {
            self.points.iter_mut().for_each(|point| point.weight = 1);
            sums[1] = sums[0];
        }
        let all = Mass { count: sums[0], weight: sums[1] };
        Subset { ranks: Ranks { first: 0, parts: self.bisection.size() }, all, local: 0..self.points.len() }
    }

    /// Cuts all subsets of a level and returns those of the next; points that have found their owner are noted.
    fn cut(&mut self, level: Vec<Subset>, owners: &mut [u32]) -> Vec<Subset> {
        let mut cuttings = self.start(level);
        while self.advance(&mut cuttings) {}
        let mut next = Vec::new();
        for cutting in cuttings {
            for subset in self.finish(cutting) {
                if subset.ranks.parts > 1 {
                    next.push(subset);
                } else {
                    let rank = subset.ranks.first as u32;
                    self.points[subset.local].iter().for_each(|point| owners[point.index as usize] = rank);
                }
            }
        }
        next
    }

    fn start(&mut self, level: Vec<Subset>) -> Vec<Cutting> {
        let extents = self.extents(&level);
        let axes = self.axes_across(&level, &extents);
        let subsets = level.into_iter().zip(extents).zip(axes);
        subsets.map(|((subset, extent), axis)| self.cutting(subset, &extent, axis)).collect()
    }

    /// The axes across which subsets are cut.
    fn axes_across(&mut self, level: &[Subset], extents: &[Extent]) -> Vec<usize> {
        let all = self.bisection.all();
        if self.axes == Axes::One && level.iter().all(|subset| subset.ranks != all) {
            return vec![self.bisection.cuts[all.cut()].axis; level.len()];
        }
        let frames: Vec<Frame> = extents.iter().map(Extent::frame).collect();
        let mut sums = Vec::with_capacity(6 * level.len());
        for (subset, frame) in level.iter().zip(&frames) {
            let mut moments = Moments::default();
            self.points[subset.local.clone()].iter().for_each(|point| moments.add(frame, point.keys.map(number)));
            sums.extend(moments.0);
        }
        self.sum(&mut sums);
        let moments = sums.chunks_exact(6).map(|sums| Moments(std::array::from_fn(|i| sums[i])));
        let earlier = self.earlier.filter(|earlier| earlier.slack > 0.0);
        (level.iter().zip(&frames).zip(moments))
            .map(|((subset, frame), moments)| {
                let before = earlier.map(|earlier| earlier.cuts.cuts[subset.ranks.cut()].axis);
                moments.widest(subset.all.count, frame, before)
            })
            .collect()
    }

    fn cutting(&self, subset: Subset, extent: &Extent, axis: usize) -> Cutting {
        let cut = subset.ranks.cut();
        let same_axis = self.earlier.filter(|earlier| earlier.cuts.cuts[cut].axis == axis);
        let guess = same_axis.map(|earlier| Guess { at: self.guesses[cut], slack: earlier.slack });
        let goal = Goal { all: subset.all, parts: subset.ranks.halves().map(|ranks| ranks.parts) };
        let low = Place::at(extent.low[axis], extent.ids[0]);
        let high = Place::at(extent.high[axis], extent.ids[1]).next();
        let median = Median::new(goal, low, high, guess);
        Cutting { axis, median, bracket: subset.local.clone(), subset }
    }

    /// The extents of subsets over all ranks.
    fn extents(&mut self, level: &[Subset]) -> Vec<Extent> {
        let mut values: Vec<f64> =
            level.iter().flat_map(|subset| Extent::around(&self.points[subset.local.clone()]).to_minima()).collect();
        self.comm.all_min(&mut values);
        self.collectives += 1;
        values.chunks_exact(8).map(Extent::from_minima).collect()
    }

    /// One round of all searches that are not at their end; whether there was one.
    fn advance(&mut self, cuttings: &mut [Cutting]) -> bool {
        let mut active: Vec<&mut Cutting> =
            cuttings.iter_mut().filter(|cutting| cutting.median.found.is_none()).collect();
        // Cuts with slack are kept at first; the few that are not shall cost few bytes rather than few rounds.
        let has_slack = self.earlier.is_some_and(|earlier| earlier.slack > 0.0);
        let closer = if has_slack { CLOSER_TRIALS.start } else { closer_trials(active.len()) };
        let mut sums = Vec::new();
        for cutting in &mut active {
            cutting.median.choose_trials(closer);
            cutting.count(&self.points, &mut sums);
        }
        if active.is_empty() {
            return false;
        }
        self.sum(&mut sums);
        let mut rest = &sums[..];
        for cutting in active {
            let (own, others) = rest.split_at(cutting.median.starts.len() * TALLY);
            cutting.median.narrow(own);
            cutting.narrow(&mut self.points);
            rest = others;
        }
        true
    }

    /// Notes a cut that is found and divides the points.
    fn finish(&mut self, cutting: Cutting) -> [Subset; 2] {
        let Cutting { subset, axis, median, bracket } = cutting;
        let found = median.found.unwrap_or(Found::NOTHING);
        self.bisection.cuts[subset.ranks.cut()] = Cut { axis, end: found.end, point: found.point };
        let left = divide(&mut self.points[bracket.clone()], |point| point.place(axis) < found.end);
        let middle = bracket.start + left;
        let [left, right] = subset.ranks.halves();
        [
            Subset { ranks: left, all: found.left, local: subset.local.start..middle },
            Subset { ranks: right, all: subset.all.without(found.left), local: middle..subset.local.end },
        ]
    }
}

impl Cutting {
    /// Appends the sums of the local points over the bins.
    fn count(&self, points: &[Point], sums: &mut Vec<u64>) {
        let begin = sums.len();
        let starts = &self.median.starts;
        sums.resize(begin + starts.len() * TALLY, 0);
        let sums = &mut sums[begin..];
        for point in &points[self.bracket.clone()] {
            tally(sums, starts, point.place(self.axis), point.weight);
        }
    }

    /// Brings the local points of the new bracket together.
    fn narrow(&mut self, points: &mut [Point]) {
        let (axis, low, high) = (self.axis, self.median.low, self.median.high);
        self.bracket.start += divide(&mut points[self.bracket.clone()], |point| point.place(axis) < low);
        let inside = divide(&mut points[self.bracket.clone()], |point| point.place(axis) < high);
        self.bracket.end = self.bracket.start + inside;
    }
}

impl Extent {
    fn around(points: &[Point]) -> Extent {
        let nothing = Extent { low: [u64::MAX; 3], high: [0; 3], ids: [u32::MAX, 0] };
        points.iter().fold(nothing, |extent, point| Extent {
            low: [0, 1, 2].map(|axis| extent.low[axis].min(point.keys[axis])),
            high: [0, 1, 2].map(|axis| extent.high[axis].max(point.keys[axis])),
            ids: [extent.ids[0].min(point.id), extent.ids[1].max(point.id)],
        })
    }

    /// Numbers whose minima over the ranks are those of the extent of all points.
    fn to_minima(self) -> [f64; 8] {
        if self.ids[0] > self.ids[1] {
            return [f64::INFINITY; 8];
        }
        let ([a, b, c], [d, e, f]) = (self.low.map(number), self.high.map(|key| -number(key)));
        [a, b, c, d, e, f, f64::from(self.ids[0]), -f64::from(self.ids[1])]
    }

    fn from_minima(minima: &[f64]) -> Extent {
        Extent {
            low: [0, 1, 2].map(|axis| coordinate_key(minima[axis])),
            high: [3, 4, 5].map(|axis| coordinate_key(-minima[axis])),
            ids: [minima[6] as u32, -minima[7] as u32],
        }
    }

    fn frame(&self) -> Frame {
        Frame::new(self.low.map(number), self.high.map(number))
    }
}

/// Fewest and most trials on either side of an expected cut.
const CLOSER_TRIALS: Range<usize> = 3..8;

/// Trials on either side of the expected cut for so many searches at once: what all of them send stays small.
fn closer_trials(searches: usize) -> usize {
    (512 / searches.max(1)).clamp(CLOSER_TRIALS.start, CLOSER_TRIALS.end)
}

/// Brings the points for which `before` holds to the front and returns their number.
fn divide(points: &mut [Point], before: impl Fn(&Point) -> bool) -> usize {
    let mut count = 0;
    for i in 0..points.len() {
        if before(&points[i]) {
            points.swap(i, count);
            count += 1;
        }
    }
    count
}
