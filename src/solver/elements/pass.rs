//! One pass over the elements of a block, compiled for every kind of element, law and instruction set.

use super::ahead::Ahead;
use super::block::Group;
use crate::lanes::{
    CHUNK, Corner, CornerForces, DoubleLanes, Force, InstructionSet, Lanes, MOST_CORNERS, MOST_LANES, Numbers, Row,
    Vectors, Widths, array,
};
use crate::model::{BulkViscosity, StepModuli};

/// Where corner forces go.
pub enum Sink<'a> {
    /// Kept apart, one per corner in group order: they will be summed with those of other ranks.
    Apart(&'a mut [Force]),
    /// Subtracted from the nodes, element by element in canonical order; the border elements, whose forces were
    /// kept apart, take their turn in between.
    Nodes {
        /// Force sums of the nodes.
        forces: &'a mut [Force],
        /// Forces of the border group, one per corner.
        border: &'a [Force],
    },
}

/// What a pass found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PassOutcome {
    /// Smallest step that an element asks for, infinite when there are no elements.
    pub stable_step: f64,
    /// Place of the element that sets it.
    pub controlling: Option<u32>,
    /// Smallest [`Outcome::motion_step`]; the stable step is no larger.
    pub motion_step: f64,
    /// Place of the first element without a positive volume or a finite motion.
    pub failed: Option<u32>,
}

impl PassOutcome {
    /// Of no elements.
    pub const NOTHING: PassOutcome =
        PassOutcome { stable_step: f64::INFINITY, controlling: None, motion_step: f64::INFINITY, failed: None };

    /// Of both: the smaller step, ties to the earlier place.
    pub fn and(self, other: PassOutcome) -> PassOutcome {
        let first = |a: Option<u32>, b: Option<u32>| a.into_iter().chain(b).min();
        let (stable_step, controlling) = if self.stable_step < other.stable_step {
            (self.stable_step, self.controlling)
        } else if other.stable_step < self.stable_step {
            (other.stable_step, other.controlling)
        } else {
            (self.stable_step, first(self.controlling, other.controlling))
        };
        let motion_step = self.motion_step.min(other.motion_step);
        PassOutcome { stable_step, controlling, motion_step, failed: first(self.failed, other.failed) }
    }
}

/// What a pass needs beside the block.
#[derive(Debug, Clone, Copy)]
pub struct PassSettings {
    /// Time of the present positions.
    pub time: f64,
    /// Time step that led to them.
    pub time_step: f64,
    /// Mean of that step and the one before it: what velocities were changed with before it.
    pub kick: f64,
    /// Bulk viscosity.
    pub bulk_viscosity: BulkViscosity,
    /// Moduli of the stable step.
    pub moduli: StepModuli,
    /// Instruction set.
    pub instructions: InstructionSet,
}

/// One step of one kind of element, from the motion of N corners to their forces. Implementations are compiled into the loop
/// over elements, once for each instruction set.
pub trait StepKernel<const N: usize> {
    /// How many of the N, the last ones, are rotations: their rates are given as they are, and moments belong to them.
    const ROTATIONS: usize = 0;

    /// Whether the forces of an element add up to nothing, so that rounding may be made good.
    const BALANCED: bool = true;

    /// Whether it asks for the rates of its neighbours: see [`Given::rates`].
    const NEIGHBOURS: bool = false;

    /// Whether [`Outcome::motion_step`] may be smaller than the stable step.
    const MOVES_FAR: bool = false;

    /// How often it [pauses](Ahead::pause) in a step: kernels that take long, so that what comes next is asked for evenly.
    const PAUSES: usize = 0;

    /// Whether x is the distance from an axis: positions and velocities along x are then those in space.
    #[inline(always)]
    fn about_axis(&self) -> bool {
        false
    }

    /// One step of the elements of one part of a chunk: from corner positions and mid-step velocities by direction and corner,
    /// both relative to the first corner. Advances the rows of `state`. `ahead` is for its [pauses](StepKernel::PAUSES).
    fn step<V: Lanes>(
        &self,
        positions: &[[V; N]; 3],
        velocities: &[[V; N]; 3],
        state: &mut [V::Row],
        part: usize,
        given: Given<V, N>,
        ahead: &mut Ahead<V::Row>,
    ) -> Outcome<V, N>;
}

/// What the elements of one part of a chunk are given beside their motion.
#[derive(Debug, Clone, Copy)]
pub struct Given<V, const N: usize> {
    /// Mass of the material: over its density, the volume at the start.
    pub material: V,
    /// What the corners have to move: the same, and what MASS SCALING has added.
    pub moving: V,
    /// The least part of an even share of its mass that any node of the element has: see [`Group::least_share`].
    pub least_share: V,
    /// At each corner the mean of the [`Outcome::rate`] that its elements had in the last pass; zeros unless
    /// [`StepKernel::NEIGHBOURS`].
    pub rates: [V; N],
}

/// What a part of a chunk hands back.
pub struct Outcome<V, const N: usize> {
    /// Internal forces on the corners, `[direction][corner]`, to be subtracted from the nodes.
    pub force: [[V; N]; 3],
    /// Largest stable time step; not positive, or no number, of an element that has failed.
    pub stable_step: V,
    /// Largest step in which the shape changes by no more than it may, of kernels that [move far](StepKernel::MOVES_FAR).
    /// It is no matter of frequencies: neighbours do not make it longer.
    pub motion_step: V,
    /// Rate at which the volume grows, over it, of elements whose neighbours ask; else zero.
    pub rate: V,
}

/// A pass over one group of a block: its border elements when the sink keeps forces apart, else its interior.
pub struct Pass<'a> {
    /// Border elements.
    pub border: &'a mut Group,
    /// All others.
    pub interior: &'a mut Group,
    /// Nodes.
    pub nodes: &'a [Row],
    /// Mean rates of the elements at each node, empty where no element asks: see [`Given::rates`].
    pub rates: &'a [f64],
    /// Where the forces go.
    pub sink: Sink<'a>,
    /// Instruction set.
    pub instructions: InstructionSet,
}

impl<'a> Pass<'a> {
    /// The group to advance, the nodes and where the forces go.
    fn taken_apart(self) -> (&'a mut Group, NodeNumbers<'a>, Target<'a>, InstructionSet) {
        let Pass { border, interior, nodes, rates, sink, instructions } = self;
        let nodes = NodeNumbers { rows: nodes, rates };
        match sink {
            Sink::Apart(slots) => (border, nodes, Target::Apart(slots), instructions),
            Sink::Nodes { forces, border: slots } => {
                (interior, nodes, Target::Nodes(Merge { forces, border, slots, next: 0 }), instructions)
            }
        }
    }

    /// Does a step of every element, in double precision.
    pub fn over<const N: usize, S: StepKernel<N>>(self, step: &S) -> PassOutcome {
        self.with::<f64, N, S>(step)
    }

    /// Does a step of every element, in single precision.
    pub fn over_single<const N: usize, S: StepKernel<N>>(self, step: &S) -> PassOutcome {
        self.with::<f32, N, S>(step)
    }

    /// Does a step of every element in the widest vectors of a precision that there are.
    fn with<P: Widths, const N: usize, S: StepKernel<N>>(self, step: &S) -> PassOutcome {
        let (group, nodes, sink, instructions) = self.taken_apart();
        // Narrow builds compile one width: a good part of a build's time is in the others, for every law and element.
        if cfg!(any(one_width, test)) {
            return step.chunks_portable::<P::Portable>(group, nodes, sink);
        }
        match instructions.vectors() {
            // SAFETY: an instruction set is one that this processor has.
            #[cfg(target_arch = "x86_64")]
            Vectors::Avx512 => unsafe { step.chunks_avx512::<P::Avx512>(group, nodes, sink) },
            // SAFETY: as above.
            #[cfg(target_arch = "x86_64")]
            Vectors::Avx2 => unsafe { step.chunks_avx2::<P::Avx2>(group, nodes, sink) },
            _ => step.chunks_portable::<P::Portable>(group, nodes, sink),
        }
    }
}

/// [`chunks`] for each instruction set. Methods of the kernel, not functions: compilers put these where the kernel stands, and so
/// compile kinds of elements side by side. As functions all of them were one piece, for which one core took most of a build's time.
trait Loops<const N: usize>: StepKernel<N> + Sized {
    /// With whatever the target guarantees.
    fn chunks_portable<V: Lanes>(&self, group: &mut Group, nodes: NodeNumbers, sink: Target) -> PassOutcome {
        chunks::<V, N, Self>(group, nodes, sink, self)
    }

    /// With eight numbers of 64 bits at once: without the attribute the compiler makes calls of vector instructions,
    /// and the pass takes several times as long (docs/performance_history.md, "Kernels").
    ///
    /// # Safety
    /// The processor must have the instructions of the attribute.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx512f,avx512dq,avx512vl")]
    unsafe fn chunks_avx512<V: Lanes>(&self, group: &mut Group, nodes: NodeNumbers, sink: Target) -> PassOutcome {
        chunks::<V, N, Self>(group, nodes, sink, self)
    }

    /// The same with four at once.
    ///
    /// # Safety
    /// The processor must have AVX2.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    unsafe fn chunks_avx2<V: Lanes>(&self, group: &mut Group, nodes: NodeNumbers, sink: Target) -> PassOutcome {
        chunks::<V, N, Self>(group, nodes, sink, self)
    }
}

impl<const N: usize, S: StepKernel<N>> Loops<N> for S {}

/// What a pass fetches from nodes.
#[derive(Clone, Copy)]
struct NodeNumbers<'a> {
    rows: &'a [Row],
    rates: &'a [f64],
}

/// Where the forces of a chunk go, with what the merge of border elements has to remember.
enum Target<'a> {
    Apart(&'a mut [Force]),
    Nodes(Merge<'a>),
}

struct Merge<'a> {
    forces: &'a mut [Force],
    border: &'a Group,
    slots: &'a [Force],
    next: usize,
}

impl Merge<'_> {
    #[inline(always)]
    fn subtract(forces: &mut [Force], node: u32, force: &Force) {
        let sum = &mut forces[node as usize].0;
        for (s, f) in sum.iter_mut().zip(force.0) {
            *s -= f;
        }
    }

    /// Lets the border elements before `place` take their turn.
    #[inline(always)]
    fn border_before(&mut self, place: u32) {
        while let Some(&border_place) = self.border.places.get(self.next)
            && border_place < place
        {
            let corners = self.border.unknowns;
            for corner in 0..corners {
                let node = self.border.node(self.next, corner);
                Merge::subtract(self.forces, node, &self.slots[corners * self.next + corner]);
            }
            self.next += 1;
        }
    }

    #[inline(always)]
    fn chunk<const N: usize>(
        &mut self,
        places: &[u32],
        connectivity: &[[u32; CHUNK]; N],
        corner_forces: &[[Force; MOST_CORNERS]],
    ) {
        for (lane, &place) in places.iter().enumerate() {
            self.border_before(place);
            for corner in 0..N {
                Merge::subtract(self.forces, connectivity[corner][lane], &corner_forces[lane][corner]);
            }
        }
    }
}

#[inline(always)]
fn chunks<V: Lanes, const N: usize, S: StepKernel<N>>(
    group: &mut Group,
    nodes: NodeNumbers,
    mut sink: Target,
    kernel: &S,
) -> PassOutcome {
    let stride = group.stride;
    // Chunks of a row.
    let abreast = V::Row::LANES / CHUNK;
    let rows = V::Row::among(&mut group.state, &mut group.single);
    let mut corner_forces: CornerForces = [[Force::default(); MOST_CORNERS]; MOST_LANES];
    // Outside of the loop: to clear them for every chunk took a twentieth of it.
    let (mut x, mut v) = ([[V::splat(0.0); N]; 3], [[V::splat(0.0); N]; 3]);
    let (mut smallest, mut smallest_row) = (V::Row::filled(f64::INFINITY), V::Row::filled(f64::INFINITY));
    let mut failed_row = V::Row::filled(f64::INFINITY);
    let mut motion_steps = V::Row::filled(f64::INFINITY);
    for (row, connectivity) in group.connectivity.as_chunks::<N>().0.chunks_exact(abreast).enumerate() {
        let chunk = row * abreast;
        let mut steps = group.steps.get_mut(chunk..chunk + abreast);
        let (state, later) = rows[row * stride..].split_at_mut(stride);
        // Forces that are kept apart are of few elements.
        let (sums, far) = match &sink {
            Target::Apart(_) => (&[][..], &[][..]),
            Target::Nodes(merge) => (&*merge.forces, &group.far[..]),
        };
        let mut ahead = Ahead {
            state: later.get(..stride).unwrap_or_default(),
            nodes: (nodes.rows, far.get(chunk + abreast..chunk + 2 * abreast).unwrap_or_default()),
            forces: (sums, far.get(chunk..chunk + abreast).unwrap_or_default()),
            shares: 2 * V::Row::LANES / V::COUNT + if Ahead::<V::Row>::pauses::<V>() { S::PAUSES } else { 0 },
            taken: 0,
        };
        for part in 0..V::Row::LANES / V::COUNT {
            let places = N - S::ROTATIONS;
            relative_corners::<V, N>(nodes.rows, connectivity, part, (kernel.about_axis(), places), [&mut x, &mut v]);
            let material = V::load_double(&group.mass[chunk..], part);
            // Of a group without added mass or coinciding corners nothing more is fetched.
            let moving = group.moving.get(chunk..).filter(|rows| !rows.is_empty());
            let moving = moving.map_or(material, |rows| V::load_double(rows, part));
            let least_share = group.least_share.get(chunk..).filter(|rows| !rows.is_empty());
            let least_share = least_share.map_or(V::splat(1.0), |rows| V::load_double(rows, part));
            let rates =
                if S::NEIGHBOURS { gathered::<V, N>(nodes.rates, connectivity, part) } else { [V::splat(0.0); N] };
            ahead.go_on();
            let outcome = kernel.step(&x, &v, state, part, Given { material, moving, least_share, rates }, &mut ahead);
            ahead.go_on();
            scatter_forces(&outcome, S::BALANCED, &mut corner_forces, part);
            // A NaN fails every comparison, so it counts as a failed element and never as the smallest step.
            let (here, mut step) = (V::splat(row as f64), outcome.stable_step);
            if let Some(rows) = &mut steps {
                step.store_double(rows, part);
            }
            if S::MOVES_FAR {
                let motion_step = outcome.motion_step;
                motion_step.min(V::load(&motion_steps, part)).store(&mut motion_steps, part);
                step = V::select_less(motion_step, step, motion_step, step);
            }
            let best = V::load(&smallest, part);
            V::select_less(step, best, here, V::load(&smallest_row, part)).store(&mut smallest_row, part);
            V::select_less(step, best, step, best).store(&mut smallest, part);
            let failed = V::load(&failed_row, part);
            V::select_less(V::splat(0.0), step, failed, failed.min(here)).store(&mut failed_row, part);
        }
        for (next, connectivity) in connectivity.iter().enumerate() {
            let first = (chunk + next) * CHUNK;
            let places = &group.places[group.places.len().min(first)..group.places.len().min(first + CHUNK)];
            let forces = &corner_forces[next * CHUNK..][..CHUNK];
            match &mut sink {
                Target::Apart(slots) => {
                    let slots = slots.get_mut(N * first..).unwrap_or_default();
                    for (slots, forces) in slots.chunks_exact_mut(N).zip(&forces[..places.len()]) {
                        slots.copy_from_slice(&forces[..N]);
                    }
                }
                Target::Nodes(merge) => merge.chunk(places, connectivity, forces),
            }
        }
    }
    if let Target::Nodes(merge) = &mut sink {
        merge.border_before(u32::MAX);
    }
    summarise(group, [&smallest, &smallest_row, &motion_steps, &failed_row])
}

/// Brings the forces of a part to where they are taken from; in single precision made to add up to nothing again in each
/// element, which they have been rounded away from: momentum is kept.
#[inline(always)]
fn scatter_forces<V: Lanes, const N: usize>(
    outcome: &Outcome<V, N>,
    balanced: bool,
    to: &mut CornerForces,
    part: usize,
) {
    let Outcome { force, rate, .. } = outcome;
    for piece in 0..V::PIECES {
        let own = V::PIECES * part + piece;
        let rate = rate.widened(piece);
        let mut sum = [V::Double::splat(0.0); 3];
        for corner in 1..N {
            let force = array![i in 3 => force[i][corner].widened(piece)];
            sum = array![i in 3 => sum[i] + force[i]];
            V::Double::spread([force[0], force[1], force[2], rate], to, corner, own);
        }
        let zero = V::Double::splat(0.0);
        let first = if V::SINGLE && balanced {
            array![i in 3 => zero - sum[i]]
        } else {
            array![i in 3 => force[i][0].widened(piece)]
        };
        V::Double::spread([first[0], first[1], first[2], rate], to, 0, own);
    }
}

/// Numbers of nodes, one per corner.
#[inline(always)]
fn gathered<V: Lanes, const N: usize>(numbers: &[f64], connectivity: &[[[u32; CHUNK]; N]], part: usize) -> [V; N] {
    let mut gathered = [V::splat(0.0); N];
    for (corner, gathered) in gathered.iter_mut().enumerate() {
        let mut row = V::Row::default();
        for lane in part * V::COUNT..(part + 1) * V::COUNT {
            let node = connectivity[lane / CHUNK][corner][lane % CHUNK];
            row.set(lane, numbers.get(node as usize).copied().unwrap_or_default());
        }
        *gathered = V::load(&row, part);
    }
    gathered
}

/// Positions and velocities of the corners, relative to the first corner so that neither a far origin nor a fast
/// flight costs digits. Of those from `places` on, which are rotations, only the rates are fetched, as they are. What is never fetched
/// stays as it is, zero.
#[inline(always)]
fn relative_corners<V: Lanes, const N: usize>(
    nodes: &[Row],
    connectivity: &[[[u32; CHUNK]; N]],
    part: usize,
    (about_axis, places): (bool, usize),
    [x, v]: [&mut [[V; N]; 3]; 2],
) {
    let at = |corner: usize| -> Corner { [&connectivity[0][corner], &connectivity[connectivity.len() - 1][corner]] };
    // Differences are those of doubles: far from the origin single precision would leave nothing of them.
    let pieces = [V::PIECES * part, V::PIECES * (part + 1) - 1];
    let mut first = array![h in 2 => V::Double::gather(nodes, at(0), pieces[h])];
    if about_axis {
        let zero = V::Double::splat(0.0);
        (x[0][0], v[0][0]) = (V::rounded([first[0][0], first[1][0]]), V::rounded([first[0][4], first[1][4]]));
        for first in &mut first {
            (first[0], first[4]) = (zero, zero);
        }
    }
    for corner in 1..places {
        let rows = array![h in 2 => V::Double::gather(nodes, at(corner), pieces[h])];
        for i in 0..3 {
            x[i][corner] = V::rounded(array![h in 2 => rows[h][i] - first[h][i]]);
            v[i][corner] = V::rounded(array![h in 2 => rows[h][4 + i] - first[h][4 + i]]);
        }
    }
    for corner in places..N {
        let rows = array![h in 2 => V::Double::gather(nodes, at(corner), pieces[h])];
        for i in 0..3 {
            v[i][corner] = V::rounded([rows[0][4 + i], rows[1][4 + i]]);
        }
    }
}

fn summarise<R: Numbers>(group: &Group, [smallest, smallest_row, motion_steps, failed_row]: [&R; 4]) -> PassOutcome {
    (0..R::LANES).fold(PassOutcome::NOTHING, |outcome, lane| {
        // Lanes that fill up the last chunk repeat its last element.
        let place = |row: f64| {
            row.is_finite().then(|| group.places[(row as usize * R::LANES + lane).min(group.places.len() - 1)])
        };
        outcome.and(PassOutcome {
            stable_step: smallest.number(lane),
            controlling: place(smallest_row.number(lane)),
            motion_step: motion_steps.number(lane),
            failed: place(failed_row.number(lane)),
        })
    })
}
