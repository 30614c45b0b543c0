//! The front part of the print log: deck, problem definition, materials, conditions, masses.

use super::{features, heading, leader, number};
use crate::mesh::Mesh;
use crate::model::{
    Analysis, Direction, Hourglass, InitialVelocity, Model, MotionKind, Precision, Spin, StepEstimate, StepModuli,
};
use crate::solver::contact::Overlap;
use crate::solver::loads::LOADS;
use crate::solver::{BlockMass, BodyShape, TiedReport};
use std::fmt::Write;

/// What the front part needs to know.
pub struct Echo<'a> {
    /// Banner: program, version, date, machine; one per line.
    pub banner: &'a [String],
    /// Text of the deck.
    pub deck: &'a str,
    /// What was assumed in reading it.
    pub assumed: &'a [String],
    /// Warnings from reading it.
    pub warnings: &'a [String],
    /// The model.
    pub model: &'a Model,
    /// The mesh.
    pub mesh: &'a Mesh,
    /// Overlaps that were taken out of the mesh.
    pub overlap: Overlap,
    /// Mass of each block, in mesh order.
    pub masses: &'a [f64],
    /// What MASS SCALING has added to blocks.
    pub added: &'a [BlockMass],
    /// Rigid bodies.
    pub rigid: &'a [BodyShape],
    /// What came of TIED CONTACT.
    pub ties: &'a [TiedReport],
    /// Names of the nodal, element and global variables of the plot file.
    pub variables: [&'a [String]; 3],
    /// Seconds that the data input phase and the data initialization phase took.
    pub seconds: [f64; 2],
    /// Memory held by this process at the end of the latter, in bytes, where the system tells.
    pub memory: Option<f64>,
}

/// The front part as text.
pub fn problem(echo: &Echo) -> String {
    let mut out = String::new();
    for line in echo.banner {
        let _ = writeln!(out, "  {line}");
    }
    out += &heading("INPUT STREAM IMAGES");
    for (i, line) in echo.deck.lines().enumerate() {
        let _ = writeln!(out, "{:4}: {line}", i + 1);
    }
    for (title, lines) in [("ASSUMED IN READING IT", echo.assumed), ("WARNINGS", echo.warnings)] {
        if !lines.is_empty() {
            out += &heading(title);
            lines.iter().for_each(|line| out += &format!("  {line}\n"));
        }
    }
    out += &heading("PROBLEM TITLE");
    let _ = writeln!(out, "          {}", echo.model.title.trim());
    out += &definition(echo.model, echo.mesh);
    out += &modelled(echo.model, echo.mesh);
    out += &materials(echo.model, echo.mesh);
    out += &functions(echo.model);
    out += &conditions(echo.model);
    out += &super::contact::tables(echo.model, echo.overlap);
    out += &end_of_phase("END OF DATA INPUT PHASE", echo.seconds[0], None);
    out += &masses(echo);
    out += &end_of_phase("END OF DATA INITIALIZATION PHASE", echo.seconds[1], echo.memory);
    out += &variables(echo.variables);
    out
}

fn end_of_phase(title: &str, seconds: f64, memory: Option<f64>) -> String {
    let memory = memory.map_or(String::new(), |bytes| format!("{:>48.3} MEGABYTES HELD\n", bytes / 1e6));
    format!("{}{seconds:>48.3} SECONDS\n{memory}", heading(title))
}

fn modelled(model: &Model, mesh: &Mesh) -> String {
    let lines = features(model, mesh).into_iter().map(|feature| format!("{:<43} {}", feature.what, feature.asked_by));
    table("WHAT IS MODELLED", &format!("{:<43} {}", "PART", "ASKED FOR BY"), lines.collect())
}

fn functions(model: &Model) -> String {
    let points = model.functions.iter().flat_map(|function| {
        let name = |i: usize| if i == 0 { function.id.to_string() } else { String::new() };
        let line = move |(i, point): (usize, &(f64, f64))| {
            format!("{:>8}{:>16}{:>16}", name(i), number(point.0), number(point.1))
        };
        function.points.iter().enumerate().map(line).collect::<Vec<_>>()
    });
    table("FUNCTIONS", "FUNCTION            TIME           VALUE", points.collect())
}

fn definition(model: &Model, mesh: &Mesh) -> String {
    let mut out = heading("PROBLEM DEFINITION");
    let count = |n: usize| n.to_string();
    let interval = |i: Option<f64>| i.map_or("NONE".into(), number);
    out += &leader("NUMBER OF ELEMENTS", &count(mesh.element_count()));
    out += &leader("NUMBER OF NODES", &count(mesh.coordinates.len()));
    out += &leader("NUMBER OF MATERIALS", &count(model.materials.len()));
    out += &leader("NUMBER OF FUNCTIONS", &count(model.functions.len()));
    out += &leader("NUMBER OF CONTACT SURFACES", &count(model.contact.surfaces.len()));
    out += &leader("NUMBER OF RIGID SURFACES", &count(model.rigid_surfaces.len()));
    out += &leader("NUMBER OF MATERIAL POINTS MONITORED", &model.material_points.len().to_string());
    out += &leader("ANALYSIS TYPE", model.analysis.name());
    out += &leader("TERMINATION TIME", &number(model.termination_time));
    out += &leader("PRINT OUTPUT AT INTERVALS OF", &number(model.output_interval));
    if model.history_interval.is_some() {
        out += &leader("WRITE HISTORIES AT INTERVALS OF", &interval(model.history_interval));
    }
    out += &leader("WRITE PLOT FILE AT INTERVALS OF", &interval(model.plot.interval));
    out += &leader("START WRITING PLOT FILE AT TIME", &number(model.plot.start));
    out += &leader("STOP WRITING PLOT FILE AT TIME", &number(model.plot.stop));
    out += &leader("WRITE RESTART FILE AT INTERVALS OF", &interval(model.restarts.write.map(|write| write.interval)));
    out += &leader("SCALE FACTOR APPLIED TO TIME STEP", &number(model.time_step.scale));
    out += &leader("STRAIN SOFTENING SCALE FACTOR", &number(model.time_step.softening));
    out += &leader("LARGEST GROWTH OF TIME STEP", &number(model.time_step.growth));
    let moduli = match model.time_step.moduli {
        StepModuli::Elastic => "ELASTIC",
        StepModuli::Effective => "EFFECTIVE",
    };
    out += &leader("MODULI OF THE TIME STEP", moduli);
    if model.precision == Precision::Single {
        out += &leader("PRECISION OF HEXAHEDRA WITH ONE POINT", "SINGLE");
    }
    if model.spin == Spin::SecondOrder {
        out += &leader("SPIN OF HEXAHEDRA WITH ONE POINT", "SECOND ORDER");
    }
    if model.step_estimate == StepEstimate::Global {
        out += &leader("ESTIMATE OF THE TIME STEP", "GLOBAL");
    }
    match model.hourglass {
        Hourglass::FlanaganBelytschko { stiffness, viscosity } => {
            out += &leader("HOURGLASS CONTROL", "FLANAGAN-BELYTSCHKO");
            out += &leader("HOURGLASS STIFFNESS FACTOR", &number(stiffness));
            out += &leader("HOURGLASS VISCOSITY FACTOR", &number(viscosity));
        }
        Hourglass::AssumedStrain { factor } => {
            out += &leader("HOURGLASS CONTROL", "ASSUMED STRAIN");
            out += &leader("FACTOR ON ASSUMED STRAIN STIFFNESS", &number(factor));
        }
    }
    out += &leader("LINEAR BULK VISCOSITY CONSTANT", &number(model.bulk_viscosity.linear));
    out += &leader("QUADRATIC BULK VISCOSITY CONSTANT", &number(model.bulk_viscosity.quadratic));
    out
}

fn materials(model: &Model, mesh: &Mesh) -> String {
    let mut out = heading("MATERIAL DEFINITIONS");
    for block in &mesh.blocks {
        let Some(material) = model.materials.iter().find(|m| m.block == block.id) else { continue };
        let entry = material.law.entry();
        out += &leader("MATERIAL TYPE", entry.name);
        out += &leader("MATERIAL ID", &block.id.to_string());
        out += &leader("DENSITY", &number(material.density));
        out += "              MATERIAL PROPERTIES:\n";
        for (property, value) in entry.properties.iter().zip(material.law.values()) {
            let _ = writeln!(out, "                     {:<21} = {:>12}", property.keyword, number(value));
        }
        if let Some(equation) = material.law.equation_of_state() {
            out += &leader("EQUATION OF STATE", equation.entry().name);
            for (property, value) in equation.entry().properties.iter().zip(equation.values()) {
                let _ = writeln!(out, "                     {:<21} = {:>12}", property.keyword, number(value));
            }
        }
        let modulus = material.law.moduli().dilatational();
        out += "              CALCULATED INITIAL VALUES FOR:\n";
        out += &leader("  INITIAL DILATATIONAL MODULUS", &number(modulus));
        out += &leader("  INITIAL DILATATIONAL WAVE SPEED", &number((modulus / material.density).sqrt()));
        out += "\n";
    }
    out
}

fn axis(direction: Direction) -> &'static str {
    ["X", "Y", "Z"][direction.axis()]
}

fn vector(v: [f64; 3]) -> String {
    format!("{:>13}{:>13}{:>13}", number(v[0]), number(v[1]), number(v[2]))
}

/// A table with a heading and one line per entry; nothing when there are none.
pub(super) fn table(title: &str, columns: &str, lines: Vec<String>) -> String {
    if lines.is_empty() {
        return String::new();
    }
    let body: String = lines.iter().map(|line| format!("              {line}\n")).collect();
    format!("{}              {columns}\n{body}", heading(title))
}

fn conditions(model: &Model) -> String {
    let still = model.no_displacements.iter().map(|c| format!("{:>13}{:>13}", c.node_set, axis(c.direction)));
    let function = |f: usize| model.functions.get(f).map_or(0, |f| f.id);
    let motions = model.prescribed_motions.iter().map(|m| {
        let kind = match m.kind {
            MotionKind::Displacement => "DISPLACEMENT",
            MotionKind::Velocity => "VELOCITY",
            MotionKind::Acceleration => "ACCELERATION",
        };
        format!(
            "{kind:<13}{:>13}{:>11}{:>10}{:>13}",
            m.node_set,
            axis(m.direction),
            function(m.function),
            number(m.scale)
        )
    });
    let points = model.material_points.iter().enumerate().map(|(i, &x)| format!("{:>13}{}", i + 1, vector(x)));
    let velocities = model.initial_velocities.iter().map(|v| match *v {
        InitialVelocity::Material { block, velocity } => format!("MATERIAL {block:>8}{}", vector(velocity)),
        InitialVelocity::NodeSet { node_set, velocity } => format!("NODE SET {node_set:>8}{}", vector(velocity)),
        InitialVelocity::Radial { block, speed, point, axis } => {
            let from = match axis {
                Some(axis) => format!("{}   AXIS THROUGH{}", vector(axis), vector(point)),
                None => format!("{}   POINT", vector(point)),
            };
            format!("RADIAL   {block:>8}{from}   SPEED {}", number(speed))
        }
        InitialVelocity::Angular { block, omega, point, axis } => {
            format!("ANGULAR  {block:>8}{}   AXIS THROUGH{}   RATE {}", vector(axis), vector(point), number(omega))
        }
    });
    let planes = model
        .rigid_surfaces
        .iter()
        .map(|r| format!("{:>8}{}{}{:>12}", r.side_set, vector(r.point), vector(r.normal), number(r.friction)));
    let loads = LOADS.iter().map(|load| {
        let (title, columns, lines) = (load.echo)(model);
        table(title, columns, lines)
    });
    let sections = model.sections.iter().map(|section| {
        let words = section.words.iter().map(|(_, word)| format!("{word:>13}"));
        let numbers = section.numbers.iter().map(|(_, value)| format!("{:>13}", number(*value)));
        format!("{:>8}  {:<22}{}", section.block, section.command, words.chain(numbers).collect::<String>())
    });
    [
        table("SECTIONS OF ELEMENTS", "   BLOCK  COMMAND", sections.collect()),
        table("NO DISPLACEMENT BOUNDARY CONDITIONS", "NODE SET FLAG    DIRECTION", still.collect()),
        table("PRESCRIBED MOTIONS", "KIND              NODE SET  DIRECTION  FUNCTION        SCALE", motions.collect()),
        loads.collect(),
        table("INITIAL VELOCITIES", "                            X            Y            Z", velocities.collect()),
        table(
            "RIGID SURFACES",
            "SIDE SET      POINT X      POINT Y      POINT Z     NORMAL X     NORMAL Y     NORMAL Z    FRICTION",
            planes.collect(),
        ),
        table("MATERIAL POINTS MONITORED", "        POINT            X            Y            Z", points.collect()),
    ]
    .concat()
}

fn masses(echo: &Echo) -> String {
    let lines = echo.mesh.blocks.iter().zip(echo.masses).map(|(b, m)| format!("{:>13}{:>16}", b.id, number(*m)));
    let table = table("TOTAL MASS OF EACH MATERIAL", "  MATERIAL ID            MASS", lines.collect());
    let table = table + &added_masses(echo.added) + &rigid_bodies(echo.rigid) + &ties(echo.ties);
    let of = match echo.model.analysis {
        Analysis::Solid => return table,
        Analysis::PlaneStrain => "A UNIT OF THICKNESS",
        Analysis::Axisymmetric | Analysis::AxisymmetricCompatible => "TWO PI RADIANS",
    };
    format!("{table}                ( ALL MASSES ARE FOR {of} )\n")
}

/// What came of TIED CONTACT, a line for each.
fn ties(ties: &[TiedReport]) -> String {
    let line = |tie: &TiedReport| {
        let TiedReport { side_sets: [first, second], tied, left, moved } = *tie;
        format!("{first:>12}{second:>12}{tied:>12}{left:>12}{:>14}", number(moved))
    };
    let columns = "  FIRST SET  SECOND SET  NODES TIED   LEFT FREE  FARTHEST MOVE";
    table("TIED SURFACES", columns, ties.iter().map(line).collect())
}

/// Mass, centre and inertia of each rigid body.
fn rigid_bodies(bodies: &[BodyShape]) -> String {
    let line = |body: &BodyShape| {
        let blocks: Vec<String> = body.blocks.iter().map(i64::to_string).collect();
        let [a, b, c] = body.inertia;
        let numbers = [body.mass, body.centre[0], body.centre[1], body.centre[2], a[0], b[1], c[2], a[1], b[2], c[0]];
        let numbers: String = numbers.iter().map(|value| format!("{:>13}", number(*value))).collect();
        format!("{numbers}  {}", blocks.join(" "))
    };
    table(
        "RIGID BODIES, MOMENTS OF INERTIA ABOUT THEIR CENTRES",
        "         MASS     CENTRE X     CENTRE Y     CENTRE Z          IXX          IYY          IZZ          IXY          IYZ          IZX  BLOCKS",
        bodies.iter().map(line).collect(),
    )
}

/// What MASS SCALING has added, a line for each block that it names.
fn added_masses(added: &[BlockMass]) -> String {
    let lines = added.iter().map(|block| {
        let BlockMass { block: id, added, elements, most, limit, .. } = *block;
        let share = number(block.share());
        format!("{id:>13}{:>16}{share:>12}{elements:>10}{:>16}{:>12}", number(added), number(most), number(limit))
    });
    table(
        "MASS ADDED BY MASS SCALING",
        "  MATERIAL ID            MASS       SHARE  ELEMENTS  LARGEST FACTOR       LIMIT",
        lines.collect(),
    )
}

fn variables([nodal, element, global]: [&[String]; 3]) -> String {
    let rows = nodal.len().max(element.len()).max(global.len());
    let at = |names: &[String], i: usize| names.get(i).cloned().unwrap_or_default();
    let lines = (0..rows).map(|i| format!("{:<12}{:<12}{:<12}", at(nodal, i), at(element, i), at(global, i)));
    let lines = lines.map(|l| l.trim_end().to_string()).collect();
    table("VARIABLES ON PLOTTING DATA BASE", "NODAL       ELEMENT     GLOBAL", lines)
}
