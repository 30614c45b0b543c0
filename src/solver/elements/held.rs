//! Corners of solids that close are held: which rows of elements are asked for them, and when.
//!
//! To ask eight Jacobians in every step would cost a tenth of the elements' time. So a row keeps how far its corners may move
//! before one of them can come near, and is asked anew when they may have moved that far. Nothing depends on when that is.

use super::hexahedron::corners::{self, Held, Points, Solid};
use crate::lanes::{CHUNK, CornerForces, Force, Lanes, Numbers, Row};
use crate::vector::subtract;

/// What holds corners in the elements of a block.
#[derive(Debug, Clone, Copy)]
pub struct Holding {
    /// Density at the start.
    pub density: f64,
    /// Dilatational modulus λ + 2μ.
    pub modulus: f64,
    /// Least part of an eighth of its mass that any node has of an element.
    pub least_share: f64,
    /// Step that led to the present positions, and that in which the forces before them acted.
    pub steps: [f64; 2],
    /// Row in which the work is booked, and that in which single precision carries what it loses.
    pub account: [usize; 2],
}

/// A step may use up this part of the room of a row without being measured. It costs quiet rows that they are asked every few hundred
/// steps, and saves to look for the fastest corner.
const UNMEASURED: f64 = 1.0 / 64.0;

/// Room of a row that is asked in every step.
const NONE: f64 = -1.0;

/// How far the corners of each row may still move before one can be held.
#[derive(Default)]
pub struct Rooms {
    /// One length for each row.
    left: Vec<f64>,
    /// Which elements of each row have a mesh that is not sound, and are left alone.
    unsound: Vec<u16>,
}

impl Rooms {
    /// Of so many rows, which are to be asked at once; `unsound` are the lanes, row by row, of the elements that are left alone.
    pub fn new(rows: usize, lanes: usize, unsound: impl Iterator<Item = usize>) -> Rooms {
        let mut rooms = Rooms { left: vec![NONE; rows], unsound: vec![0; rows] };
        unsound.for_each(|slot| rooms.unsound[slot / lanes] |= 1 << (slot % lanes));
        rooms
    }

    /// The square of the speed, summed over the corners, up to which a row need not be measured, if `per` is that of a unit of room;
    /// negative where it is to be asked.
    #[inline(always)]
    pub fn quiet(&self, row: usize, per: f64) -> f64 {
        let left = self.left[row];
        left * left.abs() * per
    }

    /// What [`Rooms::quiet`] takes for a step.
    pub fn per_unit(time_step: f64) -> f64 {
        // Velocities are relative to the first corner's: those of an edge differ by no more than √2 of the root of the sum.
        0.5 * (UNMEASURED / time_step) * (UNMEASURED / time_step)
    }

    /// After a step in which a row has not been measured.
    #[inline(always)]
    pub fn unmeasured(&mut self, row: usize) {
        self.left[row] *= 1.0 - UNMEASURED;
    }

    /// Whether a row is to be asked after a step in which its elements have moved with these squares of speeds.
    pub fn is_used_up<R: Numbers>(&mut self, row: usize, squares: &R, time_step: f64) -> bool {
        let most = (0..R::LANES).fold(0.0f64, |most, lane| most.max(squares.number(lane)));
        let left = self.left[row] - time_step * (2.0 * most).sqrt();
        self.left[row] = if left > 0.0 { left } else { NONE };
        left.is_nan() || left <= 0.0
    }
}

/// Sum of the squares of the velocities of all corners against the first.
#[inline(always)]
pub fn squared_speed<V: Lanes, const N: usize>(v: &[[V; N]; 3]) -> V {
    let mut sum = V::splat(0.0);
    for corner in 1..N {
        let [x, y, z] = [v[0][corner], v[1][corner], v[2][corner]];
        sum = sum + ((x * x + y * y) + z * z);
    }
    sum
}

/// A row of elements that is to be asked.
pub struct Asked<'a, R> {
    /// Its number.
    pub row: usize,
    /// Corners of each element.
    pub nodes: &'a [[u32; 8]],
    /// Mass of the material, and what the corners have to move, of each.
    pub masses: &'a [[f64; 2]],
    /// Stable step of each; those of elements with held corners are changed.
    pub steps: &'a mut R,
    /// What the elements store.
    pub state: &'a mut [R],
    /// Forces on the corners of each, to which those are added that hold them.
    pub forces: &'a mut CornerForces,
}

impl Holding {
    /// Asks the elements of a row for their corners and holds those that have closed. Answers for which elements something
    /// has changed, one bit each.
    #[inline(never)]
    pub fn hold<R: Numbers>(&self, rooms: &mut Rooms, rows: &[Row], asked: Asked<R>) -> u16 {
        let Asked { row, nodes, masses, steps, state, forces } = asked;
        let (mut room, mut changed) = (f64::INFINITY, 0);
        for (lane, (nodes, [material, moving])) in nodes.iter().zip(masses).enumerate() {
            if rooms.unsound[row] >> lane & 1 == 1 {
                continue;
            }
            let of = |first: usize| -> Points {
                let at = nodes.map(|node| std::array::from_fn(|i| rows[node as usize].0[first + i]));
                at.map(|x| subtract(x, at[0]))
            };
            let (x, v) = (of(0), of(4));
            let element = Solid {
                whole: corners::whole(nodes),
                volume: material / self.density,
                mass: moving * self.least_share,
                modulus: self.modulus,
                steps: self.steps,
                stable_step: steps.number(lane),
            };
            room = room.min(corners::room(&element.whole, &x, element.volume));
            let Some(Held { force, work, stable_step }) = element.hold(&x, &v) else { continue };
            changed |= 1 << lane;
            steps.set(lane, stable_step);
            add(&mut forces[lane], &force);
            self.book(work, state, lane);
        }
        rooms.left[row] = if room > 0.0 { room } else { NONE };
        changed
    }

    /// Books what holding corners has taken from the motion of an element.
    fn book<R: Numbers>(&self, work: f64, state: &mut [R], lane: usize) {
        let [own, behind] = self.account;
        let sum = state[own].number(lane);
        if R::LANES == CHUNK {
            return state[own].set(lane, sum + work);
        }
        let addition = work + state[behind].number(lane);
        state[own].set(lane, sum + addition);
        let rest = addition - (state[own].number(lane) - sum);
        state[behind].set(lane, rest);
    }
}

fn add(forces: &mut [Force], held: &Points) {
    for (sum, force) in forces.iter_mut().zip(held) {
        for i in 0..3 {
            sum.0[i] += force[i];
        }
    }
}
