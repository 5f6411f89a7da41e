//! Chapter 2: degrees of freedom, coordinates, what the connections demand.

use super::Work;
use super::pen::{Pen, inline, words};
use super::statement::capital;
use super::wording::Word;
use mechanics::model::Class;
use report::document::Rich;
use report::formula::Layout;
use report::table::Column;
use report::{Cell, Table};
use words::Language;

pub(super) fn write(work: &Work, pen: &mut Pen) {
    if !work.equations.coordinates.is_empty() {
        pen.section(pen.word(Word::Freedoms), |pen| freedoms(work, pen));
        pen.section(pen.word(Word::Conditions), |pen| conditions(work, pen));
    }
    for results in work.results_of(Word::Kinematics) {
        let heading = work.text(&results.heading);
        pen.section(heading, |pen| pen.take(results.below(&work.view()), heading));
    }
}

/// "two degrees of freedom".
fn degrees(n: usize, language: Language) -> String {
    const EN: [&str; 11] = ["no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"];
    const RU: [&str; 11] = ["ноль", "одну", "две", "три", "четыре", "пять", "шесть", "семь", "восемь", "девять", "десять"];
    let number = language.pick(EN, RU).get(n).map_or_else(|| n.to_string(), |word| (*word).to_owned());
    let noun = match (language, n % 10, n % 100) {
        (Language::En, ..) => {
            if n == 1 {
                "degree of freedom"
            } else {
                "degrees of freedom"
            }
        }
        (Language::Ru, 1, tens) if tens != 11 => "степень свободы",
        (Language::Ru, 2..=4, tens) if !(12..=14).contains(&tens) => "степени свободы",
        _ => "степеней свободы",
    };
    format!("{number} {noun}")
}

fn freedoms(work: &Work, pen: &mut Pen) {
    let (n, free) = (work.equations.coordinates.len(), work.equations.degrees_of_freedom());
    let tied = n.saturating_sub(free);
    let degrees = degrees(free, work.language);
    let graph = &work.equations.graph;
    let mut list = Vec::new();
    for (i, coordinate) in work.equations.coordinates.iter().enumerate() {
        list.push(words(if i == 0 { "" } else { ", " }));
        list.push(inline(work.printer.symbol_layout(graph, coordinate.symbols[0])));
    }
    let mut pieces = Vec::new();
    if tied == 0 {
        pieces.push(words(work.language.pick(
            format!("The machine has {degrees}. Generalized coordinates: "),
            format!("Система имеет {degrees}. Обобщённые координаты: "),
        )));
        pieces.extend(list);
        pieces.push(words("."));
    } else {
        pieces.push(words(work.language.pick("The place of the machine is given by ", "Положение механизма определяют координаты ")));
        pieces.extend(list);
        pieces.push(words(work.language.pick(
            format!(" ({n} of them), tied by the equations of the connections ({tied}); the machine has {degrees}."),
            format!(" (всего {n}), подчинённые уравнениям связей (их {tied}); механизм имеет {degrees}. Независимых координат столько же, остальные выражаются через них из уравнений связей."),
        )));
    }
    pen.tell(pieces);
    let caption = if work.model.frames.iter().any(|f| f.is_body) {
        pen.word(Word::Coordinates)
    } else {
        work.language.pick("coordinates", "координаты")
    };
    pen.table(coordinates(work), capital(caption));
}

fn coordinates(work: &Work) -> Table {
    let heads = [Word::Coordinate, Word::What, Word::Start, Word::Rate];
    let mut table = Table::new(heads.map(|w| Column::new(work.language.word(w))).into());
    table.columns[1] = Column::new(work.language.word(report::Word::Description));
    let graph = &work.equations.graph;
    for coordinate in &work.equations.coordinates {
        let value = |e, unit: &str| match super::quantity::number(work, (graph, e)) {
            Some(x) => Cell::Rich(Rich(vec![inline(super::quantity::with_unit(x, unit, work.language))])),
            None => Cell::words("–"),
        };
        let rate = if coordinate.unit == "1" { "1/s".to_owned() } else { format!("{}/s", coordinate.unit) };
        let found = |given: bool, cell: Cell| {
            if given { cell } else { Cell::words(work.language.pick("from the connections", "из уравнений связей")) }
        };
        let tied = work.equations.degrees_of_freedom() < work.equations.coordinates.len();
        table.row(vec![
            Cell::Rich(Rich(vec![inline(work.printer.symbol_layout(graph, coordinate.symbols[0]))])),
            Cell::words(work.text(&coordinate.label)),
            found(coordinate.given[0] || !tied, value(coordinate.start, &coordinate.unit)),
            found(coordinate.given[1] || !tied, value(coordinate.rate, &rate)),
        ]);
    }
    table
}

fn conditions(work: &Work, pen: &mut Pen) {
    let conditions = crate::document::conditions(work.equations, &work.printer);
    if conditions.is_empty() {
        return;
    }
    for (layout, when) in conditions.into_iter().zip(crate::document::holding(work.equations, work.language)) {
        if let Some(words) = when {
            pen.say(format!("{}:", capital(&words)));
        }
        pen.numbered(work.printer.block(layout));
    }
    definitions(work, pen);
}

/// "where" with the formulas of named quantities.
pub(super) fn definitions(work: &Work, pen: &mut Pen) {
    let constant = |s| work.model.parameters.iter().any(|p| p.symbol == s && p.class == Class::Constant);
    let named = crate::document::named_definitions(work.equations, &work.printer);
    // constants stand among the data
    let definitions: Vec<Layout> = named.into_iter().filter(|(s, _)| !constant(*s)).map(|(_, layout)| layout).collect();
    if definitions.is_empty() || std::mem::replace(&mut pen.defined, true) {
        return;
    }
    pen.say(pen.word(Word::Where));
    definitions.into_iter().for_each(|layout| pen.formula(work.printer.block(layout)));
}
