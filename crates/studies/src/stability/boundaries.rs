//! Where a quantity of one variable changes its sign: between samples of different signs, and beside extremes between samples of one sign.

use algebra::arrange::Arrange;
use algebra::golden::Section;

/// Halvings of an interval; each ends at neighbouring numbers.
const HALVINGS: usize = 80;
/// Steps of the search of an extreme, which shrink the interval by 0.62 each.
const STEPS: usize = 60;
/// An extreme must pass zero by this much, as a share of the larger of 1 and the samples about it: rounding of a trace.
const PASSES: f64 = 1e-9;

/// A change of sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Root {
    /// Where.
    pub(super) at: f64,
    /// Whether the quantity is positive above it.
    pub(super) rises: Side,
}

/// What becomes of a quantity at its root.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// It becomes positive.
    Rises,
    /// It becomes negative.
    Falls,
}

/// The roots between samples (x, f(x)) in ascending order. `smooth` quantities are sought between samples of one sign too.
///
/// # Errors
/// The quantity has no value.
pub(super) fn roots<E>(samples: &[(f64, f64)], smooth: Smooth, mut f: impl FnMut(f64) -> Result<f64, E>) -> Result<Vec<Root>, E> {
    let mut found = Vec::new();
    for (i, pair) in samples.windows(2).enumerate() {
        let ([a, b], sign) = ([pair[0], pair[1]], pair[0].1 > 0.0);
        let [here, back] = if sign { [Side::Falls, Side::Rises] } else { [Side::Rises, Side::Falls] };
        if sign != (b.1 > 0.0) {
            found.push(root((a.0, b.0), here, &mut f)?);
            continue;
        }
        // an extreme towards zero within the two intervals beside sample i + 1 is looked for once, at the sample
        let Some(next) = samples.get(i + 2).filter(|c| smooth == Smooth::Yes && (c.1 > 0.0) == sign) else { continue };
        if b.1.abs() > a.1.abs() || b.1.abs() > next.1.abs() {
            continue;
        }
        let towards = if sign { -1.0 } else { 1.0 };
        let beyond = PASSES * a.1.abs().max(next.1.abs()).max(1.0);
        let (x, value) = extreme((a.0, next.0), (towards, beyond), &mut f)?;
        if towards * value > beyond {
            found.push(root((a.0, x), here, &mut f)?);
            found.push(root((x, next.0), back, &mut f)?);
        }
    }
    found.arrange_by(|a, b| a.at.total_cmp(&b.at));
    Ok(found)
}

/// Gives samples of which the sign is rounding that of the known ones about them, where these agree: a quantity that only touches zero there has no roots.
pub(super) fn settled(samples: &mut [(f64, f64)], is_known: impl Fn(usize) -> bool) {
    let known: Vec<usize> = (0..samples.len()).filter(|k| is_known(*k)).collect();
    for pair in known.windows(2) {
        let positive = samples[pair[0]].1 > 0.0;
        if positive == (samples[pair[1]].1 > 0.0) {
            samples[pair[0] + 1..pair[1]].iter_mut().for_each(|s| s.1 = if positive { f64::MIN_POSITIVE } else { 0.0 });
        }
    }
}

/// Whether the quantity is a smooth function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Smooth {
    /// It is.
    Yes,
    /// Only its sign means something.
    No,
}

fn root<E>((mut low, mut high): (f64, f64), side: Side, f: &mut impl FnMut(f64) -> Result<f64, E>) -> Result<Root, E> {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        // some ten units of the last place: nothing more is to be halved
        if middle <= low || middle >= high || high - low <= 1e-14 * middle.abs() {
            break;
        }
        if (f(middle)? > 0.0) == (side == Side::Falls) { low = middle } else { high = middle }
    }
    Ok(Root { at: 0.5 * (low + high), rises: side })
}

/// Place and value of the largest `towards * f` between two places.
fn extreme<E>(ends: (f64, f64), (towards, beyond): (f64, f64), f: &mut impl FnMut(f64) -> Result<f64, E>) -> Result<(f64, f64), E> {
    let above = |a: &f64, b: &f64| towards * a > towards * b;
    let mut section = Section::new([ends.0, ends.1], &mut *f)?;
    for _ in 0..STEPS {
        // a value clearly beyond zero is all that is asked for
        if section.values.iter().any(|value| towards * value > beyond) || section.length() <= 1e-12 * section.ends[1].abs() {
            break;
        }
        section = section.narrowed(above, &mut *f)?;
    }
    Ok(section.best(above))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Some hundred roundings of numbers about 1.
    const EXACT: f64 = 1e-13;
    /// What roundings become in the steps of a period, or in the matrix of a collocation.
    const STEPS: f64 = 1e-11;

    fn found(f: impl Fn(f64) -> f64, count: usize, smooth: Smooth) -> Vec<Root> {
        let samples: Vec<(f64, f64)> = (0..=count).map(|k| k as f64 / count as f64).map(|x| (x, f(x))).collect();
        roots::<()>(&samples, smooth, |x| Ok(f(x))).unwrap()
    }

    #[test]
    fn narrow_bumps_between_samples_are_found() {
        // positive within 1e-3 of 0.337 only
        let f = |x: f64| 1e-6 - (x - 0.337) * (x - 0.337);
        let list = found(f, 10, Smooth::Yes);
        assert_eq!(list.len(), 2);
        assert!((list[0].at - 0.336).abs() < STEPS && list[0].rises == Side::Rises);
        assert!((list[1].at - 0.338).abs() < STEPS && list[1].rises == Side::Falls);
        assert!(found(f, 10, Smooth::No).is_empty());
        assert!(found(|x| -(x - 0.337) * (x - 0.337), 10, Smooth::Yes).is_empty(), "touching is no change of sign");
    }

    /// -(x - 0.4)² with rounding at the sample 0.4 that says 0.4 is above zero.
    #[test]
    fn touching_at_a_sample_is_no_change_of_sign() {
        let mut samples: Vec<(f64, f64)> = (0..=10).map(|k| f64::from(k) / 10.0).map(|x| (x, -(x - 0.4) * (x - 0.4))).collect();
        samples[4].1 = 4e-16;
        settled(&mut samples, |k| k != 4);
        assert!(roots::<()>(&samples, Smooth::Yes, |x| Ok(4e-16 - (x - 0.4) * (x - 0.4))).unwrap().is_empty());
    }

    #[test]
    fn changes_between_samples_are_located_to_rounding() {
        let list = found(|x| (20.0 * x).sin(), 40, Smooth::Yes);
        let pi = std::f64::consts::PI;
        // sin 0 is not positive: the first change is at the start
        let inner: Vec<f64> = list.iter().map(|r| r.at).filter(|x| *x > 0.05).collect();
        assert_eq!(inner.len(), 6);
        assert!(inner.iter().enumerate().all(|(k, x)| (x - (k + 1) as f64 * pi / 20.0).abs() < EXACT));
    }
}
