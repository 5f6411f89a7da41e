//! What is asked of branches.

use crate::machine::Machine;
use crate::periodic::{self, Periodic};
use crate::{equilibrium, stability};
use analysis::{Quantity, System};
use mechanics::asked::{Asked, Value};

/// Most points of a branch without a wish.
const POINTS: usize = 2000;
/// The same of a backbone curve: amplitudes grow without bound where the frequency does not.
pub(super) const POINTS_FREE: usize = 300;
/// The same of branches of a backbone curve: at high energies internal resonances part from one another without end.
const BRANCHES_FREE: usize = 1;
/// Name of the frequency of free oscillations, which is no parameter of the file.
const FREQUENCY: &str = "omega_free";
/// The word for free oscillations.
pub(super) const BACKBONE: &str = "backbone";
/// Most branches without a wish.
const BRANCHES: usize = 12;

/// What is followed; SI.
#[derive(Clone, Debug)]
pub(super) struct Branched {
    /// The parameter.
    pub(super) name: String,
    /// Its least value.
    pub(super) from: f64,
    /// Its greatest value.
    pub(super) to: f64,
    /// Most points of a branch.
    pub(super) points: usize,
    /// Most branches.
    pub(super) branches: usize,
    /// The parameter over which folds and period doublings are followed.
    pub(super) second: Option<Beside>,
    /// What is followed.
    pub(super) of: Followed,
    /// The backbone curve that is laid over it.
    pub(super) backbone: Option<Wanted>,
    /// Place of the study of the file that says what a period is: its formulas are read anew with other values.
    pub(super) place: std::ops::Range<usize>,
}

/// A second parameter; SI.
#[derive(Clone, Debug)]
pub(super) struct Beside {
    /// Its name.
    pub(super) name: String,
    /// Its ends.
    pub(super) range: [f64; 2],
    /// Its value in the file.
    pub(super) here: f64,
}

/// The machine without losses and loads, and its mode.
#[derive(Clone, Debug)]
pub(super) struct Wanted {
    /// Values with which nothing is lost and nothing drives.
    pub(super) values: Vec<(String, f64)>,
    /// Number of the mode, from 1.
    pub(super) mode: usize,
}

/// What is followed.
#[derive(Clone, Debug)]
pub(super) enum Followed {
    /// Motions.
    Orbits(Box<Periodic>),
    /// Places of rest.
    Rest,
    /// Free oscillations from a mode, in a range of frequencies, rad/s.
    Free {
        /// Number of the mode, from 1.
        mode: usize,
        /// The range, where it is given.
        range: Option<[f64; 2]>,
    },
}

impl Branched {
    /// Of the study itself; what a period is may stand in a study `periodic` or `stability` of the file instead.
    pub(super) fn of(machine: &Machine, asked: &Asked) -> Branched {
        if asked.word("of") == Some(BACKBONE) {
            return Branched::free(asked);
        }
        let says = |asked: &&Asked| asked.has("period") || asked.has("section");
        let listed = || machine.model.studies.iter().filter(says);
        let other = listed().find(|a| a.kind == periodic::KIND.name).or_else(|| listed().find(|a| a.kind == stability::KIND.name));
        let source = Some(asked).filter(says).or(other).filter(|_| asked.word("of") != Some(equilibrium::KIND.name));
        let source = source.or((asked.word("of") == Some(periodic::KIND.name)).then_some(asked));
        Branched {
            name: asked.word("parameter").unwrap_or_default().to_owned(),
            from: asked.number("from").unwrap_or(0.0),
            to: asked.number("to").unwrap_or(0.0),
            points: asked.count("points").unwrap_or(POINTS),
            branches: asked.count("branches").unwrap_or(BRANCHES),
            second: second(machine, asked),
            of: source.map_or(Followed::Rest, |source| Followed::Orbits(Box::new(Periodic::of(source)))),
            backbone: values(asked).map(|values| Wanted { values, mode: asked.count("mode").unwrap_or(1) }),
            place: source.map_or(0..0, |source| source.span.clone()),
        }
    }
}

impl Branched {
    /// A backbone curve; the ends of its range are known when its mode is.
    fn free(asked: &Asked) -> Branched {
        let range = asked.numbers("frequencies").and_then(|ends| Some([*ends.first()?, *ends.last()?]));
        Branched {
            name: FREQUENCY.into(),
            from: 0.0,
            to: 0.0,
            points: asked.count("points").unwrap_or(POINTS_FREE),
            branches: asked.count("branches").unwrap_or(BRANCHES_FREE),
            second: None,
            of: Followed::Free { mode: asked.count("mode").unwrap_or(1), range },
            backbone: None,
            place: 0..0,
        }
    }
}

/// The values of the key `backbone`: the first of each list.
fn values(asked: &Asked) -> Option<Vec<(String, f64)>> {
    let Some(Value::Ranges(ranges)) = asked.get(BACKBONE) else { return None };
    Some(ranges.iter().filter_map(|range| Some((range.name.clone(), *range.values.first()?))).collect())
}

/// The stretch of the key `second` with the value that the machine has.
fn second(machine: &Machine, asked: &Asked) -> Option<Beside> {
    let Some(Value::Ranges(ranges)) = asked.get("second") else { return None };
    let range = ranges.first()?;
    let ends = [range.values.first(), range.values.last()].map(|end| end.copied().unwrap_or(0.0));
    // what is no parameter has no value that could be changed
    let here = machine.number(&range.name).unwrap_or(f64::NAN);
    Some(Beside { name: range.name.clone(), range: ends, here })
}

/// Printed symbol of a parameter.
pub(super) fn symbol(machine: &Machine, name: &str) -> String {
    machine
        .model
        .notation
        .iter()
        .find(|(n, _)| n == name)
        .map_or_else(|| if name == FREQUENCY { "ω".into() } else { name.to_owned() }, |(_, s)| s.clone())
}

/// Its unit.
pub(super) fn unit(machine: &Machine, name: &str) -> String {
    machine
        .model
        .parameters
        .iter()
        .find(|p| p.name == name)
        .map_or_else(|| if name == FREQUENCY { "rad/s".into() } else { "1".into() }, |p| p.unit.clone())
}

/// Coordinates with their units and symbols.
pub(super) fn coordinates(machine: &Machine) -> Vec<Quantity> {
    let n = machine.system.n_coordinates();
    machine.system.states()[..n].to_vec()
}
