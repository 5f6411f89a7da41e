//! What periodic motions are followed on, by whole turns or on a mesh: the machine over its parameter, the regime that began, the length of a period.

use super::zeros::Family;
use crate::Fault;
use crate::fault::codes;
use crate::studies::periodic::Shooting;
use words::{Message, Text};

/// A machine over its parameter, and what its first regime tells of all.
pub(super) struct Ground<'a, 'o> {
    pub(super) family: &'a mut dyn Family,
    pub(super) shooting: &'a Shooting<'o>,
    /// Periods of the loads in one of the motion.
    pub(super) returns: usize,
    /// Range of the parameter.
    pub(super) range: f64,
    /// Turns followed, and turns varied.
    pub(super) work: &'a mut [usize; 2],
}

impl Ground<'_, '_> {
    /// The period at y.
    pub(super) fn period(&mut self, y: &[f64]) -> Result<f64, Fault> {
        period_at(self.family, y, self.shooting.is_driven().then_some(self.returns))
    }
}

/// The period at y: that of the loads as often as they repeat in it, or of a free motion (none) the unknown before the parameter.
///
/// *Errors*: S150 without one, and those of the family.
pub(super) fn period_at(family: &mut dyn Family, y: &[f64], returns: Option<usize>) -> Result<f64, Fault> {
    let (_, period) = family.at(y[y.len() - 1])?;
    let period = match returns {
        Some(returns) => period.ok_or_else(no_period)? * returns as f64,
        None => y[y.len() - 2],
    };
    if period > 0.0 && period.is_finite() { Ok(period) } else { Err(no_period()) }
}

fn no_period() -> Fault {
    Fault::new(Message {
        code: codes::NO_PERIOD,
        what: Text::new(
            "the motion is driven in time, and no period follows from the file",
            "движение вынужденное, а период из файла не следует",
        ),
        why: Text::new(
            "a forced motion can repeat only after whole periods of its loads, which change with the parameter",
            "вынужденное движение может повторяться только через целое число периодов нагрузок, а они меняются вместе с параметром",
        ),
        help: Text::new(
            "give the period as a formula of the parameter: period = \"2*pi/w\"",
            "задайте период формулой от параметра: period = \"2*pi/w\"",
        ),
    })
}

/// The laws do not come back after the period.
pub(super) fn not_the_period(period: f64) -> Fault {
    let n = words::digits::number(period);
    Fault::new(Message {
        code: codes::NO_PERIOD,
        what: Text::new(
            format!("{} s is not a period of the loads at this value of the parameter", n.en),
            format!("{} с – не период нагрузок при этом значении параметра", n.ru),
        ),
        why: Text::new(
            "the loads change with the parameter, and the period that was given does not, or otherwise",
            "нагрузки меняются вместе с параметром, а заданный период не меняется или меняется иначе",
        ),
        help: Text::new(
            "give the period as a formula of the parameter: period = \"2*pi/w\"",
            "задайте период формулой от параметра: period = \"2*pi/w\"",
        ),
    })
}

/// The laws feel the turns that are taken off.
pub(super) fn not_the_turn() -> Fault {
    Fault::new(Message {
        code: codes::NO_PERIOD,
        what: Text::new(
            "after its whole turns the machine is another one at this value of the parameter",
            "при этом значении параметра машина после целых оборотов уже не та же самая",
        ),
        why: Text::new(
            "with this ratio of wheels, or number of lobes, the forces feel by how many turns an angle has gone on",
            "при таком передаточном отношении или числе выступов силы зависят от того, на сколько оборотов повернулся угол",
        ),
        help: Text::new(
            "follow another parameter, or give the turns after which all wheels stand as before (turns = 3) and values at which they do",
            "прослеживайте другой параметр или задайте число оборотов, после которого все колёса стоят как прежде (turns = 3), и значения, при которых это так",
        ),
    })
}

/// Something switches where the period begins.
pub(super) fn passes_the_start() -> Fault {
    Fault::new(Message {
        code: "S169",
        what: Text::new(
            "something switches just where the period begins, at t = 0",
            "переключение происходит именно там, где начинается период, – при t = 0",
        ),
        why: Text::new(
            "a contact closes or opens, or a friction comes to rest or breaks away there; what is free at the start is not what is free a period later, and the motion is not followed across that",
            "там контакт замыкается или размыкается, трение останавливает или отпускает тело; в начале свободно не то, что период спустя, и через такую точку ветвь не продолжается",
        ),
        help: Text::new(
            "begin the period elsewhere: write t + t0 for t in all formulas of time, with t0 a part of the period in which nothing happens, and start the motion there",
            "начните период в другой момент: во всех формулах времени замените t на t + t0, где t0 – доля периода, на которой ничего не происходит, и начните движение оттуда",
        ),
    })
}
