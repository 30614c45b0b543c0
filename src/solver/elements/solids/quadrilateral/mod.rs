//! The four-node quadrilateral with one point of integration, in plane strain and about an axis; also as triangle.
//!
//! The mean gradient of Flanagan and Belytschko (1981) in the plane. Of the third dimension the model says what it is:
//! [`sections::Section`]. Forces, masses and energies are those of a unit of thickness,
//! or of the whole turn of 2π radians.

mod end;
mod exact;
mod fluid;
pub mod hourglass;
mod kernel;
pub mod kinematics;
pub mod sections;

use crate::lanes::{Matrix3, Sym3};
use crate::material::{Kernel, KernelVisitor, Law, Start};
use crate::mesh::plane::{self, Corners};
use crate::mesh::{Block, Shape};
use crate::model::{Analysis, Hourglass, Model, StepModuli};
use crate::solver::body::centroid;
use crate::solver::elements::{
    Energies, Entry, Formulation, Group, NewElement, Pass, PassOutcome, PassSettings, Sample, Steps, StoredRow, Unfit,
};
use crate::solver::nodes::Nodes;
use kernel::{Physics, Settings, solid};
use sections::{Operator, Section};

/// Rows of an element's state, in the order in which they are stored; the law's own rows follow.
pub mod rows {
    /// Cauchy stress in the element's frame: xx, yy, zz, xy.
    pub const STRESS: usize = 0;
    /// Right stretch in the element's frame, four components in the same order.
    pub const STRETCH: usize = 4;
    /// Cosine and sine of the frame's angle.
    pub const FRAME: usize = 8;
    /// Hourglass resistance in the frame, per unit of thickness.
    pub const HOURGLASS: usize = 10;
    /// Internal energy since the start.
    pub const INTERNAL_ENERGY: usize = 12;
    /// Hourglass energy since the start.
    pub const HOURGLASS_ENERGY: usize = 13;
    /// Energy taken up by bulk viscosity since the start.
    pub const VISCOUS_ENERGY: usize = 14;
    /// Bulk viscosity q of the last step, added to the mean stress.
    pub const VISCOUS_STRESS: usize = 15;
    /// One over the element's part of the mass of each corner.
    pub const INVERSE_MASS: usize = 16;
    /// First row of the law.
    pub const LAW: usize = 20;
}

const ROWS: [StoredRow; rows::LAW] = [
    StoredRow { name: "USIGXX", dimension: "force/length^2" },
    StoredRow { name: "USIGYY", dimension: "force/length^2" },
    StoredRow { name: "USIGZZ", dimension: "force/length^2" },
    StoredRow { name: "USIGXY", dimension: "force/length^2" },
    StoredRow { name: "USTRXX", dimension: "-" },
    StoredRow { name: "USTRYY", dimension: "-" },
    StoredRow { name: "USTRZZ", dimension: "-" },
    StoredRow { name: "USTRXY", dimension: "-" },
    StoredRow { name: "COSTHETA", dimension: "-" },
    StoredRow { name: "SINTHETA", dimension: "-" },
    StoredRow { name: "HGX", dimension: "force/length" },
    StoredRow { name: "HGY", dimension: "force/length" },
    StoredRow { name: "EINTERN", dimension: "energy" },
    StoredRow { name: "EHOURGL", dimension: "energy" },
    StoredRow { name: "EVISCOUS", dimension: "energy" },
    StoredRow { name: "BULKQ", dimension: "force/length^2" },
    StoredRow { name: "INVMASS1", dimension: "1/mass" },
    StoredRow { name: "INVMASS2", dimension: "1/mass" },
    StoredRow { name: "INVMASS3", dimension: "1/mass" },
    StoredRow { name: "INVMASS4", dimension: "1/mass" },
];

pub(in crate::solver::elements) static ENTRY: Entry = Entry {
    name: "QUADRILATERAL",
    summary: "Four nodes in the plane, one point of integration, in plane strain or axisymmetric; also as triangle.",
    shape: Shape::Plane,
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

/// What holds for all quadrilaterals of a block.
#[derive(Debug, Clone)]
pub struct Quadrilateral {
    /// Hourglass control.
    pub hourglass: Hourglass,
    /// What stands for the third dimension.
    pub section: Section,
}

impl Quadrilateral {
    /// Volume of the whole turn, or of a unit of thickness.
    fn whole(&self, corners: &Corners) -> f64 {
        self.section.turn() * if self.section.about_axis() { plane::swept(corners) } else { plane::area(corners) }
    }
}

impl Formulation for Quadrilateral {
    fn of_block(block: &Block, model: &Model) -> Result<Self, Unfit> {
        match model.analysis {
            Analysis::Solid => Err(Unfit {
                reason: "its quadrilaterals lie in a plane".into(),
                help: "add AXISYMMETRIC or PLANE STRAIN to the deck".into(),
            }),
            Analysis::PlaneStrain => Ok(Quadrilateral { hourglass: model.hourglass, section: Section::PlaneStrain }),
            Analysis::Axisymmetric => Ok(Quadrilateral { hourglass: model.hourglass, section: Section::Axisymmetric }),
            Analysis::AxisymmetricCompatible => {
                let material = model.materials.iter().find(|material| material.block == block.id);
                if material.is_some_and(|material| material.law.equation_of_state().is_none()) {
                    return Err(Unfit {
                        reason: "its material has no equation of state, which the compatible form asks for".into(),
                        help: "AXISYMMETRIC alone computes every material".into(),
                    });
                }
                Ok(Quadrilateral { hourglass: model.hourglass, section: Section::Compatible })
            }
        }
    }

    fn weigh(&self, element: &Sample, density: f64, shares: &mut [f64]) -> f64 {
        let (Ok(nodes), Ok(corners)) = (element.nodes.try_into(), element.corners.try_into()) else { return 0.0 };
        shares.copy_from_slice(&self.section.mass_shares(nodes, corners));
        density * self.whole(corners)
    }

    fn start(&self, element: &NewElement, _: f64, own: &mut [f64]) -> Start {
        let corners: Corners = element.corners[..].try_into().unwrap_or_default();
        let nodes: [u32; 4] = element.nodes[..].try_into().unwrap_or_default();
        let frame = own_axis(&corners);
        let shares = self.section.mass_shares(&nodes, &corners);
        unstressed(frame, &shares.map(|share| share * (element.mass + element.added)), own);
        Start { centre: centroid(&corners), length: plane::area(&corners).sqrt(), frame: matrix(frame) }
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
            control: self.hourglass,
        };
        law.accept(OfLaw { section: self.section, pass, settings })
    }

    fn stand_in(&self, density: f64, edge: f64, own: &mut [f64]) -> f64 {
        let corners = [[0.0; 3], [edge, 0.0, 0.0], [edge, edge, 0.0], [0.0, edge, 0.0]];
        let mass = density * self.whole(&corners);
        let shares = self.section.mass_shares(&[0, 1, 2, 3], &corners);
        unstressed([1.0, 0.0], &shares.map(|share| share * mass), own);
        mass
    }

    fn volume(&self, group: &Group, i: usize, nodes: &Nodes) -> f64 {
        self.whole(&group.positions(i, nodes))
    }

    fn frame(&self, group: &Group, i: usize, _: &Nodes) -> Matrix3<f64> {
        matrix(group.values::<2>(i, rows::FRAME))
    }

    fn initial_frame(&self, group: &Group, i: usize, nodes: &Nodes) -> Matrix3<f64> {
        matrix(own_axis(&group.initial_positions(i, nodes)))
    }

    fn stress(&self, group: &Group, i: usize) -> Sym3<f64> {
        tensor(group, i, rows::STRESS)
    }

    fn stretch(&self, group: &Group, i: usize, _: &Nodes) -> Sym3<f64> {
        tensor(group, i, rows::STRETCH)
    }

    fn least_corner(&self, group: &Group, i: usize, nodes: &Nodes) -> f64 {
        group.all_nodes(i).map_or(1.0, |own| plane::least_corner(&own, &group.positions(i, nodes)))
    }

    /// Of stress and bulk viscosity; hourglass forces are left out.
    fn last_half_step(&self, group: &Group, i: usize, nodes: &Nodes, time_step: f64) -> f64 {
        let viscous = group.value(i, rows::VISCOUS_STRESS);
        let s = self.stress(group, i).add_diagonal(viscous).rotate(&self.frame(group, i, nodes));
        let v: [[f64; 3]; 4] = group.velocities(i, nodes);
        let x: [[f64; 3]; 4] = group.positions(i, nodes);
        let before = [0, 1].map(|axis: usize| [0, 1, 2, 3].map(|n: usize| x[n][axis] - time_step * v[n][axis]));
        let height = before[1][0];
        let relative = [before[0], before[1].map(|y| y - height)];
        let operator = self.section.of_forces(self.section.operator::<f64>(&relative), &relative);
        let Operator { radial, axial, hoop, .. } = operator;
        let of_corner = |n: usize| {
            let [along, across] =
                [s.xx * radial[n] + s.xy * axial[n] + s.zz * hoop[n], s.xy * radial[n] + s.yy * axial[n]];
            along * v[n][0] + across * v[n][1]
        };
        let work = 0.5 * time_step * self.section.turn() * (0..4).map(of_corner).sum::<f64>();
        // An element that dies inverted may have moved beyond all measure.
        if work.is_finite() { work } else { 0.0 }
    }

    fn last_exact_work(&self, group: &Group, i: usize, nodes: &Nodes, law: &Law, steps: Steps) -> Option<f64> {
        law.accept(exact::LastWork { section: self.section, group, i, nodes, steps })
    }
}

/// Rows of an element in this frame that has not been strained, whose corners have these masses.
fn unstressed(frame: [f64; 2], masses: &[f64; 4], own: &mut [f64]) {
    own[rows::STRETCH..rows::STRETCH + 3].fill(1.0);
    own[rows::FRAME..rows::FRAME + 2].copy_from_slice(&frame);
    for (own, mass) in own[rows::INVERSE_MASS..].iter_mut().zip(masses) {
        *own = 1.0 / mass;
    }
}

fn tensor(group: &Group, i: usize, first: usize) -> Sym3<f64> {
    solid(group.values::<4>(i, first))
}

fn matrix([c, s]: [f64; 2]) -> Matrix3<f64> {
    [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]
}

/// Cosine and sine of the rotation nearest to the element's own axes, the polar factor of its mean Jacobian, which no numbering of the
/// corners chooses; of x where it has none.
fn own_axis(corners: &Corners) -> [f64; 2] {
    let along = |i: usize| {
        let (one, other) = (corners[2][i] - corners[0][i], corners[1][i] - corners[3][i]);
        [one + other, one - other]
    };
    let ([xi_x, eta_x], [xi_y, eta_y]) = (along(0), along(1));
    let (x, y) = (xi_x + eta_y, xi_y - eta_x);
    let length = (x * x + y * y).sqrt();
    if length > 0.0 { [x / length, y / length] } else { [1.0, 0.0] }
}

/// A pass that still has to learn its law.
struct OfLaw<'a> {
    section: Section,
    pass: Pass<'a>,
    settings: Settings,
}

impl KernelVisitor for OfLaw<'_> {
    type Output = PassOutcome;

    fn visit<K: Kernel>(self, law: K) -> PassOutcome {
        self.pass.over(&Physics { settings: self.settings, law: &law, section: self.section })
    }
}

#[cfg(test)]
mod tests;
