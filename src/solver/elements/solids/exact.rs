//! Accounts of elements with an equation of state: the work of their corner forces, exactly as the nodes feel it.
//!
//! Central differences change the kinetic energy ½ m v⁻·v⁺ between two states by v·½ (Δt̄ₙ fₙ + Δt̄ₙ₊₁ fₙ₊₁), where v is the
//! velocity between them and Δt̄ the mean of the steps before and after a state. That much, with its sign turned, is booked,
//! whatever the steps do: forces of both states with the velocities of the one step, at the geometry where they acted. Δt̄ₙ₊₁
//! is not known when fₙ₊₁ is; Δtₙ stands in for it, and the power that was booked so is kept to make good in the next step.

use crate::lanes::Lanes;
use crate::material::Kernel;
use crate::solver::elements::state_rows::{accumulate, accumulate_carried};

/// Work or power of stress, bulk viscosity and, in fluids, hourglass resistance and held corners.
pub type Works<V> = [V; 3];

/// Where an element keeps its accounts.
pub struct AccountRows {
    /// Rows in the order of [`Works`].
    pub accounts: [usize; 3],
    /// First row of the law.
    pub law: usize,
    /// In single precision: where the accounts keep what their sums lose, from the end of the law's rows.
    pub carried: [usize; 3],
}

/// The step that is booked.
#[derive(Debug, Clone, Copy)]
pub struct Steps {
    /// Δt
    pub time_step: f64,
    /// Mean of that step and the one before it.
    pub kick: f64,
}

/// Powers of the forces of a step's start, with the velocities of the step, where they acted.
pub struct StartPowers<V> {
    /// Of the stress.
    pub stress: V,
    /// Bulk viscosity, force/length², and what multiplies it: the rate of the volume.
    pub viscous: [V; 2],
    /// Of hourglass resistance and held corners.
    pub modes: V,
}

/// What is known of a step's work before the law has found its stress. `F` is how an element tells its flow.
pub struct Start<V, F> {
    /// Energy of the element but for the work of the stress at the end of the step; that of viscosities at its end is
    /// taken to be as at its start.
    pub energy: V,
    /// Volume that the element sweeps in the step at its speed at the end.
    pub swept: V,
    /// Rates at the end of the step times the volume.
    pub flow: F,
    /// Rate of the volume at the end of the step.
    pub growth: V,
    works: Works<V>,
    rows: &'static AccountRows,
}

impl<V: Lanes, F> Start<V, F> {
    /// From the powers of the forces at the step's start, and flow and growth at its end.
    #[inline(always)]
    pub fn new<K: Kernel>(
        rows: &'static AccountRows,
        powers: &StartPowers<V>,
        (flow, growth): (F, V),
        state: &[V::Row],
        part: usize,
        steps: Steps,
    ) -> Self {
        let works = rows.begin::<V, K>(powers, state, part, steps);
        let energy = rows.energy::<V, K>(&works, [powers.viscous[0], growth], state, part, steps);
        Start { energy, swept: V::splat(steps.time_step) * growth, flow, growth, works, rows }
    }

    /// Energy and swept volume as laws see them, over the volume at the start of all; none of an element without accounts.
    #[inline(always)]
    pub fn per_volume(start: &Option<Self>, inverse_volume: V) -> [V; 2] {
        match start {
            Some(start) => [start.energy * inverse_volume, start.swept * inverse_volume],
            None => [V::splat(0.0), V::splat(0.0)],
        }
    }

    /// Work that the forces of the step's start have done in it, and what was owed of the step before.
    #[inline(always)]
    pub fn work(&self) -> V {
        (self.works[0] + self.works[1]) + self.works[2]
    }

    /// Energy that hourglass resistance and held corners of fluids have taken so far.
    #[inline(always)]
    pub fn taken(&self, state: &[V::Row], part: usize) -> V {
        self.rows.taken(&self.works, state, part)
    }

    /// Books the step, given the powers at its end. Those of the hourglass resistance of solids are booked elsewhere.
    #[inline(always)]
    pub fn finish<K: Kernel>(&self, powers: Works<V>, state: &mut [V::Row], part: usize, steps: Steps) {
        self.rows.finish::<V, K>(&self.works, powers, state, part, steps);
    }
}

impl AccountRows {
    /// Rows of the forces on corners, of fluids.
    pub fn of_corners<K: Kernel>(&self) -> std::ops::Range<usize> {
        let end = self.end_power::<K>();
        end - 9..end
    }

    /// Row of the rate of the volume in the last pass, of fluids.
    pub fn of_rate<K: Kernel>(&self) -> usize {
        self.of_corners::<K>().start - 1
    }

    fn end_power<K: Kernel>(&self) -> usize {
        self.law + K::STATE.len() - 1
    }

    /// Energy that hourglass resistance and held corners of fluids have taken so far, with what the forces of the step's start did.
    #[inline(always)]
    fn taken<V: Lanes>(&self, works: &Works<V>, state: &[V::Row], part: usize) -> V {
        V::load(&state[self.accounts[2]], part) + works[2]
    }

    /// Works of the forces of the step's start.
    #[inline(always)]
    fn begin<V: Lanes, K: Kernel>(
        &self,
        powers: &StartPowers<V>,
        state: &[V::Row],
        part: usize,
        steps: Steps,
    ) -> Works<V> {
        let half_kick = V::splat(0.5 * steps.kick);
        let end_power = V::load(&state[self.end_power::<K>()], part);
        let overdue = V::splat(0.5 * (steps.time_step - steps.kick)) * end_power;
        let [viscous, rate] = powers.viscous;
        [half_kick * powers.stress + overdue, half_kick * viscous * rate, half_kick * powers.modes]
    }

    /// Energy of the element but for the work of the stress at the end of the step, where its volume grows at the rate `growth`;
    /// that of viscosities there is taken to be as at its start.
    #[inline(always)]
    fn energy<V: Lanes, K: Kernel>(
        &self,
        works: &Works<V>,
        [viscous, growth]: [V; 2],
        state: &[V::Row],
        part: usize,
        steps: Steps,
    ) -> V {
        let [internal, of_viscosity, of_modes] = self.accounts;
        let mut energy = V::load(&state[internal], part) + V::load(&state[of_viscosity], part);
        energy = energy + (works[0] + works[1]) + V::splat(0.5 * steps.time_step) * viscous * growth;
        if K::FLUID {
            energy = energy + V::load(&state[of_modes], part) + (works[2] + works[2]);
        }
        energy
    }

    /// Books the step, given the works of its start and the powers at its end. Those of the hourglass resistance of solids are
    /// booked elsewhere.
    #[inline(always)]
    fn finish<V: Lanes, K: Kernel>(
        &self,
        works: &Works<V>,
        powers: Works<V>,
        state: &mut [V::Row],
        part: usize,
        steps: Steps,
    ) {
        let half_step = V::splat(0.5 * steps.time_step);
        for account in 0..if K::FLUID { 3 } else { 2 } {
            let (row, work) = (self.accounts[account], works[account] + half_step * powers[account]);
            if V::SINGLE {
                let carried = self.law + K::STATE.len() + self.carried[account];
                accumulate_carried(work, [row, carried], state, part);
            } else {
                accumulate(work, &mut state[row], part);
            }
        }
        let sum = powers[0] + powers[1];
        let sum = if K::FLUID { sum + powers[2] } else { sum };
        sum.store(&mut state[self.end_power::<K>()], part);
    }
}
