//! What histories compare the present state with: motion as it was when their last state was due. It belongs to the state
//! between two steps, so that a continued run goes on with the same accelerations.

use crate::restart::Archive;
use std::collections::BTreeMap;

/// What is watched: a kind, and a number of that kind.
pub type Key = (u8, i64);

/// What stands for the state itself: of it only the time is kept.
const STATE: Key = (0, 0);

/// Velocities of what is watched, on the first rank.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Remembered {
    velocities: BTreeMap<Key, (f64, [f64; 3])>,
}

impl Remembered {
    /// The mean acceleration since the state that was kept last, and keeps the present one instead when it is `due`. Zero
    /// where nothing was kept yet.
    ///
    /// A velocity's change over the interval has in it all that happened between: samples of accelerations would not.
    pub fn acceleration(&mut self, key: Key, time: f64, velocity: [f64; 3], due: bool) -> [f64; 3] {
        let last = self.velocities.get(&key).copied();
        if due {
            self.velocities.insert(key, (time, velocity));
        }
        match last {
            Some((then, before)) if time > then => [0, 1, 2].map(|i| (velocity[i] - before[i]) / (time - then)),
            _ => [0.0; 3],
        }
    }

    /// Keeps the time of a state that was due.
    pub fn mark(&mut self, time: f64) {
        self.velocities.insert(STATE, (time, [0.0; 3]));
    }

    /// Time of the last state that was due, on the first rank.
    pub fn since(&self) -> Option<f64> {
        self.velocities.get(&STATE).map(|(time, _)| *time)
    }

    /// Visits what is kept.
    pub(super) fn visit_state(&mut self, archive: &mut dyn Archive) {
        let row =
            |(&(kind, id), &(time, [x, y, z])): (&Key, &(f64, [f64; 3]))| [f64::from(kind), id as f64, time, x, y, z];
        let mut rows = self.velocities.iter().flat_map(row).collect();
        archive.list("HISTORY", 6, &mut rows);
        if archive.loading() {
            let first = archive.comm().rank() == 0;
            let rows = rows.chunks_exact(6).filter(|_| first);
            self.velocities = rows.map(|r| ((r[0] as u8, r[1] as i64), (r[2], [r[3], r[4], r[5]]))).collect();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn accelerations_are_changes_over_the_interval() {
        let mut kept = Remembered::default();
        assert_eq!(kept.acceleration((1, 7), 1.0, [0.0, 1.0, 2.0], true), [0.0; 3]);
        // A state that is not due looks back but leaves no trace.
        assert_eq!(kept.acceleration((1, 7), 1.5, [1.0, 1.0, 1.0], false), [2.0, 0.0, -2.0]);
        assert_eq!(kept.acceleration((1, 7), 3.0, [2.0, 1.0, 0.0], true), [1.0, 0.0, -1.0]);
        assert_eq!(kept.acceleration((1, 7), 3.0, [5.0; 3], true), [0.0; 3]);
    }
}
