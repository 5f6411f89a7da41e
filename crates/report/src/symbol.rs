//! Names of the model as symbols in print: `phi'` is φ with a dot, `c_x` is c with index x, `omega_p` is ω with index p.
//!
//! Tables, plots, pages and formulas read names in one place ([`Printer::named`]); here are only the forms that are no formulas.

use crate::formula::{Form, Identifier, Layout, Placement, Printer, Shape};
use words::Language;

/// A piece of a symbol with one style.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Piece {
    /// The letters.
    pub text: String,
    /// Slanted letters.
    pub italic: bool,
    /// Below the line, smaller.
    pub index: bool,
}

/// The symbol cut where the style changes, for writers that set letters themselves. One and two time derivatives are combining dots,
/// more are primes behind the index.
pub fn pieces(name: &str, language: Language) -> Vec<Piece> {
    if let Some(Ratio { second, of, by }) = ratio(name) {
        let upright = |text: &str| Piece { text: text.into(), italic: false, index: false };
        let mut out = Vec::new();
        let (d, square) = if second { ("d²", "²") } else { ("d", "") };
        push(&mut out, upright(d));
        pieces(of, language).into_iter().for_each(|piece| push(&mut out, piece));
        push(&mut out, upright("/d"));
        pieces(by, language).into_iter().for_each(|piece| push(&mut out, piece));
        push(&mut out, upright(square));
        return out;
    }
    let symbol = Printer::new(language).named(name);
    let (dots, primes) = match symbol.dots() {
        0 => ("", usize::from(symbol.primes)),
        1 => ("\u{307}", 0),
        2 => ("\u{308}", 0),
        _ => ("", 3),
    };
    let Identifier { base, shape, subscript, .. } = symbol;
    let mut out = Vec::new();
    let upon_line = |text: String, shape: Shape| Piece { text, italic: shape == Shape::Italic, index: false };
    push(&mut out, upon_line(format!("{base}{dots}"), shape));
    for index in subscript {
        push(&mut out, Piece { index: true, ..upon_line(index.text, index.shape) });
    }
    push(&mut out, upon_line("′".repeat(primes), Shape::Upright));
    out
}

/// A derivative of a coordinate by another: `dφ_2/dφ_1`, `d²φ_2/dφ_1²`.
struct Ratio<'a> {
    second: bool,
    of: &'a str,
    by: &'a str,
}

fn ratio(name: &str) -> Option<Ratio<'_>> {
    let (above, below) = name.strip_prefix('d')?.split_once("/d")?;
    let found = match (above.strip_prefix('²'), below.strip_suffix('²')) {
        (Some(of), Some(by)) => Ratio { second: true, of, by },
        (None, None) => Ratio { second: false, of: above, by: below },
        _ => return None,
    };
    (!found.of.is_empty() && !found.by.is_empty()).then_some(found)
}

/// Adds a piece to the last one if the style is the same.
fn push(out: &mut Vec<Piece>, piece: Piece) {
    match out.last_mut() {
        _ if piece.text.is_empty() => {}
        Some(last) if last.italic == piece.italic && last.index == piece.index => last.text.push_str(&piece.text),
        _ => out.push(piece),
    }
}

/// The symbol as plain text, as in formulas of the terminal: `φ'`, `c_x`.
pub fn plain(name: &str, language: Language) -> String {
    written(name, language, Form::Text)
}

/// The symbol as a `<math>` element.
pub fn mathml(name: &str, language: Language) -> String {
    written(name, language, Form::MathMl)
}

/// The layout of a symbol.
pub(crate) fn layout(name: &str, language: Language) -> Layout {
    let symbol = |name: &str| Layout::Symbol(Printer::new(language).named(name));
    let Some(Ratio { second, of, by }) = ratio(name) else { return symbol(name) };
    let d = || Layout::Words("d".into());
    let two = |base: Layout| Layout::Power(Box::new(base), Box::new(Layout::Number { mantissa: "2".into(), exponent: None }));
    let (above, below) = match second {
        true => (vec![two(d()), symbol(of)], vec![d(), two(symbol(by))]),
        false => (vec![d(), symbol(of)], vec![d(), symbol(by)]),
    };
    Layout::Fraction(Box::new(Layout::Row(above)), Box::new(Layout::Row(below)))
}

/// The symbol in a written form.
pub(crate) fn written(name: &str, language: Language, form: Form) -> String {
    Printer::new(language).write(&layout(name, language), form, Placement::Inline)
}

#[cfg(test)]
mod tests {
    use super::*;
    use Language::{En, Ru};

    #[test]
    fn derivatives_by_a_coordinate_are_fractions() {
        assert_eq!(written("dφ_2/dφ_1", En, Form::Latex), "\\frac{\\mathrm{d}\\varphi_2}{\\mathrm{d}\\varphi_1}");
        assert_eq!(written("d²φ_4/dφ_1²", En, Form::Latex), "\\frac{\\mathrm{d}^2\\varphi_4}{\\mathrm{d}\\varphi_1^2}");
        assert_eq!(marked("d²φ_4/dφ_1²", En), "d²/φ/[4]/d/φ/[1]²");
        // a symbol of the user that begins with d stays one
        assert!(!written("d_1", En, Form::Latex).contains("frac"));
    }

    /// Slanted pieces in `/…/`, indices in `[…]`.
    fn marked(name: &str, language: Language) -> String {
        let mark = |p: Piece| {
            let text = if p.italic { format!("/{}/", p.text) } else { p.text };
            if p.index { format!("[{text}]") } else { text }
        };
        pieces(name, language).into_iter().map(mark).collect()
    }

    #[test]
    fn names_become_symbols() {
        for (name, text, pieces) in [
            ("phi'", "φ'", "φ\u{307}"),
            ("c_x", "c_x", "/c/[/x/]"),
            ("phi1''", "φ₁''", "φ\u{308}[1]"),
            ("omega_p", "ω_p", "ω[/p/]"),
            ("M_h'''", "M_h'''", "/M/[/h/]′′′"),
            ("φ′", "φ'", "φ\u{307}"),
            ("m_в", "m_в", "/m/[в]"),
            ("speed'", "speed'", "speed′"),
            ("x_P1", "x_P1", "/x/[/P/][1]"),
            ("<b>", "<b>", "<b>"),
            ("", "", ""),
        ] {
            assert_eq!(plain(name, Ru), text, "{name}");
            assert_eq!(marked(name, Ru), pieces, "{name}");
        }
        assert_eq!(marked("omega_p", En), "/ω/[/p/]");
        assert!(mathml("<b>", En).contains("&lt;b&gt;"));
    }
}
