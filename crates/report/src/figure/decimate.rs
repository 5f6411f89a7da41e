//! Leaving out what a picture cannot show, so that peaks survive.

/// Indices of the points to keep for a curve over growing x: the last of all, and of each of `n_buckets` equal intervals of x the
/// first point, and the lowest and the highest of every curve. All curves share x, so one list serves them all. A break (not a number)
/// is kept once per bucket. At most `n_buckets · (1 + 3·curves) + 1` indices, ascending; short curves are kept whole.
pub fn buckets(x: &[f64], curves: &[&[f64]], n_buckets: usize) -> Vec<usize> {
    let n = curves.iter().fold(x.len(), |n, c| n.min(c.len()));
    if n_buckets == 0 || n <= n_buckets * (1 + 2 * curves.len()) {
        return (0..n).collect();
    }
    let finite = || x[..n].iter().copied().filter(|v| v.is_finite());
    let (low, high) = finite().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
    let bucket_of = |i: usize| (((x[i] - low) / (high - low) * n_buckets as f64) as usize).min(n_buckets - 1);
    let mut kept = Vec::new();
    let mut start = 0;
    while start < n {
        let bucket = bucket_of(start);
        let end = (start + 1..n).find(|&i| bucket_of(i) != bucket).unwrap_or(n);
        let from = kept.len();
        kept.push(start);
        if end == n {
            kept.push(n - 1);
        }
        for curve in curves {
            kept.extend(extremes(curve, start, end).into_iter().flatten());
        }
        kept[from..].sort_unstable();
        start = end;
    }
    kept.dedup();
    kept
}

/// Lowest, highest and first broken point of a curve in [start, end).
fn extremes(curve: &[f64], start: usize, end: usize) -> [Option<usize>; 3] {
    let (mut low, mut high, mut broken) = (None, None, None);
    for i in start..end {
        let v = curve[i];
        if !v.is_finite() {
            broken = broken.or(Some(i));
            continue;
        }
        if low.is_none_or(|l: usize| v < curve[l]) {
            low = Some(i);
        }
        if high.is_none_or(|h: usize| v > curve[h]) {
            high = Some(i);
        }
    }
    [low, high, broken]
}

/// Indices of the points to keep for a curve in a plane: a point goes if it is closer than the resolution to the last kept one,
/// unless it is an extreme of x or y. The resolution is a `1/n_cells` part of each range, doubled until at most `most` points stay.
pub fn plane(x: &[f64], y: &[f64], n_cells: usize, most: usize) -> Vec<usize> {
    let n = x.len().min(y.len());
    if n <= most.min(n_cells) {
        return (0..n).collect();
    }
    let always: Vec<usize> = [extremes(x, 0, n), extremes(y, 0, n)].into_iter().flatten().flatten().collect();
    let span = |v: &[f64]| match extremes(v, 0, n) {
        [Some(l), Some(h), _] if v[h] > v[l] => v[h] - v[l],
        _ => 1.0,
    };
    let (span_x, span_y) = (span(x), span(y));
    let mut resolution = 1.0 / n_cells.max(1) as f64;
    loop {
        let kept = thinned(n, |i| (x[i] / span_x, y[i] / span_y), resolution, &always);
        if kept.len() <= most.max(8) || resolution > 1.0 {
            return kept;
        }
        resolution *= 2.0;
    }
}

fn thinned(n: usize, point: impl Fn(usize) -> (f64, f64), resolution: f64, always: &[usize]) -> Vec<usize> {
    let mut kept: Vec<usize> = Vec::new();
    let mut broken = false;
    for i in 0..n {
        let (px, py) = point(i);
        let gap = !(px.is_finite() && py.is_finite());
        let near = match kept.last() {
            Some(&last) if !broken && !gap => {
                let (qx, qy) = point(last);
                (px - qx).abs().max((py - qy).abs()) < resolution
            }
            _ => false,
        };
        if !(near || gap && broken) || always.contains(&i) || i + 1 == n {
            kept.push(i);
            broken = gap;
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn extremes_and_ends_survive(y in prop::collection::vec(-1e6..1e6_f64, 1..3000), n_buckets in 1..80_usize) {
            let x: Vec<f64> = (0..y.len()).map(|i| (i as f64).powf(1.3)).collect();
            let kept = buckets(&x, &[&y], n_buckets);
            let of = |indices: &[usize]| indices.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &i| (l.min(y[i]), h.max(y[i])));
            let all: Vec<usize> = (0..y.len()).collect();
            prop_assert_eq!(of(&kept), of(&all));
            prop_assert!(kept.windows(2).all(|w| w[0] < w[1]));
            prop_assert_eq!((kept.first(), kept.last()), (Some(&0), Some(&(y.len() - 1))));
            prop_assert!(kept.len() <= n_buckets * 5 || kept.len() == y.len());
        }

        #[test]
        fn extremes_of_a_trajectory_survive(points in prop::collection::vec((-1e3..1e3_f64, -1.0..1.0_f64), 1..2000)) {
            let (x, y): (Vec<f64>, Vec<f64>) = points.into_iter().unzip();
            let kept = plane(&x, &y, 50, 100);
            for v in [&x, &y] {
                let high = v.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                prop_assert!(kept.iter().any(|&i| v[i] == high));
            }
            prop_assert!(kept.windows(2).all(|w| w[0] < w[1]));
        }
    }

    #[test]
    fn a_spike_of_one_sample_survives() {
        let x: Vec<f64> = (0..100_000).map(|i| i as f64 * 1e-3).collect();
        let mut y = vec![0.0; x.len()];
        y[54_321] = 1.0;
        let kept = buckets(&x, &[&y], 700);
        assert!(kept.contains(&54_321) && kept.len() < 3600);
    }

    #[test]
    fn breaks_survive_and_constants_do_not_hang() {
        let x = vec![1.0; 5000];
        let mut y = vec![2.0; 5000];
        y[77] = f64::NAN;
        assert!(buckets(&x, &[&y], 10).contains(&77));
        assert!(plane(&x, &y, 100, 500).contains(&77));
    }
}
