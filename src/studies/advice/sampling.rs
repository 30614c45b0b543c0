//! Plot states that are too far apart to show what happened.

use super::{Advice, Scene};
use crate::comm::Communicator;
use crate::common::numbers::scientific;

/// Part of the largest kinetic energy by which it must have turned.
const AMPLITUDE: f64 = 0.02;
/// States that a turn of the energy needs to be seen at all.
const STATES_PER_TURN: f64 = 2.0;

pub fn advice(scene: &Scene, _: &mut dyn Communicator) -> Vec<Advice> {
    let turns = turns(scene.lines);
    let (Some(first), Some(last)) = (scene.states.first(), scene.states.last()) else { return Vec::new() };
    // A deck that asks for no states does not want to see.
    if scene.model.plot.interval.is_none() || turns.len() < 4 || scene.states.len() < 3 {
        return Vec::new();
    }
    let apart = (last - first) / (scene.states.len() - 1) as f64;
    let mut gaps: Vec<f64> = turns.windows(2).map(|pair| pair[1] - pair[0]).collect();
    gaps.sort_by(f64::total_cmp);
    let middle = gaps[gaps.len() / 2];
    if apart * STATES_PER_TURN <= middle {
        return Vec::new();
    }
    let words = format!(
        "plot states are {} apart, and the kinetic energy turned {} times, as a rule every {}",
        scientific(apart, 2),
        turns.len(),
        scientific(middle, 2)
    );
    vec![Advice::lack(words, format!("PLOT TIME, {} shows it", scientific(middle / STATES_PER_TURN, 1)))]
}

/// Times at which the energy has turned by more than a part of its largest value.
fn turns(lines: &[[f64; 2]]) -> Vec<f64> {
    let least = AMPLITUDE * lines.iter().fold(0.0, |most: f64, line| most.max(line[1]));
    let mut turns = Vec::new();
    let Some(&start) = lines.first() else { return turns };
    let (mut extreme, mut rising) = (start, None);
    for &line in lines {
        match rising {
            None if (line[1] - start[1]).abs() > least => (extreme, rising) = (line, Some(line[1] > start[1])),
            Some(true) if line[1] < extreme[1] - least => {
                turns.push(extreme[0]);
                (extreme, rising) = (line, Some(false));
            }
            Some(false) if line[1] > extreme[1] + least => {
                turns.push(extreme[0]);
                (extreme, rising) = (line, Some(true));
            }
            Some(up) if up == (line[1] > extreme[1]) => extreme = line,
            _ => (),
        }
    }
    turns
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_energy_turns_twice_in_a_period_and_noise_does_not_count() {
        let wave = |n: u32| {
            let t = 0.01 * f64::from(n);
            [t, 1.0 + libm::cos(10.0 * t) + 1e-3 * libm::cos(1e3 * t)]
        };
        let lines: Vec<[f64; 2]> = (0..400).map(wave).collect();
        // cos 10 t has extremes every π/10: 12 of them between the first and t = 4.
        let found = turns(&lines);
        assert_eq!(found.len(), 12, "{found:?}");
        assert!((found[0] - 0.314).abs() < 0.011);
        assert!(turns(&[]).is_empty() && turns(&[[0.0, 1.0]; 5]).is_empty());
    }
}
