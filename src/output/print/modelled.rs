//! What a model makes the code do, and which command asked for it.

use crate::mesh::Shape;
use crate::mesh::check::counted;
use crate::mesh::hexahedron::{Form, form};
use crate::mesh::{Block, Mesh};
use crate::model::{Hourglass, Model, MotionKind, Precision, PrescribedMotion, Spin, StepEstimate, Unknown};
use crate::solver::elements::Element;

/// A part of the code that has work to do.
pub struct Feature {
    /// What is modelled.
    pub what: String,
    /// The command, and how often it stands in the deck or what it acts on.
    pub asked_by: String,
}

/// Everything that is modelled. What is not in this list costs nothing.
pub fn features(model: &Model, mesh: &Mesh) -> Vec<Feature> {
    let mut list = solids(model, mesh);
    let (held, forces) = (&model.no_displacements, &model.prescribed_forces);
    let motions = |kind| {
        let of_kind = |motion: &&PrescribedMotion| motion.of == Unknown::Position && motion.kind == kind;
        model.prescribed_motions.iter().filter(of_kind).count()
    };
    let turned = model.prescribed_motions.iter().filter(|motion| motion.of == Unknown::Rotation).count();
    let counts = [
        ("nodes held still", "NO DISPLACEMENT", held.iter().filter(|held| held.of == Unknown::Position).count()),
        ("rotations of nodes held", "NO ROTATION", held.iter().filter(|held| held.of == Unknown::Rotation).count()),
        ("prescribed rotations", "PRESCRIBED ROTATION", turned),
        ("prescribed displacements", "PRESCRIBED DISPLACEMENT", motions(MotionKind::Displacement)),
        ("prescribed velocities", "PRESCRIBED VELOCITY", motions(MotionKind::Velocity)),
        ("prescribed accelerations", "PRESCRIBED ACCELERATION", motions(MotionKind::Acceleration)),
        ("forces on nodes", "PRESCRIBED FORCE", forces.iter().filter(|force| force.of == Unknown::Position).count()),
        ("moments on nodes", "PRESCRIBED MOMENT", forces.iter().filter(|force| force.of == Unknown::Rotation).count()),
        ("rigid bodies", "RIGID BODY", model.rigid_bodies.len()),
        ("masses added for longer time steps", "MASS SCALING", model.mass_scalings.len()),
        ("masses at nodes", "POINT MASS", model.point_masses.len()),
        ("pressure on deformed faces", "PRESSURE", model.pressures.len()),
        ("body force", "GRAVITY", model.gravities.len()),
        ("waves leave through side sets", "SILENT BC", model.silent_boundaries.len()),
        ("initial velocities", "INITIAL VELOCITY", model.initial_velocities.len()),
        ("contact with rigid planes", "RIGID SURFACE", model.rigid_surfaces.len()),
        ("surfaces tied to others", "TIED CONTACT", model.ties.len()),
        ("contact of all outer faces", "CONTACT MATERIAL", usize::from(model.contact.materials.is_some())),
        ("contact of pairs of side sets", "CONTACT SURFACE", model.contact.surfaces.len()),
        ("elements that are taken away", "DEATH", model.deaths.len()),
        ("blocks that are taken away at a time", "DELETE MATERIAL", model.deletions.len()),
        ("histories of material points", "MATERIAL POINT", model.material_points.len()),
        ("histories of blocks, node sets and nodes", "HISTORY", model.histories.len()),
    ];
    for (what, command, count) in counts.into_iter().filter(|(.., count)| *count > 0) {
        let asked_by = if count == 1 { command.to_string() } else { format!("{command}, {count} of them") };
        list.push(Feature { what: what.to_string(), asked_by });
    }
    list
}

/// How many elements of which shapes a block has.
fn elements(block: &Block) -> String {
    if block.shape == Shape::Plane {
        let all = block.elements();
        let triangles = all.filter(|nodes| (0..4).any(|i| nodes[i] == nodes[(i + 1) % 4])).count();
        let kinds = [(block.len() - triangles, "quadrilateral"), (triangles, "triangle")];
        let named = kinds.into_iter().filter(|(count, name)| *count > 0 || block.is_empty() && *name != "triangle");
        return named.map(|(count, name)| counted(count, name)).collect::<Vec<_>>().join(", ");
    }
    if block.shape != Shape::Hexahedron {
        let [one, several] = block.shape.names();
        return format!("{} {}", block.len(), if block.len() == 1 { one } else { several });
    }
    let mut out = Vec::new();
    for (shape, name) in [
        (Form::Hexahedron, "hexahedra"),
        (Form::Wedge, "wedges"),
        (Form::Pyramid, "pyramids"),
        (Form::Tetrahedron, "tetrahedra"),
    ] {
        let count = block.hexahedra().iter().filter(|nodes| form(nodes) == shape).count();
        if count > 0 || block.is_empty() && shape == Form::Hexahedron {
            out.push(format!("{count} {name}"));
        }
    }
    out.join(", ")
}

/// What every element does.
fn solids(model: &Model, mesh: &Mesh) -> Vec<Feature> {
    let laws = mesh.blocks.iter().filter_map(|block| {
        let material = model.materials.iter().find(|material| material.block == block.id)?;
        let what = format!("{}, {}", elements(block), material.law.entry().name.to_lowercase());
        Some(Feature { what, asked_by: format!("MATERIAL {}", block.id) })
    });
    let eight_points = |block: &&Block| block.shape == Shape::Hexahedron && model.has_eight_points(block.id);
    let eight_points = mesh.blocks.iter().filter(eight_points).map(|block| Feature {
        what: format!("eight points of integration in block {}", block.id),
        asked_by: "ELEMENT".into(),
    });
    laws.chain(eight_points).chain(choices(model, mesh)).collect()
}

/// What is chosen for elements of a kind, where there are any.
fn choices(model: &Model, mesh: &Mesh) -> Vec<Feature> {
    let some = |is_such: &dyn Fn(&Block) -> bool| mesh.blocks.iter().any(is_such);
    let hourglass = match model.hourglass {
        Hourglass::FlanaganBelytschko { .. } => "Flanagan-Belytschko hourglass control",
        Hourglass::AssumedStrain { .. } => "assumed strain hourglass control",
    };
    let has_modes = some(&|block| model.has_hourglass_modes(block));
    let one_point_hexahedra = some(&|block| model.has_one_point_hexahedra(block));
    let vibrates = |block: &Block| {
        let law = model.materials.iter().find(|material| material.block == block.id).map(|material| &material.law);
        law.zip(Element::of_block(block, model).ok()).is_some_and(|(law, element)| element.vibrates(law))
    };
    let viscosity = model.bulk_viscosity;
    let is_global = model.step_estimate == StepEstimate::Global;
    [
        (has_modes, hourglass, "HOURGLASS CONTROL, or its default"),
        (viscosity.linear != 0.0 || viscosity.quadratic != 0.0, "bulk viscosity", "BULK VISCOSITY, or its default"),
        (is_global && some(&vibrates), "time steps of the mesh as a whole", "TIME STEP ESTIMATE"),
        (
            model.precision == Precision::Single && one_point_hexahedra,
            "hexahedra with one point in single precision",
            "PRECISION",
        ),
        (model.spin == Spin::SecondOrder && one_point_hexahedra, "second-order spin of one-point hexahedra", "SPIN"),
    ]
    .into_iter()
    .filter(|(is_so, ..)| *is_so)
    .map(|(_, what, asked_by)| Feature { what: what.into(), asked_by: asked_by.into() })
    .collect()
}
