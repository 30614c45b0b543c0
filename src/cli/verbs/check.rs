//! `urto check`: what would be modelled, the first time step, memory and time to expect.

use crate::cli::input::Given;
use crate::cli::terminal::{complain, say};
use crate::cli::{DONE, FAILED, Failure, options};
use crate::comm::Serial;
use crate::common::vector::{dot, subtract};
use crate::mesh::{Block, Dimension, Mesh, Shape, plane};
use crate::model::{Model, StepEstimate};
use crate::output::print::{self, scientific};
use crate::run::Endless;
use crate::solver::contact::search::Box3;
use crate::solver::elements::{Element, ahead};
use crate::solver::{BlockTrial, Body, Request, Solver, Stop, of_overlaps, state_names, studs};
use crate::studies::advice;
use std::time::Instant;

/// Passes over the elements of each block that are timed to tell which of them makes a run long.
const PASSES: u32 = 5;

/// Steps that are not timed before those that are: the first ones touch memory anew, and contact searches, which lasts for many more.
const UNTIMED_STEPS: usize = 2;

/// Steps that are timed at least, and at most.
const TIMED_STEPS: [usize; 2] = [3, 200];

/// Seconds after which no more steps are timed than must be.
const TRIAL_SECONDS: f64 = 0.1;

/// Beams that turn with more than this times the inertia about their line are told.
const TOLD_INERTIA: f64 = 1.01;

/// Reads, checks and reports.
///
/// # Errors
///
/// Deck or mesh cannot be read or have mistakes; all of them are reported.
pub fn check(options: &options::Check) -> Result<u8, Failure> {
    let given = Given::read(&options.input)?;
    let mut is_warned = false;
    let mut warn = |warning: Option<String>| {
        if let Some(warning) = warning {
            complain(format_args!("{warning}\n"));
            is_warned = true;
        }
    };
    warn(given.warnings());
    let model = &given.problem.model;
    say(model.title.trim());
    let body = given.body()?;
    of_overlaps(&given.mesh, &body).iter().for_each(|found| warn(Some(print::warning_on_terminal(found))));
    let overlap = &body.overlap;
    overlap.warnings_of_unheld(&given.mesh).into_iter().for_each(|warning| warn(Some(warning)));
    for note in overlap.note(&given.mesh, model, &body).into_iter().chain(overlap.crowded.note(&given.mesh)) {
        complain(format_args!("{note}\n"));
    }
    say(modelled(&given, &body));
    if let Some(assumed) = assumed(&given) {
        say(assumed);
    }
    say(trial(&given, &body)?.trim_end());
    say(if is_warned { "deck and mesh can be run, but see the warnings" } else { "deck and mesh are sound" });
    Ok(if options.strict && is_warned { FAILED } else { DONE })
}

/// How abbreviations were understood, in a few lines; the log of a run has all.
fn assumed(given: &Given) -> Option<String> {
    /// Assumptions shown.
    const SHOWN: usize = 4;
    let mut notes: Vec<&str> = Vec::new();
    for note in given.problem.diagnostics.notes() {
        let text = note.message.trim_start_matches("assumed ");
        if !notes.contains(&text) {
            notes.push(text);
        }
    }
    let first = notes.iter().take(SHOWN).copied().collect::<Vec<_>>().join(", ");
    match notes.len() {
        0 => None,
        n if n > SHOWN => Some(format!("assumed: {first} and {} more, which the log of a run lists\n", n - SHOWN)),
        _ => Some(format!("assumed: {first}\n")),
    }
}

/// What is modelled, block by block.
fn modelled(given: &Given, body: &Body) -> String {
    let (mesh, model) = (&given.mesh, &given.problem.model);
    let masses = body.block_masses(mesh.blocks.len());
    let mut out = format!(
        "mesh {}: {} nodes, {} elements, {} node sets, {} side sets\n",
        given.mesh_path.display(),
        mesh.coordinates.len(),
        mesh.element_count(),
        mesh.node_sets.len(),
        mesh.side_sets.len()
    );
    for (index, block) in mesh.blocks.iter().enumerate() {
        let material = &model.materials[body.block_material[index]];
        let modulus = material.law.moduli().dilatational();
        out += &format!(
            "  block {}: {} elements of {}, mass {}, dilatational wave speed {}\n",
            block.id,
            block.len(),
            material.law.entry().name,
            scientific(masses[index], 4),
            scientific((modulus / material.density).sqrt(), 4)
        );
    }
    out += &(0..mesh.blocks.len()).filter_map(|index| heavy_turning(mesh, body, index)).collect::<String>();
    out += &between_bars(mesh, model, body).concat();
    out += &soft_in_torsion(mesh, model).unwrap_or_default();
    for (number, rigid) in body.rigid.iter().enumerate() {
        out +=
            &format!("  rigid body {}: {} nodes, mass {}\n", number + 1, rigid.nodes.len(), scientific(rigid.mass, 4));
    }
    for tie in &body.tied.reports {
        out += &format!(
            "  TIED CONTACT {}, {}: {} nodes follow, {} face nothing and stay free; moved by at most {}\n",
            tie.side_sets[0],
            tie.side_sets[1],
            tie.tied,
            tie.left,
            scientific(tie.moved, 4)
        );
    }
    if let Some([words, instead]) = advice::on_joints(mesh, model, body.tied.step_part()) {
        out += &format!("  {words}; better {instead}\n");
    }
    for added in &body.added_mass.blocks {
        out += &format!(
            "  block {}: MASS SCALING adds {}, {} of its mass, to {} elements; one of them has {} times its mass\n",
            added.block,
            scientific(added.added, 4),
            scientific(added.share(), 4),
            added.elements,
            scientific(added.most, 4)
        );
    }
    let parts = print::features(model, mesh).into_iter().map(|part| format!("  {:<43} {}\n", part.what, part.asked_by));
    out + "what is modelled, and which command asked for it\n" + &parts.collect::<String>()
}

/// That beams of a block turn with more than the inertia of their section, where they do; a rigid body has that of its volume.
fn heavy_turning(mesh: &Mesh, body: &Body, index: usize) -> Option<String> {
    let block = mesh.blocks.get(index).filter(|block| block.shape == Shape::Bar)?;
    let corners = |nodes: &[u32]| nodes.iter().map(|&node| body.positions[node as usize]).collect::<Vec<_>>();
    let ratios = block.elements().map(|nodes| body.elements[index].inertia_about_line(&corners(nodes)));
    let most = ratios.fold(1.0, f64::max);
    (most > TOLD_INERTIA && body.block_body[index].is_none()).then(|| {
        format!(
            "  block {}: beams turn with up to {most:.2} times rho (Iy + Iz), torsional frequencies come out up to {:.0} % low; shorter \
             elements turn with less\n",
            block.id,
            100.0 * (1.0 - 1.0 / most.sqrt())
        )
    })
}

/// That a block which touches is narrower than bars that touch are long, and so may go between the nodes with which they touch; for each
/// block of bars the narrowest.
fn between_bars(mesh: &Mesh, model: &Model, body: &Body) -> Vec<String> {
    let touches = |block: &&Block| model.contact.names(block.id);
    let (bars, others): (Vec<&Block>, Vec<&Block>) =
        mesh.blocks.iter().filter(touches).partition(|block| block.shape == Shape::Bar);
    let position = |node: u32| body.positions[node as usize];
    let width = |block: &Block| {
        let around = Box3::around(&block.elements().flatten().map(|&node| position(node)).collect::<Vec<_>>());
        let mut extents = [0, 1, 2].map(|axis| around.high[axis] - around.low[axis]);
        extents.sort_by(f64::total_cmp);
        // A shell has no thickness of its own in the mesh, and meets bars with its face.
        extents[1]
    };
    let longest = |block: &Block| {
        let along = block.elements().map(|nodes| subtract(position(nodes[1]), position(nodes[0])));
        along.map(|along| dot(along, along)).fold(0.0, f64::max).sqrt()
    };
    let widths: Vec<(f64, i64)> = others.iter().map(|block| (width(block), block.id)).collect();
    let Some((narrowest, other)) = widths.into_iter().min_by(|a, b| a.0.total_cmp(&b.0)) else { return Vec::new() };
    let long = bars.iter().map(|block| (longest(block), block.id)).filter(|(length, _)| *length > narrowest);
    long.map(|(length, id)| {
        format!(
            "  block {id}: bars touch with their nodes only, which are up to {} apart: block {other}, {} wide, may go through between \
             them; shorter bars hold it\n",
            scientific(length, 3),
            scientific(narrowest, 3)
        )
    })
    .collect()
}

/// That beams stand on shells, where they do: a note only, since most of them carry no torque.
fn soft_in_torsion(mesh: &Mesh, model: &Model) -> Option<String> {
    let (count, first) = studs(mesh, model)?;
    let where_else = if count > 1 { format!(" and {} more", count - 1) } else { String::new() };
    Some(format!(
        "  beams stand on shells at {first}{where_else}: a torque about the normal of shells is carried far too softly, and the more so the \
         finer they are; join beams that carry one over several nodes, or with a RIGID BODY\n"
    ))
}

/// Prepares the run, takes a few steps without writing anything, and says what the whole would take.
fn trial(given: &Given, body: &Body) -> Result<String, Failure> {
    let (mesh, model) = (&given.mesh, &given.problem.model);
    let cut = body.cut(1);
    let contributors = body.contributors(&cut);
    let share = body.decomposition(&contributors, 1).share(0);
    let comm = &mut Serial;
    let mut solver = Solver::new(mesh, model, body, &share, comm);
    let stopped = |stop| Failure::run(format_args!("error: the run would stop at once: {stop}"));
    solver.prepare(Request::Continue, comm).map_err(stopped)?;
    let place = solver.controlling_element(comm);
    let (first, own_step) = (solver.time_step, solver.own_step);
    let set_by = solver.bound_beside_elements().map(str::to_string);
    let of_joints = match (body.tied.step_part(), &set_by) {
        (part, None) if part < 1.0 => format!("{part:.2} of that of its elements by joints of TIED CONTACT, "),
        _ => String::new(),
    };
    let set_by = set_by.unwrap_or_else(|| format!("element {} of block {}", place.element, place.block));
    if let Some(endless) = Endless::at(solver.time, first, model.termination_time) {
        let place = format!("set by {set_by}");
        return Err(Failure::input(format_args!("error: {endless}, {place}\nhelp: {}", endless.advice())));
    }
    let foretold: String =
        advice::foretold(mesh, model, &solver).iter().map(|line| format!("foretold: {line}\n")).collect();
    let per_step = seconds_per_step(&mut solver, model.termination_time, comm).map_err(stopped)?;
    let by_block = by_block(given, &mut solver);
    let steps = (model.termination_time / first).ceil();
    let [x, y, z] = place.centre.map(|coordinate| scientific(coordinate, 3));
    let centre = if place.element == 0 { String::new() } else { format!(" at ({x}, {y}, {z})") };
    let elements = mesh.element_count() as f64;
    let of_pronto = pronto_step(given, body).map_or(String::new(), |step| {
        format!("PRONTO2D's own estimate of it, by lengths in the plane: {}\n", scientific(step, 4))
    });
    let own = model.time_step.scale * own_step;
    let of_mesh = match model.step_estimate {
        StepEstimate::Element => String::new(),
        StepEstimate::Global => format!("of the mesh as a whole; by its elements alone {}, ", scientific(own, 4)),
    };
    Ok(format!(
        "first time step {}, {of_mesh}{of_joints}set by {set_by}{centre}\n{of_pronto}\
         at least {steps:.0} steps at that size; the step shrinks where elements are squeezed\n\
         {:.0} ns per element and cycle on one core: at least {} there\n\
         {by_block}about {} of memory, {:.0} bytes per element\n\
         {foretold}",
        scientific(first, 4),
        per_step * 1e9 / elements,
        duration(per_step * steps),
        bytes(memory(given)),
        memory(given) / elements,
    ))
}

/// Seconds of a step, the median of some: neither what other programs take of the processor meanwhile nor what comes once in many steps
/// is in it, so that a run takes this at least.
fn seconds_per_step(solver: &mut Solver, end: f64, comm: &mut Serial) -> Result<f64, Stop> {
    let [fewest, most] = TIMED_STEPS;
    let (begun, mut seconds) = (Instant::now(), Vec::new());
    for step in 0..UNTIMED_STEPS + most {
        let is_needed = seconds.len() < fewest;
        if !is_needed && (begun.elapsed().as_secs_f64() > TRIAL_SECONDS || solver.time >= end) {
            break;
        }
        let begun = Instant::now();
        solver.advance();
        match solver.prepare(Request::Continue, comm) {
            Err(stop) if is_needed => return Err(stop),
            // What stops the run later is the run's to tell.
            Err(_) => break,
            Ok(_) if step >= UNTIMED_STEPS => seconds.push(begun.elapsed().as_secs_f64()),
            Ok(_) => (),
        }
    }
    seconds.sort_by(f64::total_cmp);
    Ok(seconds.get(seconds.len() / 2).copied().unwrap_or(0.0))
}

/// Step and cost of each block, where there are several: which of them makes a run long.
fn by_block(given: &Given, solver: &mut Solver) -> String {
    let (mesh, scale) = (&given.mesh, given.problem.model.time_step.scale);
    if mesh.blocks.len() < 2 {
        return String::new();
    }
    let trials = solver.try_blocks(PASSES);
    let all: f64 = trials.iter().map(|trial| trial.seconds).sum();
    let line = |trial: &BlockTrial| {
        let block = &mesh.blocks[trial.index];
        format!(
            "  block {}: step {}, {:.0} ns per element and cycle, {:.0} % of the time of all elements\n",
            block.id,
            scientific(scale * trial.stable_step, 4),
            1e9 * trial.seconds / block.len() as f64,
            100.0 * trial.seconds / all
        )
    };
    trials.iter().filter(|trial| trial.stable_step.is_finite()).map(line).collect()
}

/// What PRONTO2D took for the first step of a two-dimensional run: the shortest L/c (√(1 + b₁²) − b₁) with L = A/√(B:B). It
/// looks at the plane alone; about an axis that is no bound, and ours is another.
fn pronto_step(given: &Given, body: &Body) -> Option<f64> {
    let (mesh, model) = (&given.mesh, &given.problem.model);
    if mesh.dimension == Dimension::Three {
        return None;
    }
    let linear = model.bulk_viscosity.linear;
    let damped = (1.0 + linear * linear).sqrt() - linear;
    let of_block = |(block, nodes): (usize, &[u32])| {
        let material = &model.materials[body.block_material[block]];
        let speed = (material.law.moduli().dilatational() / material.density).sqrt();
        let corners: [u32; 4] = nodes.try_into().ok()?;
        Some(plane::wave_length(&body.corners(&corners)) / speed * damped)
    };
    mesh.elements().filter_map(of_block).reduce(f64::min)
}

/// Bytes of element and node state and of the mesh, by the sizes of what is stored.
fn memory(given: &Given) -> f64 {
    let (mesh, model) = (&given.mesh, &given.problem.model);
    let elements: usize = mesh
        .blocks
        .iter()
        .map(|block| {
            let law_rows =
                model.materials.iter().find(|m| m.block == block.id).map_or(0, |m| state_names(&m.law).len());
            // State, mass, connectivity; place, file number and canonical number; connectivity and number in the mesh.
            let rows =
                |element: Element| element.entry().rows.len() + element.points() * (element.point_rows() + law_rows);
            let rows = Element::of_block(block, model).map_or(0, rows);
            ahead::bytes(block.len())
                + block.len() * (8 * rows + 8 + 4 * block.shape.corners() + 3 * 4 + 4 * block.shape.corners() + 8)
        })
        .sum();
    // A node's record, force, file number and ownership; position and number in the mesh.
    (elements + mesh.coordinates.len() * (64 + 32 + 4 + 1 + 24 + 8)) as f64
}

fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 0.1 => "less than 0.1 s".to_string(),
        s if s < 120.0 => format!("{s:.1} s"),
        s if s < 7200.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}

fn bytes(count: f64) -> String {
    match count {
        b if b < 1e6 => format!("{:.0} kB", b / 1e3),
        b if b < 1e9 => format!("{:.0} MB", b / 1e6),
        b => format!("{:.1} GB", b / 1e9),
    }
}
