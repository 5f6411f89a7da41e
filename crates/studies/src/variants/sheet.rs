//! What students and teachers read: a task, its solution, the key, a report on what was handed in, the table of a class.

use super::grade::{Graded, Verdict};
use super::key::{Entry, Key};
use crate::Finds;
use crate::calculation::Calculation;
use crate::machine::Machine;
use crate::provenance::VERSION;
use crate::source::Source;
use mechanics::Model;
use mechanics::model::{AnswerDecl, Class as Dependence, CoordinateDecl, ParameterDecl, ParameterValue};
use mechanics::units::parse_number_or_quantity;
use report::table::Column;
use report::{Block, Cell, Document, Table};
use words::{Language, Text};

/// Digits of data and answers.
const DIGITS: usize = 5;

/// The line that says whose sheet it is.
fn whose(entry: &Entry, language: Language) -> Block {
    let mut words = Vec::new();
    if !entry.student.is_empty() {
        words.push(format!("{}: {}", language.pick("Student", "Студент"), entry.student));
    }
    if let Some(group) = entry.member.given.group {
        words.push(format!("{} {group}", language.pick("group", "группа")));
    }
    words.push(format!("{} {}", language.pick("variant", "вариант"), entry.member.name));
    Block::paragraph(words.join(", "))
}

/// A document about a variant; the hash is that of the model with its values.
fn document(model: &Model, (source, entry): (&Source, &Entry), blocks: Vec<Block>, language: Language) -> Document {
    Document {
        language,
        title: language.text(&model.title).to_owned(),
        description: String::new(),
        blocks,
        version: VERSION.into(),
        model_hash: source.hash(&entry.member.overrides),
    }
}

/// The task: description, data, what the machine is made of with the laws of its loads, questions. Without a machine it says why there is none.
pub fn task(model: &Model, calculation: Option<&Calculation>, (source, entry): (&Source, &Entry), language: Language) -> Document {
    let mut blocks = vec![whose(entry, language)];
    let given = language.text(&model.description);
    blocks.push(Block::heading(1, language.pick("Given", "Дано")));
    if !given.is_empty() {
        blocks.push(Block::paragraph(given));
    }
    match calculation {
        Some(calculation) if entry.failure.is_empty() => {
            blocks.extend(crate::scheme::figure(&calculation.machine, language));
            blocks.push(Block::Table(data(&calculation.machine, language)));
            blocks.extend(crate::written::given(calculation, language));
            blocks.push(Block::heading(1, language.pick("To be found", "Требуется определить")));
            blocks.push(Block::Table(questions(&model.answers, language)));
        }
        _ => blocks.extend(failed(entry, language)),
    }
    document(model, (source, entry), blocks, language)
}

fn failed(entry: &Entry, language: Language) -> [Block; 2] {
    let words = language.pick(
        "This variant cannot be given out: ask your teacher for another one.",
        "Этот вариант выдать нельзя: попросите преподавателя назначить другой.",
    );
    [Block::paragraph(words), Block::paragraph(format!("{}: {}", language.pick("Reason", "Причина"), entry.failure))]
}

/// The data as a table.
fn data(machine: &Machine, language: Language) -> Table {
    let heads = [language.pick("quantity", "величина"), language.pick("symbol", "обозначение"), language.pick("value", "значение")];
    let mut table = Table::new(heads.map(Column::new).into()).with_caption(language.pick("Data", "Исходные данные"));
    for Datum { label, symbol, value } in quantities(machine, language) {
        table.row(vec![Cell::words(label), Cell::symbol(symbol), Cell::words(value)]);
    }
    table
}

/// What is given, in a line: the description of the machine and its data.
pub fn given(machine: &Machine, language: Language) -> String {
    let data: Vec<String> = quantities(machine, language)
        .into_iter()
        .map(|d| {
            // φ_1'(0): the primes and the instant are no part of the index
            let (symbol, rest) = d.symbol.split_at(d.symbol.find(['\'', '(']).unwrap_or(d.symbol.len()));
            let symbol = report::symbol::plain(symbol, language);
            if d.label.is_empty() { format!("{symbol}{rest} = {}", d.value) } else { format!("{}: {symbol}{rest} = {}", d.label, d.value) }
        })
        .collect();
    let mut description = language.text(&machine.model.description).trim().to_owned();
    if !description.is_empty() && !description.ends_with(['.', '!', '?']) {
        description.push('.');
    }
    let data = if data.is_empty() { String::new() } else { format!("{}: {}", language.pick("Given", "Дано"), data.join("; ")) };
    [description, data].into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" ")
}

/// A number that students begin with.
struct Datum {
    label: String,
    symbol: String,
    value: String,
}

/// Numbers that students begin with, not what follows from them or is asked for.
fn quantities(machine: &Machine, language: Language) -> Vec<Datum> {
    let model = &machine.model;
    let asked = |p: &ParameterDecl| model.answers.iter().any(|a| a.gives.as_ref() == Some(&p.name)) || model.unknowns.contains(&p.symbol);
    let index = |p: &ParameterDecl| {
        let variants = model.variants.as_ref();
        variants.is_some_and(|v| v.number.as_ref() == Some(&p.name) || v.group_parameter.as_ref() == Some(&p.name))
    };
    let number = |p: &&ParameterDecl| p.class == Dependence::Constant && matches!(p.value, ParameterValue::Number { .. });
    let symbol = |name: &str| model.notation.iter().find(|(n, _)| n == name).map_or_else(|| name.to_owned(), |(_, s)| s.clone());
    let set = |name: &str| machine.origin.overrides.iter().find(|(n, _)| n == name).map(|(_, text)| text.as_str());
    let mut found = Vec::new();
    for p in model.parameters.iter().filter(number).filter(|p| !asked(p) && !index(p)) {
        let written = set(&p.name).unwrap_or(&p.written);
        let value = shown(written, (p.number, &p.unit), language);
        found.push(Datum { label: language.text(&p.label).to_owned(), symbol: symbol(&p.name), value });
    }
    found.extend(gravity(model, language));
    for c in &model.coordinates {
        for (order, words) in [("", ("at the start", "в начальный момент")), ("'", ("rate at the start", "скорость в начальный момент"))]
        {
            let name = format!("{}{order}", c.name);
            if let Some(written) = set(&name).map(str::to_owned).or_else(|| stands(machine, c, order.len())) {
                let label = [language.text(&c.label), language.pick(words.0, words.1)].join(", ");
                let value = shown(&written, (None, &c.units[order.len()]), language);
                let label = label.trim_start_matches(", ").to_owned();
                found.push(Datum { label, symbol: format!("{}{order}(0)", symbol(&c.name)), value });
            }
        }
    }
    found
}

/// The start (0) or the rate at the start (1) that the file gives a motion, as a quantity.
fn stands(machine: &Machine, c: &CoordinateDecl, order: usize) -> Option<String> {
    let model = &machine.model;
    let moves =
        model.studies.iter().any(|s| matches!(machine.origin.studies.finds(s.kind), Finds::Motion | Finds::ClosedForm | Finds::Points));
    // what is not given is zero where no connection decides it
    let decided = c.given[order] || (machine.equations.conditions.is_empty() && !c.guessed[order]);
    if !moves || !decided {
        return None;
    }
    let of = |s| model.parameters.iter().find(|p| p.symbol == s).and_then(|p| p.number).unwrap_or(f64::NAN);
    let value = model.graph.evaluate(&[[c.start, c.rate][order]], &of)[0];
    let unit = if c.units[order] == "1" { "" } else { &c.units[order] };
    value.is_finite().then(|| if value == 0.0 { format!("0 {unit}") } else { format!("{value} {unit}") })
}

/// The acceleration of gravity where it acts and no parameter gives it.
fn gravity(model: &Model, language: Language) -> Option<Datum> {
    let vector = model.gravity?;
    if model.parameters.iter().any(|p| p.name == "g") || !model.graph.symbols_in(&vector).is_empty() {
        return None;
    }
    let parts = model.graph.evaluate(&vector, &|_| f64::NAN);
    let size = parts.iter().map(|x| x * x).sum::<f64>().sqrt();
    let label = language.pick("acceleration of gravity", "ускорение свободного падения").to_owned();
    let value = report::number::with_unit(&report::number::short(size, DIGITS, language), &report::unit::print("m/s^2", language));
    (size > 0.0).then(|| Datum { label, symbol: "g".into(), value })
}

/// A value as it is written, where a person wrote it; a computed one with five digits.
fn shown(written: &str, (number, unit): (Option<f64>, &str), language: Language) -> String {
    let spaced = |number: String, unit: &str| report::number::with_unit(&number, &report::unit::print(unit, language));
    if let Ok(quantity) = parse_number_or_quantity(written) {
        let own = written.trim_start_matches(|c: char| c.is_ascii_digit() || "+-−.,eE \u{a0}".contains(c));
        return spaced(report::number::short(quantity.number.to_f64(), DIGITS, language), own.trim());
    }
    number.map_or_else(|| written.to_owned(), |x| spaced(report::number::short(x, DIGITS, language), if unit == "1" { "" } else { unit }))
}

/// The questions, with room for the answers.
fn questions(answers: &[AnswerDecl], language: Language) -> Table {
    let heads = [
        "№",
        language.pick("question", "вопрос"),
        language.pick("name", "имя"),
        language.pick("answer", "ответ"),
        language.pick("unit", "единица"),
    ];
    let mut table = Table::new(heads.map(Column::new).into()).with_caption(language.pick("Questions", "Вопросы"));
    for (i, a) in answers.iter().enumerate() {
        table.row(vec![
            Cell::words((i + 1).to_string()),
            Cell::words(language.text(&a.ask)),
            Cell::words(a.id.clone()),
            Cell::words("\u{a0}".repeat(16)),
            Cell::words(report::unit::print(&a.unit.label, language)),
        ]);
    }
    table
}

/// The solution: whose it is and the right answers before the written calculation.
pub fn solution(mut calculation: Document, model: &Model, (source, entry): (&Source, &Entry), language: Language) -> Document {
    let mut blocks = vec![whose(entry, language)];
    if !model.answers.is_empty() {
        blocks.push(Block::heading(1, language.pick("Answers", "Ответы")));
        blocks.push(Block::Table(right(&model.answers, entry, language)));
    }
    blocks.append(&mut calculation.blocks);
    Document { blocks, model_hash: source.hash(&entry.member.overrides), ..calculation }
}

/// The solution of a variant that has none.
pub fn no_solution(model: &Model, (source, entry): (&Source, &Entry), language: Language) -> Document {
    let blocks = [whose(entry, language)].into_iter().chain(failed(entry, language)).collect();
    document(model, (source, entry), blocks, language)
}

fn right(answers: &[AnswerDecl], entry: &Entry, language: Language) -> Table {
    let heads = [
        language.pick("question", "вопрос"),
        language.pick("name", "имя"),
        language.pick("answer", "ответ"),
        language.pick("unit", "единица"),
    ];
    // the calculation counts its own tables
    let mut table = Table::new(heads.map(Column::new).into());
    for (a, truth) in answers.iter().zip(&entry.truths) {
        let number = truth.map_or(Cell::Empty, |v| Cell::number(v, DIGITS, language));
        let unit = report::unit::print(&a.unit.label, language);
        table.row(vec![Cell::words(language.text(&a.ask)), Cell::words(a.id.clone()), number, Cell::words(unit)]);
    }
    table
}

fn head(a: &AnswerDecl, language: Language) -> Column {
    let unit = report::unit::print(&a.unit.label, language);
    Column::new(if unit.is_empty() { a.id.clone() } else { format!("{}, {unit}", a.id) })
}

fn student_heads(language: Language) -> [Column; 2] {
    [language.pick("student", "студент"), language.pick("variant", "вариант")].map(Column::new)
}

/// The key of a class for its teacher.
pub fn key(key: &Key, model: &Model, language: Language) -> Document {
    let mut table = Table::new(student_heads(language).into_iter().chain(model.answers.iter().map(|a| head(a, language))).collect());
    for e in &key.entries {
        let mut row = vec![Cell::words(e.student.clone()), Cell::words(e.member.name.clone())];
        row.extend(e.truths.iter().map(|t| t.map_or(Cell::Empty, |v| Cell::number(v, DIGITS, language))));
        table.row(row);
    }
    let mut blocks = vec![Block::heading(1, language.pick("Key", "Ключ")), Block::Table(table)];
    for e in key.entries.iter().filter(|e| !e.failure.is_empty()) {
        blocks.push(Block::paragraph(format!("{} {}: {}", language.pick("variant", "вариант"), e.member.name, e.failure)));
    }
    blocks.extend(model.answers.iter().map(|a| Block::paragraph(format!("{} – {}", a.id, language.text(&a.ask)))));
    let title = language.text(&model.title).to_owned();
    Document { language, title, description: String::new(), blocks, version: key.version.clone(), model_hash: key.hash() }
}

/// The report on what a student handed in.
pub fn report(model: &Model, (source, entry): (&Source, &Entry), graded: &[Graded], (remarks, language): (&[Text], Language)) -> Document {
    let counted = graded.iter().filter(|g| g.verdict.counts()).count();
    let mut table = Table::new(
        [
            language.pick("question", "вопрос"),
            language.pick("your answer", "ваш ответ"),
            language.pick("unit", "единица"),
            language.pick("verdict", "оценка"),
            language.pick("remark", "замечание"),
        ]
        .map(Column::new)
        .into(),
    );
    for (a, g) in model.answers.iter().zip(graded) {
        let likeness = g.likeness.as_ref().map(|l| l.words());
        table.row(vec![
            Cell::words(language.text(&a.ask)),
            Cell::words(g.given.clone()),
            Cell::words(report::unit::print(&a.unit.label, language)),
            Cell::words(format!("{} {}", g.verdict.mark(language), language.text(&g.verdict.words()))),
            Cell::words(likeness.as_ref().map_or("", |l| language.text(l))),
        ]);
    }
    let mut blocks = vec![whose(entry, language), Block::Table(table)];
    let of = graded.len();
    blocks.push(Block::paragraph(language.pick(format!("Right: {counted} of {of}."), format!("Верных ответов: {counted} из {of}."))));
    blocks.extend(remarks.iter().map(|r| Block::paragraph(language.text(r))));
    document(model, (source, entry), blocks, language)
}

/// The table of a class for its teacher.
pub fn class(key: &Key, model: &Model, rows: &[(Entry, Option<Vec<Graded>>)], (remarks, language): (&[Text], Language)) -> Document {
    let blocks = class_blocks(model, rows, (remarks, language));
    let title = language.text(&model.title).to_owned();
    Document { language, title, description: String::new(), blocks, version: key.version.clone(), model_hash: key.hash() }
}

/// The same as blocks.
pub fn class_blocks(model: &Model, rows: &[(Entry, Option<Vec<Graded>>)], (remarks, language): (&[Text], Language)) -> Vec<Block> {
    let heads = student_heads(language).into_iter().chain(model.answers.iter().map(|a| Column::new(a.id.clone())));
    let mut table = Table::new(heads.chain([Column::new(language.pick("right", "верно"))]).collect());
    for (entry, graded) in rows {
        let mut row = vec![Cell::words(entry.name().to_owned()), Cell::words(entry.member.name.clone())];
        let mark = |i: usize| graded.as_ref().and_then(|g| g.get(i)).map_or_else(|| "–".to_owned(), |g| g.verdict.mark(language));
        row.extend((0..model.answers.len()).map(|i| Cell::words(mark(i))));
        let counted = graded.as_ref().map(|g| g.iter().filter(|g| g.verdict.counts()).count());
        row.push(Cell::words(counted.map_or_else(|| language.pick("not handed in", "не сдано").to_owned(), |c| c.to_string())));
        table.row(row);
    }
    let mut blocks = vec![Block::Table(table)];
    for (entry, graded) in rows {
        for (a, g) in model.answers.iter().zip(graded.iter().flatten()) {
            if let Some(likeness) = &g.likeness {
                blocks.push(Block::paragraph(format!("{}, {}: {}", entry.name(), a.id, language.text(&likeness.words()))));
            } else if g.verdict == Verdict::Follows {
                blocks.push(Block::paragraph(format!("{}, {}: {}", entry.name(), a.id, language.text(&g.verdict.words()))));
            }
        }
    }
    blocks.extend(remarks.iter().map(|r| Block::paragraph(language.text(r))));
    blocks
}
