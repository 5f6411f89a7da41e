//! Formats for print: whatever a user writes into a file, the page stays well formed.

use proptest::prelude::*;
use report::document::{Content, Formula, Inline, Rich};
use report::formats::{Page, Sheet, TABLE, find};
use report::formula::{Layout, Printer};
use report::table::Verdict;
use report::{Block, Cell, Document, Download, Table, table};
use words::Language;

/// A document with a text of the user at every place where one may stand.
fn document(text: &str, language: Language) -> Document {
    let mut cells = Table::new(vec![table::Column::new(text), table::Column::with_unit(text, "m", language)]).with_caption(text);
    cells.row(vec![Cell::symbol(text), Cell::Number("12,5".into())]);
    cells.row(vec![Cell::words(text), Cell::Verdict(Verdict::Failed)]);
    let formula =
        Printer::new(language).block(Layout::Row(vec![Layout::Words(text.into()), Layout::Symbol(Printer::new(language).named(text))]));
    let blocks = vec![
        Block::heading(1, text),
        Block::Paragraph(Rich(vec![Inline::Words(text.into()), Inline::Symbol(text.into()), Inline::Words("1".into())])),
        Block::Equation { formula: formula.clone(), numbered: true },
        Block::Details {
            summary: text.into(),
            blocks: vec![Block::Equation { formula: Formula::inline(formula.layout), numbered: false }],
        },
        Block::Table(cells),
        Block::Downloads(vec![Download { name: text.into(), label: text.into(), content: Content::Beside }]),
    ];
    Document { language, title: text.into(), description: text.into(), blocks, version: text.into(), model_hash: text.into() }
}

fn written(name: &str, text: &str) -> String {
    let page: Page = find(name).and_then(|format| format.page()).unwrap_or_else(|| panic!("{name}"));
    (page.write)(&document(text, Language::Ru), &Sheet::default())
}

/// Braces without those behind a backslash; environments; dollars.
fn latex_is_sound(text: &str) -> Result<(), String> {
    let (mut depth, mut dollars, mut before) = (0_i32, 0, ' ');
    let body = text.split("\\begin{document}").nth(1).ok_or("no document")?;
    for c in body.chars() {
        match c {
            '{' if before != '\\' => depth += 1,
            '}' if before != '\\' => depth -= 1,
            '$' if before != '\\' => dollars += 1,
            '%' | '#' if before != '\\' => return Err(format!("a bare {c}")),
            _ => {}
        }
        before = if before == '\\' && c == '\\' { ' ' } else { c };
        if depth < 0 {
            return Err("a brace too many is closed".into());
        }
    }
    let mut open = Vec::new();
    for (i, _) in text.match_indices("\\begin{").chain(text.match_indices("\\end{")).collect::<std::collections::BTreeMap<_, _>>() {
        let name = text[i..].split(['{', '}']).nth(1).unwrap_or_default();
        match text[i..].starts_with("\\begin") {
            true => open.push(name),
            false if open.pop() != Some(name) => return Err(format!("{name} is closed and was not open")),
            false => {}
        }
    }
    if depth == 0 && dollars % 2 == 0 && open.is_empty() {
        Ok(())
    } else {
        Err(format!("braces {depth}, dollars {dollars}, open {open:?}"))
    }
}

/// Brackets outside of strings and escapes; dollars; strings that end.
fn typst_is_sound(text: &str) -> Result<(), String> {
    let (mut open, mut dollars, mut string, mut escaped) = (Vec::new(), 0, false, false);
    let body: String = text.lines().filter(|l| !l.starts_with("//")).collect::<Vec<_>>().join("\n");
    for c in body.chars() {
        if std::mem::take(&mut escaped) {
            continue;
        }
        match c {
            '\\' => escaped = true,
            '"' => string = !string,
            _ if string => {}
            '$' => dollars += 1,
            // round brackets may be words
            '[' | '{' => open.push(c),
            ']' | '}' if open.pop() != Some(if c == ']' { '[' } else { '{' }) => return Err(format!("{c} closes nothing")),
            _ => {}
        }
    }
    if dollars % 2 == 0 && !string && open.is_empty() { Ok(()) } else { Err(format!("dollars {dollars}, a string is open: {string}")) }
}

/// How often a mark stands without a backslash that takes its meaning.
fn bare(text: &str, mark: char) -> usize {
    let is_bare = |i: usize| (i - text[..i].trim_end_matches('\\').len()).is_multiple_of(2);
    text.match_indices(mark).filter(|(i, _)| is_bare(*i)).count()
}

/// Rows of tables with equal numbers of cells; dollars.
fn markdown_is_sound(text: &str) -> Result<(), String> {
    let bars = |line: &str| bare(line, '|');
    let mut before = None;
    for line in text.lines() {
        let now = line.starts_with('|').then(|| bars(line));
        if let (Some(a), Some(b)) = (before, now)
            && a != b
        {
            return Err(format!("a row with {b} bars behind one with {a}: {line}"));
        }
        before = now;
    }
    let dollars = bare(text, '$');
    if dollars.is_multiple_of(2) { Ok(()) } else { Err(format!("{dollars} dollars")) }
}

fn sound(name: &str, text: &str) -> Result<(), String> {
    match name {
        "latex" => latex_is_sound(text),
        "typst" => typst_is_sound(text),
        "markdown" => markdown_is_sound(text),
        _ => Ok(()),
    }
}

const HOSTILE: &str = "$ % & # _ { } ~ ^ \\ < > \" @ * ` ' | [ ] -- /* // 1. = + маятник φ₁ é 中 \u{307} \u{200b} \n \\end{document}";

#[test]
fn hostile_words_are_mere_words() {
    for format in TABLE.iter().filter(|format| format.page().is_some()) {
        sound(format.name, &written(format.name, HOSTILE)).unwrap_or_else(|e| panic!("{}: {e}", format.name));
    }
    let latex = written("latex", HOSTILE);
    assert_eq!(latex.matches("\\end{document}").count(), 1, "the user's own is words");
}

#[test]
fn a_decimal_comma_is_no_list() {
    let number = Layout::Number { mantissa: "12,5".into(), exponent: Some(-3) };
    let formula = Formula::inline(Layout::Root { degree: 2, radicand: Box::new(number) });
    assert_eq!(formula.write(report::formula::Form::Latex), "\\sqrt{12{,}5 \\cdot 10^{-3}}");
    assert_eq!(formula.write(report::formula::Form::Typst), "sqrt(\"12,5\" dot.op 10^(-3))");
}

#[test]
fn unsound_pages_are_seen() {
    for (name, text) in [
        ("latex", "\\begin{document}{\\end{document}"),
        ("latex", "\\begin{document}$\\end{document}"),
        ("latex", "\\begin{document}\\begin{center}\\end{document}"),
        ("typst", "#text[a"),
        ("typst", "#image(\"a)"),
        ("markdown", "| a | b |\n| --- |"),
        ("markdown", "$x"),
    ] {
        assert!(sound(name, text).is_err(), "{name}: {text}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]
    #[test]
    fn any_words_leave_pages_sound(text in r#"[$%&#_{}~^\\<>"@*`'|\[\]()=+./ ,;:!?aяφ²0-9\n-]{0,40}"#) {
        for name in ["latex", "typst", "markdown"] {
            let page = written(name, &text);
            prop_assert!(sound(name, &page).is_ok(), "{}: {:?}\n{}", name, sound(name, &page), page);
        }
    }
}
