//! The drive that closes the balance, and the flywheel for a wanted irregularity.

use super::asked::Cycle;
use super::tried::{Tried, turned};
use crate::machine::Machine;
use words::{Notice, Text};

/// Steps of the searches.
const STEPS: usize = 40;
/// Changes of a drive below this share of it are rounding.
const SETTLED: f64 = 1e-13;

/// The balance of work over the cycle, rest + slope·drive = 0, J, and the drive that solves it.
#[derive(Clone, Copy)]
pub(super) struct Drive {
    rest: f64,
    slope: f64,
    pub value: f64,
}

impl Drive {
    pub fn words(self, name: &str) -> Text {
        let print = |x: f64| report::number::short(x, 8, words::Language::En);
        let sign = |x: f64| if x < 0.0 { "−" } else { "+" };
        let name = report::symbol::plain(name, words::Language::En);
        let (rest, value) = (print(self.rest), print(self.value));
        let line = format!("∮ M dφ = {rest} {} {}·{name} = 0,   {name} = {value}", sign(self.slope), print(self.slope.abs()));
        let ru = line.replace('.', ",");
        Text::new(format!("Energy balance of the cycle (J): {line}"), format!("Баланс энергии за цикл (Дж): {ru}"))
    }
}

/// The value of a parameter for which the work over the cycle vanishes. `near` solved the balance with other numbers.
pub(super) fn driven(
    machine: &Machine,
    tried: &mut Tried,
    study: &Cycle,
    (name, others): (&str, &[(String, f64)]),
    near: Option<Drive>,
) -> Result<Drive, Notice> {
    let first = machine.number(name)?;
    let mut work = |value: f64| -> Result<f64, Notice> {
        let mut values = others.to_vec();
        values.retain(|(n, _)| n != name);
        values.push((name.to_owned(), value));
        tried.set(&values)?;
        tried.work(study)
    };
    let mut a = near.map_or(first, |near| near.value);
    let mut work_a = work(a)?;
    let mut b = near.map_or(if first == 0.0 { 1.0 } else { 0.9 * first }, |near| a - work_a / near.slope);
    if let Some(near) = near.filter(|near| (b - near.value).abs() <= SETTLED * b.abs()) {
        return Ok(near);
    }
    let (mut slope, mut rest) = (0.0, 0.0);
    for _ in 0..STEPS {
        let work_b = work(b)?;
        let now = (work_b - work_a) / (b - a);
        if now == 0.0 || !now.is_finite() {
            break;
        }
        (slope, rest) = (now, work_b - now * b);
        let next = -rest / slope;
        let settled = (next - b).abs() <= SETTLED * next.abs();
        (a, work_a, b) = (b, work_b, next);
        if settled {
            break;
        }
    }
    if slope == 0.0 {
        return Err(Notice::new("S048", format!("`{name}` does no work over the cycle"), format!("`{name}` не совершает работы за цикл"))
            .help("choose a drive force or torque as the unknown", "выберите неизвестной движущую силу или момент"));
    }
    Ok(Drive { rest, slope, value: b })
}

/// The inertia for which the irregularity is the wanted one, with the drive that goes with it.
pub(super) fn flywheel(
    machine: &Machine,
    tried: &mut Tried,
    study: &Cycle,
    (name, wanted): (&str, f64),
    mut drive: Option<Drive>,
) -> Result<(f64, Option<f64>), Notice> {
    let first = machine.number(name)?;
    let mut at = |value: f64| -> Result<f64, Notice> {
        let mut values = vec![(name.to_owned(), value)];
        if let Some(unknown) = &study.unknown {
            let found = driven(machine, tried, study, (unknown, &values), drive)?;
            drive = Some(found);
            values.push((unknown.clone(), found.value));
        }
        tried.set(&values)?;
        let found = turned(&mut tried.machine, study)?;
        Ok((found.greatest - found.least) / found.mean.abs())
    };
    // the irregularity is nearly inverse to the inertia: secant in 1/irregularity
    let (mut a, turns) = turning_with(first, &mut at)?;
    let mut b = 1.5 * a;
    let mut f_a = 1.0 / turns - 1.0 / wanted;
    let mut reached = at(b)?;
    for _ in 0..STEPS {
        let f_b = 1.0 / reached - 1.0 / wanted;
        let slope = (f_b - f_a) / (b - a);
        // a share of the wanted value that the tolerance of a turn still shows
        if f_b.abs() <= 1e-12 / wanted || slope == 0.0 || !slope.is_finite() {
            break;
        }
        let next = (b - f_b / slope).max(0.1 * b);
        (a, f_a, b) = (b, f_b, next);
        reached = at(b)?;
    }
    // more digits than a flywheel is made to
    if (reached - wanted).abs() > 1e-8 * wanted {
        return Err(Notice::new(
            "S048",
            format!("no value of `{name}` gives the irregularity {wanted}"),
            format!("ни при каком значении `{name}` неравномерность хода не равна {wanted}"),
        ));
    }
    Ok((b, drive.map(|drive| drive.value)))
}

/// The first of growing values with which the shaft turns, and its irregularity then: the value in the file is a guess, a small flywheel stalls.
fn turning_with(first: f64, at: &mut impl FnMut(f64) -> Result<f64, Notice>) -> Result<(f64, f64), Notice> {
    let (mut stalled, mut value) = (None, first);
    for _ in 0..GROWN {
        match at(value) {
            Ok(found) => return Ok((value, found)),
            Err(fault) if fault.code == "S046" => stalled = stalled.or(Some(fault)),
            Err(fault) => return Err(stalled.unwrap_or(fault)),
        }
        value *= 4.0;
    }
    Err(stalled.unwrap_or_else(|| Notice::new("S046", "the shaft does not turn", "вал не вращается")))
}

/// How often the value of the file is multiplied by four.
const GROWN: usize = 16;
