//! `[regimes]`: conditions over numbers of a motion, each the name of a regime.
//!
//! A condition is a formula like those of `[variants.require]`. The numbers in it (`mean(phi', 20 s, 30 s)`) are read as what studies observe and stand in the formula as constants
//! with names of their own, whose values every run gives anew.

use super::cover::{Cover, constant};
use super::studies::observed;
use crate::asked::observed::{Observed, REDUCED, observed as parsed};
use crate::model::RegimeDecl;
use crate::reader::{Fields, Reader, string};
use crate::snippet::{Site, Snippet};
use crate::units::Dimension;
use std::borrow::Cow;
use std::ops::Range;
use words::Notice;

/// All regimes, in the user's order: the first whose condition holds is meant.
pub(super) fn read<'a>(reader: &mut Reader<'a>, top: &Fields<'a>) -> Vec<RegimeDecl> {
    let mut found = Vec::new();
    for (name, _, value) in top.rows(reader, "regimes") {
        let Some((text, span)) = string(reader, value, "a condition in quotes", "условие в кавычках") else { continue };
        let Some(snippet) = reader.snippet(value) else { continue };
        found.extend(regime(reader, (name, &text, span), &snippet));
    }
    found
}

fn regime<'a>(reader: &mut Reader<'a>, (name, text, span): (&str, &str, Range<usize>), snippet: &Snippet<'a>) -> Option<RegimeDecl> {
    let mut cover = Cover { before: Vec::new(), own: [false; 2] };
    let (mut formula, mut numbers, mut last) = (String::new(), Vec::new(), 0);
    let mut good = true;
    for place in numbers_in(text, &|name| reader.scope.get(name).is_some()) {
        let part = snippet.part(place.clone());
        let Some(found) = observed::note(reader, &part) else {
            good = false;
            continue;
        };
        let own = format!("number_{}", numbers.len() + 1);
        let dimension = observed::dimension(reader, &part.text).unwrap_or(Dimension::NONE);
        let symbol = cover.quantity(reader, &own, (&format!("regime {name} {own}"), dimension));
        numbers.push((canonical(&part.text, &found), symbol));
        formula += &text[last..place.start];
        formula += &own;
        last = place.end;
    }
    formula += &text[last..];
    let holds = good.then(|| {
        // a condition stands in an `if`: 1 where it holds
        let condition = Snippet { text: Cow::Owned(format!("if({formula}, 1, 0)")), site: Site::Inside(span.clone()) };
        let raw = reader.raw_text(condition);
        constant(reader, &raw, None)
    });
    cover.lift(reader);
    let (holds, _) = holds??;
    if numbers.is_empty() {
        let fault = Notice::piece(
            "M378",
            span.clone(),
            format!("the regime `{name}` asks for no number of a motion"),
            format!("условие режима `{name}` не содержит ни одного числа движения"),
        );
        reader.fault(fault.help(
            "write for example \"abs(mean(phi', 20 s, 30 s) - 200 [rad/s]) < 5 [rad/s]\"",
            "напишите, например, \"abs(mean(phi', 20 с, 30 с) - 200 [рад/с]) < 5 [рад/с]\"",
        ));
        return None;
    }
    Some(RegimeDecl { name: name.to_owned(), text: text.to_owned(), numbers, holds, span })
}

/// How many events there are, of all or of one name.
const EVENTS: &str = "events";

/// A number as studies name it: blanks within brackets say nothing.
fn canonical(text: &str, found: &Observed) -> String {
    let text = text.trim();
    match (found.word, found.window) {
        (Some(word), None) => format!("{word}({})", found.of),
        (None, _) => text.chars().filter(|c| !c.is_whitespace()).collect(),
        _ => text.to_owned(),
    }
}

/// Where numbers of a motion stand in a condition: `mean(..)`, `amplitude(..)`, `last(..)`, and `max(..)`, `min(..)` of one quantity or with a window; with several quantities
/// these are functions. Also `events(NAME)`, and `events` where that is no name of the model.
fn numbers_in(text: &str, is_name: &dyn Fn(&str) -> bool) -> Vec<Range<usize>> {
    let mut found: Vec<Range<usize>> = Vec::new();
    let mut at = 0;
    while at < text.len() {
        let rest = &text[at..];
        let before = text[..at].chars().next_back();
        let begins = !before.is_some_and(|c| c.is_alphanumeric() || c == '_');
        let called = |word: &str| rest.strip_prefix(word).is_some_and(|r| r.trim_start().starts_with('('));
        let word = REDUCED.iter().chain([&EVENTS]).find(|word| begins && called(word));
        let ends = |r: &str| !r.starts_with(|c: char| c.is_alphanumeric() || c == '_');
        let alone = begins && word.is_none() && rest.strip_prefix(EVENTS).is_some_and(ends) && !is_name(EVENTS);
        let end = if alone { Some(at + EVENTS.len()) } else { word.and_then(|_| closed(rest)).map(|length| at + length) };
        let is_number = |end: usize| {
            let function = matches!(word, Some(&"max" | &"min"));
            parsed(&text[at..end]).is_ok() || !function
        };
        match end.filter(|end| is_number(*end)) {
            Some(end) => {
                found.push(at..end);
                at = end;
            }
            None => at += rest.chars().next().map_or(1, char::len_utf8),
        }
    }
    found
}

/// The length of a call up to its closing bracket.
fn closed(text: &str) -> Option<usize> {
    let mut depth = 0_usize;
    for (at, c) in text.char_indices() {
        match c {
            '(' => depth += 1,
            ')' if depth <= 1 => return Some(at + 1),
            ')' => depth -= 1,
            _ => {}
        }
    }
    None
}
