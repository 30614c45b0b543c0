//! Values that the user gives to names of decks and recipes, in place of those that assignments in braces would give.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Mutex, PoisonError};

/// A value from the command line.
#[derive(Debug, Clone, PartialEq)]
pub enum Given {
    /// A number.
    Number(f64),
    /// A text.
    Text(String),
}

/// Names with their values, and which of them something has used.
#[derive(Debug, Default)]
pub struct Definitions {
    values: BTreeMap<String, Given>,
    used: Mutex<BTreeSet<String>>,
}

impl Definitions {
    /// Reads `name=value` of each text. What is no number is a text.
    ///
    /// # Errors
    /// With the text that is not of this form, or a name that is given twice.
    pub fn parse(texts: &[String]) -> Result<Definitions, String> {
        let mut values = BTreeMap::new();
        for text in texts {
            let Some((name, value)) = text.split_once('=').map(|(name, value)| (name.trim(), value.trim())) else {
                return Err(format!("-D {text}: expected NAME=VALUE"));
            };
            let begins = name.starts_with(|letter: char| letter.is_ascii_alphabetic() || letter == '_');
            if !begins || name.contains(|letter: char| !letter.is_ascii_alphanumeric() && letter != '_') {
                return Err(format!("-D {text}: {name:?} is no name; names have letters, digits and underscores"));
            }
            if value.is_empty() {
                return Err(format!("-D {text}: the value is missing; leave -D out for the value that the deck gives"));
            }
            // A deck takes it for the end of a field: what follows would be the value of the next one.
            if value.contains(',') {
                return Err(format!(
                    "-D {text}: a comma would make two fields of the value\n\
                     help: decimals follow a point, as in 1.5; two fields of a deck need two names, as in {{a}}, {{b}}"
                ));
            }
            let number = value.parse::<f64>().ok().filter(|number| number.is_finite());
            let given = number.map_or_else(|| Given::Text(value.to_owned()), Given::Number);
            if values.insert(name.to_owned(), given).is_some() {
                return Err(format!("-D {text}: {name} has a value already"));
            }
        }
        Ok(Definitions { values, used: Mutex::default() })
    }

    /// All names with their values.
    pub fn values(&self) -> impl Iterator<Item = (&str, &Given)> {
        self.values.iter().map(|(name, given)| (name.as_str(), given))
    }

    /// The value given to a name, which is used by this.
    pub fn take(&self, name: &str) -> Option<&Given> {
        let given = self.values.get(name)?;
        // Nothing is left half done where a thread panics here.
        self.used.lock().unwrap_or_else(PoisonError::into_inner).insert(name.to_owned());
        Some(given)
    }

    /// Names that nothing has used.
    pub fn unused(&self) -> Vec<String> {
        let used = self.used.lock().unwrap_or_else(PoisonError::into_inner);
        self.values.keys().filter(|name| !used.contains(*name)).cloned().collect()
    }
}

/// Two are the same when they give the same values.
impl PartialEq for Definitions {
    fn eq(&self, other: &Definitions) -> bool {
        self.values == other.values
    }
}

impl Eq for Definitions {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_values_are_read_and_their_use_is_known() {
        let texts = |list: &[&str]| list.iter().map(|text| text.to_string()).collect::<Vec<_>>();
        let given = Definitions::parse(&texts(&["n=4", "angle = 1.5e1", "kind=soft"])).unwrap();
        assert_eq!(given.take("angle"), Some(&Given::Number(15.0)));
        assert_eq!(given.take("kind"), Some(&Given::Text("soft".into())));
        assert_eq!((given.take("m"), given.unused()), (None, vec!["n".to_string()]));
        for wrong in ["n", "4=n", "a b=1", "=1", "n=", "n= ", "n=1,5"] {
            assert!(Definitions::parse(&texts(&[wrong])).is_err(), "{wrong}");
        }
        assert!(Definitions::parse(&texts(&["n=1", "n=2"])).is_err());
    }
}
