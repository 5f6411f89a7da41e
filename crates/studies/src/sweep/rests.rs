//! Where places of rest change between neighbouring values of a sweep: other contacts are closed, another verdict, other places.

use crate::repeat::stands::{Stand, Stands, stands};
use crate::repeat::{At, Repeated, one};
use crate::watch::Watch;
use analysis::Quantity;
use analysis::studies::rest::changes::written;
use words::Text;

/// Changes that are located at most.
const MOST: usize = 12;
/// Halvings between two values.
const HALVINGS: usize = 60;

/// Remarks on what changes between neighbouring values of the only parameter of a sweep, located by halving.
pub(super) fn remarks(at: &mut At, repeated: &Repeated, parameter: &Quantity, seen: &[(f64, Stands)]) -> Vec<(f64, Text)> {
    let pairs = seen.windows(2).filter(|pair| pair[0].1 != pair[1].1).take(MOST);
    pairs.map(|pair| remark(at, repeated, parameter, pair)).collect()
}

fn remark(at: &mut At, repeated: &Repeated, parameter: &Quantity, pair: &[(f64, Stands)]) -> (f64, Text) {
    let (mut low, mut high) = (pair[0].clone(), pair[1].clone());
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low.0 + high.0);
        if middle == low.0 || middle == high.0 {
            break;
        }
        let finding = one(at, repeated, &[(parameter.name.clone(), middle)], &mut Watch::default());
        let there = finding.ok().and_then(|f| stands(&at.machine, &f.data));
        if there == low.1 { low.0 = middle } else { high = (middle, there) }
    }
    // a contact that is about to close presses by less than rounding still
    let at = 0.5 * (low.0 + high.0);
    let value = written(at, parameter);
    let (what, name) = (difference(&low.1, &high.1), &parameter.name);
    (at, Text::new(format!("at {name} = {}: {}", value.en, what.en), format!("при {name} = {}: {}", value.ru, what.ru)))
}

fn difference(before: &Stands, after: &Stands) -> Text {
    let (a, b) = match (before, after) {
        (Some(a), Some(b)) => (a, b),
        (Some(_), None) => return Text::new("the place of rest that was found ends", "найденное положение равновесия исчезает"),
        _ => return Text::new("a place of rest appears", "появляется положение равновесия"),
    };
    if a.len() != b.len() {
        return Text::new(
            format!("places of rest that are found: {} before, {} behind", a.len(), b.len()),
            format!("найденных положений равновесия до этого значения {}, после него {}", a.len(), b.len()),
        );
    }
    let mut list: Vec<Text> = Vec::new();
    for (x, y) in a.iter().zip(b) {
        let names =
            |of: &Stand, other: &Stand| of.closed.iter().filter(|c| !other.closed.contains(c)).cloned().collect::<Vec<_>>().join(", ");
        let (closes, opens) = (names(y, x), names(x, y));
        let mut say = |en: String, ru: String| {
            let text = Text::new(en, ru);
            if !list.contains(&text) {
                list.push(text);
            }
        };
        if !closes.is_empty() {
            say(format!("contacts that close: {closes}"), format!("замыкаются контакты: {closes}"));
        }
        if !opens.is_empty() {
            say(format!("contacts that open: {opens}"), format!("размыкаются контакты: {opens}"));
        }
        if x.stable != y.stable {
            let word = |stable: Option<bool>| match stable {
                Some(true) => ("stable", "устойчивое"),
                Some(false) => ("unstable", "неустойчивое"),
                None => ("not decided", "устойчивость не определена"),
            };
            let (x, y) = (word(x.stable), word(y.stable));
            say(
                format!("the place of rest is {} before and {} behind", x.0, y.0),
                format!("положение равновесия: до – {}, после – {}", x.1, y.1),
            );
        }
    }
    let join = |pick: fn(&Text) -> &str| list.iter().map(pick).collect::<Vec<_>>().join("; ");
    Text::new(join(|t| &t.en), join(|t| &t.ru))
}
