//! Contact that never came, or came late, or of which a part never mattered.

use super::{Advice, Promise, Scene};
use crate::comm::Communicator;
use crate::common::numbers::scientific;
use crate::solver::Section;
use crate::solver::contact::{LOOSER, Looser, Seen};

/// Part of a run without contact that is worth words.
const LATE: f64 = 0.1;
/// Part of all candidates from which blocks that never touched are worth words.
const MANY_CANDIDATES: f64 = 0.05;
/// Pairs of blocks that are told at most, those with most candidates.
const PAIRS: usize = 5;
/// Part of all iterations from which a looser tolerance is worth words.
const MANY_ITERATIONS: f64 = 0.1;
/// Iterations that a step with contact makes at least, on average, where a looser tolerance is worth words: one or two cost next to nothing.
const FEW_ITERATIONS: u64 = 3;

pub fn advice(scene: &Scene, comm: &mut dyn Communicator) -> Vec<Advice> {
    let Some(contact) = &scene.solver.domain.contact else { return Vec::new() };
    let seen = contact.seen(comm);
    let short = contact.short_arcs(comm);
    // Nobody has seen the beginning of a run that goes on.
    if scene.continued {
        return Vec::new();
    }
    let mut list = Vec::new();
    if contact.has_surfaces() {
        surfaces(scene, &seen, contact.has_edges(), &mut list);
    }
    rubbed(&seen, &mut list);
    planes(scene, &seen, contact.has_surfaces(), &mut list);
    list.extend(short.into_iter().map(|block| arc(scene.mesh.blocks[block as usize].id)));
    list
}

fn surfaces(scene: &Scene, seen: &Seen, has_edges: bool, list: &mut Vec<Advice>) {
    let part = |share: f64| Some((Section::Contact, share));
    // Overlaps are taken out of what is named only, and with planes contact and they are solved together.
    let bits = if scene.moved > 0 || seen.planes.contains(&true) { Promise::Nothing } else { Promise::Bits };
    if !seen.met.any {
        let instead = "a deck without CONTACT MATERIAL and CONTACT SURFACE".to_string();
        return list.push(Advice::spare("nothing touched anything".into(), instead, bits, part(1.0)));
    }
    let chosen = chosen(scene);
    let (met, idle): (Vec<usize>, Vec<usize>) = chosen.iter().partition(|block| seen.met.has_met(**block));
    // A pair of side sets has faces of its own.
    if seen.met.follows() && !idle.is_empty() && !met.is_empty() && scene.model.contact.surfaces.is_empty() {
        let words = format!("{} {} touched nothing", blocks(&idle), numbers(scene, &idle));
        let instead = format!("CONTACT MATERIAL, {}", numbers(scene, &met));
        list.push(Advice::spare(words, instead, bits, part(idle.len() as f64 / chosen.len() as f64)));
    }
    pairs(scene, seen, &met, list);
    if has_edges && !seen.met.edges {
        let words = "no edge touched another".to_string();
        list.push(Advice::spare(words, "CONTACT EDGES, OFF".into(), Promise::Bits, part(1.0)));
    }
    looser(scene, seen, list);
    let begun = seen.steps_before / scene.solver.step.max(1) as f64;
    // Where no force could act there is no first one.
    if begun > LATE && begun.is_finite() {
        let words = format!(
            "nothing touched before time {}, in {:.0} % of the steps",
            scientific(seen.first, 3),
            100.0 * begun
        );
        let instead = "bodies that begin closer to each other".to_string();
        list.push(Advice::spare(words, instead, Promise::Nothing, part(begun)));
    }
}

/// Places of the blocks that CONTACT MATERIAL names.
fn chosen(scene: &Scene) -> Vec<usize> {
    let blocks = scene.mesh.blocks.iter().enumerate();
    blocks.filter(|(_, block)| scene.model.contact.names(block.id)).map(|(place, _)| place).collect()
}

fn numbers(scene: &Scene, places: &[usize]) -> String {
    places.iter().map(|&place| scene.mesh.blocks[place].id.to_string()).collect::<Vec<_>>().join(", ")
}

fn blocks(list: &[usize]) -> &'static str {
    if list.len() == 1 { "block" } else { "blocks" }
}

/// Blocks that have touched others, but not each other or themselves, and yet were searched and watched for it.
fn pairs(scene: &Scene, seen: &Seen, met: &[usize], list: &mut Vec<Advice>) {
    let apart = |a: usize, b: usize| !seen.met.have_met(a, b);
    let selves: f64 = met.iter().map(|&a| seen.met.share(a, a)).sum();
    let none = met.len() > 2 && met.iter().all(|&a| apart(a, a));
    if none && selves >= MANY_CANDIDATES {
        let words = format!("no block touched itself, of which {:.0} % of all candidates were", 100.0 * selves);
        list.push(Advice::spare(words, "CONTACT EXCLUSION, ALL".into(), Promise::Bits, None));
    }
    let all = met.iter().enumerate().flat_map(|(i, &a)| met[i..].iter().map(move |&b| (a, b)));
    let idle = all.filter(|&(a, b)| apart(a, b) && !(none && a == b));
    let mut idle: Vec<(f64, usize, usize)> = idle.map(|(a, b)| (seen.met.share(a, b), a, b)).collect();
    idle.retain(|(share, ..)| *share >= MANY_CANDIDATES);
    idle.sort_by(|one, other| other.0.total_cmp(&one.0).then((one.1, one.2).cmp(&(other.1, other.2))));
    for (share, a, b) in idle.into_iter().take(PAIRS) {
        let [first, second] = [a, b].map(|place| scene.mesh.blocks[place].id);
        let share = 100.0 * share;
        let (words, instead) = if a == b {
            (
                format!("block {first} never touched itself, of which {share:.0} % of all candidates were"),
                format!("CONTACT EXCLUSION, {first}"),
            )
        } else {
            (
                format!(
                    "blocks {first} and {second} never touched each other, of which {share:.0} % of all candidates were"
                ),
                format!("CONTACT EXCLUSION, {first}, {second}"),
            )
        };
        list.push(Advice::spare(words, instead, Promise::Bits, None));
    }
}

/// Iterations that a looser tolerance would not have made. What it does to results nobody can promise: what is left in a step by a
/// millionth of a face moves energies by a thousandth in the end.
fn looser(scene: &Scene, seen: &Seen, list: &mut Vec<Advice>) {
    let control = &scene.model.contact.control;
    if seen.iterations < FEW_ITERATIONS * seen.steps {
        return;
    }
    let spared = |(looser, factor): (&Looser, f64)| {
        (looser.iterations as f64 / seen.iterations.max(1) as f64, looser.moved, factor * control.tolerance)
    };
    let best = seen.looser.iter().zip(LOOSER).map(spared).find(|(part, ..)| *part >= MANY_ITERATIONS);
    let Some((part, moved, tolerance)) = best else { return };
    let words = format!(
        "{:.0} % of the passes of contact moved nothing by more than {} of a face in a step, all of them together",
        100.0 * part,
        scientific(moved, 1)
    );
    let instead = format!(
        "CONTACT PASSES, {}, {}, {} leaves them out, but no digit is promised: urto trade measures which change",
        control.passes,
        scientific(tolerance, 1),
        control.unsettled_passes
    );
    list.push(Advice::spare(words, instead, Promise::Nothing, None));
}

fn rubbed(seen: &Seen, list: &mut Vec<Advice>) {
    if seen.friction < 0.0 || seen.slid {
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

fn planes(scene: &Scene, seen: &Seen, with_surfaces: bool, list: &mut Vec<Advice>) {
    let sets: Vec<Vec<u32>> =
        scene.model.rigid_surfaces.iter().map(|plane| scene.mesh.side_set_nodes(plane.side_set)).collect();
    // Nodes of two planes are solved for both, in more passes than one needs.
    let shared = |place: usize| {
        let own = &sets[place];
        let others = sets.iter().enumerate().filter(|(other, _)| *other != place);
        others.flat_map(|(_, set)| set).any(|node| own.binary_search(node).is_ok())
    };
    for (place, plane) in scene.model.rigid_surfaces.iter().enumerate() {
        if seen.planes.get(place) != Some(&false) {
            continue;
        }
        let words = format!("the rigid plane of side set {} was never touched", plane.side_set);
        let instead = "a deck without it".to_string();
        let promise = if !with_surfaces && shared(place) { Promise::Digits } else { Promise::Bits };
        // What planes alone cost is little; with surfaces it is a part of contact that nobody measures.
        list.push(Advice::spare(words, instead, promise, None));
    }
}

/// What a curved surface lacked.
fn arc(block: i64) -> Advice {
    let words =
        format!("block {block} touched where it is curved, but never with two elements side by side along the arc");
    Advice::lack(words, "a finer mesh there: its contact is that of single nodes or rows of them".into())
}
