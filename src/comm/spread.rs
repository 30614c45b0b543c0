//! How evenly a number is spread over the ranks.

use super::Communicator;

/// The least, the mean and the largest of a number over all ranks.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Spread {
    /// Least.
    pub least: f64,
    /// Mean.
    pub mean: f64,
    /// Largest.
    pub most: f64,
}

impl Spread {
    /// Of these numbers; zero for none. The mean is exact while the sum stays below 2^53.
    pub fn of(numbers: impl IntoIterator<Item = u64>) -> Spread {
        let (mut least, mut sum, mut most, mut count) = (u64::MAX, 0, 0, 0);
        for number in numbers {
            (least, sum, most, count) = (least.min(number), sum + number, most.max(number), count + 1);
        }
        match count {
            0 => Spread::default(),
            _ => Spread { least: least as f64, mean: sum as f64 / f64::from(count), most: most as f64 },
        }
    }

    /// All three divided.
    pub fn over(self, divisor: f64) -> Spread {
        Spread { least: self.least / divisor, mean: self.mean / divisor, most: self.most / divisor }
    }
}

/// The spread of each number over the ranks, known to all of them; all ranks call it with as many numbers, below 2^53.
pub fn spreads(own: &[u64], comm: &mut dyn Communicator) -> Vec<Spread> {
    let mut sums = own.to_vec();
    comm.all_sum(&mut sums);
    let mut extremes: Vec<f64> = own.iter().flat_map(|&number| [number as f64, -(number as f64)]).collect();
    comm.all_min(&mut extremes);
    let ranks = comm.size() as f64;
    let spread = |(sum, [least, most]): (u64, [f64; 2])| Spread { least, mean: sum as f64 / ranks, most: -most };
    sums.into_iter().zip(extremes.as_chunks().0.iter().copied()).map(spread).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::comm::run_threads;

    #[test]
    fn all_ranks_know_the_spread_of_all() {
        let found = run_threads(3, |comm| {
            let rank = comm.rank() as u64;
            Ok::<_, ()>(spreads(&[rank * rank, 7], comm))
        });
        let expected = [Spread { least: 0.0, mean: 5.0 / 3.0, most: 4.0 }, Spread { least: 7.0, mean: 7.0, most: 7.0 }];
        assert!(found.unwrap().iter().all(|spreads| *spreads == expected));
        assert_eq!(Spread::of([0, 1, 4]), expected[0]);
        assert_eq!(expected[1].over(7.0), Spread { least: 1.0, mean: 1.0, most: 1.0 });
    }
}
