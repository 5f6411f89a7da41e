//! Which reactions hold a machine at rest: equilibrium, ropes that pull, surfaces that push, friction within its limits.
//!
//! The equations of equilibrium A λ = b leave λ = λ0 + Z y with the columns of Z from the null space of A. Of these
//!
//! ```text
//! λ_k ≥ 0                          a contact
//! |F| ≤ μ |N|                      dry friction at rest; N a linear form of the reactions, or 1 where the limit itself is given
//! ```
//!
//! are admissible. For each choice of the signs of the N it is a linear programme: no y means that the machine does not rest, and the least and greatest λ_k
//! over all admissible y are what statics says about a reaction (A. A. Markeev, Theoretical Mechanics, on friction at rest).

use algebra::qr::{DEPENDENT, Qr};
use algebra::simplex::{Inequality, Optimum, largest};
use algebra::vectors::norm;

/// Slack of inequalities, relative to the largest force: at a limit that is reached exactly rounding decides nothing.
const SLACK: f64 = 1e-9;
/// Slacks within which an inequality counts as met at an end of a range.
const ACTIVE: f64 = 4.0;
/// Slacks below which a range is one value.
const UNSURE: f64 = 100.0;
/// Frictions whose normal force may have either sign; beyond, all are taken as they are in λ0.
const SIGNS: usize = 6;
/// Share of the largest entry of a reaction below which another is rounding: levers are metres and not 1e-15 of them.
const LEVER: f64 = 1e-15;
/// How often what is left of a limit is halved beside what presses: coefficients of friction are not below a thousandth of one another.
const HALVINGS: usize = 12;
/// Share of a direction that counts as none.
const NOTHING: f64 = 1e-9;

/// Dry friction at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// Column of the friction.
    pub column: usize,
    /// Largest magnitude, or the coefficient of |N|.
    pub coefficient: f64,
    /// N = constant + Σ factor λ; none where the limit itself is given.
    pub normal: Option<(f64, Vec<(usize, f64)>)>,
}

/// Everything that can hold.
#[derive(Clone, Debug, Default)]
pub struct Hold {
    /// A solution of the equations.
    pub some: Vec<f64>,
    /// Directions that change no equation.
    pub free: Vec<Vec<f64>>,
    /// What is left of the equations, relative to the largest term.
    pub remainder: f64,
    /// Columns of contacts.
    pub contacts: Vec<usize>,
    /// Frictions.
    pub limits: Vec<Limit>,
}

/// What holds, or why nothing does.
#[derive(Clone, Debug, PartialEq)]
pub enum Holds {
    /// Least and greatest value of each reaction.
    Between(Vec<(f64, f64)>),
    /// This contact would have to pull (a rope: to push).
    WrongSide(usize),
    /// Frictions are too weak; they would hold with limits this many times as large (infinite: never).
    Slips(f64),
}

impl Hold {
    /// Solves A λ = b (row-major, `rows` x `columns`); rows are compared after scaling to entries of the order 1.
    pub fn new(matrix: &[f64], right: &[f64], columns: usize) -> Hold {
        let rows = right.len();
        // the sine of an angle of 1e-54 is no lever: a row of nothing else would be scaled up to an equation
        let widest: Vec<f64> = (0..columns).map(|k| (0..rows).fold(0.0_f64, |m, i| m.max(matrix[i * columns + k].abs()))).collect();
        let settled = |p: usize| if matrix[p].abs() <= LEVER * widest[p % columns.max(1)] { 0.0 } else { matrix[p] };
        let matrix: Vec<f64> = (0..rows * columns).map(settled).collect();
        let size = |i: usize| matrix[i * columns..(i + 1) * columns].iter().fold(0.0_f64, |m, a| m.max(a.abs()));
        let scale: Vec<f64> = (0..rows).map(|i| if size(i) > 0.0 { size(i) } else { 1.0 }).collect();
        let a: Vec<f64> = (0..rows * columns).map(|p| matrix[p] / scale[p / columns.max(1)]).collect();
        let b: Vec<f64> = (0..rows).map(|i| right[i] / scale[i]).collect();
        let some = if columns == 0 { Vec::new() } else { Qr::new(&a, rows, columns).least_squares(&b).0 };
        let mut hold = Hold { some, ..Hold::default() };
        let (mut largest, mut worst) = (0.0_f64, 0.0_f64);
        for i in 0..rows {
            let terms: Vec<f64> = (0..columns).map(|k| a[i * columns + k] * hold.some[k]).collect();
            largest = terms.iter().fold(largest.max(b[i].abs()), |m, t| m.max(t.abs()));
            worst = worst.max((terms.iter().sum::<f64>() - b[i]).abs());
        }
        hold.remainder = if largest > 0.0 { worst / largest } else { 0.0 };
        if columns > 0 {
            hold.free = Qr::alike(&a, rows, columns, DEPENDENT).null_space();
        }
        hold.free.iter_mut().for_each(|z| {
            let length = norm(z);
            z.iter_mut().for_each(|v| *v = if v.abs() <= NOTHING * length { 0.0 } else { *v / length });
        });
        hold
    }

    /// Largest force among the reactions; 1 where there is none.
    fn unit(&self) -> f64 {
        let largest = self.some.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        if largest > 0.0 { largest } else { 1.0 }
    }

    /// Whether a reaction is the same in all solutions of the equations.
    pub fn is_unique(&self, column: usize) -> bool {
        self.free.iter().all(|z| z[column] == 0.0)
    }

    /// The admissible reactions, or why there are none.
    pub fn judge(&self) -> Holds {
        match self.ranges(1.0) {
            Some(ranges) => Holds::Between(ranges),
            None if self.limits.is_empty() || self.sets(f64::INFINITY).all(|set| !self.feasible(&set)) => {
                Holds::WrongSide(self.worst_contact())
            }
            None => Holds::Slips(self.needed()),
        }
    }

    /// Admissible reactions at corners, by column: one at which most is left of each limit, those of the columns named first before the others. Between two walls that may press
    /// however much there is no most: then what presses least beside.
    pub fn corners(&self, first: &[usize]) -> Vec<Vec<f64>> {
        let owner = |k: usize| match k.checked_sub(self.contacts.len()) {
            None => self.contacts[k],
            Some(k) => self.limits[k / 2].column,
        };
        let mut found: Vec<Vec<f64>> = Vec::new();
        for set in self.sets(1.0).filter(|set| self.feasible(set)) {
            let (before, after): (Vec<usize>, Vec<usize>) = (0..set.len()).partition(|k| first.contains(&owner(*k)));
            for k in before.into_iter().chain(after) {
                let Some(y) = self.most_left(k, &set) else { continue };
                let y = at_corner(&y, &set);
                let value =
                    |column: usize| self.some[column] + self.unit() * self.free.iter().zip(&y).map(|(z, y)| z[column] * y).sum::<f64>();
                let corner: Vec<f64> = (0..self.some.len()).map(value).collect();
                let close = |other: &Vec<f64>| other.iter().zip(&corner).all(|(a, b)| (a - b).abs() <= UNSURE * SLACK * self.unit());
                if !found.iter().any(close) {
                    found.push(corner);
                }
            }
        }
        found
    }

    /// The corner at which most is left of an inequality, less what all contacts press where that has no end.
    fn most_left(&self, k: usize, set: &[Inequality]) -> Option<Vec<f64>> {
        let mut wanted = set[k].0.clone();
        for _ in 0..HALVINGS {
            match largest(&wanted, set) {
                Optimum::At(_, y) => return Some(y),
                Optimum::Nowhere => return None,
                Optimum::Unbounded => {
                    wanted.iter_mut().for_each(|w| *w *= 0.5);
                    set[..self.contacts.len()].iter().for_each(|(row, _)| wanted.iter_mut().zip(row).for_each(|(w, a)| *w -= a));
                }
            }
        }
        None
    }

    /// The limit of a friction beside these reactions, by column; none where there is none.
    pub fn limit(&self, column: usize, reactions: &[f64]) -> Option<f64> {
        let limit = self.limits.iter().find(|limit| limit.column == column)?;
        let normal =
            limit.normal.as_ref().map_or(1.0, |(constant, terms)| constant + terms.iter().map(|(k, f)| f * reactions[*k]).sum::<f64>());
        Some(limit.coefficient * normal.abs())
    }

    /// Whether a friction is at its limit on this side whatever the admissible reactions are: elsewhere another share of the load holds the machine further on.
    pub fn is_at_limit(&self, column: usize, side: f64) -> bool {
        let Some(limit) = self.limits.iter().position(|limit| limit.column == column) else { return true };
        let left = |set: &Vec<Inequality>| {
            // what is left of μ |N| on that side, among the inequalities behind those of the contacts
            let (row, constant) = &set[self.contacts.len() + 2 * limit + usize::from(side > 0.0)];
            match largest(row, set) {
                Optimum::At(most, _) => most + constant,
                Optimum::Nowhere => 0.0,
                Optimum::Unbounded => f64::INFINITY,
            }
        };
        self.sets(1.0).all(|set| left(&set) <= UNSURE * SLACK)
    }

    /// The contact that is furthest on the wrong side in the solution at hand.
    fn worst_contact(&self) -> usize {
        self.contacts.iter().copied().min_by(|a, b| self.some[*a].total_cmp(&self.some[*b])).unwrap_or(0)
    }

    /// How many times as large all limits have to be.
    fn needed(&self) -> f64 {
        let holds = |times: f64| self.sets(times).any(|set| self.feasible(&set));
        let (mut low, mut high) = (1.0_f64, 2.0_f64);
        while !holds(high) {
            (low, high) = (high, 4.0 * high);
            if high > 1e9 {
                return f64::INFINITY;
            }
        }
        for _ in 0..60 {
            let middle = (low * high).sqrt();
            if holds(middle) { high = middle } else { low = middle }
        }
        high
    }

    /// Least and greatest value of each reaction with limits so many times as large; none when nothing is admissible.
    fn ranges(&self, times: f64) -> Option<Vec<(f64, f64)>> {
        let mut found: Option<Vec<(f64, f64)>> = None;
        for set in self.sets(times).filter(|set| self.feasible(set)) {
            let ranges: Vec<(f64, f64)> = (0..self.some.len()).map(|k| self.range(k, &set)).collect();
            found = Some(match found {
                None => ranges,
                Some(old) => old.iter().zip(&ranges).map(|(a, b)| (a.0.min(b.0), a.1.max(b.1))).collect(),
            });
        }
        found
    }

    fn range(&self, k: usize, set: &[Inequality]) -> (f64, f64) {
        if self.is_unique(k) {
            return (self.some[k], self.some[k]);
        }
        let unit = self.unit();
        let along: Vec<f64> = self.free.iter().map(|z| z[k]).collect();
        let end = |sign: f64| {
            let c: Vec<f64> = along.iter().map(|a| sign * a).collect();
            match largest(&c, set) {
                Optimum::At(_, y) => {
                    let y = at_corner(&y, set);
                    self.some[k] + unit * along.iter().zip(&y).map(|(a, y)| a * y).sum::<f64>()
                }
                _ => sign * f64::INFINITY,
            }
        };
        let (least, most) = (end(-1.0), end(1.0));
        // slack leaves a range of its own size where there is one value
        if most - least <= UNSURE * SLACK * unit { (0.5 * (least + most), 0.5 * (least + most)) } else { (least, most) }
    }

    fn feasible(&self, set: &[Inequality]) -> bool {
        largest(&vec![0.0; self.free.len()], set) != Optimum::Nowhere
    }

    /// The inequalities over y in units of the largest force, one set for each choice of signs of the normal forces. An infinite `times` leaves
    /// frictions without limits.
    fn sets(&self, times: f64) -> impl Iterator<Item = Vec<Inequality>> + '_ {
        let open: Vec<usize> = (0..self.limits.len()).filter(|i| self.sign(*i).is_none()).take(SIGNS).collect();
        (0..1_usize << open.len()).map(move |choice| {
            let mut set: Vec<Inequality> = self.contacts.iter().map(|k| self.form(0.0, &[(*k, 1.0)])).collect();
            for (i, limit) in self.limits.iter().enumerate().filter(|_| times.is_finite()) {
                let chosen = open.iter().position(|o| *o == i).map(|bit| if choice >> bit & 1 == 0 { 1.0 } else { -1.0 });
                let sign = chosen.or(self.sign(i)).unwrap_or(1.0);
                let mu = times * limit.coefficient * sign;
                let (constant, terms) = limit.normal.clone().unwrap_or((1.0, Vec::new()));
                for side in [1.0, -1.0] {
                    let forms: Vec<(usize, f64)> = terms.iter().map(|(k, f)| (*k, mu * f)).chain([(limit.column, side)]).collect();
                    set.push(self.form(mu * constant, &forms));
                }
            }
            set
        })
    }

    /// The sign of N where the equations or the contacts fix it.
    fn sign(&self, limit: usize) -> Option<f64> {
        let Some((constant, terms)) = &self.limits[limit].normal else { return Some(1.0) };
        let pushed = *constant >= 0.0 && terms.iter().all(|(k, f)| *f >= 0.0 && self.contacts.contains(k));
        if pushed {
            return Some(1.0);
        }
        let unique = terms.iter().all(|(k, _)| self.is_unique(*k));
        let value = constant + terms.iter().map(|(k, f)| f * self.some[*k]).sum::<f64>();
        unique.then_some(if value < 0.0 { -1.0 } else { 1.0 })
    }

    /// constant + Σ factor λ ≥ 0 over y, in units of the largest force.
    fn form(&self, constant: f64, terms: &[(usize, f64)]) -> Inequality {
        let unit = self.unit();
        let value = constant + terms.iter().map(|(k, f)| f * self.some[*k]).sum::<f64>();
        let along = self.free.iter().map(|z| terms.iter().map(|(k, f)| f * z[*k]).sum()).collect();
        (along, value / unit + SLACK)
    }
}

/// The corner nearby at which the inequalities that are met with their slack hold without it.
fn at_corner(y: &[f64], set: &[Inequality]) -> Vec<f64> {
    let left = |(row, g): &Inequality| row.iter().zip(y).map(|(a, y)| a * y).sum::<f64>() + g;
    let active: Vec<&Inequality> = set.iter().filter(|i| left(i) <= ACTIVE * SLACK && i.0.iter().any(|a| *a != 0.0)).collect();
    if active.is_empty() {
        return y.to_vec();
    }
    let matrix: Vec<f64> = active.iter().flat_map(|i| i.0.iter().copied()).collect();
    let missing: Vec<f64> = active.iter().map(|i| SLACK - left(i)).collect();
    let (step, _) = Qr::alike(&matrix, active.len(), y.len(), DEPENDENT).least_squares(&missing);
    y.iter().zip(&step).map(|(y, d)| y + d).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Forces of a few operations: units of the last place.
    const ROUNDING: f64 = 1e-14;
    /// Beside a load of 1e4: rounding of the largest force.
    const LOADED: f64 = 1e-11;

    /// A block of weight 10 on an incline of slope tan a: N = 10 cos a, F = 10 sin a; columns N, F.
    fn block(slope: f64, mu: f64) -> Hold {
        let a = slope.atan();
        let mut hold = Hold::new(&[1.0, 0.0, 0.0, 1.0], &[10.0 * a.cos(), 10.0 * a.sin()], 2);
        hold.contacts = vec![0];
        hold.limits = vec![Limit { column: 1, coefficient: mu, normal: Some((0.0, vec![(0, 1.0)])) }];
        hold
    }

    #[test]
    fn a_block_holds_up_to_its_cone() {
        assert!(matches!(block(0.29, 0.3).judge(), Holds::Between(_)));
        assert!(matches!(block(0.3, 0.3).judge(), Holds::Between(_)));
        let Holds::Slips(times) = block(0.36, 0.3).judge() else { panic!() };
        // bisection ends at that share
        assert!((times - 1.2).abs() < 1e-6);
    }

    #[test]
    fn a_rope_does_not_push() {
        let mut hold = Hold::new(&[1.0], &[-5.0], 1);
        hold.contacts = vec![0];
        assert_eq!(hold.judge(), Holds::WrongSide(0));
    }

    #[test]
    fn two_rough_walls_share_within_limits() {
        // F1 + F2 = 6 with |F1| <= 4, |F2| <= 5
        let mut hold = Hold::new(&[1.0, 1.0], &[6.0], 2);
        hold.limits = vec![Limit { column: 0, coefficient: 4.0, normal: None }, Limit { column: 1, coefficient: 5.0, normal: None }];
        let Holds::Between(ranges) = hold.judge() else { panic!() };
        assert!((ranges[0].0 - 1.0).abs() < ROUNDING && (ranges[0].1 - 4.0).abs() < ROUNDING, "{ranges:?}");
        assert!((ranges[1].0 - 2.0).abs() < ROUNDING && (ranges[1].1 - 5.0).abs() < ROUNDING, "{ranges:?}");
    }

    #[test]
    fn what_is_held_at_both_limits_has_their_value() {
        // F1 + F2 = 9 with |F1| <= 4, |F2| <= 5, beside a force of 10 000 whose rounding is that of no other
        let mut hold = Hold::new(&[1.0, 1.0, 0.0, 0.0, 0.0, 1.0], &[9.0, 1e4], 3);
        hold.limits = vec![Limit { column: 0, coefficient: 4.0, normal: None }, Limit { column: 1, coefficient: 5.0, normal: None }];
        let Holds::Between(ranges) = hold.judge() else { panic!() };
        assert!(ranges[0].0 == ranges[0].1 && (ranges[0].0 - 4.0).abs() < LOADED, "{ranges:?}");
    }
}
