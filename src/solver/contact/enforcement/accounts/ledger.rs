//! Who pays for what contact gives back.

use super::certificate::{Bank, Granted};

/// Who pays for what contact gives back.
pub enum Ledger<'a> {
    /// All contacts of all ranks draw on one bank.
    Bank(&'a mut Bank),
    /// The constraints of each point are for themselves: rigid planes alone. What motion has made of an overlap is lifted without a
    /// bank; there is no other side that could drive it.
    EachNode,
    /// Nobody: nodes are moved before the run, without velocities.
    Unlimited,
}

impl Ledger<'_> {
    /// What is granted when forces are sought.
    pub(in crate::solver::contact) fn granted(&self) -> Granted {
        match self {
            Ledger::Bank(bank) => bank.granted(),
            Ledger::EachNode | Ledger::Unlimited => [1.0; 2],
        }
    }
}
