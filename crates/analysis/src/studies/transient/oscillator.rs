//! One degree of freedom: x'' + 2 n x' + k² x = h(τ), τ from the start of a phase.
//!
//! The motion is written with divided differences of the exponential at the roots r1, r2 of r² + 2 n r + k² and the rates λ of the load,
//!
//! ```text
//! x = x0 (S' + 2 n S) + v0 S + Σ c k! exp_τ[r1, r2, λ, ..., λ],   S = exp_τ[r1, r2],   for h = Σ c τ^k e^(λ τ)
//! ```
//!
//! which holds in every case: critical damping (r1 = r2) and resonance (λ = r1) are not exceptions. The constants of the textbook formula,
//! which does tell cases apart, are computed beside it for print.

use super::load::{Load, Term};
use algebra::arrange::Arrange;
use algebra::complex::{self, Complex};
use algebra::divided::exponential;

/// n and k that agree to this share are critical damping, a root and a rate that agree to it are resonance: data carry rounding.
pub const EQUAL: f64 = 1e-12;

/// What the free motion is like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Case {
    /// n = 0: oscillations that do not die out.
    Undamped,
    /// n < k: decaying oscillations.
    Underdamped,
    /// n = k.
    Critical,
    /// n > k: two real exponents.
    Overdamped,
    /// k = 0: nothing pulls back.
    Free,
    /// k² < 0: an unstable equilibrium.
    Unstable,
}

impl Case {
    /// Name in files.
    pub fn name(self) -> &'static str {
        match self {
            Case::Undamped => "undamped",
            Case::Underdamped => "underdamped",
            Case::Critical => "critical",
            Case::Overdamped => "overdamped",
            Case::Free => "free",
            Case::Unstable => "unstable",
        }
    }
}

/// x'' + 2 n x' + k² x = h(τ) with x(0), x'(0).
#[derive(Clone, Debug, PartialEq)]
pub struct Oscillator {
    /// n, 1/s.
    pub n: f64,
    /// k², 1/s².
    pub k2: f64,
    /// h over τ.
    pub load: Load,
    /// x(0).
    pub x0: f64,
    /// x'(0).
    pub v0: f64,
}

/// A harmonic part of the load and the motion that it forces: h sin(p τ + delta) gives D sin(p τ + delta - epsilon).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Harmonic {
    /// Frequency, rad/s.
    pub p: f64,
    /// Amplitude of the load per unit of inertia.
    pub h: f64,
    /// Initial phase, -π..π.
    pub delta: f64,
    /// Amplitude of the forced motion; none in resonance without damping, where it grows.
    pub amplitude: Option<f64>,
    /// Lag of the forced motion, 0..π.
    pub lag: f64,
}

/// The textbook formula: x = (free motion with C1, C2) + (forced motion).
#[derive(Clone, Debug, PartialEq)]
pub struct Constants {
    /// Kind of the free motion.
    pub case: Case,
    /// Whether a rate of the load is a root: the forced motion grows.
    pub resonance: bool,
    /// Roots of r² + 2 n r + k² = 0; the first decays more slowly.
    pub roots: [Complex; 2],
    /// Frequency sqrt(k² - n²) of decaying oscillations, or sqrt(n² - k²) of the two exponents; 0 in the critical case.
    pub k1: f64,
    /// C1 and C2 of e^(-nτ)(C1 cos k1 τ + C2 sin k1 τ), of e^(-nτ)(C1 + C2 τ), or of C1 e^(r1 τ) + C2 e^(r2 τ).
    pub free: [f64; 2],
    /// The constant part of the forced motion.
    pub rest: f64,
    /// Harmonic parts by ascending frequency.
    pub harmonics: Vec<Harmonic>,
    /// The whole forced motion over τ.
    pub forced: Load,
}

impl Oscillator {
    /// Roots of λ² + 2 n λ + k² = 0 and rates of the load, real and imaginary part.
    pub fn rates(&self) -> Vec<(f64, f64)> {
        let square = self.k2 - self.n * self.n;
        let side = square.abs().sqrt();
        let own = if square > 0.0 { [(-self.n, side), (-self.n, -side)] } else { [(-self.n + side, 0.0), (-self.n - side, 0.0)] };
        own.into_iter().chain(self.load.0.iter().map(|term| (term.rate.re, term.rate.im))).collect()
    }

    /// n² - k² without cancellation.
    fn discriminant(&self) -> f64 {
        if self.k2 < 0.0 {
            return self.n * self.n - self.k2;
        }
        let k = self.k2.sqrt();
        (self.n - k) * (self.n + k)
    }

    /// Roots of r² + 2 n r + k² = 0, the one nearer to 0 first.
    pub fn roots(&self) -> [Complex; 2] {
        let d = self.discriminant();
        if d < 0.0 {
            let w = (-d).sqrt();
            return [Complex::new(-self.n, w), Complex::new(-self.n, -w)];
        }
        let far = -(self.n + d.sqrt().copysign(self.n));
        let near = if far == 0.0 { 0.0 } else { self.k2 / far };
        [Complex::from(near), Complex::from(far)]
    }

    /// x and x' at τ.
    pub fn at(&self, tau: f64) -> [f64; 2] {
        let [r1, r2] = self.roots();
        let impulse = exponential(&[r1, r2], tau);
        // S' = r1 S + e^(r2 τ), and with 2 n = -(r1 + r2): S' + 2 n S = e^(r2 τ) - r2 S
        let decay = complex::exp(r2.scale(tau));
        let slope = r1 * impulse + decay;
        let start = decay - r2 * impulse;
        let mut x = self.x0 * start.re + self.v0 * impulse.re;
        // S'' + 2 n S' = -k² S
        let mut v = -self.x0 * self.k2 * impulse.re + self.v0 * slope.re;
        for term in &self.load.0 {
            let factor = term.factor.scale((1..=term.power).map(f64::from).product());
            let mut nodes = vec![r1, r2];
            nodes.extend((0..=term.power).map(|_| term.rate));
            let response = exponential(&nodes, tau);
            let shorter = exponential(&nodes[..nodes.len() - 1], tau);
            x += (factor * response).re;
            v += (factor * (term.rate * response + shorter)).re;
        }
        [x, v]
    }

    /// The textbook formula.
    pub fn constants(&self) -> Constants {
        let k = self.k2.max(0.0).sqrt();
        let size = self.n.abs() + k;
        let d = self.discriminant();
        let case = match () {
            () if self.k2 < 0.0 => Case::Unstable,
            () if self.k2 == 0.0 => Case::Free,
            () if self.n.abs() <= EQUAL * k => Case::Undamped,
            () if (self.n.abs() - k).abs() <= EQUAL * size => Case::Critical,
            () if d < 0.0 => Case::Underdamped,
            () => Case::Overdamped,
        };
        let roots = if case == Case::Critical { [Complex::from(-self.n); 2] } else { self.roots() };
        let mut forced = Load::default();
        let mut resonance = false;
        for term in &self.load.0 {
            let multiplicity = roots.iter().filter(|r| complex::abs(**r - term.rate) <= EQUAL * (size + complex::abs(term.rate))).count();
            // a free body under a constant force is no resonance
            resonance |= multiplicity > 0 && term.rate != Complex::ZERO;
            forced.add(&Load(self.particular(term, multiplicity)), 1.0);
        }
        let rate = forced.derivative();
        let (a, b) = (self.x0 - forced.at(0.0), self.v0 - rate.at(0.0));
        let k1 = if case == Case::Critical { 0.0 } else { d.abs().sqrt() };
        let [r1, r2] = [roots[0].re, roots[1].re];
        let free = match case {
            Case::Undamped | Case::Underdamped => [a, (b + self.n * a) / k1],
            _ if k1 == 0.0 => [a, b + self.n * a],
            _ => {
                let first = (b - r2 * a) / (r1 - r2);
                [first, a - first]
            }
        };
        let rest = forced.0.iter().filter(|t| t.rate == Complex::ZERO && t.power == 0).fold(0.0, |sum, t| sum + t.factor.re);
        Constants { case, resonance, roots, k1, free, rest, harmonics: self.harmonics(), forced }
    }

    /// A particular solution for one term of the load, as Σ X_j τ^j e^(λ τ), where λ is a root `multiplicity` times:
    /// (λ² + 2nλ + k²) X_j + 2 (λ + n)(j + 1) X_(j+1) + (j + 1)(j + 2) X_(j+2) = c for j = k, 0 below.
    fn particular(&self, term: &Term, multiplicity: usize) -> Vec<Term> {
        let (rate, m) = (term.rate, term.power as usize);
        let p = rate * rate + rate.scale(2.0 * self.n) + Complex::from(self.k2);
        let p1 = (rate + Complex::from(self.n)).scale(2.0);
        let mut x = vec![Complex::ZERO; m + 3 + multiplicity];
        for j in (0..=m).rev() {
            let wanted = if j == m { term.factor } else { Complex::ZERO };
            let (one, two) = ((j + 1) as f64, ((j + 1) * (j + 2)) as f64);
            match multiplicity {
                0 => x[j] = (wanted - p1 * x[j + 1].scale(one) - x[j + 2].scale(two)) / p,
                1 => x[j + 1] = (wanted - x[j + 2].scale(two)) / p1.scale(one),
                _ => x[j + 2] = wanted.scale(1.0 / two),
            }
        }
        let terms = x.into_iter().enumerate().filter(|(_, c)| *c != Complex::ZERO);
        terms.map(|(j, factor)| Term { rate, power: j as u32, factor }).collect()
    }

    fn harmonics(&self) -> Vec<Harmonic> {
        let steady = |t: &&Term| t.power == 0 && t.rate.re == 0.0 && t.rate.im > 0.0;
        let mut found: Vec<Harmonic> = self.load.0.iter().filter(steady).map(|t| self.harmonic(t)).collect();
        found.arrange_by(|a, b| a.p.total_cmp(&b.p));
        found
    }

    /// 2 Re(c e^(ipτ)) = 2 |c| sin(pτ + arg c + π/2).
    fn harmonic(&self, term: &Term) -> Harmonic {
        use std::f64::consts::{FRAC_PI_2, PI, TAU};
        let p = term.rate.im;
        let h = 2.0 * complex::abs(term.factor);
        let delta = complex::arg(term.factor) + FRAC_PI_2;
        let delta = if delta > PI { delta - TAU } else { delta };
        let response = Complex::new(self.k2 - p * p, 2.0 * self.n * p);
        let amplitude = (complex::abs(response) > EQUAL * (self.k2.abs() + p * p)).then(|| h / complex::abs(response));
        Harmonic { p, h, delta, amplitude, lag: complex::arg(response) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Units of the last place.
    const ROUNDING: f64 = 1e-15;
    /// A closed form against another: sums of a dozen terms.
    const CLOSED: f64 = 1e-13;
    /// Digits of the lag as it is published.
    const PUBLISHED: f64 = 1e-12;
    /// Central differences with the step 1e-5: its square times third derivatives.
    const DIFFERENCE: f64 = 1e-8;

    /// The textbook formula evaluated by itself.
    fn textbook(o: &Oscillator, tau: f64) -> f64 {
        let c = o.constants();
        let [c1, c2] = c.free;
        let free = match c.case {
            Case::Undamped | Case::Underdamped => {
                let (s, cos) = (c.k1 * tau).sin_cos();
                (-o.n * tau).exp() * (c1 * cos + c2 * s)
            }
            Case::Critical => (-o.n * tau).exp() * (c1 + c2 * tau),
            _ => c1 * (c.roots[0].re * tau).exp() + c2 * (c.roots[1].re * tau).exp(),
        };
        free + c.forced.at(tau)
    }

    #[test]
    fn entire_functions_and_textbook_agree_in_all_cases() {
        for (n, k2) in [(0.0, 100.0), (1.0, 100.0), (9.9, 100.0), (10.0, 100.0), (10.1, 100.0), (40.0, 100.0), (3.0, 0.0), (0.5, -4.0)] {
            let mut load = Load::sine(15.0, 0.3);
            load.add(&Load::constant(2.0), 1.0);
            load.add(&Load::time().times(&Load::growth(-0.7, 0.0)), 0.5);
            let o = Oscillator { n, k2, load, x0: 0.02, v0: 1.23 };
            for tau in [0.0, 0.1, 0.7, 2.0] {
                let (x, wanted) = (o.at(tau)[0], textbook(&o, tau));
                assert!((x - wanted).abs() < CLOSED * (1.0 + wanted.abs()), "n = {n}, k² = {k2}, τ = {tau}: {x} {wanted}");
            }
        }
    }

    #[test]
    fn rate_is_the_derivative() {
        let o = Oscillator { n: 2.0, k2: 100.0, load: Load::time().times(&Load::sine(7.0, 0.2)), x0: 0.1, v0: -1.0 };
        let d = 1e-5;
        for tau in [0.3, 1.0, 2.5] {
            let numeric = (o.at(tau + d)[0] - o.at(tau - d)[0]) / (2.0 * d);
            assert!((numeric - o.at(tau)[1]).abs() < DIFFERENCE);
        }
    }

    /// From rest in resonance x = u_st/2 (sin kt - kt cos kt), u_st = h/k² (card F1).
    #[test]
    fn growth_in_resonance() {
        let k: f64 = 3.0;
        let o = Oscillator { n: 0.0, k2: k * k, load: Load::sine(k, 0.0), x0: 0.0, v0: 0.0 };
        assert!(o.constants().resonance && o.constants().harmonics[0].amplitude.is_none());
        for t in [0.5, 4.0, 100.0] {
            let wanted = 0.5 / (k * k) * ((k * t).sin() - k * t * (k * t).cos());
            assert!((o.at(t)[0] - wanted).abs() < CLOSED * (1.0 + t), "{t}");
            assert!((textbook(&o, t) - wanted).abs() < CLOSED * (1.0 + t));
        }
    }

    #[test]
    fn card_00() {
        let o = Oscillator {
            n: 10.0,
            k2: 100.0,
            load: Load(Load::sine(15.0, 0.0).0.into_iter().map(|t| Term { factor: t.factor.scale(50.0 / 3.0), ..t }).collect()),
            x0: 0.0,
            v0: 1.23,
        };
        let c = o.constants();
        assert_eq!(c.case, Case::Critical);
        assert!((c.free[0] - 8.0 / 169.0).abs() < ROUNDING && (c.free[1] - 2599.0 / 1300.0).abs() < ROUNDING);
        // units of the last place
        assert!((c.harmonics[0].amplitude.unwrap() - 2.0 / 39.0).abs() < 1e-16);
        assert!((c.harmonics[0].lag - 1.965587446495).abs() < PUBLISHED);
    }
}
