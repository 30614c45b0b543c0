//! Fields of the plot file: their names, and their values on one rank.

use super::nodal::NodalValues;
use super::plane;
use crate::comm::Communicator;
use crate::mesh::{Dimension, Shape};
use crate::model::{ElementField, Model, NodalField};
use crate::solver::elements::fields::{field_values, point_state, point_values, state_values};
use crate::solver::elements::{ElementBlock, Group};
use crate::solver::nodes::Nodes;
use crate::solver::{Solver, Totals};

/// Global variables of the plot file with their meaning.
pub const GLOBAL_VARIABLES: [(&str, &str); 17] = [
    (
        "KE",
        "kinetic energy, m v v / 2 with the velocities before and after the state; below zero where these are opposed",
    ),
    ("IE", "internal energy since the start: work of stresses, without INITIAL ENERGY of materials"),
    ("HGE", "hourglass energy"),
    ("BVE", "energy dissipated by bulk viscosity"),
    ("FRICE", "energy dissipated by friction"),
    ("DEADE", "energy of eroded elements"),
    ("EXTW", "work of loads and prescribed motions"),
    ("CONTE", "work of normal contact forces; negative where impacts took energy out"),
    ("CONTGAIN", "energy that contact has made: given beyond what it had taken before; an error"),
    ("EBAL", "energy accounted for minus energy supplied, with what was made out of nothing, over the largest account"),
    ("XMOM", "momentum in x"),
    ("YMOM", "momentum in y"),
    ("ZMOM", "momentum in z"),
    ("NSTEPS", "steps taken"),
    ("TMSTEP", "time step"),
    ("ADDMASS", "mass that MASS SCALING has added; only with it"),
    ("ADDKE", "kinetic energy of what MASS SCALING has added; only with it"),
];

/// The last of them, which only models with MASS SCALING have.
const OF_ADDED_MASS: usize = 2;

/// Names of the global variables of a model's files.
pub fn global_names(model: &Model) -> impl Iterator<Item = &'static str> + use<> {
    let (dimension, count) = (model.analysis.dimension(), global_count(!model.mass_scalings.is_empty()));
    GLOBAL_VARIABLES[..count].iter().map(|(name, _)| *name).filter(move |name| plane::is_in(dimension, name))
}

/// How many global variables there are in three dimensions.
fn global_count(scaled: bool) -> usize {
    GLOBAL_VARIABLES.len() - if scaled { 0 } else { OF_ADDED_MASS }
}

/// Values of these variables at the present state.
pub fn global_values(solver: &Solver, totals: &Totals, dimension: Dimension) -> Vec<f64> {
    let [x, y, z] = totals.momentum;
    let all: [f64; GLOBAL_VARIABLES.len()] = [
        totals.kinetic,
        totals.internal,
        totals.hourglass,
        totals.bulk_viscosity,
        totals.friction,
        totals.eroded,
        totals.external,
        totals.contact,
        totals.contact_gain,
        totals.relative_error(solver.initial_energy),
        x,
        y,
        z,
        solver.step as f64,
        solver.time_step,
        solver.domain.mass_added.unwrap_or_default(),
        totals.added_kinetic,
    ];
    let named = GLOBAL_VARIABLES[..global_count(solver.domain.mass_added.is_some())].iter().zip(all);
    named.filter(|((name, _), _)| plane::is_in(dimension, name)).map(|(_, value)| value).collect()
}

/// The nodal and element variables of a run.
#[derive(Debug, Clone)]
pub struct FieldList {
    nodal: Vec<NodalField>,
    element: Vec<ElementField>,
    state: Vec<String>,
    dimension: Dimension,
    /// Whether there are elements in layers, whose values are listed at bottom, middle and top too.
    layered: bool,
}

/// What the names of values at the bottom, in the middle and at the top of layered elements end in.
const LAYERS: [&str; 3] = ["B", "M", "T"];

impl FieldList {
    /// What the model asks for.
    pub fn new(model: &Model, solver: &Solver) -> FieldList {
        let requests = &model.plot_requests;
        FieldList {
            nodal: requests.nodal.clone(),
            element: requests.element.clone(),
            state: requests.state.clone(),
            dimension: model.analysis.dimension(),
            layered: solver.domain.layered.contains(&true),
        }
    }

    /// Element variables and state variables.
    pub(super) fn of_element(
        element: Vec<ElementField>,
        state: Vec<String>,
        dimension: Dimension,
        layered: bool,
    ) -> FieldList {
        FieldList { nodal: Vec::new(), element, state, dimension, layered }
    }

    /// Those components, given by their names, that are in the files, and their places among all.
    fn shown(&self, components: &'static [&'static str]) -> impl Iterator<Item = (usize, &'static str)> + use<> {
        let dimension = self.dimension;
        components.iter().copied().enumerate().filter(move |(_, name)| plane::is_in(dimension, name))
    }

    /// Names of the nodal variables.
    pub fn nodal_names(&self) -> Vec<String> {
        self.nodal.iter().flat_map(|f| self.shown(f.components())).map(|(_, c)| c.to_string()).collect()
    }

    /// Names of the element variables.
    pub fn element_names(&self) -> Vec<String> {
        let fields = self.element.iter().flat_map(|f| self.shown(f.components())).map(|(_, c)| c.to_string());
        let mut names: Vec<String> = fields.chain(self.state.iter().cloned()).collect();
        for layer in LAYERS.iter().filter(|_| self.layered) {
            let fields = self.fields_of_points().flat_map(|f| f.components()).map(|c| c.to_string());
            names.extend(fields.chain(self.state.iter().cloned()).map(|name| format!("{name}_{layer}")));
        }
        names
    }

    fn fields_of_points(&self) -> impl Iterator<Item = ElementField> + '_ {
        self.element.iter().copied().filter(|field| field.of_points())
    }

    /// Nodal values of the owned nodes of a rank, variable by variable. All ranks call it.
    pub fn nodal_values(&self, solver: &mut Solver, comm: &mut dyn Communicator) -> Vec<f64> {
        self.prepare(solver, comm);
        let values = self.nodal(solver);
        (0..values.len()).flat_map(|variable| values.of(variable)).collect()
    }

    /// Lets ranks tell each other what nodal values are made of. All ranks call it.
    pub fn prepare(&self, solver: &mut Solver, comm: &mut dyn Communicator) {
        solver.refresh();
        if [NodalField::Contact, NodalField::Reaction].iter().any(|field| self.nodal.contains(field)) {
            solver.complete_contact(comm);
        }
    }

    /// Nodal values of a rank, to be asked for one variable after the other; see [`FieldList::prepare`].
    pub fn nodal<'a>(&self, solver: &'a Solver) -> NodalValues<'a> {
        let of_field = |field: &NodalField| {
            let field = *field;
            self.shown(field.components()).map(move |(component, _)| (field, component))
        };
        NodalValues::new(self.nodal.iter().flat_map(of_field).collect(), solver)
    }

    /// The element variables in a few lists of their own, in their order: together all values are much.
    pub fn element_parts(&self) -> Vec<FieldList> {
        // Those of layers come with what they are the layers of.
        if self.layered {
            return vec![self.clone()];
        }
        let part = |element, state| FieldList::of_element(element, state, self.dimension, false);
        let fields = self.element.iter().map(|&field| part(vec![field], Vec::new()));
        let state = (!self.state.is_empty()).then(|| part(Vec::new(), self.state.clone()));
        fields.chain(state).collect()
    }

    /// Element values of the elements of a rank in its canonical order, variable by variable.
    pub fn element_values(&self, solver: &Solver, rank: usize) -> Vec<f64> {
        let elements = solver.domain.element_file.len();
        let count = self.element_names().len();
        let mut values = vec![0.0; count * elements];
        let mut point = Vec::with_capacity(count);
        for block in &solver.domain.blocks {
            for group in block.groups() {
                for i in 0..group.len() {
                    if !group.is_alive(i) {
                        // All of it is zero, its STATUS too.
                        continue;
                    }
                    point.clear();
                    self.element_point(solver, block, group, i, rank, &mut point);
                    for (variable, value) in point.iter().enumerate() {
                        values[variable * elements + group.places[i] as usize] = *value;
                    }
                }
            }
        }
        values
    }

    /// All element variables of one element.
    pub(super) fn element_point(
        &self,
        solver: &Solver,
        block: &ElementBlock,
        group: &Group,
        i: usize,
        rank: usize,
        out: &mut Vec<f64>,
    ) {
        for field in &self.element {
            let values = match field {
                ElementField::Rotation if block.rigid => rigid_rotation(solver, block, group, i),
                _ => None,
            };
            let values = values.unwrap_or_else(|| field_values(*field, block, group, i, &solver.domain.nodes, rank));
            out.extend(self.shown(field.components()).map(|(place, _)| values[place]));
        }
        if !self.state.is_empty() {
            let state = state_values(block, group, i, &solver.domain.nodes);
            let names = block.law.entry().state;
            // A variable that a law does not have is zero in its blocks.
            let value = |name: &String| names.iter().position(|v| v.name == *name).map_or(0.0, |k| state[k]);
            out.extend(self.state.iter().map(value));
        }
        if self.layered {
            self.layers(block, group, i, &solver.domain.nodes, out);
        }
    }

    /// Values at the bottom, in the middle and at the top of an element; zeros of one without layers.
    fn layers(&self, block: &ElementBlock, group: &Group, i: usize, nodes: &Nodes, out: &mut Vec<f64>) {
        let Some(layers) = block.element.layers() else {
            return out.resize(self.element_names().len(), 0.0);
        };
        let names = block.law.entry().state;
        for [a, b] in layers {
            for field in self.fields_of_points() {
                let [a, b] = [a, b].map(|point| point_values(field, block, group, i, point, nodes));
                out.extend((0..field.components().len()).map(|c| 0.5 * (a[c] + b[c])));
            }
            let [a, b] = [a, b].map(|point| point_state(block, group, i, point, nodes));
            let value = |name: &String| names.iter().position(|v| v.name == *name).map_or(0.0, |k| 0.5 * (a[k] + b[k]));
            out.extend(self.state.iter().map(value));
        }
    }
}

/// Rotation of an element of a rigid block that has its frame from its own steps, which rigid blocks leave out: that of its body.
/// `None` of all others.
fn rigid_rotation(solver: &Solver, block: &ElementBlock, group: &Group, i: usize) -> Option<[f64; 9]> {
    let rigid = solver.domain.rigid.as_ref().filter(|_| block.element.entry().shape == Shape::Hexahedron)?;
    let body = rigid.of_node(group.node(i, 0))?;
    let [[a, b, c], [d, e, f], [g, h, i]] = rigid.bodies[body as usize].frame;
    Some([a, b, c, d, e, f, g, h, i])
}
