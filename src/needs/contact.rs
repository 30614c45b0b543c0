//! Contact that never came, or came late.

use super::{Advice, Promise, Scene};
use crate::comm::Communicator;
use crate::model::ContactMaterials;
use crate::numbers::scientific;
use crate::solver::Section;
use crate::solver::contact::Seen;

/// Part of a run without contact that is worth words.
const LATE: f64 = 0.1;
/// Part of the friction that a contact can bear, below which it has never slid.
const HELD: f64 = 0.999;

pub fn advice(scene: &Scene, comm: &mut dyn Communicator) -> Vec<Advice> {
    let Some(contact) = &scene.solver.domain.contact else { return Vec::new() };
    let seen = contact.seen(comm);
    if scene.continued {
        return Vec::new();
    }
    let mut list = Vec::new();
    if contact.has_surfaces() {
        surfaces(scene, &seen, contact.has_edges(), &mut list);
    }
    planes(scene, &seen, &mut list);
    list
}

fn surfaces(scene: &Scene, seen: &Seen, has_edges: bool, list: &mut Vec<Advice>) {
    let whole = Some((Section::Contact, 1.0));
    let part = |share: f64| Some((Section::Contact, share));
    if !seen.edges && !seen.blocks.contains(&true) {
        let instead = "a deck without CONTACT MATERIAL and CONTACT SURFACE".to_string();
        return list.push(Advice::spare("nothing touched anything".into(), instead, Promise::Bits, whole));
    }
    let chosen: Vec<i64> = match &scene.model.contact.materials {
        None => Vec::new(),
        Some(ContactMaterials::All) => scene.mesh.blocks.iter().map(|block| block.id).collect(),
        Some(ContactMaterials::Blocks(ids)) => ids.clone(),
    };
    let touched = |id: &&i64| scene.mesh.block_index(**id).is_some_and(|index| seen.blocks.get(index) == Some(&true));
    let (met, idle): (Vec<&i64>, Vec<&i64>) = chosen.iter().partition(touched);
    // A pair of side sets has faces of its own.
    if !idle.is_empty() && !met.is_empty() && scene.model.contact.surfaces.is_empty() {
        let numbers = |ids: &[&i64]| ids.iter().map(|id| id.to_string()).collect::<Vec<_>>().join(", ");
        let (blocks, touch) = if idle.len() == 1 { ("block", "touched") } else { ("blocks", "touched") };
        let words = format!("{blocks} {} {touch} nothing", numbers(&idle));
        let instead = format!("CONTACT MATERIAL, {}", numbers(&met));
        list.push(Advice::spare(words, instead, Promise::Bits, part(idle.len() as f64 / chosen.len() as f64)));
    }
    if has_edges && !seen.edges {
        let words = "no edge touched another".to_string();
        list.push(Advice::spare(words, "CONTACT EDGES, OFF".into(), Promise::Bits, whole));
    }
    rubbed(seen, list);
    let begun = seen.steps_before / scene.solver.step.max(1) as f64;
    if begun > LATE {
        let words = format!(
            "nothing touched before time {}, in {:.0} % of the steps",
            scientific(seen.first, 3),
            100.0 * begun
        );
        let instead = "bodies that begin closer to each other".to_string();
        list.push(Advice::spare(words, instead, Promise::Nothing, part(begun)));
    }
}

fn rubbed(seen: &Seen, list: &mut Vec<Advice>) {
    if seen.friction < 0.0 || seen.friction >= HELD {
        return;
    }
    let words = if seen.friction == 0.0 {
        "friction never had anything to hold".to_string()
    } else {
        format!("friction never slid: it used {:.0} % of what it can hold at most", 100.0 * seen.friction)
    };
    let instead = "any larger coefficient".to_string();
    list.push(Advice::spare(words, instead, Promise::Bits, None));
}

fn planes(scene: &Scene, seen: &Seen, list: &mut Vec<Advice>) {
    let idle = scene.model.rigid_surfaces.iter().zip(&seen.planes).filter(|(_, pushed)| !**pushed);
    for (plane, _) in idle {
        let words = format!("the rigid plane of side set {} was never touched", plane.side_set);
        let instead = "a deck without it".to_string();
        // What planes alone cost is little; with surfaces it is a part of contact that nobody measures.
        list.push(Advice::spare(words, instead, Promise::Bits, None));
    }
}
