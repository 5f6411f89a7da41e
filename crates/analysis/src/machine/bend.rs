//! Places that formulas bend. Positions and rates of the coordinates run on through a switch; where a formula that places a body has a kink or a step there, the body
//! changes its velocity or its place although nothing acts on it:
//!
//! ```text
//! T = q'ᵀ M q'/2 + b·q' + c        (M₊ - M₋) q' = 0     momenta; b jumps with prescribed velocities, see `jolt.rs`
//! g(q, t) = 0                      g₊ = g₋, J₊ q' = J₋ q'    what holds by a condition
//! ```
//!
//! The potential energy does not jump either but by switches of time: a pathway with a step would do its work in no time.
//!
//! What happens there (a catch, a stop, a blow with or without loss) no formula of places says: refused. A contact has a law of its own: a gap that jumps open, or
//! whose rate becomes positive, lets it go; one whose rate becomes negative is struck, by its restitution.

use algebra::elementary;

use super::Machine;
use super::conditions::Conditions;
use super::leap::Leap;
use crate::fault::bends;
use crate::system::Bends;
use crate::{Fault, GuardKind, Mode};
use words::Text;

/// Share of its size above which a momentum, a rate or a place jumps.
const FELT: f64 = 1e-9;
/// Share of the time, and of that in which the machine moves by its own size, in which both sides are looked at: far beyond the rounding of the instant.
const BESIDE: f64 = 1e-9;
/// The longest such time, in those that have passed.
const AGES: f64 = 1e4;

impl Machine {
    /// See [`crate::System::bend`].
    ///
    /// *Errors*: S137 to S140 what jumps otherwise.
    pub(super) fn pass_bend(&mut self, (t, x): (f64, &[f64]), modes: [&[Mode]; 2]) -> Result<Bends, Fault> {
        let flipped = (0..self.guards.len()).filter(|&i| modes[0][i] != modes[1][i]);
        let switch = crate::connections::listed(flipped.map(|i| &self.guards[i].name));
        let Some(beside) = Beside::new((t, x), self.n_coordinates_of()) else { return Ok(Bends::default()) };
        let Some(sides) = self.modes_beside(&beside, modes) else { return Ok(Bends::default()) };
        let sides = [&sides[0][..], &sides[1][..]];
        if self.momentum_jumps((t, x), sides) {
            return Err(bends::bent_place(&switch, t));
        }
        if self.potential_jumps(&beside, sides) {
            return Err(bends::broken_pathway(&switch, t));
        }
        if self.body_jumps(&beside) {
            return Err(bends::broken_place(&switch, t));
        }
        match &mut self.conditions {
            Some(conditions) => conditions.pass_bend(&beside, modes[0], &switch),
            None => Ok(Bends::default()),
        }
    }

    fn n_coordinates_of(&self) -> usize {
        self.bound.program().coordinates
    }

    /// The modes on both sides: a switch that decides something on one side only has its value there. None where a formula has none.
    fn modes_beside(&mut self, beside: &Beside, modes: [&[Mode]; 2]) -> Option<[Vec<Mode>; 2]> {
        let mut side = |k: usize| {
            let (t, x) = &beside.sides[k][0];
            let values = self.bound.modes(*t, x).ok()?;
            let mode = |i: usize| if self.guards[i].kind == GuardKind::Switch { values[i] } else { modes[k][i] };
            Some((0..self.guards.len()).map(mode).collect())
        };
        Some([side(0)?, side(1)?])
    }

    /// q'ᵀ (M₊ - M₋) d for a direction d that nothing distinguishes; T is a quadratic form.
    fn momentum_jumps(&mut self, (t, x): (f64, &[f64]), modes: [&[Mode]; 2]) -> bool {
        let n = self.n_coordinates_of();
        let rates = &x[n..2 * n];
        let fastest = rates.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        let way: Vec<f64> = (0..n).map(|j| fastest * (1.0 + 0.5 * elementary::sin(2.0 + 3.0 * j as f64))).collect();
        let sum: Vec<f64> = rates.iter().zip(&way).map(|(v, d)| v + d).collect();
        let still = vec![0.0; n];
        let [before, after] = modes.map(|modes| {
            let mut energy = |rates: &[f64]| self.kinetic_of((t, x), modes, rates);
            let [both, own, other, none] = [energy(&sum)?, energy(rates)?, energy(&way)?, energy(&still)?];
            Some((both - own - other + none, both.abs().max(own.abs()).max(other.abs())))
        });
        let (Some((before, size)), Some((after, other))) = (before, after) else { return false };
        (after - before).abs() > FELT * size.max(other)
    }

    fn kinetic_of(&mut self, (t, x): (f64, &[f64]), modes: &[Mode], rates: &[f64]) -> Option<f64> {
        let n = rates.len();
        let mut y = x.to_vec();
        y[n..2 * n].copy_from_slice(rates);
        Some(self.levels(t, &y, modes)?[0])
    }

    /// Whether the potential energy jumps where a place decides the switch. A stiffness may jump with the time.
    fn potential_jumps(&mut self, beside: &Beside, modes: [&[Mode]; 2]) -> bool {
        let levels = beside.each(|t, x| self.levels(t, x, modes[usize::from(t > beside.instant)]).map(|levels| levels.to_vec()));
        // kinetic, then potential
        let jumps = levels.is_some_and(|leap| leap.of(1).abs() > FELT * leap.size(0).max(leap.size(1)));
        jumps && !self.is_timed(beside, modes)
    }

    /// Whether time alone takes one of the changing switches to its other side.
    fn is_timed(&mut self, beside: &Beside, modes: [&[Mode]; 2]) -> bool {
        let [Ok(earlier), Ok(later)] = beside.times().map(|t| self.bound.modes(t, &beside.here)) else { return true };
        (0..self.guards.len()).any(|i| modes[0][i] != modes[1][i] && earlier[i] != later[i])
    }

    /// Whether a body stands elsewhere afterwards.
    fn body_jumps(&mut self, beside: &Beside) -> bool {
        let places = beside.each(|t, x| {
            let point = program::Point { time: t, states: x, accelerations: &self.accelerations, ..program::Point::default() };
            self.placements.evaluate(&point).ok().map(<[f64]>::to_vec)
        });
        places.is_some_and(|leap| leap.is_felt(FELT))
    }
}

/// Two instants before this one and two after it, with the states there: the nearer first.
pub(super) struct Beside {
    instant: f64,
    here: Vec<f64>,
    sides: [[(f64, Vec<f64>); 2]; 2],
}

impl Beside {
    /// None at the very beginning of a machine at rest.
    fn new((t, x): (f64, &[f64]), n: usize) -> Option<Beside> {
        let largest = |list: &[f64]| list.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        let fastest = largest(&x[n..2 * n]);
        let own = if fastest > 0.0 { largest(&x[..n]) / fastest } else { 0.0 };
        // rates that end in zero leave rounding, which would take ages
        let own = if t == 0.0 { own } else { own.min(AGES * t.abs()) };
        let gap = BESIDE * t.abs().max(own);
        let at = |steps: f64| {
            let mut y = x.to_vec();
            (0..n).for_each(|j| y[j] += steps * gap * x[n + j]);
            (t + steps * gap, y)
        };
        (gap > 0.0 && gap.is_finite()).then(|| Beside { instant: t, here: x.to_vec(), sides: [[at(-1.0), at(-2.0)], [at(1.0), at(2.0)]] })
    }

    /// Values at all of them; none where a formula has none.
    fn each(&self, mut values: impl FnMut(f64, &[f64]) -> Option<Vec<f64>>) -> Option<Leap> {
        let mut side = |[near, far]: &[(f64, Vec<f64>); 2]| Some([values(near.0, &near.1)?, values(far.0, &far.1)?]);
        Some(Leap { before: side(&self.sides[0])?, after: side(&self.sides[1])? })
    }

    /// The nearer instants.
    fn times(&self) -> [f64; 2] {
        [self.sides[0][0].0, self.sides[1][0].0]
    }
}

impl Conditions {
    fn pass_bend(&mut self, beside: &Beside, modes: &[Mode], switch: &Text) -> Result<Bends, Fault> {
        let (places, rates) = (beside.each(|t, x| self.places_at(t, x)), beside.each(|t, x| self.rates_at(t, x).ok()));
        let (Some(places), Some(rates)) = (places, rates) else { return Ok(Bends::default()) };
        let (t, x) = (beside.instant, &beside.sides[0][0].1);
        // a velocity that jumps with the time alone is prescribed
        let prescribed = self.steps(beside.times(), x)?;
        let mut found = Bends::default();
        let mut bent = Vec::new();
        for row in 0..self.rows.len() {
            let (leap, size) = (places.of(row), self.size_of_place(row, x));
            let contact = self.contact_of(row);
            let holds = self.holds_in(row, modes);
            let felt = leap.abs() > FELT * size;
            let rate = rates.after[0][row];
            let turns =
                holds && !prescribed && rates.of(row).abs() > FELT * rates.size(row).max(self.rate_size(row, &x[self.n..2 * self.n]));
            match contact {
                Some(guard) if felt && places.after[0][row] > FELT * size => found.opens.extend(holds.then_some(guard)),
                Some(_) if felt && places.after[0][row] < -FELT * size => {
                    return Err(bends::broken_condition(&self.rows[row].name, (switch, t)));
                }
                None if felt && holds => return Err(bends::broken_condition(&self.rows[row].name, (switch, t))),
                Some(guard) if turns && rate > 0.0 => found.opens.push(guard),
                Some(guard) if turns => found.strikes.push(guard),
                None if turns => bent.push(row),
                _ => {}
            }
        }
        // a wheel does not roll on a track that it leaves, and is struck with it
        let free =
            |row: &usize| self.rough_on(*row).is_some_and(|contact| found.opens.contains(&contact) || found.strikes.contains(&contact));
        match bent.into_iter().find(|row| !free(row)) {
            Some(row) => Err(bends::bent_condition(&self.rows[row].name, (switch, t))),
            None => Ok(found),
        }
    }
}
