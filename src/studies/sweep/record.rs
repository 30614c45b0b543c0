//! How a member of a study went, from the summary that its run has left.

use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;
use std::time::SystemTime;

/// How a run went.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// `complete`, `stopped` or `failed`.
    pub ended: String,
    /// Why it did not come to its end.
    pub reason: Option<String>,
    /// Steps taken.
    pub steps: u64,
    /// Time reached.
    pub time: f64,
    /// Relative error of the energy balance.
    pub energy_error: Option<f64>,
    /// Number of warnings.
    pub warnings: usize,
    /// Wall-clock seconds.
    pub seconds: f64,
    /// What it was run with: deck, mesh and parameters.
    made_of: Made,
}

/// What a run is made of.
#[derive(Debug, Clone, PartialEq)]
pub struct Made {
    /// The deck.
    pub deck: String,
    /// The mesh, or its recipe.
    pub mesh: String,
    /// How much finer than the recipe says.
    pub refine: u32,
    /// Names and values.
    pub parameters: BTreeMap<String, String>,
}

impl Record {
    /// What stands in a summary; `None` where there is none, or it is not whole.
    pub fn read(path: &Path) -> Option<Record> {
        let all: Value = serde_json::from_str(&std::fs::read_to_string(path).ok()?).ok()?;
        let text = |name: &str| all[name].as_str().map(str::to_owned);
        let value = |(name, value): (&String, &Value)| Some((name.clone(), value.as_str()?.to_owned()));
        Some(Record {
            ended: text("ended")?,
            reason: text("reason"),
            // Not known of a run that failed before its first step.
            steps: all["steps"].as_u64().unwrap_or(0),
            time: all["time"].as_f64().unwrap_or(0.0),
            energy_error: all["energy_error"].as_f64(),
            warnings: all["warnings"].as_array()?.len(),
            seconds: all["seconds"]["all"].as_f64()?,
            made_of: Made {
                deck: text("deck")?,
                mesh: text("mesh")?,
                refine: all["refine"].as_u64()?.try_into().ok()?,
                parameters: all["parameters"].as_object()?.iter().map(value).collect::<Option<_>>()?,
            },
        })
    }

    /// A run of which there is no summary.
    pub fn lost(reason: String) -> Record {
        Record {
            ended: "failed".into(),
            reason: Some(reason),
            steps: 0,
            time: 0.0,
            energy_error: None,
            warnings: 0,
            seconds: 0.0,
            made_of: Made { deck: String::new(), mesh: String::new(), refine: 1, parameters: BTreeMap::new() },
        }
    }

    /// Whether it has come to its end.
    pub fn is_complete(&self) -> bool {
        self.ended == "complete"
    }

    /// Whether it was made of this.
    pub fn is_of(&self, made: &Made) -> bool {
        self.made_of == *made
    }
}

/// Whether a file was written after all of these.
pub fn is_newer(path: &Path, inputs: &[std::path::PathBuf]) -> bool {
    let written = |path: &Path| std::fs::metadata(path).and_then(|known| known.modified()).ok();
    let Some(own) = written(path) else { return false };
    let newest: Option<SystemTime> = inputs.iter().filter_map(|input| written(input)).max();
    newest.is_none_or(|newest| newest <= own)
}
