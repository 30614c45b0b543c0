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
        let pulses = turns.windows(3).map(|turns| Pulse {
            function: self.id,
            start: turns[0].to,
            length: turns[2].from - turns[0].to,
        });
        pulses.min_by(|a, b| a.length.total_cmp(&b.length))
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
