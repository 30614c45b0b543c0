//! What is done to the curves before they are drawn: difference, derivative, integral, filter, and what they are over.

use std::path::Path;

use super::PlotError;
use super::curve::Curve;
use super::filter::{Before, Class, ENOUGH_SAMPLES, filtered};
use super::options::PlotOptions;
use super::pick;
use super::run::Run;
use super::signal::{derivative, even_times, integral, interpolate, sum_of_means};

/// Works on all curves and returns what the user should know.
///
/// # Errors
/// When what is to be subtracted is not there, or there are too few states to work on.
pub fn on(curves: &mut [Curve], runs: &[Run], options: &PlotOptions) -> Result<Vec<String>, PlotError> {
    subtract(curves, runs, options)?;
    let mut warnings = Vec::new();
    for curve in curves.iter_mut() {
        if options.derive || options.integrate || options.filter.is_some() {
            without_ends(curve);
        }
        if options.derive {
            enough(curve)?;
            curve.y = derivative(&curve.x, &curve.y);
            curve.before = before_derivative(curve);
            curve.label = format!("d/dt {}", curve.label);
            curve.means = false;
        }
        if options.integrate {
            curve.y = if curve.means { sum_of_means(&curve.x, &curve.y) } else { integral(&curve.x, &curve.y) };
            curve.label = format!("integral of {}", curve.label);
            curve.means = false;
            // It begins with nothing.
            curve.before = Before::First;
        }
        if let Some(class) = options.filter {
            enough(curve)?;
            warnings.extend(filter(curve, class, options.second)?);
            curve.label = format!("{}, CFC{}", curve.label, class.hertz);
        }
        curve.y.iter_mut().for_each(|value| *value *= options.scale);
    }
    warnings.dedup();
    if let Some(name) = &options.over {
        for curve in curves.iter_mut() {
            let run = &runs[curve.run];
            let (values, _) = pick::one(run, name, options, curve.site)?;
            curve.x = curve.x.iter().map(|&time| interpolate(run.times(), &values, time)).collect();
        }
    }
    Ok(warnings)
}

/// Takes away what has no values before the first and behind the last: states of parts of a run that do not have the variable.
fn without_ends(curve: &mut Curve) {
    let Some(first) = curve.y.iter().position(|value| value.is_finite()) else { return };
    let behind = curve.y.iter().rposition(|value| value.is_finite()).map_or(first, |last| last + 1);
    if first > 0 {
        curve.before = Before::Unknown;
    }
    curve.x = curve.x[first..behind].to_vec();
    curve.y = curve.y[first..behind].to_vec();
}

/// What the derivative of a curve did before its first value: a velocity becomes an acceleration.
fn before_derivative(curve: &Curve) -> Before {
    let velocity = || ["VEL", "|VEL", "ROT", "|ROT"].iter().any(|stem| curve.label.starts_with(stem));
    match curve.before {
        Before::First if velocity() => Before::Slope,
        Before::First | Before::Steady | Before::Slope => Before::First,
        Before::Unknown => Before::Unknown,
    }
}

fn enough(curve: &Curve) -> Result<(), PlotError> {
    if curve.x.len() < 3 {
        let what = format!("it has {} states; that takes three at least", curve.x.len());
        return Err(PlotError::Work { curve: curve.label.clone(), what });
    }
    if curve.y.iter().any(|value| !value.is_finite()) {
        let what = "some of its values are not numbers".to_owned();
        return Err(PlotError::Work { curve: curve.label.clone(), what });
    }
    Ok(())
}

fn subtract(curves: &mut [Curve], runs: &[Run], options: &PlotOptions) -> Result<(), PlotError> {
    let Some(what) = &options.minus else { return Ok(()) };
    let path = Path::new(what);
    if !path.exists() {
        for curve in curves.iter_mut() {
            let (values, means) = pick::one(&runs[curve.run], what, options, curve.site)?;
            curve.means &= means;
            curve.y.iter_mut().zip(values).for_each(|(y, other)| *y -= other);
            curve.label = format!("{} − {}", curve.label, what.to_uppercase());
        }
        return Ok(());
    }
    let other = [Run::open(path)?];
    let theirs = pick::curves(&other, options)?.0;
    for curve in curves.iter_mut() {
        // Of those that are taken apart by elements, that of the same element.
        let same = |their: &&Curve| their.variable == curve.variable;
        let alike = theirs.iter().filter(same).find(|their| their.label == curve.label);
        let Some(their) = alike.or_else(|| theirs.iter().find(same)) else { continue };
        // Means over other intervals are others.
        curve.means &= their.means && their.x == curve.x;
        if their.before == Before::Unknown {
            curve.before = Before::Unknown;
        }
        let at = |time: &f64| interpolate(&their.x, &their.y, *time);
        let differences = curve.x.iter().zip(&curve.y).map(|(time, y)| y - at(time)).collect();
        curve.y = differences;
        curve.label = format!("{} − {}", curve.label, path.display());
    }
    // Outside the time that both have there is no difference.
    for curve in curves {
        let both: Vec<usize> = (0..curve.x.len()).filter(|&i| curve.y[i].is_finite()).collect();
        curve.x = both.iter().map(|&i| curve.x[i]).collect();
        curve.y = both.iter().map(|&i| curve.y[i]).collect();
    }
    Ok(())
}

/// Filters a curve on even times; says so when there are too few of them.
fn filter(curve: &mut Curve, class: Class, second: f64) -> Result<Option<String>, PlotError> {
    let wrong = |what: String| PlotError::Work { curve: curve.label.clone(), what };
    let (times, interval) = even_times(&curve.x).ok_or_else(|| wrong("its states are all at one time".to_owned()))?;
    let frequency = class.frequency(second);
    let samples = 1.0 / (frequency * interval);
    let wanted = 1.0 / (frequency * ENOUGH_SAMPLES);
    let hint = format!(
        "write states every {wanted:.2e} or more often (HISTORY TIME), or say with --second how long a second is"
    );
    let values: Vec<f64> = times.iter().map(|&time| interpolate(&curve.x, &curve.y, time)).collect();
    let class_name = format!("CFC{}", class.hertz);
    curve.y = filtered(&values, frequency, interval, curve.before).ok_or_else(|| {
        wrong(format!("states every {interval:.2e} are too far apart for {class_name}\n  help: {hint}"))
    })?;
    curve.x = times;
    // States are at the steps nearest to the times asked for: a little less than asked is as asked.
    Ok((samples < 0.99 * ENOUGH_SAMPLES).then(|| {
        format!(
            "{class_name} on {samples:.1} states a period, where {ENOUGH_SAMPLES} belong: what is above half their \
             rate is folded into the curve\n  help: {hint}"
        )
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(count: usize, interval: f64) -> Curve {
        let x: Vec<f64> = (0..count).map(|i| i as f64 * interval).collect();
        Curve::of("A", x, vec![1.0; count])
    }

    #[test]
    fn few_states_a_period_are_told() {
        let class = Class { hertz: 100.0 };
        assert_eq!(filter(&mut curve(100, 1e-3), class, 1.0).unwrap(), None);
        let told = filter(&mut curve(100, 1.25e-3), class, 1.0).unwrap().unwrap();
        assert!(told.contains("8.0 states a period") && told.contains("1.00e-3"), "{told}");
        // The same in milliseconds.
        assert!(filter(&mut curve(100, 1.25), class, 1000.0).unwrap().is_some());
        assert!(filter(&mut curve(100, 1.25), class, 1.0).is_err());
    }
}
