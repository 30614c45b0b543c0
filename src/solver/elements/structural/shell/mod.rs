//! Shells: one point in their plane, one to nine through their thickness, any law of solids in plane stress.
//!
//! `facet.rs` says what a kind of shell says of itself; what that of four nodes is made of stands in `geometry.rs`, that of three in
//! `triangle.rs`; `plane_stress.rs` lets a law see a strain through the thickness by which there is no
//! stress. The step: rates at mid-step, strain ε + z κ at each point, in axes that turn with the material in the plane (exact
//! two-dimensional polar decomposition), stress, thickness t ← t (1 + mean Δε_zz), resultants, hourglass and drill resistance, and
//! forces at the end of the step.

mod facet;
mod geometry;
mod kernel;
mod plane_stress;
mod rule;
mod stable_step;
pub mod triangle;

use crate::lanes::{Matrix3, Sym3};
use crate::material::{Kernel, KernelVisitor, Law, Start};
use crate::mesh::{Block, Shape};
use crate::model::Model;
use crate::solver::body::centroid;
use crate::solver::elements::{
    Energies, Entry, Formulation, Group, NewElement, Pass, PassOutcome, PassSettings, PointEntry, Sample, StoredRow,
    Touch, Unfit,
};
use crate::solver::nodes::Nodes;
use facet::{Corners, Facet, Kind, Rows};
use geometry::{Quadrilateral, RESISTANCES};
use kernel::ShellStep;
pub use rule::MOST_POINTS;
use rule::Rule;
use stable_step::Stiffness;
use std::marker::PhantomData;

/// Rows of a shell's state; those of its points follow.
mod rows {
    /// ∂ξ_α/∂X_b of the element at the start, in axes of which the first is along ξ.
    pub const REFERENCE: usize = 0;
    /// Thickness.
    pub const THICKNESS: usize = 3;
    /// Thickness at the start.
    pub const START: usize = 4;
    /// Rotary inertia over mass.
    pub const INERTIA: usize = 5;
    /// Largest stable step when it was found last.
    pub const STEP: usize = 6;
    /// How much the element has changed since then, as a strain.
    pub const CHANGED: usize = 7;
    /// First of the resistances, behind which all other rows depend on their number: see [`super::facet::Rows`].
    pub const RESISTANCE: usize = 8;
}

/// Rows of a point; those of its law follow.
mod point_rows {
    /// Stress in the axes of the material.
    pub const XX: usize = 0;
    pub const YY: usize = 1;
    pub const XY: usize = 2;
    pub const YZ: usize = 3;
    pub const ZX: usize = 4;
    /// What is left of the stress through the thickness.
    pub const LEFT: usize = 5;
    /// 1 where the point carries nothing any more.
    pub const LOST: usize = 6;
    /// First row of the law.
    pub const LAW: usize = 7;
}

/// Of a shell of four nodes.
const QUADRILATERAL: Rows = Rows::of(RESISTANCES);

const ROWS: [StoredRow; QUADRILATERAL.points] = [
    StoredRow { name: "SHREF1", dimension: "1/length" },
    StoredRow { name: "SHREF2", dimension: "1/length" },
    StoredRow { name: "SHREF3", dimension: "1/length" },
    StoredRow { name: "SHTHICK", dimension: "length" },
    StoredRow { name: "SHTHICK0", dimension: "length" },
    StoredRow { name: "SHINERT", dimension: "length^2" },
    StoredRow { name: "SHSTEP", dimension: "time" },
    StoredRow { name: "SHCHANGE", dimension: "-" },
    StoredRow { name: "SHHGM1", dimension: "force" },
    StoredRow { name: "SHHGM2", dimension: "force" },
    StoredRow { name: "SHHGB1", dimension: "force*length" },
    StoredRow { name: "SHHGB2", dimension: "force*length" },
    StoredRow { name: "SHHGS1", dimension: "force" },
    StoredRow { name: "SHHGS2", dimension: "force" },
    StoredRow { name: "SHDRILL1", dimension: "force*length" },
    StoredRow { name: "SHDRILL2", dimension: "force*length" },
    StoredRow { name: "SHDRILL3", dimension: "force*length" },
    StoredRow { name: "SHDRILL4", dimension: "force*length" },
    StoredRow { name: "SHNXX", dimension: "force/length" },
    StoredRow { name: "SHNYY", dimension: "force/length" },
    StoredRow { name: "SHNXY", dimension: "force/length" },
    StoredRow { name: "SHMXX", dimension: "force" },
    StoredRow { name: "SHMYY", dimension: "force" },
    StoredRow { name: "SHMXY", dimension: "force" },
    StoredRow { name: "SHQX", dimension: "force/length" },
    StoredRow { name: "SHQY", dimension: "force/length" },
    StoredRow { name: "EINTERN", dimension: "energy" },
    StoredRow { name: "EHOURGL", dimension: "energy" },
    StoredRow { name: "EVISCOUS", dimension: "energy" },
    StoredRow { name: "BULKQ", dimension: "force/length^2" },
    StoredRow { name: "SHDMPM1", dimension: "force" },
    StoredRow { name: "SHDMPM2", dimension: "force" },
    StoredRow { name: "SHDMPB1", dimension: "force*length" },
    StoredRow { name: "SHDMPB2", dimension: "force*length" },
    StoredRow { name: "SHDMPS1", dimension: "force" },
    StoredRow { name: "SHDMPS2", dimension: "force" },
    StoredRow { name: "SHDMPD1", dimension: "force*length" },
    StoredRow { name: "SHDMPD2", dimension: "force*length" },
    StoredRow { name: "SHDMPD3", dimension: "force*length" },
    StoredRow { name: "SHDMPD4", dimension: "force*length" },
];

const POINT_ROWS: [StoredRow; point_rows::LAW] = [
    StoredRow { name: "SHSIGXX", dimension: "force/length^2" },
    StoredRow { name: "SHSIGYY", dimension: "force/length^2" },
    StoredRow { name: "SHSIGXY", dimension: "force/length^2" },
    StoredRow { name: "SHSIGYZ", dimension: "force/length^2" },
    StoredRow { name: "SHSIGZX", dimension: "force/length^2" },
    StoredRow { name: "SHSIGZZ", dimension: "force/length^2" },
    StoredRow { name: "SHLOST", dimension: "-" },
];

pub(in crate::solver::elements) static ENTRY: Entry = Entry {
    name: "SHELL",
    summary: "Four nodes of a surface, with rotations; points through the thickness, any law of solids in plane stress.",
    shape: Shape::Quadrilateral,
    rotations: true,
    rows: &ROWS,
    points: Some(POINTS),
    energies: energies(QUADRILATERAL),
    viscous_stress: Some(QUADRILATERAL.viscous_stress),
};

/// What is to be known of the points through the thickness.
const POINTS: PointEntry = PointEntry { rows: &POINT_ROWS, lost: point_rows::LOST, layered: true };

const fn energies(rows: Rows) -> Energies {
    Energies {
        internal: rows.internal_energy,
        hourglass: Some(rows.hourglass_energy),
        viscous: Some(rows.viscous_energy),
    }
}

/// Shear correction of a homogeneous section (Reissner 1945).
const SHEAR_CORRECTION: f64 = 5.0 / 6.0;

/// Points through the thickness without INTEGRATION POINTS.
const USUAL_POINTS: usize = 5;

/// The shell of four nodes.
pub type Shell = Layered<Quadrilateral, 4, RESISTANCES, 8, 18>;

/// What holds for all shells of a block, of a kind with C corners and R resistances; N is the number of corners and their
/// rotations, W that of all rates.
#[derive(Debug, Clone)]
pub struct Layered<S, const C: usize, const R: usize, const N: usize, const W: usize> {
    kind: PhantomData<S>,
    /// Thickness that the deck gives; without it each element has its own.
    thickness: Option<f64>,
    /// Factor on the thickness.
    scale: f64,
    /// Places and weights of the points.
    points: Vec<[f64; 2]>,
}

impl<S: Kind<C, R>, const C: usize, const R: usize, const N: usize, const W: usize> Layered<S, C, R, N, W> {
    fn thickness_of(&self, attributes: &[f64]) -> f64 {
        self.scale * self.thickness.or(attributes.first().copied()).unwrap_or(0.0)
    }

    /// Factor of the points on the bending stiffness: 3/2 Σ w ζ².
    fn bending(&self) -> f64 {
        self.points.iter().map(|[place, weight]| 1.5 * weight * place * place).sum()
    }

    /// Stress at a point as the law has it. Its transverse shear is that of a uniform angle, and larger than what is carried.
    fn law_stress(&self, group: &Group, i: usize, point: usize) -> Sym3<f64> {
        let stride = (group.stride - S::ROWS.points) / self.points.len();
        let first = S::ROWS.points + point * stride;
        let [xx, yy, xy, yz, zx] = group.values(i, first + point_rows::XX);
        Sym3 { xx, yy, zz: 0.0, xy, yz, zx }
    }

    /// The part of the law's transverse shear that the section carries, so that its mean is the shear force over the thickness: the
    /// correction of the section, and in triangles what is taken off where they are slender. Both are in the force.
    fn shear_share(&self, group: &Group, i: usize) -> f64 {
        let [.., qx, qy] = group.values::<8>(i, S::ROWS.resultants);
        let [yz, zx] = (0..self.points.len()).fold([0.0; 2], |[yz, zx], point| {
            let (share, stress) = (0.5 * self.points[point][1], self.law_stress(group, i, point));
            [yz + share * stress.yz, zx + share * stress.zx]
        });
        let carried = (qx * zx + qy * yz) / (group.value(i, rows::THICKNESS) * (zx * zx + yz * yz));
        // Nothing is sheared, or by so little that its square is no number.
        if carried.is_finite() { carried } else { SHEAR_CORRECTION }
    }

    fn stiffness(&self, law: &Law) -> Stiffness {
        let membrane = self.points.len() == 1;
        Stiffness {
            moduli: law.moduli(),
            bending: self.bending(),
            shear_correction: if membrane { 0.0 } else { SHEAR_CORRECTION },
        }
    }
}

/// Whether a law can be held in plane stress: it must have a stiffness of its own in tension, and see no volume.
struct SeesVolume;
impl KernelVisitor for SeesVolume {
    type Output = bool;
    fn visit<K: Kernel>(self, _: K) -> bool {
        K::VOLUME
    }
}

/// Why a block of shells or the like cannot have its law.
pub(super) fn unfit_law(block: &Block, model: &Model) -> Option<Unfit> {
    let law = model.materials.iter().find(|material| material.block == block.id).map(|material| &material.law)?;
    law.accept(SeesVolume).then(|| Unfit {
        reason: format!("{} cannot be held in plane stress", law.entry().name),
        help: "shells and bars need a law that goes by strain increments alone, such as ELASTIC, ELASTIC PLASTIC or JOHNSON COOK"
            .into(),
    })
}

/// How many points through the thickness a block has, and the word of INTEGRATION POINTS for their rule.
pub fn points_of(block: i64, model: &Model) -> (usize, &str) {
    match model.section("INTEGRATION POINTS", block) {
        Some(section) => (section.number("points") as usize, section.word("rule").unwrap_or("GAUSS")),
        None => (USUAL_POINTS, "GAUSS"),
    }
}

/// The points that the deck chooses for a block.
fn points(block: &Block, model: &Model) -> Result<Vec<[f64; 2]>, Unfit> {
    let (count, word) = points_of(block.id, model);
    let rule = match word {
        "LOBATTO" => Rule::Lobatto,
        "TRAPEZOID" => Rule::Trapezoid,
        _ => Rule::Gauss,
    };
    if count != 1 && !(rule.fewest()..=MOST_POINTS).contains(&count) {
        return Err(Unfit {
            reason: format!("INTEGRATION POINTS: {rule:?} has no rule with {count} points"),
            help: format!("it has 1, which is a membrane, and {} to {MOST_POINTS}", rule.fewest()),
        });
    }
    Ok(rule.points(count))
}

impl<S: Kind<C, R>, const C: usize, const R: usize, const N: usize, const W: usize> Formulation
    for Layered<S, C, R, N, W>
{
    fn of_block(block: &Block, model: &Model) -> Result<Self, Unfit> {
        if let Some(unfit) = unfit_law(block, model) {
            return Err(unfit);
        }
        let thickness = model.section("SHELL THICKNESS", block.id).map(|section| section.number("thickness"));
        let own = (0..block.len()).map(|element| block.attributes_of(element).first().copied().unwrap_or(0.0));
        if thickness.is_none() && !own.into_iter().all(|thickness| thickness > 0.0 && thickness.is_finite()) {
            return Err(Unfit {
                reason: "its shells have no thickness".into(),
                help: "give it with SHELL THICKNESS, or as the first attribute in the mesh".into(),
            });
        }
        let scale = model.section("THICKNESS SCALE", block.id).map_or(1.0, |section| section.number("factor"));
        Ok(Layered { kind: PhantomData, thickness, scale, points: points(block, model)? })
    }

    fn weigh(&self, element: &Sample, density: f64, shares: &mut [f64]) -> f64 {
        let Ok(corners) = element.corners.try_into() else { return 0.0 };
        let thickness = self.thickness_of(element.attributes);
        let area = S::Facet::<f64>::new(corners, thickness).area();
        let (of_mass, of_inertia) = shares.split_at_mut(C);
        of_mass.fill(1.0 / C as f64);
        of_inertia.fill(inertia::<S, C, R>(thickness, area) / C as f64);
        density * thickness * area
    }

    fn start(&self, element: &NewElement, density: f64, own: &mut [f64]) -> Start {
        let corners: Corners<f64, C> = element.corners[..].try_into().unwrap_or([[0.0; 3]; C]);
        let geometry = S::Facet::<f64>::new(&corners, 0.0);
        let thickness = element.mass / (density * geometry.area());
        unstressed::<S, C, R>(&geometry, thickness, own);
        let (turn, _) = geometry.turn(&geometry.reference());
        Start { centre: centroid(&corners), length: geometry.area().sqrt(), frame: geometry.material_axes(turn) }
    }

    fn run(&self, pass: Pass, law: &Law, _: f64, settings: &PassSettings) -> PassOutcome {
        law.accept(OfLaw { pass, shell: self, stiffness: self.stiffness(law), settings: *settings })
    }

    fn stand_in(&self, density: f64, edge: f64, own: &mut [f64]) -> f64 {
        let corners = S::PLAIN.map(|[x, y]| [x * edge, y * edge, 0.0]);
        let geometry = S::Facet::<f64>::new(&corners, edge);
        unstressed::<S, C, R>(&geometry, edge, own);
        density * geometry.area() * edge
    }

    fn volume(&self, group: &Group, i: usize, nodes: &Nodes) -> f64 {
        let thickness = group.value(i, rows::THICKNESS);
        S::Facet::<f64>::new(&group.positions(i, nodes), thickness).area() * thickness
    }

    fn frame(&self, group: &Group, i: usize, nodes: &Nodes) -> Matrix3<f64> {
        material_axes::<S, C, R>(&group.positions(i, nodes), group, i)
    }

    fn initial_frame(&self, group: &Group, i: usize, nodes: &Nodes) -> Matrix3<f64> {
        material_axes::<S, C, R>(&group.initial_positions(i, nodes), group, i)
    }

    fn stress(&self, group: &Group, i: usize) -> Sym3<f64> {
        let nothing = Sym3 { xx: 0.0, yy: 0.0, zz: 0.0, xy: 0.0, yz: 0.0, zx: 0.0 };
        let [.., qx, qy] = self.resultants(group, i);
        let thickness = self.thickness(group, i);
        let mean = (0..self.points.len()).fold(nothing, |sum, point| {
            let share = self.point_share(point);
            sum.zip(self.law_stress(group, i, point), |sum, stress| sum + share * stress)
        });
        Sym3 { yz: qy / thickness, zx: qx / thickness, ..mean }
    }

    /// One point in the middle makes a membrane of it.
    fn bends(&self) -> bool {
        self.points.len() > 1
    }

    fn points(&self) -> usize {
        self.points.len()
    }

    fn point_share(&self, point: usize) -> f64 {
        0.5 * self.points[point][1]
    }

    fn point_stress(&self, group: &Group, i: usize, point: usize) -> Sym3<f64> {
        let stress = self.law_stress(group, i, point);
        let share = self.shear_share(group, i);
        Sym3 { yz: share * stress.yz, zx: share * stress.zx, ..stress }
    }

    fn thickness(&self, group: &Group, i: usize) -> f64 {
        group.value(i, rows::THICKNESS)
    }

    fn resultants(&self, group: &Group, i: usize) -> [f64; 8] {
        group.values(i, S::ROWS.resultants)
    }

    fn touch(&self, attributes: &[f64]) -> Touch {
        Touch::BothSides(0.5 * self.thickness_of(attributes))
    }

    fn stretch(&self, group: &Group, i: usize, nodes: &Nodes) -> Sym3<f64> {
        let geometry = S::Facet::<f64>::new(&group.positions(i, nodes), 0.0);
        let (_, [xx, yy, xy]) = geometry.turn(&group.values(i, rows::REFERENCE));
        let zz = group.value(i, rows::THICKNESS) / group.value(i, rows::START);
        Sym3 { xx, yy, zz, xy, yz: 0.0, zx: 0.0 }
    }

    /// Of membrane forces, moments, shear forces and bulk viscosity; hourglass and drill resistance are left out.
    fn last_half_step(&self, group: &Group, i: usize, nodes: &Nodes, time_step: f64) -> f64 {
        let v: Corners<f64, C> = group.velocities(i, nodes);
        let now: Corners<f64, C> = group.positions(i, nodes);
        let omega: Corners<f64, C> = std::array::from_fn(|corner| nodes.velocity(group.node(i, C + corner)));
        let before = std::array::from_fn(|c| [0, 1, 2].map(|k: usize| now[c][k] - time_step * v[c][k]));
        let geometry = S::Facet::<f64>::new(&before, group.value(i, rows::THICKNESS));
        let (turn, _) = geometry.turn(&group.values(i, rows::REFERENCE));
        let work = kernel::power(&geometry.rates(&v, &omega), turn, &self.resultants(group, i));
        let [xx, yy, _] = geometry.rates(&v, &omega).strain;
        let viscous = group.value(i, S::ROWS.viscous_stress) * group.value(i, rows::THICKNESS) * (xx + yy);
        let work = 0.5 * time_step * geometry.area() * (work + viscous);
        if work.is_finite() { work } else { 0.0 }
    }
}

/// Axes of the material of an element whose corners are here, which the mesh has had elsewhere.
fn material_axes<S: Kind<C, R>, const C: usize, const R: usize>(
    corners: &Corners<f64, C>,
    group: &Group,
    i: usize,
) -> Matrix3<f64> {
    let geometry = S::Facet::<f64>::new(corners, 0.0);
    let (turn, _) = geometry.turn(&group.values(i, rows::REFERENCE));
    geometry.material_axes(turn)
}

/// Rotary inertia of a corner over its mass: that of the section, or more, so that rotations seldom set the time step.
fn inertia<S: Kind<C, R>, const C: usize, const R: usize>(thickness: f64, area: f64) -> f64 {
    (thickness * thickness / 12.0).max(area * S::INERTIA)
}

/// Rows of an element that has not been strained; its stable step is still to be found.
fn unstressed<S: Kind<C, R>, const C: usize, const R: usize>(
    geometry: &S::Facet<f64>,
    thickness: f64,
    own: &mut [f64],
) {
    own[rows::REFERENCE..rows::REFERENCE + 3].copy_from_slice(&geometry.reference());
    own[rows::THICKNESS] = thickness;
    own[rows::START] = thickness;
    own[rows::INERTIA] = inertia::<S, C, R>(thickness, geometry.area());
    own[rows::CHANGED] = 1.0;
}

/// A pass that still has to learn its law.
struct OfLaw<'a, S, const C: usize, const R: usize, const N: usize, const W: usize> {
    pass: Pass<'a>,
    shell: &'a Layered<S, C, R, N, W>,
    stiffness: Stiffness,
    settings: PassSettings,
}

impl<S: Kind<C, R>, const C: usize, const R: usize, const N: usize, const W: usize> KernelVisitor
    for OfLaw<'_, S, C, R, N, W>
{
    type Output = PassOutcome;

    fn visit<K: Kernel>(self, law: K) -> PassOutcome {
        let mut rule = [[0.0; 2]; MOST_POINTS];
        rule.iter_mut().zip(&self.shell.points).for_each(|(place, point)| *place = *point);
        self.pass.over(&ShellStep::<K, S, C, R, N, W> {
            kind: PhantomData,
            law,
            moduli: self.stiffness.moduli,
            times: [self.settings.time, self.settings.time_step],
            viscosity: self.settings.bulk_viscosity,
            points: self.shell.points.len(),
            rule,
            stiffness: self.stiffness,
        })
    }
}

#[cfg(test)]
mod tests;
