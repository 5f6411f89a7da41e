//! What happened at a switch, in words.

use words::Text;

use super::happened::{Change, Rival, Switch};
use crate::dataset::{ContactChange, Standing};
use crate::{Guard, GuardKind, Mode};
use words::digits::number;

/// One line for the table of events.
pub fn describe(switch: &Switch, guard: &Guard) -> Text {
    let name = &guard.name;
    let told = |en: String, ru: String| Text::new([&name.en[..], ": ", &en].concat(), [&name.ru[..], ": ", &ru].concat());
    match (&guard.kind, switch.change) {
        (_, Change::Impact { rates, .. }) => impact(switch, rates, guard, told),
        (_, Change::Rests { limit }) => {
            let n = number(limit);
            told(
                format!("closes after infinitely many impacts, which end at t = {} s", n.en),
                format!("замыкается после бесконечного числа ударов, которые кончаются при t = {} с", n.ru),
            )
        }
        (_, Change::Jolt) => {
            let words = change_of_side(switch, name);
            Text::new(format!("{}, prescribed velocities jump", words.en), format!("{}, заданные скорости изменяются скачком", words.ru))
        }
        (GuardKind::Friction { .. }, Change::Mode) => friction(switch, told),
        (GuardKind::Contact { .. }, Change::Mode) => {
            let (en, ru) = match (switch.after == Mode::Zero, guard.tie) {
                (true, true) => ("becomes taut", "натягивается"),
                (true, false) => ("closes", "замыкается"),
                (false, true) => ("goes slack", "провисает"),
                (false, false) => ("opens", "размыкается"),
            };
            told(en.into(), ru.into())
        }
        (GuardKind::Normal { .. }, Change::Mode) => {
            let sign = if switch.after == Mode::Negative {
                ("negative", "отрицательной")
            } else {
                ("positive", "положительной")
            };
            told(format!("its normal force becomes {}", sign.0), format!("нормальная сила становится {}", sign.1))
        }
        _ => change_of_side(switch, name),
    }
}

/// What frictions do in another motion.
pub fn rivals(found: &[Rival], guards: &[Guard]) -> Text {
    let one = |rival: &Rival| {
        let name = &guards[rival.guard].name;
        let (en, ru) = match rival.mode {
            _ if matches!(guards[rival.guard].kind, GuardKind::Contact { .. }) => ("opens", "размыкается"),
            Mode::Zero => ("sticks", "залипает"),
            Mode::Positive => ("slides forward", "скользит вперёд"),
            Mode::Negative => ("slides backward", "скользит назад"),
        };
        let (by, by_ru) = match rival.turned {
            true => (", pressed by a force of the other sign", " при нормальной силе другого знака"),
            false => ("", ""),
        };
        (format!("{} {en}{by}", name.en), format!("{} {ru}{by_ru}", name.ru))
    };
    let (en, ru): (Vec<String>, Vec<String>) = found.iter().map(one).unzip();
    Text::new(en.join("; "), ru.join("; "))
}

/// The same for machines; none for a switch that is no contact.
pub fn change(switch: &Switch, guard: &Guard) -> Option<ContactChange> {
    let (from, to) = (state(switch.before, guard)?, state(switch.after, guard)?);
    let impulse = if let Change::Impact { impulse, .. } = switch.change { Some(impulse) } else { None };
    let endless = matches!(switch.change, Change::Rests { .. });
    Some(ContactChange { contact: contact(guard), from, to, impulse, endless })
}

/// A guard is named by the kind and the user's name, which has no spaces.
fn contact(guard: &Guard) -> String {
    guard.name.en.rsplit(' ').next().unwrap_or_default().to_owned()
}

/// What a contact or friction does in a mode; none for other switches.
fn state(mode: Mode, guard: &Guard) -> Option<&'static str> {
    let friction = match guard.kind {
        GuardKind::Friction { .. } => true,
        GuardKind::Contact { .. } => false,
        _ => return None,
    };
    Some(match (mode, friction, guard.tie) {
        (Mode::Zero, true, _) => "sticking",
        (Mode::Positive, true, _) => "forward",
        (Mode::Negative, true, _) => "backward",
        (Mode::Positive, false, true) => "slack",
        (_, false, true) => "taut",
        (Mode::Positive, false, false) => "open",
        (_, false, false) => "closed",
    })
}

/// All contacts and frictions in these modes.
pub fn standing(guards: &[Guard], modes: &[Mode]) -> Vec<Standing> {
    let one = |(i, (guard, mode)): (usize, (&Guard, &Mode))| {
        let pressed = if let GuardKind::Friction { pressed, .. } = &guard.kind { pressed.clone() } else { Vec::new() };
        Some(Standing {
            contact: contact(guard),
            label: guard.name.clone(),
            at_start: state(*mode, guard)?,
            guard: i,
            pressed,
            friction: matches!(guard.kind, GuardKind::Friction { .. }),
        })
    };
    guards.iter().zip(modes).enumerate().filter_map(one).collect()
}

fn impact(switch: &Switch, rates: [f64; 2], guard: &Guard, told: impl Fn(String, String) -> Text) -> Text {
    let [before, after] = rates.map(short);
    let word = if guard.tie { ("catches", "рывок") } else { ("impact", "удар") };
    let mut en = [word.0, ", rate ", &before.en, " → ", &after.en].concat();
    let mut ru = [word.1, ", скорость ", &before.ru, " → ", &after.ru].concat();
    if switch.after == Mode::Zero && guard.tie {
        en += ", stays taut";
        ru += ", остаётся натянутой";
    } else if switch.after == Mode::Zero {
        en += ", closes";
        ru += ", замыкается";
    }
    told(en, ru)
}

fn friction(switch: &Switch, told: impl Fn(String, String) -> Text) -> Text {
    let (en, ru) = match switch.after {
        Mode::Positive => ("slides forward", "скользит вперёд"),
        Mode::Negative => ("slides backward", "скользит назад"),
        Mode::Zero => return told("sticks".into(), "залипает".into()),
    };
    match switch.before {
        Mode::Zero => told(format!("breaks away, {en}"), format!("срывается, {ru}")),
        _ => told(format!("reverses, {en}"), format!("меняет направление, {ru}")),
    }
}

fn change_of_side(switch: &Switch, name: &Text) -> Text {
    if let (Some(en), Some(ru)) = (instant(&name.en), instant(&name.ru)) {
        return Text::new(format!("t reaches {en}"), format!("t достигает значения {ru}"));
    }
    let word = |mode: Mode| match mode {
        Mode::Negative => "minus",
        Mode::Zero => "zero",
        Mode::Positive => "plus",
    };
    let in_russian = |mode: Mode| if mode == Mode::Negative { ("минуса", "минус") } else { ("плюса", "плюс") };
    // of "-y" readers want to know what y does
    let bare = name.en.strip_prefix(['-', '−']).zip(name.ru.strip_prefix(['-', '−'])).filter(|(en, _)| !en.contains(' '));
    let turned = |mode: Mode| match mode {
        Mode::Negative if bare.is_some() => Mode::Positive,
        Mode::Positive if bare.is_some() => Mode::Negative,
        other => other,
    };
    let (en, ru) = bare.unwrap_or((name.en.as_str(), name.ru.as_str()));
    let changes = match (switch.before == Mode::Zero, turned(switch.after)) {
        (false, Mode::Zero) => format!("{ru} обращается в нуль"),
        (true, Mode::Positive) => format!("{ru} становится больше нуля"),
        (true, Mode::Negative) => format!("{ru} становится меньше нуля"),
        (true, Mode::Zero) => format!("{ru} остаётся нулём"),
        (false, to) => format!("{ru} меняет знак с {} на {}", in_russian(turned(switch.before)).0, in_russian(to).1),
    };
    Text::new(format!("{en} changes from {} to {}", word(turned(switch.before)), word(turned(switch.after))), changes)
}

/// What time is compared with: `5` of `5 − t` and of `t − 5`.
fn instant(guard: &str) -> Option<&str> {
    let timeless = |rest: &str| !rest.split(|c: char| !(c.is_alphanumeric() || "_*'".contains(c))).any(|word| word == "t");
    let alone = |rest: &str| !rest.contains(" − ") && !rest.contains(" + ") && !rest.contains(" - ");
    let after = || guard.strip_prefix("t − ").or_else(|| guard.strip_prefix("t - ")).filter(|rest| alone(rest));
    guard.strip_suffix(" − t").or_else(|| guard.strip_suffix(" - t")).or_else(after).filter(|rest| timeless(rest))
}

/// Six digits: enough to recognise an impact; the full numbers stand beside the event.
fn short(value: f64) -> Text {
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    number(rounded)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_switch_of_time_says_which_instant() {
        assert_eq!(instant("t_* − t"), Some("t_*"));
        assert_eq!(instant("a + b − t"), Some("a + b"));
        assert_eq!(instant("t − 5"), Some("5"));
        assert_eq!(instant("t − a − b"), None);
        assert_eq!(instant("sin t − t"), None);
        assert_eq!(instant("t"), None);
        assert_eq!(instant("y'"), None);
        // the place of a belt that moves at v t
        assert_eq!(instant("x − v t"), None);
    }

    #[test]
    fn numbers_in_words_have_the_signs_of_print() {
        for (value, en, ru) in
            [(-4.42945, "−4.42945", "−4,42945"), (9.61e-5, "9.61·10⁻⁵", "9,61·10⁻⁵"), (-2e7, "−2·10⁷", "−2·10⁷"), (0.0, "0", "0")]
        {
            assert_eq!(short(value), Text::new(en, ru));
        }
    }
}
