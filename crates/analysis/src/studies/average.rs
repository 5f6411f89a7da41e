//! Averaging over a fast turn: one angle φ turns nearly uniformly, and the rest of the machine answers with a motion that repeats after a turn.
//!
//! ```text
//! φ = Ωt:  M_qq q'' = h_q(q, q', φ, Ω)        q(φ + 2π) = q(φ), by trigonometric collocation
//! J Ω' = L(Ω) = <h_φ - M_φq q''>              mean over a turn
//! L = N - V                                   N = <h_φ> with the rest held at its mean place: what turns the angle by itself; V is what the answer of the rest takes, the vibrational moment
//! ```
//!
//! Speeds at which L = 0 are those of steady turning, stable where L falls. The error is of the order of the ripple: how far φ departs from uniform turning within a turn. *Source*:
//! I. I. Blekhman, Vibrational Mechanics, 2000, part II; V. O. Kononenko, Vibrating Systems with a Limited Power Supply, 1969, ch. 3.

use crate::marks::bracketed;
use algebra::arrange::Arrange;
use algebra::elementary;
use algebra::lu::Lu;
use std::f64::consts::TAU;

/// Instants of a turn that are tried, odd; two that follow one another must agree.
const INSTANTS: [usize; 4] = [17, 33, 65, 129];
/// By how much of the largest moment they may differ.
const AGREE: f64 = 1e-10;
/// Relative distance of the speeds between which L falls or grows where it vanishes: within a narrow resonance, and a thousand times what [`AGREE`] leaves of a slope.
const BESIDE: f64 = 1e-7;
/// Share of the moments that is left where they balance: a narrow resonance, a millionth of its speed wide, turns the rounding of a speed into 1e-10 of them.
const MET: f64 = 1e-6;
/// Share of the greatest moment of a turn below which a difference of means is rounding: some thousand of them.
const ROUNDING: f64 = 1e-13;
/// Newton's steps.
const STEPS: usize = 40;
/// Share of the largest value of the rest below which a step is rounding of the matrices of derivatives.
const STILL: f64 = 1e-12;

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
    greatest: f64,
    /// q at equally spaced instants of the turn.
    values: Vec<f64>,
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

/// A speed at which the moments balance.
#[derive(Clone, Debug, PartialEq)]
pub struct Steady {
    /// The turn.
    pub turn: Turn,
    /// Whether L falls there.
    pub stable: bool,
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
        let allowed = AGREE * size + ROUNDING * next.greatest;
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

/// Speeds of steady turning between turns that follow one another.
pub fn steady<T: Turning + ?Sized>(machine: &T, turns: &[Option<Turn>]) -> Vec<Steady> {
    let turns = with_peaks(machine, turns);
    let pairs = turns.windows(2).filter_map(|pair| pair[0].as_ref().zip(pair[1].as_ref()));
    let root = |(a, b): (&Turn, &Turn)| {
        if (a.balance() > 0.0) == (b.balance() > 0.0) {
            return None;
        }
        let value = |speed: f64| turn(machine, speed, Some(a)).map_or(f64::NAN, |turn| turn.balance());
        let speed = bracketed(&mut |speed| value(speed), (a.speed, a.balance()), (b.speed, b.balance()));
        let found = turn(machine, speed, Some(a))?;
        // where the answer of the rest falls to another the moments are unlike on both sides, and balance nowhere
        let met = found.balance().abs() <= MET * a.size().max(b.size()) + ROUNDING * found.greatest;
        let beside = |by: f64| turn(machine, speed * (1.0 + by), Some(&found)).map(|turn| turn.balance());
        // both ends may lie on other answers of the rest than the balance
        let stable = beside(-BESIDE).zip(beside(BESIDE)).map_or(a.balance() > 0.0, |(slower, faster)| slower > faster);
        met.then_some(Steady { turn: found, stable })
    };
    pairs.filter_map(root).collect()
}

/// The turns with those where V is greatest, and where L is nearest to zero, between neighbours: a resonance that is narrower than the distance of the speeds may have
/// both of its balances between two of them.
fn with_peaks<T: Turning + ?Sized>(machine: &T, turns: &[Option<Turn>]) -> Vec<Option<Turn>> {
    let mut between: Vec<Turn> = Vec::new();
    for three in turns.windows(3) {
        let [Some(a), Some(b), Some(c)] = three else { continue };
        let ends = [a.speed, c.speed];
        let peak = |of: fn(&Turn) -> f64| of(b) >= of(a).max(of(c)) && of(b) > of(a).min(of(c));
        let resonance: fn(&Turn) -> f64 = |turn| turn.vibration.abs();
        let dip: fn(&Turn) -> f64 = |turn| -turn.balance().abs();
        let one_side = [a, c].iter().all(|t| (t.balance() > 0.0) == (b.balance() > 0.0));
        if peak(resonance) {
            between.extend(greatest(machine, ends, NEAR, &resonance));
        }
        if one_side && peak(dip) {
            let sign = if b.balance() > 0.0 { -1.0 } else { 1.0 };
            between.extend(greatest(machine, ends, NEAR, &|turn| sign * turn.balance()));
        }
    }
    let mut all: Vec<Option<Turn>> = Vec::with_capacity(turns.len() + between.len());
    for turn in turns {
        let reached = turn.as_ref().map_or(f64::NEG_INFINITY, |turn| turn.speed);
        let last = all.last().and_then(Option::as_ref).map_or(f64::NEG_INFINITY, |turn| turn.speed);
        let mut inside: Vec<Turn> = between.iter().filter(|t| t.speed > last && t.speed < reached).cloned().collect();
        inside.arrange_by(|a, b| a.speed.total_cmp(&b.speed));
        all.extend(inside.into_iter().map(Some));
        all.push(turn.clone());
    }
    all
}

/// Distance in speed, relative to it, within which the top of a resonance is found: its height then errs by the square of that.
const NEAR: f64 = 1e-6;

/// The turn of the greatest `sign` L between two speeds.
pub fn extreme<T: Turning + ?Sized>(machine: &T, ends: [f64; 2], sign: f64) -> Option<Turn> {
    // L is flat there: its place is known to the root of the rounding
    greatest(machine, ends, 1e-8, &|turn| sign * turn.balance())
}

/// The turn of the greatest value between two speeds, by the golden section.
fn greatest<T: Turning + ?Sized>(machine: &T, [mut low, mut high]: [f64; 2], within: f64, of: &dyn Fn(&Turn) -> f64) -> Option<Turn> {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let value = |speed: f64| turn(machine, speed, None);
    let mut inner = [value(high - GOLDEN * (high - low))?, value(low + GOLDEN * (high - low))?];
    while high - low > within * high.abs().max(low.abs()) {
        if of(&inner[0]) > of(&inner[1]) {
            high = inner[1].speed;
            let next = value(high - GOLDEN * (high - low))?;
            let [first, _] = inner;
            inner = [next, first];
        } else {
            low = inner[0].speed;
            let next = value(low + GOLDEN * (high - low))?;
            let [_, second] = inner;
            inner = [second, next];
        }
    }
    let [first, second] = inner;
    Some(if of(&first) > of(&second) { first } else { second })
}

/// Equally spaced instants of a turn, and the derivative by the angle there.
struct Grid {
    n: usize,
    others: usize,
    /// D: derivative of the trigonometric polynomial through n values, n odd.
    first: Vec<f64>,
    /// D².
    second: Vec<f64>,
}

impl Grid {
    fn new(n: usize, others: usize) -> Grid {
        // Trefethen, Spectral Methods in MATLAB, 2000, ch. 3: D_jk = (-1)^(j-k) / (2 sin((j - k)π/n))
        let entry = |j: usize, k: usize| {
            let sign = if (j + k).is_multiple_of(2) { 1.0 } else { -1.0 };
            let half = 0.5 * TAU * (j as f64 - k as f64) / n as f64;
            if j == k { 0.0 } else { 0.5 * sign / elementary::sin(half) }
        };
        let first: Vec<f64> = (0..n * n).map(|e| entry(e / n, e % n)).collect();
        let second = (0..n * n).map(|e| (0..n).map(|m| first[e / n * n + m] * first[m * n + e % n]).sum()).collect();
        Grid { n, others, first, second }
    }

    fn turn<T: Turning + ?Sized>(&self, machine: &T, speed: f64, guess: Option<&[f64]>) -> Option<Turn> {
        let mut values = self.taken(guess);
        for _ in 0..STEPS {
            let instants = self.instants(machine, speed, &values);
            let step = self.step(&instants, speed)?;
            values.iter_mut().zip(&step).for_each(|(v, s)| *v -= s);
            let largest = values.iter().fold(0.0_f64, |l, v| l.max(v.abs()));
            let moved = step.iter().fold(0.0_f64, |l, v| l.max(v.abs()));
            if !moved.is_finite() {
                return None;
            }
            if moved <= STILL * largest || moved == 0.0 {
                return self.told(machine, speed, values);
            }
        }
        None
    }

    /// Values at these instants from those at others: the trigonometric polynomial through them.
    fn taken(&self, guess: Option<&[f64]>) -> Vec<f64> {
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

    /// Derivative of the values by time.
    fn derived(&self, matrix: &[f64], factor: f64, values: &[f64]) -> Vec<f64> {
        let entry = |e: usize| {
            let (k, i) = (e / self.others, e % self.others);
            factor * (0..self.n).map(|m| matrix[k * self.n + m] * values[m * self.others + i]).sum::<f64>()
        };
        (0..values.len()).map(entry).collect()
    }

    fn instants<T: Turning + ?Sized>(&self, machine: &T, speed: f64, values: &[f64]) -> Vec<Instant> {
        let rates = self.derived(&self.first, speed, values);
        let accelerations = self.derived(&self.second, speed * speed, values);
        let of = |k: usize| k * self.others..(k + 1) * self.others;
        let place = |k: usize| Place {
            angle: TAU * k as f64 / self.n as f64,
            speed,
            values: &values[of(k)],
            rates: &rates[of(k)],
            accelerations: &accelerations[of(k)],
        };
        (0..self.n).map(|k| machine.at(&place(k))).collect()
    }

    /// Newton's step; none where the matrix is singular: an undamped resonance.
    fn step(&self, instants: &[Instant], speed: f64) -> Option<Vec<f64>> {
        let (n, m) = (self.n, self.others);
        let size = n * m;
        if size == 0 {
            return Some(Vec::new());
        }
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
        let right: Vec<f64> = instants.iter().flat_map(|instant| instant.residuals[..m].to_vec()).collect();
        if right.iter().chain(&matrix).any(|v| !v.is_finite()) {
            return None;
        }
        Lu::new(&matrix, size).solve(&right)
    }

    /// Moments of a turn that repeats.
    fn told<T: Turning + ?Sized>(&self, machine: &T, speed: f64, values: Vec<f64>) -> Option<Turn> {
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
        let turn = Turn { speed, own, vibration: own - balance, ripple, greatest, values };
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

#[cfg(test)]
mod tests {
    use super::*;

    /// (M + m) x'' + b x' + c x = me (φ'' sin φ + φ'² cos φ), (J + me²) φ'' - me x'' sin φ = k(Ω₀ - φ'): the centre of mass lies at e (cos φ, sin φ).
    struct Motor {
        idle: f64,
        cubic: f64,
    }

    const M: f64 = 10.5;
    const ME: f64 = 0.02;
    const C: f64 = 4200.0;
    const B: f64 = 12.0;
    const K: f64 = 0.05;

    impl Turning for Motor {
        fn others(&self) -> usize {
            1
        }
        fn at(&self, p: &Place<'_>) -> Instant {
            let (sin, cos) = elementary::sin_cos(p.angle);
            let (x, v, a) = (p.values[0], p.rates[0], p.accelerations[0]);
            let rest = M * a + B * v + C * x + self.cubic * x * x * x - ME * p.speed * p.speed * cos;
            let own = -ME * a * sin - K * (self.idle - p.speed);
            Instant { residuals: vec![rest, own], slopes: vec![C + 3.0 * self.cubic * x * x, B, M], inertia: 0.0208 }
        }
    }

    /// Kononenko: V = bΩA²/2, A = meΩ²/√((c - MΩ²)² + b²Ω²).
    fn vibration(speed: f64) -> f64 {
        let amplitude = ME * speed * speed / elementary::hypot(C - M * speed * speed, B * speed);
        0.5 * B * speed * amplitude * amplitude
    }

    #[test]
    fn a_linear_foundation_takes_what_its_damper_takes() {
        for speed in [10.0, 19.9, 20.0, 23.0, 55.0] {
            let found = turn(&Motor { idle: 18.0, cubic: 0.0 }, speed, None).unwrap();
            // some ten roundings
            assert!((found.own - K * (18.0 - speed)).abs() < 1e-13, "{found:?}");
            // AGREE of the moments
            assert!(
                // AGREE
                (found.vibration - vibration(speed)).abs() < 1e-10 * vibration(speed).max(1.0),
                "{speed}: {} {}",
                found.vibration,
                vibration(speed)
            );
        }
    }

    /// Ω₀ = 22: three speeds, of which the middle one is unstable; each solves k(Ω₀ - Ω) = V(Ω).
    #[test]
    fn three_speeds_belong_to_one_idle_speed() {
        let machine = Motor { idle: 22.0, cubic: 0.0 };
        let speeds: Vec<f64> = (0..121).map(|k| 15.0 + 10.0 * f64::from(k) / 120.0).collect();
        let found = steady(&machine, &turns(&machine, &speeds));
        assert_eq!(found.iter().map(|s| s.stable).collect::<Vec<_>>(), [true, false, true]);
        for s in &found {
            let off = K * (22.0 - s.turn.speed) - vibration(s.turn.speed);
            // AGREE of the moments, and what the bracket leaves
            assert!(off.abs() < 1e-9, "{off:e} at {}", s.turn.speed);
        }
    }

    /// Without damping nothing is taken: the idle speed itself, where both moments are 0, is a speed of steady turning.
    #[test]
    fn moments_that_vanish_balance_too() {
        struct Undamped;
        impl Turning for Undamped {
            fn others(&self) -> usize {
                1
            }
            fn at(&self, p: &Place<'_>) -> Instant {
                let mut instant = Motor { idle: 18.0, cubic: 0.0 }.at(p);
                instant.residuals[0] -= B * p.rates[0];
                instant.slopes[1] = 0.0;
                instant
            }
        }
        let speeds: Vec<f64> = (0..41).map(|k| 17.0 + 0.05 * f64::from(k)).collect();
        let found = steady(&Undamped, &turns(&Undamped, &speeds));
        // the moment of the bracket over the slope k
        assert!(found.len() == 1 && found[0].stable && (found[0].turn.speed - 18.0).abs() < 1e-9, "{found:?}");
    }

    /// A hardening spring: what the vibration takes is still what the damper takes, <b x'²>/Ω, whatever the spring is.
    #[test]
    fn a_hardening_spring_needs_more_instants() {
        let machine = Motor { idle: 30.0, cubic: 2e6 };
        let found = turn(&machine, 23.0, None).unwrap();
        let grid = Grid::new(found.values.len(), 1);
        let rates = grid.derived(&grid.first, 23.0, &found.values);
        let taken = B * rates.iter().map(|v| v * v).sum::<f64>() / rates.len() as f64 / 23.0;
        // AGREE of both moments
        assert!((found.vibration - taken).abs() < 1e-9 * taken, "{} {taken}", found.vibration);
    }

    /// Without damping the resonance has no motion that repeats.
    #[test]
    fn an_undamped_resonance_has_no_turn() {
        struct Free;
        impl Turning for Free {
            fn others(&self) -> usize {
                1
            }
            fn at(&self, p: &Place<'_>) -> Instant {
                let rest = p.accelerations[0] + 4.0 * p.values[0] - elementary::cos(p.angle);
                Instant { residuals: vec![rest, 0.0], slopes: vec![4.0, 0.0, 1.0], inertia: 1.0 }
            }
        }
        assert_eq!(turn(&Free, 2.0, None), None);
        // 1/(4 - Ω²), and none of the harmonics of 0.9 is 2; roundings of a matrix with entries up to n²
        assert!((turn(&Free, 0.9, None).unwrap().values[0] - 1.0 / 3.19).abs() < 1e-12);
    }
}
