//! Energies and momenta of the whole body, and their balance.
//!
//! kinetic + internal + hourglass + bulk viscosity + friction + eroded = initial + external work + contact work.
//! What contact, hourglass resistance or viscosity have made out of nothing is in these accounts with its sign, so that
//! they close; it counts as an error of the balance all the same.
//! Kinetic energy is ½ m v⁻·v⁺ of the velocities half a step before and after the state: with it central
//! differences balance exactly for constant steps. Work is booked in the same manner.

use super::domain::Domain;
use super::loads::{self, Places};
use crate::comm::{Communicator, ExactSum};

/// Accounts below this part of the largest energy supplied so far are round-off: all has come to rest.
const AT_REST: f64 = 1e-6;

/// Accounts below this part of ½ m v² of the velocities in the middle of two steps are not what moves: nothing has been booked yet.
const BEGINS: f64 = 1e-3;

/// The same as a part of the energy below which nothing is said about balance: it is that of a uniform strain of 3e-8, and so this is one of
/// 1e-12, which coordinates with 16 digits have beside each other some thousand elements from the origin.
const ROUND_OFF_OF_STRAIN: f64 = 1e-9;

/// Sums over the whole body at one state. The same bits on every rank and any number of ranks.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Totals {
    /// Kinetic energy.
    pub kinetic: f64,
    /// Internal energy.
    pub internal: f64,
    /// Hourglass energy.
    pub hourglass: f64,
    /// Energy dissipated by bulk viscosity.
    pub bulk_viscosity: f64,
    /// Energy dissipated by friction.
    pub friction: f64,
    /// Energy of eroded elements.
    pub eroded: f64,
    /// Work of loads and prescribed motions.
    pub external: f64,
    /// Work of normal contact forces and of the axis of bodies of revolution: they stop nodal masses dead, which takes energy out.
    pub contact: f64,
    /// Energy that contact has made: given beyond what it had taken before. It is a part of `contact` and `friction`.
    pub contact_gain: f64,
    /// Work of press fits: energy supplied. It is a part of `contact`.
    pub press_fit: f64,
    /// Linear momentum.
    pub momentum: [f64; 3],
    /// Kinetic energy of what MASS SCALING has added. It is a part of `kinetic`.
    pub added_kinetic: f64,
    /// An energy below which all accounts are round-off: of what was supplied before, of a motion that begins, or of coordinates.
    pub least_scale: f64,
}

impl Totals {
    /// Number of sums.
    const COUNT: usize = 14;

    fn from_array(s: [f64; Self::COUNT]) -> Totals {
        Totals {
            kinetic: s[0],
            internal: s[1],
            hourglass: s[2],
            bulk_viscosity: s[3],
            friction: s[4],
            external: s[5],
            contact: s[6] + s[13],
            contact_gain: 0.0,
            press_fit: 0.0,
            momentum: [s[7], s[8], s[9]],
            eroded: s[10],
            added_kinetic: s[11],
            // A step after rest v⁻ is round-off, and so is ½ m v⁻·v⁺ beside ½ m of the square of their mean.
            least_scale: BEGINS * s[12],
        }
    }

    /// Learns the largest energy supplied so far and the one below which nothing is said about balance.
    pub(super) fn know(&mut self, supplied: f64, floor: f64) {
        self.least_scale = self.least_scale.max(AT_REST * supplied).max(ROUND_OFF_OF_STRAIN * floor);
    }

    /// Energy accounted for minus energy supplied, with what was made out of nothing: the error of the balance.
    pub fn imbalance(&self, initial: f64) -> f64 {
        self.gap(initial) + self.made()
    }

    /// What the accounts do not explain: energy accounted for minus energy supplied.
    pub fn gap(&self, initial: f64) -> f64 {
        let stored = self.kinetic + self.internal + self.hourglass + self.bulk_viscosity;
        (stored + self.friction + self.eroded) - (initial + self.external + self.contact)
    }

    /// Energy that was made out of nothing: by contact, and by resistances that have given back more than they took.
    pub fn made(&self) -> f64 {
        // Friction that gives is a part of what contact gives.
        let [hourglass, viscosity, friction] = self.given_back();
        self.contact_gain.max(friction) + hourglass + viscosity
    }

    /// What hourglass resistance, bulk viscosity and friction have given back beyond what they took.
    pub fn given_back(&self) -> [f64; 3] {
        [self.hourglass, self.bulk_viscosity, self.friction].map(|taken| (-taken).max(0.0))
    }

    /// The largest account, or `least_scale` when all has come to rest or nothing has happened yet.
    pub fn scale(&self, initial: f64) -> f64 {
        let accounts = [self.kinetic, self.internal, initial, self.external, self.contact];
        accounts.iter().fold(self.least_scale, |m, e| e.abs().max(m))
    }

    /// Imbalance over the largest account; 0 when nothing has happened yet.
    pub fn relative_error(&self, initial: f64) -> f64 {
        self.relative(self.imbalance(initial), initial)
    }

    /// What the accounts do not explain over the largest of them; 0 when nothing has happened yet.
    pub fn relative_gap(&self, initial: f64) -> f64 {
        self.relative(self.gap(initial), initial)
    }

    fn relative(&self, energy: f64, initial: f64) -> f64 {
        let scale = self.scale(initial);
        if scale > 0.0 { energy / scale } else { 0.0 }
    }
}

/// Sums at state n, before the kick `kick` = Δt̄ₙ is applied, which is longer than the step before it by `longer`. Contact learns its work.
pub fn totals(domain: &mut Domain, [kick, longer]: [f64; 2], comm: &mut dyn Communicator) -> Totals {
    let mut sums: [ExactSum; Totals::COUNT] = std::array::from_fn(|_| ExactSum::new());
    add_nodes(domain, kick, &mut sums);
    if let Some(rigid) = domain.rigid.as_ref().filter(|_| comm.rank() == 0) {
        rigid.surplus_energies(kick > 0.0).for_each(|energy| sums[0].add(energy));
        rigid.works().for_each(|work| sums[5].add(work));
    }
    let [_, internal, hourglass, viscous, ..] = &mut sums;
    domain.blocks.iter().for_each(|block| block.add_energies(longer, [&mut *internal, &mut *hourglass, &mut *viscous]));
    add_work(domain, &mut sums);
    add_eroded(domain, &mut sums);
    ExactSum::merge_ranks(&mut sums, comm);
    let sums = sums.map(|sum| sum.value());
    let mut totals = Totals::from_array(sums);
    if let Some(contact) = &mut domain.contact {
        // The axis only takes: what it took is none of what contact may give.
        contact.note_work(sums[6] - totals.friction);
        totals.contact_gain = contact.gain();
        totals.press_fit = contact.growth_work();
    }
    totals
}

/// Lets contact learn its work, and returns what it has made; without the price of all sums.
pub fn contact_gain(domain: &mut Domain, comm: &mut dyn Communicator) -> f64 {
    let Some(contact) = &mut domain.contact else { return 0.0 };
    let mut sums = [ExactSum::new(), ExactSum::new()];
    for [normal, friction] in contact.works() {
        sums[0].add(normal);
        sums[1].add(-friction);
    }
    ExactSum::merge_ranks(&mut sums, comm);
    // As `totals` has it, so that looking more often changes no bit of what both have seen.
    let [normal, friction] = sums.map(|sum| sum.value());
    contact.note_work(normal - friction);
    contact.gain()
}

fn add_nodes(domain: &Domain, kick: f64, sums: &mut [ExactSum; Totals::COUNT]) {
    let nodes = &domain.nodes;
    let added = |i: usize| domain.added_mass.get(i).copied();
    for (i, ((row, force), owned)) in nodes.rows.iter().zip(&nodes.forces).zip(&nodes.owned).enumerate() {
        if !owned {
            continue;
        }
        let (r, turns) = (&row.0, i >= nodes.places);
        let (mut product, mut mean) = (0.0, 0.0);
        for i in 0..3 {
            let (before, after) = (r[4 + i], r[4 + i] + kick * (force.0[i] * r[7]));
            product += before * after;
            mean += 0.25 * (before + after) * (before + after);
            if !turns {
                sums[7 + i].add(0.5 * r[3] * (before + after));
            }
        }
        sums[0].add(0.5 * r[3] * product);
        sums[12].add(0.5 * r[3] * mean);
        // What has been dropped with the last element of a node has no mass of either kind.
        if let Some(mass) = added(i).filter(|_| r[3] > 0.0) {
            sums[11].add(0.5 * mass * product);
        }
    }
}

fn add_work(domain: &mut Domain, sums: &mut [ExactSum; Totals::COUNT]) {
    let Domain { nodes, pressure_faces, loads, constraints, axis, element_file, element_canonical, .. } = domain;
    let places = Places { nodes, elements: [element_file, element_canonical] };
    for load in loads::all(pressure_faces, loads) {
        load.accounts(&places, &mut |account| {
            if account.own {
                sums[5].add(*account.work);
            }
        });
    }
    if let Some(axis) = axis {
        axis.accounts(&places, &mut |account| {
            if account.own {
                sums[13].add(*account.work);
            }
        });
    }
    for constraint in constraints.iter().filter(|constraint| nodes.owned[constraint.node as usize]) {
        sums[5].add(constraint.work);
    }
    domain.carried_work.iter().for_each(|work| sums[5].add(*work));
    for [normal, friction] in domain.contact.iter().flat_map(|contact| contact.works()) {
        sums[6].add(normal);
        sums[4].add(-friction);
    }
}

fn add_eroded(domain: &Domain, sums: &mut [ExactSum; Totals::COUNT]) {
    for energy in domain.erosion.iter().flat_map(|erosion| &erosion.energy) {
        sums[10].add(*energy);
    }
}

/// Kinetic energy ½ m v² of the velocities as they stand, before the first step.
pub fn initial_kinetic_energy(domain: &Domain, comm: &mut dyn Communicator) -> f64 {
    let mut sum = [ExactSum::new()];
    let nodes = &domain.nodes;
    for (row, _) in nodes.rows.iter().zip(&nodes.owned).filter(|(_, owned)| **owned) {
        let r = &row.0;
        sum[0].add(0.5 * r[3] * (r[4] * r[4] + r[5] * r[5] + r[6] * r[6]));
    }
    let rigid = domain.rigid.as_ref().filter(|_| comm.rank() == 0);
    rigid.into_iter().flat_map(|rigid| rigid.surplus_energies(false)).for_each(|energy| sum[0].add(energy));
    ExactSum::merge_ranks(&mut sum, comm);
    sum[0].value()
}

/// Kinetic energy of what all nodes do together along these axes, ½ P²/M of the velocities as they stand: no collision and no deformation can
/// turn it into anything.
pub fn flight_energy(domain: &Domain, axes: [bool; 3], comm: &mut dyn Communicator) -> f64 {
    let mut sums: [ExactSum; 4] = std::array::from_fn(|_| ExactSum::new());
    let nodes = &domain.nodes;
    for (row, _) in nodes.rows.iter().zip(&nodes.owned).take(nodes.places).filter(|(_, owned)| **owned) {
        let [.., u, v, w, _] = row.0;
        let mass = row.0[3];
        sums.iter_mut().zip([u, v, w, 1.0]).for_each(|(sum, velocity)| sum.add(mass * velocity));
    }
    ExactSum::merge_ranks(&mut sums, comm);
    let [x, y, z, mass] = sums.map(|sum| sum.value());
    let along = [x, y, z].into_iter().zip(axes).filter(|(_, counts)| *counts);
    if mass > 0.0 { along.map(|(momentum, _)| 0.5 * momentum * momentum / mass).sum() } else { 0.0 }
}
