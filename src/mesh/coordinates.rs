//! Positions of all nodes, which many hold and hardly anybody changes.

use std::ops::{Deref, DerefMut};
use std::sync::Arc;

/// A list of positions that copies share until one of them is changed: mesh, body and nodes have the same ones.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Coordinates(Arc<Vec<[f64; 3]>>);

impl Deref for Coordinates {
    type Target = Vec<[f64; 3]>;

    fn deref(&self) -> &Vec<[f64; 3]> {
        &self.0
    }
}

impl DerefMut for Coordinates {
    /// Makes a copy of its own first, where others have the same.
    fn deref_mut(&mut self) -> &mut Vec<[f64; 3]> {
        Arc::make_mut(&mut self.0)
    }
}

impl From<Vec<[f64; 3]>> for Coordinates {
    fn from(list: Vec<[f64; 3]>) -> Coordinates {
        Coordinates(Arc::new(list))
    }
}

impl FromIterator<[f64; 3]> for Coordinates {
    fn from_iter<I: IntoIterator<Item = [f64; 3]>>(positions: I) -> Coordinates {
        Vec::from_iter(positions).into()
    }
}

impl<'a> IntoIterator for &'a Coordinates {
    type Item = &'a [f64; 3];
    type IntoIter = std::slice::Iter<'a, [f64; 3]>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl<'a> IntoIterator for &'a mut Coordinates {
    type Item = &'a mut [f64; 3];
    type IntoIter = std::slice::IterMut<'a, [f64; 3]>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter_mut()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn copies_are_one_list_until_one_changes() {
        let mut first = Coordinates::from(vec![[1.0; 3], [2.0; 3]]);
        let second = first.clone();
        assert_eq!(first.as_ptr(), second.as_ptr());
        first[0][1] = 5.0;
        assert!(second[0] == [1.0; 3] && first[0] == [1.0, 5.0, 1.0] && first[1] == second[1]);
    }
}
