//! The beam: two nodes with rotations, one point along it, fibres over its section by any law in uniaxial stress.
//!
//! Its axes turn with the line between the nodes and with their mean rotation about it. Rates at mid-step:
//!
//! ε = e₁·v₂₁/L, κ = (ω₂ − ω₁)/L in e₁, e₂, e₃, γ_y = e₂·v₂₁/L − e₃·ω̄, γ_z = e₃·v₂₁/L + e₂·ω̄.
//!
//! A fibre is strained by ε + z κ_y − y κ_z. Shear has the residual flexibility of bending, so that one element is exact under
//! forces at its ends. Forces are the transpose of the rates, at the end of the step. The section follows the mean strain across its
//! fibres and keeps its form, so that areas grow with exp(2ε_t), distances with exp(ε_t).

mod kernel;
mod orientation;
mod section;

use super::shell::unfit_law;
use crate::common::vector::{dot, normalized, scaled, subtract};
use crate::lanes::{Matrix3, Sym3};
use crate::material::{Kernel, KernelVisitor, Law, Moduli, Start};
use crate::mesh::{Block, Mesh, Shape};
use crate::model::{self, Model};
use crate::solver::body::centroid;
use crate::solver::elements::{
    Element, Energies, Entry, Formulation, Group, NewElement, Pass, PassOutcome, PassSettings, PointEntry, Sample,
    StoredRow, Touch, Unfit,
};
use crate::solver::nodes::Nodes;
use kernel::{BeamStep, axes, young_and_shear};
use section::{MOST_FIBRES, Section};

/// Rows of a beam's state; those of its fibres follow.
mod rows {
    /// y axis of the section, in space.
    pub const AXIS: usize = 0;
    /// Length at the start.
    pub const START: usize = 3;
    /// Rotary inertia of a node over its mass.
    pub const INERTIA: usize = 4;
    /// N, T, M_y, M_z, Q_y, Q_z.
    pub const RESULTANTS: usize = 5;
    /// Internal energy since the start.
    pub const INTERNAL_ENERGY: usize = 11;
    /// Logarithmic strain across, the mean of the fibres.
    pub const LATERAL: usize = 12;
    /// First row of the fibres.
    pub const POINTS: usize = 13;
}

/// Rows of a fibre; those of its law follow.
mod point_rows {
    /// Stress along the fibre.
    pub const STRESS: usize = 0;
    /// What is left of the stress across it.
    pub const ACROSS: usize = 1;
    /// 1 where the fibre carries nothing any more.
    pub const LOST: usize = 2;
    /// First row of the law.
    pub const LAW: usize = 3;
}

const ROWS: [StoredRow; rows::POINTS] = [
    StoredRow { name: "BEAMYX", dimension: "-" },
    StoredRow { name: "BEAMYY", dimension: "-" },
    StoredRow { name: "BEAMYZ", dimension: "-" },
    StoredRow { name: "BEAMLENG", dimension: "length" },
    StoredRow { name: "BEAMINER", dimension: "length^2" },
    StoredRow { name: "BEAMN", dimension: "force" },
    StoredRow { name: "BEAMT", dimension: "force*length" },
    StoredRow { name: "BEAMMY", dimension: "force*length" },
    StoredRow { name: "BEAMMZ", dimension: "force*length" },
    StoredRow { name: "BEAMQY", dimension: "force" },
    StoredRow { name: "BEAMQZ", dimension: "force" },
    StoredRow { name: "EINTERN", dimension: "energy" },
    StoredRow { name: "BEAMLATR", dimension: "-" },
];

const POINT_ROWS: [StoredRow; point_rows::LAW] = [
    StoredRow { name: "BEAMSIG", dimension: "force/length^2" },
    StoredRow { name: "BEAMACRS", dimension: "force/length^2" },
    StoredRow { name: "BEAMLOST", dimension: "-" },
];

pub(in crate::solver::elements) static ENTRY: Entry = Entry {
    name: "BEAM",
    summary: "Two nodes with rotations; fibres over its section, any law of solids in uniaxial stress.",
    shape: Shape::Bar,
    rotations: true,
    rows: &ROWS,
    points: Some(PointEntry { rows: &POINT_ROWS, lost: point_rows::LOST, layered: false }),
    energies: Energies { internal: rows::INTERNAL_ENERGY, hourglass: None, viscous: None },
    viscous_stress: None,
};

/// What holds for all beams of a block.
#[derive(Debug, Clone)]
pub struct Beam {
    section: Section,
    /// Vector in the plane of the beam and its y axis.
    direction: Option<[f64; 3]>,
    moduli: Moduli,
}

/// Number of dimensions that a form of cross section has.
fn dimensions(form: &str) -> usize {
    match form {
        "RECTANGLE" | "TUBE" => 2,
        "I" => 4,
        _ => 1,
    }
}

/// What a block says of its beams: the dimensions of the command and the vector of their y axis, or where it gives none those of the
/// mesh, which are the first attributes.
fn given_by(command: &model::Section, block: &Block) -> Result<([f64; 4], [f64; 3]), Unfit> {
    let numbers = ["a", "b", "c", "d"].map(|field| command.number(field));
    let vector = ["yx", "yy", "yz"].map(|field| command.number(field));
    if !numbers[0].is_nan() {
        return Ok((numbers, vector));
    }
    let form = command.word("form").unwrap_or_default();
    let needed = dimensions(form);
    let unfit = |reason: String, help: &str| Unfit { reason: format!("BEAM SECTION: {reason}"), help: help.into() };
    let first = block.attributes_of(0);
    if first.len() < needed {
        let reason =
            format!("{form} has {needed} dimensions, and neither the deck nor the attributes of the mesh give them");
        return Err(unfit(reason, "give them with BEAM SECTION"));
    }
    if (1..block.len()).any(|element| block.attributes_of(element) != first) {
        let help = "give the elements of each section a block of their own, or the dimensions in BEAM SECTION";
        return Err(unfit("the attributes of the block's beams are not all the same".into(), help));
    }
    if let Some(bad) = first[..needed].iter().find(|dimension| !(**dimension > 0.0 && dimension.is_finite())) {
        return Err(unfit(format!("the mesh gives {bad} as a dimension"), "give them with BEAM SECTION"));
    }
    let dimensions = [0, 1, 2, 3].map(|i| if i < needed { first[i] } else { f64::NAN });
    let of_mesh = first.get(needed..needed + 3).and_then(|rest| rest.try_into().ok());
    let given = vector.iter().any(|component| !component.is_nan());
    Ok((dimensions, if given { vector } else { of_mesh.unwrap_or(vector) }))
}

/// The section of a block's beams and the vector of their y axis in words; `None` for what are no beams.
pub fn in_words(block: &Block, model: &Model) -> Option<[String; 2]> {
    let command = model.section("BEAM SECTION", block.id)?;
    let form = command.word("form").unwrap_or_default();
    let (numbers, vector) = given_by(command, block).ok()?;
    let joined = |numbers: &[f64]| numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
    let vector = if vector.iter().all(|component| component.is_nan()) { "none".into() } else { joined(&vector) };
    Some([format!("{form} of {}", joined(&numbers[..dimensions(form)])), vector])
}

/// Why a block of beams cannot be computed of which some lie along the vector that is to be in the plane of their y axis.
pub fn unfit_direction(mesh: &Mesh, block: &Block, numbers: &[i64], model: &Model) -> Option<Unfit> {
    let Ok(Element::Beam(beam)) = Element::of_block(block, model) else { return None };
    let direction = beam.direction?;
    let ends = |nodes: &[u32]| [nodes[0], nodes[1]].map(|node| mesh.coordinates[node as usize]);
    let lies_along = |(nodes, _): &(&[u32], &i64)| orientation::sine(ends(nodes), direction) < orientation::PARALLEL;
    let mut along = block.elements().zip(numbers).filter(lies_along);
    let (nodes, number) = along.next()?;
    let more = match along.count() {
        0 => String::new(),
        more => format!(", and {more} more"),
    };
    let [a, b] = ends(nodes);
    let [x, y, z] = orientation::axis_across(subtract(b, a));
    Some(Unfit {
        reason: format!(
            "BEAM SECTION: the vector lies along beam {number}{more}, and does not say where the y axis of the section is"
        ),
        help: format!(
            "give one across the beam, such as {x:?}, {y:?}, {z:?}, which without a vector is taken for it; beams that no vector suits \
             need blocks of their own"
        ),
    })
}

/// The cross section of a form with these dimensions, of which there may be fewer.
fn section(form: &str, [a, b, c, d]: [f64; 4]) -> Result<Section, Unfit> {
    let unfit = |reason: String| Err(Unfit { reason: format!("BEAM SECTION: {reason}"), help: String::new() });
    let needed = dimensions(form);
    let given = [a, b, c, d][..needed].iter().filter(|dimension| !dimension.is_nan()).count();
    if given < needed {
        return unfit(format!("{form} needs {needed} dimensions, and {given} are given"));
    }
    match form {
        "RECTANGLE" => Ok(Section::rectangle(a, b)),
        "TUBE" if b > a => unfit(format!("the wall is {b}, thicker than the radius {a}")),
        "TUBE" => Ok(Section::tube(a, b)),
        "I" if 2.0 * c >= a || d > b => unfit("flanges and web do not fit into height and width".to_string()),
        "I" => Ok(Section::i_beam(a, b, c, d)),
        _ => Ok(Section::rod(a)),
    }
}

impl Beam {
    /// The y axis of a beam that lies along a vector, at the start.
    fn y_axis(&self, along: [f64; 3]) -> [f64; 3] {
        orientation::y_axis(along, self.direction)
    }

    /// Rotary inertia of a node over its mass, by which no rotation is faster than the beam stretches: that about its line, or more
    /// where the beam is long.
    fn inertia(&self, length: f64) -> f64 {
        let Section { area, moments: [iy, iz], torsion, shear_corrections: [along_y, along_z], .. } = self.section;
        let [young, mu] = young_and_shear(self.moduli);
        let stiffness = |correction: f64, moment: f64| {
            1.0 / (1.0 / (correction * mu * area) + length * length / (12.0 * young * moment))
        };
        let shear = stiffness(along_y, iz).max(stiffness(along_z, iy));
        let own = 0.25 * length * length * shear / (young * area - shear);
        own.max((iy + iz) / area).max(mu / young * torsion / area)
    }
}

impl Formulation for Beam {
    fn takes(block: &Block, model: &Model) -> bool {
        model.section("BEAM SECTION", block.id).is_some()
    }

    fn of_block(block: &Block, model: &Model) -> Result<Self, Unfit> {
        if let Some(unfit) = unfit_law(block, model) {
            return Err(unfit);
        }
        let missing = || Unfit { reason: "its beams have no section".into(), help: "give it with BEAM SECTION".into() };
        let given = model.section("BEAM SECTION", block.id).ok_or_else(missing)?;
        let (dimensions, direction) = given_by(given, block)?;
        let direction = direction.map(|component| if component.is_nan() { 0.0 } else { component });
        let law = model.materials.iter().find(|material| material.block == block.id).map(|material| &material.law);
        let moduli = law.map_or(Moduli { lambda: 0.0, two_mu: 1.0 }, Law::moduli);
        Ok(Beam {
            section: section(given.word("form").unwrap_or_default(), dimensions)?,
            direction: normalized(direction),
            moduli,
        })
    }

    fn weigh(&self, element: &Sample, density: f64, shares: &mut [f64]) -> f64 {
        let length = length(element.corners);
        let inertia = self.inertia(length);
        let (of_mass, of_inertia) = shares.split_at_mut(2);
        of_mass.fill(0.5);
        of_inertia.fill(0.5 * inertia);
        density * self.section.area * length
    }

    fn start(&self, element: &NewElement, _: f64, own: &mut [f64]) -> Start {
        let along = subtract(element.corners[1], element.corners[0]);
        self.rest(along, own);
        let y = self.y_axis(along);
        Start {
            centre: centroid(&element.corners),
            length: dot(along, along).sqrt(),
            frame: columns(axes(&along, &y).e),
        }
    }

    fn run(&self, pass: Pass, law: &Law, _: f64, settings: &PassSettings) -> PassOutcome {
        law.accept(OfLaw { pass, beam: self, times: [settings.time, settings.time_step] })
    }

    fn stand_in(&self, density: f64, edge: f64, own: &mut [f64]) -> f64 {
        self.rest([edge, 0.0, 0.0], own);
        density * self.section.area * edge
    }

    fn bends(&self) -> bool {
        true
    }

    fn points(&self) -> usize {
        self.section.fibres.len()
    }

    fn point_share(&self, point: usize) -> f64 {
        self.section.fibres[point][2] / self.section.area
    }

    fn point_stress(&self, group: &Group, i: usize, point: usize) -> Sym3<f64> {
        let stride = (group.stride - rows::POINTS) / self.points();
        uniaxial_stress(group.value(i, rows::POINTS + point * stride + point_rows::STRESS))
    }

    fn volume(&self, group: &Group, i: usize, nodes: &Nodes) -> f64 {
        let along = chord(group, i, nodes);
        self.area(group, i) * dot(along, along).sqrt()
    }

    fn frame(&self, group: &Group, i: usize, nodes: &Nodes) -> Matrix3<f64> {
        columns(axes(&chord(group, i, nodes), &group.values(i, rows::AXIS)).e)
    }

    fn initial_frame(&self, group: &Group, i: usize, nodes: &Nodes) -> Matrix3<f64> {
        let [a, b]: [[f64; 3]; 2] = group.initial_positions(i, nodes);
        let along = subtract(b, a);
        columns(axes(&along, &self.y_axis(along)).e)
    }

    fn stress(&self, group: &Group, i: usize) -> Sym3<f64> {
        uniaxial_stress(group.value(i, rows::RESULTANTS) / self.area(group, i))
    }

    /// That of the fibre with the largest.
    fn governing_stress(&self, group: &Group, i: usize) -> Sym3<f64> {
        let stresses = (0..self.points()).map(|point| self.point_stress(group, i, point).xx);
        uniaxial_stress(stresses.fold(0.0, |most: f64, stress| if stress.abs() > most.abs() { stress } else { most }))
    }

    fn touch(&self, _: &[f64]) -> Touch {
        Touch::Nodes(self.section.radius)
    }

    fn inertia_about_line(&self, corners: &[[f64; 3]]) -> f64 {
        let Section { area, moments: [iy, iz], .. } = self.section;
        self.inertia(length(corners)) / ((iy + iz) / area)
    }

    fn stretch(&self, group: &Group, i: usize, nodes: &Nodes) -> Sym3<f64> {
        let along = chord(group, i, nodes);
        let long = dot(along, along).sqrt() / group.value(i, rows::START);
        let wide = libm::exp(group.value(i, rows::LATERAL));
        Sym3 { xx: long, yy: wide, zz: wide, xy: 0.0, yz: 0.0, zx: 0.0 }
    }

    fn resultants(&self, group: &Group, i: usize) -> [f64; 8] {
        let [n, t, my, mz, qy, qz] = group.values(i, rows::RESULTANTS);
        [n, 0.0, 0.0, my, mz, t, qy, qz]
    }

    fn last_half_step(&self, group: &Group, i: usize, nodes: &Nodes, time_step: f64) -> f64 {
        let [a, b]: [[f64; 3]; 2] = group.velocities(i, nodes);
        let v = subtract(b, a);
        let before = subtract(chord(group, i, nodes), scaled(v, time_step));
        let omega = [2, 3].map(|corner| nodes.velocity(group.node(i, corner)));
        let lying = axes(&before, &group.values(i, rows::AXIS));
        let rates = lying.rates(&v, &omega);
        let [n, t, my, mz, qy, qz] = group.values(i, rows::RESULTANTS);
        let along: f64 = [n, t, my, mz].iter().zip(rates.along).map(|(force, rate)| force * rate).sum();
        let work = 0.5 * time_step * lying.length * (along + qy * rates.shear[0] + qz * rates.shear[1]);
        if work.is_finite() { work } else { 0.0 }
    }
}

impl Beam {
    /// Area of the section now.
    fn area(&self, group: &Group, i: usize) -> f64 {
        self.section.area * libm::exp(2.0 * group.value(i, rows::LATERAL))
    }

    /// Rows of a beam along a vector that has not been strained.
    fn rest(&self, along: [f64; 3], own: &mut [f64]) {
        let length = dot(along, along).sqrt();
        own[rows::AXIS..rows::AXIS + 3].copy_from_slice(&self.y_axis(along));
        own[rows::START] = length;
        own[rows::INERTIA] = self.inertia(length);
    }
}

fn length(corners: &[[f64; 3]]) -> f64 {
    let along = subtract(corners[1], corners[0]);
    dot(along, along).sqrt()
}

fn uniaxial_stress(xx: f64) -> Sym3<f64> {
    Sym3 { xx, yy: 0.0, zz: 0.0, xy: 0.0, yz: 0.0, zx: 0.0 }
}

fn chord(group: &Group, i: usize, nodes: &Nodes) -> [f64; 3] {
    let [a, b]: [[f64; 3]; 2] = group.positions(i, nodes);
    subtract(b, a)
}

fn columns([e1, e2, e3]: [[f64; 3]; 3]) -> Matrix3<f64> {
    [0, 1, 2].map(|i| [e1[i], e2[i], e3[i]])
}

/// A pass that still has to learn its law.
struct OfLaw<'a> {
    pass: Pass<'a>,
    beam: &'a Beam,
    times: [f64; 2],
}

impl KernelVisitor for OfLaw<'_> {
    type Output = PassOutcome;

    fn visit<K: Kernel>(self, law: K) -> PassOutcome {
        let Section { area, moments: [iy, iz], torsion, shear_corrections, fibres: own, .. } = &self.beam.section;
        let mut fibres = [[0.0; 3]; MOST_FIBRES];
        fibres.iter_mut().zip(own).for_each(|(place, fibre)| *place = *fibre);
        self.pass.over(&BeamStep {
            law,
            moduli: self.beam.moduli,
            times: self.times,
            section: [*area, *iy, *iz, *torsion],
            shear_corrections: *shear_corrections,
            count: own.len(),
            fibres,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A long beam bends by 12 EI/L³, and no rotation is faster than its stretching with 3 I/A: over (Iy + Iz)/A that is 3/2 of what is
    /// round or square, 3 Iy/(Iy + Iz) of a rectangle. A beam that is half as long as high has the inertia of its section.
    #[test]
    fn long_beams_turn_with_more_than_their_section() {
        let beam = |section: Section| Beam {
            section,
            direction: None,
            moduli: Moduli { lambda: 0.6e11, two_mu: 0.8e11 * 2.0 },
        };
        for (section, part) in [
            (Section::rod(0.5), 1.5),
            (Section::tube(0.5, 0.05), 1.5),
            (Section::rectangle(1.0, 1.0), 1.5),
            (Section::rectangle(0.5, 1.0), 2.4),
            (Section::rectangle(0.1, 1.0), 3.0 / 1.01),
        ] {
            let of_length = |length: f64| beam(section.clone()).inertia_about_line(&[[0.0; 3], [length, 0.0, 0.0]]);
            assert!((of_length(1e3) / part - 1.0).abs() < 1e-4, "{section:?}: {} instead of {part}", of_length(1e3));
            assert!((of_length(0.5) - 1.0).abs() < 1e-12, "{section:?}: {}", of_length(0.5));
        }
    }
}
