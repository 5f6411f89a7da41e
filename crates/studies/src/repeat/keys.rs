//! Keys of studies that repeat another one: their own that all of them have, and those of the repeated study that their commands take too.

use crate::machine::Machine;
use crate::{Repeats, Studies};
use analysis::Quantity;
use mechanics::asked::{Asked, Key, Kind, Like, Takes, Way};

/// The study that is repeated.
pub const OF: Key = Key::new(
    "of",
    Takes::Repeatable,
    ("kind of the study of the file that is repeated", "вид расчёта из файла, который повторяется"),
    "\"periodic\"",
)
.default("first that fits", "первый подходящий")
.option(
    "The study that is repeated, when the file has several; also --study",
    "Повторяемый расчёт, если в файле их несколько; также --study",
)
.also("study")
.way(Way::Written);

/// Options of every study that is repeated as a motion or at rest, the first of each name, without those of the kind itself; one that gives numbers of its own
/// sort is repeated as the file has it.
pub fn keys(all: &Studies, kind: &Kind) -> Vec<&'static Key> {
    let mut keys: Vec<&'static Key> = Vec::new();
    let repeated = all.iter().filter(|study| matches!(study.repeats(), Repeats::Motion | Repeats::Rest));
    for key in repeated.flat_map(|study| study.kind().keys) {
        let own = kind.key(key.name).is_some() || keys.iter().any(|k| k.name == key.name);
        // rows and columns are those that are observed; names of coordinates need the study in the file
        let idle = matches!(key.takes, Takes::Results | Takes::Moments | Takes::Step);
        // what goes along a parameter itself is not repeated over others
        let along = matches!(key.takes, Takes::Varied | Takes::Quantity(Like::Of("parameter"), _));
        let usable =
            key.option.is_some() && !idle && !along && !matches!(key.takes, Takes::Coordinate | Takes::RangeOf(_) | Takes::Section);
        if !own && usable {
            keys.push(key);
        }
    }
    keys
}

/// What is asked of the repeated study: all that is no key of the kind itself.
pub fn inner(asked: &Asked, kind: &Kind) -> Asked {
    let mut inner = Asked::default();
    let others = asked.values().iter().filter(|(key, _)| kind.key(key).is_none());
    others.for_each(|(key, value)| inner.set(key, value.clone()));
    inner
}

/// The quantity of a parameter, a start or a starting rate.
pub fn quantity(machine: &Machine, name: &str) -> Quantity {
    let model = &machine.model;
    let base = name.trim_end_matches('\'');
    let primes = name.len() - base.len();
    let symbol = model.notation.iter().find(|(n, _)| n == base).map_or(base, |(_, s)| s.as_str());
    let mut quantity = Quantity { symbol: format!("{symbol}{}", "'".repeat(primes)), ..Quantity::new(name, "1") };
    if let Some(p) = model.parameters.iter().find(|p| p.name == name) {
        (quantity.unit, quantity.label) = (p.unit.clone(), p.label.clone());
    } else if let Some(c) = model.coordinates.iter().find(|c| c.name == base) {
        quantity.unit = c.units.get(primes).cloned().unwrap_or_default();
    }
    quantity
}
