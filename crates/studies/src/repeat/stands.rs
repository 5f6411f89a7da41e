//! How places of rest stand: what is compared between neighbouring values.

use crate::machine::Machine;
use analysis::Dataset;
use analysis::studies::rest::contacts::SLACK;
use symbolic::connections::Law;

/// What is known of one place.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Stand {
    /// Contacts that press.
    pub(crate) closed: Vec<String>,
    /// 1 stable, 0 unstable, none undecided.
    pub(crate) stable: Option<bool>,
}

/// The places at one value; none where none was found.
pub(crate) type Stands = Option<Vec<Stand>>;

/// How the places that were found stand.
pub(crate) fn stands(machine: &Machine, data: &Dataset) -> Stands {
    let rows = data.columns.first().map_or(0, |c| c.values.len());
    let value = |name: &str, row: usize| data.column(name).and_then(|c| c.values.get(row).copied()).filter(|v| v.is_finite());
    let reactions = &machine.equations.reactions;
    let one = |row: usize| {
        let largest = reactions.iter().filter_map(|r| value(&r.name, row)).fold(0.0_f64, |m, v| m.max(v.abs()));
        let presses = |name: &str| value(name, row).is_some_and(|v| v > SLACK * largest);
        let contacts = reactions.iter().filter(|r| matches!(r.law, Law::Contact { .. }) && presses(&r.name));
        let plain = |name: &str| name.split_once('(').and_then(|(_, rest)| rest.strip_suffix(')')).unwrap_or(name).to_owned();
        Stand { closed: contacts.map(|r| plain(&r.name)).collect(), stable: value("stable", row).map(|v| v != 0.0) }
    };
    (rows > 0).then(|| (0..rows).map(one).collect())
}
