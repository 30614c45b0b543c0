//! The explicit method: central differences with velocities at mid-step, a lumped mass and a step that changes.
//!
//! One step, from state n to state n + 1, is [`Solver::prepare`], which finds forces and the step size at state n,
//! then whatever wants to look at state n, then [`Solver::advance`]. The solver knows no deck words and no files.

mod clock;
pub mod contact;
mod domain;
pub mod elements;
mod erosion;
mod forces;
mod health;
mod lanczos;
pub mod loads;
mod present;
pub mod rigid;
mod state;
pub mod tied;
mod time_step;
mod totals;

pub use clock::{Clock, Section};
pub use domain::fit::{idle_deaths, idle_rotations, unfit_blocks};
pub use domain::joints::{loose, studs};
pub use domain::trial::BlockTrial;
pub use domain::{Body, Cut, Domain, NoMaterial, Rotations, centroid, nodes, state_names};
pub use health::stop::{ElementPlace, Stop};
pub use health::{Evidence, Finding, Spot, of_overlaps};
pub use rigid::{BodyShape, RigidBodies};
pub use state::remembered::Remembered;
pub use tied::{Tied, TiedReport, Ties};
pub use time_step::{AddedMass, BlockMass, Slivers};
pub use totals::Totals;

use crate::comm::{Communicator, Traffic};
use crate::lanes::{Force, InstructionSet};
use crate::mesh::Mesh;
use crate::model::{Function, Model, MotionKind, StepEstimate, TimeStepControl};
use crate::partition::Share;
use domain::{Axis, body, constraints};
use elements::{PassOutcome, PassSettings, Steps};
use health::Watch;
use time_step::{GlobalStep, REACHED};

/// One rank's solver.
pub struct Solver {
    /// This rank's part of the problem.
    pub domain: Domain,
    /// Where the time went.
    pub clock: Clock,
    /// Number of steps taken.
    pub step: u64,
    /// Time of the present state.
    pub time: f64,
    /// Time of the state before; that of the first one is its own.
    pub previous_time: f64,
    /// Step that leads from the present state to the next, a time.
    pub time_step: f64,
    /// The same, had the end of the run not made it shorter.
    pub whole_step: f64,
    /// Largest stable step of the present state, a time.
    pub stable_step: f64,
    /// The largest that every element alone allows.
    pub own_step: f64,
    /// Kinetic energy at the start.
    pub initial_energy: f64,
    /// What histories compare the present state with.
    pub remembered: Remembered,
    /// What the first state says of the elements that set the step; `None` in a run that goes on from another.
    pub slivers: Option<Slivers>,
    /// Energies and momenta when they were last summed, and the step at which that was.
    last_totals: Option<(u64, Totals)>,
    kick: f64,
    first_stable_step: Option<f64>,
    /// The stable step of the mesh as a whole, where the deck asks for it.
    global_step: Option<GlobalStep>,
    /// What the run has found out about itself.
    watch: Watch,
    local: PassOutcome,
    control: TimeStepControl,
    /// Time that the last step shall reach, where there is one.
    end: Option<f64>,
    /// Whether steps have been made shorter for it.
    ending: bool,
    pass: PassSettings,
    functions: Vec<Function>,
    /// Velocities that are prescribed at the start: local node, axis and value, ascending.
    prescribed: Vec<(u32, usize, f64)>,
}

/// Something that all ranks agree on at every step; the largest request of any rank wins.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Request {
    /// Go on.
    Continue,
    /// Write a last state and leave: a shutdown file was found.
    Shutdown,
    /// Write a last state and leave: a signal with this number.
    Signal(u8),
}

impl Request {
    fn from_number(n: f64) -> Request {
        match n as u8 {
            0 => Request::Continue,
            1 => Request::Shutdown,
            n => Request::Signal(n - 2),
        }
    }

    fn to_number(self) -> f64 {
        f64::from(match self {
            Request::Continue => 0,
            Request::Shutdown => 1,
            Request::Signal(n) => n.saturating_add(2),
        })
    }

    /// Who asks: "by SIGTERM"; nothing where nobody does.
    pub fn asked_by(self) -> Option<String> {
        match self {
            Request::Continue => None,
            Request::Shutdown => Some("by the shutdown file".to_string()),
            Request::Signal(n) => {
                let name = signal_hook::low_level::signal_name(n.into());
                Some(name.map_or_else(|| format!("by signal {n}"), |name| format!("by {name}")))
            }
        }
    }
}

fn prescribed_at_start(domain: &Domain, functions: &[Function]) -> Vec<(u32, usize, f64)> {
    let start = |constraint: &constraints::Constraint| {
        let motion = constraint.motion.filter(|motion| motion.kind == MotionKind::Velocity)?;
        Some((constraint.node, constraint.axis, motion.scale * functions[motion.function].value(0.0)))
    };
    let mut all: Vec<_> = domain.constraints.iter().filter_map(start).collect();
    all.sort_by_key(|(node, axis, _)| (*node, *axis));
    all
}

impl Solver {
    /// One rank's share of the problem in its initial state.
    pub fn new(mesh: &Mesh, model: &Model, body: &Body, share: &Share, comm: &mut dyn Communicator) -> Solver {
        let mut domain = Domain::new(mesh, model, body, share, comm);
        let global_step = (model.step_estimate == StepEstimate::Global).then(|| GlobalStep::new(&mut domain));
        let initial_energy = totals::initial_kinetic_energy(&domain, comm);
        let flight_energy = totals::flight_energy(&domain, model.free_axes(), comm);
        Solver {
            prescribed: prescribed_at_start(&domain, &model.functions),
            watch: Watch::new(mesh, model, body, share, [initial_energy, flight_energy]),
            domain,
            clock: Clock::default(),
            step: 0,
            time: 0.0,
            previous_time: 0.0,
            time_step: 0.0,
            whole_step: 0.0,
            stable_step: 0.0,
            own_step: 0.0,
            initial_energy,
            remembered: Remembered::default(),
            slivers: None,
            last_totals: None,
            kick: 0.0,
            first_stable_step: None,
            global_step,
            local: PassOutcome::NOTHING,
            control: model.time_step,
            end: None,
            ending: false,
            pass: PassSettings {
                time: 0.0,
                time_step: 0.0,
                kick: 0.0,
                bulk_viscosity: model.bulk_viscosity,
                moduli: model.time_step.moduli,
                instructions: InstructionSet::detect(),
            },
            functions: model.functions.clone(),
        }
    }

    /// Chooses the instruction set of the element kernels; results do not depend on it.
    pub fn use_instructions(&mut self, instructions: InstructionSet) {
        self.pass.instructions = instructions;
    }

    /// Finds the forces of the present state and the step to the next one; `request` is this rank's wish, the
    /// answer what all ranks agreed on. After an error the state can still be looked at, but not advanced.
    ///
    /// # Errors
    ///
    /// The state makes no sense any more: see [`Stop`].
    pub fn prepare(&mut self, request: Request, comm: &mut dyn Communicator) -> Result<Request, Stop> {
        comm.enter(Traffic::Erosion);
        self.erode(comm);
        self.domain.rigid.iter_mut().for_each(RigidBodies::begin);
        comm.enter(Traffic::Elements);
        // Where the mesh as a whole bounds the step, a few elements do not.
        let kept = (self.step == 0 && self.global_step.is_none()).then(|| self.keep_steps());
        self.internal_forces(comm);
        comm.enter(Traffic::Step);
        let agreed = match self.agree(request, comm) {
            Ok(agreed) => agreed,
            Err(stop) => {
                // The forces of a failed element are no numbers; the state is shown as it was reached, without them.
                self.domain.nodes.forces.fill(Force::default());
                self.domain.forget_reactions();
                comm.enter(Traffic::Output);
                return Err(self.post_mortem(stop, comm));
            }
        };
        self.external_forces(comm);
        // Until the next step, all that is said is for sums, log and files.
        comm.enter(Traffic::Output);
        if let Some(kept) = kept.filter(|_| self.own_step.is_finite()) {
            self.weigh_steps(&kept, comm);
        }
        if self.step == 0 {
            // The first state is the initial condition itself; its velocities stand at time zero, not half a step before.
            self.last_totals = Some((0, totals::totals(&mut self.domain, [0.0; 2], comm)));
        }
        self.book_work(false);
        self.glance(comm)?;
        Ok(agreed)
    }

    /// Takes the prepared step.
    pub fn advance(&mut self) {
        self.clock.start();
        self.domain.nodes.integrate(self.kick, self.time_step);
        self.clock.stop(Section::Integration);
        self.book_work(true);
        if let Some(rigid) = &mut self.domain.rigid {
            self.clock.start();
            rigid.drift(&mut self.domain.nodes, self.time_step);
            self.clock.stop(Section::Integration);
        }
        self.previous_time = self.time;
        self.time += self.time_step;
        if self.ending {
            // The end is met to the bit.
            let end = self.end.filter(|end| (end - self.time).abs() <= REACHED * self.whole_step);
            self.time = end.unwrap_or(self.time);
        }
        self.step += 1;
    }

    /// Takes failed elements away, and lets the surface grow inwards.
    fn erode(&mut self, comm: &mut dyn Communicator) {
        let Domain { erosion, blocks, nodes, element_canonical, contact, pressure_faces, loads, .. } = &mut self.domain;
        let Some(erosion) = erosion else { return };
        self.clock.start();
        let steps = Steps { time_step: self.time_step, kick: self.kick };
        if let Some(dead) = erosion.advance(blocks, element_canonical, nodes, self.time, steps, comm) {
            loads::all(pressure_faces, loads).for_each(|load| load.lose(&dead, false));
            self.global_step.iter_mut().for_each(GlobalStep::forget);
            if let Some(contact) = contact {
                comm.enter(Traffic::ContactSearch);
                contact.erode(&dead, erosion, nodes, comm);
            }
        }
        self.clock.stop(Section::Erosion);
    }
}
