//! The end of the step: geometry, frequency, resistance to hourglass modes and corner forces in the new configuration.

use super::exact::{Start, corner_rows};
use super::fluid;
use super::hourglass;
use super::kernel::{Middle, Settings, Slowed, Turned, dot, mode};
use super::kinematics::Flat;
use super::rows;
use super::sections::{Corners, Operator, Section};
use crate::lanes::{Lanes, array};
use crate::material::Kernel;
use crate::model::Hourglass;
use crate::solver::elements::solids::answer::Moduli;
use crate::solver::elements::solids::fluid::acting_step;
use crate::solver::elements::state_rows::{accumulate, store};

/// What is known of the end of the step beside the stress.
pub(super) struct End<'a, V> {
    pub(super) section: Section,
    /// Whether it is the compatible form of a law with an equation of state.
    pub(super) compatible: bool,
    x: &'a [Corners<V>; 2],
    v: &'a [Corners<V>; 2],
    pub(super) operator: Operator<V>,
    /// One over what rates are sums over, and over the area.
    inverses: [V; 2],
    /// Volume of the whole turn, or of a unit of thickness.
    pub(super) volume: V,
    /// Volume over area; of the compatible form the way around at the mean radius.
    pub(super) thickness: V,
    /// Weights of the corners in the compatible form, and the mean radius.
    weights: Option<(Corners<V>, V)>,
    /// One over the mass of the lightest corner.
    lightest: V,
    /// B_iI B_iI
    b_squared: V,
    /// L₂/L₁ and L₁/L₂ along the frame.
    proportions: [V; 2],
    /// γ
    gamma: Corners<V>,
}

/// How fast an element can vibrate, and the step that this leaves.
pub(super) struct Frequency<V> {
    /// Bound of ω² with the elastic modulus, 1/time²; of the compatible form without the hoop.
    square: V,
    /// What the hoop adds to it in the compatible form, 1/time²; it shortens the step alone.
    of_hoop: V,
    /// Dilatational modulus by which the step goes, force/length².
    pub(super) modulus: V,
    /// The stable step without viscosity, a time.
    pub(super) bound: V,
}

impl<V: Lanes> Frequency<V> {
    /// By how much the hoop shortens a step. Where viscosity rules the step, it falls with the square of the frequency.
    #[inline(always)]
    pub(super) fn shorter(&self) -> V {
        self.square / (self.square + self.of_hoop)
    }
}

impl<'a, V: Lanes> End<'a, V> {
    /// From what the corners weigh, one over their masses, which are weighted in the compatible form.
    #[inline(always)]
    pub(super) fn of(
        (section, compatible): (Section, bool),
        [x, v]: [&'a [Corners<V>; 2]; 2],
        operator: Operator<V>,
        frame: &[V; 2],
        inverse_corners: &mut Corners<V>,
    ) -> End<'a, V> {
        let turn = V::splat(section.turn());
        let weights = if compatible { section.weights(x) } else { None };
        if let Some((weights, _)) = &weights {
            *inverse_corners = array![i in 4 => inverse_corners[i] * weights[i]];
        }
        let [a, b, c, d] = *inverse_corners;
        let inverses = section.inverses(&operator);
        let volume = operator.volume * turn;
        let mut thickness = if section.about_axis() { volume * inverses[1] } else { V::splat(1.0) };
        if let Some((_, mean)) = &weights {
            thickness = *mean * turn;
        }
        End {
            section,
            compatible,
            x,
            v,
            inverses,
            volume,
            thickness,
            weights,
            lightest: a.max(b).max(c.max(d)),
            b_squared: dot(&operator.plane[0], &operator.plane[0]) + dot(&operator.plane[1], &operator.plane[1]),
            proportions: proportions(x, frame),
            gamma: hourglass_vector(&operator, x, inverses[1]),
            operator,
        }
    }

    /// B_iI B_iI / A
    #[inline(always)]
    fn measure(&self) -> V {
        self.b_squared * self.inverses[1]
    }

    /// The bound of the frequency. `moving` is what the corners have to move, a mass.
    #[inline(always)]
    pub(super) fn frequency(
        &self,
        moduli: &Moduli<V>,
        inverse_corners: &Corners<V>,
        moving: V,
        settings: &Settings,
    ) -> Frequency<V> {
        let (zero, one) = (V::splat(0.0), V::splat(1.0));
        let End { operator, thickness, lightest, gamma, .. } = self;
        let [inverse_measure, inverse_area] = self.inverses;
        let elastic = moduli.elastic;
        let mut square =
            frequency_square(self.section, operator, inverse_corners, [elastic, moduli.shear]) * inverse_measure;
        let mut of_hoop = zero;
        if self.compatible {
            square = square * *thickness;
            // It shortens the step alone: a viscosity that knew of it would be another at every angle of a sphere.
            let hoop = operator.hoop[0] * operator.hoop[0] * inverse_area * *thickness;
            of_hoop = elastic
                * hoop
                * ((inverse_corners[0] + inverse_corners[1]) + (inverse_corners[2] + inverse_corners[3]));
        }
        // Hourglass and strain modes are orthogonal only where corners weigh alike and the element is a parallelogram: near the
        // axis the whole resistance counts, and in warped elements what the hourglass vector has across (1, −1, 1, −1).
        let of_modes =
            hourglass::stiffness(settings.control, moduli.shear, settings.poisson, &self.proportions, self.measure());
        let stiffness = of_modes * *thickness;
        let across = (dot(gamma, gamma) - V::splat(4.0)).max(zero);
        square = square + stiffness * (across + V::splat(2.0) * across.sqrt()) * *lightest;
        if self.section.about_axis() {
            // Three times what the heaviest quarter has beyond the lightest corner.
            let uneven = (*lightest * moving * V::splat(0.75) - V::splat(3.0)).max(zero).min(one);
            let squares: Corners<V> = array![i in 4 => gamma[i] * gamma[i]];
            square = square + uneven * stiffness * dot(&squares, inverse_corners);
        }
        let bound = (V::splat(4.0) * elastic / (square * moduli.step)).sqrt();
        Frequency { square, of_hoop, modulus: moduli.step, bound }
    }

    /// Slows the modes of a fluid and holds its corners: the resistance in space, and what holding means.
    #[inline(always)]
    pub(super) fn resist_as_fluid<K: Kernel>(
        &self,
        (start, slowed): (&Start<V>, &Slowed<V>),
        state: &mut [V::Row],
        part: usize,
        settings: &Settings,
    ) -> ([V; 2], fluid::Held<V>) {
        let End { x, v, gamma, .. } = self;
        let (heavy, time_step) = (V::splat(4.0) / self.lightest, V::splat(settings.time_step));
        // What slows the modes of the plane works on weighted ones.
        let rates = if self.compatible { [dot(gamma, &v[0]), dot(gamma, &v[1])] } else { start.flow.hourglass };
        // As strongly as where all of the viscosity acts: a limiter sees no modes.
        let step = acting_step(slowed.least_step, time_step);
        let resistance = fluid::resistance(&rates, hourglass::of_fluids(settings.control), heavy, step);
        store(resistance, state, rows::HOURGLASS, part);
        let sizes = [self.operator.area, heavy, slowed.stable_step, time_step, self.b_squared];
        let (taken, weights) = (start.taken(&*state, part), self.weights.as_ref());
        let held = fluid::hold([x, v], &mut state[corner_rows::<K>()], part, sizes, taken, weights);
        (resistance, held)
    }

    /// Resists the modes of a solid and books the energy: the resistance in space, and the stable step with it. Given are the shear
    /// modulus, the return of the law and the stable step without.
    #[inline(always)]
    pub(super) fn resist_as_solid(
        &self,
        (middle, turned): (&Middle<V>, &Turned<V>),
        [mu, returned, without]: [V; 3],
        state: &mut [V::Row],
        part: usize,
        settings: &Settings,
    ) -> ([V; 2], V) {
        let modes = hourglass::State {
            proportions: self.proportions,
            stiffness_measure: self.measure(),
            lightest: [self.lightest, self.thickness],
            mu,
            poisson: settings.poisson,
            returned,
            time_step: V::splat(settings.time_step),
        };
        let rates = [middle.hourglass_rate(), &middle.worked_rate];
        let resistance = resist(settings.control, rates, turned.frames, (state, part), middle.thickness, &modes);
        (resistance, hourglass::stable_step(settings.control, without, &modes))
    }

    /// Corner forces from the stress in space, with viscosity, and the resistance of the modes.
    #[inline(always)]
    pub(super) fn forces(self, total: &Flat<V>, resistance: &[V; 2], lever: V) -> [Corners<V>; 3] {
        let End { section, operator, x, gamma, weights, .. } = self;
        let gamma = match &weights {
            Some((weights, _)) => array![i in 4 => gamma[i] * weights[i]],
            None => gamma,
        };
        forces(section, total, resistance, &section.of_forces(operator, x), &gamma, lever)
    }
}

/// A bound of ω² times the measure of rates: the trace of the corners' scaled stiffness,
/// Σ_I [λ (V_x² + V_y²) + 2μ (G² + H² + V_y²)]_I/m_I; of the others, and per thickness in the compatible form,
/// (λ + 2μ) Σ_I (B_x² + B_y²)_I/m_I.
#[inline(always)]
fn frequency_square<V: Lanes>(
    section: Section,
    operator: &Operator<V>,
    inverse_mass: &Corners<V>,
    [dilatational, mu]: [V; 2],
) -> V {
    let two_mu = mu + mu;
    let Operator { radial, axial, hoop, .. } = operator;
    if section != Section::Axisymmetric {
        let squares: Corners<V> = array![i in 4 => radial[i] * radial[i] + axial[i] * axial[i]];
        return dilatational * dot(&squares, inverse_mass);
    }
    let lambda = (dilatational - two_mu).max(V::splat(0.0));
    let terms: Corners<V> = array![i in 4 => {
        let (whole, axial2) = (radial[i] + hoop[i], axial[i] * axial[i]);
        lambda * (whole * whole + axial2) + two_mu * ((radial[i] * radial[i] + hoop[i] * hoop[i]) + axial2)
    }];
    dot(&terms, inverse_mass) * V::splat(section.turn())
}

/// Λ₁ · x with Λ₁ = (−1, 1, 1, −1).
#[inline(always)]
fn xi<V: Lanes>(x: &Corners<V>) -> V {
    (x[1] - x[0]) + (x[2] - x[3])
}

/// Λ₂ · x with Λ₂ = (−1, −1, 1, 1).
#[inline(always)]
fn eta<V: Lanes>(x: &Corners<V>) -> V {
    (x[3] - x[0]) + (x[2] - x[1])
}

/// L₂/L₁ and L₁/L₂ of the element's lengths L_i = Λ_i · x̂_i along its frame, kept positive in elements that have folded over.
#[inline(always)]
fn proportions<V: Lanes>(x: &[Corners<V>; 2], [c, s]: &[V; 2]) -> [V; 2] {
    let [xi, eta] = [[xi(&x[0]), xi(&x[1])], [eta(&x[0]), eta(&x[1])]];
    let (l1, l2) = (xi[0] * *c + xi[1] * *s, eta[1] * *c - eta[0] * *s);
    let floor = l1.max(l2) * V::splat(1e-3);
    let (l1, l2) = (l1.max(floor), l2.max(floor));
    let inverse = V::splat(1.0) / (l1 * l2);
    [l2 * l2 * inverse, l1 * l1 * inverse]
}

/// Turns the rates, and those on which the resistance works, into the frame of the middle, lets the control act, books the energy,
/// and turns the resistance back by the frame of the end.
#[inline(always)]
fn resist<V: Lanes>(
    control: Hourglass,
    [rate, worked]: [&[V; 2]; 2],
    [[cm, sm], [c, s]]: [[V; 2]; 2],
    (own, part): (&mut [V::Row], usize),
    thickness: V,
    state: &hourglass::State<V>,
) -> [V; 2] {
    let local = [cm * rate[0] + sm * rate[1], cm * rate[1] - sm * rate[0]];
    let worked = [cm * worked[0] + sm * worked[1], cm * worked[1] - sm * worked[0]];
    let old = [V::load(&own[rows::HOURGLASS], part), V::load(&own[rows::HOURGLASS + 1], part)];
    let mut q = old;
    let total = hourglass::resist(control, &local, &mut q, state);
    store(q, own, rows::HOURGLASS, part);
    let half = V::splat(0.5);
    // Stored resistance by the trapezoidal rule, a viscous rest as it acts now.
    let work = (total[0] + (old[0] - q[0]) * half) * worked[0] + (total[1] + (old[1] - q[1]) * half) * worked[1];
    accumulate(work * state.time_step * thickness, &mut own[rows::HOURGLASS_ENERGY], part);
    [c * total[0] - s * total[1], s * total[0] + c * total[1]]
}

/// γ = Γ − B_j (x_j·Γ)/A: the hourglass mode made orthogonal to linear fields.
#[inline(always)]
pub(super) fn hourglass_vector<V: Lanes>(operator: &Operator<V>, x: &[Corners<V>; 2], inverse_area: V) -> Corners<V> {
    let [bx, by] = &operator.plane;
    let (hx, hy) = (mode(&x[0]) * inverse_area, mode(&x[1]) * inverse_area);
    array![i in 4 => {
        let one = V::splat(if i.is_multiple_of(2) { 1.0 } else { -1.0 });
        one - (bx[i] * hx + by[i] * hy)
    }]
}

/// f_x = σ_r G + τ V_y + σ_θ H, f_y = τ G + σ_z V_y, and Q_i γ times the thickness.
#[inline(always)]
fn forces<V: Lanes>(
    section: Section,
    [xx, yy, zz, xy]: &Flat<V>,
    q: &[V; 2],
    operator: &Operator<V>,
    gamma: &Corners<V>,
    thickness: V,
) -> [Corners<V>; 3] {
    let turn = V::splat(section.turn());
    let (xx, yy, zz, xy) = (*xx * turn, *yy * turn, *zz * turn, *xy * turn);
    let q = [q[0] * thickness, q[1] * thickness];
    let Operator { radial, axial, hoop, .. } = operator;
    [
        array![i in 4 => {
            let f = xx * radial[i] + xy * axial[i] + q[0] * gamma[i];
            if section.about_axis() { f + zz * hoop[i] } else { f }
        }],
        array![i in 4 => xy * radial[i] + yy * axial[i] + q[1] * gamma[i]],
        [V::splat(0.0); 4],
    ]
}
