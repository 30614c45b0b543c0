//! How much the flattest directions of hexahedra have shrunk since the step of the mesh was estimated.
//!
//! The highest frequency of a mesh goes with one over the smallest height of its elements, while an element's own bound
//! goes with the sum of 1/h² over its three heights: pressed at constant volume it hardly feels the first fifth that the
//! mesh feels wholly. So heights h = V/A are followed themselves, A the area of the middle surface across, and what they
//! have lost since the last look is taken to be lost once more before the next.

use super::frequency::visit_by_element;
use crate::common::vector::{add, cross, dot, subtract};
use crate::restart::Archive;
use crate::solver::domain::Domain;
use crate::solver::elements::Group;
use crate::solver::nodes::Nodes;

/// Steps from look to look: one costs about half as much as a step of these elements.
const LOOK: u64 = 4;

/// Heights of the elements that take part, and what has become of them.
pub struct Heights {
    /// Smallest height of each element when the step was found, a length, in each block by group.
    then: Vec<[Vec<f64>; 2]>,
    /// Least ratio of heights now and then, at the last look and at the one before; the same on all ranks.
    ratios: [f64; 2],
}

impl Heights {
    /// Of no estimate yet.
    pub fn none(domain: &Domain) -> Heights {
        let none = |group: &Group| vec![f64::INFINITY; group.len()];
        Heights { then: domain.blocks.iter().map(|block| block.groups().map(none)).collect(), ratios: [1.0; 2] }
    }

    /// Takes the heights of now for those of an estimate.
    pub fn begin(&mut self, domain: &Domain, takes_part: &[bool]) {
        self.ratios = [1.0; 2];
        for ((block, then), _) in domain.blocks.iter().zip(&mut self.then).zip(takes_part).filter(|(_, part)| **part) {
            for (group, then) in block.groups().into_iter().zip(then) {
                then.iter_mut().enumerate().for_each(|(i, then)| *then = least_height(group, i, &domain.nodes));
            }
        }
    }

    /// The least ratio of heights now and then on this rank; infinite at steps that do not look.
    pub fn vote(&self, since: u64, domain: &Domain, takes_part: &[bool]) -> f64 {
        let mut least = f64::INFINITY;
        if since == 0 || !since.is_multiple_of(LOOK) {
            return least;
        }
        for ((block, then), _) in domain.blocks.iter().zip(&self.then).zip(takes_part).filter(|(_, part)| **part) {
            for (group, then) in block.groups().into_iter().zip(then) {
                for (i, then) in then.iter().enumerate().filter(|(i, _)| group.is_alive(*i)) {
                    least = least.min(least_height(group, i, &domain.nodes) / then);
                }
            }
        }
        least
    }

    /// Hears what all ranks have found.
    pub fn learn(&mut self, vote: f64) {
        if vote < f64::INFINITY {
            self.ratios = [vote.min(1.0), self.ratios[0]];
        }
    }

    /// What the step of the mesh is to be multiplied by until the next look.
    pub fn ratio(&self) -> f64 {
        let [now, before] = self.ratios;
        now * (now / before).min(1.0)
    }

    /// Visits what the next steps need.
    pub fn visit_state(&mut self, archive: &mut dyn Archive, domain: &Domain) {
        let Heights { then, ratios: [now, before] } = self;
        archive.number("GLOBALSHRUNK1", now);
        archive.number("GLOBALSHRUNK2", before);
        let groups = then.iter_mut().flatten().map(|group| group.iter_mut());
        visit_by_element("GLOBALHEIGHT", groups, domain, archive);
    }
}

/// Volume over the largest middle surface of a hexahedron, a length.
fn least_height(group: &Group, i: usize, nodes: &Nodes) -> f64 {
    let x: [[f64; 3]; 8] = group.positions(i, nodes);
    let mean = |four: [usize; 4]| four.into_iter().fold([0.0; 3], |sum, corner| add(sum, x[corner]));
    let a = subtract(mean([1, 2, 5, 6]), mean([0, 3, 4, 7]));
    let b = subtract(mean([2, 3, 6, 7]), mean([0, 1, 4, 5]));
    let c = subtract(mean([4, 5, 6, 7]), mean([0, 1, 2, 3]));
    let surfaces = [cross(b, c), cross(c, a), cross(a, b)];
    let largest = surfaces.iter().map(|surface| dot(*surface, *surface)).fold(0.0, f64::max);
    0.25 * dot(a, surfaces[0]) / largest.sqrt()
}
