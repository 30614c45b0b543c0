//! What a restart is a state of, and whether a deck and a mesh are still the same problem.
//!
//! A continued run may change its times, outputs, loads, constraints and the numbers of its laws. What gives the stored
//! state its meaning must stay: the mesh, laws with their equations of state, densities and added masses of the blocks, layers
//! of shells and sections of beams, hourglass control, and what is in contact. What only the start of a run asks for may
//! change, and has no effect.

use crate::exodus::Restart;
use crate::material::{EquationOfState, Law};
use crate::mesh::{Block, Mesh, Shape};
use crate::model::{
    Analysis, ContactMaterials, ContactOverlap, Hourglass, MassScaling, Model, Precision, Spin, StepEstimate,
};
use crate::output::print::scientific;
use crate::solver::contact::PressFit;
use crate::solver::elements::{beam, shell};
use crate::solver::{Body, state_names};

/// Version of the meaning of what a restart file holds. Since 2 it holds what the run has found out about itself, and what
/// contact has made; since 3 the energy at the last look, and heights of elements since the step of the mesh was estimated;
/// since 4 for how many steps contact has not settled; since 6 its identity tells of equations of state, layers, sections
/// and exclusions; since 8 edges may be bent lines.
const FORMAT: &str = "8";

/// How names of lines begin that tell what only a start asks for.
const START: &str = "START ";

/// The line of what becomes of overlaps. It may change, but for what [`press_fit`] refuses.
const OVERLAP: &str = "CONTACT OVERLAP";

/// Differences told one by one.
const TOLD: usize = 5;

/// A name and a value.
type Line = (String, String);

/// What must stay the same, and what only a start asks for: names and values, a line each.
pub fn identity(model: &Model, mesh: &Mesh) -> String {
    let mut lines = vec![("format".to_string(), FORMAT.to_string())];
    lines.extend(of_analysis(model));
    lines.extend(of_blocks(model, mesh));
    lines.extend(of_contact(model));
    lines.extend(of_start(model, mesh));
    lines.into_iter().map(|(name, value)| format!("{name}: {value}\n")).collect()
}

/// How the whole is computed.
fn of_analysis(model: &Model) -> Vec<Line> {
    let mut lines = Vec::new();
    if model.analysis != Analysis::Solid {
        lines.push(("ANALYSIS".to_string(), model.analysis.name().to_string()));
    }
    let hourglass = match model.hourglass {
        Hourglass::FlanaganBelytschko { .. } => "FLANAGAN BELYTSCHKO",
        Hourglass::AssumedStrain { .. } => "ASSUMED STRAIN",
    };
    lines.push(("HOURGLASS CONTROL".into(), hourglass.into()));
    if model.precision == Precision::Single {
        lines.push(("PRECISION".into(), "SINGLE".into()));
    }
    if model.spin == Spin::SecondOrder {
        lines.push(("SPIN".into(), "SECOND ORDER".into()));
    }
    if model.step_estimate == StepEstimate::Global {
        lines.push(("TIME STEP ESTIMATE".into(), "GLOBAL".into()));
    }
    lines
}

/// What the blocks are made of and how they hang together.
fn of_blocks(model: &Model, mesh: &Mesh) -> Vec<Line> {
    let mut lines = Vec::new();
    for material in &model.materials {
        let states = state_names(&material.law);
        let stored = if states.is_empty() { String::new() } else { format!(" with {}", states.join(" ")) };
        let law = format!("{} of density {}{stored}", material.law.entry().name, material.density);
        lines.push((format!("MATERIAL {}", material.block), law));
        // The state holds what has been added to this energy.
        lines.extend(material.law.equation_of_state().map(|equation| {
            let energy = equation.initial_energy();
            let value = format!("{} with INITIAL ENERGY {energy}", equation.entry().name);
            (format!("EQUATION OF STATE {}", material.block), value)
        }));
    }
    for block in mesh.blocks.iter().filter(|block| !model.is_rigid(block.id)) {
        if matches!(block.shape, Shape::Quadrilateral | Shape::Triangle) {
            let (points, rule) = shell::points_of(block.id, model);
            lines.push((format!("INTEGRATION POINTS {}", block.id), format!("{points} by {rule}")));
        }
        lines.extend(beam::in_words(block, model).map(|[section, _]| (format!("BEAM SECTION {}", block.id), section)));
    }
    for section in model.sections.iter().filter(|section| section.command == "ELEMENT") {
        let formulation = section.word("formulation").unwrap_or_default();
        lines.push((format!("ELEMENT {}", section.block), formulation.to_string()));
    }
    for (number, blocks) in model.rigid_bodies.iter().enumerate() {
        let blocks: Vec<String> = blocks.iter().map(i64::to_string).collect();
        lines.push((format!("RIGID BODY {}", number + 1), blocks.join(" ")));
    }
    for tie in &model.ties {
        let [first, second] = tie.side_sets;
        lines.push((format!("TIED CONTACT {first} {second}"), tie.tolerance.to_string()));
    }
    // Masses are of the start; the same commands find the same ones.
    for MassScaling { block, scale, .. } in &model.mass_scalings {
        let of = block.map_or("ALL".to_string(), |block| block.to_string());
        lines.push((format!("MASS SCALING {of}"), format!("{scale:?}")));
    }
    lines
}

/// What touches.
fn of_contact(model: &Model) -> Vec<Line> {
    let mut lines = Vec::new();
    let materials = match &model.contact.materials {
        None => "none".to_string(),
        Some(ContactMaterials::All) => "all blocks".to_string(),
        Some(ContactMaterials::Blocks(blocks)) => {
            let mut blocks = blocks.clone();
            blocks.sort_unstable();
            blocks.dedup();
            blocks.iter().map(i64::to_string).collect::<Vec<_>>().join(" ")
        }
    };
    lines.push(("CONTACT MATERIAL".into(), materials));
    let pairs = model.contact.surfaces.iter().map(|pair| format!("{} on {}", pair.side_sets[0], pair.side_sets[1]));
    lines.push(("CONTACT SURFACE".into(), some(pairs.collect())));
    lines.push(("CONTACT EXCLUSION".into(), some(exclusions(&model.contact.exclusions))));
    let balls = model.contact.node_sets.iter().map(|(set, radius)| format!("{set} of radius {radius}"));
    lines.push(("CONTACT NODE SET".into(), some(balls.collect())));
    let planes = model.rigid_surfaces.iter().map(|p| format!("{} at {:?} along {:?}", p.side_set, p.point, p.normal));
    lines.push(("RIGID SURFACE".into(), some(planes.collect())));
    lines.push((OVERLAP.into(), overlap_in_words(model.contact.control.overlap)));
    lines
}

fn overlap_in_words(overlap: ContactOverlap) -> String {
    match overlap {
        ContactOverlap::Refuse | ContactOverlap::Remove => "REMOVE".to_string(),
        ContactOverlap::Keep => "KEEP".to_string(),
        ContactOverlap::Stress(None) => "STRESS".to_string(),
        ContactOverlap::Stress(Some(time)) => format!("STRESS {time}"),
    }
}

/// Pairs of blocks that do not touch, in one order however the deck names them.
fn exclusions(pairs: &[[Option<i64>; 2]]) -> Vec<String> {
    let mut pairs: Vec<[Option<i64>; 2]> = pairs.to_vec();
    // Without a second block it is the first that does not touch itself; two are a pair in either order.
    pairs.iter_mut().filter(|pair| pair[1].is_some()).for_each(|pair| pair.sort_unstable());
    pairs.sort_unstable();
    pairs.dedup();
    let name = |block: Option<i64>, missing: &str| block.map_or(missing.to_string(), |block| block.to_string());
    pairs.iter().map(|&[first, second]| format!("{} from {}", name(first, "all"), name(second, "itself"))).collect()
}

/// What only a start asks for: all of it is in the state since.
fn of_start(model: &Model, mesh: &Mesh) -> Vec<Line> {
    let mut lines = Vec::new();
    if !model.initial_velocities.is_empty() {
        lines.push((format!("{START}INITIAL VELOCITY"), format!("{:?}", model.initial_velocities)));
    }
    for material in &model.materials {
        // When each element begins to burn, and how fast, is in its state.
        if let (Law::Hydrodynamic(law), Some(EquationOfState::Jwl(jwl))) =
            (&material.law, material.law.equation_of_state())
        {
            let (block, burn) = (material.block, [jwl.velocity, jwl.width]);
            lines.push((format!("{START}DETONATION POINT"), format!("{:?}", law.points)));
            lines.push((format!("{START}DETONATION VELOCITY and BURN WIDTH of block {block}"), format!("{burn:?}")));
        }
    }
    for block in &mesh.blocks {
        let name = || format!("{START}the vector of BEAM SECTION {}", block.id);
        lines.extend(beam::in_words(block, model).map(|[_, vector]| (name(), vector)));
    }
    lines
}

/// What a deck asks otherwise than the one before did and only a start heeds, a sentence each; what it does not ask for any
/// more is not missed.
pub fn without_effect(restart: &Restart, mesh: &Mesh, model: &Model, body: &Body) -> Vec<String> {
    let (then, now) = (lines(&restart.identity), lines(&identity(model, mesh)));
    let of_start = now.iter().filter_map(|(name, asked)| Some((name, name.strip_prefix(START)?, asked)));
    let changed = of_start.filter(|(name, _, asked)| value(&then, name) != **asked);
    let mut told: Vec<String> = changed.map(|(_, what, _)| format!("{what} has no effect after a restart")).collect();
    told.dedup();
    told.extend(idle_fit(restart, mesh, model, body));
    told
}

fn some(list: Vec<String>) -> String {
    if list.is_empty() { "none".into() } else { list.join(", ") }
}

/// Why the state of another version of the program cannot be gone on from.
pub fn other_form(restart: &Restart) -> Option<String> {
    let form = value(&lines(&restart.identity), "format");
    (form != FORMAT).then(|| {
        format!(
            "its state has form {form}, and this version of urto needs form {FORMAT}: without what contact has made, how it \
             settles and what the run was warned of, the balance of the rest would mean nothing"
        )
    })
}

/// Why a state cannot be gone on from with this deck and mesh, a sentence each; none when it can.
pub fn differences(restart: &Restart, mesh: &Mesh, model: &Model, body: &Body) -> Vec<String> {
    let now = identity(model, mesh);
    let mut found = meshes(&restart.mesh, mesh);
    found.extend(texts(&restart.identity, &now));
    found.extend(unfinished_fit(restart, mesh, model, body));
    let dead = restart.snapshot.lists.iter().find(|list| list.name == "DEAD").map_or(0, |list| list.values.len());
    if dead > 0 && model.deaths.is_empty() && model.deletions.is_empty() {
        found.push(format!("{dead} elements had been taken away, the deck has neither DEATH nor DELETE MATERIAL now"));
    }
    if found.is_empty() {
        found.extend(masses(restart, mesh, body));
    }
    found
}

/// Names and values of an identity.
fn lines(text: &str) -> Vec<Line> {
    text.lines().filter_map(|line| line.split_once(": ")).map(|(a, b)| (a.to_string(), b.to_string())).collect()
}

/// A value by its name.
fn value(list: &[Line], name: &str) -> String {
    list.iter().find(|(known, _)| known == name).map_or("none".to_string(), |(_, value)| value.clone())
}

/// Values that differ between two identities.
fn texts(then: &str, now: &str) -> Vec<String> {
    let (then, now) = (lines(then), lines(now));
    let mut names: Vec<&String> = then.iter().chain(&now).map(|(name, _)| name).collect();
    names.sort();
    names.dedup();
    let may_differ = |name: &&String| name.starts_with(START) || *name == OVERLAP;
    let differ = names.into_iter().filter(|name| !may_differ(name) && value(&then, name) != value(&now, name));
    differ.map(|name| format!("{name}: it was {}, it is {}", value(&then, name), value(&now, name))).collect()
}

fn meshes(then: &Mesh, now: &Mesh) -> Vec<String> {
    let counts = |mesh: &Mesh| format!("{} nodes and {} elements", mesh.coordinates.len(), mesh.element_count());
    if counts(then) != counts(now) {
        return vec![format!("the mesh had {}, it has {}", counts(then), counts(now))];
    }
    let ids = |mesh: &Mesh| mesh.blocks.iter().map(|block| block.id).collect::<Vec<_>>();
    if ids(then) != ids(now) {
        return vec![format!("the element blocks were {:?}, they are {:?}", ids(then), ids(now))];
    }
    let mut found = Vec::new();
    for (block, other) in then.blocks.iter().zip(&now.blocks) {
        if block.shape != other.shape {
            let [then, now] = [block, other].map(|block| block.shape.names()[1]);
            found.push(format!("the elements of block {} were {then}, they are {now}", block.id));
        } else if block.len() != other.len() {
            let counts = [block, other].map(Block::len);
            found.push(format!("block {} had {} elements, it has {}", block.id, counts[0], counts[1]));
        } else if block.nodes != other.nodes {
            found.push(format!("elements of block {} have other nodes than they had", block.id));
        } else if block.attributes != other.attributes {
            found.push(format!("elements of block {} have other attributes than they had", block.id));
        }
    }
    let moved = then.coordinates.iter().zip(&now.coordinates).position(|(a, b)| a != b);
    found.extend(moved.map(|node| format!("node {} is not where it was in the mesh", now.node_ids[node])));
    found
}

/// Masses follow from mesh, densities and the overlaps that were taken out of the mesh at the start.
fn masses(restart: &Restart, mesh: &Mesh, body: &Body) -> Option<String> {
    let (_, then) = restart.snapshot.nodal.iter().find(|(name, _)| name == "NODMASS")?;
    // A node that has been dropped has no mass.
    let differ = then.iter().zip(&body.node_mass).position(|(then, now)| *then != 0.0 && then != now)?;
    let node = mesh.node_ids[differ];
    Some(format!(
        "node {node} had another mass: CONTACT OVERLAP takes overlaps out of the mesh in another way now, or masses are added in another way"
    ))
}

/// When the press fit of the run that wrote a state ends, and when that of the deck does.
fn fits(restart: &Restart, mesh: &Mesh, model: &Model, body: &Body) -> [Option<f64>; 2] {
    let then = value(&lines(&restart.identity), OVERLAP);
    let said = then.strip_prefix("STRESS").map(|time| time.trim().parse::<f64>().ok());
    let then = said.map(|said| PressFit::duration_of(said, mesh, model, body));
    [then, PressFit::of(mesh, model, body).map(|fit| fit.duration)]
}

/// A press fit, or overlaps that were kept, of which the deck wants nothing to be left at a time that is past.
fn unfinished_fit(restart: &Restart, mesh: &Mesh, model: &Model, body: &Body) -> Option<String> {
    let time = restart.snapshot.time();
    let [then, now] = fits(restart, mesh, model, body);
    let now = now.filter(|now| *now <= time)?;
    let is_kept = value(&lines(&restart.identity), OVERLAP) == "KEEP" && body.overlap.kept.nodes > 0;
    let was = match then {
        Some(then) if then > time => format!("it was to end at {}", scientific(then, 6)),
        None if is_kept => "what overlaps was kept until then".to_string(),
        _ => return None,
    };
    Some(format!(
        "CONTACT OVERLAP, STRESS: its time, {}, is past at {}, and bodies still overlap, as {was}: a time that is still to come ends the fit",
        scientific(now, 6),
        scientific(time, 6)
    ))
}

/// That a press fit which the deck asks for anew finds nothing to press.
fn idle_fit(restart: &Restart, mesh: &Mesh, model: &Model, body: &Body) -> Option<String> {
    let time = restart.snapshot.time();
    let why = match (value(&lines(&restart.identity), OVERLAP).as_str(), fits(restart, mesh, model, body)) {
        (_, [_, None]) => return None,
        (_, [Some(then), Some(now)]) if then <= time && now > time => "the fit had ended before",
        ("REMOVE", _) => "overlaps had been taken out of the mesh at the start, or there were none",
        ("KEEP", _) if body.overlap.kept.nodes == 0 => "nothing overlaps in the mesh",
        _ => return None,
    };
    Some(format!("CONTACT OVERLAP, STRESS has no effect after a restart: {why}"))
}

/// The differences as a list of lines, not all when there are many.
pub fn told(differences: &[String]) -> String {
    let mut lines: Vec<String> = differences.iter().take(TOLD).map(|line| format!("  {line}")).collect();
    if differences.len() > TOLD {
        lines.push(format!("  and {} more", differences.len() - TOLD));
    }
    lines.join("\n")
}
