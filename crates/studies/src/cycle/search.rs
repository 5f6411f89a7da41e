//! The drive that closes the balance, and the flywheel for a wanted irregularity.

use super::asked::Cycle;
use super::tried::{Tried, turned};
use crate::machine::Machine;
use analysis::fault::codes;
use words::digits::number;
use words::{Notice, Text};

/// Steps of the searches.
const STEPS: usize = 40;
/// Changes of a drive below this share of it are rounding.
const SETTLED: f64 = 1e-13;

/// What a sum of work leaves of zero, as a share of what passes: some hundred units of the last place.
const NOTHING: f64 = 1e-13;
/// Share of what passes that the work of the unknown has where the two values lie between which its slope is taken: rounding is then below 1e-12 of the slope.
const SEEN: f64 = 0.1;
/// Change of the unknown where it does nothing that can be seen yet, and how often it is made.
const LARGER: f64 = 1e4;
const ENLARGED: usize = 5;
/// Distance of the work half-way from the mean of both ends, as a share of the work of the unknown, up to which it is a straight line.
const STRAIGHT: f64 = 1e-9;
/// Digits that are printed where they are known.
const DIGITS: usize = 8;
/// Share of the unknown over which the tangent is taken where the work is no straight line.
const BESIDE: f64 = 1e-3;

/// The balance of work over the cycle, rest + slope·drive = 0, J, and the drive that solves it.
#[derive(Clone, Copy)]
pub(super) struct Drive {
    rest: f64,
    slope: f64,
    pub value: f64,
    /// Digits to which rest and value are known beside all work that passes.
    digits: usize,
}

impl Drive {
    pub fn words(self, name: &str) -> Text {
        let shown = |x: f64, digits: usize| report::number::short(x, digits, words::Language::En);
        let sign = |x: f64| if x < 0.0 { "−" } else { "+" };
        let name = report::symbol::plain(name, words::Language::En);
        let (rest, value) = (shown(self.rest, self.digits), shown(self.value, self.digits));
        let line = format!("∮ M dφ = {rest} {} {}·{name} = 0,   {name} = {value}", sign(self.slope), shown(self.slope.abs(), DIGITS));
        let ru = line.replace('.', ",");
        Text::new(format!("Energy balance of the cycle (J): {line}"), format!("Баланс энергии за цикл (Дж): {ru}"))
    }

    /// Work without the drive, and by a unit of it, J.
    pub fn json(self) -> serde_json::Value {
        serde_json::json!({"rest": self.rest, "slope": self.slope})
    }

    /// A balance whose rest is known to a rounding of what passes.
    fn of([rest, size]: [f64; 2], slope: f64) -> Drive {
        let rest = if rest.abs() <= NOTHING * size { 0.0 } else { rest };
        let known = if rest == 0.0 { DIGITS as f64 } else { -algebra::elementary::log10(f64::EPSILON * size / rest.abs()) };
        Drive { rest, slope, value: 0.0 - rest / slope, digits: known.clamp(1.0, DIGITS as f64) as usize }
    }
}

/// The work over the cycle with a value of the unknown, and what passes.
type Work<'w> = dyn FnMut(f64) -> Result<[f64; 2], Notice> + 'w;

/// The work as a straight line over the unknown, W(0) + slope·u, which it is in most machines: a load has a part in the generalized force. None where it bends, or
/// where the unknown does nothing.
fn line(work: &mut Work, first: f64) -> Result<Option<Drive>, Notice> {
    let rest = work(0.0)?;
    let mut far = if first == 0.0 { 1.0 } else { first };
    for _ in 0..ENLARGED {
        let [there, size] = work(far)?;
        let done = (there - rest[0]).abs();
        let passes = size.max(rest[1]);
        if done <= NOTHING * passes {
            far *= LARGER;
            continue;
        }
        if done < SEEN * passes && done < SEEN * rest[1] {
            far *= rest[1] / done;
            continue;
        }
        let [half, _] = work(0.5 * far)?;
        let straight = (half - 0.5 * (rest[0] + there)).abs() <= STRAIGHT * done;
        return Ok(straight.then(|| Drive::of(rest, (there - rest[0]) / far)));
    }
    Ok(None)
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
    let mut work = |value: f64| -> Result<[f64; 2], Notice> {
        let mut values = others.to_vec();
        values.retain(|(n, _)| n != name);
        values.push((name.to_owned(), value));
        tried.set(&values)?;
        tried.work(study)
    };
    if near.is_none()
        && let Ok(Some(found)) = line(&mut work, first)
    {
        return Ok(found);
    }
    let found = secant(&mut work, first, near)?.ok_or_else(|| idle(machine, name))?;
    Ok(if near.is_some() { found } else { tangent(&mut work, found)? })
}

/// The balance by secants, where the work bends with the unknown; none where it does not change.
fn secant(work: &mut Work, first: f64, near: Option<Drive>) -> Result<Option<Drive>, Notice> {
    let mut a = near.map_or(first, |near| near.value);
    let [mut work_a, mut size] = work(a)?;
    let mut b = near.map_or(if first == 0.0 { 1.0 } else { 0.9 * first }, |near| a - work_a / near.slope);
    if let Some(near) = near.filter(|near| (b - near.value).abs() <= SETTLED * b.abs() || work_a.abs() <= NOTHING * size) {
        return Ok(Some(near));
    }
    let (mut slope, mut rest) = (0.0, 0.0);
    for _ in 0..STEPS {
        let [work_b, passes] = work(b)?;
        size = passes;
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
    let known = Drive::of([rest, size], slope).digits;
    Ok((slope != 0.0).then_some(Drive { rest, slope, value: b, digits: known }))
}

/// The same with the slope of the tangent there: between the last two values of a search it is one of rounding.
fn tangent(work: &mut Work, found: Drive) -> Result<Drive, Notice> {
    let by = BESIDE * found.value.abs();
    if by == 0.0 {
        return Ok(found);
    }
    let ([above, _], [below, _]) = (work(found.value + by)?, work(found.value - by)?);
    let slope = (above - below) / (2.0 * by);
    Ok(if slope == 0.0 || !slope.is_finite() { found } else { Drive { slope, rest: -slope * found.value, ..found } })
}

/// S048.
fn idle(machine: &Machine, name: &str) -> Notice {
    let held = |r: &symbolic::connections::Reaction| matches!(r.law, symbolic::connections::Law::Motor);
    if machine.equations.reactions.iter().any(held) || machine.equations.conditions.iter().any(|c| c.reaction.is_none()) {
        let (en, ru) = (
            format!("no value of `{name}` follows from the balance: a motor or a prescribed motion does whatever work is missing"),
            format!("величина `{name}` из баланса не следует: недостающую работу совершает двигатель или заданное движение"),
        );
        return Notice::new("S048", en, ru).help(
            "leave out the prescribed motion: the study holds the shaft to the uniform rate by itself",
            "уберите заданное движение: равномерное вращение вала расчёт обеспечивает сам",
        );
    }
    Notice::new("S048", format!("`{name}` does no work over the cycle"), format!("`{name}` не совершает работы за цикл"))
        .help("choose a drive force or torque as the unknown", "выберите неизвестной движущую силу или момент")
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
            format!("no value of `{name}` gives the irregularity {}", number(wanted).en),
            format!("ни при каком значении `{name}` неравномерность хода не равна {}", number(wanted).ru),
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
            Err(fault) if fault.code == codes::STANDS => stalled = stalled.or(Some(fault)),
            Err(fault) => return Err(stalled.unwrap_or(fault)),
        }
        value *= 4.0;
    }
    Err(stalled.unwrap_or_else(|| Notice::new(codes::STANDS, "the shaft does not turn", "вал не вращается")))
}

/// How often the value of the file is multiplied by four.
const GROWN: usize = 16;
