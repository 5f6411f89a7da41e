//! Plain Unicode text: `m l² φ'' + m g l sin φ = 0`. Time derivatives are primes, fractions are slashes.

use super::layout::{Bare, Bracket, Identifier, Layout, Row, Sign};
use super::pieces::{Joint, Lines, Piece};

/// Start of a continuation line.
pub(super) const INDENT: &str = "    ";

/// The whole formula.
pub(super) fn lines(lines: &Lines) -> String {
    let mut out = String::new();
    for (i, row) in lines.rows.iter().enumerate() {
        if i > 0 {
            if let Some(sign) = row.first().and_then(joint_character) {
                out.push(' ');
                out.push(sign);
            }
            out.push('\n');
            out.push_str(INDENT);
        }
        for (k, piece) in row.iter().enumerate() {
            if k > 0 {
                out.push(' ');
            }
            write_piece(piece, &mut out);
        }
    }
    out
}

/// Characters a piece takes with the space before it.
pub(super) fn piece_length(piece: &Piece) -> usize {
    let mut out = String::new();
    write_piece(piece, &mut out);
    out.chars().count() + 1
}

fn write_piece(piece: &Piece, out: &mut String) {
    if let Some(sign) = joint_character(piece) {
        out.push(sign);
        out.push(' ');
    }
    if piece.minus {
        out.push(Sign::Minus.character());
    }
    write(piece.body, out);
}

pub(super) fn joint_character(piece: &Piece) -> Option<char> {
    match piece.joint {
        Joint::Start => None,
        Joint::Sign(sign) => Some(sign.character()),
        Joint::Relation(relation) => Some(relation.character()),
    }
}

fn write(layout: &Layout, out: &mut String) {
    match layout {
        Layout::Number { mantissa, exponent } => number(mantissa, *exponent, out),
        Layout::Symbol(identifier) => symbol(identifier, out),
        Layout::Words(words) => out.push_str(words),
        Layout::Row(items) => items.iter().for_each(|item| write(item, out)),
        Layout::Sum(terms) => sum(terms, out),
        Layout::Product(factors) => product(factors, " ", out),
        Layout::Fraction(above, below) => {
            part(above, needs_brackets_above, out);
            out.push('/');
            part(below, needs_brackets_below, out);
        }
        Layout::Power(base, exponent) => {
            write(base, out);
            power(exponent, out);
        }
        Layout::Exponential(argument) => {
            out.push_str("exp");
            fenced(argument, out);
        }
        Layout::Root { degree, radicand } => root(*degree, radicand, out),
        Layout::Fence(Bracket::Round, inner) => fenced(inner, out),
        Layout::Fence(Bracket::Bar, inner) => {
            out.push('|');
            write(inner, out);
            out.push('|');
        }
        Layout::Call { name, power, argument, bare } => call((name, power.as_deref()), argument, *bare, out),
        Layout::List(items, mark) => {
            for (i, item) in items.iter().enumerate() {
                if i > 0 {
                    out.push_str(mark);
                    out.push(' ');
                }
                write(item, out);
            }
        }
        Layout::Related(left, relation, right) => {
            write(left, out);
            out.push(' ');
            out.push(relation.character());
            out.push(' ');
            write(right, out);
        }
        Layout::Cases(rows) => cases(rows, out),
    }
}

/// In brackets where they are needed.
fn part(layout: &Layout, needed: fn(&Layout) -> bool, out: &mut String) {
    if needed(layout) { fenced(layout, out) } else { write(layout, out) }
}

fn fenced(layout: &Layout, out: &mut String) {
    out.push('(');
    write(layout, out);
    out.push(')');
}

/// A function by its name and the power behind it, `sin² φ`.
fn call((name, power): (&str, Option<&str>), argument: &Layout, bare: Bare, out: &mut String) {
    out.push_str(name);
    if let Some(power) = power {
        out.push_str(&raised(power).unwrap_or_else(|| format!("^{power}")));
    }
    match (bare, argument) {
        (Bare::Always, Layout::Product(factors)) => {
            out.push(' ');
            product(factors, "", out);
        }
        (Bare::Always, argument) => {
            out.push(' ');
            write(argument, out);
        }
        _ => fenced(argument, out),
    }
}

fn number(mantissa: &str, exponent: Option<i32>, out: &mut String) {
    let Some(n) = exponent else { return out.push_str(mantissa) };
    if mantissa != "1" {
        out.push_str(mantissa);
        out.push('·');
    }
    out.push_str("10");
    out.push_str(&raised(&n.to_string()).unwrap_or_default());
}

fn sum(terms: &[(Sign, Layout)], out: &mut String) {
    for (i, (sign, body)) in terms.iter().enumerate() {
        match (i, sign) {
            (0, Sign::Plus) => {}
            (0, Sign::Minus) => out.push(sign.character()),
            _ => {
                out.push(' ');
                out.push(sign.character());
                out.push(' ');
            }
        }
        write(body, out);
    }
}

/// A space between factors; a dot where a number follows a number.
fn product(factors: &[Layout], space: &str, out: &mut String) {
    for (i, factor) in factors.iter().enumerate() {
        if i > 0 {
            out.push_str(if factor.starts_with_digit() { "·" } else { space });
        }
        part(factor, |f| matches!(f, Layout::Fraction(..) | Layout::Sum(_)), out);
    }
}

/// `cos φ/2` would read as the cosine of φ/2.
fn needs_brackets_above(layout: &Layout) -> bool {
    match layout {
        Layout::Sum(_) | Layout::Fraction(..) | Layout::Related(..) => true,
        Layout::Call { bare, .. } => *bare == Bare::Always,
        Layout::Root { radicand, .. } => matches!(**radicand, Layout::Symbol(_)),
        Layout::Product(factors) => factors.last().is_some_and(needs_brackets_above),
        _ => false,
    }
}

fn needs_brackets_below(layout: &Layout) -> bool {
    match layout {
        Layout::Sum(_) | Layout::Fraction(..) | Layout::Product(_) | Layout::Related(..) => true,
        Layout::Number { exponent, .. } => exponent.is_some(),
        _ => false,
    }
}

fn power(exponent: &Layout, out: &mut String) {
    let mut inner = String::new();
    write(exponent, &mut inner);
    let simple = match exponent {
        Layout::Number { .. } => inner.chars().all(|c| c.is_ascii_digit()),
        Layout::Symbol(_) => true,
        _ => false,
    };
    match (raised(&inner), simple) {
        (Some(raised), _) => out.push_str(&raised),
        (None, true) => {
            out.push('^');
            out.push_str(&inner);
        }
        (None, false) => {
            out.push_str("^(");
            out.push_str(&inner);
            out.push(')');
        }
    }
}

fn root(degree: u32, radicand: &Layout, out: &mut String) {
    match degree {
        2 => out.push('√'),
        3 => out.push('∛'),
        4 => out.push('∜'),
        _ => {
            part(radicand, |r| !matches!(r, Layout::Symbol(_)), out);
            out.push_str("^(1/");
            out.push_str(&degree.to_string());
            out.push(')');
            return;
        }
    }
    part(radicand, |r| !is_bare_radicand(r), out);
}

fn is_bare_radicand(radicand: &Layout) -> bool {
    match radicand {
        Layout::Symbol(identifier) => identifier.primes == 0,
        Layout::Number { exponent, .. } => exponent.is_none(),
        _ => false,
    }
}

fn cases(rows: &[Row], out: &mut String) {
    out.push('{');
    for (i, row) in rows.iter().enumerate() {
        if i > 0 {
            out.push_str("; ");
        }
        write(&row.value, out);
        out.push_str(", ");
        write(&row.condition, out);
    }
    out.push('}');
}

fn symbol(identifier: &Identifier, out: &mut String) {
    out.push_str(&identifier.base);
    out.push_str(&subscript(identifier));
    for _ in 0..identifier.primes {
        out.push('\'');
    }
}

/// `₁₂`, `_p`, `_C1`, `_{x,A}`.
fn subscript(identifier: &Identifier) -> String {
    let index: String = identifier.subscript.iter().map(|i| i.text.as_str()).collect();
    if index.is_empty() {
        index
    } else if index.chars().all(|c| c.is_ascii_digit()) {
        index.chars().filter_map(lowered).collect()
    } else if index.contains(',') {
        format!("_{{{index}}}")
    } else {
        format!("_{index}")
    }
}

/// For plots: dots above the letter and, where Unicode has the letters, a lowered subscript.
pub(super) fn label(identifier: &Identifier) -> String {
    let mut out = identifier.base.clone();
    match identifier.dots() {
        0 => {}
        1 => out.push('\u{307}'),
        2 => out.push('\u{308}'),
        _ => out.push('\u{20db}'),
    }
    let index: String = identifier.subscript.iter().map(|i| i.text.as_str()).collect();
    match index.chars().map(lowered).collect::<Option<String>>() {
        Some(low) => out.push_str(&low),
        None => out.push_str(&subscript(identifier)),
    }
    out.extend(std::iter::repeat_n('′', identifier.raised_primes()));
    out
}

fn raised(digits: &str) -> Option<String> {
    digits
        .chars()
        .map(|c| match c {
            '0' => Some('⁰'),
            '1' => Some('¹'),
            '2' => Some('²'),
            '3' => Some('³'),
            '4'..='9' => char::from_u32('⁴' as u32 + (c as u32 - '4' as u32)),
            '-' | '−' => Some('⁻'),
            _ => None,
        })
        .collect()
}

fn lowered(c: char) -> Option<char> {
    const LETTERS: [(char, char); 18] = [
        ('a', 'ₐ'),
        ('e', 'ₑ'),
        ('h', 'ₕ'),
        ('i', 'ᵢ'),
        ('j', 'ⱼ'),
        ('k', 'ₖ'),
        ('l', 'ₗ'),
        ('m', 'ₘ'),
        ('n', 'ₙ'),
        ('o', 'ₒ'),
        ('p', 'ₚ'),
        ('r', 'ᵣ'),
        ('s', 'ₛ'),
        ('t', 'ₜ'),
        ('u', 'ᵤ'),
        ('v', 'ᵥ'),
        ('x', 'ₓ'),
        ('φ', 'ᵩ'),
    ];
    if c.is_ascii_digit() {
        return char::from_u32('₀' as u32 + (c as u32 - '0' as u32));
    }
    LETTERS.iter().find(|(letter, _)| *letter == c).map(|(_, low)| *low)
}
