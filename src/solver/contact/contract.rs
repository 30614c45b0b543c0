//! Who must know of whose points until the next search, and what an arena therefore holds.

use super::arena::{Arena, Cast};
use super::neighbourhood::Found;
use super::planes::PlanePoint;
use super::regional::Regional;
use super::setup::Layout;
use crate::comm::Communicator;
use crate::partition::dynamic::Parcels;
use std::collections::{BTreeMap, BTreeSet};

/// Who must know of whose points in the passes.
#[derive(Default)]
pub struct Contract {
    /// Points that this rank is the home of, and on which constraints may act.
    pub here: BTreeSet<u32>,
    /// Points that go to each rank, and that come from each.
    pub send: BTreeMap<u32, BTreeSet<u32>>,
    pub receive: BTreeMap<u32, BTreeSet<u32>>,
    /// Ranks with constraints that act on points of both.
    pub partners: BTreeSet<u32>,
    /// Corners of candidate faces, and homes of ends of candidate edges.
    pub corners: BTreeMap<u32, [u32; 4]>,
    pub end_homes: BTreeMap<u32, u32>,
}

impl Contract {
    /// From the candidates of this rank and what others say of theirs.
    pub fn new(layout: &Layout, found: &Found, regional: &Regional, comm: &mut dyn Communicator) -> Contract {
        let me = comm.rank() as u32;
        let mut contract = Contract::default();
        let mut deliveries: BTreeSet<(u32, u32, u32)> = BTreeSet::new();
        for (i, &point) in found.watched.iter().enumerate() {
            contract.here.insert(point);
            for near in &found.near[found.first[i] as usize..found.first[i + 1] as usize] {
                let corners = layout.faces.corners[near.face as usize];
                contract.corners.insert(near.face, corners);
                let Ok(place) = regional.faces.ids.binary_search(&near.face) else { continue };
                let homes = regional.face_homes[place];
                let members = corners.into_iter().zip(homes).chain([(point, me)]);
                contract.agree(members, me, &mut deliveries);
            }
        }
        for pair in &found.pairs {
            let ends = pair.iter().filter_map(|edge| {
                let place = regional.edges.ids.binary_search(edge).ok()?;
                Some(layout.edges[*edge as usize].ends.into_iter().zip(regional.edge_homes[place]))
            });
            let members: Vec<(u32, u32)> = ends.flatten().collect();
            contract.end_homes.extend(members.iter().copied());
            contract.agree(members.into_iter(), me, &mut deliveries);
        }
        let mut parcels = Parcels::new(comm.size(), 2);
        for (from, to, point) in deliveries {
            parcels.add(from, point, &[0.0, f64::from(to)]);
            parcels.add(to, point, &[1.0, f64::from(from)]);
        }
        let records = parcels.exchange(comm);
        for (sender, range) in records.senders.clone() {
            if sender as u32 != me {
                contract.partners.insert(sender as u32);
            }
            for i in range {
                let (point, v) = (records.ids[i], records.values(i));
                let list = if v[0] == 0.0 { &mut contract.send } else { &mut contract.receive };
                list.entry(v[1] as u32).or_default().insert(point);
                if v[0] == 0.0 {
                    contract.here.insert(point);
                }
            }
        }
        contract
    }

    /// The home of each point of an arena that constraints may act on, `me` for all others; by places in the arena.
    pub fn homes(&self, me: u32, regional: &Regional, arena: &Arena) -> Vec<u32> {
        let mut homes = vec![me; arena.cast.points.len() + arena.cast.ghosts.len()];
        let mut note = |point: u32, home: u32| {
            if let Some(of) = homes.get_mut(arena.place(point) as usize) {
                *of = home;
            }
        };
        for (face, corners) in &self.corners {
            let Ok(place) = regional.faces.ids.binary_search(face) else { continue };
            corners.iter().zip(regional.face_homes[place]).for_each(|(&corner, home)| note(corner, home));
        }
        self.end_homes.iter().for_each(|(&point, &home)| note(point, home));
        homes
    }

    /// The homes of all members of a constraint know all of them.
    fn agree(
        &mut self,
        members: impl Iterator<Item = (u32, u32)> + Clone,
        me: u32,
        deliveries: &mut BTreeSet<(u32, u32, u32)>,
    ) {
        let mut ranks: Vec<u32> = members.clone().map(|(_, home)| home).chain([me]).collect();
        ranks.sort_unstable();
        ranks.dedup();
        for (point, home) in members {
            if home == me {
                self.here.insert(point);
            }
            for &rank in ranks.iter().filter(|&&rank| rank != home) {
                deliveries.insert((home, rank, point));
            }
        }
        self.partners.extend(ranks.into_iter().filter(|&rank| rank != me));
    }
}

/// Everything that the check of these candidates looks at.
pub fn cast(layout: &Layout, found: &Found, contract: &Contract, watches: &[PlanePoint]) -> Cast {
    let faces = &layout.faces;
    let mut chosen: BTreeSet<u32> = BTreeSet::new();
    found.watched.iter().for_each(|&point| chosen.extend(faces.around(point)));
    found.near.iter().for_each(|near| chosen.extend(faces.of_same_element(near.face)));
    let edges: BTreeSet<u32> = found.pairs.iter().flatten().copied().collect();
    edges.iter().for_each(|&edge| chosen.extend(layout.edges[edge as usize].faces));
    let mut points: BTreeSet<u32> = chosen.iter().flat_map(|&face| faces.corners[face as usize]).collect();
    points.extend(found.watched.iter().chain(&contract.here));
    points.extend(watches.iter().map(|watch| watch.point));
    let come = contract.receive.values().flatten().copied();
    Cast {
        ghosts: come.filter(|point| !points.contains(point)).collect::<BTreeSet<u32>>().into_iter().collect(),
        points: points.into_iter().collect(),
        faces: chosen.into_iter().collect(),
        edges: edges.into_iter().collect(),
    }
}
