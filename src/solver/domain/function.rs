//! Piecewise linear functions of time.

use crate::model::Function;

impl Function {
    /// Value at time `t`: linear between points, constant before the first and after the last.
    pub fn value(&self, t: f64) -> f64 {
        let after = self.points.partition_point(|p| p.0 <= t);
        if after == 0 {
            return self.points.first().map_or(0.0, |p| p.1);
        }
        let (t0, f0) = self.points[after - 1];
        match self.points.get(after) {
            Some(&(t1, f1)) => f0 + (f1 - f0) * ((t - t0) / (t1 - t0)),
            None => f0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_linear_between_points_and_constant_outside() {
        let f = Function { id: 1, points: vec![(0.0, 1.0), (2.0, 5.0), (4.0, 5.0)] };
        assert_eq!([-1.0, 0.0, 1.0, 2.0, 3.0, 9.0].map(|t| f.value(t)), [1.0, 1.0, 3.0, 5.0, 5.0, 5.0]);
    }
}
