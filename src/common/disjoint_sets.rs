//! Sets that grow together as their members are joined.

/// Numbers from 0 on, each in one set, which the least of its members stands for (Tarjan 1975, with paths that are halved).
#[derive(Debug, Clone)]
pub struct DisjointSets(Vec<u32>);

impl DisjointSets {
    /// So many numbers, each alone.
    pub fn new(count: usize) -> DisjointSets {
        DisjointSets((0u32..).take(count).collect())
    }

    /// The least number of the set of a number.
    pub fn least(&mut self, mut number: u32) -> u32 {
        let parents = &mut self.0;
        while parents[number as usize] != number {
            parents[number as usize] = parents[parents[number as usize] as usize];
            number = parents[number as usize];
        }
        number
    }

    /// Makes one set of those of two numbers.
    pub fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.least(a), self.least(b));
        self.0[a.max(b) as usize] = a.min(b);
    }

    /// For each number the least of its set.
    pub fn into_least(mut self) -> Vec<u32> {
        (0..self.0.len() as u32).map(|number| self.least(number)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_stands_for_all() {
        let mut sets = DisjointSets::new(6);
        [(4, 5), (1, 4), (2, 3), (5, 1)].into_iter().for_each(|(a, b)| sets.join(a, b));
        assert_eq!(sets.least(5), 1);
        assert_eq!(sets.into_least(), [0, 1, 2, 2, 1, 1]);
    }
}
