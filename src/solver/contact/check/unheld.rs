//! Overlaps of the mesh that contact does not see, and their words.

use crate::mesh::Mesh;

/// Where bodies are in each other and contact does not hold them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Unheld {
    /// Number of edges or elements.
    pub count: usize,
    /// Pairs of blocks between which they are.
    pub pairs: usize,
    /// The worst place.
    pub place: Place,
    /// Whether the deck asks for what needs that all overlaps are known.
    pub must_go: bool,
}

/// A place of an overlap.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Place {
    /// Numbers of the blocks that are in each other there, ascending.
    pub blocks: [i64; 2],
    /// Where it is, lengths.
    pub at: [f64; 3],
    /// The ends of the edge, or two nodes of the element, from 0 in the mesh file.
    pub nodes: [u32; 2],
    /// The element whose face the edge goes through, or which is inside, from 0 in the mesh file.
    pub element: u32,
    /// How deep it is below the surface, a length; 0 where that cannot be said, as of what goes through a surface.
    pub deepest: f64,
}

impl Unheld {
    /// So many, between the blocks of these pairs; nothing without a place.
    pub fn new(count: usize, pairs: impl Iterator<Item = [i64; 2]>, worst: Option<Place>) -> Unheld {
        let Some(worst) = worst else { return Unheld::default() };
        let ascending = |[a, b]: [i64; 2]| [a.min(b), a.max(b)];
        let mut pairs: Vec<[i64; 2]> = pairs.map(ascending).collect();
        pairs.sort_unstable();
        pairs.dedup();
        let place = Place { blocks: ascending(worst.blocks), ..worst };
        Unheld { count, pairs: pairs.len(), place, must_go: false }
    }
}

/// An overlap by the numbers that the analyst's mesh gives to what is there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Told {
    /// Number of edges or elements.
    pub count: u64,
    /// Pairs of blocks between which they are.
    pub pairs: u64,
    /// Numbers of the blocks at the worst place, ascending.
    pub blocks: [i64; 2],
    /// How deep it is there, a length; 0 where that cannot be said.
    pub deepest: f64,
    /// The ends of the edge there, or two nodes of the element.
    pub nodes: [i64; 2],
    /// The element whose face the edge goes through, or which is inside.
    pub element: i64,
    /// Where it is, lengths.
    pub at: [f64; 3],
}

impl Told {
    /// `None` where there is nothing to tell.
    pub fn of(unheld: &Unheld, mesh: &Mesh) -> Option<Told> {
        let Unheld { count, pairs, place: Place { blocks, at, nodes, element, deepest }, .. } = *unheld;
        let [a, b] = nodes.map(|node| mesh.node_ids.get(node as usize).copied());
        (count > 0).then_some(Told {
            count: count as u64,
            pairs: pairs as u64,
            blocks,
            deepest,
            nodes: [a?, b?],
            element: *mesh.element_ids.get(element as usize)?,
            at,
        })
    }

    /// Edges through faces.
    pub fn edges_in_words(&self) -> String {
        let Told { count, deepest, nodes: [a, b], element, at: [x, y, z], .. } = self;
        let depth = if *deepest > 0.0 { format!(", up to {deepest:.4e} below the surface") } else { String::new() };
        format!(
            "{count} edges of contact surfaces begin going through faces of another body, {}{depth}: no node is inside there, and \
             contact does not hold them apart: the edge between nodes {a} and {b} at ({x:.4e}, {y:.4e}, {z:.4e}) through \
             element {element}",
            self.between()
        )
    }

    /// Elements inside bodies.
    pub fn elements_in_words(&self) -> String {
        let Told { count, element, at: [x, y, z], .. } = self;
        format!(
            "{count} elements begin inside another body, {}: nothing says which way is out, and contact does not hold them apart: \
             the middle of element {element} at ({x:.4e}, {y:.4e}, {z:.4e})",
            self.between()
        )
    }

    fn between(&self) -> String {
        let Told { blocks: [a, b], pairs, .. } = self;
        let of = if a == b { format!("both of block {a}") } else { format!("of blocks {a} and {b}") };
        match pairs {
            0 | 1 => of,
            2 => format!("{of} and one other pair"),
            more => format!("{of} and {} other pairs", more - 1),
        }
    }
}

/// What to try with edges that go through faces.
pub const ADVICE_ON_EDGES: &str = "move the bodies apart in the mesh, or make what is coarse there finer, so that nodes are inside, which are moved \
     out or known; CONTACT EXCLUSION leaves out what is meant to lie in each other";

/// What to try with elements that are inside.
pub const ADVICE_ON_ELEMENTS: &str = "two bodies at one place: take one out of the mesh, move them apart, or let them share nodes; CONTACT EXCLUSION leaves \
     out what is meant to lie in each other";
