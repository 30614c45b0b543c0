//! The words in which parameters are described: what deck, materials and elements have in common, and know each by itself.

/// One parameter of a law, or of another thing that a deck describes.
pub struct Property {
    /// Keyword in the deck, e.g. `YOUNGS MODULUS`.
    pub keyword: &'static str,
    /// Symbol in the manual, e.g. `E`.
    pub symbol: &'static str,
    /// Dimension in words, e.g. `force/length^2`.
    pub dimension: &'static str,
    /// Values that make sense.
    pub range: Range,
    /// Value when the deck does not give one; `None` means it must.
    pub default: Option<f64>,
    /// One sentence for the manual.
    pub meaning: &'static str,
}

impl Property {
    /// One that the deck must give.
    pub const fn required(
        keyword: &'static str,
        symbol: &'static str,
        dimension: &'static str,
        range: Range,
        meaning: &'static str,
    ) -> Property {
        Property { keyword, symbol, dimension, range, default: None, meaning }
    }

    /// The same with a default.
    pub const fn or(self, default: f64) -> Property {
        Property { default: Some(default), ..self }
    }
}

/// The values a number may take.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Range {
    /// Any finite number.
    Any,
    /// > 0
    Positive,
    /// ≥ 0
    NotNegative,
    /// The number of a function of the deck.
    Function,
    /// Between two bounds; each says whether it is included.
    Between {
        /// Lower bound and whether it belongs to the range.
        low: (f64, bool),
        /// Upper bound and whether it belongs to the range.
        high: (f64, bool),
    },
}

impl Range {
    /// Whether a value lies in the range; NaN and infinities never do.
    pub fn contains(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Range::Any => true,
                Range::Positive => value > 0.0,
                Range::NotNegative => value >= 0.0,
                Range::Function => value >= 1.0 && value.trunc() == value,
                Range::Between { low, high } => {
                    (value > low.0 || (low.1 && value == low.0)) && (value < high.0 || (high.1 && value == high.0))
                }
            }
    }
}

impl std::fmt::Display for Range {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Range::Any => write!(f, "any number"),
            Range::Positive => write!(f, "greater than 0"),
            Range::NotNegative => write!(f, "0 or more"),
            Range::Function => write!(f, "the number of a function"),
            Range::Between { low, high } => write!(
                f,
                "from {}{} to {}{}",
                low.0,
                if low.1 { "" } else { " (excluded)" },
                high.0,
                if high.1 { "" } else { " (excluded)" }
            ),
        }
    }
}

/// One state variable of a law, stored per element.
pub struct StateVariable {
    /// Name in the plot file, at most 8 characters, upper case.
    pub name: &'static str,
    /// One sentence for the manual.
    pub meaning: &'static str,
}

/// Where the spelling of a command or property comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Origin {
    /// Seen in a genuine deck or print file.
    Verified,
    /// Remembered from the manuals, not seen.
    Recalled,
    /// Our own addition.
    Ours,
}

/// What there is to tell of a model: a thing that a deck chooses by its name and gives properties.
#[derive(Clone, Copy)]
pub struct Description {
    /// Name as spelled in the deck, e.g. `ELASTIC PLASTIC`.
    pub name: &'static str,
    /// Other spellings that are understood.
    pub aliases: &'static [&'static str],
    /// One sentence for the manual.
    pub summary: &'static str,
    /// Its parameters in the order the print log lists them.
    pub properties: &'static [Property],
    /// Its state variables as PLOT STATE names them.
    pub state: &'static [StateVariable],
    /// Where the deck form comes from.
    pub origin: Origin,
}

impl Description {
    /// All its names.
    pub fn names(&self) -> impl Iterator<Item = &'static str> + use<> {
        std::iter::once(self.name).chain(self.aliases.iter().copied())
    }
}

/// The models that a command chooses from.
pub struct Models {
    /// The command.
    pub command: &'static str,
    /// What they are, as the heading of a list.
    pub heading: &'static str,
    /// First line of the group that describes one, before its name and after.
    pub form: [&'static str; 2],
    /// Commands to read beside.
    pub see: &'static str,
    /// All of them, in the order of the manual.
    pub models: Vec<Description>,
}
