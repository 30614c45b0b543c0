//! What elements of fluids share in the plane and in space: how strongly hourglass modes are slowed and closing corners are held,
//! and how far a volume may change in a step.

use crate::lanes::Lanes;

/// Part α by which an hourglass mode is slowed in a stable step of its element.
pub const SLOWED: f64 = 0.9;

/// A volume may grow, and shrink, by this part of itself in a step.
const LARGEST_GROWTH: f64 = 0.1;
const LARGEST_SHRINKAGE: f64 = 0.2;

/// A corner is held when its Jacobian is below this part of the volume.
const CLOSE: f64 = 0.3;

/// Strength of the brake on a closing corner, and of what brings one back, at a Jacobian of zero. They are those of an
/// element alone; its neighbours make nodes eight times as heavy.
const BRAKE: f64 = 20.0;
/// See [`BRAKE`].
const BACK: f64 = 100.0;

/// By how much the stable step is shortened by them.
const SHORTER: f64 = 12.0;

/// A corner may close by this part of its Jacobian in a step, or of a tenth of the volume where it is less.
const LARGEST_CLOSING: f64 = 0.5;
/// See [`LARGEST_CLOSING`].
const LEAST_ROOM: f64 = 0.1;

/// The areas of a corner do not count as less than this part of B:B, that a flat corner is not given a boundless force.
const LEAST_REACH: f64 = 0.05;

/// The largest step in which a volume that grows at `rate` times itself does so by no more than it may; `otherwise` where that
/// is smaller, or no number.
#[inline(always)]
pub fn gentle_step<V: Lanes>(rate: V, otherwise: V) -> V {
    let tiny = V::splat(V::TINY);
    let growing = V::splat(LARGEST_GROWTH) / rate.max(tiny);
    let shrinking = V::splat(LARGEST_SHRINKAGE) / (-rate).max(tiny);
    // In this order a NaN stays.
    growing.min(shrinking).min(otherwise)
}

/// The step in which forces of this state may be measured: they act over the mean Δt̄ of the `last` step and the next, and the next is
/// no longer than the `stable` one. Where the stable step falls at once to a part of the last one, a force that slows a motion
/// in the stable step would turn it round in Δt̄, and give what it never took.
#[inline(always)]
pub fn acting_step<V: Lanes>(stable: V, last: V) -> V {
    // In this order a NaN stays.
    ((last + stable) * V::splat(0.5)).max(stable)
}

/// A neighbour's rate may be this many times smaller than the element's own before viscosity acts in full: see [`jump`].
const STEEPEST: f64 = 2.0;

/// The part 1 − ψ of bulk viscosity that acts: 0 where the rate of the volume goes on evenly from element to element, 1 where it
/// jumps. With the ratios r of both neighbours' rates to the own one, ψ = max(0, min(1, (r₋ + r₊)/2, 2 r₋, 2 r₊)), and the least of
/// it over the directions counts (Christensen 1991; Benson 1992; Caramana, Shashkov and Whalen 1998). `last` and `means` belong to
/// the last pass; `means` are those over pairs of opposite faces, half of which is the element's own, so that r = 2 mean/last − 1.
/// Where the rate is larger `now`, ψ is smaller by as much: what acts would else depend on how near to nothing the last one was.
#[inline(always)]
pub fn jump<V: Lanes>([last, now]: [V; 2], means: &[[V; 2]]) -> V {
    let (zero, one, two) = (V::splat(0.0), V::splat(1.0), V::splat(2.0));
    let (half, steepest) = (V::splat(0.5), V::splat(STEEPEST));
    let sign = V::select_less(last, zero, -one, one);
    let size = last * sign;
    let mut even = size;
    for pair in means {
        let [a, b] = pair.map(|mean| (two * mean - last) * sign);
        even = even.min((a + b) * half).min(a * steepest).min(b * steepest);
    }
    // A rate of nothing jumps; where one is no number, viscosity acts.
    one - even.max(zero) / size.max(now.max(-now)).max(V::splat(V::TINY))
}

/// What holds the corners of an element, and what that costs its stable step.
pub struct Brake<V> {
    volume: V,
    mass: V,
    steps: [V; 2],
    start: V,
    inverse: V,
    least_reach: V,
    most: V,
    closing: V,
}

impl<V: Lanes> Brake<V> {
    /// Of an element with this volume, mass at a corner, stable step, last step and B_iI B_iI.
    #[inline(always)]
    pub fn new([volume, mass, stable_step, last_step, b_squared]: [V; 5]) -> Brake<V> {
        let (zero, one) = (V::splat(0.0), V::splat(1.0));
        Brake {
            volume,
            mass,
            steps: [stable_step, last_step],
            start: V::splat(CLOSE) * volume,
            inverse: one / (volume * V::splat(CLOSE)),
            least_reach: b_squared * V::splat(LEAST_REACH),
            most: zero,
            closing: zero,
        }
    }

    /// Force Λ on the Jacobian of a corner, given its rate and `reach`, the sum of the squares of its derivatives; and the energy that
    /// it would give to the motion in the step in which it acts, at most.
    #[inline(always)]
    pub fn force(&mut self, jacobian: V, rate: V, reach: V) -> [V; 2] {
        let zero = V::splat(0.0);
        let missing = (self.start - jacobian).max(zero);
        let weight = (missing * self.inverse).min(V::splat(1.0));
        self.most = weight.max(self.most);
        let [stable, last] = self.steps;
        // The next step is at most `stable` over `shorter`, and the forces are measured in steps that are longer by as much.
        let shorter = V::splat(1.0) + V::splat(SHORTER) * weight;
        let acting = acting_step(stable, last * shorter);
        let inverse_step = V::splat(1.0) / acting;
        let brake = rate.min(zero) * V::splat(BRAKE);
        let back = missing * inverse_step * V::splat(BACK);
        let reach = reach.max(self.least_reach);
        let force = weight * (brake - back) * (self.mass * inverse_step) / reach;
        let room = jacobian.max(self.volume * V::splat(LEAST_ROOM));
        self.closing = (-(rate / room)).max(self.closing);
        // A zero has the sign that it has where no lane came here.
        let force = force + zero;
        let impulse = -force * (acting / shorter);
        let mean_rate = rate + V::splat(0.5) * impulse * (reach / self.mass);
        [force, impulse * mean_rate.max(zero)]
    }

    /// The stable step with the forces that have been found.
    #[inline(always)]
    pub fn stable_step(&self, without: V) -> V {
        let limit = V::splat(LARGEST_CLOSING) / self.closing.max(V::splat(V::TINY));
        let slower = without / (V::splat(1.0) + V::splat(SHORTER) * self.most);
        // In this order a NaN of the element's own step stays.
        V::select_less(V::splat(0.0), self.most, limit.min(slower), without)
    }
}

/// The part of forces that would give energy which may act: they give what was `taken` before, and no more.
#[inline(always)]
pub fn affordable<V: Lanes>(taken: V, given: V) -> V {
    // In this order a NaN stays.
    (taken.max(V::splat(0.0)) / given.max(V::splat(V::TINY))).min(V::splat(1.0))
}

/// Whether a row has a number below the start of the resistance in this part.
#[inline(always)]
pub fn any_close<V: Lanes>(row: &V::Row, part: usize) -> bool {
    V::any_less(V::load(row, part), V::splat(CLOSE))
}

#[cfg(test)]
mod tests {
    use super::jump;

    /// In one direction, given the rates of the element and of its neighbours.
    fn between(own: f64, [left, right]: [f64; 2]) -> f64 {
        jump([own, own], &[[0.5 * (own + left), 0.5 * (own + right)]])
    }

    #[test]
    fn viscosity_acts_where_rates_jump() {
        // Even flow: nothing acts, in compression and in expansion.
        for own in [-3.0, 2.0] {
            assert_eq!(between(own, [own, own]), 0.0);
            assert_eq!(between(own, [0.75 * own, 1.25 * own]), 0.0);
            assert_eq!(between(own, [0.5 * own, own]), 0.25);
            // The foot and the top of a front, and what rings.
            assert_eq!(between(own, [0.0, 4.0 * own]), 1.0);
            assert_eq!(between(own, [0.0, 0.0]), 1.0);
            assert_eq!(between(own, [-own, -own]), 1.0);
        }
        assert_eq!(between(0.0, [1.0, 1.0]), 1.0);
        assert_eq!(between(f64::NAN, [1.0, 1.0]), 1.0);
        // Directions: the least even one counts. A rate that has doubled since: half of it acts.
        assert_eq!(jump([1.0, 1.0], &[[1.0, 1.0], [0.5, 0.5]]), 1.0);
        assert_eq!(jump([1.0, 2.0], &[[1.0, 1.0]]), 0.5);
        assert_eq!(jump([1.0, -2.0], &[[1.0, 1.0]]), 0.5);
    }
}
