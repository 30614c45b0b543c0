//! The frame in which search boxes lie: it flies along with what most contact nodes have in common.
//!
//! A search box holds the way that a node would go until the next search. Seen from the ground that way is long for all nodes of a body
//! that flies, though they stay beside each other, and every one of them would be a candidate of whatever lies along it. Seen from a
//! frame that flies along they rest. All ranks have the same frame, since boxes of nodes of one rank meet those of another; which frame
//! that is decides on time alone.

use crate::comm::{Communicator, ExactSum};
use crate::solver::nodes::{add, dot, scaled, subtract};

/// The frame is taken where it leaves less than this part of the sum of all speeds: where half of the nodes rest, one half has to
/// pay whatever the frame is.
const WORTH: f64 = 0.5;

/// How the frame moves, and how far it has gone since the last search.
#[derive(Debug, Clone, Copy, Default)]
pub struct Frame {
    velocity: [f64; 3],
    gone: [f64; 3],
}

impl Frame {
    /// A frame that begins its way now, for nodes with these velocities, each of which one rank tells. All ranks call it and learn the
    /// same.
    pub fn of(velocities: impl Iterator<Item = [f64; 3]> + Clone, comm: &mut dyn Communicator) -> Frame {
        let [x, y, z, count, speeds] =
            sums(velocities.clone().map(|v| [v[0], v[1], v[2], 1.0, dot(v, v).sqrt()]), comm);
        // Nodes that go apart on all sides, or rest, or are lost, have nothing in common. Written so that NaN has neither.
        let along = dot([x, y, z], [x, y, z]).sqrt();
        let in_common = speeds.is_finite() && along > WORTH * speeds;
        if !in_common {
            return Frame::default();
        }
        // Those that go along with the mean tell how they fly, without those that do not.
        let mean = scaled([x, y, z], 1.0 / count);
        let go_along = |v: &[f64; 3]| {
            let apart = subtract(*v, mean);
            dot(apart, apart) < dot(*v, *v)
        };
        let [x, y, z, count] = sums(velocities.clone().filter(go_along).map(|v| [v[0], v[1], v[2], 1.0]), comm);
        let velocity = scaled([x, y, z], 1.0 / count);
        let speed_left = |v| {
            let left = subtract(v, velocity);
            [dot(left, left).sqrt()]
        };
        let [left] = sums(velocities.map(speed_left), comm);
        if left < WORTH * speeds { Frame { velocity, gone: [0.0; 3] } } else { Frame::default() }
    }

    /// Goes on for a time.
    pub fn advance(&mut self, time: f64) {
        self.gone = add(self.gone, self.path(time));
    }

    /// How far it has gone since the last search, lengths.
    pub fn gone(&self) -> [f64; 3] {
        self.gone
    }

    /// How far it goes in a time, lengths.
    pub fn path(&self, time: f64) -> [f64; 3] {
        scaled(self.velocity, time)
    }
}

/// Sums over all ranks, the same on any number of them.
fn sums<const N: usize>(numbers: impl Iterator<Item = [f64; N]>, comm: &mut dyn Communicator) -> [f64; N] {
    let mut sums = [const { ExactSum::new() }; N];
    for of_one in numbers {
        sums.iter_mut().zip(of_one).for_each(|(sum, number)| sum.add(number));
    }
    ExactSum::merge_ranks(&mut sums, comm);
    sums.map(|sum| sum.value())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::comm::run_threads;

    /// The velocity of the frame of so many nodes each with these velocities, dealt out to three ranks and on one.
    fn velocity(groups: &[(usize, [f64; 3])]) -> [f64; 3] {
        let all: Vec<[f64; 3]> = groups.iter().flat_map(|&(count, v)| std::iter::repeat_n(v, count)).collect();
        let on = |ranks: usize| {
            let frames = run_threads(ranks, |comm| {
                let own = all.iter().skip(comm.rank()).step_by(comm.size()).copied();
                Ok::<_, ()>(Frame::of(own, comm).velocity)
            });
            frames.unwrap_or_else(|_| panic!("a rank failed"))
        };
        let alone = on(1)[0];
        assert!(on(3).iter().all(|other| other.map(f64::to_bits) == alone.map(f64::to_bits)));
        alone
    }

    #[test]
    fn it_flies_along_with_most_of_what_flies() {
        let fast = [0.0, -2000.0, 0.0];
        assert_eq!(velocity(&[(10, fast)]), fast);
        // What rests beside it does not slow it down.
        assert_eq!(velocity(&[(9, fast), (1, [0.0; 3])]), fast);
        // Two that collide while both fly: the mean, which leaves a tenth of the speed.
        assert_eq!(velocity(&[(5, [1100.0, 0.0, 0.0]), (5, [900.0, 0.0, 0.0])]), [1000.0, 0.0, 0.0]);
    }

    #[test]
    fn it_rests_where_flying_along_gains_little() {
        let fast = [2000.0, 0.0, 0.0];
        for groups in [
            &[][..],
            &[(10, [0.0; 3])],
            // A shot at a plate, as large as the plate at most.
            &[(1, fast), (9, [0.0; 3])],
            &[(5, fast), (5, [0.0; 3])],
            // What goes apart.
            &[(5, fast), (5, [-2000.0, 0.0, 0.0])],
            // What is lost.
            &[(5, fast), (1, [f64::NAN, 0.0, 0.0])],
            &[(5, fast), (1, [f64::INFINITY, 0.0, 0.0])],
            &[(5, [1e200, 0.0, 0.0])],
        ] {
            assert_eq!(velocity(groups), [0.0; 3], "{groups:?}");
        }
    }

    #[test]
    fn it_goes_with_time() {
        let mut frame = Frame { velocity: [4.0, 0.0, -2.0], gone: [0.0; 3] };
        frame.advance(0.5);
        frame.advance(0.25);
        assert_eq!((frame.gone(), frame.path(2.0)), ([3.0, 0.0, -1.5], [8.0, 0.0, -4.0]));
    }
}
