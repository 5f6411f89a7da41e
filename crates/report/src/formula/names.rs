//! Names of the model file to symbols: `omega_p` is ω with the subscript p, `phi1` is φ₁, `vx(A)` is v with the subscript x, A.

use super::{Identifier, Index, Shape};
use words::Language;
use words::letters::greek;

/// Kinematic requests whose letter is not their name: function, letter, leading subscript.
const REQUESTS: [(&str, &str, &str); 13] = [
    ("vx", "v", "x"),
    ("vy", "v", "y"),
    ("vz", "v", "z"),
    ("ax", "a", "x"),
    ("ay", "a", "y"),
    ("az", "a", "z"),
    ("speed", "v", ""),
    ("angle", "φ", ""),
    ("kinetic_energy", "T", ""),
    ("potential_energy", "Π", ""),
    ("dissipation", "Φ", ""),
    ("force", "F", ""),
    ("extension", "Δ", ""),
];

/// The symbol of a name, without dots.
pub(super) fn identifier(name: &str, language: Language) -> Identifier {
    if let Some((function, arguments)) = name.strip_suffix(')').and_then(|n| n.split_once('(')) {
        return request(function, arguments, language);
    }
    let name = plain_digits(name);
    let mut parts = name.split('_').filter(|p| !p.is_empty());
    let first = parts.next().unwrap_or(&name);
    let (letters, digits) = match split_digits(first) {
        ("", all) => (all, ""),
        split => split,
    };
    let (base, attached) = base_letter(letters);
    let mut subscript = Vec::new();
    for part in attached.into_iter().chain([digits]).chain(parts) {
        append_index(&mut subscript, part, language);
    }
    Identifier { shape: shape_of(&base, language), base, primes: 0, subscript }
}

/// `vx(A)`: the arguments become the end of the subscript.
fn request(function: &str, arguments: &str, language: Language) -> Identifier {
    let known = REQUESTS.iter().find(|r| r.0 == function);
    let mut id = match known {
        Some((_, letter, _)) => Identifier { base: (*letter).to_owned(), shape: shape_of(letter, language), primes: 0, subscript: vec![] },
        None => identifier(function, language),
    };
    for part in known.map(|r| r.2).into_iter().chain(arguments.split(',')) {
        append_index(&mut id.subscript, part.trim(), language);
    }
    id
}

/// Adds one part to a subscript; parts are separated by commas.
pub(super) fn append_index(subscript: &mut Vec<Index>, part: &str, language: Language) {
    let part = plain_digits(part);
    if part.is_empty() {
        return;
    }
    if !subscript.is_empty() {
        subscript.push(Index { text: ",".into(), shape: Shape::Upright });
    }
    for (k, piece) in part.split('_').filter(|p| !p.is_empty()).enumerate() {
        // the index of an index: Q of φ_2 is Q with φ2
        let number = piece.chars().all(|c| c.is_ascii_digit());
        if k > 0 && !number {
            subscript.push(Index { text: ",".into(), shape: Shape::Upright });
        }
        let (letters, digits) = split_digits(piece);
        let text = greek(letters).map_or_else(|| letters.to_owned(), String::from);
        for text in [text, digits.to_owned()] {
            if !text.is_empty() {
                subscript.push(Index { shape: shape_of(&text, language), text });
            }
        }
    }
}

/// The letter a name starts with: a Greek letter, one letter, a letter with an axis (`Fx`), or the whole word.
fn base_letter(letters: &str) -> (String, Option<&str>) {
    if let Some(letter) = greek(letters) {
        return (letter.to_string(), None);
    }
    let mut characters = letters.chars();
    match (characters.next(), characters.next(), characters.next()) {
        (Some(first), Some('x' | 'y' | 'z'), None) if first.is_alphabetic() => (first.to_string(), Some(&letters[first.len_utf8()..])),
        _ => (letters.to_owned(), None),
    }
}

/// Single Latin letters are italic; digits, words and Cyrillic upright; Greek by language.
fn shape_of(text: &str, language: Language) -> Shape {
    let mut characters = text.chars();
    match (characters.next(), characters.next()) {
        (Some(c), None) if c.is_ascii_alphabetic() => Shape::Italic,
        (Some(c), None) if is_greek(c) && language == Language::En => Shape::Italic,
        _ => Shape::Upright,
    }
}

/// A letter of the Greek alphabet.
pub(super) fn is_greek(c: char) -> bool {
    ('\u{370}'..='\u{3ff}').contains(&c)
}

/// Letters before the digits at the end, and the digits. A name of digits only keeps them as letters.
fn split_digits(part: &str) -> (&str, &str) {
    let letters = part.trim_end_matches(|c: char| c.is_ascii_digit());
    part.split_at(letters.len())
}

/// Subscript digits of Unicode become digits, braces of a hand-written subscript vanish: `φ₁` is `φ1`, `m_{пр}` is `m_пр`.
fn plain_digits(name: &str) -> String {
    name.chars()
        .filter(|c| !matches!(c, '{' | '}'))
        .map(|c| match c {
            '₀'..='₉' => char::from(b'0' + (c as u32 - '₀' as u32) as u8),
            _ => c,
        })
        .collect()
}
