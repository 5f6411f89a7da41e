//! Which of several admissible sets of modes holds.
//!
//! A static limit above the kinetic one, or a friction that presses itself, makes several sets admissible: a block that stands under a load between both
//! limits may go on standing or slide. A set changes only as far as the event forces it to. So where the pivoting has left the suggestion of the event
//! (`modes.rs`: everything else as before, what fired or struck closed and sticking), the sets nearer to it are tried too: some of the departures taken
//! back, what fired in any of its modes. Preferred is the set with fewest departures among those that did not fire, then with fewest at all.

use crate::integrate::taylor::Flow;
use crate::{Fault, GuardKind, Mode, System};
use algebra::arrange::Arrange;

use crate::integrate::crossings::Verdict;

/// Most sets that are tried.
const TRIED: usize = 64;
/// Most sets that are ranked.
const RANKED: usize = 6561;

/// A set between: modes of the guards that may differ, and its rank.
type Between = ([usize; 2], Vec<Mode>);

impl<S: System + ?Sized> Flow<'_, S> {
    /// Leaves the present set, which is admissible, for one nearer to `suggested`, if there is any. `tried`: sets that are not.
    pub(super) fn prefer(&mut self, suggested: &[Mode], tried: &[Vec<Mode>]) -> Result<(), Fault> {
        let left = self.departures(suggested);
        if left.is_empty() || !self.system.guards().iter().any(|g| matches!(g.kind, GuardKind::Friction { .. })) {
            return Ok(());
        }
        let found = self.modes.clone();
        let open = self.in_question(suggested, &left);
        let between = self.nearer(suggested, &open, self.rank(&left));
        let mut moved = false;
        for (rank, modes) in between {
            let mode = |i: usize| open.iter().position(|k| *k == i).map_or(found[i], |k| modes[k]);
            if tried.iter().any(|set| (0..found.len()).all(|i| !self.holds(i) || set[i] == mode(i))) {
                continue;
            }
            moved = true;
            open.iter().zip(&modes).for_each(|(&i, mode)| self.leaving[i] |= *mode != Mode::Zero);
            if self.try_combination((&open, &modes), &found) && self.rank(&self.departures(suggested)) <= rank {
                return Ok(());
            }
        }
        self.modes = found;
        match if moved { self.attempt()? } else { Verdict::Holds } {
            Verdict::Holds => Ok(()),
            _ => Err(self.no_modes(left[0])),
        }
    }

    fn holds(&self, i: usize) -> bool {
        matches!(self.system.guards()[i].kind, GuardKind::Friction { .. } | GuardKind::Contact { .. })
    }

    /// Contacts and frictions that the suggestion holds and the present set does not.
    fn departures(&self, suggested: &[Mode]) -> Vec<usize> {
        let left = |i: &usize| suggested[*i] == Mode::Zero && self.modes[*i] != Mode::Zero && !self.is_off(*i);
        (0..self.modes.len()).filter(|i| self.holds(*i)).filter(left).collect()
    }

    /// What may be other than found: the departures, and what fired and is on its surface.
    fn in_question(&self, suggested: &[Mode], left: &[usize]) -> Vec<usize> {
        let fired = |i: usize| self.fired[i] && suggested[i] == Mode::Zero && self.holds(i) && !self.is_off(i);
        (0..suggested.len()).filter(|&i| left.contains(&i) || fired(i)).collect()
    }

    /// Departures of those that did not fire, and of all.
    fn rank(&self, left: &[usize]) -> [usize; 2] {
        [left.iter().filter(|i| !self.fired[**i]).count(), left.len()]
    }

    /// Sets of lower rank, the lowest first.
    fn nearer(&self, suggested: &[Mode], open: &[usize], rank: [usize; 2]) -> Vec<Between> {
        let choices = |i: usize| match self.system.guards()[i].kind {
            GuardKind::Friction { .. } if suggested[i] == Mode::Zero => vec![Mode::Zero, Mode::Positive, Mode::Negative],
            _ => vec![Mode::Zero, Mode::Positive],
        };
        let mut all: Vec<Between> = vec![([0, 0], Vec::new())];
        for &i in open {
            let unfired = usize::from(!self.fired[i]);
            let with = |(own, modes): &Between, mode: Mode| {
                let more = usize::from(mode != Mode::Zero);
                ([own[0] + unfired * more, own[1] + more], [&modes[..], &[mode]].concat())
            };
            all = choices(i).into_iter().flat_map(|mode| all.iter().map(move |set| with(set, mode)).collect::<Vec<_>>()).collect();
            all.retain(|(own, _)| *own < rank);
            all.arrange_by_key(|(own, _)| *own);
            all.truncate(RANKED);
        }
        all.truncate(TRIED);
        all
    }
}
