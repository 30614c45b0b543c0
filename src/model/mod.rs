//! What to simulate: the analyst's problem as plain data, checked and resolved.
//!
//! A [`Model`] holds no deck words and no arrays per node. The deck's commands fill it (`model::from_deck`),
//! `model::check` holds it against a mesh, and the solver reads it.

mod check;
mod conditions;
mod control;
mod interactions;
mod materials;
mod problem;
mod without_effect;

pub use check::check;
pub use conditions::{
    Direction, Function, Gravity, InitialVelocity, Jump, MotionKind, NoDisplacement, PointMass, PrescribedForce,
    PrescribedMotion, Pressure, Pulse, Unknown,
};
pub use control::{
    Analysis, BulkViscosity, DEFAULT_HOURGLASS, Death, DeathVariable, Deletion, ElementField, Hourglass, MassScaling,
    NodalField, PlotRequests, PlotSchedule, Precision, ReadRestart, Restarts, ScaleMass, Spin, StepColumns,
    StepEstimate, StepModuli, TimeStepControl, Watched, WriteRestart,
};
pub use interactions::{
    Contact, ContactControl, ContactData, ContactDecomposition, ContactEdges, ContactMaterials, ContactOverlap,
    ContactSearch, ContactSurface, Friction, RigidSurface, Tie,
};
pub use materials::{BlockMaterial, Section};
pub use problem::{Problem, examine, from_deck};

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
    /// Order of the spin of hexahedra with one point.
    pub spin: Spin,
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

impl Model {
    /// What a command says of a block; the last one counts.
    pub fn section(&self, command: &str, block: i64) -> Option<&Section> {
        self.sections.iter().rfind(|section| section.command == command && section.block == block)
    }

    /// Whether RIGID BODY names a block, by its number.
    pub fn is_rigid(&self, block: i64) -> bool {
        self.rigid_bodies.iter().flatten().any(|rigid| *rigid == block)
    }

    /// Axes along which nothing holds or drives the model, so that it goes on as a whole as it began but for its loads.
    pub fn free_axes(&self) -> [bool; 3] {
        if !self.rigid_surfaces.is_empty() || !self.silent_boundaries.is_empty() {
            return [false; 3];
        }
        let held = self.no_displacements.iter().map(|held| (held.of, held.direction));
        let driven = self.prescribed_motions.iter().map(|driven| (driven.of, driven.direction));
        let mut free = match self.analysis {
            Analysis::Solid => [true; 3],
            Analysis::PlaneStrain => [true, true, false],
            // Bodies of revolution move together along their axis alone.
            Analysis::Axisymmetric | Analysis::AxisymmetricCompatible => [false, true, false],
        };
        held.chain(driven).filter(|(of, _)| *of == Unknown::Position).for_each(|(_, axis)| free[axis.axis()] = false);
        free
    }

    /// Whether any material is a fluid: see [`Law::is_fluid`](crate::material::Law::is_fluid).
    pub fn has_fluids(&self) -> bool {
        self.materials.iter().any(|material| material.law.is_fluid())
    }
}

/// A model that says nothing yet. What is NaN here is required, follows from others, or has a command that always holds.
impl Default for Model {
    fn default() -> Model {
        Model {
            title: String::new(),
            analysis: Analysis::default(),
            termination_time: f64::NAN,
            output_interval: f64::NAN,
            step_log: Vec::new(),
            plot: PlotSchedule { interval: None, start: 0.0, stop: f64::NAN },
            time_step: TimeStepControl {
                scale: f64::NAN,
                softening: f64::NAN,
                growth: f64::NAN,
                moduli: StepModuli::default(),
                longest: f64::INFINITY,
            },
            rigid_bodies: Vec::new(),
            ties: Vec::new(),
            precision: Precision::default(),
            spin: Spin::default(),
            step_estimate: StepEstimate::default(),
            mass_scalings: Vec::new(),
            bulk_viscosity: BulkViscosity { linear: f64::NAN, quadratic: f64::NAN },
            hourglass: DEFAULT_HOURGLASS,
            functions: Vec::new(),
            materials: Vec::new(),
            sections: Vec::new(),
            no_displacements: Vec::new(),
            prescribed_motions: Vec::new(),
            point_masses: Vec::new(),
            prescribed_forces: Vec::new(),
            pressures: Vec::new(),
            gravities: Vec::new(),
            silent_boundaries: Vec::new(),
            initial_velocities: Vec::new(),
            rigid_surfaces: Vec::new(),
            contact: Contact::default(),
            deaths: Vec::new(),
            deletions: Vec::new(),
            plot_requests: PlotRequests::default(),
            material_points: Vec::new(),
            histories: Vec::new(),
            history_interval: None,
            restarts: Restarts::default(),
        }
    }
}
