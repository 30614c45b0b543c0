//! What is drawn: a results file's body at a state, coloured by a variable.

use std::path::{Path, PathBuf};

use super::ViewError;
use super::field::{Field, Names, Place};
use super::options::{StateChoice, ViewOptions};
use super::scene::{Scene, Values};
use crate::exodus::{Results, ResultsError};
use crate::mesh::exterior::{SIDES, exterior};
use crate::mesh::{Block, Mesh, Shape};
use crate::vector::dot;

/// A face of the outer surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Face {
    /// Position of its element in the mesh.
    pub element: usize,
    /// Its four nodes, counter-clockwise seen from outside; a triangle has a node twice.
    pub nodes: [u32; 4],
}

/// Element variables that tell which elements have gone, with the value that says so; these are not drawn.
const FATES: [(&str, f64); 2] = [("DEATH", 1.0), ("STATUS", 0.0)];
/// The word that asks for colours by block.
const NO_VARIABLE: &str = "none";

/// A results file opened to be drawn.
pub struct Subject<'a> {
    path: PathBuf,
    options: &'a ViewOptions,
    results: Results,
    mesh: Mesh,
    /// The variable that colours the picture; `None` colours by block.
    pub field: Option<Field>,
    displacement: Option<Vec<String>>,
    /// Positions, in the whole mesh, of the elements of the blocks shown.
    elements: Vec<usize>,
    /// The surface of the blocks shown, if elements cannot die.
    skin: Option<Vec<Face>>,
}

/// A scene and what it leaves out.
pub struct Shot {
    /// What is to be seen.
    pub scene: Scene,
    /// Number of faces that have no place in space.
    pub dropped: usize,
}

impl<'a> Subject<'a> {
    /// Reads the mesh and finds the variable.
    ///
    /// # Errors
    /// When the file cannot be read, or lacks the variable or block asked for.
    pub fn open(path: &Path, options: &'a ViewOptions) -> Result<Self, ViewError> {
        let results = Results::open(path)?;
        let names = Names { nodal: results.nodal_names(), element: results.element_names() };
        let field = if mesh_alone(options, results.times()) { None } else { choose_field(path, options, &names)? };
        let displacement = names.displacement();
        let mesh = results.mesh()?;
        let elements = shown_elements(path, &mesh, &options.blocks)?;
        let mut subject =
            Subject { path: path.to_owned(), options, field, displacement, elements, skin: None, results, mesh };
        if !subject.mortal() {
            subject.skin = Some(subject.surface_of(&subject.elements));
        }
        Ok(subject)
    }

    /// The file's title.
    pub fn title(&self) -> &str {
        self.mesh.title.trim()
    }

    /// The times of the states.
    pub fn times(&self) -> &[f64] {
        self.results.times()
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Positions and names of the blocks shown.
    pub fn blocks(&self) -> Vec<(usize, String)> {
        let shown = |id: i64| self.options.blocks.is_empty() || self.options.blocks.contains(&id);
        let blocks = self.mesh.blocks.iter().enumerate().filter(|(_, block)| shown(block.id));
        let name = |block: &Block| format!("block {} {}", block.id, block.name).trim_end().to_owned();
        blocks.map(|(position, block)| (position, name(block))).collect()
    }

    /// The zero-based state that a choice means; `None` means the mesh alone.
    ///
    /// # Errors
    /// When there is no such state.
    pub fn state(&self, choice: StateChoice) -> Result<Option<usize>, ViewError> {
        let times = self.times();
        if mesh_alone(self.options, times) {
            return Ok(None);
        }
        if times.is_empty() && choice != StateChoice::Mesh {
            return Err(ViewError::NoStates { path: self.path.clone() });
        }
        let distance = |state: &usize, time: f64| (times[*state] - time).abs();
        match choice {
            StateChoice::Mesh => Ok(None),
            StateChoice::Last => Ok(Some(times.len() - 1)),
            StateChoice::Number(number) if (1..=times.len()).contains(&number) => Ok(Some(number - 1)),
            StateChoice::Number(number) => {
                Err(ViewError::NoState { path: self.path.clone(), number, count: times.len() })
            }
            StateChoice::Nearest(time) => {
                Ok((0..times.len()).min_by(|a, b| distance(a, time).total_cmp(&distance(b, time))))
            }
        }
    }

    /// The body at a state.
    ///
    /// # Errors
    /// When values cannot be read, or nothing is left to be seen.
    pub fn shot(&self, state: Option<usize>) -> Result<Shot, ViewError> {
        let skin = match (&self.skin, state) {
            (Some(skin), _) => skin.clone(),
            (None, None) => self.surface_of(&self.elements),
            (None, Some(state)) => self.surface_of(&self.alive(state)?),
        };
        let quads = skin.iter().map(|face| face.nodes).collect();
        let mut scene = Scene { positions: self.positions(state)?, quads, values: self.values(&skin, state)? };
        let dropped = scene.drop_unusable_faces();
        if scene.quads.is_empty() {
            let reason = if dropped > 0 { "no face has finite coordinates" } else { "no element is left" };
            return Err(ViewError::Nothing { path: self.path.clone(), reason });
        }
        for axis in (0..3).filter(|&axis| self.options.mirror[axis]) {
            scene.mirror(axis, self.field.as_ref().is_some_and(|field| field.odd[axis]));
        }
        Ok(Shot { scene, dropped })
    }

    /// Elements can die.
    fn mortal(&self) -> bool {
        self.fate().is_some()
    }

    /// The variable that says which elements are gone, and its value for those that are.
    fn fate(&self) -> Option<(&'static str, f64)> {
        let names = self.results.element_names();
        FATES.into_iter().find(|(fate, _)| names.iter().any(|name| name.eq_ignore_ascii_case(fate)))
    }

    fn alive(&self, state: usize) -> Result<Vec<usize>, ViewError> {
        let Some((name, gone)) = self.fate() else { return Ok(self.elements.clone()) };
        let values = self.read(Place::Elements, name, state)?;
        // A block that does not have the variable has NaN, and lives.
        Ok(self.elements.iter().copied().filter(|&element| values[element] != gone).collect())
    }

    /// The surface of some elements.
    fn surface_of(&self, elements: &[usize]) -> Vec<Face> {
        let all: Vec<(Shape, &[u32])> = self.mesh.shaped().collect();
        let shown = elements.iter().map(|&element| all[element]);
        let numbers = exterior(shown, self.mesh.coordinates.len(), |_| true);
        let face = |number: u32| {
            let element = elements[number as usize / SIDES];
            let (shape, nodes) = all[element];
            Some(Face { element, nodes: shape.face(nodes, (number as usize % SIDES) as u8)? })
        };
        numbers.into_iter().filter_map(face).collect()
    }

    /// Node positions with the displacement, as many times as asked for.
    fn positions(&self, state: Option<usize>) -> Result<Vec<[f64; 3]>, ViewError> {
        let mut positions = self.mesh.coordinates.clone();
        if let (Some(names), Some(state)) = (&self.displacement, state) {
            for (axis, name) in names.iter().enumerate() {
                for (position, displacement) in positions.iter_mut().zip(self.read(Place::Nodes, name, state)?) {
                    position[axis] += self.options.magnify * displacement;
                }
            }
        }
        Ok(positions)
    }

    /// A variable's values in a state, as many as there are nodes or elements.
    fn read(&self, place: Place, name: &str, state: usize) -> Result<Vec<f64>, ViewError> {
        let (values, expected) = match place {
            Place::Nodes => (self.results.nodal(name, state)?, self.mesh.coordinates.len()),
            Place::Elements => (self.results.element(name, state)?, self.mesh.element_count()),
        };
        if values.len() == expected {
            return Ok(values);
        }
        let what = format!("{name} has {} values where {expected} belong", values.len());
        Err(ResultsError::Unusable { path: self.path.clone(), what }.into())
    }

    fn values(&self, skin: &[Face], state: Option<usize>) -> Result<Values, ViewError> {
        let (Some(field), Some(state)) = (&self.field, state) else {
            let block_of: Vec<usize> = self.mesh.elements().map(|(block, _)| block).collect();
            return Ok(Values::Blocks(skin.iter().map(|face| block_of[face.element]).collect()));
        };
        let read = |name: &String| self.read(field.place, name, state);
        let components = field.names.iter().map(read).collect::<Result<Vec<_>, _>>()?;
        let values = match components.as_slice() {
            [x, y, z] => (0..x.len()).map(|i| dot([x[i], y[i], z[i]], [x[i], y[i], z[i]]).sqrt()).collect(),
            _ => components.into_iter().next().unwrap_or_default(),
        };
        Ok(match field.place {
            Place::Nodes => Values::Nodes(values),
            Place::Elements => Values::Faces(skin.iter().map(|face| values[face.element]).collect()),
        })
    }
}

/// The mesh is drawn by itself: asked for, or all that a file without states has to show.
fn mesh_alone(options: &ViewOptions, times: &[f64]) -> bool {
    let nothing_else = times.is_empty() && options.state == StateChoice::Last && options.variable.is_none();
    options.state == StateChoice::Mesh || nothing_else
}

fn choose_field(path: &Path, options: &ViewOptions, names: &Names) -> Result<Option<Field>, ViewError> {
    let Some(name) = &options.variable else { return Ok(names.customary()) };
    match names.find(name) {
        Some(field) => Ok(Some(field)),
        None if name.eq_ignore_ascii_case(NO_VARIABLE) => Ok(None),
        None => {
            let (path, near) = (path.to_owned(), names.nearest(name));
            Err(ViewError::NoVariable { path, name: name.clone(), near, known: names.known() })
        }
    }
}

fn shown_elements(path: &Path, mesh: &Mesh, blocks: &[i64]) -> Result<Vec<usize>, ViewError> {
    if let Some(&id) = blocks.iter().find(|&&id| mesh.block_index(id).is_none()) {
        let known = mesh.blocks.iter().map(|block| block.id.to_string()).collect();
        return Err(ViewError::NoBlock { path: path.to_owned(), id, known });
    }
    let shown = |block: usize| blocks.is_empty() || blocks.contains(&mesh.blocks[block].id);
    Ok(mesh.elements().enumerate().filter(|(_, (block, _))| shown(*block)).map(|(element, _)| element).collect())
}
