//! Numbers of results as users name them: `max(x)`, `mean(phi', 20 s, 30 s)`, `events`, `multipliers.1.abs`.
//!
//! What stands in the brackets is a result of the machine or a formula of its motion; two instants behind it make a window. Commas separate; where a semicolon stands outside
//! of inner brackets, semicolons do, and commas are decimal marks.

use crate::units::{Dimension, parse_quantity};
use std::ops::Range;
use words::{Notice, Place};

/// What may be made of a quantity over a motion.
pub const REDUCED: [&str; 5] = ["max", "min", "amplitude", "mean", "last"];
/// The only one that an instant decides.
const LAST: &str = "last";

/// A number of a result.
#[derive(Clone, Debug, PartialEq)]
pub struct Observed {
    /// What is made of the quantity: one of [`REDUCED`]; none for what a study names itself.
    pub word: Option<&'static str>,
    /// The quantity, or the whole text.
    pub of: String,
    /// Where the quantity stands in the text, bytes.
    pub span: Range<usize>,
    /// From, to, s; the whole motion without it.
    pub window: Option<[f64; 2]>,
}

/// Reads one.
///
/// # Errors
/// M377: a window without two ascending instants.
pub fn observed(text: &str) -> Result<Observed, Notice> {
    let start = text.len() - text.trim_start().len();
    let body = text.trim();
    let whole = || Observed { word: None, of: body.to_owned(), span: start..start + body.len(), window: None };
    let Some((word, open)) = REDUCED.iter().find_map(|word| opened(body, word)) else { return Ok(whole()) };
    let parts = parts(&body[open..body.len() - 1], None);
    let placed = |part: &Range<usize>| {
        let (from, text) = (start + open + part.start, &body[open + part.start..open + part.end]);
        let lead = text.len() - text.trim_start().len();
        from + lead..from + lead + text.trim().len()
    };
    let spans: Vec<Range<usize>> = parts.iter().map(placed).collect();
    let of = |span: &Range<usize>| text[span.clone()].to_owned();
    match &spans[..] {
        [only] => Ok(Observed { word: Some(word), of: of(only), span: only.clone(), window: None }),
        [what, from, to] => {
            let window = window(word, text, [from, to])?;
            Ok(Observed { word: Some(word), of: of(what), span: what.clone(), window: Some(window) })
        }
        _ => Err(no_window(start..start + body.len())),
    }
}

/// The place behind `word(`, when the bracket closes at the end.
fn opened(body: &str, word: &'static str) -> Option<(&'static str, usize)> {
    let rest = body.strip_prefix(word)?;
    let inner = rest.trim_start().strip_prefix('(')?;
    let open = body.len() - inner.len();
    let mut depth = 1_usize;
    for (at, c) in inner.char_indices() {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return (at + 1 == inner.len()).then_some((word, open));
        }
    }
    None
}

/// A list of several, parted by commas outside of brackets, as on the command line.
pub fn listed(text: &str) -> Vec<String> {
    parts(text, Some(',')).into_iter().map(|part| text[part].trim().to_owned()).filter(|part| !part.is_empty()).collect()
}

/// Parts between separators outside of brackets: this one, or semicolons where there are any, else commas.
fn parts(text: &str, separator: Option<char>) -> Vec<Range<usize>> {
    let outside = |wanted: char| {
        let mut depth = 0_usize;
        let mut found = Vec::new();
        for (at, c) in text.char_indices() {
            match c {
                '(' | '[' => depth += 1,
                ')' | ']' => depth = depth.saturating_sub(1),
                c if c == wanted && depth == 0 => found.push(at),
                _ => {}
            }
        }
        found
    };
    let cuts = match separator {
        Some(separator) => outside(separator),
        None => Some(outside(';')).filter(|cuts| !cuts.is_empty()).unwrap_or_else(|| outside(',')),
    };
    let starts = std::iter::once(0).chain(cuts.iter().map(|cut| cut + 1));
    let ends = cuts.iter().copied().chain(std::iter::once(text.len()));
    starts.zip(ends).map(|(from, to)| from..to).collect()
}

fn window(word: &str, text: &str, ends: [&Range<usize>; 2]) -> Result<[f64; 2], Notice> {
    let both = ends[0].start..ends[1].end;
    if word == LAST {
        return Err(Notice::piece("M377", both, "the last value has no window", "у последнего значения нет окна")
            .help("write last(x), or mean(x, 20 s, 30 s) for a window", "напишите last(x), а для окна — mean(x, 20 с, 30 с)"));
    }
    let one = |span: &Range<usize>| {
        let moved = |fault: Notice| match fault.place.clone() {
            Place::Piece(inner) => Notice { place: Place::Piece(span.start + inner.start..span.start + inner.end), ..fault },
            _ => fault,
        };
        parse_quantity(&text[span.clone()], &Dimension::TIME).map_err(moved)
    };
    let [from, to] = [one(ends[0])?, one(ends[1])?];
    if from >= 0.0 && from < to && to.is_finite() { Ok([from, to]) } else { Err(no_window(both)) }
}

fn no_window(span: Range<usize>) -> Notice {
    Notice::piece("M377", span, "a window has two instants, the first the earlier one", "окно задают два момента, первый — более ранний")
        .why("they are counted from the start of the motion, t = 0", "моменты отсчитываются от начала движения, t = 0")
        .help("write mean(x, 20 s, 30 s)", "напишите mean(x, 20 с, 30 с)")
}

#[cfg(test)]
mod tests {
    use super::{Observed, listed, observed};

    fn read(text: &str) -> (Option<&'static str>, String, Option<[f64; 2]>) {
        let Observed { word, of, span, window } = observed(text).unwrap();
        assert_eq!(&text[span], of);
        (word, of, window)
    }

    #[test]
    fn quantities_windows_and_names_are_told_apart() {
        assert_eq!(read(" mean(phi', 20 s, 30 s)"), (Some("mean"), "phi'".into(), Some([20.0, 30.0])));
        assert_eq!(read("max( x - max(y, z) )"), (Some("max"), "x - max(y, z)".into(), None));
        assert_eq!(read("min(atan2(y, x), 0, 1 min)"), (Some("min"), "atan2(y, x)".into(), Some([0.0, 60.0])));
        assert_eq!(read("amplitude(x; 0,5 с; 1,5 с)"), (Some("amplitude"), "x".into(), Some([0.5, 1.5])));
        assert_eq!(read("max(x) - min(x)"), (None, "max(x) - min(x)".into(), None));
        assert_eq!(read("multipliers.1.abs"), (None, "multipliers.1.abs".into(), None));
        assert_eq!(read("force(A)"), (None, "force(A)".into(), None));
    }

    #[test]
    fn a_list_is_parted_outside_of_brackets() {
        assert_eq!(listed("period, mean(x, 1 s, 2 s),max(y)"), ["period", "mean(x, 1 s, 2 s)", "max(y)"]);
    }

    #[test]
    fn windows_without_two_ascending_instants_are_refused() {
        let code = |text: &str| observed(text).err().map(|fault| fault.code);
        for text in
            ["mean(x, 1 s)", "mean(x, 2 s, 1 s)", "mean(x, 1 s, 1 s)", "max(x, -1 s, 1 s)", "last(x, 1 s, 2 s)", "mean(x, 1 s, 2 s, 3 s)"]
        {
            assert_eq!(code(text), Some("M377"), "{text}");
        }
        assert_eq!(code("mean(x, 1 kg, 2 kg)"), Some("M024"));
    }
}
