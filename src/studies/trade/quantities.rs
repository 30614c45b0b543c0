//! What the user cares for: numbers that every variant gives.

use crate::exodus::Results;
use crate::model::{Model, Watched};
use serde_json::Value;
use std::path::Path;

/// The largest displacement of a node in the last state.
const DISPLACEMENT: &str = "DISPLACEMENT";
/// Components of a vector below this part of its largest do not count by themselves.
const SMALL: f64 = 0.1;

/// A number that is looked at.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Quantity {
    /// Global variable of the plot file, or variable of a history.
    pub name: String,
    /// Which value of it.
    pub wanted: Wanted,
}

/// Which value of a variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wanted {
    /// The last one.
    Last,
    /// The one farthest from zero.
    Peak,
}

impl std::str::FromStr for Quantity {
    type Err = String;

    fn from_str(text: &str) -> Result<Quantity, String> {
        let (name, wanted) = match text.split_once(':') {
            None => (text, Wanted::Last),
            Some((name, "last")) => (name, Wanted::Last),
            Some((name, "peak")) => (name, Wanted::Peak),
            Some(_) => return Err(format!("--quantity {text}: expected NAME, NAME:last or NAME:peak")),
        };
        if name.trim().is_empty() {
            Err("--quantity: a name is missing".into())
        } else {
            Ok(Quantity { name: name.trim().to_uppercase(), wanted })
        }
    }
}

impl std::fmt::Display for Quantity {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        let which = match self.wanted {
            Wanted::Last => "last",
            Wanted::Peak => "peak",
        };
        write!(f, "{which} {}", self.name)
    }
}

/// What most who wrote such a deck care for: the deformation and the energy that it took, and the peaks of forces and of the motion of
/// blocks that it watches, of each vector the large components, as the run of the deck itself shows them.
pub fn of_deck(model: &Model, summary: &Value) -> Vec<Quantity> {
    let last = |name: &str| Quantity { name: name.into(), wanted: Wanted::Last };
    let mut all = vec![last(DISPLACEMENT), last("IE")];
    for watched in &model.histories {
        let stems = match watched {
            Watched::RigidSurface(id) => vec![("F", format!("_WALL{id}"), Wanted::Peak)],
            Watched::Contact(first, Some(second)) => {
                vec![("F", format!("_CONTACT{first}_{second}"), Wanted::Peak)]
            }
            Watched::Contact(block, None) => vec![("F", format!("_CONTACT{block}"), Wanted::Peak)],
            Watched::Block(id) => {
                vec![("VEL", format!("_BLOCK{id}"), Wanted::Last), ("ACCL", format!("_BLOCK{id}"), Wanted::Peak)]
            }
            Watched::NodeSet(id) => {
                vec![("DISPL", format!("_SET{id}"), Wanted::Peak), ("R", format!("_SET{id}"), Wanted::Peak)]
            }
            Watched::Node(id) => vec![("DISPL", format!("_NODE{id}"), Wanted::Peak)],
            _ => Vec::new(),
        };
        for (stem, place, wanted) in stems {
            let names = ["X", "Y", "Z"].map(|axis| Quantity { name: format!("{stem}{axis}{place}"), wanted });
            let sizes = names.each_ref().map(|quantity| of_summary(quantity, summary).map_or(0.0, f64::abs));
            let largest = sizes.iter().fold(0.0, |most: f64, size| most.max(*size));
            let counts = names.into_iter().zip(sizes).filter(|(_, size)| *size > SMALL * largest && *size > 0.0);
            all.extend(counts.map(|(quantity, _)| quantity));
        }
    }
    all.retain(|quantity| {
        quantity.name == DISPLACEMENT || of_summary(quantity, summary).is_some_and(|value| value != 0.0)
    });
    all
}

fn of_summary(quantity: &Quantity, summary: &Value) -> Option<f64> {
    let reached = ["globals", "histories"].iter().find_map(|list| summary[list].get(&quantity.name))?;
    match quantity.wanted {
        Wanted::Last => reached["last"].as_f64(),
        Wanted::Peak => {
            let [least, greatest] = [reached["least"].as_f64()?, reached["greatest"].as_f64()?];
            Some(if least.abs() > greatest.abs() { least } else { greatest })
        }
    }
}

/// The value of a quantity in a run, from its summary or else from its results.
///
/// # Errors
/// With the reason, when the run does not have it.
pub fn found(quantity: &Quantity, summary: &Value, results: &Path) -> Result<f64, String> {
    if quantity.name != DISPLACEMENT {
        return of_summary(quantity, summary).ok_or_else(|| {
            let known =
                ["globals", "histories"].iter().flat_map(|list| summary[list].as_object()).flat_map(|all| all.keys());
            let known: Vec<&str> = known.map(String::as_str).collect();
            format!("the run has no {}; it has {DISPLACEMENT}, {}", quantity.name, known.join(", "))
        });
    }
    let cannot = |error: &dyn std::fmt::Display| format!("{}: {error}", results.display());
    let file = Results::open(results).map_err(|error| cannot(&error))?;
    let all: Vec<usize> = match quantity.wanted {
        Wanted::Last => file.times().len().checked_sub(1).into_iter().collect(),
        Wanted::Peak => (0..file.times().len()).collect(),
    };
    let mut most = 0.0f64;
    for state in all {
        let axes = file.nodal_names().iter().filter(|name| ["DISPLX", "DISPLY", "DISPLZ"].contains(&name.as_str()));
        let parts =
            axes.map(|name| file.nodal(name, state)).collect::<Result<Vec<_>, _>>().map_err(|error| cannot(&error))?;
        let nodes = parts.first().map_or(0, Vec::len);
        let length = |node: usize| parts.iter().map(|part| part[node] * part[node]).sum::<f64>().sqrt();
        most = (0..nodes).map(length).fold(most, f64::max);
    }
    Ok(most)
}
