//! Office MathML, the formulas of Word: ECMA-376 part 1, chapter 22.1. Word breaks long formulas itself, at their signs.

use super::layout::{Bare, Bracket, Identifier, Layout, Placement, Row, Shape, Sign};
use super::pieces::{Joint, Lines};
use crate::escape::markup;

/// The whole formula as `<m:oMath>`, in a paragraph of its own as `<m:oMathPara>`.
pub(super) fn lines(lines: &Lines, placement: Placement) -> String {
    let mut out = String::from("<m:oMath>");
    for piece in lines.rows.iter().flatten() {
        match piece.joint {
            Joint::Start => {}
            Joint::Sign(sign) => upright(&sign.character().to_string(), &mut out),
            Joint::Relation(relation) => upright(&relation.character().to_string(), &mut out),
        }
        if piece.minus {
            upright("−", &mut out);
        }
        write(piece.body, &mut out);
    }
    out.push_str("</m:oMath>");
    match placement {
        Placement::Block => format!("<m:oMathPara>{out}</m:oMathPara>"),
        Placement::Inline => out,
    }
}

/// Text in a style of its own.
fn run(text: &str, style: &str, out: &mut String) {
    let style = if style.is_empty() { String::new() } else { format!("<m:rPr><m:sty m:val=\"{style}\"/></m:rPr>") };
    const FONT: &str = "<w:rPr><w:rFonts w:ascii=\"Cambria Math\" w:hAnsi=\"Cambria Math\"/></w:rPr>";
    out.push_str(&format!("<m:r>{style}{FONT}<m:t xml:space=\"preserve\">{}</m:t></m:r>", markup(text)));
}

fn upright(text: &str, out: &mut String) {
    run(text, "p", out);
}

fn italic(text: &str, out: &mut String) {
    run(text, "i", out);
}

fn letter(text: &str, shape: Shape, out: &mut String) {
    match shape {
        Shape::Italic => italic(text, out),
        Shape::Upright => upright(text, out),
    }
}

/// `<m:name>` content `</m:name>`.
fn element(name: &str, out: &mut String, content: impl FnOnce(&mut String)) {
    out.push_str(&format!("<m:{name}>"));
    content(out);
    out.push_str(&format!("</m:{name}>"));
}

fn write(layout: &Layout, out: &mut String) {
    match layout {
        Layout::Number { mantissa, exponent } => number(mantissa, *exponent, out),
        Layout::Symbol(identifier) => symbol(identifier, None, out),
        Layout::Words(words) => upright(words, out),
        Layout::Row(items) => items.iter().for_each(|item| write(item, out)),
        Layout::Sum(terms) => sum(terms, out),
        Layout::Product(factors) => product(factors, out),
        Layout::Fraction(above, below) => element("f", out, |out| {
            element("num", out, |out| write(above, out));
            element("den", out, |out| write(below, out));
        }),
        Layout::Power(base, exponent) => match &**base {
            Layout::Symbol(identifier) => symbol(identifier, Some(exponent), out),
            _ => raised(|out| write(base, out), |out| write(exponent, out), out),
        },
        Layout::Exponential(argument) => raised(|out| upright("e", out), |out| write(argument, out), out),
        Layout::Root { degree, radicand } => element("rad", out, |out| {
            if *degree == 2 {
                out.push_str("<m:radPr><m:degHide m:val=\"1\"/></m:radPr><m:deg/>");
            } else {
                element("deg", out, |out| upright(&degree.to_string(), out));
            }
            element("e", out, |out| write(radicand, out));
        }),
        Layout::Fence(bracket, inner) => fence(*bracket, inner, out),
        Layout::Call { name, power, argument, bare } => call((name, power.as_deref()), argument, *bare, out),
        Layout::List(items, mark) => {
            for (i, item) in items.iter().enumerate() {
                if i > 0 {
                    upright(&format!("{mark} "), out);
                }
                write(item, out);
            }
        }
        Layout::Related(left, relation, right) => {
            write(left, out);
            upright(&relation.character().to_string(), out);
            write(right, out);
        }
        Layout::Cases(rows) => cases(rows, out),
    }
}

fn raised(base: impl FnOnce(&mut String), exponent: impl FnOnce(&mut String), out: &mut String) {
    element("sSup", out, |out| {
        element("e", out, base);
        element("sup", out, exponent);
    });
}

fn number(mantissa: &str, exponent: Option<i32>, out: &mut String) {
    let Some(n) = exponent else { return upright(mantissa, out) };
    if mantissa != "1" {
        upright(&format!("{mantissa}·"), out);
    }
    raised(|out| upright("10", out), |out| upright(&n.to_string().replace('-', "−"), out), out);
}

fn sum(terms: &[(Sign, Layout)], out: &mut String) {
    for (i, (sign, body)) in terms.iter().enumerate() {
        if i > 0 || *sign == Sign::Minus {
            upright(&sign.character().to_string(), out);
        }
        write(body, out);
    }
}

/// Factors side by side, a dot between numbers, a thin space beside named functions.
fn product(factors: &[Layout], out: &mut String) {
    for (i, factor) in factors.iter().enumerate() {
        let before = i.checked_sub(1).map(|k| &factors[k]);
        match before {
            None => {}
            Some(_) if factor.starts_with_digit() => upright("·", out),
            Some(Layout::Call { .. }) => upright("\u{2009}", out),
            Some(_) if matches!(factor, Layout::Cases(_)) => upright("\u{2009}", out),
            Some(_) => {}
        }
        write(factor, out);
    }
}

fn fence(bracket: Bracket, inner: &Layout, out: &mut String) {
    let [open, close] = match bracket {
        Bracket::Round => ["(", ")"],
        Bracket::Bar => ["|", "|"],
    };
    bracketed([open, close], |out| element("e", out, |out| write(inner, out)), out);
}

fn bracketed([open, close]: [&str; 2], inner: impl FnOnce(&mut String), out: &mut String) {
    out.push_str(&format!("<m:d><m:dPr><m:begChr m:val=\"{open}\"/><m:endChr m:val=\"{close}\"/></m:dPr>"));
    inner(out);
    out.push_str("</m:d>");
}

fn call((name, power): (&str, Option<&str>), argument: &Layout, bare: Bare, out: &mut String) {
    element("func", out, |out| {
        element("fName", out, |out| match power {
            None => upright(name, out),
            Some(power) => raised(|out| upright(name, out), |out| upright(power, out), out),
        });
        element("e", out, |out| if bare == Bare::Never { fence(Bracket::Round, argument, out) } else { write(argument, out) });
    });
}

fn cases(rows: &[Row], out: &mut String) {
    const COLUMNS: &str = "<m:mPr><m:mcs><m:mc><m:mcPr><m:count m:val=\"2\"/><m:mcJc m:val=\"left\"/></m:mcPr></m:mc></m:mcs></m:mPr>";
    let table = |out: &mut String| {
        out.push_str(COLUMNS);
        for (i, row) in rows.iter().enumerate() {
            element("mr", out, |out| {
                element("e", out, |out| {
                    write(&row.value, out);
                    upright(",", out);
                });
                element("e", out, |out| {
                    write(&row.condition, out);
                    if i + 1 < rows.len() {
                        upright(";", out);
                    }
                });
            });
        }
    };
    bracketed(["{", ""], |out| element("e", out, |out| element("m", out, table)), out);
}

fn symbol(identifier: &Identifier, exponent: Option<&Layout>, out: &mut String) {
    let base = |out: &mut String| dotted(identifier, out);
    let index = |out: &mut String| identifier.subscript.iter().for_each(|i| letter(&i.text, i.shape, out));
    let above = |out: &mut String| {
        if identifier.raised_primes() > 0 {
            upright(&"′".repeat(identifier.raised_primes()), out);
        }
        if let Some(exponent) = exponent {
            write(exponent, out);
        }
    };
    match (!identifier.subscript.is_empty(), exponent.is_some() || identifier.raised_primes() > 0) {
        (false, false) => base(out),
        (false, true) => raised(base, above, out),
        (true, false) => element("sSub", out, |out| {
            element("e", out, base);
            element("sub", out, index);
        }),
        (true, true) => element("sSubSup", out, |out| {
            element("e", out, base);
            element("sub", out, index);
            element("sup", out, above);
        }),
    }
}

/// The letter with up to three dots above.
fn dotted(identifier: &Identifier, out: &mut String) {
    let dots = match identifier.dots() {
        1 => '\u{307}',
        2 => '\u{308}',
        3 => '\u{20db}',
        _ => return letter(&identifier.base, identifier.shape, out),
    };
    out.push_str(&format!("<m:acc><m:accPr><m:chr m:val=\"{dots}\"/></m:accPr>"));
    element("e", out, |out| letter(&identifier.base, identifier.shape, out));
    out.push_str("</m:acc>");
}
