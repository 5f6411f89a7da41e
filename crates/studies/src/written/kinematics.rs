//! Chapter 2: degrees of freedom, coordinates, what the connections demand.

use super::pen::{Pen, inline, words};
use super::wording::Word;
use super::work::Work;
use mechanics::model::Class;
use report::document::{Inline, Rich};
use report::formula::{Bracket, Layout, Relation, Sign};
use report::table::Column;
use report::{Cell, Table};
use symbolic::{Expr, SymbolId};
use words::Language;
use words::capital;

pub(super) fn write(work: &Work, pen: &mut Pen) {
    if !work.equations.coordinates.is_empty() {
        pen.section(pen.word(Word::Freedoms), |pen| freedoms(work, pen));
        pen.section(pen.word(Word::Conditions), |pen| conditions(work, pen));
        super::centres::write(work, pen);
    }
    for results in work.results_of(Word::Kinematics) {
        let heading = work.text(&results.heading);
        pen.section(heading, |pen| pen.take(super::sentences::below(work, results), heading));
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
        let (en, ru) = if n == 1 {
            ("The generalized coordinate is ", "Обобщённая координата – ")
        } else {
            ("Generalized coordinates: ", "Обобщённые координаты: ")
        };
        pieces.push(words(work.language.pick(format!("The machine has {degrees}. {en}"), format!("Система имеет {degrees}. {ru}"))));
        pieces.extend(list);
        pieces.push(words("."));
    } else {
        pieces.push(words(work.language.pick("The place of the machine is given by ", "Положение механизма определяют координаты ")));
        pieces.extend(list);
        pieces.push(words(work.language.pick(
            format!(" ({n} of them), tied by {tied} equations of the connections; the machine has {degrees}."),
            format!(" (всего {n}), связанные уравнениями связей (их {tied}); механизм имеет {degrees}."),
        )));
        pieces.extend(independent(work, free));
    }
    pen.tell(pieces);
    let caption = if work.model.frames.iter().any(|f| f.is_body) {
        pen.word(Word::Coordinates)
    } else {
        work.language.pick("coordinates", "координаты")
    };
    pen.table(coordinates(work), capital(caption));
}

/// Which coordinate is the generalized one, and that the others depend on it.
fn independent(work: &Work, free: usize) -> Vec<Inline> {
    let leading = super::machine::leading(work).filter(|_| free == 1);
    let Some(leading) = leading else {
        return vec![words(work.language.pick(
            " As many of the coordinates are generalized ones, the others depend on them by the equations of the connections.",
            " Обобщённых координат столько же, остальные – зависимые: они выражаются через них из уравнений связей.",
        ))];
    };
    let symbol = work.printer.symbol_layout(&work.equations.graph, work.equations.coordinates[leading].symbols[0]);
    vec![
        words(work.language.pick(" The generalized coordinate is ", " Обобщённая координата – ")),
        inline(symbol),
        words(work.language.pick(
            "; the others depend on it by the equations of the connections.",
            "; остальные координаты – зависимые, они выражаются через неё из уравнений связей.",
        )),
    ]
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
    let conditions = crate::document::conditions(work.equations, &work.own);
    if conditions.is_empty() {
        return;
    }
    for (layout, when) in conditions.into_iter().zip(crate::document::holding(work.equations, work.language)) {
        if let Some(words) = when {
            pen.say(format!("{}:", capital(&words)));
        }
        pen.numbered(work.printer.block(upright(layout)));
    }
    told_signs(work, pen);
    let formulas: Vec<Expr> = work.equations.conditions.iter().map(|c| c.place.unwrap_or(c.rate)).collect();
    definitions(work, &formulas, pen);
}

/// −a − b = 0 as a + b = 0, and l − (l − s) − x = 0 as s − x = 0.
fn upright(layout: Layout) -> Layout {
    match layout {
        Layout::Related(left, relation, right) => match *left {
            Layout::Sum(terms) => {
                let (opened, kept) = (multiplied(&terms), cancelled(terms));
                let mut terms = if opened.len() < kept.len() { opened } else { kept };
                if terms.iter().all(|(sign, _)| *sign == Sign::Minus) {
                    terms.iter_mut().for_each(|(sign, _)| *sign = Sign::Plus);
                }
                Layout::Related(Box::new(Layout::Sum(terms)), relation, right)
            }
            left => Layout::Related(Box::new(left), relation, right),
        },
        other => other,
    }
}

/// Terms without brackets around sums, and without those that cancel.
fn cancelled(terms: Vec<(Sign, Layout)>) -> Vec<(Sign, Layout)> {
    let mut list: Vec<(Sign, Layout)> = Vec::new();
    for (sign, term) in terms {
        let inner = match term {
            Layout::Fence(Bracket::Round, inner) if matches!(*inner, Layout::Sum(_)) => *inner,
            other => other,
        };
        let parts = if let Layout::Sum(parts) = inner { parts } else { vec![(Sign::Plus, inner)] };
        for (own, part) in parts {
            let sign = if sign == own { Sign::Plus } else { Sign::Minus };
            match list.iter().position(|(s, kept)| *s != sign && *kept == part) {
                Some(at) => drop(list.remove(at)),
                None => list.push((sign, part)),
            }
        }
    }
    begun(list)
}

/// A whole number in front, and what it multiplies.
fn counted(term: Layout) -> (i64, Layout) {
    let whole = |f: &Layout| match f {
        Layout::Number { mantissa, exponent: None } => mantissa.parse::<i64>().ok(),
        _ => None,
    };
    match term {
        Layout::Product(mut factors) if factors.len() > 1 => match whole(&factors[0]) {
            Some(n) => {
                factors.remove(0);
                let rest = if factors.len() == 1 { factors.remove(0) } else { Layout::Product(factors) };
                (n, rest)
            }
            None => (1, Layout::Product(factors)),
        },
        other => (1, other),
    }
}

/// Terms with whole numbers multiplied into the brackets behind them, and like terms as one.
fn multiplied(terms: &[(Sign, Layout)]) -> Vec<(Sign, Layout)> {
    let signed = |sign: Sign, n: i64| if sign == Sign::Minus { -n } else { n };
    let mut list: Vec<(i64, Layout)> = Vec::new();
    for (sign, term) in terms {
        let (n, rest) = counted(term.clone());
        let inner = match rest {
            Layout::Fence(Bracket::Round, inner) if matches!(*inner, Layout::Sum(_)) => *inner,
            other => other,
        };
        let parts = if let Layout::Sum(parts) = inner { parts } else { vec![(Sign::Plus, inner)] };
        for (own, part) in parts {
            let (k, part) = counted(part);
            let k = signed(own, k).saturating_mul(signed(*sign, n));
            match list.iter_mut().find(|(_, kept)| *kept == part) {
                Some((sum, _)) => *sum = sum.saturating_add(k),
                None => list.push((k, part)),
            }
        }
    }
    let shown = |(k, part): (i64, Layout)| {
        let sign = if k < 0 { Sign::Minus } else { Sign::Plus };
        let number = Layout::Number { mantissa: k.unsigned_abs().to_string(), exponent: None };
        let term = match part {
            part if k.abs() == 1 => part,
            Layout::Product(factors) => Layout::Product(std::iter::once(number).chain(factors).collect()),
            part => Layout::Product(vec![number, part]),
        };
        (sign, term)
    };
    begun(list.into_iter().filter(|(k, _)| *k != 0).map(shown).collect())
}

/// A sum that begins with a positive term; 0 without any.
fn begun(mut list: Vec<(Sign, Layout)>) -> Vec<(Sign, Layout)> {
    if list.is_empty() {
        list.push((Sign::Plus, Layout::Number { mantissa: "0".into(), exponent: None }));
    }
    if let Some(at) = list.iter().position(|(sign, _)| *sign == Sign::Plus) {
        list[..=at].rotate_right(1);
    }
    list
}

/// "where" with the formulas of named quantities that stand in these formulas and were not written yet.
pub(super) fn definitions(work: &Work, formulas: &[Expr], pen: &mut Pen) {
    let graph = &work.equations.graph;
    // what a quantity is made of is told with it
    let mut wanted = graph.symbols_in(formulas);
    for definition in work.equations.definitions.iter().rev().filter(|d| d.shown) {
        if wanted.contains(&definition.symbol) {
            wanted.extend(graph.symbols_in(&[definition.formula]));
        }
    }
    told(work, |s| wanted.contains(&s), pen);
}

/// The same with all quantities that are left.
pub(super) fn other_definitions(work: &Work, pen: &mut Pen) {
    told(work, |_| true, pen);
}

fn told(work: &Work, wanted: impl Fn(SymbolId) -> bool, pen: &mut Pen) {
    let constant = |s| work.model.parameters.iter().any(|p| p.symbol == s && p.class == Class::Constant);
    let named = crate::document::named_definitions(work.equations, &work.printer);
    let unit = |s| work.equations.definitions.iter().find(|d| d.symbol == s).map_or("", |d| d.unit.as_str());
    // constants stand among the data
    let new: Vec<(SymbolId, Layout)> = named.into_iter().filter(|(s, _)| !constant(*s) && wanted(*s) && !pen.defined.contains(s)).collect();
    if new.is_empty() {
        return;
    }
    pen.say(pen.word(Word::Where));
    for (symbol, layout) in new {
        pen.defined.push(symbol);
        pen.formula(work.printer.block(super::quantity::cases_with_unit(layout, unit(symbol), work.language)));
    }
}

/// "During all motions 4 − s > 0."
fn told_signs(work: &Work, pen: &mut Pen) {
    let graph = &work.equations.graph;
    let moves = |e| graph.contains(e, |s| work.equations.coordinates.iter().any(|c| c.symbols.contains(&s)));
    // that a length of the data is positive nobody has to be told
    let signs: Vec<_> = work.signs.iter().filter(|(e, _)| moves(*e)).collect();
    if signs.is_empty() {
        return;
    }
    let mut pieces = vec![words(work.language.pick("During all motions considered ", "Во всех рассмотренных движениях "))];
    for (i, (e, sign)) in signs.into_iter().enumerate() {
        let zero = Layout::Number { mantissa: "0".into(), exponent: None };
        let mut graph = work.equations.graph.clone();
        let positive = if *sign == Sign::Plus { *e } else { graph.neg(*e) };
        let left = work.printer.layout(&graph, positive);
        pieces.push(words(if i == 0 { "" } else { ", " }));
        pieces.push(inline(Layout::Related(Box::new(left), Relation::Greater, Box::new(zero))));
    }
    pieces.push(words(work.language.pick("; the lengths are written so.", "; длины записаны с учётом этого.")));
    pen.tell(pieces);
}

#[cfg(test)]
mod tests {
    use super::*;
    use report::document::Formula;

    #[test]
    fn conditions_begin_with_a_plus_and_keep_nothing_that_cancels() {
        let letter = |name: &str| Layout::Symbol(report::formula::Printer::new(Language::En).named(name));
        let shown = |terms: Vec<(Sign, Layout)>| {
            let zero = Layout::Number { mantissa: "0".into(), exponent: None };
            Formula::inline(upright(Layout::Related(Box::new(Layout::Sum(terms)), report::formula::Relation::Equal, Box::new(zero)))).text()
        };
        let (plus, minus) = (Sign::Plus, Sign::Minus);
        let inner = Layout::Fence(Bracket::Round, Box::new(Layout::Sum(vec![(plus, letter("l")), (minus, letter("s"))])));
        assert_eq!(shown(vec![(plus, letter("l")), (minus, inner), (minus, letter("x"))]), "s − x = 0");
        assert_eq!(shown(vec![(minus, letter("a")), (minus, letter("b"))]), "a + b = 0");
        // 4 (a + 2 b) - 4 a - 8 b + x = 0
        let number = |n: &str| Layout::Number { mantissa: n.into(), exponent: None };
        let times = |n: &str, of: Layout| Layout::Product(vec![number(n), of]);
        let sum = Layout::Sum(vec![(plus, letter("a")), (plus, times("2", letter("b")))]);
        let bracket = times("4", Layout::Fence(Bracket::Round, Box::new(sum)));
        let rest = [(minus, times("4", letter("a"))), (minus, times("8", letter("b"))), (plus, letter("x")), (plus, letter("y"))];
        assert_eq!(shown(std::iter::once((plus, bracket.clone())).chain(rest).collect()), "x + y = 0");
        // a bracket that nothing cancels stays
        assert!(shown(vec![(plus, bracket), (minus, letter("x"))]).contains('('));
        assert_eq!(shown(vec![(minus, letter("a")), (plus, letter("b"))]), "b − a = 0");
    }
}
