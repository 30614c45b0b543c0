//! Corners of solids: a potential of their Jacobians over the initial volume, which no finite energy turns inside out or presses to
//! nothing. It acts in extremis only, so it is computed element by element, in double precision whatever the block has.

use super::geometry::{self, Gradient, Modes, gradient, modes};
use crate::mesh::check::hexahedron_volume;
use crate::mesh::corners::NEIGHBOURS;
use crate::vector::{cross, dot, subtract};

/// Positions or velocities of the corners, relative to the first one.
pub type Points = [[f64; 3]; 8];

/// The potential begins where a Jacobian falls below this part of the initial volume.
const START: f64 = 0.15;

/// Its strength, in moduli λ + 2μ.
const STRENGTH: f64 = 0.25;

/// Below this part of [`START`] it goes on with constant stiffness: what has jumped through is brought back.
const FLOOR: f64 = 0.01;

/// A held corner may close by this part of its Jacobian in a step, or of [`LEAST_ROOM`] where that is more.
const LARGEST_CLOSING: f64 = 0.5;

/// See [`LARGEST_CLOSING`]; a part of where the potential begins.
const LEAST_ROOM: f64 = 0.1;

/// Corners of a mesh whose Jacobians are below this part of the volume belong to elements that are left alone.
const SOUND: f64 = 2.0 * START;

/// What is to be known of an element.
pub struct Solid {
    /// Corners that have an edge of no length, since two are one node, are not held.
    pub whole: [bool; 8],
    /// Volume at the start.
    pub volume: f64,
    /// Eight times the mass of the lightest corner.
    pub mass: f64,
    /// Dilatational modulus λ + 2μ.
    pub modulus: f64,
    /// Step that led to the present positions, and that in which the forces before them acted.
    pub steps: [f64; 2],
    /// Stable step without held corners.
    pub stable_step: f64,
}

/// What holding corners means.
pub struct Held {
    /// Internal forces on the corners.
    pub force: Points,
    /// What they have taken from the motion since the last positions.
    pub work: f64,
    /// The stable step with them.
    pub stable_step: f64,
}

/// Which corners of an element have three edges.
pub fn whole(nodes: &[u32; 8]) -> [bool; 8] {
    std::array::from_fn(|corner| NEIGHBOURS[corner].iter().all(|&to| nodes[to] != nodes[corner]))
}

/// Whether the corners of an element are far enough from closing in its mesh.
pub fn are_sound(nodes: &[u32; 8], x: &Points) -> bool {
    let (whole, volume) = (whole(nodes), hexahedron_volume(x));
    (0..8).all(|corner| !whole[corner] || Corner::of(x, corner).jacobian >= SOUND * volume)
}

/// How far corners may move relative to each other, along a path of that length, before one is held; not positive where one is.
pub fn room(whole: &[bool; 8], x: &Points, volume: f64) -> f64 {
    let start = START * volume;
    // Rounded sums of motions must not end beyond it.
    let start = start + 1e-6 * start;
    let mut least = f64::INFINITY;
    for corner in (0..8).filter(|&corner| whole[corner]) {
        let c = Corner::of(x, corner);
        let left = c.jacobian - start;
        if left.is_nan() || left <= 0.0 {
            return 0.0;
        }
        // Edges that change by d change the Jacobian by no more than d A + d² L + d³.
        let areas: f64 = (3.0 * c.areas.iter().map(|a| dot(*a, *a)).sum::<f64>()).sqrt();
        let lengths: f64 = (3.0 * c.edges.iter().map(|e| dot(*e, *e)).sum::<f64>()).sqrt();
        let most = left / areas;
        least = least.min(left / (areas + most * (lengths + most)));
    }
    least.min(Whole::of(x).room(start))
}

/// The volume of an element, which can vanish while all its corners are open: 192 V is 3 D(ξ, η, ζ) + D(ξ, ξη, ζξ) + D(η, ηζ, ξη) +
/// D(ζ, ζξ, ηζ), D the determinant of three modes.
struct Whole {
    modes: [Modes<f64>; 3],
    operator: Gradient<f64>,
    volume: f64,
}

impl Whole {
    fn of(x: &Points) -> Whole {
        let modes = [0, 1, 2].map(|i| modes(&x.map(|x| x[i])));
        let operator = gradient(&modes);
        let volume = operator.volume192 / 192.0;
        Whole { modes, operator, volume }
    }

    /// Σ of the squares of the modes that it depends on.
    fn squares(&self) -> f64 {
        self.modes.iter().flat_map(|modes| &modes[..6]).map(|mode| mode * mode).sum()
    }

    /// How far corners may move relative to each other before the volume is below `start`; not positive where it is.
    fn room(&self, start: f64) -> f64 {
        let left = self.volume - start;
        if left.is_nan() || left <= 0.0 {
            return 0.0;
        }
        // A mode is four edges, with signs: edges that change by d change it by no more than 4 d, and determinants of three lengths L
        // by 3 (L + 4 d)³ − 3 L³ at most, together six of them over 192.
        let length = self.squares().sqrt();
        let least = |d: f64| (12.0 * length + 48.0 * d) * length + 64.0 * d * d;
        let most = 32.0 * left / (12.0 * length * length);
        32.0 * left / least(most)
    }

    /// Derivatives of the volume by the positions of the corners.
    fn derivatives(&self) -> Points {
        let by_axis = self.operator.g24.map(|g| geometry::corners(&[g[0], g[1], g[2], g[3], g[4], g[5], 0.0]));
        std::array::from_fn(|n| [0, 1, 2].map(|i| by_axis[i][n] / 192.0))
    }

    /// As [`Corner::stiffness`]: of the determinants each mode is in four at most, and the squares of modes are eight times those of
    /// corners.
    fn stiffness(&self, [first, second]: [f64; 2]) -> f64 {
        let squares = self.operator.square4608() / 4608.0;
        second * squares + first.abs() * (4.0 / 3.0 * self.squares()).sqrt() / 6.0
    }
}

/// The Jacobian of a corner, e₁·(e₂ × e₃) of its edges, and its derivatives by them.
struct Corner {
    edges: [[f64; 3]; 3],
    areas: [[f64; 3]; 3],
    jacobian: f64,
}

impl Corner {
    fn of(x: &Points, corner: usize) -> Corner {
        let edges = NEIGHBOURS[corner].map(|to| subtract(x[to], x[corner]));
        let [e1, e2, e3] = edges;
        let areas = [cross(e2, e3), cross(e3, e1), cross(e1, e2)];
        Corner { edges, areas, jacobian: dot(e1, areas[0]) }
    }

    /// Derivative by the position of the corner itself.
    fn own(&self) -> [f64; 3] {
        let [a, b, c] = &self.areas;
        std::array::from_fn(|i| -(a[i] + b[i] + c[i]))
    }

    /// Its rate.
    fn rate(&self, v: &Points, corner: usize) -> f64 {
        let to = NEIGHBOURS[corner];
        (0..3).map(|k| dot(self.areas[k], subtract(v[to[k]], v[corner]))).sum()
    }

    /// A bound of the largest eigenvalue of the second derivatives of the potential by the positions, given its first two by the
    /// Jacobian. Those of the Jacobian have none beyond 4 √(4/3 Σ e²): 2 Σ e_i·(δ_j × δ_k) of the edges' changes δ is at most √(4/3 Σ e²) Σ δ²,
    /// and Σ δ² at most four times the sum of the squares of the corners' motions.
    fn stiffness(&self, [first, second]: [f64; 2]) -> f64 {
        let own = self.own();
        let squares: f64 = self.areas.iter().map(|a| dot(*a, *a)).sum::<f64>() + dot(own, own);
        let lengths: f64 = self.edges.iter().map(|e| dot(*e, *e)).sum();
        second * squares + first.abs() * 4.0 * (4.0 / 3.0 * lengths).sqrt()
    }
}

/// f = 1/3u − 1 + u − u²/3: its first and second derivatives, which vanish at u = 1. Below [`FLOOR`] the second stays as it is there.
fn slopes(u: f64) -> [f64; 2] {
    let at = u.max(FLOOR);
    let inverse = 1.0 / at;
    let second = 2.0 / 3.0 * (inverse * inverse * inverse - 1.0);
    let first = 1.0 - 2.0 / 3.0 * at - inverse * inverse / 3.0;
    [first + second * (u - at), second]
}

impl Solid {
    /// Derivatives of the potential by the Jacobian of a corner; `None` where it does not act.
    fn slopes(&self, jacobian: f64) -> Option<[f64; 2]> {
        let start = START * self.volume;
        let u = jacobian / start;
        // The potential of a corner is k (λ+2μ) V₀/8 f(J/sV₀).
        let scale = STRENGTH * self.modulus * self.volume / (8.0 * start);
        (u < 1.0).then(|| slopes(u)).map(|[first, second]| [scale * first, scale * second / start])
    }

    /// Internal forces at these positions, and a bound of the largest eigenvalue of their derivatives; `None` where nothing acts.
    fn forces(&self, x: &Points) -> Option<(Points, f64)> {
        let mut found: Option<(Points, f64)> = None;
        for corner in (0..8).filter(|&corner| self.whole[corner]) {
            let c = Corner::of(x, corner);
            let Some(slopes) = self.slopes(c.jacobian) else { continue };
            let (force, stiffness) = found.get_or_insert(([[0.0; 3]; 8], 0.0));
            *stiffness += c.stiffness(slopes);
            let own = c.own();
            for i in 0..3 {
                force[corner][i] += slopes[0] * own[i];
                for (to, area) in NEIGHBOURS[corner].iter().zip(&c.areas) {
                    force[*to][i] += slopes[0] * area[i];
                }
            }
        }
        let whole = Whole::of(x);
        if let Some([first, second]) = self.slopes(whole.volume) {
            // As strong as eight corners.
            let slopes = [8.0 * first, 8.0 * second];
            let (force, stiffness) = found.get_or_insert(([[0.0; 3]; 8], 0.0));
            *stiffness += whole.stiffness(slopes);
            for (sum, by) in force.iter_mut().zip(whole.derivatives()) {
                (0..3).for_each(|i| sum[i] += slopes[0] * by[i]);
            }
        }
        found
    }

    /// The step in which no held corner closes by more than it may.
    fn closing_step(&self, x: &Points, v: &Points) -> f64 {
        let start = START * self.volume;
        let mut longest = f64::INFINITY;
        for corner in (0..8).filter(|&corner| self.whole[corner]) {
            let c = Corner::of(x, corner);
            let closing = -c.rate(v, corner);
            if c.jacobian < start && closing > 0.0 {
                longest = longest.min(LARGEST_CLOSING * c.jacobian.max(LEAST_ROOM * start) / closing);
            }
        }
        longest
    }

    /// Holds its corners; `None` where none is to be held, now or a step ago.
    pub fn hold(&self, x: &Points, v: &Points) -> Option<Held> {
        let [last, kick] = self.steps;
        let before: Points = std::array::from_fn(|n| std::array::from_fn(|i| x[n][i] - last * v[n][i]));
        let (then, now) = (self.forces(&before), self.forces(x));
        if then.is_none() && now.is_none() {
            return None;
        }
        let power = |force: &Points| force.iter().zip(v).map(|(f, v)| dot(*f, *v)).sum::<f64>();
        let work = 0.5 * (kick * then.map_or(0.0, |(force, _)| power(&force)));
        let Some((force, stiffness)) = now else {
            return Some(Held { force: [[0.0; 3]; 8], work, stable_step: self.stable_step });
        };
        // With the element's own bound Δt, damped or not, 4/Δt² · Δt/Δt' + K/m ≤ 4/Δt'² is enough.
        let share = 2.0 * stiffness / self.mass * self.stable_step * self.stable_step;
        let stable_step = self.stable_step * 2.0 / (1.0 + (1.0 + 4.0 * share).sqrt());
        Some(Held {
            force,
            work: work + 0.5 * last * power(&force),
            stable_step: stable_step.min(self.closing_step(x, v)),
        })
    }
}
