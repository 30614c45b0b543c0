//! What is drawn of a file, as far as options and its variables and blocks decide it.

use std::path::Path;

use super::field::{Field, Names};
use super::selection::Criterion;
use crate::mesh::Mesh;
use crate::postprocess::view::ViewError;
use crate::postprocess::view::options::{StateChoice, ViewOptions};

/// The word that asks for colours by block.
const NO_VARIABLE: &str = "none";

/// The mesh is drawn by itself: asked for, or all that a file without states has to show.
pub fn mesh_alone(options: &ViewOptions, times: &[f64]) -> bool {
    let nothing_else = times.is_empty() && options.state == StateChoice::Last && options.variable.is_none();
    options.state == StateChoice::Mesh || nothing_else
}

/// The variable that colours the picture; `None` colours by block.
///
/// # Errors
/// When the file does not have the one asked for.
pub fn choose_field(path: &Path, options: &ViewOptions, names: &Names) -> Result<Option<Field>, ViewError> {
    let Some(name) = &options.variable else { return Ok(names.customary()) };
    match names.find(name) {
        Some(field) => Ok(Some(field)),
        None if name.eq_ignore_ascii_case(NO_VARIABLE) => Ok(None),
        None => Err(no_variable(path, name, names)),
    }
}

/// The variables that decide which elements are drawn.
///
/// # Errors
/// When the file lacks one.
pub fn choose_criteria(path: &Path, options: &ViewOptions, names: &Names) -> Result<Vec<Criterion>, ViewError> {
    let criterion = |(name, range): &(String, (f64, f64))| match names.find(name) {
        Some(field) => Ok(Criterion { field, range: *range }),
        None => Err(no_variable(path, name, names)),
    };
    options.criteria.iter().map(criterion).collect()
}

fn no_variable(path: &Path, name: &str, names: &Names) -> ViewError {
    let (path, near) = (path.to_owned(), names.nearest(name));
    ViewError::NoVariable { path, name: name.to_owned(), near, known: names.known() }
}

/// The components of the vector that is drawn as arrows, if one is.
///
/// # Errors
/// When the file has no such vector at its nodes.
pub fn choose_arrows(path: &Path, options: &ViewOptions, names: &Names) -> Result<Option<Vec<String>>, ViewError> {
    let Some(name) = &options.arrows else { return Ok(None) };
    let vectors = Names { nodal: names.nodal, element: &[] };
    match vectors.find(name).filter(|field| field.names.len() > 1) {
        Some(field) => Ok(Some(field.names)),
        None => {
            let known = vectors.known().into_iter().filter(|n| vectors.find(n).is_some_and(|f| f.names.len() > 1));
            let (path, near, known) = (path.to_owned(), vectors.nearest(name), known.collect());
            Err(ViewError::NoVariable { path, name: name.clone(), near, known })
        }
    }
}

/// Whether the block with this number is drawn.
pub fn is_shown(options: &ViewOptions, id: i64) -> bool {
    (options.blocks.is_empty() || options.blocks.contains(&id)) && !options.hide.contains(&id)
}

/// Positions in the mesh of the elements of all blocks that are drawn.
///
/// # Errors
/// When there is no such block.
pub fn shown_elements(path: &Path, mesh: &Mesh, options: &ViewOptions) -> Result<Vec<usize>, ViewError> {
    let mut named = options.blocks.iter().chain(&options.hide);
    if let Some(&id) = named.find(|&&id| mesh.block_index(id).is_none()) {
        let known = mesh.blocks.iter().map(|block| block.id.to_string()).collect();
        return Err(ViewError::NoBlock { path: path.to_owned(), id, known });
    }
    let shown = |block: usize| is_shown(options, mesh.blocks[block].id);
    Ok(mesh.elements().enumerate().filter(|(_, (block, _))| shown(*block)).map(|(element, _)| element).collect())
}
