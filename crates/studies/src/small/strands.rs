//! Strands of belts that only pull, tracks and stops that only push, in forced oscillations: at which frequencies the motion asks for more.

use super::touching::{self, Level, Touching};
use crate::strands::ROUNDING;
use analysis::Fault;
use analysis::linear::{LinearMachine, Place};
use analysis::marks::pushes::{Beyond, Push};
use analysis::studies::least::{Least, least};
use analysis::studies::response::{Forced, Source};
use analysis::studies::rest::contacts::Contacts;
use symbolic::Expr;
use words::{Language, Text};

/// Halvings of an interval in which a bound lies.
const HALVINGS: usize = 40;

/// A force or a gap that must not be negative.
#[derive(Clone, Debug)]
pub struct Watched {
    /// `slack_side(S)`, `normal(F)` or `force(S)`.
    pub name: String,
    /// What it is.
    pub formula: Expr,
    /// What holds it.
    pub kind: Kind,
}

/// What must not be negative.
#[derive(Clone, Debug)]
pub enum Kind {
    /// A connection that the equations hold both ways.
    BothWays(Push),
    /// A one-sided contact as it stands at rest.
    Contact(Touching),
}

/// A force or a gap that has the wrong sign at times.
#[derive(Clone, Debug, PartialEq)]
pub struct Slack {
    /// `slack_side(S)`, `normal(F)` or `force(S)`.
    pub name: String,
    /// Frequencies from and to, rad/s.
    pub bands: Vec<[f64; 2]>,
    /// Of a contact: `opens` or `closes`, and from which share of the load on, where that is least.
    pub contact: Option<(&'static str, Level)>,
    /// In words.
    pub remark: Text,
}

/// Forces and gaps of the wrong sign at frequencies in `ends`; `places` are where it is looked, in any order, also outside.
///
/// # Errors
/// A formula has no value at one of the frequencies.
pub fn slack(
    machine: &mut LinearMachine,
    rest: (&Place, &[Vec<f64>]),
    watched: &[Watched],
    (source, parameter): (Source, Option<usize>),
    (ends, places): ([f64; 2], &[f64]),
) -> Result<Vec<Slack>, Fault> {
    // a unit load has no size
    if watched.is_empty() || matches!(source, Source::Unit(_)) {
        return Ok(Vec::new());
    }
    let formulas: Vec<Expr> = watched.iter().map(|w| w.formula).collect();
    let own = parameter.map(|p| machine.value(p));
    let mut forced = Forced::new(machine, rest, source, parameter, &formulas)?;
    forced.cover(ends)?;
    let mut omegas: Vec<f64> = places.iter().copied().filter(|w| (ends[0]..=ends[1]).contains(w)).collect();
    omegas.sort_by(f64::total_cmp);
    omegas.dedup();
    let rows = omegas.iter().map(|w| least(&mut forced, *w)).collect::<Result<Vec<_>, _>>()?;
    let mut list = Vec::new();
    let mut first = 0;
    // both strands of a belt are one name
    for both in watched.chunk_by(|a, b| a.name == b.name) {
        let own = first..first + both.len();
        first = own.end;
        let wrong = |row: &[Least]| row[own.clone()].iter().any(is_wrong);
        let holds: Vec<bool> = rows.iter().map(|row| wrong(row)).collect();
        let found = bands(&omegas, &holds, |w| Ok(wrong(&least(&mut forced, w)?)))?;
        if !found.is_empty() {
            let levels = omegas.iter().zip(&rows).map(|(omega, row)| Level { share: share(&row[own.start]), omega: *omega });
            let lowest = levels.min_by(|a, b| a.share.total_cmp(&b.share));
            let (contact, remark) = match (&both[0].kind, lowest) {
                (Kind::Contact(contact), Some(level)) => {
                    (Some((contact.change(), level)), touching::remark(contact, &listed(&found), level))
                }
                (Kind::Contact(_), None) => continue,
                (Kind::BothWays(push), _) => (None, remark(push, &found)),
            };
            list.push(Slack { name: both[0].name.clone(), remark, bands: found, contact });
        }
    }
    own.map_or(Ok(()), |value| forced.restore(value))?;
    Ok(list)
}

fn is_wrong(force: &Least) -> bool {
    force.least < -ROUNDING * force.mean.abs()
}

/// Contacts that change within the amplitudes. One whose force is not unique (a bar on three stops) says nothing.
pub(super) fn touched(
    machine: &mut LinearMachine,
    rest: (&Place, &[Vec<f64>]),
    contacts: Option<&Contacts>,
    load: (Source, Option<usize>),
    along: ([f64; 2], &[f64]),
) -> Vec<Slack> {
    let one = |(name, formula, touching): (String, Expr, Touching)| Watched { name, formula, kind: Kind::Contact(touching) };
    let watched: Vec<Watched> = touching::contacts(machine, contacts).into_iter().map(one).collect();
    let own = load.1.map(|p| (p, machine.value(p)));
    let mut look = |list: &[Watched]| {
        let found = slack(machine, rest, list, load.clone(), along);
        if let (Err(_), Some((parameter, value))) = (&found, own) {
            // formulas had a value for it before
            machine.set(parameter, value).ok();
        }
        found
    };
    match look(&watched) {
        Ok(found) => found,
        Err(_) => watched.iter().filter_map(|contact| look(std::slice::from_ref(contact)).ok()).flatten().collect(),
    }
}

/// Share of the load at which a value that must not be negative comes to zero.
fn share(value: &Least) -> f64 {
    let room = value.mean - value.least;
    match () {
        () if value.mean <= 0.0 => 0.0,
        () if room > 0.0 => value.mean / room,
        () => f64::INFINITY,
    }
}

/// Intervals of the frequencies for which something holds, their bounds halved in.
fn bands(omegas: &[f64], holds: &[bool], mut at: impl FnMut(f64) -> Result<bool, Fault>) -> Result<Vec<[f64; 2]>, Fault> {
    let mut found: Vec<[f64; 2]> = Vec::new();
    for (i, omega) in omegas.iter().enumerate().filter(|(i, _)| holds[*i]) {
        let before = i.checked_sub(1);
        match (before, found.last_mut()) {
            (Some(j), Some(band)) if holds[j] => band[1] = *omega,
            (Some(j), _) => found.push([bound(omegas[j], *omega, &mut at)?, *omega]),
            (None, _) => found.push([*omega; 2]),
        }
        if let (Some(next), Some(band)) = (omegas.get(i + 1).filter(|_| !holds[i + 1]), found.last_mut()) {
            band[1] = bound(*next, *omega, &mut at)?;
        }
    }
    Ok(found)
}

/// Where it begins to hold between two frequencies; it does at the second.
fn bound(mut not: f64, mut held: f64, at: &mut impl FnMut(f64) -> Result<bool, Fault>) -> Result<f64, Fault> {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (not + held);
        *(if at(middle)? { &mut held } else { &mut not }) = middle;
    }
    Ok(held)
}

fn listed(bands: &[[f64; 2]]) -> Text {
    let list = |language| {
        let number = |x| report::number::short(x, 6, language);
        let band = |[a, b]: &[f64; 2]| if a == b { number(*a) } else { format!("{} … {}", number(*a), number(*b)) };
        bands.iter().map(band).collect::<Vec<_>>().join("; ")
    };
    Text::new(list(Language::En), list(Language::Ru))
}

fn remark(push: &Push, bands: &[[f64; 2]]) -> Text {
    let (Text { en, ru }, Text { en: name, ru: name_ru }) = (listed(bands), &push.label);
    match push.beyond {
        Beyond::Ends => Text::new(
            format!(
                "{name}: a strand would have to push at ω = {en} rad/s; it goes slack there, and the amplitudes of the table are not those of the machine"
            ),
            format!(
                "{name_ru}: при ω = {ru} рад/с одна из ветвей должна была бы толкать; она провисает, и амплитуды таблицы там не относятся к машине"
            ),
        ),
        Beyond::Noted => Text::new(
            format!(
                "{name}: the normal force is negative at times at ω = {en} rad/s; a track only pushes, and the wheel would lift off there"
            ),
            format!(
                "{name_ru}: при ω = {ru} рад/с нормальная реакция временами отрицательна; опора только давит, и колесо там оторвалось бы"
            ),
        ),
    }
}
