//! Values of the nodal variables on one rank, one variable at a time.

use crate::model::NodalField;
use crate::solver::Solver;
use crate::solver::nodes::Nodes;

/// What the nodal variables of the owned nodes of a rank are made of.
pub struct NodalValues<'a> {
    solver: &'a Solver,
    /// Field and component of each variable.
    variables: Vec<(NodalField, usize)>,
    /// The owned nodes, ascending.
    owned: Vec<u32>,
    /// At all local nodes; empty where nobody asks.
    reactions: Vec<[f64; 3]>,
    /// Contact force, overlap, status and element touched, at the nodes that contact knows.
    contact: Vec<(u32, [f64; 6])>,
    /// Nodes that can turn, with their angle and its rate.
    rotations: Vec<(u32, [[f64; 3]; 2])>,
    /// Rank that computes the contact of a node.
    owner_ranks: Vec<(u32, u32)>,
}

impl<'a> NodalValues<'a> {
    /// Of these fields and components, at the present state.
    pub fn new(variables: Vec<(NodalField, usize)>, solver: &'a Solver) -> NodalValues<'a> {
        let nodes = &solver.domain.nodes;
        let wanted = |fields: &[NodalField]| variables.iter().any(|(field, _)| fields.contains(field));
        let contact = || solver.domain.contact.iter();
        let turn = |&(node, rotation): &(u32, u32)| (node, [nodes.position(rotation), solver.velocity_now(rotation)]);
        let turns = wanted(&[NodalField::Rotation, NodalField::RotationRate]);
        let (touches, ranks) = (wanted(&[NodalField::Contact]), wanted(&[NodalField::ContactRank]));
        NodalValues {
            owned: (0..nodes.places as u32).filter(|&n| nodes.owned[n as usize]).collect(),
            reactions: if wanted(&[NodalField::Reaction]) { solver.reactions() } else { Vec::new() },
            contact: contact().filter(|_| touches).flat_map(|contact| contact.node_values()).collect(),
            rotations: solver.domain.rotations.iter().filter(|_| turns).map(turn).collect(),
            owner_ranks: contact().filter(|_| ranks).flat_map(|contact| contact.owner_ranks()).collect(),
            solver,
            variables,
        }
    }

    /// Number of variables.
    pub fn len(&self) -> usize {
        self.variables.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.variables.is_empty()
    }

    /// Values of a variable, by its place, at the owned nodes.
    pub fn of(&self, variable: usize) -> Vec<f64> {
        let (field, component) = self.variables[variable];
        match field {
            NodalField::Reaction => self.owned.iter().map(|&node| self.reactions[node as usize][component]).collect(),
            NodalField::Contact => self.of_some(0.0, self.contact.iter().map(|(node, of)| (*node, of[component]))),
            NodalField::Rotation => {
                self.of_some(0.0, self.rotations.iter().map(|(node, of)| (*node, of[0][component])))
            }
            NodalField::RotationRate => {
                self.of_some(0.0, self.rotations.iter().map(|(node, of)| (*node, of[1][component])))
            }
            // There is no rank where there is no contact.
            NodalField::ContactRank => {
                self.of_some(-1.0, self.owner_ranks.iter().map(|&(node, rank)| (node, f64::from(rank))))
            }
            _ => self.owned.iter().map(|&node| self.of_node(field, node)[component]).collect(),
        }
    }

    /// An array that has another value than that of all others at some local nodes.
    fn of_some(&self, other: f64, some: impl Iterator<Item = (u32, f64)>) -> Vec<f64> {
        let mut values = vec![other; self.owned.len()];
        for (node, value) in some {
            if let Ok(place) = self.owned.binary_search(&node) {
                values[place] = value;
            }
        }
        values
    }

    fn of_node(&self, field: NodalField, node: u32) -> [f64; 3] {
        let nodes: &Nodes = &self.solver.domain.nodes;
        match field {
            NodalField::Displacement => {
                let (x, initial) = (nodes.position(node), nodes.initial(node));
                [x[0] - initial[0], x[1] - initial[1], x[2] - initial[2]]
            }
            NodalField::Velocity => self.solver.velocity_now(node),
            NodalField::Acceleration => nodes.acceleration(node),
            _ => [nodes.mass(node), 0.0, 0.0],
        }
    }
}
