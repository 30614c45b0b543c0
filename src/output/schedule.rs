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
        self.time_of(self.next)
    }

    fn time_of(&self, number: f64) -> f64 {
        if number == 0.0 { self.start } else { self.start + number * self.interval }
    }

    /// Goes on behind the state at `time`, followed by a step `time_step`: what that state served, or one before it, is not
    /// due again.
    pub fn pass(&mut self, time: f64, time_step: f64) {
        let reach = time + 0.5 * time_step;
        self.next = if self.time_of(0.0) <= reach { self.first_beyond(reach) } else { 0.0 };
    }

    /// Whether the state at `time`, followed by a step `time_step`, is the nearest to an asked time that has not
    /// been served. Several times within one step are served by one state.
    pub fn due(&mut self, time: f64, time_step: f64) -> bool {
        let reach = time + 0.5 * time_step;
        if self.next_time() > reach || self.next_time() > self.stop {
            return false;
        }
        self.next = self.first_beyond(reach);
        true
    }

    /// Number of the first time beyond `reach`, which is not before the start. It is computed, not counted up to:
    /// intervals may be far below the time step, or below the resolution of time itself.
    fn first_beyond(&self, reach: f64) -> f64 {
        let number = ((reach - self.start) / self.interval).floor().min(f64::MAX);
        // The quotient may be rounded across a whole number; who has served what must not hang on that.
        if self.time_of(number) > reach {
            number.max(1.0)
        } else if self.time_of(number + 1.0) > reach {
            number + 1.0
        } else {
            number + 2.0
        }
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
    fn a_schedule_that_passes_a_state_is_due_when_one_is_that_never_stopped() {
        // Steps and intervals whose multiples are rounded now up, now down.
        for (step, interval, start) in [(0.1, 0.3, 0.0), (0.1, 0.1, 0.1), (0.07, 0.01, 1.0), (0.3, 1.1, 0.9)] {
            let new = || Schedule::new(start, Some(interval), f64::INFINITY);
            let whole: Vec<bool> = {
                let mut schedule = new();
                (0..200).map(|n| schedule.due(f64::from(n) * step, step)).collect()
            };
            for stop in 1..200 {
                let mut schedule = new();
                schedule.pass(f64::from(stop - 1) * step, step);
                let rest: Vec<bool> = (stop..200).map(|n| schedule.due(f64::from(n) * step, step)).collect();
                assert_eq!(rest, whole[stop as usize..], "stopped before state {stop}");
            }
        }
    }

    #[test]
    fn keeps_to_start_and_stop_and_to_no_interval() {
        assert_eq!(served(Schedule::new(1.0, Some(1.0), 2.0), 0.5, 20), [2, 4]);
        assert_eq!(served(Schedule::new(0.0, None, 2.0), 0.5, 20), [0]);
    }
}
