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
//! have every other coefficient zero; a longer run of zeros is caught after the step by its defect (see `Flow::advance`).

use super::step::Series;

/// Lowest order.
const LOWEST_ORDER: usize = 4;
/// Highest order that is asked of a system.
pub const HIGHEST_ORDER: usize = 40;
/// Share of the largest component of a unit below which a smaller one of that unit is not resolved relatively.
const UNIT_SHARE: f64 = 1e-8;
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
        Rule {
            tolerance,
            order,
            safety,
            root,
            powers: vec![0.0; order + 1],
            scale: vec![0.0; group.len()],
            largest: vec![0.0; names.len()],
            group,
        }
    }

    /// Longest admissible step, at most `limit`; `guess` (positive, may be infinite) only saves iterations.
    pub(super) fn length(&mut self, states: &Series, guess: f64, limit: f64) -> f64 {
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

/// Order for a tolerance: Jorba and Zou's -ln(tol)/2 + 1 is optimal for a cost of p^2 per expansion, -ln(tol) for a cost of p. On tapes of machines
/// sums, constant factors and overheads, which cost p, prevail (`cargo bench -p strutt-analysis`: flat optimum from 20 to 30). Orders
/// above 26 make steps so long that the terms of an oscillation exceed its sum tenfold and cancel: digits are lost, time is not gained.
fn order_for(tolerance: f64) -> usize {
    (1.0 - 0.85 * tolerance.ln()).ceil().min(26.0) as usize
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
