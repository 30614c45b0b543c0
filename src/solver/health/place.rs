//! Elements and nodes to blame, in the analyst's numbers. All ranks ask together and get the same.

use super::finding::{SPOTS, Spot};
use super::watch::Exam;
use crate::comm::{Communicator, ExactSum};
use crate::solver::body::centroid;
use crate::solver::elements::{ElementBlock, Group};
use crate::solver::{Domain, ElementPlace, Solver};

impl Solver {
    /// Canonical number of a local place, as a number that ranks can compare.
    pub(in crate::solver) fn canonical(&self, place: u32) -> f64 {
        f64::from(self.domain.element_canonical[place as usize])
    }

    /// What bounds the stable step where no element does.
    pub fn bound_beside_elements(&self) -> Option<&'static str> {
        let mut bounds =
            ["TIME STEP MAXIMUM", "the spin of a rigid body"].into_iter().zip(self.bounds_beside_elements());
        bounds.find(|(_, step)| *step == self.stable_step).map(|(bound, _)| bound)
    }

    /// The element that sets the stable step; of several the first in canonical order. Number 0 where
    /// [something else](Self::bound_beside_elements) does.
    pub fn controlling_element(&self, comm: &mut dyn Communicator) -> ElementPlace {
        match self.bound_beside_elements() {
            Some(_) => self.locate(f64::INFINITY, comm),
            None => self.slowest_element(comm),
        }
    }

    /// The element with the smallest stable step; of several the first in canonical order. Number 0 where there is none.
    pub(in crate::solver) fn slowest_element(&self, comm: &mut dyn Communicator) -> ElementPlace {
        let mine = self.local.controlling.filter(|_| self.local.stable_step == self.own_step);
        let mut first = [mine.map_or(f64::INFINITY, |place| self.canonical(place))];
        comm.all_min(&mut first);
        self.locate(first[0], comm)
    }

    /// Number, block and centre of an element given by its canonical number, known to all ranks.
    pub(in crate::solver) fn locate(&self, canonical: f64, comm: &mut dyn Communicator) -> ElementPlace {
        let mut facts = [f64::INFINITY; 6];
        if canonical == f64::INFINITY {
            // No element: all are rigid, or something else bounds the step.
            return ElementPlace { element: 0, block: 0, centre: [0.0; 3], volume: 0.0 };
        }
        if let Some(place) = find(&self.domain, canonical) {
            let [x, y, z] = place.centre;
            facts = [place.element as f64, place.block as f64, x, y, z, place.volume];
        }
        comm.all_min(&mut facts);
        let [element, block, x, y, z, volume] = facts;
        ElementPlace { element: element as i64, block: block as i64, centre: [x, y, z], volume }
    }
}

/// The element with a canonical number, if this rank has it.
fn find(domain: &Domain, canonical: f64) -> Option<ElementPlace> {
    let place = domain.element_canonical.iter().position(|&c| f64::from(c) == canonical)?;
    let (block, group, i) = domain.blocks.iter().find_map(|block| {
        let at = |group: &Group| group.places.binary_search(&(place as u32)).ok();
        block.groups().into_iter().find_map(|group| Some((block, group, at(group)?)))
    })?;
    let corners: Vec<[f64; 3]> = group.nodes(i).map(|node| domain.nodes.position(node)).collect();
    let volume = block.element.volume(group, i, &domain.nodes);
    Some(ElementPlace { element: domain.element_number(place), block: block.id, centre: centroid(&corners), volume })
}

/// Living elements of this rank, block by block.
pub fn elements(domain: &Domain) -> impl Iterator<Item = (&ElementBlock, &Group, usize)> + Clone {
    let groups = domain.blocks.iter().flat_map(|block| block.groups().map(|group| (block, group)));
    groups.flat_map(|(block, group)| (0..group.len()).filter(|&i| group.is_alive(i)).map(move |i| (block, group, i)))
}

/// Two energies of each block of the mesh, of its living elements on all ranks; `energies` tells those of an element.
pub fn energies_of_blocks(
    exam: &Exam,
    energies: impl Fn(&ElementBlock, &Group, usize) -> [f64; 2],
    comm: &mut dyn Communicator,
) -> Vec<[f64; 2]> {
    let mut sums: Vec<ExactSum> = vec![ExactSum::new(); 2 * exam.facts.blocks.len()];
    for (block, group, i) in elements(&exam.solver.domain) {
        for (which, energy) in energies(block, group, i).into_iter().enumerate() {
            sums[2 * block.index + which].add(energy);
        }
    }
    ExactSum::merge_ranks(&mut sums, comm);
    sums.chunks_exact(2).map(|pair| [pair[0].value(), pair[1].value()]).collect()
}

/// The place of the element of a block in which an energy is greatest.
pub fn worst_of_block(
    exam: &Exam,
    block: i64,
    energy: impl Fn(&ElementBlock, &Group, usize) -> f64,
    comm: &mut dyn Communicator,
) -> Option<Spot> {
    let own = elements(&exam.solver.domain).filter(|(of, ..)| of.id == block);
    worst_element(exam, own.map(|(of, group, i)| (group.places[i], energy(of, group, i))), comm)
}

/// The place of the element for which a number is greatest; of several the first in canonical order. `None` where there
/// are none, or where all are NaN.
pub fn worst_element(
    exam: &Exam,
    values: impl Iterator<Item = (u32, f64)>,
    comm: &mut dyn Communicator,
) -> Option<Spot> {
    let mut best = [f64::INFINITY, f64::INFINITY];
    for (place, value) in values {
        let key = [-value, exam.solver.canonical(place)];
        if key[0] < best[0] || (key[0] == best[0] && key[1] < best[1]) {
            best = key;
        }
    }
    let canonical = first_of_all(best, comm)?;
    let place = exam.solver.locate(canonical, comm);
    Some(Spot { node: None, element: Some(place.element), at: place.centre })
}

/// The nodes for which a number is greatest and positive, the greatest first, with the element whose face each meets.
/// `values` are those of local nodes that this rank owns.
pub fn worst_nodes(exam: &Exam, values: &[(u32, f64)], comm: &mut dyn Communicator) -> [Option<Spot>; SPOTS] {
    let nodes = &exam.solver.domain.nodes;
    let file = |node: u32| f64::from(nodes.file[node as usize]);
    let mut left: Vec<(u32, f64)> = values.iter().copied().filter(|(_, value)| *value > 0.0).collect();
    left.sort_by(|a, b| b.1.total_cmp(&a.1).then(file(a.0).total_cmp(&file(b.0))));
    left.truncate(SPOTS);
    left.reverse();
    let mut spots = [None; SPOTS];
    for spot in &mut spots {
        let mine = left.last().copied();
        let key = mine.map_or([f64::INFINITY; 2], |(node, value)| [-value, file(node)]);
        let Some(chosen) = first_of_all(key, comm) else { break };
        let own = mine.filter(|(node, _)| file(*node) == chosen).map(|(node, _)| node);
        if own.is_some() {
            left.pop();
        }
        *spot = Some(node_spot(exam, own, comm));
    }
    spots
}

/// The analyst's number of a local node, as one that ranks can compare; of a rotation, which has none, infinity.
fn number_of_node(exam: &Exam, node: usize) -> f64 {
    let nodes = &exam.solver.domain.nodes;
    let place = || (node < nodes.places).then(|| f64::from(nodes.file[node]) + 1.0);
    let number = exam.facts.node_id.get(node).map(|&id| id as f64);
    number.or_else(|| place().filter(|_| exam.facts.node_id.is_empty())).unwrap_or(f64::INFINITY)
}

/// The node that one rank has chosen, and the element whose face it meets.
fn node_spot(exam: &Exam, own: Option<u32>, comm: &mut dyn Communicator) -> Spot {
    let domain = &exam.solver.domain;
    let mut facts = [f64::INFINITY; 5];
    if let Some(node) = own {
        let [x, y, z] = domain.nodes.position(node);
        // Places in the mesh file are told from 1, and 0 is none.
        let met = domain.contact.iter().flat_map(|contact| contact.node_values()).find(|(met, _)| *met == node);
        let element = met.map_or(0.0, |(_, values)| values[5]);
        facts = [number_of_node(exam, node as usize), x, y, z, element];
    }
    comm.all_min(&mut facts);
    let [node, x, y, z, element] = facts;
    let here = domain.element_file.iter().position(|&file| f64::from(file) + 1.0 == element);
    let mut id = [here.map_or(f64::INFINITY, |place| domain.element_number(place) as f64)];
    comm.all_min(&mut id);
    Spot { node: Some(node as i64), element: id[0].is_finite().then_some(id[0] as i64), at: [x, y, z] }
}

/// The number and the position of a node, by its place in the mesh file.
pub fn node_id(exam: &Exam, file: u32, comm: &mut dyn Communicator) -> (i64, [f64; 3]) {
    let nodes = &exam.solver.domain.nodes;
    let here = (0..nodes.len()).find(|&node| nodes.owned[node] && nodes.file[node] == file);
    let mut facts = [f64::INFINITY; 4];
    if let Some(node) = here {
        let [x, y, z] = nodes.position(node as u32);
        facts = [number_of_node(exam, node), x, y, z];
    }
    comm.all_min(&mut facts);
    (facts[0] as i64, [facts[1], facts[2], facts[3]])
}

/// The second number of the smallest pair of all ranks.
pub fn first_of_all([value, number]: [f64; 2], comm: &mut dyn Communicator) -> Option<f64> {
    let mut least = [value];
    comm.all_min(&mut least);
    let mut first = [if value == least[0] { number } else { f64::INFINITY }];
    comm.all_min(&mut first);
    first[0].is_finite().then_some(first[0])
}
