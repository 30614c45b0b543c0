//! Curves as functions of time: interpolation, even spacing, derivative, integral.

/// Relative difference of intervals up to which samples count as evenly spaced.
const EVEN: f64 = 1e-6;

/// The value at `time` on the polygon through ascending times; NaN outside.
pub fn interpolate(times: &[f64], values: &[f64], time: f64) -> f64 {
    let after = times.partition_point(|&t| t < time);
    if times.get(after) == Some(&time) {
        return values[after];
    }
    if after == 0 || after == times.len() {
        return f64::NAN;
    }
    let (low, high) = (after - 1, after);
    let fraction = (time - times[low]) / (times[high] - times[low]);
    values[low] + fraction * (values[high] - values[low])
}

/// Times at even intervals from the first to about the last, the median apart, and the interval. Times that are even
/// already stay as they are. `None` with fewer than two times.
///
/// States are written at the step nearest to the time asked for, so that intervals differ by up to a step.
pub fn even_times(times: &[f64]) -> Option<(Vec<f64>, f64)> {
    let mut intervals: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).filter(|dt| *dt > 0.0).collect();
    intervals.sort_by(f64::total_cmp);
    let median = *intervals.get(intervals.len() / 2)?;
    let (least, most) = (*intervals.first()?, *intervals.last()?);
    if most - least <= EVEN * median {
        return Some((times.to_vec(), median));
    }
    let (first, last) = (*times.first()?, *times.last()?);
    let count = ((last - first) / median * (1.0 + 1e-9)).floor();
    // A gap a million times the median is no sampling; what lies in it would fill the memory.
    let count = count.min(1e7) as usize;
    Some(((0..=count).map(|i| (first + i as f64 * median).min(last)).collect(), median))
}

/// Derivative with respect to time: of the parabola through each point and its two neighbours, of the line to the only
/// neighbour at the ends.
pub fn derivative(times: &[f64], values: &[f64]) -> Vec<f64> {
    let slope = |i: usize| (values[i + 1] - values[i]) / (times[i + 1] - times[i]);
    let last = times.len() - 1;
    let at = |i: usize| match i {
        0 => slope(0),
        i if i == last => slope(last - 1),
        i => {
            let (before, after) = (times[i] - times[i - 1], times[i + 1] - times[i]);
            (after * slope(i - 1) + before * slope(i)) / (before + after)
        }
    };
    if last == 0 { vec![f64::NAN] } else { (0..=last).map(at).collect() }
}

/// Integral over time from the first state, by trapezoids.
pub fn integral(times: &[f64], values: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let mut all = vec![0.0; times.len().min(1)];
    for (t, v) in times.windows(2).zip(values.windows(2)) {
        sum += 0.5 * (t[1] - t[0]) * (v[0] + v[1]);
        all.push(sum);
    }
    all
}

/// Integral over time from the first state of values that are means since the state before: their sum, each as many times
/// as its interval is long. The first state has no interval.
pub fn sum_of_means(times: &[f64], means: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let mut all = vec![0.0; times.len().min(1)];
    for (t, mean) in times.windows(2).zip(means.iter().skip(1)) {
        sum += (t[1] - t[0]) * mean;
        all.push(sum);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_on_uneven_times_has_its_slope_and_area() {
        let times = [0.0, 0.1, 0.25, 0.5, 0.6, 1.0];
        let values = times.map(|t| 3.0 * t * t - t);
        let found = derivative(&times, &values);
        for i in 1..5 {
            assert!((found[i] - (6.0 * times[i] - 1.0)).abs() < 1e-12);
        }
        let straight = times.map(|t| 2.0 * t + 1.0);
        for (area, t) in integral(&times, &straight).iter().zip(times) {
            assert!((area - (t * t + t)).abs() < 1e-15);
        }
    }

    #[test]
    fn means_add_up_to_what_has_changed() {
        let times = [0.0, 0.1, 0.25, 0.5, 0.6, 1.0];
        let velocity = times.map(|t: f64| (7.0 * t).sin());
        let change = |i: usize| (velocity[i] - velocity[i - 1]) / (times[i] - times[i - 1]);
        let means: Vec<f64> = (0..6).map(|i| if i == 0 { 99.0 } else { change(i) }).collect();
        let found = sum_of_means(&times, &means);
        assert!((0..6).all(|i| (found[i] - velocity[i]).abs() < 1e-15), "{found:?}");
        assert!(sum_of_means(&[], &[]).is_empty());
    }

    #[test]
    fn interpolation_ends_where_the_curve_does() {
        let (times, values) = ([1.0, 2.0, 4.0], [10.0, 20.0, 0.0]);
        assert_eq!([1.0, 1.5, 3.0, 4.0].map(|t| interpolate(&times, &values, t)), [10.0, 15.0, 10.0, 0.0]);
        assert!(interpolate(&times, &values, 0.9).is_nan() && interpolate(&times, &values, 4.1).is_nan());
    }

    #[test]
    fn times_near_asked_ones_become_even() {
        let times = [0.0, 1.01, 1.98, 3.0, 4.02, 4.5];
        let (even, interval) = even_times(&times).unwrap();
        assert!((0.97..=1.02).contains(&interval));
        assert!(even.windows(2).all(|pair| (pair[1] - pair[0] - interval).abs() < 1e-12) && even.len() == 5);
        assert_eq!(even_times(&[0.0, 0.5, 1.0]).unwrap(), (vec![0.0, 0.5, 1.0], 0.5));
        assert!(even_times(&[1.0]).is_none());
    }
}
