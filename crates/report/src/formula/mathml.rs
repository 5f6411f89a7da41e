//! MathML Core.
//!
//! Dots are an `mover` over the letter inside `msub`, so that they sit on the letter and not on letter and subscript together.
//! Nothing relies on `mathvariant` but its value `normal`, the only one browsers honour.

use super::layout::{Bare, Bracket, Identifier, Layout, Placement, Row, Shape, Sign};
use super::pieces::{Joint, Lines, Piece};
use crate::escape::xml;

/// Space around a named function, as TeX sets it.
const THIN: &str = "<mspace width=\"0.167em\"/>";

const HAIR: &str = "<mspace width=\"0.1em\"/>";

/// The whole formula as a `<math>` element; several lines become a table.
pub(super) fn lines(lines: &Lines, placement: Placement) -> String {
    let mut out = String::from(match placement {
        Placement::Block => "<math display=\"block\">",
        Placement::Inline => "<math>",
    });
    match &lines.rows[..] {
        [row] => row_pieces(row, &mut out),
        rows => table(rows, lines.relation(), &mut out),
    }
    out.push_str("</math>");
    out
}

fn table(rows: &[Vec<Piece>], relation: Option<usize>, out: &mut String) {
    const LEFT: &str = "<mtd style=\"text-align:left;padding-left:0;padding-right:0\">";
    const RIGHT: &str = "<mtd style=\"text-align:right;padding-left:0;padding-right:0\">";
    out.push_str("<mtable displaystyle=\"true\">");
    for (i, row) in rows.iter().enumerate() {
        let (head, tail) = match (i, relation) {
            (0, Some(k)) => row.split_at(k),
            _ => row.split_at(0),
        };
        out.push_str("<mtr>");
        if relation.is_some() {
            element(out, RIGHT, "mtd", |out| row_pieces(head, out));
        }
        element(out, LEFT, "mtd", |out| {
            if i > 0 {
                out.push_str("<mspace width=\"2em\"/>");
            }
            row_pieces(tail, out);
            if let Some(next) = rows.get(i + 1).and_then(|r| r.first()) {
                joint(next, out);
            }
        });
        out.push_str("</mtr>");
    }
    out.push_str("</mtable>");
}

fn row_pieces(row: &[Piece], out: &mut String) {
    out.push_str("<mrow>");
    for piece in row {
        joint(piece, out);
        if piece.minus {
            prefix_minus(out);
        }
        write(piece.body, out);
    }
    out.push_str("</mrow>");
}

/// A binary sign or relation. The form is stated: at the end of a line it would otherwise be taken for a postfix without space.
fn joint(piece: &Piece, out: &mut String) {
    match piece.joint {
        Joint::Start => {}
        Joint::Sign(sign) => infix(sign.character(), out),
        Joint::Relation(relation) => infix(relation.character(), out),
    }
}

fn infix(c: char, out: &mut String) {
    out.push_str("<mo form=\"infix\">");
    out.push_str(&xml(&c.to_string()));
    out.push_str("</mo>");
}

fn prefix_minus(out: &mut String) {
    out.push_str("<mo form=\"prefix\">−</mo>");
}

/// `open` content `</name>`.
fn element(out: &mut String, open: &str, name: &str, content: impl FnOnce(&mut String)) {
    out.push_str(open);
    content(out);
    out.push_str("</");
    out.push_str(name);
    out.push('>');
}

/// The layout as exactly one element.
fn write(layout: &Layout, out: &mut String) {
    match layout {
        Layout::Number { mantissa, exponent } => number(mantissa, *exponent, out),
        Layout::Symbol(identifier) => symbol(identifier, None, out),
        Layout::Words(words) => self::words(words, out),
        Layout::Row(items) => element(out, "<mrow>", "mrow", |out| items.iter().for_each(|item| write(item, out))),
        Layout::Sum(terms) => sum(terms, out),
        Layout::Product(factors) => element(out, "<mrow>", "mrow", |out| product(factors, out)),
        Layout::Fraction(above, below) => element(out, "<mfrac>", "mfrac", |out| {
            write(above, out);
            write(below, out);
        }),
        Layout::Power(base, exponent) => match &**base {
            Layout::Symbol(identifier) => symbol(identifier, Some(exponent), out),
            _ => element(out, "<msup>", "msup", |out| {
                write(base, out);
                write(exponent, out);
            }),
        },
        Layout::Exponential(argument) => element(out, "<msup>", "msup", |out| {
            out.push_str("<mi mathvariant=\"normal\">e</mi>");
            write(argument, out);
        }),
        Layout::Root { degree: 2, radicand } => element(out, "<msqrt>", "msqrt", |out| write(radicand, out)),
        Layout::Root { degree, radicand } => element(out, "<mroot>", "mroot", |out| {
            write(radicand, out);
            out.push_str(&format!("<mn>{degree}</mn>"));
        }),
        Layout::Fence(Bracket::Round, inner) => fence("(", inner, ")", out),
        Layout::Fence(Bracket::Bar, inner) => fence("|", inner, "|", out),
        Layout::Call { name, power, argument, bare } => call(name, power.as_deref(), argument, *bare, out),
        Layout::List(items, mark) => element(out, "<mrow>", "mrow", |out| {
            for (i, item) in items.iter().enumerate() {
                if i > 0 {
                    out.push_str(&format!("<mo separator=\"true\">{mark}</mo>"));
                }
                write(item, out);
            }
        }),
        Layout::Related(left, relation, right) => element(out, "<mrow>", "mrow", |out| {
            write(left, out);
            infix(relation.character(), out);
            write(right, out);
        }),
        Layout::Cases(rows) => cases(rows, out),
    }
}

fn number(mantissa: &str, exponent: Option<i32>, out: &mut String) {
    let Some(n) = exponent else {
        out.push_str(&format!("<mn>{mantissa}</mn>"));
        return;
    };
    out.push_str("<mrow>");
    if mantissa != "1" {
        out.push_str(&format!("<mn>{mantissa}</mn><mo>·</mo>"));
    }
    let digits = n.to_string().replace('-', "−");
    out.push_str(&format!("<msup><mn>10</mn><mn>{digits}</mn></msup></mrow>"));
}

fn words(words: &str, out: &mut String) {
    match words {
        " " => out.push_str(THIN),
        "∂" | "d" | "…" => out.push_str(&format!("<mi mathvariant=\"normal\">{words}</mi>")),
        // white space at the ends of a text element is dropped by browsers
        other => element(out, "<mtext>", "mtext", |out| out.push_str(&xml(&other.replace(' ', "\u{a0}")))),
    }
}

fn sum(terms: &[(Sign, Layout)], out: &mut String) {
    element(out, "<mrow>", "mrow", |out| {
        for (i, (sign, body)) in terms.iter().enumerate() {
            match (i, sign) {
                (0, Sign::Plus) => {}
                (0, Sign::Minus) => prefix_minus(out),
                _ => infix(sign.character(), out),
            }
            write(body, out);
        }
    });
}

/// Factors side by side, a dot between numbers, thin space beside named functions, a hair after a subscript: without it `M_r e`
/// looks like a subscript of two letters.
fn product(factors: &[Layout], out: &mut String) {
    for (i, factor) in factors.iter().enumerate() {
        if i > 0 {
            if factor.starts_with_digit() {
                out.push_str("<mo>·</mo>");
            } else {
                out.push_str("<mo>\u{2062}</mo>");
                let after_call = matches!(&factors[i - 1], Layout::Call { bare, .. } if *bare != Bare::Never);
                if matches!(factor, Layout::Call { .. } | Layout::Cases(_)) || after_call {
                    out.push_str(THIN);
                } else if matches!(&factors[i - 1], Layout::Symbol(s) if !s.subscript.is_empty()) {
                    out.push_str(HAIR);
                }
            }
        }
        write(factor, out);
    }
}

/// Brackets grow only around what is tall: `(l₀ − λ x)²` keeps them at the size of the line.
fn fence(open: &str, inner: &Layout, close: &str, out: &mut String) {
    let stretchy = match (open, inner.is_tall()) {
        ("|", _) => " minsize=\"1.1em\"",
        (_, true) => "",
        (_, false) => " stretchy=\"false\"",
    };
    element(out, "<mrow>", "mrow", |out| {
        out.push_str(&format!("<mo form=\"prefix\"{stretchy}>{open}</mo>"));
        write(inner, out);
        out.push_str(&format!("<mo form=\"postfix\"{stretchy}>{close}</mo>"));
    });
}

fn call(name: &str, power: Option<&str>, argument: &Layout, bare: Bare, out: &mut String) {
    element(out, "<mrow>", "mrow", |out| {
        match power {
            None => out.push_str(&format!("<mi>{name}</mi>")),
            Some(power) => out.push_str(&format!("<msup><mi>{name}</mi><mn>{power}</mn></msup>")),
        }
        out.push_str("<mo>\u{2061}</mo>");
        if bare == Bare::Never {
            fence("(", argument, ")", out);
        } else {
            out.push_str(THIN);
            write(argument, out);
        }
    });
}

fn cases(rows: &[Row], out: &mut String) {
    const CELL: &str = "<mtd style=\"text-align:left\">";
    element(out, "<mrow>", "mrow", |out| {
        out.push_str("<mo form=\"prefix\" stretchy=\"true\">{</mo><mtable>");
        for (i, row) in rows.iter().enumerate() {
            let end = if i + 1 < rows.len() { ";" } else { "" };
            out.push_str("<mtr>");
            element(out, CELL, "mtd", |out| {
                write(&row.value, out);
                out.push_str("<mtext>,</mtext>");
            });
            element(out, CELL, "mtd", |out| {
                write(&row.condition, out);
                if !end.is_empty() {
                    out.push_str(&format!("<mtext>{end}</mtext>"));
                }
            });
            out.push_str("</mtr>");
        }
        out.push_str("</mtable>");
    });
}

fn symbol(identifier: &Identifier, exponent: Option<&Layout>, out: &mut String) {
    let scripted = (!identifier.subscript.is_empty(), exponent.is_some() || identifier.raised_primes() > 0);
    let tag = match scripted {
        (false, false) => None,
        (true, false) => Some("msub"),
        (false, true) => Some("msup"),
        (true, true) => Some("msubsup"),
    };
    if let Some(tag) = tag {
        out.push_str(&format!("<{tag}>"));
    }
    dotted(identifier, out);
    if scripted.0 {
        element(out, "<mrow>", "mrow", |out| identifier.subscript.iter().for_each(|i| index(&i.text, i.shape, out)));
    }
    if scripted.1 {
        element(out, "<mrow>", "mrow", |out| {
            if identifier.raised_primes() > 0 {
                out.push_str(&format!("<mo>{}</mo>", "′".repeat(identifier.raised_primes())));
            }
            if let Some(exponent) = exponent {
                write(exponent, out);
            }
        });
    }
    if let Some(tag) = tag {
        out.push_str(&format!("</{tag}>"));
    }
}

/// The letter with up to three dots above.
fn dotted(identifier: &Identifier, out: &mut String) {
    let dots = match identifier.dots() {
        1 => "˙",
        2 => "¨",
        3 => "…",
        _ => return letter(&identifier.base, identifier.shape, out),
    };
    // three dots are an ellipsis: the combining character sits beside the letter in several fonts
    element(out, "<mover accent=\"true\">", "mover", |out| {
        letter(&identifier.base, identifier.shape, out);
        out.push_str(&format!("<mo stretchy=\"false\">{dots}</mo>"));
    });
}

fn letter(text: &str, shape: Shape, out: &mut String) {
    let single = text.chars().count() == 1;
    let open = if single && shape == Shape::Upright { "<mi mathvariant=\"normal\">" } else { "<mi>" };
    element(out, open, "mi", |out| out.push_str(&xml(text)));
}

fn index(text: &str, shape: Shape, out: &mut String) {
    if text == "," {
        out.push_str("<mo separator=\"true\" lspace=\"0\" rspace=\"0\">,</mo>");
    } else if text.chars().all(|c| c.is_ascii_digit()) {
        out.push_str(&format!("<mn>{text}</mn>"));
    } else {
        letter(text, shape, out);
    }
}
