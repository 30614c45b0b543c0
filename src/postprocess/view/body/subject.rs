//! What is drawn: a results file's body at a state, coloured by a variable.

mod readings;

use std::path::{Path, PathBuf};

use super::bars::add_tubes;
use super::choice::{choose_arrows, choose_criteria, choose_field, is_shown, mesh_alone, shown_elements};
use super::field::{Field, Names, Place};
use super::quarters::quarter;
use super::revolve::{Turn, revolve};
use super::scene::Scene;
use super::section::{Between, Cutting, Plane};
use super::selection::{self, Criterion};
use super::thickness::{Added, thicken};
use crate::common::vector::{dot, subtract};
use crate::exodus::Results;
use crate::mesh::exterior::{SIDES, exterior};
use crate::mesh::{Block, Dimension, Mesh, Shape};
use crate::postprocess::depiction::{Depiction, RigidPlane};
use crate::postprocess::view::ViewError;
use crate::postprocess::view::camera::{Axes, Bounds};
use crate::postprocess::view::options::{Direction, StateChoice, ViewOptions};

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
/// Radius of bars of which nothing is told, as a part of the size of the mesh.
const THINNEST: f64 = 0.004;

/// A results file opened to be drawn.
pub struct Subject<'a> {
    path: PathBuf,
    options: &'a ViewOptions,
    results: Results,
    mesh: Mesh,
    /// The variable that colours the picture; `None` colours by block.
    pub field: Option<Field>,
    displacement: Option<Vec<String>>,
    /// The vector drawn as arrows, by its components.
    arrows: Option<Vec<String>>,
    /// Positions, in the whole mesh, of the elements of the blocks shown.
    elements: Vec<usize>,
    /// What values of elements must be for them to be drawn.
    criteria: Vec<Criterion>,
    /// The surface of the blocks shown, if it is the same in all states.
    skin: Option<Vec<Face>>,
    /// What the results tell of the deck.
    told: Depiction,
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
        let arrows = choose_arrows(path, options, &names)?;
        let criteria = choose_criteria(path, options, &names)?;
        let mesh = results.mesh()?;
        let elements = shown_elements(path, &mesh, options)?;
        let (path, skin) = (path.to_owned(), None);
        let told = Depiction::read(&results.info());
        let mut subject =
            Subject { path, options, field, displacement, arrows, elements, criteria, skin, told, results, mesh };
        subject.sizes_are_known()?;
        if !subject.mortal() && !subject.selects() {
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
        let blocks = self.mesh.blocks.iter().enumerate().filter(|(_, block)| is_shown(self.options, block.id));
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
    /// When values cannot be read, or nothing is left to be seen. Where only a part of the body is asked for, there may be
    /// nothing of it in one of many states.
    pub fn shot(&self, state: Option<usize>) -> Result<Shot, ViewError> {
        let drawn = if self.skin.is_none() { Some(self.drawn(state)?) } else { None };
        let elements = drawn.as_deref().unwrap_or(&self.elements);
        let skin = match &self.skin {
            Some(skin) => skin.clone(),
            None => self.surface_of(elements),
        };
        let (mut scene, mut dropped) = (None::<Scene>, 0);
        for Image { planes, flips } in self.images() {
            let mut cut = self.cut(&planes, self.bodies(&skin, elements, state)?, elements);
            if state.is_some() && self.field.as_ref().is_some_and(Field::is_status) {
                quarter(&mut cut);
            }
            let Cut { positions, skin, made, seams } = cut;
            let quads = skin.iter().map(|face| face.nodes).collect();
            let values = self.values(&skin, &made, state)?;
            let mut copy = Scene { positions, quads, values, seams, vectors: self.vectors(&made, state)? };
            if let (true, Some(angle)) = (self.turned(), self.options.revolve) {
                copy = self.revolved(&copy, elements, angle, state)?;
            }
            dropped += copy.drop_unusable_faces();
            flips.iter().for_each(|&(axis, place)| copy.reflect(axis, place, self.is_odd(axis)));
            match (&mut scene, flips.last()) {
                (Some(scene), Some(&(axis, place))) => scene.join(copy, axis, place),
                _ => scene = Some(copy),
            }
        }
        let mut scene = scene.ok_or_else(|| self.nothing("no element is left"))?;
        if scene.quads.is_empty() && !self.selects() {
            return Err(self.nothing(match dropped {
                0 if !self.options.cuts.is_empty() => "the cut has taken off all of it",
                0 => "no element is left",
                _ => "no face has finite coordinates",
            }));
        }
        for (axis, place) in self.mirrors().filter(|(axis, _)| !self.cuts_across(*axis)) {
            scene.mirror(axis, place, self.is_odd(axis));
        }
        Ok(Shot { scene, dropped })
    }

    /// That nothing is to be seen, and why.
    pub fn nothing(&self, reason: &'static str) -> ViewError {
        ViewError::Nothing { path: self.path.clone(), reason }
    }

    /// Where the eye is: straight above a plane, unless another direction is asked for.
    pub fn from(&self) -> Direction {
        let flat = self.mesh.dimension == Dimension::Two && self.options.revolve.is_none();
        let top = Direction { azimuth: -90.0, elevation: 90.0 };
        if flat && self.options.from == Direction::ISOMETRIC { top } else { self.options.from }
    }

    /// Whether a section is turned about its axis.
    pub fn turned(&self) -> bool {
        self.mesh.dimension == Dimension::Two && self.options.revolve.is_some()
    }

    /// A section turned about its axis, open towards the eye.
    fn revolved(
        &self,
        section: &Scene,
        elements: &[usize],
        angle: f64,
        state: Option<usize>,
    ) -> Result<Scene, ViewError> {
        let rim = self.outside_of(elements);
        let edges: Vec<[u32; 4]> = rim.iter().map(|face| face.nodes).collect();
        let values = self.values(&rim, &[], state)?;
        Ok(revolve(section, &edges, &values, Turn::open_to(self.options.from.azimuth, angle)))
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

    /// Whether only a part of the body is asked for, by its place or its values.
    pub fn selects(&self) -> bool {
        !self.criteria.is_empty() || self.options.region.iter().any(Option::is_some)
    }

    /// The elements that are drawn in a state.
    fn drawn(&self, state: Option<usize>) -> Result<Vec<usize>, ViewError> {
        let mut elements = match state {
            Some(state) if self.mortal() => self.alive(state)?,
            _ => self.elements.clone(),
        };
        if !self.selects() {
            return Ok(elements);
        }
        let all: Vec<&[u32]> = self.mesh.elements().map(|(_, nodes)| nodes).collect();
        if self.options.region.iter().any(Option::is_some) {
            selection::in_region(&mut elements, &all, &self.positions(state)?, &self.options.region);
        }
        for criterion in &self.criteria {
            let state = state.ok_or_else(|| selection::needs_a_state(criterion))?;
            selection::by_value(&mut elements, &all, &self.values_of(&criterion.field, state)?, criterion);
        }
        Ok(elements)
    }

    fn alive(&self, state: usize) -> Result<Vec<usize>, ViewError> {
        let Some((name, gone)) = self.fate() else { return Ok(self.elements.clone()) };
        let values = self.read(Place::Elements, name, state)?;
        // A block that does not have the variable has NaN, and lives.
        Ok(self.elements.iter().copied().filter(|&element| values[element] != gone).collect())
    }

    /// Whether a reflection across an axis changes the sign of the values.
    fn is_odd(&self, axis: usize) -> bool {
        self.field.as_ref().is_some_and(|field| field.odd[axis])
    }

    /// Axes with a mirror plane, and where that is.
    fn mirrors(&self) -> impl Iterator<Item = (usize, f64)> {
        self.options.mirror.iter().enumerate().filter_map(|(axis, place)| Some((axis, (*place)?)))
    }

    fn cuts_across(&self, axis: usize) -> bool {
        self.options.cuts.iter().any(|(cut, _)| *cut == axis)
    }

    /// The body and its images across the axes that have a cut too: the plane goes through each at another place.
    fn images(&self) -> Vec<Image> {
        let mut images = vec![Image { planes: self.planes(), flips: Vec::new() }];
        for (axis, place) in self.mirrors().filter(|(axis, _)| self.cuts_across(*axis)) {
            let turned = |image: &Image| Image {
                planes: image.planes.iter().map(|plane| plane.reflected(axis, place)).collect(),
                flips: [&image.flips[..], &[(axis, place)]].concat(),
            };
            let more: Vec<Image> = images.iter().map(turned).collect();
            images.extend(more);
        }
        images
    }

    /// The planes asked for; what is on the eye's side of each goes.
    fn planes(&self) -> Vec<Plane> {
        let toward = Axes::new(self.from()).toward;
        let plane = |&(axis, at): &(usize, f64)| Plane { axis, at, below: toward[axis] >= 0.0 };
        self.options.cuts.iter().map(plane).collect()
    }

    /// The surface cut open, if that is asked for: what stands between a plane and the eye is taken off.
    fn cut(&self, planes: &[Plane], bodies: Added, elements: &[usize]) -> Cut {
        let Added { positions, skin, mut made, mut seams, solids } = bodies;
        seams.sort_unstable();
        if planes.is_empty() {
            return Cut { positions, skin, made, seams };
        }
        let all: Vec<&[u32]> = self.mesh.elements().map(|(_, nodes)| nodes).collect();
        // Only solids have an inside.
        let solid = |&element: &usize| Some((element, <&[u32; 8]>::try_from(all[element]).ok()?));
        let mut elements: Vec<(usize, &[u32; 8])> = elements.iter().filter_map(solid).collect();
        elements.extend(solids.iter().map(|(element, nodes)| (*element, nodes)));
        let mut cutting = Cutting::new(positions, &skin);
        cutting.cut(planes, &elements);
        let skin = cutting.faces();
        made.append(&mut cutting.made);
        seams.append(&mut cutting.seams);
        seams.sort_unstable();
        Cut { positions: cutting.positions, skin, made, seams }
    }

    /// The surface in space: bars with a tube around them, shells as thick as they are where that is asked for.
    fn bodies(&self, skin: &[Face], elements: &[usize], state: Option<usize>) -> Result<Added, ViewError> {
        let mut added = Added { positions: self.positions(state)?, skin: skin.to_vec(), ..Added::default() };
        let shapes: Vec<Shape> = self.mesh.blocks.iter().map(|block| block.shape).collect();
        if shapes.contains(&Shape::Bar) {
            let least = THINNEST * self.size();
            let radius = |block: usize| self.told.size(self.mesh.blocks[block].id).unwrap_or(least);
            let bars: Vec<(usize, [u32; 2], f64)> = self.of_shape(Shape::Bar, elements, radius).collect();
            add_tubes(&mut added, &bars);
        }
        if self.options.thickness && shapes.iter().any(|shape| shape.is_surface()) {
            let now = match (state, self.thickness_name()) {
                (Some(state), Some(name)) => self.read(Place::Elements, name, state)?,
                _ => Vec::new(),
            };
            let of_block = |block: usize| self.told.size(self.mesh.blocks[block].id).unwrap_or(0.0);
            let shells: Vec<(usize, [u32; 4], f64)> = self.surfaces(elements, of_block).collect();
            let is_shell: std::collections::HashSet<usize> = shells.iter().map(|shell| shell.0).collect();
            added.skin.retain(|face| !is_shell.contains(&face.element));
            let thick = |(element, nodes, told): (usize, [u32; 4], f64)| {
                let now = now.get(element).copied().filter(|now| now.is_finite() && *now > 0.0);
                (element, nodes, now.unwrap_or(told))
            };
            thicken(&mut added, shells.into_iter().map(thick).collect());
        }
        Ok(added)
    }

    /// Elements of a shape among some, with their nodes and what their block says.
    fn of_shape<const N: usize>(
        &self,
        shape: Shape,
        elements: &[usize],
        of_block: impl Fn(usize) -> f64,
    ) -> impl Iterator<Item = (usize, [u32; N], f64)> {
        let all: Vec<(usize, &[u32])> = self.mesh.elements().collect();
        let one = move |&element: &usize| {
            let (block, nodes) = all[element];
            let is_one = self.mesh.blocks[block].shape == shape;
            let nodes = is_one.then(|| <[u32; N]>::try_from(nodes).ok()).flatten()?;
            Some((element, nodes, of_block(block)))
        };
        elements.iter().filter_map(one)
    }

    /// Surface elements among some, with the nodes of their tops and what their block says.
    fn surfaces(
        &self,
        elements: &[usize],
        of_block: impl Fn(usize) -> f64,
    ) -> impl Iterator<Item = (usize, [u32; 4], f64)> {
        let all: Vec<(usize, &[u32])> = self.mesh.elements().collect();
        let one = move |&element: &usize| {
            let (block, nodes) = all[element];
            let shape = self.mesh.blocks[block].shape;
            let top = shape.is_surface().then(|| shape.face(nodes, 0)).flatten()?;
            Some((element, top, of_block(block)))
        };
        elements.iter().filter_map(one)
    }

    /// The variable that tells how thick shells are.
    fn thickness_name(&self) -> Option<&str> {
        let mut names = self.results.element_names().iter();
        names.find(|name| name.eq_ignore_ascii_case("THICKNESS")).map(String::as_str)
    }

    /// Whether shells that are to be thick have a thickness.
    fn sizes_are_known(&self) -> Result<(), ViewError> {
        let mut shells = self.mesh.blocks.iter().filter(|block| block.shape.is_surface());
        let known = |block: &Block| self.told.size(block.id).is_some() || self.thickness_name().is_some();
        match shells.find(|block| !known(block)).filter(|_| self.options.thickness) {
            None => Ok(()),
            Some(block) => Err(ViewError::option(
                "thickness of shells",
                format!("asked for, but nothing tells that of block {}", block.id),
                "results of urto, or an element variable THICKNESS",
            )),
        }
    }

    /// Diagonal of the box around the mesh.
    fn size(&self) -> f64 {
        let mut around = Bounds::EMPTY;
        self.mesh.coordinates.iter().for_each(|x| around.include(*x));
        let corners = around.corners();
        let diagonal = subtract(corners[7], corners[0]);
        dot(diagonal, diagonal).sqrt()
    }

    /// The rigid planes that are to be drawn, and their reflections.
    pub fn planes_told(&self) -> Vec<RigidPlane> {
        // A line that is turned about the axis is no plane, unless it is across the axis.
        let stays = |plane: &&RigidPlane| self.options.revolve.is_none() || plane.normal[1].abs() == 1.0;
        let mut planes: Vec<RigidPlane> =
            self.told.planes.iter().filter(stays).filter(|_| self.options.planes).copied().collect();
        for (axis, place) in self.mirrors() {
            let mut images = planes.clone();
            images.retain(|plane| plane.normal[axis] != 0.0);
            for image in &mut images {
                image.point[axis] = 2.0 * place - image.point[axis];
                image.normal[axis] = -image.normal[axis];
            }
            planes.extend(images);
        }
        planes
    }

    /// The surface of some elements; in the plane the elements themselves.
    fn surface_of(&self, elements: &[usize]) -> Vec<Face> {
        if self.mesh.dimension == Dimension::Three {
            return self.outside_of(elements);
        }
        let all: Vec<&[u32]> = self.mesh.elements().map(|(_, nodes)| nodes).collect();
        let face = |&element: &usize| Some(Face { element, nodes: all[element].try_into().ok()? });
        elements.iter().filter_map(face).collect()
    }

    /// The outside of some elements.
    fn outside_of(&self, elements: &[usize]) -> Vec<Face> {
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
}

/// The body seen in some mirrors, and the planes that it is cut by before it is.
struct Image {
    planes: Vec<Plane>,
    /// Axes and places of the mirrors.
    flips: Vec<(usize, f64)>,
}

/// A surface that may have been cut.
pub(super) struct Cut {
    pub(super) positions: Vec<[f64; 3]>,
    pub(super) skin: Vec<Face>,
    pub(super) made: Vec<Between>,
    pub(super) seams: Vec<[u32; 2]>,
}
