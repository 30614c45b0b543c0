//! Nodes that have sunk into elements of others, deeper than half an element: contact does not hold them there.

use crate::comm::{Communicator, numbers_of_others};
use crate::mesh::plane;
use crate::solver::contact::EmbeddedNode;
use crate::solver::health::finding::{Evidence, Spot};
use crate::solver::health::place::{elements, first_of_all, node_id};
use crate::solver::health::symptoms::{Symptom, When};
use crate::solver::health::watch::Exam;

pub const SYMPTOM: Symptom = Symptom {
    code: 10,
    when: When::SomeLines,
    threshold: 0.0,
    cause: f64::INFINITY,
    measure,
    place,
    label: |_| "nodes deep inside elements".into(),
    words: |evidence| {
        let Evidence { count, .. } = evidence;
        let (plural, them) = if *count == 1 { ("node is", "it") } else { ("nodes are", "them") };
        format!(
            "{count} {plural} deeper than half an element inside others, where contact does not hold {them}; the deepest: {}",
            evidence.places()
        )
    },
    advice: "more CONTACT PASSES, a smaller TIME STEP SCALE, or a finer mesh of the softer body; where elements fold or are \
             squashed, DEATH",
};

/// Deeper than this part of an element contact does not hold a node.
const DEEP: f64 = 0.5;

/// What has sunk into elements of this rank. A node between elements is as deep as the element says in which it is least
/// so: at a hollow edge the others have no outer face near it.
fn sunk(exam: &Exam, comm: &mut dyn Communicator) -> Vec<EmbeddedNode> {
    let domain = &exam.solver.domain;
    let Some(contact) = &domain.contact else { return Vec::new() };
    let outer = contact.outer_elements();
    let mut is_outer = vec![false; domain.element_canonical.len()];
    let mut numbers = outer.iter().peekable();
    for (is_outer, canonical) in is_outer.iter_mut().zip(&domain.element_canonical) {
        while numbers.next_if(|first| *first < canonical).is_some() {}
        *is_outer = numbers.peek() == Some(&canonical);
    }
    drop(outer);
    let here = elements(domain).filter(|(_, group, i)| is_outer[group.places[*i] as usize]);
    let here = here.filter(|(block, ..)| block.element.entry().shape.is_solid()).map(|(_, group, i)| {
        let nodes: Vec<u32> = group.nodes(i).collect();
        (domain.element_canonical[group.places[i] as usize], plane::eight(&nodes))
    });
    let found = contact.embedded_nodes(here, &domain.nodes, comm);
    let mut count = [found.iter().filter(|sunk| sunk.depth >= DEEP).count() as u64];
    comm.all_sum(&mut count);
    if count[0] == 0 {
        return Vec::new();
    }
    let (deep, shallow): (Vec<EmbeddedNode>, Vec<EmbeddedNode>) =
        found.into_iter().partition(|sunk| sunk.depth >= DEEP);
    let shallow = of_all(shallow.iter().map(|sunk| sunk.node).collect(), comm);
    deep.into_iter().filter(|sunk| shallow.binary_search(&sunk.node).is_err()).collect()
}

/// The numbers of all ranks, each once, ascending.
fn of_all(mut numbers: Vec<u32>, comm: &mut dyn Communicator) -> Vec<u32> {
    if comm.size() > 1 {
        let others = numbers_of_others(&numbers, comm);
        numbers.extend(others.into_iter().flat_map(|(_, theirs)| theirs));
    }
    numbers.sort_unstable();
    numbers.dedup();
    numbers
}

fn measure(exam: &Exam, comm: &mut dyn Communicator) -> Vec<Evidence> {
    if exam.solver.domain.contact.is_none() {
        return Vec::new();
    }
    // Of several elements that a node is in, of one rank or of many, it counts once.
    let nodes = of_all(sunk(exam, comm).iter().map(|sunk| sunk.node).collect(), comm);
    let count = nodes.len() as u64;
    // Those that begin there are told at the start, beside others that are not that deep.
    let overlap = exam.facts.overlap;
    let begin = overlap.deep.nodes - overlap.deep.faces_away + overlap.known_opposite;
    let new = count.saturating_sub(begin as u64);
    vec![Evidence { share: new as f64, count, ..Evidence::default() }]
}

/// The deepest node, and the element that it is in.
fn place(exam: &Exam, evidence: &mut Evidence, comm: &mut dyn Communicator) {
    let own = sunk(exam, comm);
    let first =
        own.iter().max_by(|a, b| a.depth.total_cmp(&b.depth).then(b.node.cmp(&a.node)).then(b.element.cmp(&a.element)));
    let key = first.map_or([f64::INFINITY; 2], |sunk| [-sunk.depth, f64::from(sunk.node)]);
    let Some(node) = first_of_all(key, comm) else { return };
    let mut least = [key[0]];
    comm.all_min(&mut least);
    // The node may be in an element of another rank as well, less deep.
    let mine = first.filter(|sunk| f64::from(sunk.node) == node && -sunk.depth == least[0]);
    let mut element = [mine.map_or(f64::INFINITY, |sunk| f64::from(sunk.element))];
    comm.all_min(&mut element);
    let place = exam.solver.locate(element[0], comm);
    let (id, at) = node_id(exam, node as u32, comm);
    evidence.spots[0] = Some(Spot { node: Some(id), element: Some(place.element), at });
}
