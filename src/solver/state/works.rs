//! Work that loads and constraints have done so far, each kept with what it belongs to.
//!
//! A deck may change its loads when a run is continued. What is still there goes on with its work; the work of what is
//! not there any more stays in the balance as a number of its own.

use crate::restart::{Archive, compare_rows, sort_rows};
use crate::solver::Axis;
use crate::solver::constraints::Constraint;
use crate::solver::loads::{Account, Key, Load, Places};
use std::collections::BTreeMap;

/// Visits the works of loads of one kind. Returns the works that nothing here has taken up though this rank should.
pub(super) fn of_load(archive: &mut dyn Archive, load: &mut dyn Load, places: &Places) -> Vec<f64> {
    let (name, key) = (load.entry().works, load.entry().key);
    visit(archive, name, key, places, &mut |take| load.accounts(places, take))
}

/// The same of constraints, by node and axis.
pub(super) fn of_constraints(archive: &mut dyn Archive, constraints: &mut [Constraint], places: &Places) -> Vec<f64> {
    visit(archive, "MOTIONW", Key::Node(1), places, &mut |take| {
        for Constraint { node, axis, work, motion: _, begins: _, reaction: _ } in constraints.iter_mut() {
            take(Account { key: [places.node(*node), *axis as f64, 0.0, 0.0], own: places.owns(*node), work });
        }
    })
}

/// The same of the axis of bodies of revolution, by node.
pub(super) fn of_axis(archive: &mut dyn Archive, axis: &mut Axis, places: &Places) -> Vec<f64> {
    visit(archive, "AXISW", Key::Node(0), places, &mut |take| axis.accounts(places, take))
}

/// The works of a kind of load that there is none of here; see [`of_load`].
pub(super) fn of_none(archive: &mut dyn Archive, name: &str, key: Key, places: &Places) -> Vec<f64> {
    visit(archive, name, key, places, &mut |_| ())
}

/// Something that hands out its accounts.
type Accounts<'a> = &'a mut dyn FnMut(&mut dyn FnMut(Account));

/// Saves or loads works with their keys; things with the same key are told apart by their order.
fn visit(archive: &mut dyn Archive, name: &str, key: Key, places: &Places, accounts: Accounts) -> Vec<f64> {
    let width = key.width();
    let mut seen: BTreeMap<[u64; 4], u32> = BTreeMap::new();
    let mut rows = Vec::new();
    accounts(&mut |account: Account| {
        let earlier = seen.entry(account.key.map(f64::to_bits)).or_insert(0);
        // What has done no work yet needs no row.
        if account.own && *account.work != 0.0 {
            rows.extend_from_slice(&account.key[..width]);
            rows.extend([f64::from(*earlier), *account.work]);
        }
        *earlier += 1;
    });
    archive.list(name, width + 2, &mut rows);
    if !archive.loading() {
        return Vec::new();
    }
    sort_rows(width + 2, &mut rows);
    let rows: Vec<&[f64]> = rows.chunks_exact(width + 2).collect();
    let mut taken = vec![false; rows.len()];
    seen.clear();
    accounts(&mut |account: Account| {
        let earlier = seen.entry(account.key.map(f64::to_bits)).or_insert(0);
        let key = [&account.key[..width], &[f64::from(*earlier)]].concat();
        *earlier += 1;
        let found = rows.binary_search_by(|row| compare_rows(&row[..=width], &key));
        *account.work = found.map_or(0.0, |row| {
            taken[row] = true;
            rows[row][width + 1]
        });
    });
    let here = Here::new(key, places);
    let left = rows.iter().zip(taken).filter(|(row, taken)| !taken && here.has(row[0]));
    left.map(|(row, _)| row[width + 1]).collect()
}

/// File places of what this rank answers for, ascending.
struct Here(Vec<u32>);

impl Here {
    fn new(key: Key, places: &Places) -> Here {
        let nodes = places.nodes;
        let mut here: Vec<u32> = match key {
            Key::Node(_) => nodes.file.iter().zip(&nodes.owned).filter(|(_, owned)| **owned).map(|(f, _)| *f).collect(),
            Key::Element(_) => places.elements[0].to_vec(),
        };
        here.sort_unstable();
        Here(here)
    }

    fn has(&self, file: f64) -> bool {
        self.0.binary_search(&(file as u32)).is_ok()
    }
}
