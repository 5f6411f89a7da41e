//! Which start values move: as few as can be, in a fixed order.
//!
//! A value that is given stays. A guess is there to be moved. A value that is neither is 0 by default, and it stays 0 wherever the connections
//! allow it: of the defaults the smallest set is moved with which all conditions hold, and of several such sets the one whose coordinates
//! stand last in the file, so that the coordinates listed first keep their zeros.
//!
//! Of n defaults all sets are tried by size while they are few. Larger machines take the last coordinates whose columns of J are independent
//! of one another and of those of the guesses (a base of the matroid of columns): with these alone the conditions can be met.
//!
//! Rates are chosen alike, but coordinates without inertia first (their rates are no state that could be kept), then those whose places are
//! guesses or were moved, because these are the followers of the machine.

use super::bench::{Bench, listed};
use super::closing::CLOSED;
use super::level::Level;
use super::rank::sort;
use crate::Fault;
use algebra::arrange::Arrange;
use algebra::random::Random;
use words::Text;
use words::digits::{rounded, seven_digits};

/// Sets of defaults of one size that are tried one after another.
const SETS: usize = 300;
/// Defaults of which all sets are tried.
const FEW: usize = 14;

/// How coordinates that close rows are sought.
#[derive(Clone, Copy)]
enum Search {
    /// From several places about the guess.
    Around,
    /// From the guess alone.
    AtOnce,
}

/// What is to be closed.
struct Trial<'t> {
    guess: &'t [f64],
    rows: &'t [usize],
    /// Those of the rows that do not hold at the guess.
    open: &'t [usize],
    level: Level,
}

impl Bench<'_> {
    /// Values that close the rows with as few defaults moved as can be; none when they do not close with all of them free.
    pub(super) fn closed_by_fewest(&mut self, guess: &[f64], rows: &[usize], level: Level) -> Result<Option<Vec<f64>>, Fault> {
        let (sought, defaults) = self.movable(level);
        let needed = self.base(rows, &sought, &defaults);
        let open = self.open(guess, rows, level)?;
        for size in 0..needed.len() {
            if let Some(x) = self.closed_by(&Trial { guess, rows, open: &open, level }, &sought, &defaults, size)? {
                return Ok(Some(x));
            }
        }
        let free = with(&sought, needed.iter().copied());
        if let Some(x) = self.closed(guess, rows, &free, (level, Search::Around))? {
            return Ok(Some(x));
        }
        if let Some(x) = self.closed_by(&Trial { guess, rows, open: &open, level }, &sought, &defaults, needed.len())? {
            return Ok(Some(x));
        }
        self.closed(guess, rows, &with(&sought, defaults.into_iter()), (level, Search::Around))
    }

    /// The first set of this size that closes the rows at once, while the sets are few.
    fn closed_by(&mut self, trial: &Trial, sought: &[usize], defaults: &[usize], size: usize) -> Result<Option<Vec<f64>>, Fault> {
        if defaults.len() > FEW {
            return Ok(None);
        }
        for set in Sets::new(defaults.len(), size).take(SETS) {
            let free = with(sought, set.iter().map(|i| defaults[*i]));
            if !self.touches(trial.open, &free) {
                continue;
            }
            if let Some(x) = self.closed(trial.guess, trial.rows, &free, (trial.level, Search::AtOnce))? {
                return Ok(Some(x));
            }
        }
        Ok(None)
    }

    /// Rows that do not hold at a state.
    fn open(&mut self, x: &[f64], rows: &[usize], level: Level) -> Result<Vec<usize>, Fault> {
        self.evaluate(x)?;
        let open = |c: &usize| match level {
            Level::Place => self.place(*c).abs() > CLOSED * self.place_size(*c, x),
            Level::Rate => self.rate(*c) != 0.0,
        };
        Ok(rows.iter().copied().filter(open).collect())
    }

    fn closed(&mut self, guess: &[f64], rows: &[usize], free: &[usize], level: (Level, Search)) -> Result<Option<Vec<f64>>, Fault> {
        match level {
            (Level::Rate, _) => self.rates_from(guess, rows, free),
            (Level::Place, Search::Around) => self.closed_from(guess, rows, free),
            (Level::Place, Search::AtOnce) => self.closed_at_once(guess, rows, free),
        }
    }

    /// Coordinates whose value is a guess, and those whose value is a default in the order in which they move.
    fn movable(&self, level: Level) -> (Vec<usize>, Vec<usize>) {
        let k = level.index();
        let coordinates = &self.equations.coordinates;
        let sought = (0..self.n).filter(|j| coordinates[*j].guessed[k] && !coordinates[*j].given[k]).collect();
        let mut defaults: Vec<usize> = (0..self.n).rev().filter(|j| !coordinates[*j].given[k] && !coordinates[*j].guessed[k]).collect();
        if level == Level::Rate {
            // a stable sort: last ones first within each rank
            defaults.arrange_by_key(|j| self.follows(*j));
        }
        (sought, defaults)
    }

    /// Rank of a coordinate whose rate is a default: 0 without inertia, 1 where its place follows from others, 2 otherwise.
    fn follows(&self, j: usize) -> usize {
        let mass = &self.equations.mass;
        let inert = (0..self.n).any(|k| !self.equations.graph.is_zero(mass.get(j, k)));
        match () {
            () if !inert => 0,
            () if self.equations.coordinates[j].guessed[0] || self.moved[j] => 1,
            () => 2,
        }
    }

    /// The first defaults whose columns are independent of one another and of the sought ones, a little beside the start, where no lever hides.
    fn base(&mut self, rows: &[usize], sought: &[usize], defaults: &[usize]) -> Vec<usize> {
        let mut random = Random::new(13);
        let mut best = Vec::new();
        for _ in 0..3 {
            let mut x = self.x.clone();
            (0..self.n).for_each(|j| x[j] += 0.3 * random.between(-1.0, 1.0) * if self.is_angle(j) { 1.0 } else { self.length() });
            if self.evaluate(&x).is_err() {
                continue;
            }
            let column = |j: &usize| -> Vec<f64> { rows.iter().map(|c| self.row(*c)[*j] / self.reach[*j]).collect() };
            let columns: Vec<Vec<f64>> = sought.iter().chain(defaults).map(column).collect();
            let kept = sort(&columns).kept;
            let found: Vec<usize> = kept.into_iter().filter(|k| *k >= sought.len()).map(|k| defaults[k - sought.len()]).collect();
            if found.len() > best.len() {
                best = found;
            }
        }
        let x = self.x.clone();
        let _ = self.evaluate(&x);
        best
    }

    /// Whether each open row depends on a free coordinate: a cheap test before the search.
    fn touches(&self, open: &[usize], free: &[usize]) -> bool {
        open.iter().all(|c| self.equations.conditions[*c].columns.iter().any(|(j, _)| free.contains(j)))
    }

    /// Coordinates whose start or rate was moved from what the file leaves it at.
    pub(super) fn moved_values(&self, before: &[f64]) -> Option<Text> {
        let mut names = Vec::new();
        for (k, level) in [Level::Place, Level::Rate].into_iter().enumerate() {
            for j in 0..self.n {
                let (old, new) = (before[k * self.n + j], self.x[k * self.n + j]);
                let coordinate = &self.equations.coordinates[j];
                if old == new || coordinate.given[level.index()] {
                    continue;
                }
                let unit = Text::unit(&unit_of(&coordinate.unit, level));
                let prime = if k == 0 { "" } else { "'" };
                let (old, new, name) = (rounded(old), seven_digits(new), self.coordinate(j));
                // a guess of the file is shown beside what came of it; zero that nobody gave is not
                let from = match coordinate.guessed[level.index()] {
                    true => Text::new(format!(" (guess {})", old.en), format!(" (начальное приближение {})", old.ru)),
                    false => Text::default(),
                };
                names.push(Text::new(
                    format!("{name}{prime} = {}{}{}", new.en, unit.en, from.en),
                    format!("{name}{prime} = {}{}{}", new.ru, unit.ru, from.ru),
                ));
            }
        }
        let list = listed(names.iter());
        (!names.is_empty()).then(|| {
            Text::new(
                format!("start values found from the connections: {}", list.en),
                format!("начальные значения найдены из уравнений связей: {}", list.ru),
            )
        })
    }
}

fn unit_of(unit: &str, level: Level) -> String {
    match (unit, level) {
        ("" | "1", Level::Place) => String::new(),
        ("" | "1", Level::Rate) => " 1/s".to_owned(),
        (unit, Level::Place) => format!(" {unit}"),
        (unit, Level::Rate) => format!(" {unit}/s"),
    }
}

fn with(sought: &[usize], more: impl Iterator<Item = usize>) -> Vec<usize> {
    let mut free: Vec<usize> = sought.iter().copied().chain(more).collect();
    free.sort_unstable();
    free
}

/// All sets of `size` numbers below `n`, in lexicographic order.
struct Sets {
    n: usize,
    next: Option<Vec<usize>>,
}

impl Sets {
    fn new(n: usize, size: usize) -> Sets {
        Sets { n, next: (size <= n).then(|| (0..size).collect()) }
    }
}

impl Iterator for Sets {
    type Item = Vec<usize>;
    fn next(&mut self) -> Option<Vec<usize>> {
        let now = self.next.take()?;
        let (n, k) = (self.n, now.len());
        if let Some(i) = (0..k).rev().find(|i| now[*i] < n - k + i) {
            let mut after = now.clone();
            after[i] += 1;
            (i + 1..k).for_each(|j| after[j] = after[j - 1] + 1);
            self.next = Some(after);
        }
        Some(now)
    }
}

#[cfg(test)]
mod tests {
    use super::Sets;

    #[test]
    fn sets_come_in_order_and_all_of_them() {
        let sets: Vec<Vec<usize>> = Sets::new(4, 2).collect();
        assert_eq!(sets, [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]]);
        assert_eq!(Sets::new(3, 0).count(), 1);
        assert_eq!(Sets::new(2, 3).count(), 0);
    }
}
