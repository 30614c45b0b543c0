//! What work and messages cost on a machine.

use super::{Case, RankWork};
use crate::comm::{Count, Flow, Traffic, rounds};

/// A machine on which every rank has a processor of its own. Times in seconds, bandwidth in bytes per second.
#[derive(Debug, Clone, PartialEq)]
pub struct Machine {
    /// What it is called.
    pub name: &'static str,
    /// An element in a step, with its share of the nodes.
    pub element: f64,
    /// A contact point in a step: its prediction, and its share of the searches.
    pub contact_point: f64,
    /// A pair of a point and a face that is checked in a step.
    pub candidate: f64,
    /// A constraint in a pass.
    pub correction: f64,
    /// A message, whatever its length; also a round of a collective call.
    pub latency: f64,
    /// What one rank can send to other nodes, while all others send too.
    pub bandwidth: f64,
    /// Ranks on a node.
    pub ranks_of_node: usize,
    /// What one rank can send to others on its node.
    pub node_bandwidth: f64,
}

/// Seconds of a step, in parts that wait for each other.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Price {
    /// Elements and the messages about them.
    pub elements: f64,
    /// The agreement on the step, and the removal of elements.
    pub agreement: f64,
    /// Contact and the messages about it.
    pub contact: f64,
    /// The computing in these, on the rank that has most of it.
    pub computing: f64,
}

impl Price {
    /// Seconds of the step.
    pub fn total(&self) -> f64 {
        self.elements + self.agreement + self.contact
    }
}

/// Costs of contact relative to that of an element, measured: docs/performance.md says how.
const CONTACT_POINT: f64 = 0.4;
const CANDIDATE: f64 = 0.004;
const CORRECTION: f64 = 1.77;

impl Machine {
    /// The same machine with a processor that needs so long for an element; contact is slower or faster in proportion.
    pub const fn with_element(self, element: f64) -> Machine {
        let (contact_point, candidate, correction) =
            (CONTACT_POINT * element, CANDIDATE * element, CORRECTION * element);
        Machine { element, contact_point, candidate, correction, ..self }
    }

    /// A machine on which work costs nothing.
    const fn network(name: &'static str, latency: f64, bandwidth: f64) -> Machine {
        let (element, contact_point, candidate, correction) = (0.0, 0.0, 0.0, 0.0);
        let (ranks_of_node, node_bandwidth) = (1, bandwidth);
        Machine {
            name,
            element,
            contact_point,
            candidate,
            correction,
            latency,
            bandwidth,
            ranks_of_node,
            node_bandwidth,
        }
    }

    /// The same machine with so many ranks on a node, which send this to each other.
    const fn with_nodes(self, ranks_of_node: usize, node_bandwidth: f64) -> Machine {
        Machine { ranks_of_node, node_bandwidth, ..self }
    }

    /// Intel Paragon under SUNMOS, about 1995. Attaway et al. (1996) give 40.75 us an element and cycle on 32 processors for
    /// the crushed can, two thirds of it contact as in their fixed-size runs: 32 · 40.75 us / 3 for the element alone.
    /// Latency and bandwidth as measured at NASA Ames in 1994 (report RNR-94-016).
    pub const PARAGON: Machine = Machine::network("paragon", 70e-6, 170e6).with_element(435e-6);

    /// A present cluster: 80 ns for an element on one core, measured. Assumed: 1.5 us a message; 10 GB/s of a node shared
    /// by 32 cores, as if all sent at once; 5 GB/s for a copy from core to core within the node.
    pub const CLUSTER: Machine =
        Machine::network("cluster", 1.5e-6, 10e9 / 32.0).with_nodes(32, 5e9).with_element(80e-9);

    /// What a rank needs for its messages, sending and receiving at once, and for its part in collective calls.
    pub fn messages(&self, count: Count, ranks: usize) -> f64 {
        let rounds = count.collectives * u64::from(rounds(ranks));
        let calls = rounds as f64 * self.latency + count.collective_bytes as f64 / self.bandwidth;
        calls + self.flow(count.sent).max(self.flow(count.received))
    }

    fn flow(&self, flow: Flow) -> f64 {
        let near = (flow.bytes - flow.far_bytes) as f64 / self.node_bandwidth;
        flow.messages as f64 * self.latency + near + flow.far_bytes as f64 / self.bandwidth
    }

    /// What a mean step costs: in each part, what the slowest rank needs.
    pub fn price(&self, case: &Case) -> Price {
        let (ranks, steps) = (case.work.len(), case.steps.max(1) as f64);
        let slowest = |cost: &dyn Fn(&RankWork) -> f64| case.work.iter().map(cost).fold(0.0, f64::max);
        let of_elements = |rank: &RankWork| self.element * rank.elements as f64;
        let of_contact = |rank: &RankWork| self.contact_work(rank) / steps;
        let said = |rank: &RankWork, part| self.messages(rank.counts.of(part), ranks) / steps;
        Price {
            elements: slowest(&|rank| of_elements(rank) + said(rank, Traffic::Elements)),
            agreement: slowest(&|rank| said(rank, Traffic::Step) + said(rank, Traffic::Erosion)),
            contact: slowest(&|rank| of_contact(rank) + self.messages(rank.of_contact(), ranks) / steps),
            computing: slowest(&of_elements) + slowest(&of_contact),
        }
    }

    /// Seconds of a rank's contact in all steps, without messages.
    pub(super) fn contact_work(&self, rank: &RankWork) -> f64 {
        self.contact_point * rank.contact_points as f64
            + self.candidate * rank.candidates as f64
            + self.correction * rank.corrections as f64
    }
}
