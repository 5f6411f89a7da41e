//! What the `value` of an answer means: a number of a study, the instant of something, an output at an instant.

use crate::observable::Observable;
use mechanics::units::{Dimension, parse_quantity};
use words::Text;

/// A number that is asked for.
#[derive(Clone, Debug, PartialEq)]
pub enum Wanted {
    /// `max(x)`, `modes.1.f`: a number of a study.
    Number(Observable),
    /// `when_max(x)`, `event(2)`: an instant of a motion.
    Instant(Moment),
    /// An output, coordinate or rate at an instant of a motion.
    At(String, Moment, Edge),
}

/// Which end of a range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Least value.
    Least,
    /// Greatest value.
    Greatest,
}

/// An instant of a motion.
#[derive(Clone, Debug, PartialEq)]
pub enum Moment {
    /// At this time, s.
    Time(f64),
    /// Where a column has its extreme.
    Extreme(Side, String),
    /// An event, of this name where one is given, counted from 1.
    Event(Option<String>, usize),
}

/// Which side of a jump.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edge {
    /// Nothing jumps there.
    Either,
    /// Just before.
    Before,
    /// Just after.
    After,
}

impl Wanted {
    /// What the texts of an answer mean; `is_column` says what is an output, a coordinate or a rate.
    ///
    /// # Errors
    /// They mean nothing.
    pub fn read(text: &str, at: Option<&str>, is_column: &dyn Fn(&str) -> bool) -> Result<Wanted, Text> {
        if let Some(at) = at {
            if !is_column(text) {
                return Err(no_column(text));
            }
            let (moment, edge) = edge(at);
            return Ok(Wanted::At(text.to_owned(), Moment::read(moment)?, edge));
        }
        if let Some(moment) = Moment::called(text)? {
            return Ok(Wanted::Instant(moment));
        }
        if is_column(text) {
            return Err(Text::new(
                format!("`{text}` is a function of time: which number of it?"),
                format!("`{text}` — функция времени: какое её число нужно?"),
            ));
        }
        let found = Observable::read(text, &|_| false).map_err(|fault| fault.what.clone())?;
        if found.iter().filter_map(Observable::reduced).any(|reduced| reduced.window.is_some()) {
            return Err(Text::new(
                "an answer is a number of the whole motion: windows are for what repeats a study",
                "ответ — число всего движения: окна есть у того, что повторяет расчёт",
            ));
        }
        let number = match found.into_iter().next() {
            Some(Observable::Field(_)) | None => Observable::field(&from_zero(text)?),
            Some(other) => other,
        };
        match number.column().filter(|c| !is_column(c)) {
            Some(column) => Err(no_column(column)),
            None => Ok(Wanted::Number(number)),
        }
    }
}

impl Moment {
    fn read(text: &str) -> Result<Moment, Text> {
        if let Some(moment) = Moment::called(text)? {
            return Ok(moment);
        }
        let time = parse_quantity(text, &Dimension::TIME).map_err(|fault| fault.what.clone())?;
        if time >= 0.0 {
            Ok(Moment::Time(time))
        } else {
            Err(Text::new("the motion begins at t = 0", "движение начинается при t = 0"))
        }
    }

    /// `when_max(x)`, `event(top, 2)`.
    fn called(text: &str) -> Result<Option<Moment>, Text> {
        let Some((word, inside)) = text.strip_suffix(')').and_then(|t| t.split_once('(')) else { return Ok(None) };
        let inside = inside.trim();
        Ok(match word.trim() {
            "when_max" => Some(Moment::Extreme(Side::Greatest, inside.to_owned())),
            "when_min" => Some(Moment::Extreme(Side::Least, inside.to_owned())),
            "event" => Some(event(inside)?),
            _ => None,
        })
    }
}

fn event(inside: &str) -> Result<Moment, Text> {
    let (name, number) = match (inside.split_once(','), inside.parse::<usize>()) {
        (_, Ok(number)) => (None, Ok(number)),
        (Some((name, number)), _) => (Some(name.trim().to_owned()), number.trim().parse::<usize>()),
        (None, Err(_)) => (Some(inside.to_owned()), Ok(1)),
    };
    match number {
        Ok(number) if number > 0 => Ok(Moment::Event(name, number)),
        _ => Err(Text::new("events are counted from 1: event(2), event(top, 1)", "события считаются с 1: event(2), event(top, 1)")),
    }
}

/// `after event(2)`.
fn edge(text: &str) -> (&str, Edge) {
    let behind = |word: &str| text.strip_prefix(word).filter(|rest| rest.starts_with(char::is_whitespace)).map(str::trim_start);
    match (behind("before"), behind("after")) {
        (Some(rest), _) => (rest, Edge::Before),
        (_, Some(rest)) => (rest, Edge::After),
        _ => (text, Edge::Either),
    }
}

/// Lists of questions count from 1, those of results from 0.
fn from_zero(path: &str) -> Result<String, Text> {
    let step = |step: &str| match step.parse::<usize>() {
        Ok(0) => Err(Text::new("lists are counted from 1 here: modes.1.f", "счёт в списках здесь с 1: modes.1.f")),
        Ok(place) => Ok((place - 1).to_string()),
        Err(_) => Ok(step.to_owned()),
    };
    Ok(path.split('.').map(step).collect::<Result<Vec<_>, _>>()?.join("."))
}

fn no_column(name: &str) -> Text {
    Text::new(
        format!("there is no output, coordinate or rate `{name}`"),
        format!("нет выходной величины, координаты или скорости `{name}`"),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str, at: Option<&str>) -> Result<Wanted, Text> {
        Wanted::read(text, at, &|name| ["x", "x'", "S"].contains(&name))
    }

    #[test]
    fn questions_have_their_meaning() {
        assert_eq!(read("modes.1.f", None), Ok(Wanted::Number(Observable::field("modes.0.f"))));
        assert_eq!(read("period", None), Ok(Wanted::Number(Observable::field("period"))));
        assert_eq!(read("max(x')", None), Ok(Wanted::Number(Observable::of_quantity(analysis::reduce::Reduction::Max, "x'"))));
        assert_eq!(read("when_min(S)", None), Ok(Wanted::Instant(Moment::Extreme(Side::Least, "S".into()))));
        assert_eq!(read("event(2)", None), Ok(Wanted::Instant(Moment::Event(None, 2))));
        assert_eq!(read("event(top)", None), Ok(Wanted::Instant(Moment::Event(Some("top".into()), 1))));
        assert_eq!(read("S", Some("0.5 s")), Ok(Wanted::At("S".into(), Moment::Time(0.5), Edge::Either)));
        assert_eq!(read("S", Some("after event(top, 3)")), Ok(Wanted::At("S".into(), Moment::Event(Some("top".into()), 3), Edge::After)));
    }

    #[test]
    fn questions_without_a_meaning_are_refused() {
        for (text, at) in [
            ("modes.0.f", None),
            ("max(y)", None),
            ("x", None),
            ("y", Some("1 s")),
            ("S", Some("1 kg")),
            ("S", Some("-1 s")),
            ("event(0)", None),
        ] {
            assert!(read(text, at).is_err(), "{text} {at:?}");
        }
    }
}
