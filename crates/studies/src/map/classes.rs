//! What places of a map are: regimes, sides of a level, groups of numbers; each stable, unstable or without a word of it; or without a result.

use super::clusters::Groups;
use crate::machine::Machine;
use crate::repeat::gathered::Row;
use crate::repeat::regimes;
use analysis::studies::map::Class;
use words::Text;

/// What tells places apart besides their verdicts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Judge {
    /// The regimes of the file.
    Regimes,
    /// The side of a level of the first number, SI.
    Level(f64),
    /// Gaps between the values of the numbers.
    Gaps,
}

/// A class of places.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Sort {
    /// There is no result.
    Failed,
    /// A regime by its number, or the group of each number; the verdict, and what makes disturbances grow.
    Found(Vec<usize>, Option<bool>, Option<String>),
}

/// What is tinted alike: a regime, and what makes disturbances grow.
pub(super) type Tinted<'a> = (&'a [usize], Option<&'a str>);

/// All classes in the order in which they were met.
#[derive(Clone, Debug)]
pub(super) struct Classes {
    pub(super) judge: Judge,
    /// Groups of values, number by number; empty before the coarse places are known.
    pub(super) groups: Vec<Groups>,
    pub(super) sorts: Vec<Sort>,
}

impl Classes {
    pub(super) fn new(judge: Judge) -> Classes {
        Classes { judge, groups: Vec::new(), sorts: Vec::new() }
    }

    /// Finds the groups of values of the coarse places.
    pub(super) fn group(&mut self, rows: &[Row], cells: u32) {
        let count = rows.iter().filter_map(|row| row.numbers.as_ref().ok()).map(Vec::len).max().unwrap_or(0);
        let values = |k: usize| rows.iter().filter_map(move |row| Some(row.numbers.as_ref().ok()?.get(k)?.0)).filter(|v| v.is_finite());
        self.groups = (0..count).map(|k| Groups::of(values(k).collect(), cells)).collect();
    }

    /// The class of a place.
    pub(super) fn of(&mut self, row: &Row) -> Class {
        let sort = self.sort(row);
        self.sorts.iter().position(|known| *known == sort).unwrap_or_else(|| {
            self.sorts.push(sort);
            self.sorts.len() - 1
        })
    }

    fn sort(&self, row: &Row) -> Sort {
        let Ok(numbers) = &row.numbers else { return Sort::Failed };
        // of events there may be infinitely many: more than any level, and in no group
        if numbers.iter().any(|(value, _)| value.is_nan() || value.is_infinite() && self.judge == Judge::Gaps) {
            return Sort::Failed;
        }
        let which = match self.judge {
            Judge::Regimes => row.regime.into_iter().collect(),
            Judge::Level(level) => numbers.first().map(|(value, _)| usize::from(*value >= level)).into_iter().collect(),
            Judge::Gaps => numbers.iter().zip(&self.groups).map(|((value, _), groups)| groups.which(*value)).collect(),
        };
        Sort::Found(which, row.stable, row.resonance.clone())
    }

    /// The name of a class; `numbers` are the names of what is observed, `level` the level in words.
    pub(super) fn name(&self, machine: &Machine, class: Class, (numbers, level): (&[String], &Text)) -> Text {
        let Some(Sort::Found(which, stable, resonance)) = self.sorts.get(class) else {
            return Text::new("no result", "нет результата");
        };
        let first = which.first().copied().unwrap_or(0);
        let regime = match self.judge {
            Judge::Regimes => Text::same(regimes::name(machine, first).map_or_else(|| "-".to_owned(), str::to_owned)),
            Judge::Level(_) => {
                let (number, sign) = (numbers.first().map_or("", String::as_str), if first == 0 { "<" } else { "≥" });
                Text::new(format!("{number} {sign} {}", level.en), format!("{number} {sign} {}", level.ru))
            }
            Judge::Gaps => {
                let several = self.groups.iter().zip(which).zip(numbers).filter(|((groups, _), _)| groups.count() > 1);
                let parts: Vec<Text> = several.map(|((groups, k), number)| groups.name(*k, number)).collect();
                let join = |pick: fn(&Text) -> &str| parts.iter().map(pick).collect::<Vec<_>>().join(", ");
                Text::new(join(|t| &t.en), join(|t| &t.ru))
            }
        };
        let verdict = match stable {
            // beside places that have one it is a limiting case
            None if regime.en.is_empty() && self.sorts.iter().any(|sort| matches!(sort, Sort::Found(_, Some(_), _))) => {
                Text::new("limiting case", "граничный случай")
            }
            None => return regime,
            Some(true) => Text::new("stable", "устойчиво"),
            Some(false) => match resonance {
                Some(name) => Text::new(format!("unstable ({name})"), format!("неустойчиво ({name})")),
                None => Text::new("unstable", "неустойчиво"),
            },
        };
        if regime.en.is_empty() {
            return verdict;
        }
        Text::new(format!("{}, {}", regime.en, verdict.en), format!("{}, {}", regime.ru, verdict.ru))
    }

    /// Whether a class has no result.
    pub(super) fn is_failed(&self, class: Class) -> bool {
        self.sorts.get(class) == Some(&Sort::Failed)
    }

    /// The verdict of a class.
    pub(super) fn stable(&self, class: Class) -> Option<bool> {
        if let Some(Sort::Found(_, stable, _)) = self.sorts.get(class) { *stable } else { None }
    }

    /// A class without its verdict: what is tinted alike, and what makes disturbances grow there. None without a result.
    pub(super) fn regime(&self, class: Class) -> Option<Tinted<'_>> {
        if let Some(Sort::Found(which, _, resonance)) = self.sorts.get(class) { Some((which, resonance.as_deref())) } else { None }
    }
}
