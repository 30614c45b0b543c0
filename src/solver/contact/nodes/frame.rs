//! The frame in which search boxes lie: it flies along with what most contact nodes have in common.
//!
//! A search box holds the way that a node would go until the next search. Seen from the ground that way is long for all nodes of a body
//! that flies, though they stay beside each other, and every one of them would be a candidate of whatever lies along it. Seen from a
//! frame that flies along they rest. All ranks have the same frame, since boxes of nodes of one rank meet those of another; which frame
//! that is decides on time alone.

use crate::comm::{Communicator, ExactSum};
use crate::solver::nodes::{add, dot, scaled, subtract};

/// A frame that flies along with most nodes is taken where it leaves less than this part of the sum of all speeds.
const WORTH: f64 = 0.5;

/// Else that of the mean of all nodes is taken where the mean has more than this part of the squares of all speeds. Where one of two
/// bodies rests that is the part of the nodes that fly: of bodies of the same size each goes half of the way. Boxes grow with their way on all sides, so that
/// two halves bring fewer candidates than one whole.
const BETWEEN: f64 = 0.4;

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
        let of_all = velocities.clone().map(|v| [v[0], v[1], v[2], 1.0, dot(v, v).sqrt(), dot(v, v)]);
        let [x, y, z, count, speeds, squares] = sums(of_all, comm);
        let mean = scaled([x, y, z], 1.0 / count);
        // Nodes that go apart on all sides, or rest, or are lost, have nothing in common. Written so that NaN has neither.
        if speeds.is_finite() && count * dot(mean, mean).sqrt() > WORTH * speeds {
            let velocity = of_most(velocities.clone(), mean, comm);
            let speed_left = |v| {
                let left = subtract(v, velocity);
                [dot(left, left).sqrt()]
            };
            let [left] = sums(velocities.map(speed_left), comm);
            if left < WORTH * speeds {
                return Frame { velocity, gone: [0.0; 3] };
            }
        }
        let between = count * dot(mean, mean) > BETWEEN * squares;
        if between { Frame { velocity: mean, gone: [0.0; 3] } } else { Frame::default() }
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

/// Mean velocity of those that go along with the mean of all: they tell how most fly, without those that do not.
fn of_most(velocities: impl Iterator<Item = [f64; 3]>, mean: [f64; 3], comm: &mut dyn Communicator) -> [f64; 3] {
    let go_along = |v: &[f64; 3]| {
        let apart = subtract(*v, mean);
        dot(apart, apart) < dot(*v, *v)
    };
    let [x, y, z, count] = sums(velocities.filter(go_along).map(|v| [v[0], v[1], v[2], 1.0]), comm);
    scaled([x, y, z], 1.0 / count)
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
    fn it_flies_between_two_bodies_of_which_one_rests() {
        let fast = [2000.0, 0.0, 0.0];
        assert_eq!(velocity(&[(5, fast), (5, [0.0; 3])]), [1000.0, 0.0, 0.0]);
        assert_eq!(velocity(&[(5, [0.0; 3]), (5, fast)]), [1000.0, 0.0, 0.0]);
        assert_eq!(velocity(&[(9, fast), (11, [0.0; 3])]), [900.0, 0.0, 0.0]);
    }

    #[test]
    fn it_rests_where_flying_along_gains_little() {
        let fast = [2000.0, 0.0, 0.0];
        for groups in [
            &[][..],
            &[(10, [0.0; 3])],
            // A shot at a plate, as large as the plate at most.
            &[(1, fast), (9, [0.0; 3])],
            &[(1, fast), (2, [0.0; 3])],
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
