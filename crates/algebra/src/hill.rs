//! Hill's equation y'' + ψ(t) y = 0, ψ of period T and smooth: its monodromy matrix by Taylor steps of its Fourier form.
//!
//! ```text
//! ψ(t) = m + Σ c_k cos kωt + s_k sin kωt,   ω = 2π/T
//! (j+1)(j+2) y_(j+2) = -Σ_i ψ_i y_(j-i)     Taylor coefficients of a step; those of ψ are exact
//! ```
//!
//! The matrix has the determinant 1 (Liouville), which no step knows of. *Source*: W. Magnus, S. Winkler, Hill's Equation, 1966, ch. I.

use crate::elementary;
use crate::lanes;
use std::f64::consts::TAU;

/// Coefficients of a step.
const ORDER: usize = 32;
/// Length of a step times the fastest rate in the equation. Coefficients of y are those of a function of ψ's terms, and fall more slowly than the powers over
/// factorials of these: at 2.1 the trace of Mathieu's equation errs by 2e-10, at 1.5 by 1e-13, here by rounding.
const REACH: f64 = 1.25;
/// Samples of a period: the first number tried, and the last.
const FEWEST: usize = 32;
const MOST: usize = 4096;
/// Share of the largest harmonic below which one is not there.
const ABSENT: f64 = 1e-12;
/// Share of the largest harmonic that the last quarter of them must not exceed: rounding of samples.
const FADED: f64 = 1e-14;

/// ψ as a Fourier series.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hill {
    /// T.
    pub period: f64,
    /// m.
    pub mean: f64,
    /// [c_k, s_k], k = 1, 2, ...
    pub waves: Vec<[f64; 2]>,
}

/// What a period does to (y, y').
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Monodromy {
    /// y₁(T), y₂(T), y₁'(T), y₂'(T).
    pub entries: [f64; 4],
}

impl Monodromy {
    /// y₁(T) + y₂'(T).
    pub fn trace(&self) -> f64 {
        self.entries[0] + self.entries[3]
    }
    /// 1, as far as the steps are right.
    pub fn determinant(&self) -> f64 {
        self.entries[0] * self.entries[3] - self.entries[1] * self.entries[2]
    }
}

impl Hill {
    /// The Fourier series of a function of period T; none where its harmonics do not fade by 2048 of them (it jumps, or has kinks), or where it has no value.
    pub fn of(period: f64, mut value: impl FnMut(f64) -> Option<f64>) -> Option<Hill> {
        let mut samples: Vec<f64> = (0..FEWEST).map(|i| value(period * i as f64 / FEWEST as f64)).collect::<Option<_>>()?;
        loop {
            if let Some(faded) = Hill::of_samples(period, &samples)?.faded(FADED) {
                return Some(faded);
            }
            let count = samples.len();
            if count >= MOST {
                return None;
            }
            let mut finer = Vec::with_capacity(2 * count);
            for (i, sample) in samples.into_iter().enumerate() {
                finer.push(sample);
                finer.push(value(period * (2 * i + 1) as f64 / (2 * count) as f64)?);
            }
            samples = finer;
        }
    }

    /// The trigonometric polynomial through equally spaced samples of a period; none where one of them is no number.
    pub fn of_samples(period: f64, samples: &[f64]) -> Option<Hill> {
        if samples.iter().any(|v| !v.is_finite()) {
            return None;
        }
        let n = samples.len();
        let turns: Vec<(f64, f64)> = (0..n).map(|i| elementary::sin_cos(TAU * i as f64 / n as f64)).collect();
        let share = 2.0 / n as f64;
        let wave = |k: usize| {
            let sums = samples.iter().enumerate().fold([0.0, 0.0], |[c, s], (i, v)| {
                let (sin, cos) = turns[i * k % n];
                [c + v * cos, s + v * sin]
            });
            sums.map(|sum| sum * share)
        };
        Some(Hill { period, mean: samples.iter().sum::<f64>() / n as f64, waves: (1..n.div_ceil(2)).map(wave).collect() })
    }

    /// The series without harmonics below a share of the largest; none where one of the last quarter is above it.
    pub fn faded(mut self, share: f64) -> Option<Hill> {
        let size = |w: &[f64; 2]| w[0].abs().max(w[1].abs());
        let largest = self.waves.iter().map(size).fold(self.mean.abs(), f64::max);
        let kept = self.waves.iter().rposition(|w| size(w) > share * largest).map_or(0, |k| k + 1);
        if kept > self.waves.len() * 3 / 4 {
            return None;
        }
        self.waves.truncate(kept);
        Some(self)
    }

    /// ψ at t.
    pub fn value(&self, t: f64) -> f64 {
        let turn = TAU * t / self.period;
        let wave = |(k, [c, s]): (usize, &[f64; 2])| {
            let (sin, cos) = elementary::sin_cos((k + 1) as f64 * turn);
            c * cos + s * sin
        };
        self.mean + self.waves.iter().enumerate().map(wave).sum::<f64>()
    }

    /// Least and greatest value of ψ: the extremes of a fine grid, moved to where the slope vanishes.
    pub fn extremes(&self) -> [f64; 2] {
        let count = 16 * (self.waves.len() + 1);
        let step = self.period / count as f64;
        let turns: Vec<(f64, f64)> = (0..count).map(|i| elementary::sin_cos(TAU * i as f64 / count as f64)).collect();
        let wave = |i: usize, k: usize, [c, s]: &[f64; 2]| {
            let (sin, cos) = turns[i * (k + 1) % count];
            c * cos + s * sin
        };
        let on_grid = |i: usize| self.mean + self.waves.iter().enumerate().map(|(k, w)| wave(i, k, w)).sum::<f64>();
        let grid: Vec<f64> = (0..count).map(on_grid).collect();
        [-1.0, 1.0].map(|sign| {
            let best = (0..count).max_by(|a, b| (sign * grid[*a]).total_cmp(&(sign * grid[*b]))).unwrap_or(0);
            let (mut low, mut high) = ((best as f64 - 1.0) * step, (best as f64 + 1.0) * step);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if sign * self.slope(middle) > 0.0 { low = middle } else { high = middle }
            }
            let found = self.value(0.5 * (low + high));
            if sign * found > sign * grid[best] { found } else { grid[best] }
        })
    }

    /// ψ'(t).
    pub fn slope(&self, t: f64) -> f64 {
        let omega = TAU / self.period;
        let wave = |(k, [c, s]): (usize, &[f64; 2])| {
            let rate = (k + 1) as f64 * omega;
            let (sin, cos) = elementary::sin_cos(rate * t);
            rate * (s * cos - c * sin)
        };
        self.waves.iter().enumerate().map(wave).sum()
    }

    /// The same function over its least period, where its harmonics are all multiples of one: how many of these a period of `self` holds.
    pub fn least(&self) -> (Hill, usize) {
        let size = |w: &[f64; 2]| w[0].abs().max(w[1].abs());
        let largest = self.waves.iter().map(size).fold(0.0, f64::max);
        let there = |k: &usize| largest > 0.0 && size(&self.waves[k - 1]) > ABSENT * largest;
        let common = (1..=self.waves.len()).filter(there).fold(0, greatest_common).max(1);
        let waves = self.waves.iter().skip(common - 1).step_by(common).copied().collect();
        (Hill { period: self.period / common as f64, mean: self.mean, waves }, common)
    }

    /// The monodromy matrix. Its error is some 1e-14 of its largest entry, with harmonics that are known to it.
    pub fn monodromy(&self) -> Monodromy {
        let mut state = [[1.0, 0.0], [0.0, 1.0]];
        if self.is_even() {
            self.walk_over(0.5 * self.period, |_, psi, h| state = both(psi, state, h));
            return of_half(state);
        }
        self.walk(|_, psi, h| state = both(psi, state, h));
        let [[y1, r1], [y2, r2]] = state;
        Monodromy { entries: [y1, y2, r1, r2] }
    }

    /// Whether ψ(-t) = ψ(t): a series of cosines.
    fn is_even(&self) -> bool {
        self.waves.iter().all(|[_, s]| *s == 0.0)
    }

    /// Which tongue of instability the equation lies in: n, where the solution that grows has n zeros in a period; none where no solution grows.
    ///
    /// For y'' + (a + b p(t)) y = 0 it is the n-th tongue by a whatever b is, n = 0 below the first boundary; where b is small it opens at √a T = nπ. A step is shorter than a half wave, so
    /// that it holds one zero at most (Sturm). *Source*: W. Magnus, S. Winkler, Hill's Equation, 1966, theorem 2.1; E. A. Coddington, N. Levinson, 1955, ch. 8.
    pub fn tongue(&self) -> Option<usize> {
        let whole = self.monodromy();
        let half = 0.5 * whole.trace();
        if !half.is_finite() || half.abs() <= 1.0 {
            return None;
        }
        let multiplier = half + half.signum() * (half * half - 1.0).sqrt();
        let [a, b, c, d] = whole.entries;
        // of two forms of the eigenvector the longer one: a column of M - 1/μ, which has rank one
        let (first, second) = ([b, multiplier - a], [multiplier - d, c]);
        let length = |[y, rate]: [f64; 2]| elementary::hypot(y, rate);
        let mut state = if length(first) >= length(second) { first } else { second };
        let positive = state[0] >= 0.0;
        let (mut before, mut zeros) = (positive, 0);
        let mut count = |now: bool| {
            zeros += usize::from(now != before);
            before = now;
        };
        self.walk(|last, psi, h| {
            state = step(psi, state, h);
            // after a period the solution is itself times its multiplier, whatever rounding says of a zero there
            count(if last { positive == (multiplier > 0.0) } else { state[0] >= 0.0 });
        });
        Some(zeros)
    }

    /// How often the solution with y = 1, y' = 0 at the start changes its sign in so many periods. Where |tr M| < 2 solutions turn by π(n + θ), 0 < θ < 1, in a period on the average; where
    /// tr M = 0, M² = -1, and every solution has 2n + 1 zeros in two periods (Sturm).
    pub fn zeros(&self, periods: usize) -> usize {
        let (mut state, mut zeros) = ([1.0, 0.0], 0);
        for _ in 0..periods {
            self.walk(|_, psi, h| {
                let before = state[0] >= 0.0;
                state = step(psi, state, h);
                zeros += usize::from(before != (state[0] >= 0.0));
            });
        }
        zeros
    }

    /// Over the steps of a period: whether it is the last one, ψ_j h^(j+2), and h.
    fn walk(&self, go: impl FnMut(bool, &[f64; ORDER], f64)) {
        self.walk_over(self.period, go);
    }

    /// The same over a time from 0 on.
    fn walk_over(&self, time: f64, mut go: impl FnMut(bool, &[f64; ORDER], f64)) {
        let omega = TAU / self.period;
        let amplitude = |[c, s]: &[f64; 2]| c.abs() + s.abs();
        let size: f64 = self.mean.abs() + self.waves.iter().map(amplitude).sum::<f64>();
        // a harmonic of a small share counts by the root that its share has in the last coefficient
        let rate = |(k, w): (usize, &[f64; 2])| {
            (k + 1) as f64 * omega * elementary::pow(amplitude(w) / size.max(f64::MIN_POSITIVE), 1.0 / ORDER as f64)
        };
        let fastest = self.waves.iter().enumerate().map(rate).fold(size.sqrt(), f64::max);
        let steps = (time * fastest / REACH).ceil().max(1.0);
        let h = time / steps;
        // h^(j+2) (kω)^j / j! of each harmonic, the same in all steps
        let scales = |k: usize| {
            let rate = (k + 1) as f64 * omega;
            let mut scale = h * h;
            std::array::from_fn(|j| {
                let own = scale;
                scale *= rate * h / (j + 1) as f64;
                own
            })
        };
        let scales: Vec<[f64; ORDER]> = (0..self.waves.len()).map(scales).collect();
        let mut psi = [0.0; ORDER];
        for i in 0..steps as usize {
            self.expand(time * i as f64 / steps, (h, &scales), &mut psi);
            go(i + 1 == steps as usize, &psi, h);
        }
    }

    /// ψ_j h^(j+2) about t.
    fn expand(&self, t: f64, (h, scales): (f64, &[[f64; ORDER]]), psi: &mut [f64; ORDER]) {
        psi.fill(0.0);
        psi[0] = self.mean * h * h;
        let omega = TAU / self.period;
        for ((k, [c, s]), scales) in self.waves.iter().enumerate().zip(scales) {
            let (sin, cos) = elementary::sin_cos((k + 1) as f64 * omega * t);
            // value and derivative by the angle; each further derivative turns by a quarter
            let (now, next) = (c * cos + s * sin, s * cos - c * sin);
            for (psi, scales) in psi.chunks_exact_mut(4).zip(scales.chunks_exact(4)) {
                psi[0] += scales[0] * now;
                psi[1] += scales[1] * next;
                psi[2] -= scales[2] * now;
                psi[3] -= scales[3] * next;
            }
        }
    }
}

fn greatest_common(mut a: usize, mut b: usize) -> usize {
    while b > 0 {
        (a, b) = (b, a % b);
    }
    a
}

/// The matrix of a period of an even ψ from y₁, y₁' and y₂, y₂' after half of it: backwards from T the solutions are those forwards from 0, y₁ even about both ends of the half and y₂ odd.
///
/// ```text
/// y₁(T) = y₂'(T) = y₁y₂' + y₂y₁'     y₂(T) = 2 y₂y₂'     y₁'(T) = 2 y₁y₁'     at T/2
/// ```
///
/// *Source*: W. Magnus, S. Winkler, Hill's Equation, 1966, ch. I, theorem 1.1.
fn of_half([[y1, r1], [y2, r2]]: [[f64; 2]; 2]) -> Monodromy {
    let half = y1 * r2 + y2 * r1;
    Monodromy { entries: [half, 2.0 * y2 * r2, 2.0 * y1 * r1, half] }
}

/// Two solutions at the end of a step.
fn both(psi: &[f64; ORDER], states: [[f64; 2]; 2], h: f64) -> [[f64; 2]; 2] {
    let [mut first, mut second] = states.map(|state| Backwards::new(state, h));
    for j in 0..ORDER {
        let [a, b] = lanes::products(Backwards::factors(psi, j), [first.up_to(j), second.up_to(j)]);
        first.push(j, a);
        second.push(j, b);
    }
    [first.end(h), second.end(h)]
}

/// (y, y') at the end of a step.
fn step(psi: &[f64; ORDER], state: [f64; 2], h: f64) -> [f64; 2] {
    let mut c = Backwards::new(state, h);
    for j in 0..ORDER {
        c.push(j, lanes::product(Backwards::factors(psi, j), c.up_to(j)));
    }
    c.end(h)
}

/// Numbers of a vector: what is left of a sum beyond them is filled up with zeros.
const GROUP: usize = 4;

/// Coefficients of y over a step from the last one to the first, so that Σ ψ_i y_(j-i) is a product of two runs; zeros behind the first.
struct Backwards([f64; ORDER + 1 + GROUP]);

impl Backwards {
    /// Of y, y'h, ...
    fn new([y, rate]: [f64; 2], h: f64) -> Backwards {
        let mut all = [0.0; ORDER + 1 + GROUP];
        (all[ORDER + 1], all[ORDER]) = (y, rate * h);
        Backwards(all)
    }

    /// ψ_0 ... ψ_j, to whole groups.
    fn factors(psi: &[f64; ORDER], j: usize) -> &[f64] {
        &psi[..(j + 1).next_multiple_of(GROUP)]
    }

    /// y_j ... y_0, to whole groups.
    fn up_to(&self, j: usize) -> &[f64] {
        let first = ORDER + 1 - j;
        &self.0[first..first + (j + 1).next_multiple_of(GROUP)]
    }

    /// y_(j+2) from the sum.
    fn push(&mut self, j: usize, sum: f64) {
        if let Some(place) = (ORDER - 1).checked_sub(j) {
            self.0[place] = -sum / ((j + 1) * (j + 2)) as f64;
        }
    }

    /// y and y' at the end, the smallest terms first.
    fn end(&self, h: f64) -> [f64; 2] {
        let known = &self.0[..=ORDER + 1];
        let slope: f64 = known.iter().enumerate().map(|(place, c)| (ORDER + 1 - place) as f64 * c).sum();
        [known.iter().sum(), slope / h]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Some hundred roundings of numbers about 1.
    const EXACT: f64 = 1e-13;
    /// What roundings become in the steps of a period, or in the matrix of a collocation.
    const STEPS: f64 = 1e-11;

    /// Constant ψ: trace 2 cos kT; negative: 2 cosh kT.
    #[test]
    fn constant_coefficients_have_closed_traces() {
        for (k, period) in [(0.3, 1.0), (2.0, 7.0), (40.0, 3.0)] {
            let trace = |mean| Hill { period, mean, waves: Vec::new() }.monodromy().trace();
            assert!((trace(k * k) - 2.0 * elementary::cos(k * period)).abs() < STEPS * (1.0 + k * period), "{k}");
            let growing = 2.0 * elementary::cosh(k * period);
            assert!((trace(-k * k) / growing - 1.0).abs() < STEPS * (1.0 + k * period), "{k}");
        }
    }

    /// y = exp(∫u) solves Hill's equation with ψ = -u' - u²: for u = ε cos t it has period 2π and the multiplier 1, so that the trace is 2.
    #[test]
    fn a_solution_made_beforehand_gives_the_trace_two() {
        for eps in [0.1, 1.0, 3.0] {
            let hill = Hill::of(TAU, |t| {
                let (sin, cos) = elementary::sin_cos(t);
                Some(eps * sin - eps * eps * cos * cos)
            });
            let whole = hill.unwrap().monodromy();
            let largest = whole.entries.iter().fold(1.0_f64, |l, v| l.max(v.abs()));
            assert!((whole.trace() - 2.0).abs() < EXACT * largest, "{eps}: {}", whole.trace());
            assert!((whole.determinant() - 1.0).abs() < EXACT * largest, "{eps}");
        }
    }

    /// An even ψ is solved over half a period: the matrix is that of steps over the whole one, and with another start, where sines come in, the trace is the same.
    #[test]
    fn half_a_period_of_an_even_function_is_enough() {
        for (mean, waves) in [(1.3, vec![[-2.0, 0.0], [0.4, 0.0]]), (-0.7, vec![[1.0, 0.0]]), (40.0, vec![[0.0, 0.0], [9.0, 0.0]])] {
            let hill = Hill { period: 3.0, mean, waves };
            let found = hill.monodromy();
            let mut state = [[1.0, 0.0], [0.0, 1.0]];
            hill.walk(|_, psi, h| state = state.map(|y| step(psi, y, h)));
            let [[y1, r1], [y2, r2]] = state;
            let largest = found.entries.iter().fold(1.0_f64, |l, v| l.max(v.abs()));
            for (own, whole) in found.entries.into_iter().zip([y1, y2, r1, r2]) {
                assert!((own - whole).abs() < EXACT * largest, "{own} {whole}");
            }
            let turned = |(k, [c, _]): (usize, &[f64; 2])| {
                let (sin, cos) = elementary::sin_cos((k + 1) as f64 * 0.9);
                [c * cos, c * sin]
            };
            let late = Hill { waves: hill.waves.iter().enumerate().map(turned).collect(), ..hill.clone() };
            assert!((late.monodromy().trace() - found.trace()).abs() < EXACT * largest);
            assert!((found.determinant() - 1.0).abs() < EXACT * largest * largest);
        }
    }

    /// y'' + (a - 2q cos 2t) y = 0: the tongues lie between a_n and b_n of DLMF 28 (q = 1: a₀ = -0.455, b₁ = -0.110, a₁ = 1.859, b₂ = 3.917, a₂ = 4.371; q = 5: b₂ = 2.099,
    /// a₂ = 7.449, b₃ = 9.236, a₃ = 11.549), and over two periods a tongue is numbered by twice as many zeros.
    #[test]
    fn tongues_are_numbered_by_zeros() {
        let mathieu = |a: f64, q: f64, times: usize| {
            let mut waves = vec![[0.0; 2]; times];
            waves[times - 1] = [-2.0 * q, 0.0];
            Hill { period: std::f64::consts::PI * times as f64, mean: a, waves }.tongue()
        };
        for (a, q, n) in [
            (-0.6, 1.0, Some(0)),
            (-0.3, 1.0, None),
            (1.0, 1.0, Some(1)),
            (3.0, 1.0, None),
            (4.1, 1.0, Some(2)),
            (5.0, 5.0, Some(2)),
            (10.0, 5.0, Some(3)),
        ] {
            assert_eq!(mathieu(a, q, 1), n, "{a} {q}");
            assert_eq!(mathieu(a, q, 2), n.map(|n| 2 * n), "{a} {q} over two periods");
        }
        // where the period begins does not matter
        for turn in [0.3, 1.1, 2.0, 2.9] {
            let (sin, cos) = elementary::sin_cos(turn);
            let hill = Hill { period: std::f64::consts::PI, mean: 5.0, waves: vec![[-10.0 * cos, -10.0 * sin]] };
            assert_eq!(hill.tongue(), Some(2), "{turn}");
        }
    }

    /// cos kt changes its sign at odd multiples of π/2k: 2n + 1 times in two periods π where cos kπ = 0, k = n + 1/2; cosh kt never does.
    #[test]
    fn zeros_are_counted_over_periods() {
        for n in 0..7_u32 {
            let k = f64::from(n) + 0.5;
            assert_eq!(Hill { period: std::f64::consts::PI, mean: k * k, waves: Vec::new() }.zeros(2), 2 * n as usize + 1);
        }
        assert_eq!(Hill { period: 3.0, mean: -2.0, waves: vec![[0.3, 0.0]] }.zeros(2), 0);
    }

    #[test]
    fn extremes_and_least_periods_are_those_of_the_function() {
        let hill = Hill { period: 3.0, mean: 2.0, waves: vec![[0.0; 2], [0.3, 0.4], [0.0; 2], [0.0; 2]] };
        let [low, high] = hill.extremes();
        assert!((low - 1.5).abs() < EXACT && (high - 2.5).abs() < EXACT, "{low} {high}");
        let (least, times) = hill.least();
        assert_eq!((least.period, times, &least.waves[..]), (1.5, 2, &[[0.3, 0.4], [0.0; 2]][..]));
        let twice = least.monodromy().trace();
        // M² has the trace (tr M)² - 2 det M
        assert!((hill.monodromy().trace() - (twice * twice - 2.0)).abs() < EXACT);
    }

    #[test]
    fn jumps_are_no_fourier_series() {
        assert!(Hill::of(1.0, |t| Some(if t < 0.3 { 1.0 } else { 2.0 })).is_none());
        assert!(Hill::of(1.0, |t| if t < 0.3 { Some(1.0) } else { None }).is_none());
        let hill = Hill::of(2.0, |t| Some(1.0 / (1.2 + elementary::cos(TAU * t / 2.0)))).unwrap();
        assert!((hill.value(0.37) - 1.0 / (1.2 + elementary::cos(TAU * 0.37 / 2.0))).abs() < EXACT);
    }
}
