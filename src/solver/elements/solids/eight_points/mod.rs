//! The eight-node hexahedron with eight points of integration and the assumed strain field of Belytschko and Bindeman (1993), which
//! bends without locking and knows no hourglass modes.
//!
//! Frame, mean strain and gradient are those of the one-point hexahedron, once for all points; `field.rs` adds what the modes ηζ, ζξ,
//! ξη and ξηζ strain at each point, and takes the same field's transpose for the forces. Each point has a law of its own, so that
//! bending yields from the outside inwards and no stiffness has to be chosen.

mod field;
mod kernel;

use super::hexahedron::hourglass::{AssumedStrain, Either};
use super::hexahedron::kinematics::rotation_matrix;
use super::hexahedron::vibration::{FrameRows, Vibration};
use super::hexahedron::{HasConstantStiffness, begin, mean_power, own_axes, share_of_lightest, weigh};
use crate::lanes::{Matrix3, Sym3};
use crate::material::{Kernel, KernelVisitor, Law, Start};
use crate::mesh::check::hexahedron_volume;
use crate::mesh::corners::{all_corners_are_sound, least_corner};
use crate::mesh::{Block, Shape};
use crate::model::{Model, StepModuli};
use crate::solver::elements::{
    Energies, Entry, Formulation, Group, NewElement, Pass, PassOutcome, PassSettings, PointEntry, Probe, Sample,
    StoredRow, Unfit,
};
use crate::solver::nodes::Nodes;
use kernel::{EightPointStep, Settings};

/// Factor on the hourglass stiffness of elastic points that covers points in flow: the field with ν = ½ has 4 μ e² in bending, the
/// elastic one 2 μ e²/(1 − ν), the law's own moduli given.
const IN_FLOW: f64 = 2.0;

/// Points of integration.
const POINTS: usize = 8;

/// Rows of an element's state; those of its points follow.
mod rows {
    /// Right stretch of the mean motion in the frame, six components.
    pub const STRETCH: usize = 0;
    /// Frame as a unit quaternion.
    pub const FRAME: usize = 6;
    /// Internal energy since the start.
    pub const INTERNAL_ENERGY: usize = 10;
    /// Energy taken up by bulk viscosity since the start.
    pub const VISCOUS_ENERGY: usize = 11;
    /// Bulk viscosity q of the last step, added to the mean stress.
    pub const VISCOUS_STRESS: usize = 12;
    /// Share of the points that flowed in the last step.
    pub const FLOWING: usize = 13;
    /// The share by which the present forces were found.
    pub const FLOWING_BEFORE: usize = 14;
    /// First row of the points.
    pub const POINTS: usize = 15;
}

/// Rows of a point; those of its law follow.
mod point_rows {
    /// Cauchy stress in the frame: xx, yy, zz, xy, yz, zx.
    pub const STRESS: usize = 0;
    /// 1 where the point carries nothing any more.
    pub const LOST: usize = 6;
    /// First row of the law.
    pub const LAW: usize = 7;
}

const ROWS: [StoredRow; rows::POINTS] = [
    StoredRow { name: "USTRXX", dimension: "-" },
    StoredRow { name: "USTRYY", dimension: "-" },
    StoredRow { name: "USTRZZ", dimension: "-" },
    StoredRow { name: "USTRXY", dimension: "-" },
    StoredRow { name: "USTRYZ", dimension: "-" },
    StoredRow { name: "USTRZX", dimension: "-" },
    StoredRow { name: "FRAME0", dimension: "-" },
    StoredRow { name: "FRAME1", dimension: "-" },
    StoredRow { name: "FRAME2", dimension: "-" },
    StoredRow { name: "FRAME3", dimension: "-" },
    StoredRow { name: "EINTERN", dimension: "energy" },
    StoredRow { name: "EVISCOUS", dimension: "energy" },
    StoredRow { name: "BULKQ", dimension: "force/length^2" },
    StoredRow { name: "FLOWING", dimension: "-" },
    StoredRow { name: "FLOWED", dimension: "-" },
];

const POINT_ROWS: [StoredRow; point_rows::LAW] = [
    StoredRow { name: "USIGXX", dimension: "force/length^2" },
    StoredRow { name: "USIGYY", dimension: "force/length^2" },
    StoredRow { name: "USIGZZ", dimension: "force/length^2" },
    StoredRow { name: "USIGXY", dimension: "force/length^2" },
    StoredRow { name: "USIGYZ", dimension: "force/length^2" },
    StoredRow { name: "USIGZX", dimension: "force/length^2" },
    StoredRow { name: "USIGLOST", dimension: "-" },
];

pub(in crate::solver::elements) static ENTRY: Entry = Entry {
    name: "HEXAHEDRON, EIGHT POINTS",
    summary: "Eight nodes, eight points of integration with an assumed strain field, each with its own law; by ELEMENT.",
    shape: Shape::Hexahedron,
    rotations: false,
    rows: &ROWS,
    points: Some(PointEntry { rows: &POINT_ROWS, lost: point_rows::LOST, layered: false }),
    energies: Energies { internal: rows::INTERNAL_ENERGY, hourglass: None, viscous: Some(rows::VISCOUS_ENERGY) },
    viscous_stress: Some(rows::VISCOUS_STRESS),
};

/// Such hexahedra; nothing differs between blocks of them.
#[derive(Debug, Clone)]
pub struct EightPoints;

/// Whether a law looks at the volume of its element: a point has none of its own.
struct SeesVolume;
impl KernelVisitor for SeesVolume {
    type Output = bool;
    fn visit<K: Kernel>(self, _: K) -> bool {
        K::VOLUME || K::EQUATION
    }
}

impl Formulation for EightPoints {
    fn takes(block: &Block, model: &Model) -> bool {
        model.has_eight_points(block.id)
    }

    fn of_block(block: &Block, model: &Model) -> Result<Self, Unfit> {
        let law = model.materials.iter().find(|material| material.block == block.id).map(|material| &material.law);
        match law.filter(|law| law.accept(SeesVolume)) {
            Some(law) => Err(Unfit {
                reason: format!(
                    "{} looks at the volume of its element, which eight points do not have",
                    law.entry().name
                ),
                help: "leave ELEMENT out: one point takes every law".into(),
            }),
            None => Ok(EightPoints),
        }
    }

    fn weigh(&self, element: &Sample, density: f64, shares: &mut [f64]) -> f64 {
        weigh(element, density, shares)
    }

    fn least_share(&self, element: &NewElement) -> f64 {
        share_of_lightest(element)
    }

    fn start(&self, element: &NewElement, _: f64, own: &mut [f64]) -> Start {
        let (axes, start) = begin(element);
        unstressed(&axes, own);
        start
    }

    fn run(&self, pass: Pass, law: &Law, _: f64, settings: &PassSettings) -> PassOutcome {
        let moduli = law.moduli();
        let settings = Settings {
            time: settings.time,
            time_step: settings.time_step,
            dilatational: moduli.dilatational(),
            mu: 0.5 * moduli.two_mu,
            poisson: moduli.poisson(),
            viscosity: settings.bulk_viscosity,
            effective_moduli: settings.moduli == StepModuli::Effective,
        };
        law.accept(OfLaw { pass, settings })
    }

    fn vibrates(&self, law: &Law) -> bool {
        law.accept(HasConstantStiffness)
    }

    fn probe(&self, probe: Probe, pass: Pass, (law, _): (&Law, f64), settings: &PassSettings) {
        pass.over(&Vibration {
            probe,
            moduli: law.moduli(),
            control: Either::AssumedStrain(AssumedStrain { factor: IN_FLOW }),
            viscosity: settings.bulk_viscosity,
            rows: FrameRows { frame: rows::FRAME, viscous_stress: rows::VISCOUS_STRESS },
            bounded: false,
            density: None,
        });
    }

    fn stand_in(&self, density: f64, edge: f64, own: &mut [f64]) -> f64 {
        unstressed(&[1.0, 0.0, 0.0, 0.0], own);
        density * edge * edge * edge
    }

    fn volume(&self, group: &Group, i: usize, nodes: &Nodes) -> f64 {
        hexahedron_volume(&group.positions(i, nodes))
    }

    fn frame(&self, group: &Group, i: usize, _: &Nodes) -> Matrix3<f64> {
        rotation_matrix(&group.values::<4>(i, rows::FRAME))
    }

    fn initial_frame(&self, group: &Group, i: usize, nodes: &Nodes) -> Matrix3<f64> {
        rotation_matrix(&own_axes(&group.initial_positions(i, nodes)))
    }

    fn stress(&self, group: &Group, i: usize) -> Sym3<f64> {
        let nothing = Sym3 { xx: 0.0, yy: 0.0, zz: 0.0, xy: 0.0, yz: 0.0, zx: 0.0 };
        (0..POINTS).fold(nothing, |sum, point| {
            sum.zip(self.point_stress(group, i, point), |sum, stress| sum + stress / POINTS as f64)
        })
    }

    fn points(&self) -> usize {
        POINTS
    }

    fn point_share(&self, _: usize) -> f64 {
        1.0 / POINTS as f64
    }

    fn point_stress(&self, group: &Group, i: usize, point: usize) -> Sym3<f64> {
        let stride = (group.stride - rows::POINTS) / POINTS;
        let [xx, yy, zz, xy, yz, zx] = group.values::<6>(i, rows::POINTS + point * stride + point_rows::STRESS);
        Sym3 { xx, yy, zz, xy, yz, zx }
    }

    fn stretch(&self, group: &Group, i: usize, _: &Nodes) -> Sym3<f64> {
        let [xx, yy, zz, xy, yz, zx] = group.values::<6>(i, rows::STRETCH);
        Sym3 { xx, yy, zz, xy, yz, zx }
    }

    fn least_corner(&self, group: &Group, i: usize, nodes: &Nodes) -> f64 {
        group.all_nodes(i).map_or(1.0, |own| least_corner(&own, &group.positions(i, nodes)))
    }

    fn corners_are_sound(&self, group: &Group, i: usize, nodes: &Nodes) -> bool {
        all_corners_are_sound(&group.positions(i, nodes))
    }

    /// Of the mean stress and bulk viscosity; what stresses vary between the points is left out.
    fn last_half_step(&self, group: &Group, i: usize, nodes: &Nodes, time_step: f64) -> f64 {
        let viscous = group.value(i, rows::VISCOUS_STRESS);
        let total = self.stress(group, i).add_diagonal(viscous).rotate(&self.frame(group, i, nodes)).matrix();
        let work =
            0.5 * time_step * mean_power(&total, &group.positions(i, nodes), &group.velocities(i, nodes), time_step);
        // An element that dies inverted may have moved beyond all measure.
        if work.is_finite() { work } else { 0.0 }
    }
}

/// Rows of an element in this frame that has not been strained.
fn unstressed(frame: &[f64; 4], own: &mut [f64]) {
    own[rows::STRETCH..rows::STRETCH + 3].fill(1.0);
    own[rows::FRAME..rows::FRAME + 4].copy_from_slice(frame);
}

/// A pass that still has to learn its law.
struct OfLaw<'a> {
    pass: Pass<'a>,
    settings: Settings,
}

impl KernelVisitor for OfLaw<'_> {
    type Output = PassOutcome;

    fn visit<K: Kernel>(self, law: K) -> PassOutcome {
        // What is refused needs no kernel: it would only have to be compiled.
        if K::VOLUME || K::EQUATION {
            return PassOutcome::NOTHING;
        }
        self.pass.over(&EightPointStep { law, settings: self.settings })
    }
}
