//! Pulses of functions of time, which steps may be too long to follow.

use super::Function;
use crate::model::Model;

/// A function turns where it goes back by this part of its range.
const TURN: f64 = 0.05;

/// A pulse: a function leaves a value and comes back.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pulse {
    /// Number of the function.
    pub function: i64,
    /// Time at which it begins.
    pub start: f64,
    /// From there until it has come back; a time.
    pub length: f64,
}

/// Where a function turns: its value there, and from when to when it stays.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Turn {
    value: f64,
    from: f64,
    to: f64,
}

impl Pulse {
    /// What is looked at once a step should last so many. A blast that long has 0.96 to 1.11 of its impulse, one of four 0.92 to 1.22, as
    /// it falls on the steps.
    pub const STEPS: f64 = 8.0;
}

impl Turn {
    fn at((time, value): (f64, f64)) -> Turn {
        Turn { value, from: time, to: time }
    }

    /// Takes a point over that is as far or farther on a side, +1 or −1.
    fn follow(&mut self, (time, value): (f64, f64), side: f64) {
        if side * value > side * self.value {
            *self = Turn::at((time, value));
        } else if value == self.value {
            self.to = time;
        }
    }
}

impl Model {
    /// The shortest pulse before the end of the run of all functions of time that drive, load or accelerate something.
    pub fn shortest_pulse(&self) -> Option<Pulse> {
        let of_motions = self.prescribed_motions.iter().map(|motion| motion.function);
        let of_forces = self.prescribed_forces.iter().map(|force| force.function);
        let of_pressures = self.pressures.iter().map(|pressure| pressure.function);
        let of_gravities = self.gravities.iter().filter_map(|gravity| gravity.function);
        let used = of_motions.chain(of_forces).chain(of_pressures).chain(of_gravities);
        let functions = used.filter_map(|index| self.functions.get(index));
        let pulses = functions.filter_map(Function::shortest_pulse).filter(|pulse| pulse.start < self.termination_time);
        pulses.min_by(|a, b| a.length.total_cmp(&b.length))
    }
}

impl Function {
    /// Its shortest pulse; before time 0 it counts as 0, since nothing acts then.
    fn shortest_pulse(&self) -> Option<Pulse> {
        let turns = self.turns();
        let pulses = turns.windows(3).map(|turns| self.pulse([&turns[0], &turns[1], &turns[2]]));
        pulses.min_by(|a, b| a.length.total_cmp(&b.length))
    }

    /// The pulse at a turn between two others: of the two the nearer value is where it begins and where it is over.
    fn pulse(&self, [before, turn, after]: [&Turn; 3]) -> Pulse {
        let heights = [before, after].map(|other| (turn.value - other.value).abs());
        let level = if heights[0] <= heights[1] { before.value } else { after.value };
        let from = self.points.partition_point(|(time, _)| *time < turn.from);
        let to = self.points.partition_point(|(time, _)| *time <= turn.to);
        let points = self.points.iter().copied();
        let begins = points.clone().take(from).rev().chain([(0.0, 0.0)]);
        let start = reached(begins, (turn.from, turn.value), level).max(before.to);
        let end = reached(points.skip(to), (turn.to, turn.value), level).min(after.from);
        Pulse { function: self.id, start, length: end - start }
    }

    /// Where it begins, turns and ends.
    fn turns(&self) -> Vec<Turn> {
        let begins = [(0.0, 0.0), (0.0, self.value(0.0))];
        let points = || begins.into_iter().chain(self.points.iter().copied().filter(|(time, _)| *time > 0.0));
        let [low, high] = points().fold([0.0_f64; 2], |[low, high], (_, value)| [value.min(low), value.max(high)]);
        let back = TURN * (high - low);
        let (mut turns, mut side) = (Vec::new(), 0.0);
        let [mut lowest, mut highest] = [Turn::at(begins[0]); 2];
        for point in points().filter(|_| back > 0.0) {
            lowest.follow(point, -1.0);
            highest.follow(point, 1.0);
            if side <= 0.0 && point.1 - lowest.value >= back {
                turns.push(lowest);
                (side, highest) = (1.0, Turn::at(point));
            } else if side >= 0.0 && highest.value - point.1 >= back {
                turns.push(highest);
                (side, lowest) = (-1.0, Turn::at(point));
            }
        }
        turns.push(if side > 0.0 { highest } else { lowest });
        turns
    }
}

/// The time at which a line through points reaches a level on its way from one of them; that of its last point where it does not.
fn reached(points: impl Iterator<Item = (f64, f64)>, from: (f64, f64), level: f64) -> f64 {
    let mut before = from;
    for point in points {
        let (height, fall) = (before.1 - level, before.1 - point.1);
        if (point.1 - level) * (from.1 - level) <= 0.0 {
            return before.0 + (point.0 - before.0) * (height / fall).clamp(0.0, 1.0);
        }
        before = point;
    }
    before.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shortest(points: &[(f64, f64)]) -> Option<(f64, f64)> {
        let function = Function { id: 1, points: points.to_vec() };
        function.shortest_pulse().map(|pulse| (pulse.start, pulse.length))
    }

    #[test]
    fn pulses_are_measured_from_where_they_begin_to_where_they_are_over() {
        assert_eq!(shortest(&[(0.0, 0.0), (3.0, 0.0), (3.25, 7.0), (4.0, 0.0), (9.0, 0.0)]), Some((3.0, 1.0)));
        assert_eq!(shortest(&[(0.0, -5.0), (2.0, 0.0), (9.0, 0.0)]), Some((0.0, 2.0)));
        assert_eq!(shortest(&[(0.0, 0.0), (5.0, 1.0), (6.0, 0.0), (8.0, 1.0)]), Some((5.0, 3.0)));
        // The second is shorter, and it stays a while.
        let two = [(0.0, 0.0), (5.0, 1.0), (6.0, 0.0), (7.0, 0.0), (7.125, -2.0), (7.25, -2.0), (7.5, 0.0)];
        assert_eq!(shortest(&two), Some((7.0, 0.5)));
        // Down from a plateau for a moment, as by 1 of 4.
        assert_eq!(shortest(&[(0.0, 0.0), (8.0, 4.0), (9.0, 3.0), (10.0, 4.0), (20.0, 4.0)]), Some((8.0, 2.0)));
    }

    #[test]
    fn what_rises_for_good_or_hardly_turns_is_no_pulse() {
        assert_eq!(shortest(&[(0.0, 1.0), (1.0, 1.0)]), None);
        assert_eq!(shortest(&[(0.0, 0.0), (1e-9, 1.0), (1.0, 1.0)]), None);
        assert_eq!(shortest(&[(0.0, 0.0), (1.0, 1.0), (1.5, 0.96), (2.0, 2.0)]), None);
        assert_eq!(shortest(&[(0.0, 0.0)]), None);
        assert_eq!(shortest(&[(0.0, f64::NAN)]), None);
    }
}
