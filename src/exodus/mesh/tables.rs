//! The arrays of a mesh file as they stand in it, and their assembly into a [`Mesh`].
//!
//! Nothing here touches a file, so that every rule about what a mesh may hold can be tried on arrays in memory.

use crate::exodus::file::names;
use crate::mesh::check::{Problem, Problems, counted};
use crate::mesh::exterior::SIDES;
use crate::mesh::hexahedron::Form;
use crate::mesh::{Block, Dimension, Kind, Mesh, NodeSet, Shape, SideSet};

/// How many bad references of one array are named one by one before the rest is summed up.
const NAMED_PER_ARRAY: usize = 3;

/// A mesh file's arrays: numbers one-based, lengths not yet compared, nothing checked.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tables {
    /// Title of the file.
    pub title: String,
    /// Number of spatial dimensions, 3 if the file does not say.
    pub dimensions: usize,
    /// A part of a mesh may be without nodes and elements.
    pub is_part: bool,
    /// x, y and z of every node, lengths; one array each.
    pub coordinates: [Vec<f64>; 3],
    /// What the dimension `num_nodes` says, if it is there.
    pub node_count: Option<usize>,
    /// What the dimension `num_elem` says, if it is there.
    pub element_count: Option<usize>,
    /// Element blocks, null blocks included.
    pub blocks: Vec<BlockTable>,
    /// Node sets, null sets included.
    pub node_sets: Vec<NodeSetTable>,
    /// Side sets, null sets included.
    pub side_sets: Vec<SideSetTable>,
    /// `node_num_map`; missing means 1, 2, 3, …
    pub node_ids: Option<Vec<i64>>,
    /// `elem_num_map`; missing means 1, 2, 3, …
    pub element_ids: Option<Vec<i64>>,
    /// QA records.
    pub qa: Vec<[String; 4]>,
}

/// One element block's arrays.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct BlockTable {
    /// Number of the block.
    pub id: i64,
    /// Name, or an empty string.
    pub name: String,
    /// Element type as the file spells it, or an empty string.
    pub element_type: String,
    /// Nodes of one element; zero in a null block.
    pub nodes_per_element: usize,
    /// Node positions, one-based, element by element.
    pub connectivity: Vec<i64>,
    /// Attributes, element by element; empty when there are none.
    pub attributes: Vec<f64>,
}

/// One node set's arrays.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct NodeSetTable {
    /// Number of the set.
    pub id: i64,
    /// Name, or an empty string.
    pub name: String,
    /// Node positions, one-based.
    pub nodes: Vec<i64>,
    /// Distribution factors, one a node; empty where they say nothing.
    pub factors: Vec<f64>,
}

/// One side set's arrays.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SideSetTable {
    /// Number of the set.
    pub id: i64,
    /// Name, or an empty string.
    pub name: String,
    /// Element positions, one-based.
    pub elements: Vec<i64>,
    /// Side of each element, 1 to 6.
    pub sides: Vec<i64>,
    /// Whether it has distribution factors other than 1.
    pub weighted: bool,
}

impl Tables {
    /// Checks the arrays against each other and turns them into a mesh.
    ///
    /// Shapes, ranges and numbers are checked, geometry is not: see [`crate::mesh::check::geometry`].
    ///
    /// # Errors
    /// Everything found that makes the arrays unfit to be a mesh.
    pub fn assemble(self) -> Result<Mesh, Problems> {
        let mut problems = Problems::default();
        let dimension = match self.dimensions {
            2 => Dimension::Two,
            3 => Dimension::Three,
            other => {
                let what = format!("the mesh is {other}-dimensional, a mesh has 2 or 3 dimensions");
                problems.add(|| Problem::new(what, "write the mesh again"));
                return Err(problems);
            }
        };
        let nodes = self.count_nodes(&mut problems);
        let elements = self.count_elements(&mut problems);
        if !problems.is_empty() {
            return Err(problems); // Whatever refers to nodes and elements would only echo these.
        }
        let node_ids = numbers("node", self.node_ids, nodes, &mut problems);
        let element_ids = numbers("element", self.element_ids, elements, &mut problems);

        unique("block", self.blocks.iter().map(|b| b.id), &mut problems);
        let kinds: Vec<(usize, Option<Kind>)> = self.blocks.iter().map(|b| (b.len(), b.accepted(dimension))).collect();
        let mut ids = element_ids.iter();
        let blocks = self.blocks.into_iter().map(|b| b.assemble((dimension, nodes), &mut ids, &mut problems)).collect();
        let weighted = [
            self.node_sets.iter().filter(|set| !set.factors.is_empty()).map(|set| set.id).collect(),
            self.side_sets.iter().filter(|set| set.weighted).map(|set| set.id).collect(),
        ];
        unique("node set", self.node_sets.iter().map(|s| s.id), &mut problems);
        let factors = self.node_sets.iter().filter(|set| !set.factors.is_empty());
        let node_factors = factors.map(|set| (set.id, set.factors.clone())).collect();
        let node_sets = self.node_sets.into_iter().map(|s| s.assemble(nodes, &mut problems)).collect();
        unique("side set", self.side_sets.iter().map(|s| s.id), &mut problems);
        let side_sets = self.side_sets.into_iter().map(|s| s.assemble(elements, &kinds, &mut problems)).collect();

        if !problems.is_empty() {
            return Err(problems);
        }
        let [x, y, mut z] = self.coordinates;
        if dimension == Dimension::Two {
            z = vec![0.0; nodes];
        }
        let coordinates = x.into_iter().zip(y).zip(z).map(|((x, y), z)| [x, y, z]).collect();
        let (title, qa) = (self.title, self.qa);
        Ok(Mesh {
            title,
            dimension,
            coordinates,
            blocks,
            node_sets,
            side_sets,
            node_ids,
            element_ids,
            qa,
            weighted,
            node_factors,
        })
    }

    /// Number of nodes, once all that speak of it agree.
    fn count_nodes(&self, problems: &mut Problems) -> usize {
        let lengths = self.coordinates.each_ref().map(Vec::len);
        let nodes = self.node_count.unwrap_or(lengths[0]);
        for (name, length) in names::COORDINATES.iter().zip(lengths).take(self.dimensions) {
            if length != nodes {
                problems.add(|| {
                    Problem::new(
                        format!("the mesh has {}, but {name} has {}", counted(nodes, "node"), counted(length, "value")),
                        "write the mesh again",
                    )
                });
            }
        }
        if nodes == 0 && !self.is_part {
            problems.add(|| Problem::new("the mesh has no nodes", "write the mesh again with its nodes and blocks"));
        }
        too_many("nodes", nodes, problems);
        nodes
    }

    /// Number of elements, once all that speak of it agree.
    fn count_elements(&self, problems: &mut Problems) -> usize {
        let elements = self.blocks.iter().map(BlockTable::len).sum();
        if self.blocks.is_empty() {
            problems.add(|| Problem::new("the mesh has no element blocks", "put the elements into at least one block"));
        } else if elements == 0 && !self.is_part {
            problems
                .add(|| Problem::new("the mesh has no elements", "all its blocks are empty; export the elements too"));
        }
        if let Some(said) = self.element_count.filter(|&said| said != elements) {
            problems.add(|| {
                Problem::new(
                    format!("num_elem promises {}, but the blocks hold {elements}", counted(said, "element")),
                    "a block is missing or was cut short; write the mesh again",
                )
            });
        }
        too_many("elements", elements, problems);
        elements
    }
}

impl BlockTable {
    fn len(&self) -> usize {
        self.connectivity.len().checked_div(self.nodes_per_element).unwrap_or(0)
    }

    /// What the elements are by type name, with or without the number of nodes in it; without a type by the number of
    /// nodes. `None` when they are of no kind that is known.
    pub(in crate::exodus) fn kind(&self, dimensions: usize) -> Option<Kind> {
        let name = self.element_type.to_ascii_uppercase();
        let mut all = Kind::all(dimensions).iter().copied();
        all.find(|kind| kind.is_named(&name) && kind.nodes() == self.nodes_per_element)
    }

    /// The same, but for what is not computed with: see [`BlockTable::unsupported`].
    fn accepted(&self, dimension: Dimension) -> Option<Kind> {
        self.kind(dimension.count()).filter(|kind| {
            matches!(
                kind,
                Kind::Solid(Form::Hexahedron | Form::Wedge | Form::Pyramid)
                    | Kind::Other(Shape::Bar | Shape::Plane | Shape::Quadrilateral | Shape::Triangle)
                    | Kind::Triangle
            )
        })
    }

    fn begins_with(&self, stem: &str) -> bool {
        self.element_type.get(..stem.len()).is_some_and(|start| start.eq_ignore_ascii_case(stem))
    }

    fn assemble<'a>(
        self,
        (dimension, nodes): (Dimension, usize),
        element_ids: &mut impl Iterator<Item = &'a i64>,
        problems: &mut Problems,
    ) -> Block {
        let mut block = Block { id: self.id, name: self.name.clone(), ..Block::default() };
        if self.connectivity.is_empty() {
            return block;
        }
        let Some(kind) = self.accepted(dimension) else {
            problems.add(|| self.unsupported(dimension));
            element_ids.by_ref().take(self.len()).for_each(drop);
            return block;
        };
        block.shape = kind.shape();
        block.attributes = self.attributes;
        let mut references = References::new(format!("block {}", self.id), Target::Node, nodes, problems);
        let mut own = vec![0; kind.nodes()];
        for (given, id) in self.connectivity.chunks_exact(kind.nodes()).zip(element_ids) {
            for (corner, (own, &given)) in own.iter_mut().zip(given).enumerate() {
                *own = references.resolve(given, || format!(", element {id}: its node {}", corner + 1));
            }
            block.nodes.extend(kind.expand(&own));
        }
        references.sum_up();
        if !block.attributes.len().is_multiple_of(block.len()) {
            let (count, of) = (block.attributes.len(), block.len());
            let what = format!("block {}: {} for {}", block.id, counted(count, "attribute"), counted(of, "element"));
            problems.add(|| Problem::new(what, "write the mesh again"));
        }
        block
    }

    /// Why this block's elements are refused, and what would be accepted.
    fn unsupported(&self, dimension: Dimension) -> Problem {
        if dimension == Dimension::Two {
            let spelled = if self.element_type.is_empty() { "(no type)" } else { self.element_type.as_str() };
            let nodes = counted(self.nodes_per_element, "node");
            return Problem::new(
                format!(
                    "block {}: elements of type {spelled} with {nodes} are not supported in two dimensions; QUAD4 and TRI3 are",
                    self.id
                ),
                "write the mesh with linear quadrilaterals and triangles, or in three dimensions",
            );
        }
        if self.kind(dimension.count()) == Some(Kind::Solid(Form::Tetrahedron)) {
            return Problem::new(
                format!(
                    "block {}: linear tetrahedra are not taken: with one point of integration each they lock in plastic \
                     flow and when nearly incompressible",
                    self.id
                ),
                "mesh the part with hexahedra, wedges or pyramids; a few may stand among hexahedra, with repeated nodes",
            );
        }
        let spelled = if self.element_type.is_empty() { "(no type)" } else { self.element_type.as_str() };
        let advice = if ["SHE", "QUA", "TRI"].iter().any(|stem| self.begins_with(stem)) {
            "shells have three or four nodes; write the mesh with linear elements"
        } else if ["HEX", "TET", "WED", "PYR"].iter().any(|stem| self.begins_with(stem)) {
            "elements of higher order are not built; write the mesh with linear elements"
        } else {
            "leave this block out or replace it by solid elements"
        };
        Problem::new(
            format!(
                "block {}: elements of type {spelled} with {} are not supported; HEX8, WEDGE6, PYRAMID5, SHELL4, TRISHELL3 and BAR2 are",
                self.id,
                counted(self.nodes_per_element, "node")
            ),
            advice,
        )
    }
}

impl NodeSetTable {
    fn assemble(self, nodes: usize, problems: &mut Problems) -> NodeSet {
        let place = format!("node set {}", self.id);
        if !self.factors.is_empty() && self.factors.len() != self.nodes.len() {
            let (own, others) = (counted(self.nodes.len(), "node"), counted(self.factors.len(), "distribution factor"));
            problems.add(|| Problem::new(format!("{place}: {own} but {others}"), "write the mesh again"));
        }
        if self.factors.iter().any(|factor| !factor.is_finite()) {
            let what = format!("{place}: a distribution factor is no number");
            problems.add(|| Problem::new(what, "write the mesh again"));
        }
        let references = References::new(place, Target::Node, nodes, problems);
        NodeSet { id: self.id, name: self.name, nodes: references.resolve_all(&self.nodes) }
    }
}

impl SideSetTable {
    /// `kinds` are the number of elements and what they are, block by block.
    fn assemble(self, elements: usize, kinds: &[(usize, Option<Kind>)], problems: &mut Problems) -> SideSet {
        let place = format!("side set {}", self.id);
        let counts = (self.elements.len(), self.sides.len());
        if counts.0 != counts.1 {
            let what = format!("{place}: {} but {}", counted(counts.0, "element"), counted(counts.1, "side"));
            problems.add(|| Problem::new(what, "write the mesh again"));
        }
        let faces = References::new(place.clone(), Target::Element, elements, problems).resolve_all(&self.elements);
        let given = References::new(place.clone(), Target::Side, SIDES, problems).resolve_all(&self.sides);
        let mut sides = Vec::with_capacity(faces.len());
        for (element, side) in faces.into_iter().zip(given) {
            let kind = kind_of(element, kinds).unwrap_or(Kind::Solid(Form::Hexahedron));
            match kind.sides().get(side as usize) {
                Some(&side) => sides.push((element, side)),
                None => problems.add(|| {
                    let what = format!("{place}: side {} of the element at place {}", side + 1, element + 1);
                    Problem::new(what, format!("the sides of a {} are 1 to {}", kind.name(), kind.sides().len()))
                }),
            }
        }
        SideSet { id: self.id, name: self.name, sides }
    }
}

/// What an element is, by its place in the file.
fn kind_of(element: u32, kinds: &[(usize, Option<Kind>)]) -> Option<Kind> {
    let mut rest = element as usize;
    for &(count, kind) in kinds {
        if rest < count {
            return kind;
        }
        rest -= count;
    }
    None
}

/// What a list of one-based numbers refers to.
#[derive(Clone, Copy)]
enum Target {
    Node,
    Element,
    Side,
}

/// Turns one-based references into indices and notes those that lead nowhere.
struct References<'a> {
    place: String,
    target: Target,
    count: usize,
    astray: usize,
    problems: &'a mut Problems,
}

impl<'a> References<'a> {
    fn new(place: String, target: Target, count: usize, problems: &'a mut Problems) -> Self {
        References { place, target, count, astray: 0, problems }
    }

    /// The index that a number stands for; zero if it is out of range, and then there is a problem and no mesh.
    fn resolve(&mut self, given: i64, entry: impl FnOnce() -> String) -> u32 {
        let index = given.checked_sub(1).and_then(|index| u32::try_from(index).ok());
        if let Some(index) = index.filter(|&index| (index as usize) < self.count) {
            return index;
        }
        self.astray += 1;
        if self.astray <= NAMED_PER_ARRAY {
            let (place, help) = (&self.place, self.help());
            self.problems.add(|| Problem::new(format!("{place}{} is given as {given}", entry()), help));
        }
        0
    }

    /// The indices of a whole list.
    fn resolve_all(mut self, given: &[i64]) -> Vec<u32> {
        let what = match self.target {
            Target::Side => "the side of entry",
            Target::Element | Target::Node => "entry",
        };
        let list = given.iter().enumerate();
        let list = list.map(|(n, &given)| self.resolve(given, || format!(": {what} {}", n + 1))).collect();
        self.sum_up();
        list
    }

    /// Counts the references that were not named one by one.
    fn sum_up(self) {
        let (place, astray) = (self.place, self.astray);
        if astray > NAMED_PER_ARRAY {
            self.problems.add(|| Problem::new(format!("{place}: {astray} references in all lead nowhere"), ""));
        }
    }

    fn help(&self) -> String {
        let count = self.count;
        match self.target {
            Target::Node => format!("nodes are referred to by their place in the file, 1 to {count}, not by a map"),
            Target::Element => {
                format!("elements are referred to by their place in the file, 1 to {count}, not by a map")
            }
            Target::Side => format!("the sides of a hexahedron are 1 to {count}"),
        }
    }
}

/// The analyst's numbers: as given, or 1, 2, 3, …; of the right length whatever the file says.
fn numbers(kind: &str, given: Option<Vec<i64>>, count: usize, problems: &mut Problems) -> Vec<i64> {
    let in_order = || (1..).take(count).collect();
    let Some(ids) = given else { return in_order() };
    if ids.len() != count {
        problems.add(|| {
            Problem::new(
                format!(
                    "the mesh has {}, but the map of their numbers has {}",
                    counted(count, kind),
                    counted(ids.len(), "value")
                ),
                "write the mesh again; the map may also be left out",
            )
        });
        return in_order();
    }
    unique(kind, ids.iter().copied(), problems);
    ids
}

/// Numbers must not be given twice.
fn unique(kind: &str, ids: impl Iterator<Item = i64> + Clone, problems: &mut Problems) {
    if ids.clone().is_sorted_by(|a, b| a < b) {
        return; // The common case, without a copy.
    }
    let mut sorted: Vec<i64> = ids.collect();
    sorted.sort_unstable();
    for group in sorted.chunk_by(|a, b| a == b).filter(|group| group.len() > 1) {
        problems.add(|| {
            Problem::new(
                format!("{kind} number {} is used {} times", group[0], group.len()),
                format!("give every {kind} its own number"),
            )
        });
    }
}

/// Indices are kept in 32 bits.
fn too_many(kind: &str, count: usize, problems: &mut Problems) {
    if count > u32::MAX as usize {
        problems.add(|| Problem::new(format!("the mesh has {count} {kind}, at most {} are possible", u32::MAX), ""));
    }
}
