//! Motions of a block of places, beside each other in lanes where their machines can go there, else one by one.

use super::gathered::Row;
use super::one::At;
use super::regimes;
use super::repeated::Repeated;
use super::wanted::Noted;
use crate::failure::in_words;
use crate::machine::Machine;
use crate::machine::bind::Binding;
use crate::observable::Observable;
use crate::simulate::{self, Simulate};
use analysis::System;
use analysis::interrupt::is_set;
use analysis::studies::simulate::{Made, Wanted, fits};
use std::ops::Range;
use std::sync::atomic::AtomicBool;
use words::Text;

/// Values of a place by its number.
type Values<'a> = &'a dyn Fn(usize) -> Vec<(String, f64)>;

/// Motions from which on it matters how they are done.
const MANY: usize = 100;

/// A motion that waits for a lane.
struct Waiting {
    values: Vec<(String, f64)>,
    anew: usize,
    study: Simulate,
}

/// How places are done.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Pace {
    /// Motions beside each other in lanes.
    InLanes,
    /// Motions one by one: lanes do not have what stands here.
    Alone(Text),
    /// Another study, one by one.
    Other,
}

/// How the places of a study are done, by the machine of the first.
pub(crate) fn pace(at: &At, repeated: &Repeated) -> Pace {
    let mut machine = at.machine.clone();
    let Some(asked) = repeated.at(&machine).ok().filter(|asked| asked.kind == simulate::KIND.name) else { return Pace::Other };
    let is_count = |noted: &Noted| matches!(noted.1, Observable::Events | Observable::EventsOf(_));
    if !machine.system.guards().is_empty() && repeated.noted.iter().any(is_count) {
        return Pace::Alone(Text::new("events are counted", "подсчитываются события"));
    }
    match wanted(&mut machine, &Simulate::of(&asked), None).map(|mut wanted| fits(&mut wanted)) {
        Some(Err(why)) if !why.en.is_empty() => Pace::Alone(why),
        // a fault of the first place says nothing of the others
        _ => Pace::InLanes,
    }
}

impl Pace {
    /// What is to be said of many motions that were done one by one.
    pub(crate) fn note(&self, count: usize) -> Option<Text> {
        let Pace::Alone(why) = self else { return None };
        (count >= MANY).then(|| {
            Text::new(
                format!("the motions were computed one by one, not eight at a time: {}", why.en),
                format!("движения рассчитаны по одному, а не по восемь сразу: {}", why.ru),
            )
        })
    }
}

fn wanted<'a>(machine: &mut Machine, study: &Simulate, interrupt: Option<&'a AtomicBool>) -> Option<Wanted<'a>> {
    simulate::moving(&machine.equations).ok()?;
    let start = machine.system.start().ok()?;
    Some(Wanted { options: simulate::numbers_only(machine, study, interrupt), machine: machine.system.clone(), start })
}

/// The rows of a block, in order; fewer when it is interrupted.
pub(crate) fn rows(
    at: &mut At,
    repeated: &Repeated,
    (values, places): (Values<'_>, Range<usize>),
    interrupt: Option<&AtomicBool>,
) -> Vec<Row> {
    let stopped = || is_set(interrupt);
    // what is done one by one finds what the place before has left, as if nothing went in lanes
    let mut own = at.clone();
    let (mut waiting, mut motions): (Vec<Option<Waiting>>, Vec<Wanted<'_>>) = (Vec::new(), Vec::new());
    for place in places.clone() {
        let prepared = prepare(&mut own, repeated, values(place), interrupt);
        waiting.push(prepared.map(|(waiting, wanted)| {
            motions.push(wanted);
            waiting
        }));
    }
    let mut made = (analysis::made::ABREAST)(&mut motions, interrupt).into_iter();
    let mut rows = Vec::with_capacity(places.len());
    for (place, waiting) in places.zip(waiting) {
        let found = waiting.and_then(|waiting| Some((waiting, made.next()?)));
        let row = match found {
            Some((_, Made::Interrupted)) => return rows,
            Some((Waiting { values, anew, study }, Made::Found(outcome))) => {
                if regimes::are_noted(&own.machine, &repeated.noted) {
                    // their conditions may hold parameters
                    let _ = bind(&mut own, &values);
                }
                let finding = simulate::finding(&own.machine, &study, *outcome);
                let finding = finding.trouble.clone().map_or(Ok(finding), Err);
                Row::new(&own, repeated, (values, anew), finding)
            }
            _ => Row::of(at, repeated, values(place), interrupt),
        };
        // a row that was interrupted on its way is none
        if stopped() {
            return rows;
        }
        rows.push(row);
    }
    rows
}

fn bind(at: &mut At, values: &[(String, f64)]) -> Option<bool> {
    let values: Vec<(&str, f64)> = values.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    at.machine.bind(&values).map_err(in_words).ok().map(|binding| binding == Binding::Anew)
}

/// A place whose motion may go in a lane; what the machine objects to its values is told by the row alone.
fn prepare<'a>(
    at: &mut At,
    repeated: &Repeated,
    values: Vec<(String, f64)>,
    interrupt: Option<&'a AtomicBool>,
) -> Option<(Waiting, Wanted<'a>)> {
    let anew = usize::from(bind(at, &values)?);
    let asked = repeated.at(&at.machine).ok()?;
    let study = Simulate::of(&asked);
    let wanted = wanted(&mut at.machine, &study, interrupt)?;
    Some((Waiting { values, anew, study }, wanted))
}
