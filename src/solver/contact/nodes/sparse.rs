//! A sparse array: a value at each of many places, of which only those take memory that are not the usual one.

use std::ops::Index;

/// A value at each of many places. A place that has the usual value takes four bytes.
#[derive(Debug, Clone)]
pub struct Sparse<T> {
    /// Where the value of each place is among `values`; 0 for the usual one.
    slots: Vec<u32>,
    /// The usual value, and behind it those of places that have another.
    values: Vec<T>,
    /// Slots that nobody has any more.
    free: Vec<u32>,
}

impl<T> Default for Sparse<T> {
    /// Without any place.
    fn default() -> Sparse<T> {
        Sparse { slots: Vec::new(), values: Vec::new(), free: Vec::new() }
    }
}

impl<T: Copy> Sparse<T> {
    /// So many places with the `usual` value.
    pub fn new(usual: T, places: usize) -> Sparse<T> {
        Sparse { slots: vec![0; places], values: vec![usual], free: Vec::new() }
    }

    /// Number of places.
    pub fn len(&self) -> usize {
        self.slots.len()
    }

    /// The value at a place, if there is such a place.
    pub fn get(&self, place: usize) -> Option<&T> {
        self.slots.get(place).map(|&slot| &self.values[slot as usize])
    }

    /// The value at a place, to be changed.
    pub fn own(&mut self, place: usize) -> &mut T {
        let slot = &mut self.slots[place];
        if *slot == 0 {
            let usual = self.values[0];
            *slot = self.free.pop().unwrap_or(self.values.len() as u32);
            match self.values.get_mut(*slot as usize) {
                Some(value) => *value = usual,
                None => self.values.push(usual),
            }
        }
        &mut self.values[*slot as usize]
    }

    /// Gives a place the usual value again.
    #[inline]
    pub fn reset(&mut self, place: usize) {
        let slot = std::mem::take(&mut self.slots[place]);
        if slot != 0 {
            self.free.push(slot);
        }
    }
}

impl<T> Index<usize> for Sparse<T> {
    type Output = T;

    #[inline(always)]
    fn index(&self, place: usize) -> &T {
        &self.values[self.slots[place] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_have_the_usual_value_until_they_own_one_and_after_they_are_reset() {
        let mut sparse = Sparse::new(7, 4);
        *sparse.own(2) = 9;
        *sparse.own(0) += 1;
        assert_eq!([0, 1, 2, 3].map(|place| sparse[place]), [8, 7, 9, 7]);
        sparse.reset(2);
        sparse.reset(3);
        assert_eq!(sparse[2], 7);
        // What is used again begins with the usual value.
        assert_eq!(*sparse.own(3), 7);
        *sparse.own(3) = 1;
        *sparse.own(1) = 2;
        assert_eq!([0, 1, 2, 3].map(|place| sparse[place]), [8, 2, 7, 1]);
        assert_eq!((sparse.len(), sparse.get(4), sparse.get(0)), (4, None, Some(&8)));
    }
}
