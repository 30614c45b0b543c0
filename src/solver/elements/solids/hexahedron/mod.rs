//! The eight-node hexahedron with one point of integration (Flanagan and Belytschko 1981), also as wedge or pyramid.

mod barrier;
mod end;
mod exact;
mod fluid;
mod frame;
pub mod geometry;
pub mod hourglass;
pub(super) mod kernel;
pub mod kinematics;
pub mod single_precision;
pub(super) mod vibration;

use crate::lanes::{Matrix3, Sym3};
use crate::material::{Kernel, KernelVisitor, Law, Start};
use crate::mesh::check::hexahedron_volume;
use crate::mesh::corners::{all_corners_are_sound, least_corner};
use crate::mesh::hexahedron::{least_share, mass_shares};
use crate::mesh::{Block, Shape};
use crate::model::{Hourglass, Model, Precision, Spin, StepModuli};
use crate::solver::body::centroid;
use crate::solver::elements::{
    Energies, Entry, Formulation, Group, NewElement, Pass, PassOutcome, PassSettings, Probe, Sample, StepKernel, Steps,
    StoredRow, Unfit,
};
use crate::solver::nodes::Nodes;
pub(super) use frame::own_axes;
use geometry::{corners, gradient, modes};
use hourglass::{AssumedStrain, Control, Either, FlanaganBelytschko};
use kernel::{Physics, Settings};
use kinematics::rotation_matrix;
use vibration::{FrameRows, Vibration};

/// Rows of an element's state, in the order in which they are stored; the law's own rows follow.
pub mod rows {
    /// Cauchy stress in the element's frame: xx, yy, zz, xy, yz, zx.
    pub const STRESS: usize = 0;
    /// Right stretch in the element's frame, six components in the same order.
    pub const STRETCH: usize = 6;
    /// Frame as a unit quaternion.
    pub const FRAME: usize = 12;
    /// Hourglass resistance, mode by mode within each direction.
    pub const HOURGLASS: usize = 16;
    /// Internal energy since the start.
    pub const INTERNAL_ENERGY: usize = 28;
    /// Hourglass energy since the start.
    pub const HOURGLASS_ENERGY: usize = 29;
    /// Energy taken up by bulk viscosity since the start.
    pub const VISCOUS_ENERGY: usize = 30;
    /// Bulk viscosity q of the last step, added to the mean stress.
    pub const VISCOUS_STRESS: usize = 31;
    /// First row of the law.
    pub const LAW: usize = 32;
}

const ROWS: [StoredRow; rows::LAW] = [
    StoredRow { name: "USIGXX", dimension: "force/length^2" },
    StoredRow { name: "USIGYY", dimension: "force/length^2" },
    StoredRow { name: "USIGZZ", dimension: "force/length^2" },
    StoredRow { name: "USIGXY", dimension: "force/length^2" },
    StoredRow { name: "USIGYZ", dimension: "force/length^2" },
    StoredRow { name: "USIGZX", dimension: "force/length^2" },
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
    StoredRow { name: "HGX1", dimension: "force" },
    StoredRow { name: "HGX2", dimension: "force" },
    StoredRow { name: "HGX3", dimension: "force" },
    StoredRow { name: "HGX4", dimension: "force" },
    StoredRow { name: "HGY1", dimension: "force" },
    StoredRow { name: "HGY2", dimension: "force" },
    StoredRow { name: "HGY3", dimension: "force" },
    StoredRow { name: "HGY4", dimension: "force" },
    StoredRow { name: "HGZ1", dimension: "force" },
    StoredRow { name: "HGZ2", dimension: "force" },
    StoredRow { name: "HGZ3", dimension: "force" },
    StoredRow { name: "HGZ4", dimension: "force" },
    StoredRow { name: "EINTERN", dimension: "energy" },
    StoredRow { name: "EHOURGL", dimension: "energy" },
    StoredRow { name: "EVISCOUS", dimension: "energy" },
    StoredRow { name: "BULKQ", dimension: "force/length^2" },
];

pub(in crate::solver::elements) static ENTRY: Entry = Entry {
    name: "HEXAHEDRON",
    summary: "Eight nodes, one point of integration; also as wedge or pyramid, with repeated nodes.",
    shape: Shape::Hexahedron,
    rotations: false,
    rows: &ROWS,
    points: None,
    energies: Energies {
        internal: rows::INTERNAL_ENERGY,
        hourglass: Some(rows::HOURGLASS_ENERGY),
        viscous: Some(rows::VISCOUS_ENERGY),
    },
    viscous_stress: Some(rows::VISCOUS_STRESS),
};

/// What holds for all hexahedra of a block.
#[derive(Debug, Clone)]
pub struct Hexahedron {
    /// Hourglass control.
    pub hourglass: Hourglass,
    /// Precision of state and kernel.
    pub precision: Precision,
    /// Order of the frame's spin.
    pub spin: Spin,
}

impl Formulation for Hexahedron {
    fn of_block(_: &Block, model: &Model) -> Result<Self, Unfit> {
        Ok(Hexahedron { hourglass: model.hourglass, precision: model.precision, spin: model.spin })
    }

    fn precision(&self) -> Precision {
        self.precision
    }

    fn carried(&self) -> &'static [&'static str] {
        match self.precision {
            Precision::Double => &[],
            Precision::Single => &single_precision::carried::NAMES,
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
        unstressed(&axes, self.precision, own);
        start
    }

    fn run(&self, pass: Pass, law: &Law, density: f64, settings: &PassSettings) -> PassOutcome {
        let moduli = law.moduli();
        let settings = Settings {
            time_step: settings.time_step,
            kick: settings.kick,
            time: settings.time,
            density,
            dilatational: moduli.dilatational(),
            mu: 0.5 * moduli.two_mu,
            poisson: moduli.poisson(),
            viscosity: settings.bulk_viscosity,
            effective_moduli: settings.moduli == StepModuli::Effective,
            second_order_spin: self.spin == Spin::SecondOrder,
        };
        law.accept(OfLaw { control: self.hourglass, pass, settings, precision: self.precision })
    }

    /// A viscosity of hourglass control and laws whose stiffness changes would need more than a stiffness.
    fn vibrates(&self, law: &Law) -> bool {
        let viscous = matches!(self.hourglass, Hourglass::FlanaganBelytschko { viscosity, .. } if viscosity > 0.0);
        !viscous && law.accept(HasConstantStiffness)
    }

    fn probe(&self, probe: Probe, pass: Pass, (law, density): (&Law, f64), settings: &PassSettings) {
        let vibration = Vibration {
            probe,
            moduli: law.moduli(),
            control: either(self.hourglass),
            viscosity: settings.bulk_viscosity,
            rows: FrameRows { frame: rows::FRAME, viscous_stress: rows::VISCOUS_STRESS },
            bounded: true,
            density: law.accept(IsHypoelastic).then_some(density),
        };
        over(self.precision, pass, &vibration);
    }

    fn stand_in(&self, density: f64, edge: f64, own: &mut [f64]) -> f64 {
        unstressed(&[1.0, 0.0, 0.0, 0.0], self.precision, own);
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
        tensor(group, i, rows::STRESS)
    }

    fn stretch(&self, group: &Group, i: usize, _: &Nodes) -> Sym3<f64> {
        let stored = tensor(group, i, rows::STRETCH);
        match self.precision {
            Precision::Double => stored,
            // See `carried`.
            Precision::Single => stored.add_diagonal(1.0),
        }
    }

    fn least_corner(&self, group: &Group, i: usize, nodes: &Nodes) -> f64 {
        group.all_nodes(i).map_or(1.0, |own| least_corner(&own, &group.positions(i, nodes)))
    }

    fn corners_are_sound(&self, group: &Group, i: usize, nodes: &Nodes) -> bool {
        all_corners_are_sound(&group.positions(i, nodes))
    }

    /// Of stress and bulk viscosity; hourglass forces are left out.
    fn last_half_step(&self, group: &Group, i: usize, nodes: &Nodes, time_step: f64) -> f64 {
        let viscous = group.value(i, rows::VISCOUS_STRESS);
        let total = self.stress(group, i).add_diagonal(viscous).rotate(&self.frame(group, i, nodes)).matrix();
        let (now, v) = (group.positions(i, nodes), group.velocities(i, nodes));
        let work = 0.5 * time_step * mean_power(&total, &now, &v, time_step);
        // An element that dies inverted may have moved beyond all measure.
        if work.is_finite() { work } else { 0.0 }
    }

    fn last_exact_work(&self, group: &Group, i: usize, nodes: &Nodes, law: &Law, steps: Steps) -> Option<f64> {
        law.accept(exact::LastWork { group, i, nodes, steps })
    }
}

/// Mass of an element; its shares of the corners.
pub(super) fn weigh(element: &Sample, density: f64, shares: &mut [f64]) -> f64 {
    let (Ok(nodes), Ok(corners)) = (element.nodes.try_into(), element.corners.try_into()) else { return 0.0 };
    shares.copy_from_slice(&mass_shares(nodes, corners));
    density * hexahedron_volume(corners)
}

/// See [`Formulation::least_share`]: 1 but where corners coincide.
pub(super) fn share_of_lightest(element: &NewElement) -> f64 {
    let (Ok(nodes), Ok(corners)) = (element.nodes[..].try_into(), element.corners[..].try_into()) else { return 1.0 };
    least_share(nodes, &mass_shares(nodes, corners))
}

/// The frame of an element in its mesh, as a quaternion, and what its law begins with.
pub(super) fn begin(element: &NewElement) -> ([f64; 4], Start) {
    let corners: [[f64; 3]; 8] = element.corners[..].try_into().unwrap_or_default();
    let axes = own_axes(&corners);
    (
        axes,
        Start {
            centre: centroid(&corners),
            length: libm::cbrt(hexahedron_volume(&corners)),
            frame: rotation_matrix(&axes),
        },
    )
}

/// Power of a stress in space that is uniform in an element, with these velocities, where its corners were a step before.
pub(super) fn mean_power(stress: &Matrix3<f64>, now: &[[f64; 3]; 8], v: &[[f64; 3]; 8], time_step: f64) -> f64 {
    let operator = gradient(&[0, 1, 2].map(|axis| {
        modes(
            &[0, 1, 2, 3, 4, 5, 6, 7]
                .map(|n: usize| (now[n][axis] - now[0][axis]) - time_step * (v[n][axis] - v[0][axis])),
        )
    }));
    let mut power = 0.0;
    for j in 0..3 {
        let g = operator.g24[j];
        let b = corners(&[g[0], g[1], g[2], g[3], g[4], g[5], 0.0]);
        for n in 0..8 {
            power += (0..3).map(|k| stress[k][j] * v[n][k]).sum::<f64>() * b[n] / 192.0;
        }
    }
    power
}

/// Rows of an element in this frame that has not been strained.
fn unstressed(frame: &[f64; 4], precision: Precision, own: &mut [f64]) {
    own[rows::STRETCH..rows::STRETCH + 3].fill(if precision == Precision::Double { 1.0 } else { 0.0 });
    own[rows::FRAME..rows::FRAME + 4].copy_from_slice(frame);
}

fn tensor(group: &Group, i: usize, first: usize) -> Sym3<f64> {
    let [xx, yy, zz, xy, yz, zx] = group.values::<6>(i, first);
    Sym3 { xx, yy, zz, xy, yz, zx }
}

/// A pass that still has to learn its law.
struct OfLaw<'a> {
    control: Hourglass,
    pass: Pass<'a>,
    settings: Settings,
    precision: Precision,
}

impl KernelVisitor for OfLaw<'_> {
    type Output = PassOutcome;

    fn visit<K: Kernel>(self, law: K) -> PassOutcome {
        let control = either(self.control);
        if !K::FREQUENT {
            return self.with_control(&law, &control);
        }
        match control {
            Either::FlanaganBelytschko(control) => self.with_control(&law, &control),
            Either::AssumedStrain(control) => self.with_control(&law, &control),
        }
    }
}

/// A control that is chosen at run time.
fn either(control: Hourglass) -> Either {
    match control {
        Hourglass::FlanaganBelytschko { stiffness, viscosity } => {
            Either::FlanaganBelytschko(FlanaganBelytschko { stiffness, viscosity })
        }
        Hourglass::AssumedStrain { factor } => Either::AssumedStrain(AssumedStrain { factor }),
    }
}

/// Whether the elastic moduli of a law bound its stiffness.
pub(super) struct HasConstantStiffness;
impl KernelVisitor for HasConstantStiffness {
    type Output = bool;
    fn visit<K: Kernel>(self, _: K) -> bool {
        !K::STIFFNESS && !K::VOLUME && !K::EQUATION
    }
}

/// Whether the stress of a law follows the strain alone, so that a barrier holds the volume.
struct IsHypoelastic;
impl KernelVisitor for IsHypoelastic {
    type Output = bool;
    fn visit<K: Kernel>(self, _: K) -> bool {
        K::HYPOELASTIC
    }
}

impl OfLaw<'_> {
    fn with_control<K: Kernel, H: Control>(self, law: &K, control: &H) -> PassOutcome {
        over(self.precision, self.pass, &Physics { settings: self.settings, law, control })
    }
}

/// A pass in the precision of a block.
fn over<S: StepKernel<8>>(precision: Precision, pass: Pass, step: &S) -> PassOutcome {
    match precision {
        Precision::Double => pass.over(step),
        Precision::Single => pass.over_single(step),
    }
}

#[cfg(test)]
mod tests;
