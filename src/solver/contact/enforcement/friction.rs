//! Coulomb friction whose coefficient falls with the speed of sliding.

use crate::common::vector::dot;
use crate::model::Friction;

impl Friction {
    /// One coefficient at all speeds.
    pub fn constant(coefficient: f64) -> Friction {
        Friction { at_rest: coefficient, high_speed: coefficient, decay: 0.0 }
    }

    /// Whether there is any.
    pub fn is_some(&self) -> bool {
        self.at_rest > 0.0 || (self.high_speed > 0.0 && self.decay > 0.0)
    }

    /// Coefficient at a velocity of sliding: μ(v) = μ_high + (μ_static − μ_high) exp(−decay |v|).
    pub fn coefficient(&self, slip: [f64; 3]) -> f64 {
        if self.decay == 0.0 {
            return self.at_rest;
        }
        let speed = dot(slip, slip).sqrt();
        self.high_speed + (self.at_rest - self.high_speed) * libm::exp(-self.decay * speed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_coefficient_falls_from_rest_to_high_speed() {
        let friction = Friction { at_rest: 0.5, high_speed: 0.2, decay: 2.0 };
        assert_eq!(friction.coefficient([0.0; 3]), 0.5);
        // 0.2 + 0.3/e at v = 0.5.
        assert!((friction.coefficient([0.3, 0.4, 0.0]) - 0.310_363_832_351_432_7).abs() < 1e-15);
        assert!((friction.coefficient([1e3, 0.0, 0.0]) - 0.2).abs() < 1e-15);
        assert_eq!(Friction::constant(0.3).coefficient([7.0, 0.0, 0.0]), 0.3);
    }
}
