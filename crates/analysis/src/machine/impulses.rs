//! What impulses do: the works of single ones, and which of them are not unique.
//!
//! Λ(u₋ + u₊)/2 is the work of the impulse Λ of a reaction whose rate jumps from u₋ to u₊, and the sum over all reactions is the change of kinetic energy.
//! Like forces at a state ([`super::open`]), impulses are open along [F; R] d = 0 over everything that holds after the blow, as far as Coulomb's limits let them.

use program::{Mode, Point};

use super::Machine;
use super::conditions::Holds;
use crate::system::Blow;
use crate::{Fault, GuardKind};

impl Machine {
    /// The shown outputs with these reactions and nothing else: powers are those of the reactions.
    fn powers_with(&mut self, (t, x): (f64, &[f64]), reactions: &[f64]) -> Option<Vec<f64>> {
        let n = self.bound.program().coordinates;
        let mut inputs = vec![0.0; self.accelerations.len()];
        let count = inputs.len() - n;
        inputs[n..].copy_from_slice(reactions.get(..count)?);
        let modes = &self.observing;
        let point = Point { time: t, states: x, accelerations: &inputs, modes: Some(&modes.modes), active: Some(&modes.active) };
        let shown = self.observed.evaluate(&point).ok()?;
        let mut values = vec![f64::NAN; self.outputs.len()];
        shown.iter().zip(&self.shown).for_each(|(value, &i)| values[i] = *value);
        Some(values)
    }

    /// Frictions, by guard, that no reaction presses: their limits are forces, not shares of impulses.
    fn of_given_size(&mut self, t: f64, x: &[f64]) -> Vec<usize> {
        let Some(conditions) = &mut self.conditions else { return Vec::new() };
        let Ok(laws) = conditions.laws.evaluate(&Point { time: t, states: x, ..Point::default() }).map(<[f64]>::to_vec) else {
            return Vec::new();
        };
        let own = |row: &super::conditions::Row| match row.holds {
            Holds::Sticking(guard, friction) => {
                let (_, pressing) = conditions.law(friction, &laws);
                pressing.iter().all(|factors| factors.iter().all(|f| *f == 0.0)).then_some(guard)
            }
            _ => None,
        };
        conditions.rows.iter().filter_map(own).collect()
    }

    /// See [`System::impulse_powers`].
    pub(super) fn powers_of(&mut self, t: f64, x: &[f64], modes: &[crate::Mode], impulses: &[f64]) -> Option<Vec<f64>> {
        self.observing.set(modes, &self.bound);
        self.powers_with((t, x), impulses)
    }

    /// See [`System::open_impulses`].
    pub(super) fn open_under(&mut self, t: f64, x: &[f64], modes: &[crate::Mode], blow: &Blow) -> Result<Vec<Vec<f64>>, Fault> {
        self.observing.set(modes, &self.bound);
        // a friction that stands after the blow may take less than its limit, whatever it does then
        for (guard, [_, after]) in &blow.rates {
            if *after == 0.0 && matches!(self.guards[*guard].kind, GuardKind::Friction { .. }) {
                self.observing.modes[*guard] = Mode::Zero;
            }
        }
        // a force of given size gives no impulse in no time: it has no part in what is open
        for guard in self.of_given_size(t, x) {
            self.observing.modes[guard] = Mode::Positive;
        }
        let count = self.bound.program().reactions;
        let unit = |r: &usize| (0..count).map(|k| f64::from(u8::from(k == *r))).collect();
        let mut directions: Vec<Vec<f64>> = self.undetermined.iter().map(unit).collect();
        if blow.reactions.len() == count && self.may_share() {
            let open = self.open_directions((t, x), &blow.reactions)?;
            directions.extend(open.into_iter().flat_map(|open| open.into_directions()));
        }
        Ok(directions)
    }
}
