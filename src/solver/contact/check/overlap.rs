//! What is found of overlaps in the mesh, and how it is told.

use super::unheld::{ADVICE_ON_EDGES, ADVICE_ON_ELEMENTS, Told, Unheld};
use crate::mesh::Mesh;
use crate::model::{ContactOverlap, Model};
use crate::solver::Body;
use crate::solver::contact::press_fit::PressFit;

/// What was moved, and what was not.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Overlap {
    /// Number of nodes moved.
    pub nodes: usize,
    /// Farthest move, a length.
    pub farthest: f64,
    /// What is left deep inside.
    pub deep: DeepOverlap,
    /// Nodes that are as deep, in a fine mesh whose own surface contact knows to be in their body.
    pub known_opposite: usize,
    /// What could not be moved out, though it is not deep.
    pub stuck: Stuck,
    /// What is to be pushed apart through strain between rigid bodies, which have none.
    pub rigid: Stuck,
    /// What overlaps and stays for the time being, because the deck says so.
    pub kept: Stuck,
    /// Elements that moving their nodes would take all length from.
    pub squeezed: Squeezed,
    /// Where the mesh leaves less room than thicknesses.
    pub crowded: Crowded,
    /// Edges that go through faces where no node is inside.
    pub pierced: Unheld,
    /// Elements inside other bodies of which no node says so.
    pub engulfed: Unheld,
}

/// Nodes that begin nearer to faces than their thicknesses allow. Contact holds them as near as they are, and farther once they
/// have been farther.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Crowded {
    /// Their number.
    pub nodes: usize,
    /// The least room, as a part of the distance at which they would touch.
    pub least: f64,
    /// The node with the least room, from 0 in the mesh file.
    pub node: u32,
}

impl Crowded {
    /// Tells the user, where there are any.
    pub fn note(&self, mesh: &Mesh) -> Option<String> {
        let Crowded { nodes, least, node } = *self;
        let [x, y, z] = mesh.coordinates.get(node as usize)?;
        (nodes > 0).then(|| {
            format!(
                "note: {nodes} nodes begin nearer to shells or bars than their thickness allows; contact uses what room there is, \
                 at least {:.1} % of it: node {} at {x:.4e} {y:.4e} {z:.4e}",
                100.0 * least,
                mesh.node_ids[node as usize]
            )
        })
    }
}

/// Overlaps that moving nodes cannot remove, because the deck holds them or others are in the way.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Stuck {
    /// Number of nodes behind faces.
    pub nodes: usize,
    /// The deepest, a length.
    pub deepest: f64,
    /// Its node, from 0 in the mesh file.
    pub node: u32,
}

impl Overlap {
    /// Why a mesh whose overlaps must go is refused; `None` where all are gone.
    pub fn refusal(&self, mesh: &Mesh) -> Option<String> {
        if let Some(refusal) = self.refusal_of_unheld(mesh).filter(|_| self.deep.nodes == 0) {
            return Some(refusal);
        }
        let Overlap { deep, stuck, rigid, .. } = *self;
        let ((count, deepest, node), why) = if deep.nodes > 0 {
            ((deep.nodes, deep.deepest, deep.node), "deeper than half an element below every face that they look at")
        } else if rigid.nodes > 0 {
            ((rigid.nodes, rigid.deepest, rigid.node), "between rigid bodies, which no stress deforms")
        } else {
            ((stuck.nodes, stuck.deepest, stuck.node), "held by the deck or between others")
        };
        let [x, y, z] = mesh.coordinates.get(node as usize)?;
        (count > 0).then(|| {
            format!(
                "error: bodies overlap in the mesh, and {count} nodes cannot be moved out, being {why}: the deepest is node {} at \
                 {x:.4e} {y:.4e} {z:.4e}, {deepest:.4e} below the nearest face\n\
                 help: mend the mesh, or say CONTACT OVERLAP, REMOVE or KEEP in the deck to run with what is left",
                mesh.node_ids[node as usize]
            )
        })
    }

    /// Why a mesh is refused whose overlaps contact does not see: always where elements are inside others, else where they must go.
    fn refusal_of_unheld(&self, mesh: &Mesh) -> Option<String> {
        let [edges, elements] = self.unheld(mesh);
        let told = elements.or(edges.filter(|_| self.pierced.must_go))?;
        Some(format!("error: bodies overlap in the mesh: {told}"))
    }

    /// Warnings of the overlaps that contact does not see.
    pub fn warnings_of_unheld(&self, mesh: &Mesh) -> Vec<String> {
        self.unheld(mesh).into_iter().flatten().map(|told| format!("warning: {told}")).collect()
    }

    /// What is said of edges through faces and of elements inside bodies, with what to try.
    fn unheld(&self, mesh: &Mesh) -> [Option<String>; 2] {
        let edges = Told::of(&self.pierced, mesh).map(|told| (told.edges_in_words(), ADVICE_ON_EDGES));
        let elements = Told::of(&self.engulfed, mesh).map(|told| (told.elements_in_words(), ADVICE_ON_ELEMENTS));
        [edges, elements].map(|told| told.map(|(words, advice)| format!("{words}\nhelp: {advice}")))
    }

    /// What becomes of bodies that the deck lets overlap, where they do; bodies that are moved apart are warned of.
    pub fn note(&self, mesh: &Mesh, model: &Model, body: &Body) -> Option<String> {
        let Stuck { nodes, deepest, node } = self.kept;
        let [x, y, z] = mesh.coordinates.get(node as usize)?;
        let what = match (model.contact.control.overlap, PressFit::of(mesh, model, body)) {
            (ContactOverlap::Keep, _) => {
                "CONTACT OVERLAP, KEEP leaves them there, and lets none sink deeper".to_string()
            }
            (_, Some(fit)) => format!(
                "CONTACT OVERLAP, STRESS pushes them apart through the strain of the bodies until time {:.4e}",
                fit.duration
            ),
            _ => return None,
        };
        (nodes > 0).then(|| {
            format!(
                "note: bodies overlap in the mesh: {nodes} nodes begin behind faces, the deepest by {deepest:.4e}: node {} at \
                 {x:.4e} {y:.4e} {z:.4e}; {what}",
                mesh.node_ids[node as usize]
            )
        })
    }
}

/// Elements whose nodes would be at one place once they are moved out: a bar or a column that goes through a body has several within the same
/// half of an element, and all of them go to its face.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Squeezed {
    /// Their number.
    pub elements: usize,
    /// The first, from 0 in the mesh file.
    pub element: u32,
    /// One of its nodes that would be moved, from 0 in the mesh file.
    pub node: u32,
}

impl Squeezed {
    /// Why such a mesh is refused, whatever the deck says of what is left inside: its elements cannot be computed.
    pub fn refusal(&self, mesh: &Mesh) -> Option<String> {
        let Squeezed { elements, element, node } = *self;
        let [x, y, z] = mesh.coordinates.get(node as usize)?;
        let is_or_are = if elements == 1 { "element has" } else { "elements have" };
        (elements > 0).then(|| {
            format!(
                "error: bodies overlap in the mesh, and when their nodes have been moved out {elements} {is_or_are} nodes at the same place: \
                 the first is element {}, at node {}, {x:.4e} {y:.4e} {z:.4e} in the mesh\n\
                 help: move the bodies apart in the mesh, let what goes through another share nodes with it, or say CONTACT OVERLAP, KEEP in \
                 the deck to move nothing",
                mesh.element_ids[element as usize],
                mesh.node_ids[node as usize]
            )
        })
    }
}

/// Nodes that remain inside elements that are not theirs: too deep to say which way is out. Contact does not see them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DeepOverlap {
    /// Their number.
    pub nodes: usize,
    /// Distance of the deepest from the nearest face of the outside, a length.
    pub deepest: f64,
    /// The deepest, from 0 in the mesh file.
    pub node: u32,
    /// The element in which it is, from 0 in the mesh file.
    pub element: u32,
    /// How many of them are less deep than half an element, but below faces at which their body does not look.
    pub faces_away: usize,
}
