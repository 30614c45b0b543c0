//! PRESSURE: on the deformed faces of side sets. Their forces are summed at the nodes together with those of the elements.

use super::{Account, Key, Load, LoadEntry, Places, Turn, function_number};
use crate::common::numbers::number;
use crate::common::vector::{cross, dot, scaled};
use crate::lanes::Force;
use crate::model::{Analysis, Function, Model};
use crate::solver::constraints::StepTimes;
use crate::solver::elements::quadrilateral::sections::ON_AXIS;
use crate::solver::nodes::Nodes;

pub(super) static ENTRY: LoadEntry = LoadEntry {
    command: "PRESSURE",
    works: "PRESSUREW",
    key: Key::Element(3),
    turn: Turn::Elements,
    echo,
    make: |_| None,
};

fn echo(model: &Model) -> (&'static str, &'static str, Vec<String>) {
    let line = |p: &crate::model::Pressure| {
        format!("{:>13}{:>10}{:>13}", p.side_set, function_number(model, p.function), number(p.scale))
    };
    ("PRESSURES", "     SIDE SET  FUNCTION        SCALE", model.pressures.iter().map(line).collect())
}

/// All faces under pressure of a rank.
#[derive(Debug, Clone, Default)]
pub struct PressureFaces(pub Vec<PressureFace>);

impl Load for PressureFaces {
    fn entry(&self) -> &'static LoadEntry {
        &ENTRY
    }

    /// Elements and their faces have added theirs before.
    fn apply(&mut self, _: &mut Nodes, _: &[Function], _: &StepTimes) {}

    fn book(&mut self, nodes: &Nodes, half_step: f64) {
        self.0.iter_mut().for_each(|face| face.book(nodes, half_step));
    }

    fn accounts(&mut self, places: &Places, visit: &mut dyn FnMut(Account)) {
        for PressureFace { nodes, element, work, gone: _, analysis: _, function: _, scale: _, force: _ } in &mut self.0
        {
            let [a, b, c, _] = nodes.map(|node| places.node(node));
            visit(Account { key: [places.element(*element), a, b, c], own: true, work });
        }
    }

    fn lose(&mut self, dead: &[u32], all: bool) {
        for face in &mut self.0 {
            let dead = dead.binary_search(&face.element).is_ok();
            face.gone = dead || (face.gone && !all);
        }
    }
}

/// Pressure on one face of this rank.
#[derive(Debug, Clone)]
pub struct PressureFace {
    /// Local nodes, counter-clockwise seen from outside; of an edge of the plane a-b-b-a.
    pub nodes: [u32; 4],
    /// Canonical number of its element.
    pub element: u32,
    /// Whether the element has been taken away; nothing presses then.
    pub gone: bool,
    /// What stands for the third dimension of an edge.
    pub analysis: Analysis,
    /// Function of time.
    pub function: usize,
    /// Factor on it.
    pub scale: f64,
    /// Force on each node now.
    pub force: [[f64; 3]; 4],
    /// Work done so far.
    pub work: f64,
}

/// ∫ N_I n dA over a face of space, over an edge a-b-b-a times a unit of thickness, or over the ring that the edge sweeps in a
/// turn about the y axis; in the compatible form as its forces are weighed. All exact but that; of an edge the last two are zero.
pub fn area_vectors(x: [[f64; 3]; 4], analysis: Analysis) -> [[f64; 3]; 4] {
    let [a, b, ..] = x;
    let normal = [b[1] - a[1], a[0] - b[0], 0.0];
    let of_ends = |weights: [f64; 2]| [scaled(normal, weights[0]), scaled(normal, weights[1]), [0.0; 3], [0.0; 3]];
    match analysis {
        Analysis::Solid => face_area_vectors(x),
        Analysis::PlaneStrain => of_ends([0.5, 0.5]),
        Analysis::Axisymmetric => {
            let sixth = std::f64::consts::TAU / 6.0;
            of_ends([sixth * (2.0 * a[0] + b[0]), sixth * (a[0] + 2.0 * b[0])])
        }
        Analysis::AxisymmetricCompatible => {
            let half = 0.5 * std::f64::consts::TAU;
            let radius = |own: f64, other: f64| if own > 0.0 { own } else { ON_AXIS * other };
            of_ends([half * radius(a[0], b[0]), half * radius(b[0], a[0])])
        }
    }
}

/// ∫ N_I n dA over a bilinear face: closed form, exact also for warped faces.
fn face_area_vectors(x: [[f64; 3]; 4]) -> [[f64; 3]; 4] {
    let combine =
        |s: [f64; 4]| [0, 1, 2].map(|i| 0.25 * (s[0] * x[0][i] + s[1] * x[1][i] + s[2] * x[2][i] + s[3] * x[3][i]));
    let (e1, e2) = (combine([-1.0, 1.0, 1.0, -1.0]), combine([-1.0, -1.0, 1.0, 1.0]));
    let h = combine([1.0, -1.0, 1.0, -1.0]);
    let (area, b, c) = (cross(e1, e2), cross(e1, h), cross(h, e2));
    [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
        .map(|(xi, eta)| [0, 1, 2].map(|i| area[i] + (xi * b[i] + eta * c[i]) / 3.0))
}

impl PressureFace {
    /// Forces of the pressure p(t) on the present face. Positive pressure pushes on it, against the outward normal.
    pub fn evaluate(&mut self, nodes: &Nodes, functions: &[Function], time: f64) {
        let pressure = if self.gone { 0.0 } else { self.scale * functions[self.function].value(time) };
        let corners = self.nodes.map(|n| nodes.position(n));
        self.force = area_vectors(corners, self.analysis).map(|area| scaled(area, -pressure));
    }

    /// Minus the forces, as slots to be subtracted like element forces.
    pub fn slots(&self) -> [Force; 4] {
        self.force.map(|f| Force([-f[0], -f[1], -f[2], 0.0]))
    }

    /// Books half the step's work with the present velocities.
    pub fn book(&mut self, nodes: &Nodes, half_step: f64) {
        let power: f64 = self.nodes.iter().zip(self.force).map(|(&n, f)| dot(f, nodes.velocity(n))).sum();
        self.work += half_step * power;
    }
}
