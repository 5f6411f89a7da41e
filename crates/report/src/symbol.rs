//! Names of the model as symbols in print: `phi'` is φ′, `c_x` is c with index x, `omega_p` is ω with index p.
//!
//! Latin letters are italic; Greek and Cyrillic letters, digits and primes are upright, as course standards ask.

use crate::escape::markup;

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

const GREEK: &[(&str, &str)] = &[
    ("alpha", "α"),
    ("beta", "β"),
    ("gamma", "γ"),
    ("delta", "δ"),
    ("epsilon", "ε"),
    ("zeta", "ζ"),
    ("eta", "η"),
    ("theta", "θ"),
    ("iota", "ι"),
    ("kappa", "κ"),
    ("lambda", "λ"),
    ("mu", "μ"),
    ("nu", "ν"),
    ("xi", "ξ"),
    ("pi", "π"),
    ("rho", "ρ"),
    ("sigma", "σ"),
    ("tau", "τ"),
    ("upsilon", "υ"),
    ("phi", "φ"),
    ("chi", "χ"),
    ("psi", "ψ"),
    ("omega", "ω"),
    ("eps", "ε"),
    ("Gamma", "Γ"),
    ("Delta", "Δ"),
    ("Theta", "Θ"),
    ("Lambda", "Λ"),
    ("Xi", "Ξ"),
    ("Pi", "Π"),
    ("Sigma", "Σ"),
    ("Phi", "Φ"),
    ("Psi", "Ψ"),
    ("Omega", "Ω"),
];

/// The pieces of a symbol. The part before the first `_` is the letter, the rest the index; digits right behind a letter are an
/// index too; primes stay on the line, behind the index.
pub fn pieces(name: &str) -> Vec<Piece> {
    let stem = name.trim_end_matches(['\'', '′']);
    let primes = name[stem.len()..].chars().count();
    let (head, tail) = stem.split_once('_').unwrap_or((stem, ""));
    let letters = head.trim_end_matches(|c: char| c.is_ascii_digit());
    // a name such as `2x` has no letter in front of its digits
    let (letters, digits) = if letters.is_empty() { (head, "") } else { head.split_at(letters.len()) };
    let mut out = Vec::new();
    push(&mut out, &greek(letters), false);
    push(&mut out, digits, true);
    if !digits.is_empty() && !tail.is_empty() {
        push(&mut out, ",", true);
    }
    push(&mut out, &tail.split('_').map(greek).collect::<Vec<_>>().join(","), true);
    push(&mut out, &"′".repeat(primes), false);
    out
}

fn greek(word: &str) -> String {
    let letters = word.trim_end_matches(|c: char| c.is_ascii_digit());
    match GREEK.iter().find(|(name, _)| *name == letters) {
        Some((_, letter)) => format!("{letter}{}", &word[letters.len()..]),
        None => word.into(),
    }
}

/// Adds the text, cut where the style changes.
fn push(out: &mut Vec<Piece>, text: &str, index: bool) {
    for c in text.chars() {
        let italic = c.is_ascii_alphabetic();
        match out.last_mut() {
            Some(last) if last.italic == italic && last.index == index => last.text.push(c),
            _ => out.push(Piece { text: c.into(), italic, index }),
        }
    }
}

/// The symbol as plain text: `φ′`, `c_x`.
pub fn plain(name: &str) -> String {
    let mut out = String::new();
    let mut in_index = false;
    for piece in pieces(name) {
        let raised: Option<String> = piece.index.then(|| subscript(&piece.text)).flatten();
        match raised {
            Some(low) => out.push_str(&low),
            None => {
                if piece.index && !in_index {
                    out.push('_');
                }
                out.push_str(&piece.text);
            }
        }
        in_index = piece.index;
    }
    out
}

/// Digits below the line; none if some character has no such form.
fn subscript(text: &str) -> Option<String> {
    text.chars().map(|c| c.to_digit(10).and_then(|d| char::from_u32('₀' as u32 + d))).collect()
}

/// The symbol as HTML: `<i>c</i><sub>x</sub>`.
pub fn html(name: &str) -> String {
    let mut out = String::new();
    for piece in pieces(name) {
        let text = markup(&piece.text);
        let text = if piece.italic { format!("<i>{text}</i>") } else { text };
        out.push_str(&if piece.index { format!("<sub>{text}</sub>") } else { text });
    }
    out.replace("</sub><sub>", "")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_become_symbols() {
        for (name, text, markup) in [
            ("phi'", "φ′", "φ′"),
            ("c_x", "c_x", "<i>c</i><sub><i>x</i></sub>"),
            ("phi1'", "φ₁′", "φ<sub>1</sub>′"),
            ("omega_p", "ω_p", "ω<sub><i>p</i></sub>"),
            ("x", "x", "<i>x</i>"),
            ("M_h''", "M_h′′", "<i>M</i><sub><i>h</i></sub>′′"),
            ("φ", "φ", "φ"),
            ("m_в", "m_в", "<i>m</i><sub>в</sub>"),
            ("<b>", "<b>", "&lt;<i>b</i>&gt;"),
            ("", "", ""),
        ] {
            assert_eq!(plain(name), text, "{name}");
            assert_eq!(html(name), markup, "{name}");
        }
    }
}
