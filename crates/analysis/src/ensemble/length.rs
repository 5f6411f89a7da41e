//! The length of a step in all lanes: the rule of `integrate::taylor` at a fixed order, since an order that followed one motion would be that of its neighbours.

use crate::integrate::UNIT_SHARE;
use crate::integrate::taylor::{ROUNDING, SEARCHES, groups, limits, order_for};
use algebra::elementary;
use algebra::simd::{Lanes, Simd, Work, dispatch, largest as widest, largest_term, over, roots, scaled, times};
use program::ensemble::{Ensemble, LANES};

/// Tolerance, order and the numbers that follow from them.
#[derive(Clone, Debug)]
pub(crate) struct Lengths {
    pub(super) tolerance: f64,
    pub(super) order: usize,
    /// Halves the truncation error.
    safety: f64,
    /// tol^(1/p).
    root: f64,
    /// Reciprocals of tol^(k/p) 4^(p-k), which the terms before the last two may reach.
    per_bounds: Vec<f64>,
    /// Index of the group with its unit, of each state.
    group: Vec<usize>,
    /// Largest change of each group.
    largest: Vec<Lanes>,
    /// A_i of the last call.
    pub(super) scale: Vec<Lanes>,
    powers: Vec<Lanes>,
}

impl Lengths {
    pub(super) fn new(tolerance: f64, units: &[&str]) -> Lengths {
        let order = order_for(tolerance);
        let (group, count) = groups(units);
        let (safety, root, bounds) = limits(tolerance, order);
        Lengths {
            per_bounds: bounds.iter().map(|bound| 1.0 / bound).collect(),
            tolerance,
            order,
            safety,
            root,
            scale: vec![[0.0; LANES]; group.len()],
            largest: vec![[0.0; LANES]; count],
            group,
            powers: vec![[1.0; LANES]; order + 1],
        }
    }

    /// Longest admissible steps, at most `limits`; a lane that is not `busy` has none.
    pub(super) fn lengths(&mut self, series: &Ensemble, guesses: &Lanes, limits: &Lanes, busy: &[bool; LANES]) -> Lanes {
        let mut open = *busy;
        let mut h: Lanes = std::array::from_fn(|lane| guesses[lane].min(limits[lane]));
        for _ in 0..SEARCHES {
            let factors = dispatch(Growth { rule: self, series, h: &h });
            for lane in 0..LANES {
                if open[lane] {
                    let next = (h[lane] * factors[lane]).min(limits[lane]);
                    open[lane] = !(next <= 1.02 * h[lane] && next >= 0.98 * h[lane]) && next > 0.0;
                    h[lane] = next;
                }
            }
            if open == [false; LANES] {
                break;
            }
        }
        // the scales of a lane are those of its length, however long its neighbours were sought
        dispatch(Growth { rule: self, series, h: &h });
        let exceeds = dispatch(Excess { rule: self, series });
        for lane in (0..LANES).filter(|lane| busy[*lane] && exceeds[*lane]) {
            h[lane] = self.shortened(series, lane, h[lane]);
        }
        h
    }

    /// Shorter until no earlier term of a lane exceeds the majorant.
    #[inline(never)]
    fn shortened(&mut self, series: &Ensemble, lane: usize, mut h: f64) -> f64 {
        for _ in 0..SEARCHES {
            let Some(factor) = self.excess_of(series, lane) else { break };
            h *= factor;
            let kept: Vec<Lanes> = self.scale.clone();
            let powers = self.powers.clone();
            dispatch(Growth { rule: self, series, h: &[h; LANES] });
            // the scales of the others are those of their own steps
            for (scale, kept) in self.scale.iter_mut().zip(kept).chain(self.powers.iter_mut().zip(powers)) {
                let own = scale[lane];
                *scale = kept;
                scale[lane] = own;
            }
        }
        h
    }

    fn excess_of(&self, series: &Ensemble, lane: usize) -> Option<f64> {
        let p = self.order;
        let first = (p - p / 4 - 1).max(p / 2 + 1);
        let mut worst: Option<f64> = None;
        for (i, scale) in self.scale.iter().enumerate() {
            let (c, a) = (series.state(i), scale[lane]);
            for (k, c_k) in c.iter().enumerate().take(p - 1).skip(first) {
                let term = c_k[lane].abs() * self.powers[k][lane];
                if term * self.per_bounds[k] > a {
                    let ratio = term / (elementary::powi(self.root, k as i32) * a);
                    // once more with a step that is shorter for sure, and not by more than three decades at once
                    let factor = elementary::pow(ratio, -1.0 / k as f64).clamp(1e-3, 0.9);
                    worst = Some(worst.map_or(factor, |w| w.min(factor)));
                }
            }
        }
        worst
    }
}

/// The factors by which steps may grow; leaves scales and powers of these steps.
struct Growth<'a> {
    rule: &'a mut Lengths,
    series: &'a Ensemble,
    h: &'a Lanes,
}

impl Work for Growth<'_> {
    type Output = Lanes;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Lanes {
        let Growth { rule, series, h } = self;
        let p = rule.order;
        for k in 1..rule.powers.len() {
            rule.powers[k] = times(simd, &rule.powers[k - 1], h);
        }
        scales(simd, rule, series);
        let (mut before, mut last) = ([0.0; LANES], [0.0; LANES]);
        for (i, a) in rule.scale.iter().enumerate() {
            let c = series.state(i);
            for (most, k) in [(&mut before, p - 1), (&mut last, p)] {
                let share = over(simd, &times(simd, &c[k], &rule.powers[k]), a);
                *most = widest(simd, most, &share);
            }
        }
        let (first, second) = (roots(simd, &before, (p - 1) as f64), roots(simd, &last, p as f64));
        let mut factors = [0.0; LANES];
        for lane in 0..LANES {
            let factor = first[lane].min(second[lane]) * rule.root;
            // a guess far too long can overflow: come back by decades
            factors[lane] = if before[lane] < f64::INFINITY && last[lane] < f64::INFINITY { (factor * rule.safety).min(1e3) } else { 1e-3 };
        }
        factors
    }
}

/// A_i(h).
#[inline(always)]
fn scales<S: Simd>(simd: S, rule: &mut Lengths, series: &Ensemble) {
    let p = rule.order;
    let Lengths { scale, powers, largest: most, group, tolerance, .. } = rule;
    most.fill([0.0; LANES]);
    for ((i, scale), group) in scale.iter_mut().enumerate().zip(group.iter()) {
        let c = series.state(i);
        *scale = largest_term(simd, &c[1..=p / 2], &powers[1..=p / 2]);
        if scale.contains(&0.0) {
            let far = largest_term(simd, &c[p / 2 + 1..=p - 2], &powers[p / 2 + 1..=p - 2]);
            (0..LANES).for_each(|lane| scale[lane] = if scale[lane] == 0.0 { far[lane] } else { scale[lane] });
        }
        most[*group] = widest(simd, &most[*group], scale);
    }
    for ((i, scale), group) in scale.iter_mut().enumerate().zip(group.iter()) {
        let floor = widest(simd, &scaled(simd, UNIT_SHARE, &most[*group]), &scaled(simd, ROUNDING / *tolerance, &series.state(i)[0]));
        // a state that does not move allows any step
        *scale = widest(simd, &widest(simd, &[f64::MIN_POSITIVE; LANES], &floor), scale);
    }
}

/// Lanes in which an earlier term exceeds the majorant of the steps last looked at.
struct Excess<'a> {
    rule: &'a Lengths,
    series: &'a Ensemble,
}

impl Work for Excess<'_> {
    type Output = [bool; LANES];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> [bool; LANES] {
        let Excess { rule, series } = self;
        let p = rule.order;
        let first = (p - p / 4 - 1).max(p / 2 + 1);
        let mut found = [false; LANES];
        for (i, a) in rule.scale.iter().enumerate() {
            let c = series.state(i);
            // max |c_k| h^k / bound_k
            let mut most = [0.0; LANES];
            for (k, c_k) in c.iter().enumerate().take(p - 1).skip(first) {
                most = widest(simd, &most, &scaled(simd, rule.per_bounds[k], &times(simd, c_k, &rule.powers[k])));
            }
            (0..LANES).for_each(|lane| found[lane] |= most[lane] > a[lane]);
        }
        found
    }
}
