//! What to simulate: the analyst's problem as plain data, checked and resolved.
//!
//! A [`Model`] holds no deck words and no arrays per node. The deck's commands fill it (`model::from_deck`),
//! `model::check` holds it against a mesh, and the solver reads it.

mod boundary;
mod check;
mod contact;
mod control;
mod deletion;
mod function;
mod initial;
mod interfaces;
mod material;
mod output;
mod problem;
mod properties;
mod restart;
mod rigid;
mod section;
mod tied;

pub use check::check;
pub use control::DEFAULT_HOURGLASS;
pub use deletion::Deletion;
pub use interfaces::{
    Contact, ContactControl, ContactData, ContactDecomposition, ContactEdges, ContactMaterials, ContactOverlap,
    ContactSearch, ContactSurface, Friction,
};
pub use problem::{Problem, examine, from_deck};
pub use restart::{ReadRestart, Restarts, WriteRestart};

use crate::material::Law;
use crate::mesh::Dimension;

/// A whole problem. Ids are the numbers the analyst wrote; `check` proves that the mesh has them.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// The deck's title line.
    pub title: String,
    /// Whether bodies are in space, in a plane, or of revolution.
    pub analysis: Analysis,
    /// Time at which the run ends, > 0.
    pub termination_time: f64,
    /// Interval between lines of the print log.
    pub output_interval: f64,
    /// Columns of these lines after PRONTO's own.
    pub step_log: Vec<StepColumns>,
    /// When plot states are written.
    pub plot: PlotSchedule,
    /// How the time step follows from the stable one.
    pub time_step: TimeStepControl,
    /// Precision of the state and the kernels of elements.
    pub precision: Precision,
    /// What bounds the time step.
    pub step_estimate: StepEstimate,
    /// Blocks that move as one, a list for each body.
    pub rigid_bodies: Vec<Vec<i64>>,
    /// Masses added so that the run may take longer steps.
    pub mass_scalings: Vec<MassScaling>,
    /// Bulk viscosity coefficients.
    pub bulk_viscosity: BulkViscosity,
    /// How hourglass modes are resisted.
    pub hourglass: Hourglass,
    /// Piecewise linear functions of time.
    pub functions: Vec<Function>,
    /// One entry per element block.
    pub materials: Vec<BlockMaterial>,
    /// What the deck says of the elements of blocks: sections, thicknesses.
    pub sections: Vec<Section>,
    /// Directions of node sets held still.
    pub no_displacements: Vec<NoDisplacement>,
    /// Motions imposed on node sets.
    pub prescribed_motions: Vec<PrescribedMotion>,
    /// Masses at the nodes of node sets.
    pub point_masses: Vec<PointMass>,
    /// Forces on the nodes of node sets.
    pub prescribed_forces: Vec<PrescribedForce>,
    /// Pressures on side sets.
    pub pressures: Vec<Pressure>,
    /// Body accelerations of the whole model.
    pub gravities: Vec<Gravity>,
    /// Numbers of the side sets that waves leave through.
    pub silent_boundaries: Vec<i64>,
    /// Velocities at time zero, applied in this order; a later one replaces an earlier one at the same node.
    pub initial_velocities: Vec<InitialVelocity>,
    /// Fixed rigid planes.
    pub rigid_surfaces: Vec<RigidSurface>,
    /// Surfaces that follow others.
    pub ties: Vec<Tie>,
    /// Contact between surfaces of the body.
    pub contact: Contact,
    /// When elements are taken away.
    pub deaths: Vec<Death>,
    /// Blocks that are taken away at a time.
    pub deletions: Vec<Deletion>,
    /// What the plot file holds.
    pub plot_requests: PlotRequests,
    /// Points of the undeformed mesh whose elements have their histories written.
    pub material_points: Vec<[f64; 3]>,
    /// What else has its history written, in the order of the deck.
    pub histories: Vec<Watched>,
    /// Interval of histories; without one they are written with the lines of the print log.
    pub history_interval: Option<f64>,
    /// Restarts to write and to go on from.
    pub restarts: Restarts,
}

/// In how many dimensions bodies are, and what stands for the one that is left out.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Analysis {
    /// Three dimensions.
    #[default]
    Solid,
    /// PLANE STRAIN: no motion and no change along z; a unit of thickness.
    PlaneStrain,
    /// AXISYMMETRIC: bodies of revolution about the y axis, all 2π radians of them.
    Axisymmetric,
    /// AXISYMMETRIC, COMPATIBLE: the same, with forces weighed by areas.
    AxisymmetricCompatible,
}

impl Analysis {
    /// The dimension of its meshes.
    pub fn dimension(self) -> Dimension {
        if self == Analysis::Solid { Dimension::Three } else { Dimension::Two }
    }

    /// Its name in the log.
    pub fn name(self) -> &'static str {
        match self {
            Analysis::Solid => "3D SOLID",
            Analysis::PlaneStrain => "PLANE STRAIN",
            Analysis::Axisymmetric => "AXISYMMETRIC",
            Analysis::AxisymmetricCompatible => "AXISYMMETRIC, COMPATIBLE",
        }
    }

    /// Whether x is the distance from an axis.
    pub fn about_axis(self) -> bool {
        matches!(self, Analysis::Axisymmetric | Analysis::AxisymmetricCompatible)
    }
}

/// A command that an element brings with it, for the block that it names.
#[derive(Debug, Clone, PartialEq)]
pub struct Section {
    /// Name of the command.
    pub command: String,
    /// Number of the element block.
    pub block: i64,
    /// Its other fields that are numbers, by their names.
    pub numbers: Vec<(String, f64)>,
    /// Its fields that are words, by their names.
    pub words: Vec<(String, String)>,
}

impl Section {
    /// A number by the name of its field; NaN for a field that the command does not have.
    pub fn number(&self, field: &str) -> f64 {
        self.numbers.iter().find(|(name, _)| name == field).map_or(f64::NAN, |(_, value)| *value)
    }
}

impl Section {
    /// A word by the name of its field.
    pub fn word(&self, field: &str) -> Option<&str> {
        self.words.iter().find(|(name, _)| name == field).map(|(_, word)| &word[..])
    }
}

impl Model {
    /// What a command says of a block; the last one counts.
    pub fn section(&self, command: &str, block: i64) -> Option<&Section> {
        self.sections.iter().rfind(|section| section.command == command && section.block == block)
    }

    /// Whether any material is a fluid: see [`Law::is_fluid`](crate::material::Law::is_fluid).
    pub fn has_fluids(&self) -> bool {
        self.materials.iter().any(|material| material.law.is_fluid())
    }
}

/// HISTORY: what is watched.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Watched {
    /// Every block, as a body.
    Blocks,
    /// The block with this number, as a body.
    Block(i64),
    /// The node set with this number.
    NodeSet(i64),
    /// The node with this number.
    Node(i64),
    /// The force of rigid surfaces on the nodes of the side set with this number, and its work.
    RigidSurface(i64),
    /// The force of the block with the second number on that with the first, or of all others where there is none, and their
    /// works.
    Contact(i64, Option<i64>),
}

/// PLOT TIME: states are written at the steps nearest to `start`, `start + interval`, … up to `stop`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlotSchedule {
    /// Interval between states; `None` writes only the first and the last state.
    pub interval: Option<f64>,
    /// First time.
    pub start: f64,
    /// Last time.
    pub stop: f64,
}

/// TIME STEP SCALE and its companions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeStepControl {
    /// Factor on the stable time step, (0, 1] is safe; the default is 1, as in PRONTO: the bound is rigorous.
    pub scale: f64,
    /// Strain softening factor of PRONTO, kept for the echo.
    pub softening: f64,
    /// Largest ratio of one step to the one before.
    pub growth: f64,
    /// Which moduli make the wave speed.
    pub moduli: StepModuli,
    /// No step is longer, a time.
    pub longest: f64,
}

/// Which moduli the stable step is computed from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum StepModuli {
    /// The elastic moduli: a rigorous bound also when a plastic element unloads.
    #[default]
    Elastic,
    /// PRONTO's effective moduli of the last increment: larger steps in plastic flow, no longer a bound.
    Effective,
}

/// PRECISION: of the state and the kernels of elements. Nodes, forces on them, energies and time are double in both.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Precision {
    /// 64 bits.
    #[default]
    Double,
    /// 32 bits.
    Single,
}

/// TIME STEP ESTIMATE: what bounds the time step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum StepEstimate {
    /// The bound of each element alone: rigorous.
    #[default]
    Element,
    /// The largest frequency of the mesh, by iterations every so many steps.
    Global,
}

/// MASS SCALING: mass that is added to the elements of a block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MassScaling {
    /// Number of the block; `None` for all blocks.
    pub block: Option<i64>,
    /// How much.
    pub scale: ScaleMass,
    /// Largest added mass of a block over the mass of its material.
    pub limit: f64,
}

/// How much mass is added to an element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ScaleMass {
    /// As much as it needs for a time step of this length, if it needs any.
    Step(f64),
    /// Its mass times this factor, which is at least 1, less its mass.
    Factor(f64),
}

/// BULK VISCOSITY.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BulkViscosity {
    /// Linear coefficient b₁.
    pub linear: f64,
    /// Quadratic coefficient b₂.
    pub quadratic: f64,
}

/// Hourglass control of the one-point hexahedron.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Hourglass {
    /// Flanagan and Belytschko (1981): an elastic stiffness and a viscosity, both dimensionless.
    FlanaganBelytschko {
        /// Stiffness coefficient κ.
        stiffness: f64,
        /// Viscosity coefficient ε.
        viscosity: f64,
    },
    /// Belytschko and Bindeman (1993): stiffness from an assumed strain field, following plastic flow.
    AssumedStrain {
        /// Factor on the assumed strain stiffness; 1 is the theory.
        factor: f64,
    },
}

/// FUNCTION: piecewise linear, constant outside its points.
#[derive(Debug, Clone, PartialEq)]
pub struct Function {
    /// The function's number.
    pub id: i64,
    /// Points `(t, f)` with increasing `t`; at least one.
    pub points: Vec<(f64, f64)>,
}

/// MATERIAL: the law of one element block.
#[derive(Debug, Clone, PartialEq)]
pub struct BlockMaterial {
    /// The element block's number.
    pub block: i64,
    /// Mass density ρ₀, mass/length³.
    pub density: f64,
    /// The constitutive law with its parameters.
    pub law: Law,
}

/// A coordinate direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// x
    X,
    /// y
    Y,
    /// z
    Z,
}

impl Direction {
    /// 0, 1 or 2.
    pub fn axis(self) -> usize {
        self as usize
    }
}

/// What of a node is held, driven or loaded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unknown {
    /// Its position, by forces.
    Position,
    /// Its rotation, by moments.
    Rotation,
}

/// NO DISPLACEMENT and NO ROTATION.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NoDisplacement {
    /// Position or rotation.
    pub of: Unknown,
    /// Direction held.
    pub direction: Direction,
    /// Node set number.
    pub node_set: i64,
}

/// PRESCRIBED DISPLACEMENT, VELOCITY, ACCELERATION, ROTATION or ANGULAR VELOCITY.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrescribedMotion {
    /// Position or rotation.
    pub of: Unknown,
    /// Which derivative of the position is given.
    pub kind: MotionKind,
    /// Direction of the motion.
    pub direction: Direction,
    /// Node set number.
    pub node_set: i64,
    /// Index into [`Model::functions`].
    pub function: usize,
    /// Factor on the function.
    pub scale: f64,
}

/// What a prescribed motion prescribes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MotionKind {
    /// Displacement from the initial position.
    Displacement,
    /// Velocity.
    Velocity,
    /// Acceleration.
    Acceleration,
}

/// PRESCRIBED FORCE or PRESCRIBED MOMENT on every node of a set.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrescribedForce {
    /// Position, for a force, or rotation, for a moment.
    pub of: Unknown,
    /// Direction of the force.
    pub direction: Direction,
    /// Node set number.
    pub node_set: i64,
    /// Index into [`Model::functions`].
    pub function: usize,
    /// Factor on the function.
    pub scale: f64,
}

/// POINT MASS at every node of a set.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointMass {
    /// Node set number.
    pub node_set: i64,
    /// Mass per node.
    pub mass: f64,
    /// Rotary inertia per node, the same about all axes.
    pub inertia: f64,
}

/// PRESSURE on the deformed faces of a side set; positive pushes on the face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pressure {
    /// Side set number.
    pub side_set: i64,
    /// Index into [`Model::functions`].
    pub function: usize,
    /// Factor on the function.
    pub scale: f64,
}

/// GRAVITY: a body acceleration of the whole model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gravity {
    /// Acceleration vector, length/time².
    pub acceleration: [f64; 3],
    /// Index into [`Model::functions`] of a factor; constant 1 without it.
    pub function: Option<usize>,
}

/// INITIAL VELOCITY.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum InitialVelocity {
    /// Every node of an element block.
    Material {
        /// Element block number.
        block: i64,
        /// Velocity vector.
        velocity: [f64; 3],
    },
    /// Every node of a node set.
    NodeSet {
        /// Node set number.
        node_set: i64,
        /// Velocity vector.
        velocity: [f64; 3],
    },
    /// Every node of an element block, away from a point or from an axis.
    Radial {
        /// Element block number.
        block: i64,
        /// Speed, negative towards the point or the axis.
        speed: f64,
        /// The point, or a point of the axis.
        point: [f64; 3],
        /// Direction of the axis, unit length; `None` for the point alone.
        axis: Option<[f64; 3]>,
    },
    /// Rotation of an element block about an axis, added to the velocity the nodes already have.
    Angular {
        /// Element block number.
        block: i64,
        /// Angular velocity ω about the axis, radians/time, right-hand rule.
        omega: f64,
        /// A point of the axis.
        point: [f64; 3],
        /// Direction of the axis, unit length.
        axis: [f64; 3],
    },
}

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

/// TIED CONTACT: the nodes of a surface follow the faces of another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tie {
    /// Numbers of the side sets: of the surface that follows, and of the other.
    pub side_sets: [i64; 2],
    /// Largest distance between the two, as a part of the root of a face's area.
    pub tolerance: f64,
}

/// DEATH: elements of a block are taken away when a variable passes a value.
#[derive(Debug, Clone, PartialEq)]
pub struct Death {
    /// Element block number.
    pub block: i64,
    /// What is watched.
    pub variable: DeathVariable,
    /// Whether the value is a largest one; a smallest one otherwise.
    pub is_maximum: bool,
    /// The value.
    pub value: f64,
    /// Whether nodes that lose their last element go on as free masses.
    pub keeps_nodes: bool,
    /// Part of the points of integration that must have passed the value before an element with several of them goes.
    pub share: f64,
}

/// What DEATH watches.
#[derive(Debug, Clone, PartialEq)]
pub enum DeathVariable {
    /// A state variable of the material.
    State(String),
    /// A component of an element field of the plot file.
    Field(ElementField, usize),
    /// Present volume over initial volume; 0 is inversion.
    Volume,
    /// The stable time step of the element.
    TimeStep,
}

impl DeathVariable {
    /// Its name in the command.
    pub fn name(&self) -> &str {
        match self {
            DeathVariable::State(name) => name,
            DeathVariable::Field(field, component) => field.components().get(*component).copied().unwrap_or_default(),
            DeathVariable::Volume => "VOLUME",
            DeathVariable::TimeStep => "TMSTEP",
        }
    }
}

/// PLOT NODAL, PLOT ELEMENT, PLOT STATE.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PlotRequests {
    /// Nodal fields, in EXODUS order; DISPLACEMENT is always first.
    pub nodal: Vec<NodalField>,
    /// Element fields.
    pub element: Vec<ElementField>,
    /// Names of material state variables.
    pub state: Vec<String>,
    /// Energies of each block, as global variables.
    pub block_energies: bool,
}

/// Groups of columns that STEP LOG can ask for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StepColumns {
    /// None beside PRONTO's own.
    Pronto,
    /// The time step and the element that sets it.
    TimeStep,
    /// The energy accounts and their balance.
    Energy,
    /// The error of the energy balance alone.
    EnergyError,
    /// The momentum of the body.
    Momentum,
    /// Seconds to the termination time.
    ToGo,
}

impl StepColumns {
    /// All of them.
    pub const ALL: [StepColumns; 6] =
        [Self::Pronto, Self::TimeStep, Self::Energy, Self::EnergyError, Self::Momentum, Self::ToGo];
    /// What a log has when the deck does not say: PRONTO's 132 columns hold it.
    pub const USUAL: [StepColumns; 3] = [Self::TimeStep, Self::ToGo, Self::EnergyError];

    /// The word that STEP LOG knows.
    pub fn keyword(self) -> &'static str {
        match self {
            Self::Pronto => "PRONTO",
            Self::TimeStep => "TIME STEP",
            Self::Energy => "ENERGY",
            Self::EnergyError => "ENERGY ERROR",
            Self::Momentum => "MOMENTUM",
            Self::ToGo => "TO GO",
        }
    }
}

macro_rules! fields {
    ($(#[$m:meta])* $name:ident { $($(#[$doc:meta])* $variant:ident = $keyword:literal, [$($component:literal),+], $meaning:literal;)+ }) => {
        $(#[$m])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum $name { $($(#[$doc])* $variant,)+ }
        impl $name {
            /// All fields.
            pub const ALL: &'static [$name] = &[$($name::$variant),+];
            /// The word that the PLOT command knows.
            pub fn keyword(self) -> &'static str { match self { $($name::$variant => $keyword,)+ } }
            /// Names of the EXODUS variables, one per component in space.
            pub fn components(self) -> &'static [&'static str] { match self { $($name::$variant => &[$($component),+],)+ } }
            /// What the field is, for the manual.
            pub fn meaning(self) -> &'static str { match self { $($name::$variant => $meaning,)+ } }
        }
    };
}

fields! {
    /// What PLOT NODAL can ask for.
    NodalField {
        /// u
        Displacement = "DISPLACEMENT", ["DISPLX", "DISPLY", "DISPLZ"], "displacement from the initial position, length";
        /// v
        Velocity = "VELOCITY", ["VELX", "VELY", "VELZ"], "velocity at the time of the state, length/time";
        /// a
        Acceleration = "ACCELERATION", ["ACCLX", "ACCLY", "ACCLZ"], "acceleration, length/time squared";
        /// r
        Reaction = "REACTION", ["RX", "RY", "RZ"], "force that holds or drives a node: constraints, prescribed motion, rigid surfaces";
        /// m
        Mass = "MASS", ["NODMASS"], "lumped nodal mass";
        /// contact
        Contact = "CONTACT", ["CONTX", "CONTY", "CONTZ", "CONTGAP", "CONTSTAT", "CONTFACE"], "contact force, of rigid surfaces too; overlap that is closed in the coming step; 0 free, 1 pushed, 2 pushed as a node on a face; element of that face";
        /// angle
        Rotation = "ROTATION", ["ROTX", "ROTY", "ROTZ"], "integral of the rotation rate of a node of shells or beams, radians";
        /// rotation rate
        RotationRate = "ROTATION RATE", ["ROTVELX", "ROTVELY", "ROTVELZ"], "rotation rate of a node of shells or beams, radians/time";
        /// home
        ContactRank = "CONTACT RANK", ["CONTRANK"], "rank that computes the contact of a node, −1 where there is none";
    }
}

fields! {
    /// What PLOT ELEMENT can ask for.
    ElementField {
        /// Cauchy stress
        Stress = "STRESS", ["SIGXX", "SIGYY", "SIGZZ", "TAUXY", "TAUYZ", "TAUZX"], "Cauchy stress without bulk viscosity, positive in tension, force/length squared";
        /// Hencky strain
        Strain = "STRAIN", ["EPSXX", "EPSYY", "EPSZZ", "EPSXY", "EPSYZ", "EPSZX"], "logarithmic strain ln V, tensor shear components";
        /// p
        Pressure = "PRESSURE", ["PRESSURE"], "minus the mean stress, positive in compression";
        /// von Mises
        VonMises = "VONMISES", ["VONMISES"], "von Mises equivalent stress";
        /// energy per volume
        Energy = "ENERGY", ["ENERGY"], "work of the stress since the start per unit initial volume: internal energy without the heat of viscosities";
        /// energy per mass
        SpecificEnergy = "EINT", ["EINT"], "specific internal energy, energy/mass, as an equation of state sees it: INITIAL ENERGY, work of the stress and of bulk viscosity, in fluids of hourglass resistance too";
        /// T
        Temperature = "TEMPERATURE", ["TEMPERATURE"], "temperature, of materials that have one (JOHNSON COOK), else 0";
        /// rho
        Density = "DENSITY", ["DENSITY"], "current mass density";
        /// hourglass energy
        HourglassEnergy = "HOURGLASS", ["HGENERGY"], "hourglass energy per unit initial volume";
        /// V
        Stretch = "STRETCH", ["STRETXX", "STRETYY", "STRETZZ", "STRETXY", "STRETYZ", "STRETZX"], "left stretch V, the stretch seen in space";
        /// R
        Rotation = "ROTATION", ["R11", "R12", "R13", "R21", "R22", "R23", "R31", "R32", "R33"], "rotation R of the element, with F = V R";
        /// q
        BulkViscosity = "BULKQ", ["BULKQ"], "pressure of the bulk viscosity in the last step, positive in compression";
        /// corner Jacobian
        Corners = "CORNERS", ["CORNER"], "least Jacobian of the corners over the mean one: 1 in a parallelepiped, 0 or less where a corner is inside out";
        /// thickness
        Thickness = "THICKNESS", ["THICKNESS"], "present thickness of shells, length";
        /// resultants
        Resultants = "RESULTANTS", ["NXX", "NYY", "NXY", "MXX", "MYY", "MXY", "QX", "QY"], "forces and moments of shells per length, in the frame of the element";
        /// alive
        Status = "STATUS", ["STATUS"], "1 for an element, 0 for one that was taken away";
        /// rank
        Rank = "RANK", ["RANK"], "rank that computes the element";
    }
}

impl ElementField {
    /// Whether it differs between the points of integration of an element, and is plotted at some of them.
    pub fn of_points(self) -> bool {
        matches!(self, ElementField::Stress | ElementField::Pressure | ElementField::VonMises)
    }
}
