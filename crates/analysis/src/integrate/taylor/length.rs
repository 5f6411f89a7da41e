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
//! disturbed (the top; the other tolerances of the two pendulums) are left out.
//!
//! **Adaptation.** A run starts with the order of that rule. Where the part of the motion that limits the step is only a ripple on a smooth change,
//! of share s, the optimum falls to that of the tolerance tol/s; where the series is that of an entire function it rises. So every
//! fourth of the steps whose length the motion limits (not an instant to be hit) estimates what two orders less and two more would cost per unit time. With
//! W_k = max_i |c_ik| h^k / A_i and the pair S_k = max(W_k, tol^(1/p) W_(k-1)), the majorant above admits for order k the step
//!
//! ```text
//! h_k = h exp(-0.7/(k-1)) (tol / S_k)^(1/k) ,    S_(p+2) = S_p (S_p / S_(p-6))^(1/3) ,    S_(p-2) not below S_p
//! ```
//!
//! without new scales, which change as little as the step does. An expansion of order k costs 3 + k + k^2/160 in units of 0.08 us on
//! pendulum-on-shaft: fitted to 1.10, 2.06, 2.66, 3.11 us per step at orders 10, 20, 26, 30 with everything that a step does; the convolutions,
//! quadratic in k, are short vector loops. The saved shares of the work are averaged over about the last three estimates, and when the average
//! exceeds 5 % the next expansion takes the new order and the averages start from zero: single coefficients that happen to be small decide
//! nothing. The lowest order is 8, the highest four above the rule and 26 at most, for the reasons above. A step that is taken back gets its
//! order back. An order that the caller gives is kept. Acceptance does not depend on any of this.

use crate::integrate::Series;
use crate::integrate::step::UNIT_SHARE;
use algebra::elementary;

/// Lowest order.
const LOWEST_ORDER: usize = 4;
/// Highest order that is asked of a system.
pub const HIGHEST_ORDER: usize = 40;
/// See the head of the file.
const SLACK: f64 = 4.0;
/// Changes of a length while it is sought: by thousandths down all decades that numbers have, and some.
pub(crate) const SEARCHES: usize = 300;
/// Half a unit in the last place, halved again.
pub(crate) const ROUNDING: f64 = 1.0 / (1u64 << 54) as f64;

/// Lowest order to which a run adapts.
const LOWEST_ADAPTED: usize = 8;
/// Highest order that the tolerance leads to; see the head of the file.
const HIGHEST_RULED: usize = 26;
/// How far a run may rise above the order that its tolerance leads to.
const RISE: usize = 4;
/// Share of the work whose saving makes a change of order worth while.
const WORTH: f64 = 0.05;
/// Steps from one estimate to the next.
const EVERY: u32 = 4;
/// Weight of the newest estimate in the mean saving.
const NEWEST: f64 = 0.375;

/// Tolerance, order and the numbers that follow from them.
#[derive(Clone, Debug)]
pub(super) struct Rule {
    pub(super) tolerance: f64,
    pub(super) order: usize,
    /// Orders that the run may use, ascending, two apart.
    levels: Vec<Level>,
    /// The present one.
    level: usize,
    /// Shares of the work that two orders less and two orders more would have saved, means over the last steps.
    savings: [f64; 2],
    /// Steps since the last estimate.
    since: u32,
    /// h^k of the last call.
    powers: Vec<f64>,
    /// Components with one unit: index of the group of each state.
    group: Vec<usize>,
    /// A_i of the last call.
    pub(super) scale: Vec<f64>,
    largest: Vec<f64>,
    /// Largest values so far, by group; what is before events counts less and less.
    reach: Vec<f64>,
}

/// What follows from an order.
#[derive(Clone, Debug)]
struct Level {
    order: usize,
    /// Safety factor exp(-0.7/(p-1)), which halves the truncation error (heyoka's choice).
    safety: f64,
    /// tol^(1/p).
    root: f64,
    /// tol^(k/p) 4^(p-k): what the terms before the last two may reach.
    bounds: Vec<f64>,
    /// ln(safety tol^(1/p) / cost).
    merit: f64,
}

/// The safety factor exp(-0.7/(p-1)) of an order, tol^(1/p), and tol^(k/p) 4^(p-k) of all k up to p.
pub(crate) fn limits(tolerance: f64, order: usize) -> (f64, f64, Vec<f64>) {
    let p = order as f64;
    let root = elementary::pow(tolerance, 1.0 / p);
    let bounds = (0..=order).map(|k| elementary::powi(root, k as i32) * elementary::powi(SLACK, (order - k) as i32)).collect();
    (elementary::exp(-0.7 / (p - 1.0)), root, bounds)
}

/// Components with one unit: the index of the group of each, and how many groups there are.
pub(crate) fn groups(units: &[&str]) -> (Vec<usize>, usize) {
    let mut names: Vec<&str> = Vec::new();
    let group = units.iter().map(|unit| {
        names.iter().position(|name| name == unit).unwrap_or_else(|| {
            names.push(unit);
            names.len() - 1
        })
    });
    (group.collect(), names.len())
}

impl Level {
    fn new(tolerance: f64, order: usize) -> Level {
        let p = order as f64;
        let (safety, root, bounds) = limits(tolerance, order);
        Level {
            order,
            safety,
            root,
            bounds,
            merit: -0.7 / (p - 1.0) - elementary::ln(3.0 + p + p * p / 160.0) + elementary::ln(tolerance) / p,
        }
    }

    /// Logarithm of (step per cost) from the logarithm of the share |c_p| h^p / A, up to a summand that all orders have in common.
    fn worth(&self, ln_share: f64) -> f64 {
        self.merit - ln_share / self.order as f64
    }
}

impl Rule {
    /// A given order is kept; the one that follows from the tolerance adapts.
    pub(super) fn new(tolerance: f64, order: Option<usize>, units: &[&str]) -> Rule {
        let ruled = order_for(tolerance);
        let orders = match order {
            Some(order) => vec![order.clamp(LOWEST_ORDER, HIGHEST_ORDER)],
            None => (LOWEST_ADAPTED.min(ruled)..=HIGHEST_RULED.min(ruled + RISE)).filter(|p| p % 2 == ruled % 2).collect(),
        };
        let levels: Vec<Level> = orders.into_iter().map(|p| Level::new(tolerance, p)).collect();
        let level = levels.iter().position(|level| level.order == ruled).unwrap_or(0);
        let (order, room) = (levels[level].order, levels[levels.len() - 1].order + 1);
        let (group, count) = groups(units);
        Rule {
            tolerance,
            order,
            levels,
            level,
            savings: [0.0; 2],
            since: 0,
            powers: vec![0.0; room],
            scale: vec![0.0; group.len()],
            largest: vec![0.0; count],
            reach: vec![0.0; count],
            group,
        }
    }

    /// Old values of the states lose half of their weight.
    pub(super) fn fade_reach(&mut self) {
        self.reach.iter_mut().for_each(|reach| *reach *= 0.5);
    }

    /// Takes note of the values of the states.
    pub(super) fn note_reach(&mut self, x: &[f64]) {
        for (x, group) in x.iter().zip(&self.group) {
            self.reach[*group] = self.reach[*group].max(x.abs());
        }
    }

    /// The largest value so far of the states with the unit of state `i`.
    pub(super) fn reach_of(&self, i: usize) -> f64 {
        self.reach[self.group[i]]
    }

    /// For each state the group of those with its unit, counted from 0.
    pub(super) fn groups(&self) -> &[usize] {
        &self.group
    }

    /// The scales of a step that was made shorter than [`Rule::length`] had found: those of the long one would excuse too much.
    pub(super) fn rescale(&mut self, states: &Series, h: f64) {
        // what has not moved yet is going to move as far as the long step says
        self.reach.iter_mut().zip(&self.largest).filter(|(reach, _)| **reach == 0.0).for_each(|(reach, change)| *reach = *change);
        self.scales(states, h);
    }

    /// Longest admissible step, at most `limit`; `guess` (positive, may be infinite) only saves iterations.
    pub(super) fn length(&mut self, states: &Series, guess: f64, limit: f64) -> f64 {
        let mut h = self.by_last_terms(states, guess, limit);
        for _ in 0..SEARCHES {
            match self.excess(states) {
                Some(factor) => h *= factor,
                None => break,
            }
            self.scales(states, h);
        }
        h
    }

    /// Chooses the order of the next step from the coefficients of this one, whose length has just been found; see the head of the file.
    pub(super) fn adapt(&mut self, states: &Series) {
        self.since = self.since.saturating_add(1);
        if self.levels.len() == 1 || self.since < EVERY {
            return;
        }
        self.since = 0;
        let (p, here) = (self.order, &self.levels[self.level]);
        // the largest shares of terms of two neighbouring orders, ending at p - 6, p - 2, p
        let ends = [p - 6, p - 2, p];
        let mut shares = [0.0_f64; 3];
        for i in 0..states.n_rows() {
            let (c, per_scale) = (states.row(i), 1.0 / self.scale[i]);
            for (share, k) in shares.iter_mut().zip(ends) {
                let pair = (c[k - 1].abs() * self.powers[k - 1] * here.root).max(c[k].abs() * self.powers[k]);
                *share = share.max(pair * per_scale);
            }
        }
        let [far, before, last] = shares.map(elementary::ln);
        if !(far.is_finite() && before.is_finite() && last.is_finite()) {
            return;
        }
        let now = here.worth(last);
        let less = self.level.checked_sub(1).map(|at| self.levels[at].worth(before.max(last)) - now);
        let more = self.levels.get(self.level + 1).map(|level| level.worth(last + (last - far) / 3.0) - now);
        for (mean, gain) in self.savings.iter_mut().zip([less, more]) {
            // the share 1 - exp(-gain), to second order
            let gain = gain.map_or(-1.0, |gain| gain.min(1.0));
            let saving = gain - 0.5 * gain * gain;
            *mean += NEWEST * (saving - *mean);
        }
        let [less, more] = self.savings;
        if less.max(more) > WORTH {
            let level = if less > more { self.level - 1 } else { self.level + 1 };
            self.settle(level);
        }
    }

    /// Back to the order of the step that is repeated.
    pub(super) fn restore(&mut self, order: usize) {
        if self.order != order
            && let Some(level) = self.levels.iter().position(|level| level.order == order)
        {
            self.settle(level);
        }
    }

    /// Goes two orders down; false at the lowest.
    pub(super) fn lower(&mut self) -> bool {
        let lower = self.level.checked_sub(1);
        lower.inspect(|level| self.settle(*level)).is_some()
    }

    fn settle(&mut self, level: usize) {
        self.level = level;
        self.order = self.levels[level].order;
        self.savings = [0.0; 2];
    }

    /// How much shorter a step must be whose earlier terms exceed the majorant; none when they keep below it.
    fn excess(&self, states: &Series) -> Option<f64> {
        let p = self.order;
        let Level { root, bounds, .. } = &self.levels[self.level];
        let first = (p - p / 4 - 1).max(p / 2 + 1);
        let mut worst: Option<f64> = None;
        for i in 0..states.n_rows() {
            let a = self.scale[i];
            let terms = states.row(i).iter().zip(&self.powers).zip(bounds).enumerate().take(p - 1).skip(first);
            for (k, ((c_k, power), bound)) in terms {
                // scale and powers may belong to a step two hundredths off: the slack covers it
                if c_k.abs() * power > bound * a {
                    let ratio = c_k.abs() * power / (elementary::powi(*root, k as i32) * a);
                    // once more with a step that is shorter for sure, and not by more than three decades at once
                    let factor = elementary::pow(ratio, -1.0 / k as f64).clamp(1e-3, 0.9);
                    worst = Some(worst.map_or(factor, |w| w.min(factor)));
                }
            }
        }
        worst
    }

    /// The step that the last two terms allow.
    fn by_last_terms(&mut self, states: &Series, guess: f64, limit: f64) -> f64 {
        let mut h = guess.min(limit);
        for _ in 0..SEARCHES {
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
        let here = &self.levels[self.level];
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
        let root = |worst: f64, k: usize| if worst == 0.0 { f64::INFINITY } else { here.root * elementary::pow(worst, -1.0 / k as f64) };
        let factor = root(worst.0, p - 1).min(root(worst.1, p));
        // a guess far too long can overflow: come back by decades
        if factor.is_nan() || factor == 0.0 { 1e-3 } else { (factor * here.safety).min(1e3) }
    }

    /// A_i(h).
    fn scales(&mut self, states: &Series, h: f64) {
        let p = self.order;
        let mut power = 1.0;
        for slot in &mut self.powers[..=p] {
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
pub fn order_for(tolerance: f64) -> usize {
    (2.0 - 2.1 * elementary::log10(tolerance)).round().min(HIGHEST_RULED as f64) as usize
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
