//! A state of a machine on what its conditions on rates have kept since another one: see `integrals.rs`.

use super::conditions::{Conditions, Holds, Row};
use super::integrals::{Form, Rows};
use crate::connections::surface::Instant;
use crate::{Fault, Mode, Since};
use program::Bound;

impl Conditions {
    /// See [`crate::System::rejoin`].
    pub(super) fn rejoin(&mut self, (t, x): (f64, &mut [f64]), (modes, bound): (&[Mode], &Bound), from: Since<'_>) -> Result<f64, Fault> {
        self.count_from((modes, bound), from)?;
        let done = self.project(t, x, (modes, bound));
        self.kept.from = None;
        done
    }

    /// See [`crate::System::kept`].
    pub(super) fn kept_at(&mut self, (t, x): (f64, &[f64]), (modes, bound): (&[Mode], &Bound), from: Since<'_>) -> Result<Vec<f64>, Fault> {
        self.count_from((modes, bound), from)?;
        let done = self.count(t, x);
        self.kept.from = None;
        done.map(|()| self.kept.places.clone())
    }

    /// From now on conditions on rates have places, counted from this state.
    fn count_from(&mut self, (modes, bound): (&[Mode], &Bound), Since { t, x, closed }: Since<'_>) -> Result<(), Fault> {
        self.sides.set(modes, bound);
        let base = (t, x[..self.n].to_vec());
        if self.kept.forms.is_none() || self.kept.closed != closed {
            self.kept.closed = closed.to_vec();
            let lasts = |row: &&Row| match row.holds {
                Holds::Always => true,
                Holds::Sticking(guard, _) | Holds::Closed(guard, _) | Holds::Rough(guard) => closed.contains(&guard),
            };
            let placed = self.rows.iter().filter(|row| row.has_place && lasts(row));
            self.kept.surface = placed.map(|row| row.condition).collect();
            let asked = |row: &Row| (!row.has_place && lasts(&row)).then_some(row.condition);
            let asked: Vec<Option<usize>> = self.rows.iter().map(asked).collect();
            let mut rows = self.still();
            let forms = asked.iter().map(|condition| condition.map_or(Ok(Form::None), |c| rows.form(c, &base)));
            self.kept.forms = Some(forms.collect::<Result<_, _>>()?);
        }
        self.kept.from = Some(base);
        Ok(())
    }

    /// c of all rows at a state.
    ///
    /// *Errors*: a formula without a value on the way.
    pub(super) fn count(&mut self, t: f64, x: &[f64]) -> Result<(), Fault> {
        let Some(from) = self.kept.from.take() else { return Ok(()) };
        let to = (t, x[..self.n].to_vec());
        let places = (0..self.rows.len()).map(|row| self.counted(row, &from, &to)).collect::<Result<Vec<f64>, Fault>>();
        self.kept.from = Some(from);
        self.kept.places = places?;
        Ok(())
    }

    fn counted(&mut self, row: usize, from: &Instant, to: &Instant) -> Result<f64, Fault> {
        let form = self.kept.forms.as_ref().map_or(Form::None, |forms| forms[row]);
        let condition = self.rows[row].condition;
        match form {
            Form::None => Ok(0.0),
            Form::Integral => Ok(self.still().along(condition, (from, to))?.0),
            Form::Within => Ok(self.still().within(condition, (from, to))?.0),
            Form::Constant => {
                let mut rows = self.still();
                let (levers, _) = rows.of(condition, (from.0, &from.1))?;
                let later = (to.0, from.1.clone());
                let passed = rows.along(condition, (from, &later))?.0;
                Ok(levers.iter().zip(&to.1).zip(&from.1).map(|((j, a), b)| j * (a - b)).sum::<f64>() + passed)
            }
        }
    }

    fn still(&mut self) -> Rows<'_> {
        let at = [self.roots.jacobian.start, self.roots.rates.start, self.roots.places.start];
        Rows { evaluator: &mut self.evaluator, sides: &self.sides, at, surface: &self.kept.surface, n: self.n }
    }

    /// Whether a row has a place now: its own, or one that is counted.
    pub(super) fn counts(&self, row: usize) -> bool {
        self.kept.from.is_some() && self.kept.forms.as_ref().is_some_and(|forms| forms[row] != Form::None)
    }
}
