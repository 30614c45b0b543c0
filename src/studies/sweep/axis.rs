//! The values that a study goes through.

use std::str::FromStr;

/// Members of a study at most: it keeps a slip of the finger from filling the disk.
const MOST_MEMBERS: usize = 10_000;

/// A name and the values that it takes.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// The name in the expressions of deck and recipe.
    pub name: String,
    /// The values, as `-D name=value` takes them.
    pub values: Vec<String>,
}

/// Why values make no study.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum AxisError {
    /// The text has another form.
    #[error("-D {text}: {what}; expected NAME=START:END:STEP, or NAME=VALUE,VALUE,...")]
    Form {
        /// The text.
        text: String,
        /// What is wrong.
        what: &'static str,
    },
    /// A name or a value is there twice.
    #[error("-D {0}: it is there twice")]
    Twice(String),
    /// There would be too many runs.
    #[error("the study would have {0} members; at most {MOST_MEMBERS} are run")]
    TooMany(usize),
}

impl FromStr for Axis {
    type Err = AxisError;

    fn from_str(text: &str) -> Result<Axis, AxisError> {
        let wrong = |what| AxisError::Form { text: text.to_owned(), what };
        let (name, values) = text.split_once('=').ok_or_else(|| wrong("there is no ="))?;
        let (name, values) = (name.trim().to_owned(), values.trim());
        let values: Vec<String> = match values.split(':').collect::<Vec<_>>()[..] {
            [list] => list.split(',').map(|value| value.trim().to_owned()).collect(),
            [start, end, step] => steps([start, end, step]).map_err(wrong)?,
            _ => return Err(wrong("a range has three numbers")),
        };
        if name.is_empty() || values.iter().any(String::is_empty) {
            return Err(wrong("a name or a value is missing"));
        }
        if let Some(twice) = values.iter().enumerate().find(|(place, value)| values[..*place].contains(value)) {
            return Err(AxisError::Twice(format!("{name}={}", twice.1)));
        }
        Ok(Axis { name, values })
    }
}

/// Numbers from start to end, the end too where the steps meet it to a millionth of a step.
fn steps(texts: [&str; 3]) -> Result<Vec<String>, &'static str> {
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    let [Some(start), Some(end), Some(step)] = texts.map(number) else { return Err("a range has three numbers") };
    if step == 0.0 || (end - start) * step < 0.0 {
        return Err("the step does not lead from start to end");
    }
    let count = ((end - start) / step + 1e-6).floor();
    if count >= MOST_MEMBERS as f64 {
        return Err("there are more than ten thousand values");
    }
    // Twelve digits: 0.1 + 2 x 0.1 is to be called 0.3.
    let short = |value: f64| format!("{value:.11e}").parse::<f64>().unwrap_or(value);
    Ok((0..=count as u32).map(|place| short(start + f64::from(place) * step).to_string()).collect())
}

/// One combination of values.
#[derive(Debug, Clone, PartialEq)]
pub struct Member {
    /// Names and values, in the order of the axes.
    pub values: Vec<(String, String)>,
}

impl Member {
    /// The name of its folder: `angle=10,foam=0.2`, with what is no letter, digit, sign or point as `-`.
    pub fn name(&self) -> String {
        let plain = |c: char| if c.is_ascii_alphanumeric() || "+-._".contains(c) { c } else { '-' };
        let part =
            |(name, value): &(String, String)| format!("{name}={}", value.chars().map(plain).collect::<String>());
        self.values.iter().map(part).collect::<Vec<_>>().join(",")
    }

    /// The values in words.
    pub fn words(&self) -> String {
        self.values.iter().map(|(name, value)| format!("{name}={value}")).collect::<Vec<_>>().join(" ")
    }
}

/// All combinations, the last axis running fastest.
///
/// # Errors
/// When a name is there twice, there are too many, or two would share a folder.
pub fn members(axes: &[Axis]) -> Result<Vec<Member>, AxisError> {
    if let Some(twice) =
        axes.iter().enumerate().find(|(place, axis)| axes[..*place].iter().any(|a| a.name == axis.name))
    {
        return Err(AxisError::Twice(twice.1.name.clone()));
    }
    let count = axes.iter().fold(1usize, |count, axis| count.saturating_mul(axis.values.len()));
    if count > MOST_MEMBERS {
        return Err(AxisError::TooMany(count));
    }
    let mut all = vec![Member { values: Vec::new() }];
    for axis in axes {
        let with = |member: &Member, value: &String| Member {
            values: [&member.values[..], &[(axis.name.clone(), value.clone())]].concat(),
        };
        all = all.iter().flat_map(|member| axis.values.iter().map(move |value| with(member, value))).collect();
    }
    let mut names: Vec<String> = all.iter().map(Member::name).collect();
    names.sort();
    match names.windows(2).find(|pair| pair[0] == pair[1]) {
        Some(pair) => Err(AxisError::Twice(pair[0].clone())),
        None => Ok(all),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(text: &str) -> Result<Vec<String>, AxisError> {
        text.parse::<Axis>().map(|axis| axis.values)
    }

    #[test]
    fn ranges_end_where_they_should_and_lists_are_as_written() {
        assert_eq!(axis("a=0:40:10").unwrap(), ["0", "10", "20", "30", "40"]);
        assert_eq!(axis("a=0.1:0.3:0.1").unwrap(), ["0.1", "0.2", "0.3"]);
        assert_eq!(axis("a=2:-1:-2").unwrap(), ["2", "0"]);
        assert_eq!(axis("a=1e-9:3e-9:1e-9").unwrap(), ["0.000000001", "0.000000002", "0.000000003"]);
        assert_eq!(axis("kind = soft, hard").unwrap(), ["soft", "hard"]);
        for wrong in ["a", "a=", "a=1,,2", "=1", "a=1:2", "a=1:2:0", "a=1:2:-1", "a=x:2:1", "a=0:1:1e-9", "a=1,1"] {
            assert!(axis(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn all_combinations_have_folders_of_their_own() {
        let axes = |texts: &[&str]| texts.iter().map(|text| text.parse::<Axis>().unwrap()).collect::<Vec<_>>();
        let found = members(&axes(&["a=1,2", "b=x/y,z"])).unwrap();
        assert_eq!(
            found.iter().map(Member::name).collect::<Vec<_>>(),
            ["a=1,b=x-y", "a=1,b=z", "a=2,b=x-y", "a=2,b=z"]
        );
        assert_eq!(found[0].words(), "a=1 b=x/y");
        assert!(members(&axes(&["a=1", "a=2"])).is_err() && members(&axes(&["b=x/y,x-y"])).is_err());
        assert_eq!(members(&axes(&["a=1:5000:1", "b=1,2,3"])), Err(AxisError::TooMany(15_000)));
    }
}
