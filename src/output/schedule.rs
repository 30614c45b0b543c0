//! When something is due: at the step nearest to each asked time. The time step is never clipped to hit one.

/// Times `start`, `start + interval`, … up to `stop`.
#[derive(Debug, Clone, PartialEq)]
pub struct Schedule {
    start: f64,
    interval: f64,
    stop: f64,
    /// Number of the next time, a whole number.
    next: f64,
}

impl Schedule {
    /// Regular times; without an interval there are none.
    pub fn new(start: f64, interval: Option<f64>, stop: f64) -> Schedule {
        Schedule { start, interval: interval.unwrap_or(f64::INFINITY), stop, next: 0.0 }
    }

    fn next_time(&self) -> f64 {
        if self.next == 0.0 { self.start } else { self.start + self.next * self.interval }
    }

    /// Whether the state at `time`, followed by a step `time_step`, is the nearest to an asked time that has not
    /// been served. Several times within one step are served by one state.
    pub fn due(&mut self, time: f64, time_step: f64) -> bool {
        let reach = time + 0.5 * time_step;
        if self.next_time() > reach || self.next_time() > self.stop {
            return false;
        }
        // The next number is computed, not counted up to: intervals may be far below the time step, or below the
        // resolution of time itself.
        let passed = ((reach - self.start) / self.interval).floor().min(f64::MAX);
        self.next = self.next.max(passed).max(0.0) + 1.0;
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn served(mut schedule: Schedule, step: f64, steps: usize) -> Vec<usize> {
        (0..steps).filter(|&n| schedule.due(n as f64 * step, step)).collect()
    }

    #[test]
    fn serves_the_nearest_step() {
        // Asked 0, 1, 2 with steps of 0.3: nearest states are 0, 0.9 (n = 3) and 2.1 (n = 7).
        assert_eq!(served(Schedule::new(0.0, Some(1.0), 2.5), 0.3, 20), [0, 3, 7]);
    }

    #[test]
    fn serves_every_step_when_asked_more_often_than_steps() {
        assert_eq!(served(Schedule::new(0.0, Some(1e-12), 1.0), 0.25, 4), [0, 1, 2, 3]);
    }

    #[test]
    fn is_not_kept_busy_by_intervals_below_the_resolution_of_time() {
        assert_eq!(served(Schedule::new(0.0, Some(1e-300), 1.0), 0.25, 4), [0, 1, 2, 3]);
        assert_eq!(served(Schedule::new(0.0, Some(5e-324), f64::INFINITY), 1e9, 3), [0, 1, 2]);
    }

    #[test]
    fn keeps_to_start_and_stop_and_to_no_interval() {
        assert_eq!(served(Schedule::new(1.0, Some(1.0), 2.0), 0.5, 20), [2, 4]);
        assert_eq!(served(Schedule::new(0.0, None, 2.0), 0.5, 20), [0]);
    }
}
