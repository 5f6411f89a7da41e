//! A turn at a given speed: the motion of the rest that repeats after it, by trigonometric collocation, and its moments.
//!
//! *Source*: L. N. Trefethen, Spectral Methods in MATLAB, 2000, ch. 3.

use algebra::elementary;
use algebra::golden::Section;
use algebra::lu::Lu;
use std::f64::consts::TAU;

/// Instants of a turn that are tried, odd; two that follow one another must agree.
pub(super) const INSTANTS: [usize; 4] = [17, 33, 65, 129];
/// By how much of the largest moment they may differ.
const AGREE: f64 = 1e-10;
/// Share of the moments that is left where they balance: a narrow resonance, a millionth of its speed wide, turns the rounding of a speed into 1e-10 of them.
pub(super) const MET: f64 = 1e-6;
/// Share of the greatest moment of a turn below which a difference of means is rounding: some thousand of them.
pub(super) const ROUNDING: f64 = 1e-13;
/// Newton's steps.
const STEPS: usize = 40;
/// Share of the largest value of the rest below which a step is rounding of the matrices of derivatives.
const STILL: f64 = 1e-12;

/// Share of the values above which a step that has ended to fall is no rounding: where the damping is 1e-9 of the critical one, rounding of the equations moves the answer by that much.
const MOVED: f64 = 1e-6;
/// Share of the step before above which a step has ended to fall.
const FALLS: f64 = 0.25;
/// How many times the rounding of the values, as the last steps show it, two moments may differ by: they are of second degree in them, and each of the steps is but one sample.
const SAMPLED: f64 = 20.0;

/// What is left of the equations of the rest, as a share of what turns there, in a motion that repeats: more is an undamped resonance, where rounding grows beyond all measure.
const LEFT: f64 = 1e-6;

/// Equations of a machine at an instant of the turn.
#[derive(Clone, Debug, Default)]
pub struct Instant {
    /// M q'' - h of the rest, then of the angle, which does not accelerate.
    pub residuals: Vec<f64>,
    /// Derivatives of those of the rest by q, q', q'', for each of them one behind the other.
    pub slopes: Vec<f64>,
    /// M_φφ.
    pub inertia: f64,
}

/// The rest of a machine at an instant of the turn: the angle, its rate; q, q', q''.
pub struct Place<'a> {
    /// φ.
    pub angle: f64,
    /// Ω.
    pub speed: f64,
    /// q.
    pub values: &'a [f64],
    /// q'.
    pub rates: &'a [f64],
    /// q''.
    pub accelerations: &'a [f64],
}

/// A machine with an angle that turns.
pub trait Turning {
    /// Coordinates besides the angle.
    fn others(&self) -> usize;
    /// The equations at an instant.
    fn at(&self, place: &Place<'_>) -> Instant;
    /// The residuals alone.
    fn residuals(&self, place: &Place<'_>) -> Vec<f64> {
        self.at(place).residuals
    }
}

/// A turn at a given speed.
#[derive(Clone, Debug, PartialEq)]
pub struct Turn {
    /// Ω, rad/s.
    pub speed: f64,
    /// N, N m.
    pub own: f64,
    /// V, N m.
    pub vibration: f64,
    /// How far the angle departs from uniform turning at most, rad: the sum of its harmonics.
    pub ripple: f64,
    /// The greatest moment of the turn that the mean leaves out, N m.
    pub(super) greatest: f64,
    /// Share of the values that is rounding: a narrow resonance magnifies that of the equations.
    pub(super) doubt: f64,
    /// q at equally spaced instants of the turn.
    pub(super) values: Vec<f64>,
}

impl Turn {
    /// L, N m.
    pub fn balance(&self) -> f64 {
        self.own - self.vibration
    }

    /// The larger of both moments.
    fn size(&self) -> f64 {
        self.own.abs().max(self.vibration.abs())
    }

    /// Whether the rest answers otherwise in another turn at the same speed.
    pub fn differs(&self, other: &Turn) -> bool {
        (self.balance() - other.balance()).abs() > MET * self.size().max(other.size()) + ROUNDING * self.greatest.max(other.greatest)
    }
}

/// The turn at a speed; none where the rest has no motion that repeats after a turn, or it is not smooth enough for 129 instants. `before` is one at a speed nearby.
pub fn turn<T: Turning + ?Sized>(machine: &T, speed: f64, before: Option<&Turn>) -> Option<Turn> {
    if speed == 0.0 || !speed.is_finite() {
        return None;
    }
    let guess = before.map(|turn| turn.values.as_slice());
    let mut last = Grid::new(INSTANTS[0], machine.others()).turn(machine, speed, guess)?;
    for instants in &INSTANTS[1..] {
        let next = Grid::new(*instants, machine.others()).turn(machine, speed, Some(&last.values))?;
        let size = [next.own, next.vibration, last.own, last.vibration].into_iter().fold(0.0_f64, |l, v| l.max(v.abs()));
        let allowed = (AGREE + SAMPLED * last.doubt.max(next.doubt)) * size + ROUNDING * next.greatest;
        if (next.balance() - last.balance()).abs() <= allowed && (next.own - last.own).abs() <= allowed {
            return Some(next);
        }
        last = next;
    }
    None
}

/// The turns at ascending speeds; none where there is none.
pub fn turns<T: Turning + ?Sized>(machine: &T, speeds: &[f64]) -> Vec<Option<Turn>> {
    let mut found: Vec<Option<Turn>> = Vec::with_capacity(speeds.len());
    for speed in speeds {
        let before = found.last().and_then(Option::as_ref);
        found.push(turn(machine, *speed, before).or_else(|| turn(machine, *speed, None)));
    }
    found
}

/// Distance in speed, relative to it, within which the top of a resonance is found: its height then errs by the square of that.
pub(super) const NEAR: f64 = 1e-6;

/// The turn of the greatest value between two speeds, by the golden section; the answers are those that a known one leads to.
pub(super) fn greatest<T: Turning + ?Sized>(
    machine: &T,
    (ends, near): ([f64; 2], &Turn),
    within: f64,
    of: &dyn Fn(&Turn) -> f64,
) -> Option<Turn> {
    let value = |speed: f64| turn(machine, speed, Some(near)).ok_or(());
    let above = |a: &Turn, b: &Turn| of(a) > of(b);
    let mut section = Section::new(ends, value).ok()?;
    while section.length() > within * section.ends[1].abs().max(section.ends[0].abs()) {
        section = section.narrowed(above, value).ok()?;
    }
    Some(section.best(above).1)
}

/// Equally spaced instants of a turn, and the derivative by the angle there.
pub(super) struct Grid {
    pub(super) n: usize,
    others: usize,
    /// D: derivative of the trigonometric polynomial through n values, n odd.
    first: Vec<f64>,
    /// D².
    second: Vec<f64>,
    /// Sine and cosine at the instants.
    around: Vec<(f64, f64)>,
}

impl Grid {
    pub(super) fn new(n: usize, others: usize) -> Grid {
        // Trefethen, Spectral Methods in MATLAB, 2000, ch. 3, for odd n: with s = (-1)^(j-k) and h = (j - k)π/n the entries of D are s / (2 sin h), those of
        // D² are -s cos h / (2 sin² h), on the diagonal -(n² - 1)/12
        let apart = |by: usize| {
            let (sin, cos) = elementary::sin_cos(0.5 * TAU * by as f64 / n as f64);
            let sign = if by.is_multiple_of(2) { 0.5 } else { -0.5 };
            if by == 0 { [0.0, (1.0 - (n * n) as f64) / 12.0] } else { [sign / sin, -sign * cos / (sin * sin)] }
        };
        let all: Vec<[f64; 2]> = (0..n).map(apart).collect();
        // D is odd in j - k, D² even
        let entry =
            |e: usize, sign: f64, order: usize| if e / n < e % n { sign * all[e % n - e / n][order] } else { all[e / n - e % n][order] };
        let first = (0..n * n).map(|e| entry(e, -1.0, 0)).collect();
        let second = (0..n * n).map(|e| entry(e, 1.0, 1)).collect();
        let around = (0..n).map(|k| elementary::sin_cos(TAU * k as f64 / n as f64)).collect();
        Grid { n, others, first, second, around }
    }

    pub(super) fn turn<T: Turning + ?Sized>(&self, machine: &T, speed: f64, guess: Option<&[f64]>) -> Option<Turn> {
        let mut values = self.taken(guess);
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            let instants = self.instants(machine, speed, &values);
            let step = self.step(&instants, speed)?;
            values.iter_mut().zip(&step).for_each(|(v, s)| *v -= s);
            let largest = values.iter().fold(0.0_f64, |l, v| l.max(v.abs()));
            let moved = step.iter().fold(0.0_f64, |l, v| l.max(v.abs()));
            if !moved.is_finite() {
                return None;
            }
            let rounding = moved >= FALLS * last && moved.max(last) <= MOVED * largest;
            if moved <= STILL * largest || rounding {
                let turn = self.told(machine, speed, values)?;
                let sample = if rounding { moved.max(last) } else { moved };
                let doubt = if sample == 0.0 { 0.0 } else { sample / largest };
                return Some(Turn { doubt, ..turn });
            }
            last = moved;
        }
        None
    }

    /// Values at these instants from those at others: the trigonometric polynomial through them.
    pub(super) fn taken(&self, guess: Option<&[f64]>) -> Vec<f64> {
        let width = self.others.max(1);
        let Some(old) = guess.filter(|old| !old.is_empty() && old.len().is_multiple_of(width)) else {
            return vec![0.0; self.n * self.others];
        };
        let count = old.len() / width;
        let weight = |k: usize, j: usize| {
            // D_n of Dirichlet over n: 1 at its own instant, 0 at the others
            let half = 0.5 * TAU * (k as f64 / self.n as f64 - j as f64 / count as f64);
            let sine = elementary::sin(half);
            if sine.abs() < f64::EPSILON { 1.0 } else { elementary::sin(count as f64 * half) / (count as f64 * sine) }
        };
        let value = |e: usize| (0..count).map(|j| weight(e / width, j) * old[j * width + e % width]).sum();
        (0..self.n * self.others).map(value).collect()
    }

    /// Rates and accelerations of the values: each harmonic by its own factors. D² itself has entries up to n²/12, whose rounding in one harmonic is as large as what a narrow resonance leaves of inertia and stiffness.
    pub(super) fn derived(&self, speed: f64, values: &[f64]) -> [Vec<f64>; 2] {
        let (n, m) = (self.n, self.others);
        let mut out = [vec![0.0; values.len()], vec![0.0; values.len()]];
        for (j, k) in (0..m).flat_map(|j| (1..=n / 2).map(move |k| (j, k))) {
            let [c, s] = self.harmonic(values, j, k);
            let rate = k as f64 * speed;
            for i in 0..n {
                let (sin, cos) = self.around[i * k % n];
                out[0][i * m + j] += rate * (s * cos - c * sin);
                out[1][i * m + j] -= rate * rate * (c * cos + s * sin);
            }
        }
        out
    }

    /// Cosine and sine of a harmonic of a coordinate.
    pub(super) fn harmonic(&self, values: &[f64], j: usize, k: usize) -> [f64; 2] {
        let sums = (0..self.n).fold([0.0, 0.0], |[c, s], i| {
            let (sin, cos) = self.around[i * k % self.n];
            let value = values[i * self.others + j];
            [c + value * cos, s + value * sin]
        });
        sums.map(|sum| 2.0 * sum / self.n as f64)
    }

    /// What the equations say at all instants.
    fn around<R>(&self, (speed, values): (f64, &[f64]), of: impl Fn(&Place<'_>) -> R) -> Vec<R> {
        let [rates, accelerations] = self.derived(speed, values);
        let range = |k: usize| k * self.others..(k + 1) * self.others;
        let place = |k: usize| Place {
            angle: TAU * k as f64 / self.n as f64,
            speed,
            values: &values[range(k)],
            rates: &rates[range(k)],
            accelerations: &accelerations[range(k)],
        };
        (0..self.n).map(|k| of(&place(k))).collect()
    }

    pub(super) fn instants<T: Turning + ?Sized>(&self, machine: &T, speed: f64, values: &[f64]) -> Vec<Instant> {
        self.around((speed, values), |place| machine.at(place))
    }

    /// L with the rest at these values.
    pub(super) fn balance<T: Turning + ?Sized>(&self, machine: &T, speed: f64, values: &[f64]) -> f64 {
        -self.around((speed, values), |place| machine.residuals(place)[self.others]).iter().sum::<f64>() / self.n as f64
    }

    /// Residuals of the rest at all instants.
    pub(super) fn left<T: Turning + ?Sized>(&self, machine: &T, speed: f64, values: &[f64]) -> Vec<f64> {
        self.around((speed, values), |place| machine.residuals(place)).iter().flat_map(|all| all[..self.others].to_vec()).collect()
    }

    /// The same of instants that are known.
    fn residuals(&self, instants: &[Instant]) -> Vec<f64> {
        instants.iter().flat_map(|instant| instant.residuals[..self.others].to_vec()).collect()
    }

    /// Their derivatives by the values.
    pub(super) fn matrix(&self, instants: &[Instant], speed: f64) -> Vec<f64> {
        let (n, m) = (self.n, self.others);
        let size = n * m;
        let mut matrix = vec![0.0; size * size];
        for (k, instant) in instants.iter().enumerate() {
            for (i, j) in (0..m).flat_map(|i| (0..m).map(move |j| (i, j))) {
                let [by_value, by_rate, by_acceleration] = [0, 1, 2].map(|order| instant.slopes[(i * 3 + order) * m + j]);
                for l in 0..n {
                    let direct = if l == k { by_value } else { 0.0 };
                    matrix[(k * m + i) * size + l * m + j] =
                        direct + by_rate * speed * self.first[k * n + l] + by_acceleration * speed * speed * self.second[k * n + l];
                }
            }
        }
        matrix
    }

    /// Newton's step; none where the matrix is singular: an undamped resonance.
    fn step(&self, instants: &[Instant], speed: f64) -> Option<Vec<f64>> {
        let size = self.n * self.others;
        if size == 0 {
            return Some(Vec::new());
        }
        let (right, matrix) = (self.residuals(instants), self.matrix(instants, speed));
        if right.iter().chain(&matrix).any(|v| !v.is_finite()) {
            return None;
        }
        Lu::new(&matrix, size).solve(&right)
    }

    /// Moments of a turn that repeats.
    pub(super) fn told<T: Turning + ?Sized>(&self, machine: &T, speed: f64, values: Vec<f64>) -> Option<Turn> {
        let (n, m) = (self.n as f64, self.others);
        let instants = self.instants(machine, speed, &values);
        let mean: Vec<f64> = (0..m).map(|i| values.iter().skip(i).step_by(m).sum::<f64>() / n).collect();
        let still = vec![0.0; m];
        let held = |k: usize| {
            let angle = TAU * k as f64 / n;
            machine.at(&Place { angle, speed, values: &mean, rates: &still, accelerations: &still })
        };
        let held: Vec<Instant> = (0..self.n).map(held).collect();
        let largest = |list: &[Instant]| list.iter().flat_map(|instant| &instant.residuals[..m]).fold(0.0_f64, |l, v| l.max(v.abs()));
        if largest(&instants) > LEFT * largest(&held) {
            return None;
        }
        let balance = -instants.iter().map(|instant| instant.residuals[m]).sum::<f64>() / n;
        let own = -held.iter().map(|instant| instant.residuals[m]).sum::<f64>() / n;
        let ripple = ripple(&instants.iter().map(|instant| -instant.residuals[m] / instant.inertia).collect::<Vec<_>>(), speed);
        let greatest = instants.iter().fold(0.0_f64, |l, instant| l.max(instant.residuals[m].abs()));
        let turn = Turn { speed, own, vibration: own - balance, ripple, greatest, doubt: 0.0, values };
        [turn.own, turn.vibration, turn.ripple].iter().all(|v| v.is_finite()).then_some(turn)
    }
}

/// How far an angle with these accelerations over a turn departs from uniform turning: harmonic k of amplitude a moves it by a/(kΩ)².
fn ripple(accelerations: &[f64], speed: f64) -> f64 {
    let n = accelerations.len();
    let amplitude = |k: usize| {
        let sums = accelerations.iter().enumerate().fold([0.0, 0.0], |[c, s], (j, a)| {
            let (sin, cos) = elementary::sin_cos(TAU * (j * k % n) as f64 / n as f64);
            [c + a * cos, s + a * sin]
        });
        2.0 / n as f64 * elementary::hypot(sums[0], sums[1])
    };
    (1..=n / 2).map(|k| amplitude(k) / ((k * k) as f64 * speed * speed)).sum()
}
