//! Typst for math mode. Every atom stands apart with spaces around it: letters side by side would be one name. Digits with a comma and words
//! are strings, since a bare comma parts the arguments of a function.

use super::layout::{Bare, Bracket, Identifier, Layout, Relation, Row, Shape, Sign};
use super::names::is_greek;
use super::pieces::{Lines, Piece};

/// The whole formula; several lines are aligned at the relation of the first, or at the left.
pub(super) fn lines(lines: &Lines) -> String {
    let mut out = String::new();
    let broken = lines.rows.len() > 1;
    let mark = lines.relation().filter(|_| broken);
    for (i, row) in lines.rows.iter().enumerate() {
        if i > 0 {
            out.push_str(&format!(" {} \\\n& quad ", row.first().map_or("", joint)));
        } else if broken && mark.is_none() {
            out.push_str("& ");
        }
        for (k, piece) in row.iter().enumerate() {
            if k > 0 {
                out.push(' ');
            }
            if i == 0 && mark == Some(k) {
                out.push('&');
            }
            write_piece(piece, &mut out);
        }
    }
    out
}

fn write_piece(piece: &Piece, out: &mut String) {
    piece.write_in_ascii(relation_text, write, out);
}

fn joint(piece: &Piece) -> &'static str {
    piece.joint_in_ascii(relation_text)
}

fn relation_text(relation: Relation) -> &'static str {
    match relation {
        Relation::Equal => "=",
        Relation::Less => "<",
        Relation::LessEqual => "<=",
        Relation::Greater => ">",
        Relation::GreaterEqual => ">=",
    }
}

fn write(layout: &Layout, out: &mut String) {
    match layout {
        Layout::Number { mantissa, exponent } => number(mantissa, *exponent, out),
        Layout::Symbol(identifier) => symbol(identifier, None, out),
        Layout::Words(words) => self::words(words, out),
        Layout::Row(items) => spaced(items, out),
        Layout::Sum(terms) => sum(terms, out),
        Layout::Product(factors) => product(factors, out),
        Layout::Fraction(above, below) => call("frac", &[above, below], out),
        Layout::Power(base, exponent) => power(base, exponent, out),
        Layout::Exponential(argument) => {
            out.push_str("upright(e)^");
            grouped(argument, out);
        }
        Layout::Root { degree: 2, radicand } => call("sqrt", &[radicand], out),
        Layout::Root { degree, radicand } => {
            out.push_str(&format!("root({degree}, "));
            write(radicand, out);
            out.push(')');
        }
        Layout::Fence(Bracket::Round, inner) => grouped(inner, out),
        Layout::Fence(Bracket::Bar, inner) => call("abs", &[inner], out),
        Layout::Call { name, power, argument, bare } => function(name, power.as_deref(), (argument, *bare), out),
        Layout::List(items, mark) => list(items, mark, out),
        Layout::Related(left, relation, right) => {
            write(left, out);
            out.push_str(&format!(" {} ", relation_text(*relation)));
            write(right, out);
        }
        Layout::Cases(rows) => cases(rows, out),
    }
}

/// `name(a, b)`.
fn call(name: &str, arguments: &[&Layout], out: &mut String) {
    out.push_str(name);
    out.push('(');
    for (i, argument) in arguments.iter().enumerate() {
        if i > 0 {
            out.push_str(", ");
        }
        write(argument, out);
    }
    out.push(')');
}

fn grouped(layout: &Layout, out: &mut String) {
    call("", &[layout], out);
}

fn spaced(items: &[Layout], out: &mut String) {
    for (i, item) in items.iter().enumerate() {
        if i > 0 {
            out.push(' ');
        }
        write(item, out);
    }
}

fn number(mantissa: &str, exponent: Option<i32>, out: &mut String) {
    match exponent {
        None => digits(mantissa, out),
        Some(n) if mantissa == "1" => out.push_str(&format!("10^({n})")),
        Some(n) => {
            digits(mantissa, out);
            out.push_str(&format!(" dot.op 10^({n})"));
        }
    }
}

fn digits(text: &str, out: &mut String) {
    let plain = text.chars().all(|c| c.is_ascii_digit() || c == '.') && text.starts_with(|c: char| c.is_ascii_digit());
    if plain { out.push_str(text) } else { string(text, out) }
}

/// Upright letters as they are.
fn string(text: &str, out: &mut String) {
    out.push('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => {
                out.push('\\');
                out.push(c);
            }
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out.push('"');
}

fn words(words: &str, out: &mut String) {
    match words {
        "∂" => out.push('∂'),
        "d" => out.push_str("upright(d)"),
        "…" => out.push_str("dots.h"),
        " " => out.push_str("thin"),
        other => string(other, out),
    }
}

fn sum(terms: &[(Sign, Layout)], out: &mut String) {
    for (i, (sign, body)) in terms.iter().enumerate() {
        match (i, sign) {
            (0, Sign::Plus) => {}
            (0, Sign::Minus) => out.push('-'),
            _ => out.push_str(&format!(" {} ", sign.ascii())),
        }
        write(body, out);
    }
}

fn product(factors: &[Layout], out: &mut String) {
    for (i, factor) in factors.iter().enumerate() {
        if i > 0 {
            out.push_str(if factor.starts_with_digit() { " dot.op " } else { " " });
        }
        write(factor, out);
    }
}

fn power(base: &Layout, exponent: &Layout, out: &mut String) {
    match base {
        Layout::Symbol(identifier) => symbol(identifier, Some(exponent), out),
        _ => {
            write(base, out);
            out.push('^');
            grouped(exponent, out);
        }
    }
}

fn function(name: &str, power: Option<&str>, (argument, bare): (&Layout, Bare), out: &mut String) {
    const KNOWN: [&str; 14] = ["sin", "cos", "tan", "arcsin", "arccos", "arctan", "sinh", "cosh", "tanh", "exp", "ln", "min", "max", "log"];
    match KNOWN.contains(&name) {
        true => out.push_str(name),
        false => out.push_str(&format!("op(\"{name}\")")),
    }
    if let Some(power) = power {
        out.push_str("^(");
        digits(power, out);
        out.push(')');
    }
    out.push(' ');
    if bare == Bare::Never { grouped(argument, out) } else { write(argument, out) }
}

fn list(items: &[Layout], mark: &str, out: &mut String) {
    let mark = match mark {
        "," => " comma ",
        ";" => " semi ",
        other => other,
    };
    for (i, item) in items.iter().enumerate() {
        if i > 0 {
            out.push_str(mark);
        }
        write(item, out);
    }
}

fn cases(rows: &[Row], out: &mut String) {
    out.push_str("cases(");
    for (i, row) in rows.iter().enumerate() {
        write(&row.value, out);
        out.push_str(" comma & ");
        write(&row.condition, out);
        out.push_str(if i + 1 < rows.len() { " semi, " } else { ")" });
    }
}

fn symbol(identifier: &Identifier, exponent: Option<&Layout>, out: &mut String) {
    let dots = match identifier.dots() {
        0 => "",
        1 => "dot",
        2 => "dot.double",
        _ => "dot.triple",
    };
    let letter = letters(&identifier.base, identifier.shape);
    out.push_str(&if dots.is_empty() { letter } else { format!("{dots}({letter})") });
    if !identifier.subscript.is_empty() {
        let index: Vec<String> = identifier.subscript.iter().map(|i| letters(&i.text, i.shape)).collect();
        out.push_str(&format!("_({})", index.join(" ")));
    }
    let primes = "prime ".repeat(identifier.raised_primes());
    if exponent.is_some() || !primes.is_empty() {
        out.push_str(&format!("^({primes}"));
        if let Some(exponent) = exponent {
            write(exponent, out);
        }
        out.push(')');
    }
}

/// Letters of a symbol or subscript: a bare letter is slanted, a string stands upright.
fn letters(text: &str, shape: Shape) -> String {
    let mut characters = text.chars();
    match (characters.next(), characters.next()) {
        (Some(c), None) if c.is_ascii_alphabetic() || is_greek(c) => match shape {
            Shape::Italic => c.to_string(),
            Shape::Upright => format!("upright({c})"),
        },
        (Some(','), None) => "\",\"".into(),
        (Some(_), _) if text.chars().all(|c| c.is_ascii_digit()) => text.to_owned(),
        _ => {
            let mut out = String::new();
            string(text, &mut out);
            out
        }
    }
}
