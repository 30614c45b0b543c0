//! Work that loads and constraints have done so far, each kept with what it belongs to.
//!
//! A deck may change its loads when a run is continued. What is still there goes on with its work; the work of what is
//! not there any more stays in the balance as a number of its own.

use crate::restart::{Archive, compare_rows, sort_rows};
use crate::solver::constraints::Constraint;
use crate::solver::loads::{BodyForce, NodeForce, PressureFace};
use crate::solver::nodes::Nodes;
use crate::solver::silent::Dashpot;
use std::collections::BTreeMap;

/// Something that has done work.
struct Account<'a, const K: usize> {
    /// Its key, in places of the mesh file.
    key: [f64; K],
    /// Whether this rank answers for it.
    own: bool,
    work: &'a mut f64,
}

/// Where works belong on this rank.
pub(super) struct Works<'a> {
    nodes: &'a Nodes,
    /// File places of the nodes that this rank answers for, ascending.
    own_nodes: Vec<u32>,
    /// File place and canonical number of each local element; the latter ascending.
    elements: [&'a [u32]; 2],
}

impl<'a> Works<'a> {
    pub fn new(nodes: &'a Nodes, elements: [&'a [u32]; 2]) -> Works<'a> {
        let mut own_nodes: Vec<u32> =
            nodes.file.iter().zip(&nodes.owned).filter(|(_, owned)| **owned).map(|(file, _)| *file).collect();
        own_nodes.sort_unstable();
        Works { nodes, own_nodes, elements }
    }

    fn file(&self, node: u32) -> f64 {
        f64::from(self.nodes.file[node as usize])
    }

    fn owned(&self, node: u32) -> bool {
        self.nodes.owned[node as usize]
    }

    /// Whether this rank answers for a node by its place in the mesh file.
    pub fn has_node(&self, file: f64) -> bool {
        self.own_nodes.binary_search(&(file as u32)).is_ok()
    }

    /// Faces under pressure, by element and corners. `dead` are canonical numbers of elements, ascending: nothing presses
    /// on them. Returns what belongs to no face any more.
    pub fn faces(&self, archive: &mut dyn Archive, faces: &mut [PressureFace], dead: &[u32]) -> Vec<f64> {
        let [file, canonical] = self.elements;
        let mut accounts = Vec::new();
        for PressureFace { nodes, element, gone, function: _, scale: _, force: _, work } in faces {
            if archive.loading() {
                *gone = dead.binary_search(element).is_ok();
            }
            let place = canonical.binary_search(element).map_or(f64::NAN, |place| f64::from(file[place]));
            let [a, b, c, _] = nodes.map(|node| self.file(node));
            accounts.push(Account { key: [place, a, b, c], own: true, work });
        }
        let mut places = file.to_vec();
        places.sort_unstable();
        visit(archive, "PRESSUREW", accounts, |key| places.binary_search(&(key[0] as u32)).is_ok())
    }

    /// Forces on nodes, by node and axis.
    pub fn forces(&self, archive: &mut dyn Archive, forces: &mut [NodeForce]) -> Vec<f64> {
        let accounts = forces
            .iter_mut()
            .map(|NodeForce { node, axis, function: _, scale: _, force: _, work }| Account {
                key: [self.file(*node), *axis as f64],
                own: self.owned(*node),
                work,
            })
            .collect();
        visit(archive, "FORCEW", accounts, |key| self.has_node(key[0]))
    }

    /// Constraints, by node and axis.
    pub fn constraints(&self, archive: &mut dyn Archive, constraints: &mut [Constraint]) -> Vec<f64> {
        let accounts = constraints
            .iter_mut()
            .map(|Constraint { node, axis, motion: _, reaction: _, work }| Account {
                key: [self.file(*node), *axis as f64],
                own: self.owned(*node),
                work,
            })
            .collect();
        visit(archive, "MOTIONW", accounts, |key| self.has_node(key[0]))
    }

    /// Dashpots, by node.
    pub fn dashpots(&self, archive: &mut dyn Archive, dashpots: &mut [Dashpot]) -> Vec<f64> {
        let accounts = dashpots
            .iter_mut()
            .map(|Dashpot { node, resistance: _, force: _, work }| Account {
                key: [self.file(*node)],
                own: self.owned(*node),
                work,
            })
            .collect();
        visit(archive, "SILENTW", accounts, |key| self.has_node(key[0]))
    }

    /// Gravity, by node.
    pub fn gravity(&self, archive: &mut dyn Archive, gravity: &mut BodyForce) -> Vec<f64> {
        let BodyForce { gravities: _, acceleration: _, work } = gravity;
        let account = |(node, work): (usize, _)| {
            let node = node as u32;
            Account { key: [self.file(node)], own: self.owned(node), work }
        };
        let accounts = work.iter_mut().enumerate().map(account).collect();
        visit(archive, "GRAVITYW", accounts, |key| self.has_node(key[0]))
    }
}

/// Saves or loads works with their keys; things with the same key are told apart by their order. `answers` says whether
/// this rank answers for what a key names. Returns the works that nothing here has taken up though this rank should.
fn visit<const K: usize>(
    archive: &mut dyn Archive,
    name: &str,
    mut accounts: Vec<Account<K>>,
    answers: impl Fn(&[f64]) -> bool,
) -> Vec<f64> {
    let mut seen: BTreeMap<[u64; K], u32> = BTreeMap::new();
    let mut keys: Vec<Vec<f64>> = Vec::with_capacity(accounts.len());
    for account in &accounts {
        let earlier = seen.entry(account.key.map(f64::to_bits)).or_insert(0);
        keys.push([&account.key[..], &[f64::from(*earlier)]].concat());
        *earlier += 1;
    }
    let mut rows = Vec::new();
    // What has done no work yet needs no row.
    for (account, key) in accounts.iter().zip(&keys).filter(|(account, _)| account.own && *account.work != 0.0) {
        rows.extend_from_slice(key);
        rows.push(*account.work);
    }
    archive.list(name, K + 2, &mut rows);
    if !archive.loading() {
        return Vec::new();
    }
    sort_rows(K + 2, &mut rows);
    let rows: Vec<&[f64]> = rows.chunks_exact(K + 2).collect();
    let mut taken = vec![false; rows.len()];
    for (account, key) in accounts.iter_mut().zip(&keys) {
        let found = rows.binary_search_by(|row| compare_rows(&row[..=K], key));
        *account.work = found.map_or(0.0, |row| {
            taken[row] = true;
            rows[row][K + 1]
        });
    }
    let left = rows.iter().zip(taken).filter(|(row, taken)| !taken && answers(row));
    left.map(|(row, _)| row[K + 1]).collect()
}
