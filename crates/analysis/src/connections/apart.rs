//! Guesses on the wrong side of a contact.
//!
//! A guess says where the search for a start begins, and a stop or a rope allows one side of its surface only. Where the guess lies on the other side the nearest
//! allowed configuration is on the surface: the rope is taut, the stop is touched. One surface after another is closed, the most violated one first, by moving guesses
//! alone; a contact that only given values violate, or that guesses cannot clear, is left to the study, which refuses it (S012).

use super::bench::Bench;
use super::closing::CLOSED;
use crate::Fault;
use symbolic::connections::Law;

impl Bench<'_> {
    /// Moves guesses so that no contact that depends on them is penetrated.
    pub(super) fn keep_apart(&mut self) -> Result<(), Fault> {
        let sought = self.sought_places();
        let mut rows: Vec<usize> = self.lasting().into_iter().filter(|c| self.equations.conditions[*c].place.is_some()).collect();
        while let Some(worst) = self.most_penetrated(&rows, &sought)? {
            rows.push(worst);
            match self.closed_from(&self.x.clone(), &rows, &sought)? {
                Some(x) => self.x = x,
                None => return Ok(()),
            }
        }
        Ok(())
    }

    /// Coordinates whose place is a guess.
    fn sought_places(&self) -> Vec<usize> {
        let is_guess = |j: &usize| self.equations.coordinates[*j].guessed[0] && !self.equations.coordinates[*j].given[0];
        (0..self.n).filter(is_guess).collect()
    }

    /// The contact beyond those in `rows` with the most negative gap against its size, which a guess can change.
    fn most_penetrated(&mut self, rows: &[usize], sought: &[usize]) -> Result<Option<usize>, Fault> {
        self.evaluate(&self.x.clone())?;
        let depth = |c: usize| self.place(c) / self.place_size(c, &self.x);
        let is_contact = |c: usize| {
            let reaction = self.equations.conditions[c].reaction;
            reaction.is_some_and(|r| matches!(self.equations.reactions[r].law, Law::Contact { .. }))
        };
        let penetrated = (0..self.equations.conditions.len())
            .filter(|c| !rows.contains(c) && is_contact(*c) && depth(*c) < -CLOSED)
            .filter(|c| sought.iter().any(|j| self.row(*c)[*j] != 0.0));
        Ok(penetrated.min_by(|a, b| depth(*a).total_cmp(&depth(*b))))
    }
}
