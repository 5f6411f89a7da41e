//! Choice of the order and of the step length.
//!
//! *Source*: À. Jorba, M. Zou, A software package for the numerical integration of ODEs by means of high-order Taylor methods, Experimental
//! Mathematics 14 (2005) 99-117, sections 3.1 and 3.2. Their order p = -ln(eps)/2 and step rho/e^2 minimise work for a cost of p^2 per
//! expansion and make the geometric majorant |c_k| <= A rho^-k reach eps A at k = p. We keep the majorant, written so that no logarithm of
//! each component is needed,
//!
//! ```text
//! |c_ik| h^k <= tol^(k/p) A_i(h)       k = p - 1, p        every component i
//! ```
//!
//! and differ in A_i. They take the largest state, or 1: then a phase of 5000 rad hides a displacement of 1e-6 m beside it and is itself
//! located only to 5000 tol. What the equations see is the change of a component within the step, so
//!
//! ```text
//! A_i(h) = max( max_{1 <= k <= p/2} |c_ik| h^k ,  1e-8 max_j A_j over components of the same unit ,  2^-54 |x_i| / tol )
//! ```
//!
//! Local error divided by local change is bounded, hence the accumulated error of a component is at most about tol times the way it has gone;
//! the rule does not change under a change of units or a shift of the origin, and needs no absolute tolerance for states that begin at zero. The
//! second term lets a component that has barely begun to move (the far end of a chain pulled at this end) wait until it is seen beside
//! its equals; the third stops control below the rounding of the state. Two neighbouring orders are tested because even and odd functions
//! have every other coefficient zero. A longer run of zeros (a double pendulum let go with both rods level has three in four) would leave the
//! step unlimited, and then A_i(h), taken far outside the circle of convergence, would excuse any defect. So the quarter of the
//! coefficients before the last two has to stay below the same majorant too, with a slack of 4^(p-k) because the terms of entire functions fall
//! ever faster. What still slips through is caught after the step by its defect (see `Flow::advance`).
//!
//! **Order.** Jorba and Zou's p = -ln(tol)/2 + 1 is optimal for a cost of p^2 per expansion, -ln(tol) for a cost of p. On tapes of machines sums,
//! constant factors and overheads, which cost p, prevail, and the optimum is flat. Shortest of several runs, ms, on one core:
//!
//! ```text
//! machine, length           tol \ p   10     12     14     16     18     20     22     24     26     30
//! pendulum-on-shaft, 30 s   1e-6    11.8    9.5    8.5    8.0    7.8    7.7    7.8    7.9    9.5    8.5
//!                           1e-9    26.1   18.5   14.8   13.1   11.9   11.3   10.8   10.8   10.7   11.0
//!                           1e-12   58.0   34.9   25.3   20.6   17.9   16.3   15.2   14.7   14.2   13.9
//!                           1e-14   95.4   52.1   36.1   32.9   24.0   21.0   19.4   18.2   17.6   16.5
//! double-pendulum, 200 s    1e-6     7.1    6.0    5.6    5.5    5.5    5.4    5.6    5.7    5.8    6.3
//!                           1e-9    15.2   11.5    9.1    8.5    7.9    7.9    7.8    7.7    7.7    7.9
//! spherical-pendulum, 300 s 1e-6     6.4    5.5    5.1    4.8    4.8    4.9    4.9    4.9    5.1    5.4
//!                           1e-14   95.3   28.7   20.6   16.7   14.5   12.5   11.6   11.1   10.6   10.3
//! ```
//!
//! The rule p = 2 + 2.1 digits, at most 26, lies within 10 % of the best of every row. At tolerances looser than 1e-9 speed alone would take a higher order, but its long
//! steps make the largest term, to which the tolerance refers, far larger than the change (a decay over five time constants at 1e-3 loses its
//! second digit at order 14); above 26 the terms of an oscillation exceed their sum tenfold and cancel. Rows that other work on the computer
//! disturbed (the top; the other tolerances of the two pendulums) are left out. On the rows kept, one fixed order per run gives away at most
//! these 10 %, which bounds what a better fixed order could gain. An order that adapts within the run has not been tried.

use super::step::Series;

/// Lowest order.
const LOWEST_ORDER: usize = 4;
/// Highest order that is asked of a system.
pub const HIGHEST_ORDER: usize = 40;
/// Share of the largest component of a unit below which a smaller one of that unit is not resolved relatively.
const UNIT_SHARE: f64 = 1e-8;
/// See the head of the file.
const SLACK: f64 = 4.0;
/// Half a unit in the last place, halved again.
const ROUNDING: f64 = 1.0 / (1u64 << 54) as f64;

/// Tolerance, order and the numbers that follow from them.
#[derive(Clone, Debug)]
pub(super) struct Rule {
    pub(super) tolerance: f64,
    pub(super) order: usize,
    /// Safety factor exp(-0.7/(p-1)), which halves the truncation error (heyoka's choice).
    safety: f64,
    /// tol^(1/p).
    root: f64,
    /// tol^(k/p) 4^(p-k): what the terms before the last two may reach.
    bounds: Vec<f64>,
    /// h^k of the last call.
    powers: Vec<f64>,
    /// Components with one unit: index of the group of each state.
    group: Vec<usize>,
    /// A_i of the last call.
    pub(super) scale: Vec<f64>,
    largest: Vec<f64>,
}

impl Rule {
    pub(super) fn new(tolerance: f64, order: Option<usize>, units: &[&str]) -> Rule {
        let order = order.unwrap_or_else(|| order_for(tolerance)).clamp(LOWEST_ORDER, HIGHEST_ORDER);
        let mut names: Vec<&str> = Vec::new();
        let group: Vec<usize> = units
            .iter()
            .map(|unit| {
                names.iter().position(|name| name == unit).unwrap_or_else(|| {
                    names.push(unit);
                    names.len() - 1
                })
            })
            .collect();
        let safety = (-0.7 / (order as f64 - 1.0)).exp();
        let root = tolerance.powf(1.0 / order as f64);
        let bounds = (0..=order).map(|k| root.powi(k as i32) * SLACK.powi((order - k) as i32)).collect();
        Rule {
            tolerance,
            order,
            safety,
            root,
            bounds,
            powers: vec![0.0; order + 1],
            scale: vec![0.0; group.len()],
            largest: vec![0.0; names.len()],
            group,
        }
    }

    /// Longest admissible step, at most `limit`; `guess` (positive, may be infinite) only saves iterations.
    pub(super) fn length(&mut self, states: &Series, guess: f64, limit: f64) -> f64 {
        let mut h = self.by_last_terms(states, guess, limit);
        for _ in 0..80 {
            match self.excess(states) {
                Some(factor) => h *= factor,
                None => break,
            }
            self.scales(states, h);
        }
        h
    }

    /// How much shorter a step must be whose earlier terms exceed the majorant; none when they keep below it.
    fn excess(&self, states: &Series) -> Option<f64> {
        let p = self.order;
        let first = (p - p / 4 - 1).max(p / 2 + 1);
        let mut worst: Option<f64> = None;
        for i in 0..states.n_rows() {
            let a = self.scale[i];
            let terms = states.row(i).iter().zip(&self.powers).zip(&self.bounds).enumerate().take(p - 1).skip(first);
            for (k, ((c_k, power), bound)) in terms {
                // scale and powers may belong to a step two hundredths off: the slack covers it
                if c_k.abs() * power > bound * a {
                    let ratio = c_k.abs() * power / (self.root.powi(k as i32) * a);
                    let factor = ratio.powf(-1.0 / k as f64).clamp(1e-3, 0.9);
                    worst = Some(worst.map_or(factor, |w| w.min(factor)));
                }
            }
        }
        worst
    }

    /// The step that the last two terms allow.
    fn by_last_terms(&mut self, states: &Series, guess: f64, limit: f64) -> f64 {
        let mut h = guess.min(limit);
        for _ in 0..80 {
            let next = (h * self.growth(states, h)).min(limit);
            let settled = next <= 1.02 * h && next >= 0.98 * h;
            h = next;
            if settled {
                // the scales of a step two hundredths longer differ by little: they only judge the defect
                return h;
            }
            if h == 0.0 {
                break;
            }
        }
        self.scales(states, h);
        h
    }

    /// The factor by which h may grow.
    fn growth(&mut self, states: &Series, h: f64) -> f64 {
        let p = self.order;
        self.scales(states, h);
        let (before, last) = (self.powers[p - 1], self.powers[p]);
        let mut worst = (0.0_f64, 0.0_f64);
        for i in 0..states.n_rows() {
            let c = states.row(i);
            let a = self.scale[i];
            if a > 0.0 {
                worst.0 = larger(worst.0, c[p - 1].abs() * before / a);
                worst.1 = larger(worst.1, c[p].abs() * last / a);
            }
        }
        let root = |worst: f64, k: usize| if worst == 0.0 { f64::INFINITY } else { self.root * worst.powf(-1.0 / k as f64) };
        let factor = root(worst.0, p - 1).min(root(worst.1, p));
        // a guess far too long can overflow: come back by decades
        if factor.is_nan() || factor == 0.0 { 1e-3 } else { (factor * self.safety).min(1e3) }
    }

    /// A_i(h).
    fn scales(&mut self, states: &Series, h: f64) {
        let p = self.order;
        let mut power = 1.0;
        for slot in &mut self.powers {
            *slot = power;
            power *= h;
        }
        self.largest.fill(0.0);
        for i in 0..states.n_rows() {
            let c = states.row(i);
            let mut change = largest_term(&c[1..=p / 2], &self.powers[1..]);
            if change == 0.0 {
                change = largest_term(&c[1..=p - 2], &self.powers[1..]);
            }
            self.scale[i] = change;
            let group = &mut self.largest[self.group[i]];
            *group = group.max(change);
        }
        for i in 0..states.n_rows() {
            let floor = (UNIT_SHARE * self.largest[self.group[i]]).max(ROUNDING * states.row(i)[0].abs() / self.tolerance);
            self.scale[i] = self.scale[i].max(floor);
        }
    }
}

/// Order for a tolerance; see the table at the head of the file.
fn order_for(tolerance: f64) -> usize {
    (2.0 - 2.1 * tolerance.log10()).round().min(26.0) as usize
}

/// max_k |c_k| h^k; a term that is not a number counts as infinite.
#[inline]
fn largest_term(c: &[f64], powers: &[f64]) -> f64 {
    c.iter().zip(powers).fold(0.0, |largest, (c_k, power)| larger(largest, c_k.abs() * power))
}

/// Maximum in which a number that is not one wins as infinity.
#[inline]
fn larger(a: f64, b: f64) -> f64 {
    if b <= a {
        a
    } else if b.is_nan() {
        f64::INFINITY
    } else {
        b
    }
}
