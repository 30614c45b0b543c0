//! The values of one rank in the order of its piece of the results.
//!
//! A node at the border stands in several pieces. The rank that owns it tells the others its values, as what contact
//! knows of a node may be known to its owner alone.

use super::across::Candidates;
use crate::comm::{Communicator, Peer};
use crate::exodus::pieces::{Piece, Sizes};
use crate::mesh::Mesh;
use crate::mesh::check::unreferenced_nodes;
use crate::partition::{Share, Source};
use crate::solver::Body;

/// A rank's piece, and where its values come from.
pub struct Split {
    /// The piece.
    pub piece: Piece,
    nodes: Vec<Origin>,
    /// The rank's own number of each element of the piece.
    elements: Vec<u32>,
    /// Number of nodes that this rank owns.
    owned: usize,
    /// Places among the owned nodes of those that each neighbour wants.
    wanted: Vec<Vec<u32>>,
    /// Number of nodes that come from each neighbour.
    coming: Vec<usize>,
    peers: Vec<Peer>,
}

/// Where the values of a node of the piece come from.
#[derive(Debug, Clone, Copy)]
enum Origin {
    /// This rank's owned nodes.
    Own(u32),
    /// A neighbour's message.
    Neighbour { peer: usize, index: usize },
    /// The node belongs to no element: its values are zero.
    Nowhere,
}

impl Split {
    /// Cuts a rank's piece out of the mesh. All ranks call it.
    pub fn new(mesh: &Mesh, body: &Body, share: &Share, comm: &mut dyn Communicator) -> Split {
        let share = &share.of_nodes(mesh.coordinates.len());
        let mut nodes = share.nodes.clone();
        if share.rank == 0 {
            nodes.extend(unreferenced_nodes(mesh));
        }
        nodes.sort_unstable();
        let members = &share.groups[0].members;
        let file: Vec<u32> = members.iter().map(|&member| body.element_order[member as usize]).collect();
        let mut elements: Vec<u32> = (0..file.len() as u32).collect();
        elements.sort_unstable_by_key(|&element| file[element as usize]);
        let part = mesh.part(nodes, elements.iter().map(|&element| file[element as usize]).collect());
        let in_piece = |node: u32| {
            let place = part.places.nodes.binary_search(&share.nodes[node as usize]);
            place.unwrap_or(0) as u32 // Every node of the share was put there.
        };
        let border = &share.groups[0].border;
        let border_elements = (0..).zip(&elements).filter(|(_, element)| border[**element as usize]).map(|(e, _)| e);
        let shared = shared_nodes(share);
        let mut split = Split {
            piece: Piece {
                rank: share.rank,
                ranks: comm.size(),
                whole: Sizes::of(mesh),
                border_nodes: share.sums.iter().map(|sum| in_piece(sum.node)).collect(),
                border_elements: border_elements.collect(),
                neighbours: (share.neighbours.iter().zip(&shared))
                    .map(|(neighbour, nodes)| (neighbour.rank, nodes.iter().map(|&node| in_piece(node)).collect()))
                    .collect(),
                across: Vec::new(),
                part: Default::default(),
            },
            nodes: vec![Origin::Nowhere; part.places.nodes.len()],
            elements,
            owned: 0,
            wanted: vec![Vec::new(); shared.len()],
            coming: vec![0; shared.len()],
            peers: share.neighbours.iter().map(|n| Peer { rank: n.rank, ..Peer::default() }).collect(),
        };
        split.find_origins(share, &shared, in_piece);
        split.piece.part = part;
        split.find_across(body, share, comm);
        split
    }

    fn find_across(&mut self, body: &Body, share: &Share, comm: &mut dyn Communicator) {
        let members = &share.groups[0].members;
        let of_piece = |element: u32| {
            let member = members[self.elements[element as usize] as usize];
            (element, body.element_nodes.shape(member as usize), &body.element_nodes[member as usize])
        };
        let shared: Vec<u32> = share.sums.iter().map(|sum| share.nodes[sum.node as usize]).collect();
        let candidates = Candidates::new(self.piece.border_elements.iter().map(|&element| of_piece(element)), |node| {
            shared.binary_search(&node).is_ok()
        });
        let neighbours: Vec<usize> = self.piece.neighbours.iter().map(|(rank, _)| *rank).collect();
        self.piece.across = candidates.across(&neighbours, comm);
    }

    fn find_origins(&mut self, share: &Share, shared: &[Vec<u32>], in_piece: impl Fn(u32) -> u32) {
        let mut own = vec![0; share.nodes.len()];
        for node in (0..share.nodes.len()).filter(|&node| share.owned[node]) {
            own[node] = self.owned as u32;
            self.nodes[in_piece(node as u32) as usize] = Origin::Own(own[node]);
            self.owned += 1;
        }
        // A node belongs to the lowest of its sharers, so the first neighbour that has one not owned here owns it.
        for (peer, nodes) in shared.iter().enumerate() {
            for &node in nodes {
                let origin = &mut self.nodes[in_piece(node) as usize];
                if share.owned[node as usize] {
                    self.wanted[peer].push(own[node as usize]);
                } else if matches!(origin, Origin::Nowhere) {
                    *origin = Origin::Neighbour { peer, index: self.coming[peer] };
                    self.coming[peer] += 1;
                }
            }
        }
    }

    /// Nodal values of the piece, one array per variable, from those of the owned nodes. All ranks call it.
    pub fn nodal(&mut self, own: &[f64], variables: usize, comm: &mut dyn Communicator) -> Vec<Vec<f64>> {
        let of_variable = |v: usize| &own[v * self.owned..(v + 1) * self.owned];
        for ((peer, wanted), &coming) in self.peers.iter_mut().zip(&self.wanted).zip(&self.coming) {
            let values = (0..variables).flat_map(|v| wanted.iter().map(move |&node| of_variable(v)[node as usize]));
            peer.send = values.collect();
            peer.receive.resize(variables * coming, 0.0);
        }
        comm.start_exchange(&mut self.peers);
        comm.finish_exchange(&mut self.peers);
        let value = |v: usize, origin: &Origin| match *origin {
            Origin::Own(node) => of_variable(v)[node as usize],
            Origin::Neighbour { peer, index } => self.peers[peer].receive[v * self.coming[peer] + index],
            Origin::Nowhere => 0.0,
        };
        (0..variables).map(|v| self.nodes.iter().map(|origin| value(v, origin)).collect()).collect()
    }

    /// Element values of the piece, one array per variable, from those in the rank's own order.
    pub fn element(&self, own: &[f64], variables: usize) -> Vec<Vec<f64>> {
        let count = self.elements.len();
        let of_variable = |v: usize| &own[v * count..(v + 1) * count];
        (0..variables)
            .map(|v| self.elements.iter().map(|&element| of_variable(v)[element as usize]).collect())
            .collect()
    }
}

/// The local nodes shared with each neighbour, in the order of the mesh.
fn shared_nodes(share: &Share) -> Vec<Vec<u32>> {
    let mut shared = vec![Vec::new(); share.neighbours.len()];
    for sum in &share.sums {
        for source in &share.sources[sum.sources.clone()] {
            if let Source::Remote { neighbour, .. } = *source {
                let nodes: &mut Vec<u32> = &mut shared[neighbour as usize];
                // A neighbour's contributions to a node need not follow each other, but its nodes do.
                if nodes.last() != Some(&sum.node) {
                    nodes.push(sum.node);
                }
            }
        }
    }
    shared
}
