//! Which of a file's variables colours the picture.

/// Variables drawn when none is asked for, the first that the file has.
const CUSTOMARY: [&str; 4] = ["EQPS", "VONMISES", "VEL", "DISPL"];
/// Stems under which programs write displacements.
const DISPLACEMENTS: [&str; 6] = ["DISPL", "DISP", "DISPLACEMENT", "DISPLACEMENTS", "DIS", "U"];
const AXES: [char; 3] = ['X', 'Y', 'Z'];

/// Where a variable has its values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Place {
    /// One value per node, drawn varying over a face.
    Nodes,
    /// One value per element, drawn as it was computed: constant over the element's faces.
    Elements,
}

/// A variable of the file, or the length of a vector.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    /// The name to print.
    pub label: String,
    /// Where the values are.
    pub place: Place,
    /// The file's names: one, or the components of a vector, two in the plane.
    pub names: Vec<String>,
    /// Whether a reflection in x, y, z changes the sign of the value, as it does for a vector's component along
    /// that axis and for a shear.
    pub odd: [bool; 3],
}

impl Field {
    /// Whether the values stand for what contact does to a node: 0 nothing, 1 it is pushed, 2 it touches a face.
    pub fn is_status(&self) -> bool {
        self.place == Place::Nodes && self.label.eq_ignore_ascii_case("CONTSTAT")
    }
}

/// The names of a file's variables.
pub struct Names<'a> {
    /// Nodal variables.
    pub nodal: &'a [String],
    /// Element variables.
    pub element: &'a [String],
}

impl Names<'_> {
    /// The variable or vector with this name, nodal ones first.
    pub fn find(&self, name: &str) -> Option<Field> {
        let places = [(Place::Nodes, self.nodal), (Place::Elements, self.element)];
        places.into_iter().find_map(|(place, names)| single(name, place, names).or_else(|| vector(name, place, names)))
    }

    /// The variable drawn when none is asked for; `None` when the file has no variables.
    pub fn customary(&self) -> Option<Field> {
        let any = || self.element.first().or(self.nodal.first()).and_then(|name| self.find(name));
        CUSTOMARY.iter().find_map(|name| self.find(name)).or_else(any)
    }

    /// The components of the displacement, if the file has them.
    pub fn displacement(&self) -> Option<Vec<String>> {
        DISPLACEMENTS.iter().find_map(|stem| vector(stem, Place::Nodes, self.nodal)).map(|field| field.names)
    }

    /// All names that [`Names::find`] understands: stems of vectors, then the variables.
    pub fn known(&self) -> Vec<String> {
        let mut known = Vec::new();
        for names in [self.nodal, self.element] {
            let stems = names.iter().filter_map(|name| strip_end(name, "X"));
            known.extend(stems.filter(|stem| components(stem, names).is_some()).map(str::to_owned));
            known.extend_from_slice(names);
        }
        known
    }

    /// The known name that is most like a misspelt one.
    pub fn nearest(&self, name: &str) -> Option<String> {
        let distance = |known: &String| strsim::damerau_levenshtein(&known.to_uppercase(), &name.to_uppercase());
        let (distance, near) = self.known().into_iter().map(|known| (distance(&known), known)).min()?;
        (distance <= 1 + name.chars().count() / 3).then_some(near)
    }
}

fn single(name: &str, place: Place, names: &[String]) -> Option<Field> {
    let name = names.iter().find(|known| known.eq_ignore_ascii_case(name))?;
    Some(Field { label: name.clone(), place, names: vec![name.clone()], odd: odd(name, names) })
}

fn vector(stem: &str, place: Place, names: &[String]) -> Option<Field> {
    let names = components(stem, names)?;
    let stem = strip_end(&names[0], "X").unwrap_or(stem).trim_end_matches('_');
    Some(Field { label: format!("|{stem}|"), place, names, odd: [false; 3] })
}

/// The variables whose names are `stem` and X, Y, Z, perhaps with an underscore between; X and Y where nothing is said of Z.
fn components(stem: &str, names: &[String]) -> Option<Vec<String>> {
    let stem = stem.trim_end_matches('_');
    let component = |axis: char| {
        let spellings = [format!("{stem}{axis}"), format!("{stem}_{axis}")];
        names.iter().find(|known| spellings.iter().any(|spelling| known.eq_ignore_ascii_case(spelling))).cloned()
    };
    let (x, y) = (component('X')?, component('Y')?);
    Some([x, y].into_iter().chain(component('Z')).collect())
}

/// Which reflections change a value's sign. A tensor's component changes it with each of its two axes, a vector's
/// with its one; other names that happen to end in an axis (ENERGY) have no sisters for the other axes.
fn odd(name: &str, names: &[String]) -> [bool; 3] {
    let upper = name.to_uppercase();
    let mut axes = upper.chars().rev().map_while(|letter| AXES.iter().position(|&axis| axis == letter));
    let mut odd = [false; 3];
    match (axes.next(), axes.next()) {
        (Some(second), Some(first)) => {
            odd[first] ^= true;
            odd[second] ^= true;
        }
        (Some(axis), None) if strip_end(name, &AXES[axis].to_string()).and_then(|s| components(s, names)).is_some() => {
            odd[axis] = true;
        }
        _ => {}
    }
    odd
}

fn strip_end<'a>(name: &'a str, end: &str) -> Option<&'a str> {
    let split = name.len().checked_sub(end.len())?;
    (name.is_char_boundary(split) && name[split..].eq_ignore_ascii_case(end)).then(|| &name[..split])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(list: &str) -> Vec<String> {
        list.split_whitespace().map(str::to_owned).collect()
    }

    #[test]
    fn a_stem_means_the_length_of_the_vector() {
        let nodal = names("DISPLX DISPLY DISPLZ VELX VELY VELZ");
        let element = names("TAUXY ENERGY");
        let names = Names { nodal: &nodal, element: &element };
        let field = names.find("vel").unwrap();
        assert_eq!((field.label.as_str(), field.names.len(), field.place), ("|VEL|", 3, Place::Nodes));
        assert_eq!(names.find("VELY").unwrap().odd, [false, true, false]);
        assert_eq!(names.find("tauxy").unwrap().odd, [true, true, false]);
        assert_eq!(names.find("ENERGY").unwrap().odd, [false; 3]);
        assert_eq!(names.customary().unwrap().label, "|VEL|");
        assert_eq!(names.displacement().unwrap(), ["DISPLX", "DISPLY", "DISPLZ"]);
    }

    #[test]
    fn normal_stresses_keep_their_sign_in_a_mirror() {
        let element = names("SIGXX SIGYY SIGZZ EPSXX EPSXY EPSXZ");
        let names = Names { nodal: &[], element: &element };
        assert_eq!(names.find("SIGYY").unwrap().odd, [false; 3]);
        assert_eq!(names.find("EPSXZ").unwrap().odd, [true, false, true]);
    }

    #[test]
    fn a_misspelt_name_finds_the_nearest_one() {
        let element = names("EQPS VONMISES PRESSURE");
        let names = Names { nodal: &[], element: &element };
        assert_eq!(names.nearest("VONMISSES").as_deref(), Some("VONMISES"));
        assert_eq!(names.nearest("TEMPERATURE"), None);
    }
}
