//! Storage of one element block on one rank: chunks of eight elements, each quantity a row of eight numbers.

use super::ahead::{FarNodes, far_nodes};
use super::pass::{Pass, PassOutcome, PassSettings, Sink};
use super::{Element, Probe};
use crate::comm::ExactSum;
use crate::common::memory::repeated;
use crate::lanes::{CHUNK, Force, Numbers, Row, SingleRow};
use crate::material::{END_POWER, Law};
use crate::model::Precision;
use crate::solver::domain::state_names;
use crate::solver::nodes::Nodes;
use std::borrow::Borrow;

/// The elements of one material on one rank.
pub struct ElementBlock {
    /// Index of the block in the mesh.
    pub index: usize,
    /// The block's number in the deck.
    pub id: i64,
    /// Mass density at the start.
    pub density: f64,
    /// Constitutive law.
    pub law: Law,
    /// What the elements are.
    pub element: Element,
    /// Names of the law's stored state variables, in row order.
    pub state_names: &'static [&'static str],
    /// Elements with a node that other ranks share; computed first, so that their forces travel while the rest works.
    pub border: Group,
    /// All others.
    pub interior: Group,
    /// Whether the stable step of each element is kept.
    pub keeps_steps: bool,
    /// Whether it is of a rigid body: its elements have no work to do.
    pub rigid: bool,
}

/// Some elements of a block in canonical order, in chunks. The last chunk is filled up with copies of its last
/// element, which are computed but never used.
#[derive(Default)]
pub struct Group {
    /// Place of each element in the rank's canonical order, ascending.
    pub places: Vec<u32>,
    /// Nodes per element.
    pub corners: usize,
    /// Nodes per element, and their rotations where the elements have any.
    pub unknowns: usize,
    /// Local nodes of eight elements, then their rotations: `unknowns` such rows per chunk.
    pub connectivity: Vec<[u32; CHUNK]>,
    /// Nodes that have to be asked for ahead, of each chunk; empty where the group is small.
    pub far: Vec<FarNodes>,
    /// Masses of the elements' material, one row per chunk.
    pub mass: Vec<Row>,
    /// The same with what MASS SCALING has added; empty where it has added nothing.
    pub moving: Vec<Row>,
    /// The least part of an even share of its mass that any node of an element has, one row per chunk; empty where no corners
    /// coincide: it is 1 there. See [`Formulation::least_share`](super::Formulation::least_share).
    pub least_share: Vec<Row>,
    /// What the elements store, `stride` rows per chunk: their own numbers, then those of their law. Empty where that is
    /// in single precision.
    pub state: Vec<Row>,
    /// The same in single precision, `stride` rows per two chunks; the number of chunks is even then.
    pub single: Vec<SingleRow>,
    /// Rows per chunk, or per two chunks.
    pub stride: usize,
    /// Which elements have been taken away; empty while none have.
    pub gone: Vec<bool>,
    /// The largest stable step of each element in the last pass, one row per chunk; empty unless somebody wants to know,
    /// and before the first pass.
    pub steps: Vec<Row>,
}

/// An element as a group takes it in.
pub struct NewElement {
    /// Place in the rank's canonical order.
    pub place: u32,
    /// Local nodes, and behind them their rotations if the element has any.
    pub nodes: Vec<u32>,
    /// Corner positions, lengths.
    pub corners: Vec<[f64; 3]>,
    /// Mass of the material.
    pub mass: f64,
    /// Mass that MASS SCALING has added to it.
    pub added: f64,
    /// Attributes in the mesh, if any.
    pub attributes: Vec<f64>,
}

impl Group {
    /// So many elements at rest, with so many corners and unknowns; `new` gives one after the other. `start` fills in the numbers that
    /// an element stores in this precision, of which there are `stride`, and gives its least share.
    pub fn new<E: Borrow<NewElement>>(
        (count, new): (usize, impl Fn(usize) -> E),
        [corners, unknowns]: [usize; 2],
        (precision, stride): (Precision, usize),
        start: impl Fn(&NewElement, &mut [f64]) -> f64,
    ) -> Group {
        let lanes = match precision {
            Precision::Double => CHUNK,
            Precision::Single => SingleRow::LANES,
        };
        let rows = count.div_ceil(lanes);
        let chunks = rows * lanes / CHUNK;
        let store = |of: Precision| if of == precision { rows * stride } else { 0 };
        let mut group = Group {
            places: Vec::with_capacity(count),
            corners,
            unknowns,
            connectivity: vec![[0; CHUNK]; chunks * unknowns],
            far: Vec::new(),
            mass: vec![Row::default(); chunks],
            moving: Vec::new(),
            least_share: Vec::new(),
            state: repeated(Row::default(), store(Precision::Double)),
            single: repeated(SingleRow::default(), store(Precision::Single)),
            stride,
            gone: Vec::new(),
            steps: Vec::new(),
        };
        let mut numbers = vec![0.0; stride];
        let mut added = Vec::new();
        for place in 0..count {
            let element = new(place);
            let element: &NewElement = element.borrow();
            group.places.push(element.place);
            numbers.fill(0.0);
            let least_share = start(element, &mut numbers);
            // The last one has copies in the lanes behind it.
            let end = if place + 1 == count { chunks * CHUNK } else { place + 1 };
            (place..end).for_each(|slot| group.set(slot, &element.nodes, element.mass, &numbers));
            if element.added > 0.0 {
                added.resize(chunks * CHUNK, 0.0);
                added[place..end].fill(element.added);
            }
            if least_share != 1.0 {
                group.least_share.resize(chunks, Row([1.0; CHUNK]));
                (place..end).for_each(|slot| group.least_share[slot / CHUNK].0[slot % CHUNK] = least_share);
            }
        }
        group.far = far_nodes(&group.connectivity, unknowns);
        if !added.is_empty() {
            group.moving = group.mass.clone();
            let lanes = group.moving.iter_mut().flat_map(|row| &mut row.0);
            lanes.zip(added).for_each(|(mass, added)| *mass += added);
        }
        group
    }

    /// Gives a lane nodes, mass and state.
    fn set(&mut self, slot: usize, nodes: &[u32], mass: f64, numbers: &[f64]) {
        let (chunk, lane) = (slot / CHUNK, slot % CHUNK);
        for (row, node) in self.connectivity[chunk * self.unknowns..].iter_mut().zip(&nodes[..self.unknowns]) {
            row[lane] = *node;
        }
        self.mass[chunk].0[lane] = mass;
        if let Some(moving) = self.moving.get_mut(chunk) {
            moving.0[lane] = mass;
        }
        if let Some(least_share) = self.least_share.get_mut(chunk) {
            least_share.0[lane] = 1.0;
        }
        for row in 0..self.stride {
            self.put(slot, row, numbers.get(row).copied().unwrap_or(0.0));
        }
    }

    /// The bits of a number that the `i`-th element stores in single precision.
    pub fn bits(&self, i: usize, row: usize) -> u32 {
        self.single[i / SingleRow::LANES * self.stride + row].0[i % SingleRow::LANES].to_bits()
    }

    /// Sets those of a lane.
    pub fn put_bits(&mut self, slot: usize, row: usize, bits: u32) {
        self.single[slot / SingleRow::LANES * self.stride + row].0[slot % SingleRow::LANES] = f32::from_bits(bits);
    }

    /// One stored number of a lane.
    fn number(&self, slot: usize, row: usize) -> f64 {
        match self.single.is_empty() {
            true => self.state[slot / CHUNK * self.stride + row].number(slot % CHUNK),
            false => self.single[slot / SingleRow::LANES * self.stride + row].number(slot % SingleRow::LANES),
        }
    }

    /// Sets one stored number of a lane.
    pub fn put(&mut self, slot: usize, row: usize, value: f64) {
        match self.single.is_empty() {
            true => self.state[slot / CHUNK * self.stride + row].set(slot % CHUNK, value),
            false => self.single[slot / SingleRow::LANES * self.stride + row].set(slot % SingleRow::LANES, value),
        }
    }

    /// Whether the `i`-th element is still there.
    pub fn is_alive(&self, i: usize) -> bool {
        self.gone.is_empty() || !self.gone[i]
    }

    /// Gives the lane of the `i`-th element to a stand-in, and with it the lanes that copy the last element.
    pub fn retire(&mut self, i: usize, stand_in: &[u32], mass: f64, numbers: &[f64]) {
        if self.gone.is_empty() {
            self.gone = vec![false; self.len()];
        }
        self.gone[i] = true;
        let lanes = self.mass.len() * CHUNK;
        let copies = if i + 1 == self.len() { self.len()..lanes } else { 0..0 };
        for slot in std::iter::once(i).chain(copies) {
            self.set(slot, stand_in, mass, numbers);
        }
    }

    /// Takes what elements that are gone have left out of `forces`, one for each corner in group order: the stand-in of a gas is under
    /// its initial pressure, and forces that are kept apart go to the nodes that the element had.
    pub fn forget_forces_of_gone(&self, forces: &mut [Force]) {
        let all = forces.chunks_exact_mut(self.unknowns.max(1)).zip(&self.gone);
        all.filter(|(_, gone)| **gone).for_each(|(own, _)| own.fill(Force::default()));
    }

    /// Number of elements.
    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// Number of corners of all elements, and of their rotations: of the forces that a pass gives.
    pub fn force_count(&self) -> usize {
        self.unknowns * self.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.places.is_empty()
    }

    /// One stored number of the `i`-th element.
    pub fn value(&self, i: usize, row: usize) -> f64 {
        self.number(i, row)
    }

    /// Sets one stored number of the `i`-th element, and of the lanes that copy the last one.
    pub fn set_value(&mut self, i: usize, row: usize, value: f64) {
        let end = if i + 1 == self.len() { self.mass.len() * CHUNK } else { i + 1 };
        for slot in i..end {
            self.put(slot, row, value);
        }
    }

    /// Several consecutive stored numbers of the `i`-th element.
    pub fn values<const N: usize>(&self, i: usize, first: usize) -> [f64; N] {
        std::array::from_fn(|k| self.value(i, first + k))
    }

    /// Local node at a corner of the `i`-th element; from [`Group::corners`] on, the rotations of these nodes.
    #[inline(always)]
    pub fn node(&self, i: usize, corner: usize) -> u32 {
        self.connectivity[i / CHUNK * self.unknowns + corner][i % CHUNK]
    }

    /// Local nodes of the `i`-th element, without rotations.
    pub fn nodes(&self, i: usize) -> impl ExactSizeIterator<Item = u32> + '_ {
        (0..self.corners).map(move |corner| self.node(i, corner))
    }

    /// The same as an array, if it has as many.
    pub fn all_nodes<const N: usize>(&self, i: usize) -> Option<[u32; N]> {
        (self.corners == N).then(|| std::array::from_fn(|corner| self.node(i, corner)))
    }

    /// Positions of the nodes of the `i`-th element, which has as many.
    #[inline]
    pub fn positions<const N: usize>(&self, i: usize, nodes: &Nodes) -> [[f64; 3]; N] {
        debug_assert!(N <= self.unknowns, "more nodes than an element has");
        let mut positions = [[0.0; 3]; N];
        for (position, numbers) in positions.iter_mut().zip(&self.connectivity[i / CHUNK * self.unknowns..]) {
            *position = nodes.position(numbers[i % CHUNK]);
        }
        positions
    }

    /// Positions in the mesh of the nodes of the `i`-th element, which has as many.
    pub fn initial_positions<const N: usize>(&self, i: usize, nodes: &Nodes) -> [[f64; 3]; N] {
        std::array::from_fn(|corner| nodes.initial(self.node(i, corner)))
    }

    /// Velocities of the nodes of the `i`-th element, which has as many.
    pub fn velocities<const N: usize>(&self, i: usize, nodes: &Nodes) -> [[f64; 3]; N] {
        std::array::from_fn(|corner| nodes.velocity(self.node(i, corner)))
    }

    /// The largest stable step of the `i`-th element in the last pass, if it was kept.
    pub fn stable_step(&self, i: usize) -> Option<f64> {
        self.steps.get(i / CHUNK).map(|row| row.0[i % CHUNK])
    }

    /// Mass of the material of the `i`-th element.
    pub fn element_mass(&self, i: usize) -> f64 {
        self.mass[i / CHUNK].0[i % CHUNK]
    }

    /// The same with what MASS SCALING has added to it.
    pub fn moving_mass(&self, i: usize) -> f64 {
        self.moving.get(i / CHUNK).map_or(self.element_mass(i), |row| row.0[i % CHUNK])
    }
}

impl ElementBlock {
    /// Both groups: border, then interior.
    pub fn groups(&self) -> [&Group; 2] {
        [&self.border, &self.interior]
    }

    /// A group of elements of this block's kind.
    pub fn group(element: &Element, law: &Law, density: f64, elements: &[NewElement]) -> Group {
        ElementBlock::group_of(element, law, density, (elements.len(), |place: usize| &elements[place]))
    }

    /// The same with so many elements that are made one after the other.
    pub fn group_of<E: Borrow<NewElement>>(
        element: &Element,
        law: &Law,
        density: f64,
        elements: (usize, impl Fn(usize) -> E),
    ) -> Group {
        let entry = element.entry();
        let (of_points, of_law) = (element.point_rows(), state_names(law).len());
        let of_points = [element.points(), of_points + of_law];
        let stride = entry.rows.len() + of_points[0] * of_points[1] + element.carried().len();
        Group::new(
            elements,
            [entry.shape.corners(), entry.unknowns()],
            (element.precision(), stride),
            |new, numbers| {
                let (own, points) = numbers.split_at_mut(entry.rows.len());
                let start = law.start(&element.start(new, density, own));
                // A law may store nothing, and an element with one point nothing of it.
                for point in points[..of_points[0] * of_points[1]].chunks_exact_mut(of_points[1].max(1)) {
                    point[element.point_rows()..].copy_from_slice(&start);
                }
                element.least_share(new)
            },
        )
    }

    /// Place among the stored numbers of the first that belongs to a point of integration.
    pub fn first_of_point(&self, point: usize) -> usize {
        self.element.entry().rows.len() + point * (self.element.point_rows() + self.state_names.len())
    }

    /// Place among the stored numbers of the first that is the law's at a point of integration.
    pub fn first_of_law(&self, point: usize) -> usize {
        self.first_of_point(point) + self.element.point_rows()
    }

    /// Whether a point of the `i`-th element carries nothing any more.
    pub fn is_lost(&self, group: &Group, i: usize, point: usize) -> bool {
        let entry = self.element.entry().points.as_ref();
        entry.is_some_and(|entry| group.value(i, self.first_of_point(point) + entry.lost) != 0.0)
    }

    /// Place among the stored numbers of the power of the last corner forces, in blocks that keep it.
    pub fn end_power(&self) -> Option<usize> {
        let last = self.state_names.len().checked_sub(1)?;
        (self.state_names[last] == END_POWER).then_some(self.first_of_law(0) + last)
    }

    /// Adds internal, hourglass and viscous energy of every element to these sums, as the balance of energy needs them: with an equation
    /// of state the work of the present forces was booked with half of the last step, and they will act with half of the kick,
    /// which is longer by `longer`. See `solids/exact.rs`.
    pub fn add_energies(&self, longer: f64, [internal, hourglass, viscous]: [&mut ExactSum; 3]) {
        let rows = &self.element.entry().energies;
        let end_power = self.end_power();
        for group in self.groups() {
            for i in 0..group.len() {
                internal.add(group.value(i, rows.internal));
                end_power.iter().for_each(|&row| internal.add(0.5 * longer * group.value(i, row)));
                rows.hourglass.iter().for_each(|&row| hourglass.add(group.value(i, row)));
                rows.viscous.iter().for_each(|&row| viscous.add(group.value(i, row)));
            }
        }
    }

    /// Lets one group answer a probe; nodes have displacements for velocities.
    pub fn probe(&mut self, probe: Probe, nodes: &[Row], sink: Sink, settings: &PassSettings) {
        let ElementBlock { element, law, density, border, interior, .. } = self;
        // The steps of the elements are not to be overwritten.
        let kept = [&mut *border, &mut *interior].map(|group| std::mem::take(&mut group.steps));
        let pass = Pass {
            border: &mut *border,
            interior: &mut *interior,
            nodes,
            rates: &[],
            sink,
            instructions: settings.instructions,
        };
        element.probe(probe, pass, (law, *density), settings);
        [border.steps, interior.steps] = kept;
    }

    /// Advances one group: the border elements when the sink keeps forces apart, else the interior. `rates` are those of
    /// [`Nodes`], which fluids ask for.
    pub fn run(&mut self, nodes: &[Row], rates: &[f64], sink: Sink, settings: &PassSettings) -> PassOutcome {
        let ElementBlock { element, law, density, border, interior, keeps_steps, rigid, .. } = self;
        if *rigid {
            return PassOutcome::NOTHING;
        }
        if *keeps_steps {
            let group = if matches!(sink, Sink::Apart(_)) { &mut *border } else { &mut *interior };
            group.steps.resize(group.mass.len(), Row::default());
        }
        let pass = Pass { border, interior, nodes, rates, sink, instructions: settings.instructions };
        element.run(pass, law, *density, settings)
    }
}
