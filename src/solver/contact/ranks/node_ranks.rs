//! Which ranks have the node of a point.

use crate::comm::{Communicator, numbers_of_others};
use crate::solver::contact::nodes::ContactNodes;

/// For each point the rank that owns its node, and all ranks of which it is a node.
pub struct NodeRanks {
    owner: Vec<u32>,
    /// Ranks of which a point is a node: `holders[first[p]..first[p + 1]]`.
    first: Vec<u32>,
    holders: Vec<u32>,
}

impl NodeRanks {
    /// Learns who has the nodes of so many points. All ranks call it.
    pub fn gather(count: usize, contact_nodes: &ContactNodes, comm: &mut dyn Communicator) -> NodeRanks {
        let number = |point: u32, owned: bool| 2 * point + u32::from(owned);
        let own: Vec<u32> = contact_nodes.list.iter().map(|of| number(of.point, of.owned)).collect();
        let mut all = numbers_of_others(&own, comm);
        all.push((comm.rank(), own));
        let mut owner = vec![0; count];
        let mut holding: Vec<(u32, u32)> = Vec::new();
        for (rank, numbers) in all {
            for number in numbers {
                holding.push((number / 2, rank as u32));
                if number % 2 == 1 {
                    owner[number as usize / 2] = rank as u32;
                }
            }
        }
        holding.sort_unstable();
        let first = (0..=count as u32).map(|point| holding.partition_point(|&(other, _)| other < point) as u32);
        NodeRanks { owner, first: first.collect(), holders: holding.into_iter().map(|(_, rank)| rank).collect() }
    }

    /// The rank that owns the node of a point.
    pub fn owner(&self, point: u32) -> u32 {
        self.owner[point as usize]
    }

    /// Ranks of which a point is a node, ascending.
    pub fn holders(&self, point: u32) -> &[u32] {
        &self.holders[self.first[point as usize] as usize..self.first[point as usize + 1] as usize]
    }
}
