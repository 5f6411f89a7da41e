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

mod balances;
mod follow;
mod resonances;
mod settled;
mod starts;
mod turn;

pub use balances::{Course, Steady, Summit, carried, steady, steady_again};
pub use follow::Branch;
pub use turn::{Instant, Place, Turn, Turning, turn, turns};

#[cfg(test)]
mod tests {
    use super::balances::steady;
    use super::turn::*;
    use algebra::elementary;

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
        let found = steady(&machine, &speeds, &turns(&machine, &speeds)).steady;
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
        let found = steady(&Undamped, &speeds, &turns(&Undamped, &speeds)).steady;
        // the moment of the bracket over the slope k
        assert!(found.len() == 1 && found[0].stable && (found[0].turn.speed - 18.0).abs() < 1e-9, "{found:?}");
    }

    /// A hardening spring: what the vibration takes is still what the damper takes, <b x'²>/Ω, whatever the spring is.
    #[test]
    fn a_hardening_spring_needs_more_instants() {
        let machine = Motor { idle: 30.0, cubic: 2e6 };
        let found = turn(&machine, 23.0, None).unwrap();
        let grid = Grid::new(found.values.len(), 1);
        let [rates, _] = grid.derived(23.0, &found.values);
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
