//! `urto mesh`: meshes of simple bodies from recipes, for this project's decks and for first models.
//!
//! A recipe ([`recipe`]) is a text in the manner of a deck; `grammar/mesh/*.cards` lists its commands. It names shapes
//! ([`body::Shape`]), moves them, joins them, and asks for sets; [`make`] works through it. Every mesh is the same
//! to the bit on every machine.

pub mod body;
mod changes;
pub mod recipe;
mod shapes;

mod assembly;
mod region;
mod sets;
mod skin;
mod turn;

pub use changes::sweep::{Sweep, Swept, sweep};
pub use recipe::{CARDS, language, manual};

use assembly::{Assembled, Assembly, Joined};
use recipe::Recipe;

use crate::{
    deck::{Diagnostic, Diagnostics, Source},
    mesh::{Mesh, check},
};

/// Elements of a mesh at most. It keeps a slip of the finger from filling the memory, and node numbers within 32 bits.
const MOST_ELEMENTS: f64 = 200e6;
/// Lengths count as equal when they differ by less than this fraction of the model's diagonal ...
const OF_DIAGONAL: f64 = 1e-6;
/// ... and by less than this fraction of the shortest element edge, which matters for long rows of small elements.
const OF_SHORTEST_EDGE: f64 = 1e-2;

/// Makes the mesh that a recipe describes, every number of cells multiplied by `refine`.
///
/// `file_name` is what messages call the recipe. A warning does not keep a mesh from being made; [`make_with_warnings`]
/// hands it out.
///
/// # Errors
/// All mistakes that were found, each with its place in the recipe.
pub fn make(recipe_text: &str, file_name: &str, refine: usize) -> Result<Mesh, Diagnostics> {
    make_with_warnings(Source::new(file_name, recipe_text), refine).map(|(mesh, _)| mesh)
}

/// As [`make`], with what there is to say about a recipe that is right.
///
/// # Errors
/// All mistakes that were found.
pub fn make_with_warnings(source: Source, refine: usize) -> Result<(Mesh, Diagnostics), Diagnostics> {
    let (recipe, mut diagnostics) = Recipe::read(source);
    if refine == 0 {
        diagnostics.push(Diagnostic::error("the refinement is 0; it must be 1 or more"));
    }
    if !diagnostics.has_errors() {
        check_size(&recipe, refine, &mut diagnostics);
    }
    let mesh = if diagnostics.has_errors() { None } else { build(&recipe, refine, &mut diagnostics) };
    match mesh {
        Some(mesh) if !diagnostics.has_errors() => Ok((mesh, diagnostics)),
        _ => Err(diagnostics),
    }
}

/// Refuses meshes that are too large, before anything is made.
fn check_size(recipe: &Recipe, refine: usize, diagnostics: &mut Diagnostics) {
    let total = recipe.elements(refine);
    let elements = |part: &&recipe::Part| part.shape.elements(refine);
    let largest = recipe.parts.iter().max_by(|a, b| elements(a).total_cmp(&elements(b)));
    let Some(part) = largest.filter(|_| total > MOST_ELEMENTS) else { return };
    let refined = if refine == 1 { String::new() } else { format!(" refined {refine} times") };
    let [total, here, most] = [total, elements(&part), MOST_ELEMENTS].map(|count| count / 1e6);
    let message = format!("the mesh{refined} would have {total} million elements; at most {most} million are made");
    diagnostics.push(
        Diagnostic::error(message)
            .at(part.place.span, format!("each shape made here has {here} million"))
            .help("give fewer elements, or refine less"),
    );
}

/// Shapes, then joints, then blocks, then sets.
fn build(recipe: &Recipe, refine: usize, diagnostics: &mut Diagnostics) -> Option<Mesh> {
    let mut assembly = assemble(recipe, refine);
    if let Some(part) = assembly.mixed_part() {
        let block = recipe.parts[part].block;
        let message = format!(
            "{}: block {block} has solids as well; the elements of a block have one shape",
            recipe.parts[part].place.owner
        );
        diagnostics.push(Diagnostic::error(message).at(recipe.parts[part].place.span, "give it a block of its own"));
        return None;
    }
    if let Some(part) = assembly.flat_part() {
        diagnostics.push(flat(recipe, part));
        return None;
    }
    let tolerance = tolerance(recipe, &assembly, diagnostics)?;
    merge(recipe, &mut assembly, tolerance, diagnostics);
    split(recipe, &mut assembly, diagnostics);
    let mut assembled = assembly.finish(&recipe.title);
    divide(recipe, &mut assembled, diagnostics);
    perturb(recipe, &mut assembled, diagnostics);
    if !diagnostics.has_errors() {
        geometry(&assembled.mesh, diagnostics);
    }
    sets::fill(&mut assembled, &recipe.node_sets, &recipe.side_sets, tolerance, diagnostics);
    assembled.mesh.qa = vec![["urto mesh", env!("CARGO_PKG_VERSION"), "", ""].map(str::to_string)];
    Some(assembled.mesh)
}

fn assemble(recipe: &Recipe, refine: usize) -> Assembly {
    let mut assembly = Assembly::default();
    for part in &recipe.parts {
        let mut body = part.shape.body(refine);
        part.moves.iter().for_each(|step| step.apply(&mut body));
        assembly.add(part.block, body);
    }
    assembly
}

fn flat(recipe: &Recipe, part: usize) -> Diagnostic {
    let place = &recipe.parts[part].place;
    let help = match place.owner.as_str() {
        "HEXAHEDRON" => "corners run counter-clockwise around the bottom, seen from the top, then around the top",
        _ => "a length is too small or too large, here or in a move, to be told apart from rounding",
    };
    Diagnostic::error(format!("{}: elements have no positive volume", place.owner))
        .at(place.span, "this shape is flat, folded or turned inside out")
        .help(help)
}

/// The tolerance that the recipe gives, or a sensible one.
fn tolerance(recipe: &Recipe, assembly: &Assembly, diagnostics: &mut Diagnostics) -> Option<f64> {
    let (diagonal, shortest) = assembly.lengths();
    let Some((tolerance, span)) = recipe.tolerance else {
        return Some((OF_DIAGONAL * diagonal).min(OF_SHORTEST_EDGE * shortest));
    };
    if tolerance < 0.5 * shortest {
        return Some(tolerance);
    }
    diagnostics.push(
        Diagnostic::error(format!("TOLERANCE is {tolerance}, but the shortest element edge is {shortest:.4e}"))
            .at(span, "neighbouring nodes would count as one")
            .help("without this command a sensible tolerance is chosen"),
    );
    None
}

fn merge(recipe: &Recipe, assembly: &mut Assembly, tolerance: f64, diagnostics: &mut Diagnostics) {
    for merge in &recipe.merges {
        let joined = assembly.merge(&merge.blocks, tolerance);
        if joined.nodes == 0 {
            diagnostics.push(
                Diagnostic::warning("MERGE: no nodes of different shapes coincide")
                    .at(merge.place.span, "nothing is joined")
                    .help(format!("nodes are joined when they are less than {tolerance:.3e} apart")),
            );
        }
        if let Some([x, y, z]) = joined.first {
            let Joined { nodes, single, .. } = joined;
            let message = format!(
                "MERGE: of {nodes} joined nodes {single} have no edge of an element in common, the first at ({x}, {y}, {z})"
            );
            diagnostics.push(
                Diagnostic::warning(message)
                    .at(merge.place.span, "meshes that do not match hang together by single nodes")
                    .help("give both shapes as many elements along what they share, or leave MERGE out and join them with TIED CONTACT"),
            );
        }
    }
}

fn split(recipe: &Recipe, assembly: &mut Assembly, diagnostics: &mut Diagnostics) {
    for split in &recipe.splits {
        if assembly.split(split.block, split.new, split.low, split.high) == 0 {
            diagnostics.push(
                Diagnostic::error(format!("SPLIT BLOCK: no element of block {} has its centre here", split.block))
                    .at(split.place.span, "nothing is moved to the new block"),
            );
        }
    }
}

fn divide(recipe: &Recipe, assembled: &mut Assembled, diagnostics: &mut Diagnostics) {
    for triangles in &recipe.triangles {
        if !changes::triangles::divide(assembled, triangles.block, triangles.pattern) {
            diagnostics.push(
                Diagnostic::error(format!("TRIANGLES: block {} has no quadrilaterals of a surface", triangles.block))
                    .at(triangles.place.span, "nothing is divided")
                    .help("SHEET, SHEET TUBE and SHEET SPHERE make them"),
            );
        }
    }
}

fn perturb(recipe: &Recipe, assembled: &mut Assembled, diagnostics: &mut Diagnostics) {
    for perturb in &recipe.perturbs {
        if changes::perturb::perturb(&mut assembled.mesh, perturb.block, perturb.amplitude) == 0 {
            diagnostics.push(
                Diagnostic::error("PERTURB: there are no interior nodes").at(perturb.place.span, "nothing moves"),
            );
        }
        if !check::geometry(&assembled.mesh).is_empty() {
            diagnostics.push(
                Diagnostic::error("PERTURB: an element is turned inside out")
                    .at(perturb.place.span, "a smaller amplitude is needed here"),
            );
        }
    }
}

/// What would be refused of a file of this mesh is refused of the recipe, which a run may make into a mesh without a file.
fn geometry(mesh: &Mesh, diagnostics: &mut Diagnostics) {
    let problems = check::geometry(mesh);
    for problem in problems.list() {
        let told = Diagnostic::error(problem.what.clone());
        diagnostics.push(if problem.help.is_empty() { told } else { told.help(problem.help.clone()) });
    }
    if problems.unlisted() > 0 {
        diagnostics.push(Diagnostic::error(format!("and {} more", problems.unlisted())));
    }
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    let [x, y, z] = [0, 1, 2].map(|i| a[i] - b[i]);
    libm::sqrt(x * x + y * y + z * z)
}

/// Smallest and largest value of each coordinate.
fn bounds(coordinates: &[[f64; 3]]) -> [[f64; 2]; 3] {
    [0, 1, 2].map(|i| {
        coordinates.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x[i]), high.max(x[i])])
    })
}
