//! What the deck says of contact: what may touch what, and how it is found and enforced.

/// RIGID SURFACE: a fixed plane which the nodes of a side set cannot cross.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidSurface {
    /// Side set number.
    pub side_set: i64,
    /// A point of the plane.
    pub point: [f64; 3],
    /// Normal of the plane, unit length, pointing to the side where the body is.
    pub normal: [f64; 3],
    /// Coulomb friction coefficient μ.
    pub friction: f64,
}

/// Contact between surfaces of the body: what may touch, and how it is enforced.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Contact {
    /// CONTACT MATERIAL: numbers of the blocks whose outside may touch any other and itself.
    pub materials: Option<ContactMaterials>,
    /// CONTACT SURFACE: pairs of side sets.
    pub surfaces: Vec<ContactSurface>,
    /// CONTACT DATA: what holds between two materials.
    pub data: Vec<ContactData>,
    /// CONTACT EXCLUSION: numbers of blocks that do not touch each other; every block where the first is missing, the same block where
    /// the second is.
    pub exclusions: Vec<[Option<i64>; 2]>,
    /// CONTACT THICKNESS: blocks, and factors on the distance at which their surfaces and bars touch.
    pub thicknesses: Vec<(i64, f64)>,
    /// CONTACT NODE SET: node sets whose nodes touch as balls, and their radii.
    pub node_sets: Vec<(i64, f64)>,
    /// CONTACT CONTROL.
    pub control: ContactControl,
}

impl Contact {
    /// Whether anything may touch anything.
    pub fn is_some(&self) -> bool {
        self.materials.is_some() || !self.surfaces.is_empty()
    }

    /// Whether CONTACT MATERIAL names a block, by its number.
    pub fn names(&self, block: i64) -> bool {
        match &self.materials {
            None => false,
            Some(ContactMaterials::All) => true,
            Some(ContactMaterials::Blocks(ids)) => ids.contains(&block),
        }
    }

    /// Whether CONTACT EXCLUSION keeps two different blocks from touching each other.
    pub fn keeps_apart(&self, one: i64, other: i64) -> bool {
        let is_of = |named: &Option<i64>, block: i64| named.is_none_or(|named| named == block);
        self.exclusions.iter().any(|[first, second]| {
            second.is_some() && [[one, other], [other, one]].iter().any(|[a, b]| is_of(first, *a) && is_of(second, *b))
        })
    }
}

/// The blocks that CONTACT MATERIAL names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ContactMaterials {
    /// Every block of the mesh.
    All,
    /// These.
    Blocks(Vec<i64>),
}

/// CONTACT SURFACE: the nodes of each side set may touch the faces of the other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactSurface {
    /// Side set numbers.
    pub side_sets: [i64; 2],
    /// Coulomb friction.
    pub friction: Friction,
    /// Share of the master role of the first side set: 1 makes it the master, 0 the slave.
    pub partition: f64,
}

/// CONTACT DATA: friction and partition between two materials.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactData {
    /// Block numbers; twice the same for a material with itself.
    pub materials: [i64; 2],
    /// Coulomb friction.
    pub friction: Friction,
    /// Share of the master role of the first material; from the impedances where `None`.
    pub partition: Option<f64>,
}

/// Coulomb friction whose coefficient falls with the speed of sliding:
/// μ(v) = μ_high + (μ_static − μ_high) exp(−decay v).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Friction {
    /// Coefficient at rest.
    pub at_rest: f64,
    /// Coefficient at high speed.
    pub high_speed: f64,
    /// Decay, time/length; 0 keeps the coefficient at rest.
    pub decay: f64,
}

/// CONTACT EDGES: which edges of the outside may touch edges.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ContactEdges {
    /// None.
    None,
    /// Those that stand out touch each other.
    Sharp,
    /// Those that stand out touch each other and the lines of the mesh within faces.
    All,
}

/// CONTACT PASSES, CONTACT SEARCH, CONTACT EDGES, CONTACT ENERGY LIMIT and CONTACT DECOMPOSITION: how contact is found and enforced.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactControl {
    /// Largest number of enforcement passes in a step.
    pub passes: u32,
    /// The same once passes have not settled in many steps in a row; not less.
    pub unsettled_passes: u32,
    /// Overlap that ends the passes, as a part of the face's size; what they may still move follows it.
    pub tolerance: f64,
    /// How near faces are found.
    pub search: ContactSearch,
    /// Steps that a search shall last for a point that keeps its velocity; 0 searches every step.
    pub reach: f64,
    /// Smallest reach of a search, as a part of the mean face size.
    pub margin: f64,
    /// Which edges may touch edges.
    pub edges: ContactEdges,
    /// What becomes of overlaps that the mesh begins with.
    pub overlap: ContactOverlap,
    /// Part of the largest energy supplied so far that contact may make before the run ends.
    pub energy_limit: f64,
    /// How points are shared out among many ranks.
    pub decomposition: ContactDecomposition,
}

impl Default for ContactControl {
    fn default() -> ContactControl {
        ContactControl {
            passes: 20,
            unsettled_passes: 200,
            tolerance: 1e-5,
            search: ContactSearch::Grid,
            reach: 150.0,
            margin: 0.1,
            edges: ContactEdges::All,
            overlap: ContactOverlap::Refuse,
            energy_limit: 0.05,
            decomposition: ContactDecomposition::Bisection,
        }
    }
}

/// CONTACT OVERLAP: what becomes of overlaps that the mesh begins with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ContactOverlap {
    /// Nodes are moved out; what cannot be moved out is refused.
    Refuse,
    /// Nodes are moved out, and what cannot be moved out stays.
    Remove,
    /// All stay: contact holds them where they are.
    Keep,
    /// All are pushed apart through the strain of the bodies by this time, or slowly against their waves.
    Stress(Option<f64>),
}

impl ContactOverlap {
    /// Whether a mesh is refused of which something is left inside that cannot be dealt with.
    pub fn refuses(self) -> bool {
        matches!(self, ContactOverlap::Refuse | ContactOverlap::Stress(_))
    }
}

/// Ways to share out the points of contact among ranks; all give the same results.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ContactDecomposition {
    /// Recursive coordinate bisection of where the points are.
    Bisection,
    /// Slices across one axis, of equally many points.
    Slices,
    /// Every point stays with the rank that owns its node.
    Static,
}

/// Ways to find faces near a point; all find the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ContactSearch {
    /// Three sorted lists (Swegle), the reference.
    PointInBox,
    /// Grids of cells.
    Grid,
    /// A tree of boxes.
    Tree,
}
