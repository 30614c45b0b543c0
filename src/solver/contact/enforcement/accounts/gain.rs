//! Energy that contact has made: what it has given to the bodies beyond what it had taken from them before.
//!
//! Contact may only take energy, and the certificate of every step sees to it: what it could not exclude stands in the bank.
//! Where rigid planes are alone there is no bank, and the account is the largest value so far of the running sum of the work
//! of all contact forces, normal and friction; it is known as often as that sum is looked at.

use crate::restart::Archive;
use crate::solver::contact::Contact;

/// The account of what contact has made.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Gain {
    most: f64,
}

impl Gain {
    /// Visits the state between two steps.
    pub fn visit_state(&mut self, archive: &mut dyn Archive) {
        let Gain { most } = self;
        archive.number("CONTGAIN", most);
    }
}

impl Contact {
    /// Energy that contact has given beyond what earlier losses had banked, summed over all steps: never negative, it
    /// only grows, and it is the same on all ranks.
    pub fn gain(&self) -> f64 {
        if self.has_bank() { self.bank.gain } else { self.gain.most }
    }

    /// Whether all contacts draw on one bank: not where rigid planes are alone, unless rigid bodies join their nodes.
    pub(in crate::solver::contact) fn has_bank(&self) -> bool {
        !self.layout.interfaces.is_empty() || self.limits.tolerance.is_finite()
    }

    /// Work that growing surfaces have done so far, an energy: that of press fits; the same on all ranks.
    pub fn growth_work(&self) -> f64 {
        self.bank.growth
    }

    /// Takes note of the work of all contact forces so far, summed over all ranks.
    pub fn note_work(&mut self, work: f64) {
        // NaN is no gain: other checks find it.
        if work > self.gain.most {
            self.gain.most = work;
        }
    }

    /// Local nodes on the surface that this rank owns, with the work of contact forces on each so far.
    pub fn node_works(&self) -> impl Iterator<Item = (u32, f64)> + '_ {
        let contact_nodes = self
            .contact_nodes
            .list
            .iter()
            .zip(&self.contact_nodes.works)
            .filter(|(contact_node, _)| contact_node.owned);
        contact_nodes.map(|(contact_node, [normal, friction])| (contact_node.node, normal + friction))
    }
}
