//! LaTeX for math mode with amsmath.

use super::layout::{Bare, Bracket, Identifier, Layout, Relation, Row, Shape, Sign};
use super::names::is_greek;
use super::pieces::{Lines, Piece};

/// The whole formula; several lines become an `aligned` block.
pub(super) fn lines(lines: &Lines) -> String {
    let mut out = String::new();
    let broken = lines.rows.len() > 1;
    let mark = if broken { lines.relation() } else { None };
    if broken {
        out.push_str("\\begin{aligned}\n");
    }
    for (i, row) in lines.rows.iter().enumerate() {
        if i > 0 {
            if let Some(first) = row.first() {
                out.push_str(&format!(" {} {{}} \\\\\n", joint(first)));
            }
            out.push_str(if mark.is_some() { "&\\quad {}" } else { "\\quad {}" });
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
    if broken {
        out.push_str("\n\\end{aligned}");
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
        Relation::LessEqual => "\\le",
        Relation::Greater => ">",
        Relation::GreaterEqual => "\\ge",
    }
}

fn write(layout: &Layout, out: &mut String) {
    match layout {
        Layout::Number { mantissa, exponent } => number(mantissa, *exponent, out),
        Layout::Symbol(identifier) => symbol(identifier, None, out),
        Layout::Words(words) => self::words(words, out),
        Layout::Row(items) => items.iter().for_each(|item| write(item, out)),
        Layout::Sum(terms) => sum(terms, out),
        Layout::Product(factors) => product(factors, out),
        Layout::Fraction(above, below) => {
            out.push_str("\\frac");
            braced(above, out);
            braced(below, out);
        }
        Layout::Power(base, exponent) => power(base, exponent, out),
        Layout::Exponential(argument) => {
            out.push_str("\\mathrm{e}^");
            braced(argument, out);
        }
        Layout::Root { degree, radicand } => {
            out.push_str("\\sqrt");
            if *degree != 2 {
                out.push_str(&format!("[{degree}]"));
            }
            braced(radicand, out);
        }
        Layout::Fence(Bracket::Round, inner) => fence('(', inner, ')', out),
        Layout::Fence(Bracket::Bar, inner) => fence('|', inner, '|', out),
        Layout::Call { name, power, argument, bare } => call(name, power.as_deref(), argument, *bare, out),
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
            out.push_str(relation_text(*relation));
            out.push(' ');
            write(right, out);
        }
        Layout::Cases(rows) => cases(rows, out),
    }
}

fn braced(layout: &Layout, out: &mut String) {
    out.push('{');
    write(layout, out);
    out.push('}');
}

/// Digits; a decimal comma must not get the space of a list.
fn number(mantissa: &str, exponent: Option<i32>, out: &mut String) {
    let digits = mantissa.replace(',', "{,}");
    match exponent {
        None => out.push_str(&digits),
        Some(n) if mantissa == "1" => out.push_str(&format!("10^{{{n}}}")),
        Some(n) => out.push_str(&format!("{digits} \\cdot 10^{{{n}}}")),
    }
}

fn words(words: &str, out: &mut String) {
    match words {
        "∂" => out.push_str("\\partial "),
        "d" => out.push_str("\\mathrm{d}"),
        "…" => out.push_str("\\ldots"),
        " " => out.push_str("\\,"),
        other => out.push_str(&format!("\\text{{{}}}", escaped(other))),
    }
}

fn sum(terms: &[(Sign, Layout)], out: &mut String) {
    for (i, (sign, body)) in terms.iter().enumerate() {
        match (i, sign) {
            (0, Sign::Plus) => {}
            (0, Sign::Minus) => out.push('-'),
            _ => {
                out.push(' ');
                out.push_str(sign.ascii());
                out.push(' ');
            }
        }
        write(body, out);
    }
}

fn product(factors: &[Layout], out: &mut String) {
    for (i, factor) in factors.iter().enumerate() {
        if i > 0 {
            out.push_str(if factor.starts_with_digit() { " \\cdot " } else { " " });
        }
        write(factor, out);
    }
}

fn power(base: &Layout, exponent: &Layout, out: &mut String) {
    match base {
        // a power of a subscripted letter shares its braces
        Layout::Symbol(identifier) => symbol(identifier, Some(exponent), out),
        _ => {
            write(base, out);
            out.push('^');
            script(exponent, out);
        }
    }
}

/// A script: single characters stay without braces.
fn script(layout: &Layout, out: &mut String) {
    let mut inner = String::new();
    write(layout, &mut inner);
    push_script(&inner, out);
}

fn push_script(inner: &str, out: &mut String) {
    if inner.chars().count() == 1 {
        out.push_str(inner);
    } else {
        out.push('{');
        out.push_str(inner);
        out.push('}');
    }
}

fn fence(open: char, inner: &Layout, close: char, out: &mut String) {
    let tall = inner.is_tall();
    out.push_str(if tall { "\\left" } else { "" });
    out.push(open);
    write(inner, out);
    out.push_str(if tall { "\\right" } else { "" });
    out.push(close);
}

fn call(name: &str, power: Option<&str>, argument: &Layout, bare: Bare, out: &mut String) {
    const KNOWN: [&str; 14] = ["sin", "cos", "tan", "arcsin", "arccos", "arctan", "sinh", "cosh", "tanh", "exp", "ln", "min", "max", "log"];
    if KNOWN.contains(&name) {
        out.push('\\');
        out.push_str(name);
    } else {
        out.push_str(&format!("\\operatorname{{{name}}}"));
    }
    if let Some(power) = power {
        out.push('^');
        push_script(power, out);
    }
    if bare == Bare::Never {
        return fence('(', argument, ')', out);
    }
    out.push(' ');
    write(argument, out);
}

fn cases(rows: &[Row], out: &mut String) {
    out.push_str("\\begin{cases} ");
    for (i, row) in rows.iter().enumerate() {
        if i > 0 {
            out.push_str(" \\\\ ");
        }
        write(&row.value, out);
        out.push_str(", & ");
        write(&row.condition, out);
    }
    out.push_str(" \\end{cases}");
}

fn symbol(identifier: &Identifier, exponent: Option<&Layout>, out: &mut String) {
    let letter = letters(&identifier.base, identifier.shape);
    match identifier.dots() {
        0 => out.push_str(&letter),
        1 => out.push_str(&format!("\\dot{{{letter}}}")),
        2 => out.push_str(&format!("\\ddot{{{letter}}}")),
        _ => out.push_str(&format!("\\dddot{{{letter}}}")),
    }
    if !identifier.subscript.is_empty() {
        let index: Vec<String> = identifier.subscript.iter().map(|i| letters(&i.text, i.shape)).collect();
        out.push('_');
        push_script(&index.concat(), out);
    }
    let primes = "\\prime".repeat(identifier.raised_primes());
    match exponent {
        None if primes.is_empty() => {}
        None => out.push_str(&format!("^{{{primes}}}")),
        Some(exponent) if primes.is_empty() => {
            out.push('^');
            script(exponent, out);
        }
        Some(exponent) => {
            out.push_str(&format!("^{{{primes} "));
            write(exponent, out);
            out.push('}');
        }
    }
}

/// Letters of a symbol or subscript. Greek is left to the font of the document: plain LaTeX has no upright small Greek.
fn letters(text: &str, shape: Shape) -> String {
    let mut characters = text.chars();
    match (characters.next(), characters.next()) {
        (Some(c), None) if is_greek(c) => greek(c),
        (Some(c), None) if c.is_ascii_digit() || shape == Shape::Italic && c.is_ascii() => escaped(text),
        (Some(','), None) => ",".into(),
        _ if text.chars().all(|c| c.is_ascii_digit()) => text.to_owned(),
        _ if text.chars().all(|c| c.is_ascii_alphanumeric()) => format!("\\mathrm{{{text}}}"),
        _ => format!("\\text{{{}}}", escaped(text)),
    }
}

/// Greek letters that have a command.
const GREEK: [(char, &str); 35] = [
    ('α', "\\alpha"),
    ('β', "\\beta"),
    ('γ', "\\gamma"),
    ('δ', "\\delta"),
    ('ε', "\\varepsilon"),
    ('ζ', "\\zeta"),
    ('η', "\\eta"),
    ('θ', "\\theta"),
    ('ϑ', "\\vartheta"),
    ('ι', "\\iota"),
    ('κ', "\\kappa"),
    ('λ', "\\lambda"),
    ('μ', "\\mu"),
    ('ν', "\\nu"),
    ('ξ', "\\xi"),
    ('ο', "o"),
    ('π', "\\pi"),
    ('ρ', "\\rho"),
    ('σ', "\\sigma"),
    ('τ', "\\tau"),
    ('υ', "\\upsilon"),
    ('φ', "\\varphi"),
    ('χ', "\\chi"),
    ('ψ', "\\psi"),
    ('ω', "\\omega"),
    ('Γ', "\\Gamma"),
    ('Δ', "\\Delta"),
    ('Θ', "\\Theta"),
    ('Λ', "\\Lambda"),
    ('Ξ', "\\Xi"),
    ('Π', "\\Pi"),
    ('Σ', "\\Sigma"),
    ('Φ', "\\Phi"),
    ('Ψ', "\\Psi"),
    ('Ω', "\\Omega"),
];
/// Greek capitals that look Latin have none.
const LATIN_LOOKING: [(char, char); 14] = [
    ('Α', 'A'),
    ('Β', 'B'),
    ('Ε', 'E'),
    ('Ζ', 'Z'),
    ('Η', 'H'),
    ('Ι', 'I'),
    ('Κ', 'K'),
    ('Μ', 'M'),
    ('Ν', 'N'),
    ('Ο', 'O'),
    ('Ρ', 'P'),
    ('Τ', 'T'),
    ('Υ', 'Y'),
    ('Χ', 'X'),
];

/// The command of a Greek letter.
pub fn greek(c: char) -> String {
    if let Some((_, command)) = GREEK.iter().find(|(letter, _)| *letter == c) {
        return (*command).to_owned();
    }
    match LATIN_LOOKING.iter().find(|(letter, _)| *letter == c) {
        Some((_, latin)) => format!("\\mathrm{{{latin}}}"),
        None => format!("\\text{{{c}}}"),
    }
}

fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '\\' => out.push_str("\\textbackslash "),
            '^' | '~' => out.push_str(&format!("\\{c}{{}}")),
            '{' | '}' | '$' | '&' | '#' | '%' | '_' => {
                out.push('\\');
                out.push(c);
            }
            _ => out.push(c),
        }
    }
    out
}
