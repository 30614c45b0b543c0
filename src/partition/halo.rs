//! Who shares which nodes with whom, and in which order their contributions are summed.
//!
//! Elements, and after them loaded faces, contribute to the sums at their nodes. Floating-point sums depend on their
//! order, so the order is fixed by the whole mesh: contributors in canonical order, corners in theirs. A node inside
//! a rank gets that order by plain scatter-adding. At a node shared by several ranks every rank keeps its corners'
//! contributions apart, sends them to all other sharers, and each sums all contributions in canonical order:
//! every copy of the node then has the bits that one rank alone would compute.

use crate::comm::Peer;
use crate::mesh::Connectivity;
use std::ops::Range;

/// One kind of contributor to nodal sums, in canonical order: elements, or faces under load.
#[derive(Debug, Clone, Copy)]
pub struct Contributors<'a> {
    /// Nodes of each contributor.
    pub nodes: &'a Connectivity,
    /// The rank that computes each contributor.
    pub ranks: &'a [u32],
}

impl<'a> Contributors<'a> {
    /// Each contributor's rank and nodes.
    fn iter(self) -> impl Iterator<Item = (u32, &'a [u32])> {
        self.ranks.iter().copied().zip(self.nodes.iter())
    }
}

/// The whole mesh cut into shares: made once, in O(size of the mesh), then asked for the share of each rank.
#[derive(Debug)]
pub struct Decomposition<'a> {
    groups: &'a [Contributors<'a>],
    node_count: usize,
    /// Number of the first rotation: local numbers of rotations come behind those of all nodes.
    first_rotation: usize,
    /// The node of each rotation, ascending.
    turning: &'a [u32],
    /// `members[group][rank]`: the contributors that a rank computes, ascending.
    members: Vec<Vec<Vec<u32>>>,
    /// Nodes with contributions from several ranks, ascending.
    shared_nodes: Vec<u32>,
    /// The contributions to `shared_nodes[i]`, in canonical order, are `corners[first[i]..first[i + 1]]`.
    first: Vec<usize>,
    corners: Vec<Corner>,
    /// For each rank the positions in `shared_nodes` of those it shares.
    shared_by: Vec<Vec<u32>>,
}

/// A contribution to a shared node.
#[derive(Debug, Clone, Copy, Default)]
struct Corner {
    rank: u32,
    slot: u32,
}

/// One rank's share of the mesh. Its *slots* number the corners of its contributors consecutively, group by group;
/// there must be fewer than 2^32 of them. See also [`Share::with_border_alone`].
#[derive(Debug, Clone, PartialEq)]
pub struct Share {
    /// Whose share this is.
    pub rank: usize,
    /// This rank's contributors, in the groups of the decomposition.
    pub groups: Vec<LocalGroup>,
    /// Mesh node numbers of the local nodes, which are numbered in the order of their first use; behind them rotations.
    pub nodes: Vec<u32>,
    /// Whether this rank answers for the node in output and sums over nodes: it is the lowest of the node's sharers, or of those of
    /// its rotation, where there is one.
    pub owned: Vec<bool>,
    /// The ranks with which nodes are shared, ascending.
    pub neighbours: Vec<Neighbour>,
    /// The shared nodes in ascending order of mesh node numbers.
    pub sums: Vec<SharedNode>,
    /// All shared nodes' contributions, one node after the other.
    pub sources: Vec<Source>,
}

/// One rank's contributors of one group.
#[derive(Debug, Clone, PartialEq)]
pub struct LocalGroup {
    /// Canonical numbers in the whole mesh, ascending.
    pub members: Vec<u32>,
    /// Local node numbers of each contributor that has slots.
    pub nodes: Connectivity,
    /// Whether the contributor touches a shared node, so that others wait for it.
    pub border: Vec<bool>,
    /// Slot of the first contributor's first corner.
    pub first_slot: u32,
}

/// A rank with which nodes are shared.
#[derive(Debug, Clone, PartialEq)]
pub struct Neighbour {
    /// Its rank.
    pub rank: usize,
    /// Slots of the contributions to send, ascending by mesh node number, then in canonical order.
    pub send: Vec<u32>,
    /// Number of contributions that come from there, in the same order.
    pub receive_count: usize,
}

/// A node of several ranks, with the range of its contributions in [`Share::sources`].
#[derive(Debug, Clone, PartialEq)]
pub struct SharedNode {
    /// Local node number.
    pub node: u32,
    /// Its contributions in canonical order.
    pub sources: Range<usize>,
}

/// Where one contribution to a shared node is found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Source {
    /// In a slot of this rank.
    Local(u32),
    /// Among what a neighbour sent.
    Remote {
        /// Position in [`Share::neighbours`].
        neighbour: u32,
        /// Position in its message.
        index: u32,
    },
}

impl<'a> Decomposition<'a> {
    /// Finds the shared nodes among `node_count` nodes, computed by `ranks` ranks. All node and rank numbers in
    /// `groups` must be below these. The groups come in canonical order.
    pub fn new(groups: &'a [Contributors<'a>], node_count: usize, ranks: usize) -> Self {
        Self::with_rotations(groups, node_count, &[], ranks)
    }

    /// The same with rotations of these nodes, ascending, which are numbered behind the nodes.
    pub fn with_rotations(groups: &'a [Contributors<'a>], nodes: usize, turning: &'a [u32], ranks: usize) -> Self {
        let node_count = nodes + turning.len();
        let members = groups.iter().map(|group| members_by_rank(group, ranks)).collect();
        let shared_nodes = find_shared_nodes(groups, node_count);
        let (first, corners) = collect_corners(groups, node_count, ranks, &shared_nodes);
        let mut shared_by = vec![Vec::new(); ranks];
        for (position, node) in (0..).zip(first.windows(2)) {
            for rank in sharers(&corners[node[0]..node[1]]) {
                shared_by[rank as usize].push(position);
            }
        }
        Self { groups, node_count, first_rotation: nodes, turning, members, shared_nodes, first, corners, shared_by }
    }

    /// The share of one rank, in O(size of the share).
    pub fn share(&self, rank: usize) -> Share {
        let mut local = LocalNumbers::new(self.node_count);
        if self.first_rotation < self.node_count {
            self.number_nodes(rank, &mut local);
        }
        let mut first_slot = 0;
        let mut groups = Vec::new();
        for (group, members) in self.groups.iter().zip(&self.members) {
            let members = members[rank].clone();
            let corners = members.iter().map(|&member| group.nodes[member as usize].len()).sum();
            let mut nodes = Connectivity::with_room_for(corners);
            for member in members.iter().map(|&member| member as usize) {
                nodes.push(group.nodes.shape(member), group.nodes[member].iter().map(|node| local.number(*node)));
            }
            let slots = nodes.nodes().len() as u32;
            groups.push(LocalGroup { members, nodes, border: Vec::new(), first_slot });
            first_slot += slots;
        }
        let mut share = Share {
            rank,
            groups,
            owned: vec![true; local.nodes.len()],
            neighbours: self.neighbours(rank),
            sums: Vec::with_capacity(self.shared_by[rank].len()),
            sources: Vec::new(),
            nodes: Vec::new(),
        };
        for position in &self.shared_by[rank] {
            let node = local.number(self.shared_nodes[*position as usize]);
            share.add_shared_node(node, self.corners_of(*position));
        }
        share.mark_border(local.nodes.len());
        self.own_with_rotations(&local, &mut share.owned);
        share.nodes = local.nodes;
        share
    }

    /// Numbers the nodes of a rank's share in the order of their first use, without rotations.
    fn number_nodes(&self, rank: usize, local: &mut LocalNumbers) {
        for (group, members) in self.groups.iter().zip(&self.members) {
            let nodes = members[rank].iter().flat_map(|&member| &group.nodes[member as usize]);
            nodes.filter(|&&node| (node as usize) < self.first_rotation).for_each(|&node| _ = local.number(node));
        }
    }

    /// Lets the rank that answers for a rotation answer for its node: ranks with only such elements at it as do not turn know
    /// nothing of the rotation.
    fn own_with_rotations(&self, local: &LocalNumbers, owned: &mut [bool]) {
        for (rotation, &node) in (self.first_rotation as u32..).zip(self.turning) {
            if let Some(node) = local.known(node) {
                owned[node as usize] = local.known(rotation).is_some_and(|rotation| owned[rotation as usize]);
            }
        }
    }

    /// The contributions to a shared node.
    fn corners_of(&self, position: u32) -> &[Corner] {
        &self.corners[self.first[position as usize]..self.first[position as usize + 1]]
    }

    /// The ranks that share a node with this one, still without messages.
    fn neighbours(&self, rank: usize) -> Vec<Neighbour> {
        let positions = self.shared_by[rank].iter();
        let mut ranks: Vec<u32> = Vec::new();
        for position in positions {
            for sharer in sharers(self.corners_of(*position)) {
                if let Err(place) = ranks.binary_search(&sharer) {
                    ranks.insert(place, sharer);
                }
            }
        }
        let others = ranks.into_iter().map(|other| other as usize).filter(|other| *other != rank);
        others.map(|rank| Neighbour { rank, send: Vec::new(), receive_count: 0 }).collect()
    }
}

impl Share {
    /// The share without what is numbered from `count` on: without rotations, of a mesh with so many nodes.
    pub fn of_nodes(&self, count: usize) -> Share {
        let own = self.nodes.partition_point(|&node| (node as usize) < count);
        let mut share = self.clone();
        share.nodes.truncate(own);
        share.owned.truncate(own);
        share.sums.retain(|sum| (sum.node as usize) < own);
        share
    }

    /// The share with the nodes of those elements alone that touch shared nodes, and slots for their corners alone: messages ask
    /// for no others. A share that is so already stays as it is.
    pub fn with_border_alone(mut self) -> Share {
        if self.has_border_alone() {
            return self;
        }
        let slots = BorderSlots::of(&self.groups[0]);
        for slot in self.neighbours.iter_mut().flat_map(|neighbour| &mut neighbour.send) {
            *slot = slots.slot(*slot);
        }
        for source in &mut self.sources {
            if let Source::Local(slot) = source {
                *slot = slots.slot(*slot);
            }
        }
        let (border, moved) = (slots.border_elements(), slots.all - slots.kept);
        self.groups[0].nodes = border;
        self.groups[1..].iter_mut().for_each(|group| group.first_slot -= moved);
        self
    }

    /// What messages and sums alone ask for.
    pub fn plan(&self) -> Share {
        Share {
            rank: self.rank,
            groups: Vec::new(),
            nodes: Vec::new(),
            owned: Vec::new(),
            neighbours: self.neighbours.clone(),
            sums: self.sums.clone(),
            sources: self.sources.clone(),
        }
    }

    /// Whether no element has nodes here but those that touch shared nodes.
    pub fn has_border_alone(&self) -> bool {
        let at_border = |elements: &LocalGroup| elements.border.iter().filter(|&&border| border).count();
        self.groups.first().is_none_or(|elements| elements.nodes.len() == at_border(elements))
    }

    /// Buffers for an exchange of `width` numbers per contribution.
    pub fn peers(&self, width: usize) -> Vec<Peer> {
        let peer = |neighbour: &Neighbour| Peer {
            rank: neighbour.rank,
            send: vec![0.0; width * neighbour.send.len()],
            receive: vec![0.0; width * neighbour.receive_count],
        };
        self.neighbours.iter().map(peer).collect()
    }

    /// Fills the send buffers with the contributions that `corner` gives for a slot.
    pub fn pack<const WIDTH: usize>(&self, peers: &mut [Peer], corner: impl Fn(u32) -> [f64; WIDTH]) {
        for (neighbour, peer) in self.neighbours.iter().zip(peers) {
            for (slot, values) in neighbour.send.iter().zip(peer.send.chunks_exact_mut(WIDTH)) {
                values.copy_from_slice(&corner(*slot));
            }
        }
    }

    /// Hands each shared node's local number and sum to `store`: all contributions in canonical order, from this
    /// rank's slots and from the receive buffers, added up from +0.
    pub fn sum<const WIDTH: usize>(
        &self,
        peers: &[Peer],
        corner: impl Fn(u32) -> [f64; WIDTH],
        mut store: impl FnMut(u32, [f64; WIDTH]),
    ) {
        for shared in &self.sums {
            let mut sum = [0.0; WIDTH];
            for source in &self.sources[shared.sources.clone()] {
                let values = match *source {
                    Source::Local(slot) => corner(slot),
                    Source::Remote { neighbour, index } => {
                        let start = WIDTH * index as usize;
                        std::array::from_fn(|i| peers[neighbour as usize].receive[start + i])
                    }
                };
                sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
            }
            store(shared.node, sum);
        }
    }

    /// Enters one shared node with its contributions into messages and sums.
    fn add_shared_node(&mut self, node: u32, corners: &[Corner]) {
        let start = self.sources.len();
        let rank = self.rank as u32;
        for corner in corners {
            self.sources.push(if corner.rank == rank {
                Source::Local(corner.slot)
            } else {
                let neighbour = self.position_of(corner.rank);
                let count = &mut self.neighbours[neighbour].receive_count;
                *count += 1;
                Source::Remote { neighbour: neighbour as u32, index: (*count - 1) as u32 }
            });
        }
        self.sums.push(SharedNode { node, sources: start..self.sources.len() });
        for sharer in sharers(corners).filter(|sharer| *sharer != rank) {
            self.owned[node as usize] &= rank < sharer;
            let neighbour = self.position_of(sharer);
            let mine = corners.iter().filter(|corner| corner.rank == rank).map(|corner| corner.slot);
            self.neighbours[neighbour].send.extend(mine);
        }
    }

    fn position_of(&self, rank: u32) -> usize {
        self.neighbours.partition_point(|neighbour| neighbour.rank < rank as usize)
    }

    fn mark_border(&mut self, node_count: usize) {
        let mut shared = vec![false; node_count];
        self.sums.iter().for_each(|sum| shared[sum.node as usize] = true);
        for group in &mut self.groups {
            let touches = |nodes: &[u32]| nodes.iter().any(|node| shared[*node as usize]);
            group.border = group.nodes.iter().map(touches).collect();
        }
    }
}

/// What slots become when elements that touch no shared node have none.
struct BorderSlots<'a> {
    elements: &'a LocalGroup,
    /// The first slot of each element at the border that is left.
    first: Vec<u32>,
    /// Slots of elements that are left, and of all elements.
    kept: u32,
    all: u32,
}

impl BorderSlots<'_> {
    fn of(elements: &LocalGroup) -> BorderSlots<'_> {
        let mut kept = 0;
        let first = (elements.border.iter().zip(elements.nodes.iter()))
            .map(|(&border, nodes)| {
                let first = kept;
                kept += if border { nodes.len() as u32 } else { 0 };
                first
            })
            .collect();
        BorderSlots { elements, first, kept, all: elements.nodes.nodes().len() as u32 }
    }

    /// The new number of a slot of an element at the border, or of a later group.
    fn slot(&self, slot: u32) -> u32 {
        if slot >= self.all {
            return self.kept + (slot - self.all);
        }
        let (element, corner) = self.elements.nodes.corner(slot as usize);
        self.first[element] + corner as u32
    }

    fn border_elements(&self) -> Connectivity {
        let mut border = Connectivity::with_room_for(self.kept as usize);
        let elements = self.elements.nodes.shaped().zip(&self.elements.border);
        for ((shape, nodes), _) in elements.filter(|(_, border)| **border) {
            border.push(shape, nodes.iter().copied());
        }
        border
    }
}

/// Numbers mesh nodes in the order in which they are first asked for.
struct LocalNumbers {
    /// Local number plus one of each mesh node, zero for none: untouched zeros cost no memory.
    local: Vec<u32>,
    nodes: Vec<u32>,
}

impl LocalNumbers {
    fn new(node_count: usize) -> Self {
        Self { local: vec![0; node_count], nodes: Vec::new() }
    }

    fn number(&mut self, node: u32) -> u32 {
        let local = &mut self.local[node as usize];
        if *local == 0 {
            self.nodes.push(node);
            *local = self.nodes.len() as u32;
        }
        *local - 1
    }

    /// The local number of a node that has been asked for.
    fn known(&self, node: u32) -> Option<u32> {
        self.local[node as usize].checked_sub(1)
    }
}

fn members_by_rank(group: &Contributors, ranks: usize) -> Vec<Vec<u32>> {
    let mut members = vec![Vec::new(); ranks];
    (0..).zip(group.ranks).for_each(|(member, rank)| members[*rank as usize].push(member));
    members
}

/// Nodes to which more than one rank contributes, ascending.
fn find_shared_nodes(groups: &[Contributors], node_count: usize) -> Vec<u32> {
    const NOBODY: u32 = u32::MAX;
    const SEVERAL: u32 = u32::MAX - 1;
    let mut user = vec![NOBODY; node_count];
    for (rank, nodes) in groups.iter().flat_map(|group| group.iter()) {
        for node in nodes {
            let user = &mut user[*node as usize];
            *user = if *user == NOBODY || *user == rank { rank } else { SEVERAL };
        }
    }
    (0..).zip(user).filter(|(_, user)| *user == SEVERAL).map(|(node, _)| node).collect()
}

/// The contributions to the shared nodes, sorted by node and then canonically (a counting sort), and where each
/// node's begin.
fn collect_corners(
    groups: &[Contributors],
    node_count: usize,
    ranks: usize,
    shared_nodes: &[u32],
) -> (Vec<usize>, Vec<Corner>) {
    const UNSHARED: u32 = u32::MAX;
    let mut position = vec![UNSHARED; node_count];
    (0..).zip(shared_nodes).for_each(|(i, node)| position[*node as usize] = i);

    let mut first = vec![0; shared_nodes.len() + 1];
    let nodes = groups.iter().flat_map(|group| group.nodes.nodes());
    nodes.map(|node| position[*node as usize]).filter(|i| *i != UNSHARED).for_each(|i| first[i as usize + 1] += 1);
    (1..first.len()).for_each(|i| first[i] += first[i - 1]);

    let mut next = first.clone();
    let mut corners = vec![Corner::default(); first[shared_nodes.len()]];
    let mut slots = vec![0; ranks];
    for (rank, nodes) in groups.iter().flat_map(|group| group.iter()) {
        let slot = &mut slots[rank as usize];
        for node in nodes {
            let i = position[*node as usize];
            if i != UNSHARED {
                corners[next[i as usize]] = Corner { rank, slot: *slot };
                next[i as usize] += 1;
            }
            *slot += 1;
        }
    }
    (first, corners)
}

/// The different ranks among a node's contributions, in order of their first.
fn sharers(corners: &[Corner]) -> impl Iterator<Item = u32> {
    let is_first = |i: &usize| corners[..*i].iter().all(|corner| corner.rank != corners[*i].rank);
    (0..corners.len()).filter(is_first).map(|i| corners[i].rank)
}

#[cfg(test)]
mod tests;
