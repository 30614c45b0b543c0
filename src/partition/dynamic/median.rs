//! The search for one cut, by points that are spread over the ranks.
//!
//! A bracket of places is known to hold the point at the cut. Trial places cut it into bins, all ranks together sum
//! the points of each bin, and the sums say which bin is the next bracket. Trials only decide how soon that ends:
//! what is found depends on the points alone.

use super::place::Place;

/// How many numbers make up a [`Tally`].
pub(super) const TALLY: usize = 5;

/// Even parts into which trials cut a bracket by coordinate.
const EVEN: usize = 8;

/// Even parts into which trials cut a bracket by places: even if coordinates gather about a point, each round
/// leaves at most this part of the bracket.
const HALVES: u128 = 4;

/// The ratio of the distances of successive trials from where the cut is thought to be.
const CLOSER: f64 = 0.25;

/// Sums over the points of a bin.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Tally {
    /// Number of points.
    count: u64,
    /// Their weights.
    weight: u64,
    /// Upper and lower halves of their coordinate keys, counted from the start of the bin. Kept apart, they are
    /// summed without overflow.
    upper: u64,
    lower: u64,
    /// Their ids.
    ids: u64,
}

impl Tally {
    fn from_sums(sums: &[u64]) -> Tally {
        Tally { count: sums[0], weight: sums[1], upper: sums[2], lower: sums[3], ids: sums[4] }
    }

    /// The place at the mean coordinate and mean id, rounded down, of a bin that is not empty and begins at `start`.
    /// It is the place of the only point, and has the coordinate of points that have one coordinate.
    fn mean(&self, start: Place) -> Place {
        let offsets = (u128::from(self.upper) << 32) + u128::from(self.lower);
        let mean = offsets / u128::from(self.count);
        Place::at(start.key() + mean as u64, (self.ids / self.count) as u32)
    }
}

/// Adds a point to the sums of the bins that begin at `starts`, the first not behind the point.
pub(super) fn tally(sums: &mut [u64], starts: &[Place], place: Place, weight: u32) {
    let bin = starts.partition_point(|start| *start <= place) - 1;
    let offset = place.key() - starts[bin].key();
    let sums = &mut sums[bin * TALLY..][..TALLY];
    sums[0] += 1;
    sums[1] += u64::from(weight);
    sums[2] += offset >> 32;
    sums[3] += offset & u64::from(u32::MAX);
    sums[4] += u64::from(place.id());
}

/// Points and what they weigh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Mass {
    pub count: u64,
    pub weight: u64,
}

/// What is to be left of a cut.
#[derive(Debug, Clone, Copy)]
pub(super) struct Goal {
    /// All points.
    pub all: Mass,
    /// How many ranks share the points left of the cut, and right of it; both at least one.
    pub parts: [usize; 2],
}

impl Goal {
    /// Weight below a cut less what it should be, in units of 1 / parts, so that it is whole.
    fn excess(&self, below: Mass) -> i128 {
        let [left, right] = self.parts.map(|parts| parts as i128);
        i128::from(below.weight) * (left + right) - i128::from(self.all.weight) * left
    }

    /// Least and largest number of points left of the cut: at least one for each rank while there are enough, at
    /// most one for each while there are not.
    fn allowed(&self) -> (u64, u64) {
        let [left, right] = self.parts.map(|parts| parts as u64);
        let rest = self.all.count.saturating_sub(right);
        (left.min(rest), left.max(rest))
    }

    /// Whether the point at the cut is not before a place with so much below it.
    fn reaches(&self, below: Mass) -> bool {
        let (least, most) = self.allowed();
        let enough = below.count > least && (below.count > most || self.excess(below) > 0);
        below.count < self.all.count && !enough
    }

    /// Whether a cut with so much below it leaves both sides their shares, but for a part `slack` of the smaller one.
    fn is_met(&self, below: Mass, slack: f64) -> bool {
        let (least, most) = self.allowed();
        let [left, right] = self.parts.map(|parts| parts as f64);
        let most_excess = slack * self.all.weight as f64 * left.min(right);
        (least..=most).contains(&below.count) && self.excess(below).unsigned_abs() as f64 <= most_excess
    }

    /// Whether the point at the cut, before it `without` and up to it `with`, goes to the left.
    fn takes(&self, without: Mass, with: Mass) -> bool {
        let (least, most) = self.allowed();
        let nearer = self.excess(with) < -self.excess(without);
        (nearer || without.count < least) && with.count <= most
    }
}

/// Where a cut is expected.
#[derive(Debug, Clone, Copy)]
pub(super) struct Guess {
    /// The place of the point that was at the cut.
    pub at: Place,
    /// The cut is kept there while neither side has more than this part of its share too much.
    pub slack: f64,
}

/// A cut that was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Found {
    /// Places before this one are left of the cut.
    pub end: Place,
    /// Id of the point at the cut.
    pub point: u32,
    /// What is left of it.
    pub left: Mass,
}

impl Found {
    /// All that can be found among no points.
    pub const NOTHING: Found = Found { end: Place::END, point: 0, left: Mass { count: 0, weight: 0 } };
}

/// The search for one cut.
#[derive(Debug)]
pub(super) struct Median {
    goal: Goal,
    /// The bracket: from `low` to before `high`.
    pub low: Place,
    pub high: Place,
    below: Mass,
    inside: Mass,
    /// Where the cut is expected before anything was counted.
    guess: Option<Guess>,
    /// Mean of the points in the bracket.
    mean: Option<Place>,
    /// Where the bins begin, ascending, the first at `low`.
    pub starts: Vec<Place>,
    /// The cut, when it is found.
    pub found: Option<Found>,
}

impl Median {
    /// The search among points whose places run from `low` to before `high`; without points the two mean nothing.
    pub fn new(goal: Goal, low: Place, high: Place, guess: Option<Guess>) -> Median {
        let guess = guess.filter(|guess| (low..high).contains(&guess.at));
        let (below, inside) = (Mass::default(), goal.all);
        let mut median = Median { goal, low, high, below, inside, guess, mean: None, starts: Vec::new(), found: None };
        if goal.all.count > 0 {
            median.conclude();
        } else {
            median.found = Some(Found::NOTHING);
        }
        median
    }

    /// Sets the bins of the next round: trials about where the cut is expected, `closer` on either side, and even ones.
    pub fn choose_trials(&mut self, closer: usize) {
        let mut trials = self.expected();
        // Where the cut may be kept there is no need of others yet.
        if self.guess.is_none_or(|guess| guess.slack == 0.0) {
            trials.extend(self.spread(closer));
        }
        let trials = trials.into_iter();
        self.starts.clear();
        self.starts.extend(trials.filter(|trial| self.low < *trial && *trial < self.high));
        self.starts.push(self.low);
        self.starts.sort_unstable();
        self.starts.dedup();
    }

    /// Trials that single out the point at the guess, and the mean.
    ///
    /// When points are of more than one coordinate, the place behind all of the mean coordinate divides them: a few
    /// that are close together need no many rounds. When they are of one, the bin of the mean has just that.
    fn expected(&self) -> Vec<Place> {
        let mut places: Vec<Place> = self.guess.iter().flat_map(|guess| [guess.at, guess.at.next()]).collect();
        if let Some(mean) = self.mean {
            places.extend([Place::at(mean.key(), 0), Place::at(mean.key() + 1, 0), mean.next()]);
        }
        places
    }

    /// Trials about where the cut is expected and where points crowd, and all over the bracket.
    fn spread(&self, closer: usize) -> Vec<Place> {
        let expected = self.guess.map_or_else(|| self.fraction_wanted(), |guess| self.fraction_at(guess.at));
        let crowd = self.mean.map(|mean| self.fraction_at(mean));
        let distances = || std::iter::successors(Some(CLOSER), |distance| Some(distance * CLOSER)).take(closer);
        let about = |centre| distances().flat_map(move |distance| [centre - distance, centre + distance]);
        let even = (1..EVEN).map(|i| i as f64 / EVEN as f64);
        let fractions = about(expected).chain([expected]).chain(crowd.into_iter().flat_map(about)).chain(even);
        let width = self.high.since(self.low);
        let halves = (1..HALVES).map(|i| self.low.plus(width * i / HALVES));
        fractions.map(|fraction| self.at_fraction(fraction)).chain(halves).collect()
    }

    /// The part of the bracket's weight that should be left of the cut.
    fn fraction_wanted(&self) -> f64 {
        let parts = (self.goal.parts[0] + self.goal.parts[1]) as f64;
        let missing = -self.goal.excess(self.below) as f64 / parts;
        if self.inside.weight > 0 { (missing / self.inside.weight as f64).clamp(0.0, 1.0) } else { 0.5 }
    }

    /// The place at a fraction, 0 to 1, of the bracket: along the axis, or by id when it is of one coordinate.
    /// Other fractions and NaN give places outside of the bracket or at its ends.
    fn at_fraction(&self, fraction: f64) -> Place {
        let last = self.high.last_before();
        if self.low.key() == last.key() {
            return self.low.plus((self.high.since(self.low) as f64 * fraction) as u128);
        }
        Place::of(self.low.coordinate() * (1.0 - fraction) + last.coordinate() * fraction, 0)
    }

    /// The fraction at which a place is; NaN if the bracket is too short to say.
    fn fraction_at(&self, place: Place) -> f64 {
        let last = self.high.last_before();
        if self.low.key() == last.key() {
            let place = place.clamp(self.low, last);
            return place.since(self.low) as f64 / self.high.since(self.low) as f64;
        }
        // Halved, so that the longest brackets do not overflow.
        let [low, at, high] = [self.low, place, last].map(|place| 0.5 * place.coordinate());
        (at - low) / (high - low)
    }

    /// Takes the sums of all ranks over the bins and keeps the bin with the point at the cut.
    pub fn narrow(&mut self, sums: &[u64]) {
        self.found = self.kept(sums);
        if self.found.is_some() {
            return;
        }
        let end = self.high;
        for (bin, sums) in sums.chunks_exact(TALLY).enumerate() {
            let tally = Tally::from_sums(sums);
            if bin > 0 {
                let below = self.below.and(self.inside);
                if !self.goal.reaches(below) {
                    break;
                }
                self.below = below;
            }
            self.low = self.starts[bin];
            self.high = self.starts.get(bin + 1).copied().unwrap_or(end);
            self.inside = Mass { count: tally.count, weight: tally.weight };
            self.mean = (tally.count > 0).then(|| tally.mean(self.low));
        }
        // A guess that was right has ended the search; another has done what it could.
        self.guess = None;
        self.conclude();
    }

    /// The cut just before or just behind the guess, if its slack allows one of them: that with the smaller excess.
    fn kept(&self, sums: &[u64]) -> Option<Found> {
        let guess = self.guess.filter(|guess| guess.slack > 0.0)?;
        let mut below = self.below;
        let mut cuts = Vec::new();
        for (start, sums) in self.starts.iter().zip(sums.chunks_exact(TALLY)) {
            if (guess.at..=guess.at.next()).contains(start) && self.goal.is_met(below, guess.slack) {
                cuts.push(Found { end: *start, point: guess.at.id(), left: below });
            }
            let tally = Tally::from_sums(sums);
            below = below.and(Mass { count: tally.count, weight: tally.weight });
        }
        cuts.into_iter().min_by_key(|cut| self.goal.excess(cut.left).abs())
    }

    /// Notes the cut if one place is left.
    fn conclude(&mut self) {
        let only = self.mean.filter(|_| self.inside.count == 1);
        let Some(at) = only.or((self.low.next() == self.high).then_some(self.low)) else { return };
        let with = self.below.and(self.inside);
        let taken = self.goal.takes(self.below, with);
        let (end, left) = if taken { (at.next(), with) } else { (at, self.below) };
        self.found = Some(Found { end, point: at.id(), left });
    }
}

impl Mass {
    /// Both together.
    pub fn and(self, other: Mass) -> Mass {
        Mass { count: self.count + other.count, weight: self.weight + other.weight }
    }

    /// What is left without a part.
    pub fn without(self, part: Mass) -> Mass {
        Mass { count: self.count - part.count, weight: self.weight - part.weight }
    }
}
