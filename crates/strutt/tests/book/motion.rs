//! Claims about the table of a motion.

use crate::claim::{Claim, Tolerance, When, Which};
use analysis::Dataset;
use analysis::dataset::Event;

/// Holds a claim against the table of a motion whose rows stand at these times.
pub fn motion(times: &[f64], data: &Dataset, claim: &Claim) -> Result<(), String> {
    match claim {
        Claim::Value { .. } | Claim::MeanRate { .. } | Claim::NoValue { .. } => row(times, data, claim),
        Claim::Extreme { .. } | Claim::Mean { .. } | Claim::Bounded { .. } | Claim::Constant { .. } => overall(data, claim),
        Claim::Event { .. } | Claim::Impulse { .. } | Claim::OpenImpulse { .. } | Claim::Events(_) | Claim::Says { .. } => {
            event(data, claim)
        }
        Claim::AuditFails(_) | Claim::Audit { .. } | Claim::AuditsOk => audit(data, claim),
        Claim::Note(text) | Claim::NoNote(text) => {
            let said = data.notes.iter().any(|note| note.en.contains(text.as_str()));
            if said == matches!(claim, Claim::Note(_)) {
                return Ok(());
            }
            Err(format!("notes: {:?}", data.notes.iter().map(|note| &note.en).collect::<Vec<_>>()))
        }
        _ => computed(),
    }
}

fn computed() -> Result<(), String> {
    Err("the motion was computed".into())
}

/// Claims about instants.
fn row(times: &[f64], data: &Dataset, claim: &Claim) -> Result<(), String> {
    match claim {
        Claim::Value { name, when, expected, tolerance } => {
            let row = match when {
                When::At(t) => times.iter().rposition(|x| x == t),
                When::End => last_row(data),
            };
            let row = row.ok_or("the instant was not asked for")?;
            let column = name.strip_prefix("shown ").unwrap_or(name);
            let unit = data.column(column).and_then(|c| c.quantity.display.as_ref()).map_or(1.0, |(_, size)| *size);
            let found = values(data, column)?.get(row).copied().unwrap_or(f64::NAN);
            tolerance.check(name, if column == name { found } else { found / unit }, *expected)
        }
        Claim::MeanRate { name, from, to, expected, tolerance } => {
            let at =
                |t: &f64| times.iter().rposition(|x| x == t).and_then(|row| values(data, name).ok()?.get(row).copied()).unwrap_or(f64::NAN);
            tolerance.check(&format!("mean rate of {name}"), (at(to) - at(from)) / (to - from), *expected)
        }
        Claim::NoValue { name, at } => {
            let row = times.iter().rposition(|x| x == at).ok_or("the instant was not asked for")?;
            let found = values(data, name)?.get(row).copied().ok_or("the motion ended before")?;
            match (found.is_nan(), data.explains(name, found)) {
                (true, true) => Ok(()),
                (true, false) => Err("nothing says why it is empty".into()),
                _ => Err(format!("{name} is {found:e}")),
            }
        }
        _ => computed(),
    }
}

/// Claims about the whole motion.
fn overall(data: &Dataset, claim: &Claim) -> Result<(), String> {
    match claim {
        Claim::Extreme { name, which, expected, tolerance } => {
            let e = data.extreme(name).ok_or_else(|| no_column(data, name))?;
            let found = match which {
                Which::Least => e.min,
                Which::LeastAt => e.t_min,
                Which::Greatest => e.max,
                Which::GreatestAt => e.t_max,
            };
            tolerance.check(name, found, *expected)
        }
        Claim::Mean { name, expected, tolerance } => {
            let found = data.overall(name).ok_or_else(|| no_column(data, name))?.mean();
            tolerance.check(&format!("mean of {name}"), found, *expected)
        }
        Claim::Bounded { name, limit } => {
            // not-a-number must not pass as small
            let largest = values(data, name)?.iter().fold(0.0f64, |m, v| if v.is_nan() { f64::INFINITY } else { m.max(v.abs()) });
            if largest < *limit { Ok(()) } else { Err(format!("largest |{name}| is {largest:.3e}")) }
        }
        Claim::Constant { name, tolerance } => constant(name, values(data, name)?, *tolerance),
        _ => computed(),
    }
}

/// Claims about events.
fn event(data: &Dataset, claim: &Claim) -> Result<(), String> {
    match claim {
        Claim::Event { number, at, tolerance } => {
            let event = nth(data, *number)?;
            Tolerance { size: *tolerance, relative: false }.check("t", event.t, *at)
        }
        Claim::Says { event, text } => {
            let event = nth(data, *event)?;
            if event.what.en == *text { Ok(()) } else { Err(format!("it says: {}", event.what.en)) }
        }
        Claim::Impulse { name, event, expected, tolerance } => {
            let event = nth(data, *event)?;
            let names = || event.impulses.iter().map(|p| p.name.as_str()).collect::<Vec<_>>().join(", ");
            let found = event.impulses.iter().find(|p| p.name == *name).ok_or_else(|| format!("impulses: {}", names()))?;
            tolerance.check(name, found.value, *expected)
        }
        Claim::OpenImpulse { name, event } => {
            let event = nth(data, *event)?;
            match event.impulses.iter().find(|p| p.name == *name) {
                Some(found) if found.value.is_nan() => Ok(()),
                found => Err(format!("{name}: {:?}", found.map(|p| p.value))),
            }
        }
        Claim::Events(count) if data.events.len() == *count => Ok(()),
        Claim::Events(_) => {
            Err(format!("there are {} events: {:?}", data.events.len(), data.events.iter().map(|e| e.t).collect::<Vec<_>>()))
        }
        _ => computed(),
    }
}

/// An event, counted from 1.
fn nth(data: &Dataset, number: usize) -> Result<&Event, String> {
    data.events.get(number.wrapping_sub(1)).ok_or_else(|| format!("there are {} events", data.events.len()))
}

/// Claims about audits.
fn audit(data: &Dataset, claim: &Claim) -> Result<(), String> {
    match claim {
        Claim::AuditFails(key) => match data.audits.iter().find(|a| a.key == *key) {
            Some(audit) if !audit.ok => Ok(()),
            Some(audit) => Err(format!("it passes with {:.3e}", audit.value)),
            None => Err(format!("audits: {:?}", data.audits.iter().map(|a| &a.key).collect::<Vec<_>>())),
        },
        Claim::Audit { name, limit } => {
            let audit = data.audits.iter().find(|a| a.name.en == *name || a.key == *name || a.key == name.replace(' ', "_"));
            let audit = audit.ok_or_else(|| format!("audits: {:?}", data.audits.iter().map(|a| &a.name.en).collect::<Vec<_>>()))?;
            if audit.value < *limit { Ok(()) } else { Err(format!("the audit has {:.3e}", audit.value)) }
        }
        Claim::AuditsOk => match data.audits.iter().find(|a| !a.ok) {
            Some(a) => Err(format!("{}: {:.3e} above {:.1e}", a.name.en, a.value, a.limit)),
            None if data.audits.is_empty() => Err("no audits".into()),
            None => Ok(()),
        },
        _ => computed(),
    }
}

/// The values of a column.
fn values<'d>(data: &'d Dataset, name: &str) -> Result<&'d [f64], String> {
    data.column(name).map(|c| &c.values[..]).ok_or_else(|| no_column(data, name))
}

/// What there is instead of a column that is not there.
pub fn no_column(data: &Dataset, name: &str) -> String {
    let names: Vec<&str> = data.columns.iter().map(|c| c.quantity.name.as_str()).collect();
    format!("no column `{name}`; there are {}", names.join(", "))
}

/// The row of the latest instant: an event may have ended the motion before the time asked for.
fn last_row(data: &Dataset) -> Option<usize> {
    let times = &data.columns.get(data.axis?)?.values;
    (0..times.len()).max_by(|a, b| times[*a].total_cmp(&times[*b]))
}

fn constant(name: &str, values: &[f64], tolerance: Tolerance) -> Result<(), String> {
    let first = values.first().copied().unwrap_or(f64::NAN);
    let spread = values.iter().fold(0.0f64, |m, v| if v.is_nan() { f64::INFINITY } else { m.max((v - first).abs()) });
    let size = values.iter().fold(0.0f64, |m, v| m.max(v.abs()));
    let allowed = if tolerance.relative { tolerance.size * size } else { tolerance.size };
    if spread <= allowed { Ok(()) } else { Err(format!("{name} varies by {spread:.3e}, allowed {allowed:.3e}")) }
}
