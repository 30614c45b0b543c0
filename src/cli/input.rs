//! Finds and reads deck and mesh.

use super::outputs::Inputs;
use super::terminal::complain;
use super::{Failure, options};
use crate::deck::{Definitions, Diagnostic, Diagnostics, Source};
use crate::exodus::{MeshError, read_mesh};
#[cfg(feature = "mpi")]
use crate::exodus::{Together, read_mesh_together};
use crate::mesh::{Mesh, check::unreferenced_nodes, plane};
use crate::mesher;
use crate::model::{Problem, examine};
use crate::solver::elements::Unfit;
use crate::solver::{Body, idle_deaths, idle_rotations, loose, unfit_blocks};
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A deck and its mesh, read and checked against each other.
pub struct Given {
    /// The deck's path.
    pub deck: PathBuf,
    /// The mesh's path.
    pub mesh_path: PathBuf,
    /// The problem.
    pub problem: Problem,
    /// The mesh.
    pub mesh: Mesh,
    /// The files of the mesh: itself, or the recipe and what it includes.
    pub mesh_files: Vec<PathBuf>,
}

/// A mesh, and the files that it was read or made from.
pub type MeshOf = (Mesh, Vec<PathBuf>);

impl Given {
    /// Reads both, or returns every mistake of both.
    ///
    /// # Errors
    ///
    /// All mistakes of deck and mesh, or what cannot be read.
    pub fn read(input: &options::Input) -> Result<Given, Failure> {
        Given::read_for(input, None)
    }

    /// The same; in the expressions of deck and recipe the name `ranks` has this value, if there is one.
    ///
    /// # Errors
    ///
    /// As [`Given::read`].
    pub fn read_for(input: &options::Input, ranks: Option<u32>) -> Result<Given, Failure> {
        let given = definitions(&input.define)?;
        let making = Making { refine: input.refine, given: &given, ranks };
        Given::read_with(input, &given, ranks, &mut |path| making.read_or_make(path, &mut read_mesh))
    }

    /// The same on every process of a job; they read the mesh together.
    ///
    /// # Errors
    ///
    /// As [`Given::read`], on every process alike.
    #[cfg(feature = "mpi")]
    pub fn read_together(input: &options::Input, together: &mut dyn Together) -> Result<Given, Failure> {
        // Where one process does not come as far as the mesh, none may wait for it there.
        let ready =
            deck_path(&input.deck).and_then(|deck| mesh_path(&deck, input.mesh.as_deref()).map(|mesh| (deck, mesh)));
        let ready = ready.is_ok_and(|(deck, mesh)| Source::open(&deck).is_ok() && !is_recipe(&mesh));
        if !together.same(ready.then_some(0)) {
            return Given::read(input);
        }
        let given = definitions(&input.define)?;
        let making = Making { refine: input.refine, given: &given, ranks: None };
        Given::read_with(input, &given, None, &mut |path| {
            making.read_or_make(path, &mut |path| read_mesh_together(path, together))
        })
    }

    /// The body before it is cut, or why it cannot begin: bodies that overlap and cannot be moved apart.
    ///
    /// # Errors
    ///
    /// Bodies overlap in the mesh and cannot be moved apart, an element cannot be computed, or MASS SCALING adds more than it may.
    pub fn body(&self) -> Result<Body, Failure> {
        let model = &self.problem.model;
        let body = Body::new(&self.mesh, model).map_err(Failure::input_error)?;
        let unfit = body.added_mass.refusals();
        if !unfit.is_empty() {
            let told = Diagnostics::new(self.problem.deck.source.clone());
            return Err(refused(&self.problem, told, unfit));
        }
        if let Some(refusal) = body.tied.refusal(&self.mesh, model, &body.node_mass) {
            return Err(Failure::input(refusal));
        }
        if let Some(refusal) = body.overlap.squeezed.refusal(&self.mesh) {
            return Err(Failure::input(refusal));
        }
        match body.overlap.refusal(&self.mesh) {
            Some(refusal) if model.contact.control.overlap.refuses() => Err(Failure::input(refusal)),
            _ => Ok(body),
        }
    }

    fn read_with(
        input: &options::Input,
        given: &Arc<Definitions>,
        ranks: Option<u32>,
        read: &mut dyn FnMut(&Path) -> Result<MeshOf, Failure>,
    ) -> Result<Given, Failure> {
        let deck = deck_path(&input.deck)?;
        let source = open(&deck, given, ranks)
            .map_err(|e| Failure::input(format_args!("error: cannot read the deck {}: {e}", deck.display())))?;
        let mesh = mesh_path(&deck, input.mesh.as_deref()).and_then(|path| Ok((read(&path)?, path)));
        // Mistakes in the deck are shown also when there is no mesh to hold it against.
        match (examine(source, mesh.as_ref().ok().map(|((mesh, _), _)| mesh)), mesh) {
            (Ok(mut problem), Ok(((mut mesh, mesh_files), mesh_path))) => {
                all_used(given)?;
                if problem.model.analysis.about_axis() {
                    mesh.coordinates = plane::on_axis(&mesh);
                }
                let unfit = unfit_blocks(&mesh, &problem.model);
                if unfit.is_empty() {
                    for joint in loose(&mesh, &problem.model) {
                        problem.diagnostics.push(Diagnostic::warning(joint.what).help(joint.help));
                    }
                    return Ok(Given { deck, mesh_path, problem, mesh, mesh_files });
                }
                Err(refused(&problem, problem.diagnostics.clone(), unfit))
            }
            (Err(mistakes), Ok(_)) => Err(Failure::input(render(&mistakes))),
            (Ok(_), Err(failure)) => Err(failure),
            (Err(mistakes), Err(failure)) => {
                Err(Failure::input(format_args!("{}\n{}", render(&mistakes), failure.message)))
            }
        }
    }

    /// The files that all of this was read from.
    pub fn inputs(&self) -> Inputs {
        let mesh = if is_recipe(&self.mesh_path) { "the recipe of the mesh" } else { "the mesh" };
        Inputs::default().with("the deck", self.problem.deck.source.files()).with(mesh, &self.mesh_files)
    }

    /// Warnings that the user should see, those of the deck with the lines that they are about.
    pub fn warnings(&self) -> Option<String> {
        let found = &self.problem.diagnostics;
        let deck = found.warnings().next().is_some().then(|| render(found));
        let idle = self.idle().map(|warning| format!("warning: {warning}"));
        let warnings: Vec<String> = deck.into_iter().chain(idle).collect();
        (!warnings.is_empty()).then(|| warnings.join("\n"))
    }

    /// The same, a sentence each.
    pub fn warning_messages(&self) -> impl Iterator<Item = String> {
        self.problem.diagnostics.warnings().map(|warning| warning.message.clone()).chain(self.idle())
    }

    /// A warning about nodes that belong to no element: they have no mass and take no part.
    fn idle_nodes(&self) -> Option<String> {
        let idle = unreferenced_nodes(&self.mesh);
        let first: Vec<String> =
            idle.iter().take(5).map(|&node| self.mesh.node_ids[node as usize].to_string()).collect();
        let more = if idle.len() > first.len() { ", ..." } else { "" };
        (!idle.is_empty()).then(|| {
            format!(
                "{}: {} nodes belong to no element and take no part: {}{more}",
                self.mesh_path.display(),
                idle.len(),
                first.join(", ")
            )
        })
    }
}

impl Given {
    /// Warnings about what is in deck or mesh and has no effect.
    fn idle(&self) -> impl Iterator<Item = String> {
        [self.idle_nodes(), self.idle_rotations(), self.idle_deaths()].into_iter().flatten()
    }

    /// A warning about elements that are to be taken away by an energy that they do not have.
    fn idle_deaths(&self) -> Option<String> {
        let blocks = idle_deaths(&self.mesh, &self.problem.model);
        let blocks: Vec<String> = blocks.iter().map(|block| block.to_string()).collect();
        (!blocks.is_empty()).then(|| {
            format!("DEATH watches HGENERGY of blocks {}, whose elements have no hourglass energy", blocks.join(", "))
        })
    }

    /// A warning about rotations that are held, driven, loaded or given an inertia where nothing can turn.
    fn idle_rotations(&self) -> Option<String> {
        let sets: Vec<String> =
            idle_rotations(&self.mesh, &self.problem.model).iter().map(|set| set.to_string()).collect();
        (!sets.is_empty()).then(|| {
            format!(
                "rotations of node sets {} are held, driven, loaded or given an inertia, but none of their nodes belongs to a shell, a beam \
                 or a rigid body",
                sets.join(", ")
            )
        })
    }
}

/// The values that options -D give to names.
///
/// # Errors
///
/// An option is not of the form NAME=VALUE, or gives a name a second value.
pub fn definitions(texts: &[String]) -> Result<Arc<Definitions>, Failure> {
    Definitions::parse(texts).map(Arc::new).map_err(Failure::input_error)
}

/// Refuses names that neither deck nor recipe has: most likely misspelt ones.
///
/// # Errors
///
/// A name that neither deck nor recipe has.
pub fn all_used(given: &Definitions) -> Result<(), Failure> {
    let unused = given.unused();
    if unused.is_empty() {
        return Ok(());
    }
    Err(Failure::input(format_args!(
        "error: -D gives a value to {}, which no expression in braces uses\n\
         help: a deck or recipe has such names as {{n = 4}}; without -D the value is 4",
        unused.join(" and ")
    )))
}

/// Messages as text, coloured on a terminal.
pub fn render(diagnostics: &Diagnostics) -> String {
    let color = std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    diagnostics.render(color).trim_end().to_string()
}

/// The failure of a deck whose blocks cannot be computed as it says, after what has been `told`: each with the commands whose name the
/// reason begins with, or its MATERIAL.
fn refused(problem: &Problem, mut told: Diagnostics, unfit: Vec<(i64, Unfit)>) -> Failure {
    for (block, Unfit { reason, help }) in unfit {
        let places = problem.places_of_block(block, |command| reason.starts_with(command));
        let message = Diagnostic::error(format!("block {block}: {reason}")).help(help);
        told.push(places.into_iter().fold(message, |message, place| message.at(place, format!("for block {block}"))));
    }
    Failure::input(render(&told))
}

/// The deck as named, or with its suffix added.
///
/// # Errors
///
/// There is no such file.
pub fn deck_path(named: &Path) -> Result<PathBuf, Failure> {
    let with_suffix = PathBuf::from(format!("{}.i", named.display()));
    let missing = || match named.extension() {
        Some(suffix) if suffix == "i" => format!("error: there is no deck {}", named.display()),
        _ => format!("error: there is no deck {}, nor {}", named.display(), with_suffix.display()),
    };
    [named, &with_suffix]
        .into_iter()
        .find(|path| path.is_file())
        .map(Path::to_path_buf)
        .ok_or_else(|| Failure::input(missing()))
}

/// What a deck asks for, without a mesh.
pub fn deck_alone(named: &Path, define: &[String]) -> Result<(PathBuf, Problem), Failure> {
    let given = definitions(define)?;
    let deck = deck_path(named)?;
    let source = open(&deck, &given, None)
        .map_err(|e| Failure::input(format_args!("error: cannot read the deck {}: {e}", deck.display())))?;
    let problem = examine(source, None).map_err(|mistakes| Failure::input(render(&mistakes)))?;
    Ok((deck, problem))
}

/// Reads a text, in whose expressions the name `ranks` has this value, if there is one.
fn open(path: &Path, given: &Arc<Definitions>, ranks: Option<u32>) -> std::io::Result<Source> {
    let source = Source::open(path)?.with_definitions(given);
    Ok(match ranks {
        Some(ranks) => source.with_value("ranks", ranks),
        None => source,
    })
}

/// The mesh of a recipe, or of a mesh file.
pub fn read_or_make(path: &Path, refine: u32, given: &Arc<Definitions>, ranks: Option<u32>) -> Result<MeshOf, Failure> {
    if path.extension().is_some_and(|suffix| suffix == "g") && refine == 1 {
        return read_mesh(path).map(|mesh| (mesh, vec![path.to_path_buf()])).map_err(Failure::input);
    }
    make_mesh(path, refine, given, ranks)
}

/// How a recipe becomes a mesh.
struct Making<'a> {
    refine: u32,
    given: &'a Arc<Definitions>,
    ranks: Option<u32>,
}

impl Making<'_> {
    /// The mesh of a file: read, or made when the file is a recipe.
    fn read_or_make(
        &self,
        path: &Path,
        read: &mut dyn FnMut(&Path) -> Result<Mesh, MeshError>,
    ) -> Result<MeshOf, Failure> {
        if is_recipe(path) {
            return make_mesh(path, self.refine, self.given, self.ranks);
        }
        if self.refine > 1 {
            return Err(Failure::input(format_args!(
                "error: --refine {} needs a mesh that is made from a recipe, and {} is a mesh file\n\
                 help: `urto refine {} -o fine.g` divides each of its elements; then --mesh fine.g",
                self.refine,
                path.display(),
                path.display()
            )));
        }
        read(path).map(|mesh| (mesh, vec![path.to_path_buf()])).map_err(Failure::input)
    }
}

/// Whether a file is a recipe, by its suffix.
pub fn is_recipe(path: &Path) -> bool {
    path.extension().is_some_and(|suffix| suffix == "mesh")
}

/// The mesh that a recipe describes; warnings go to the standard error.
///
/// # Errors
///
/// All mistakes of the recipe, or what cannot be read.
pub fn make_mesh(recipe: &Path, refine: u32, given: &Arc<Definitions>, ranks: Option<u32>) -> Result<MeshOf, Failure> {
    let make = |refine: u32| {
        let source = open(recipe, given, ranks)
            .map_err(|e| Failure::input(format_args!("error: cannot read the recipe {}: {e}", recipe.display())))?;
        mesher::make_with_warnings(source, refine as usize).map_err(|mistakes| Failure::input(render(&mistakes)))
    };
    let (mut mesh, found) = make(refine)?;
    if refine > 1 && !mesh.node_sets.is_empty() {
        mesh.share_out_as(&make(1)?.0);
    }
    if !found.is_empty() {
        complain(render(&found));
    }
    Ok((mesh, found.source().files().into_iter().map(PathBuf::from).collect()))
}

/// The mesh as named, or `x.g` beside the deck, or in `meshes/` beside the deck's folder, or its recipe there.
fn mesh_path(deck: &Path, named: Option<&Path>) -> Result<PathBuf, Failure> {
    if let Some(path) = named {
        return Ok(path.to_path_buf());
    }
    let beside = deck.with_extension("g");
    let folder = deck.parent().unwrap_or(Path::new(""));
    let shelf = match (folder.file_name(), folder.parent()) {
        (Some(_), Some(parent)) => parent.join("meshes"),
        _ => folder.join("..").join("meshes"),
    };
    let shelved = beside.file_name().map(|name| shelf.join(name)).unwrap_or_default();
    let places = [beside.clone(), shelved.clone(), beside.with_extension("mesh"), shelved.with_extension("mesh")];
    places.into_iter().find(|path| path.is_file()).ok_or_else(|| {
        Failure::input(format_args!(
            "error: no mesh for {}: neither {} nor {} exists, and no recipe with suffix .mesh either\n\
             help: name it with --mesh, or make one with urto mesh",
            deck.display(),
            beside.display(),
            shelved.display()
        ))
    })
}
