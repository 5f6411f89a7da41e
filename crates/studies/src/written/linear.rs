//! Chapter 4, linearisation: the coefficients of the equations of small motions with their numbers; for one coordinate n, k and what follows from them.

use super::coefficients::{form, free, only_load, units};
use super::pen::{Coefficients, Pen, inline, words};
use super::quantity::{chain, line_at, with_unit};
use super::work::Work;
use crate::Finds;
use crate::small::formulas;
use analysis::studies::transient::oscillator::EQUAL;
use report::document::Inline;
use report::formula::{Layout, Relation, Sign};
use symbolic::{Linear, Matrix, SymbolId};

/// More coordinates than this are not written out.
const LARGEST: usize = 4;

pub(super) fn write(work: &Work, pen: &mut Pen) -> Option<Coefficients> {
    let study = work.model.studies.iter().find(|s| matches!(work.finds(s.kind), Finds::Shapes | Finds::Amplitudes | Finds::ClosedForm));
    let study = study.filter(|_| work.model.structure.is_none())?;
    let n = work.equations.coordinates.len();
    if n == 0 || study.word("about").is_some() {
        return None;
    }
    let small = crate::small::about_rest(&work.calculation.machine, study.guess()).ok().filter(|small| small.two_sided().is_ok())?;
    if !small.machine.linear().conditions.is_empty() {
        let found = super::tied::write(work, &small, pen)?;
        after(work, &found, pen);
        return Some(found);
    }
    if n > LARGEST {
        return None;
    }
    let exact = formulas::at_place(work.equations, &small);
    let linear = exact.unwrap_or_else(|| small.machine.linear().clone());
    let mut values: Vec<(SymbolId, f64)> = work.equations.parameters.iter().map(|p| (p.symbol, p.value)).collect();
    values.extend(work.equations.coordinates.iter().zip(&small.place.q).map(|(c, q)| (c.symbols[0], *q)));
    for (symbol, formula) in &linear.definitions {
        let find = |s: SymbolId| values.iter().find(|(n, _)| *n == s).map_or(f64::NAN, |(_, v)| *v);
        let value = linear.graph.evaluate(&[*formula], &find)[0];
        values.push((*symbol, value));
    }
    let title = work.language.pick("Linearisation about the equilibrium", "Линеаризация около положения равновесия");
    let mut found = None;
    pen.section(title, |pen| found = told(work, (&linear, &values, &small.place.q), pen));
    found
}

fn told(work: &Work, (linear, values, place): (&Linear, &[(SymbolId, f64)], &[f64]), pen: &mut Pen) -> Option<Coefficients> {
    let graph = &work.equations.graph;
    let mut pieces = vec![words(work.language.pick("The equilibrium is ", "Положение равновесия: "))];
    for (i, (c, q)) in work.equations.coordinates.iter().zip(place).enumerate() {
        pieces.push(words(if i == 0 { "" } else { ", " }));
        let symbol = work.printer.symbol_layout(graph, c.symbols[0]);
        pieces.push(inline(Layout::Related(Box::new(symbol), Relation::Equal, Box::new(with_unit(*q, &c.unit, work.language)))));
    }
    pieces.push(words(work.language.pick(
        ". Near it T, Π and Φ are kept to the second order in deviations and rates; the coefficients of the linear equation",
        ". Вблизи него T, Π и Φ сохраняем с точностью до второго порядка по отклонениям и скоростям; коэффициенты линейных уравнений",
    )));
    if let [only] = &work.equations.coordinates[..] {
        pieces.push(words(" "));
        pieces.push(inline(form(work, only, numbers(linear, values))));
    }
    pieces.push(words(":"));
    pen.tell(pieces);
    if place.len() > 1 {
        several(work, (linear, values), pen);
        return None;
    }
    let found = one(work, (linear, values), pen);
    after(work, &found, pen);
    Some(found)
}

/// a, b, c of one coordinate.
fn numbers(linear: &Linear, values: &[(SymbolId, f64)]) -> [f64; 3] {
    let find = |s: SymbolId| values.iter().find(|(n, _)| *n == s).map_or(f64::NAN, |(_, v)| *v);
    [&linear.mass, &linear.damping, &linear.stiffness].map(|matrix| linear.graph.evaluate(&[matrix.get(0, 0)], &find)[0])
}

/// a, b, c.
fn one(work: &Work, (linear, values): (&Linear, &[(SymbolId, f64)]), pen: &mut Pen) -> Coefficients {
    let units = units(&work.equations.coordinates[0].unit);
    let found = numbers(linear, values);
    for (k, (name, matrix)) in [("a", &linear.mass), ("b", &linear.damping), ("c", &linear.stiffness)].into_iter().enumerate() {
        let entry = matrix.get(0, 0);
        if !linear.graph.is_zero(entry) {
            let letter = Layout::Symbol(work.printer.named(&free(work, name, found[k])));
            pen.numbered(line_at(work, (letter, units[k]), (&linear.graph, entry), values));
        }
    }
    let [a, b, c] = found;
    Coefficients { a, b, c, p: only_load(work, linear, values) }
}

/// n, k and what follows from them.
fn after(work: &Work, found: &Coefficients, pen: &mut Pen) {
    let Coefficients { a, b, c, .. } = *found;
    if !(a > 0.0 && c > 0.0) {
        return;
    }
    let (n, k) = (b / (2.0 * a), (c / a).sqrt());
    if b > 0.0 {
        damping(work, [a, b, n], pen);
    }
    frequency(work, [a, c, k], pen);
    let decays = b > 0.0 && n < k && (n - k).abs() > EQUAL * k;
    pen.tell(case(work, [b, n, k]));
    if decays {
        decaying(work, (n, k), pen);
    }
}

/// Which kind of free motion there is.
fn case(work: &Work, [b, n, k]: [f64; 3]) -> Vec<Inline> {
    let language = work.language;
    let [own, other] = [("n", n), ("k", k)].map(|(letter, value)| Layout::Symbol(work.printer.named(&free(work, letter, value))));
    let compared = |relation: Relation| inline(Layout::Related(Box::new(own.clone()), relation, Box::new(other.clone())));
    let told = |en: &str, ru: &str| words(language.pick(en, ru));
    match () {
        () if b == 0.0 => {
            let lead = told(
                "There is no damping: the free oscillations are harmonic with the frequency ",
                "Затухания нет: свободные колебания гармонические с частотой ",
            );
            vec![lead, inline(other.clone()), words(".")]
        }
        () if (n - k).abs() <= EQUAL * k => vec![
            compared(Relation::Equal),
            told(
                ": the damping is critical, the free motion does not oscillate.",
                ": затухание критическое, свободное движение апериодическое.",
            ),
        ],
        () if n > k => vec![
            compared(Relation::Greater),
            told(": the free motion does not oscillate.", ": свободное движение апериодическое (большое сопротивление)."),
        ],
        () => vec![
            compared(Relation::Less),
            told(
                ": damped oscillations; their frequency, period and logarithmic decrement are",
                ": затухающие колебания; их частота, период и логарифмический декремент",
            ),
        ],
    }
}

/// k_* = √(k² − n²), T_* = 2π/k_*, δ = n T_*.
fn decaying(work: &Work, (n, k): (f64, f64), pen: &mut Pen) {
    let damped = (k * k - n * n).sqrt();
    let period = std::f64::consts::TAU / damped;
    let letter = |name: &str, value: f64| Layout::Symbol(work.printer.named(&free(work, name, value)));
    let digit = |text: &str| Layout::Number { mantissa: text.into(), exponent: None };
    let square = |of: Layout| Layout::Power(Box::new(of), Box::new(digit("2")));
    let root = |a: Layout, b: Layout| Layout::Root {
        degree: 2,
        radicand: Box::new(Layout::Sum(vec![(Sign::Plus, square(a)), (Sign::Minus, square(b))])),
    };
    let [own_n, own_k, own_damped, own_period] = [letter("n", n), letter("k", k), letter("k_*", damped), letter("T_*", period)];
    let (formula, numbers) = (root(own_k, own_n.clone()), root(size(k, work), size(n, work)));
    pen.numbered(chain(&work.printer, vec![own_damped.clone(), formula, numbers, with_unit(damped, "rad/s", work.language)]));
    let turn = Layout::Product(vec![digit("2"), Layout::Symbol(work.printer.named("π"))]);
    let whole = Layout::Fraction(Box::new(turn), Box::new(own_damped));
    pen.numbered(chain(&work.printer, vec![own_period.clone(), whole, with_unit(period, "s", work.language)]));
    let decrement = letter("δ", n * period);
    pen.numbered(chain(&work.printer, vec![decrement, Layout::Product(vec![own_n, own_period]), size(n * period, work)]));
}

fn size(x: f64, work: &Work) -> Layout {
    report::formula::value(x, 6, work.language)
}

/// n = b/(2a) = numbers = value.
fn damping(work: &Work, [a, b, n]: [f64; 3], pen: &mut Pen) {
    let letter = |name: &str, value: f64| Layout::Symbol(work.printer.named(&free(work, name, value)));
    let over = |above: Layout, below: Layout| {
        let two = Layout::Number { mantissa: "2".into(), exponent: None };
        Layout::Fraction(Box::new(above), Box::new(Layout::Product(vec![two, below])))
    };
    let (formula, numbers) = (over(letter("b", b), letter("a", a)), over(size(b, work), size(a, work)));
    pen.numbered(chain(&work.printer, vec![letter("n", n), formula, numbers, with_unit(n, "1/s", work.language)]));
}

/// k = √(c/a) = numbers = value.
fn frequency(work: &Work, [a, c, k]: [f64; 3], pen: &mut Pen) {
    let letter = |name: &str, value: f64| Layout::Symbol(work.printer.named(&free(work, name, value)));
    let root =
        |above: Layout, below: Layout| Layout::Root { degree: 2, radicand: Box::new(Layout::Fraction(Box::new(above), Box::new(below))) };
    let (formula, numbers) = (root(letter("c", c), letter("a", a)), root(size(c, work), size(a, work)));
    pen.numbered(chain(&work.printer, vec![letter("k", k), formula, numbers, with_unit(k, "rad/s", work.language)]));
}

/// Entries of M, B, C on and above the diagonal; where a matrix is not symmetric, all.
fn several(work: &Work, (linear, values): (&Linear, &[(SymbolId, f64)]), pen: &mut Pen) {
    let n = work.equations.coordinates.len();
    let symmetric = |m: &Matrix| (0..n).all(|i| (0..i).all(|j| m.get(i, j) == m.get(j, i)));
    let unit = |i: usize, j: usize, k: usize| {
        if work.equations.coordinates[i].unit == work.equations.coordinates[j].unit {
            units(&work.equations.coordinates[i].unit)[k]
        } else {
            mixed(k)
        }
    };
    for (k, (name, matrix)) in [("a", &linear.mass), ("b", &linear.damping), ("c", &linear.stiffness)].into_iter().enumerate() {
        for i in 0..n {
            for j in (if symmetric(matrix) { i } else { 0 })..n {
                let entry = matrix.get(i, j);
                if !linear.graph.is_zero(entry) {
                    let name = Layout::Symbol(work.printer.named(&format!("{name}{}{}", i + 1, j + 1)));
                    pen.numbered(line_at(work, (name, unit(i, j, k)), (&linear.graph, entry), values));
                }
            }
        }
    }
    pen.say(work.language.pick(
        "Coefficients that are not listed vanish; the frequencies are the roots of det(C − ω² M) = 0 where there is no damping.",
        "Остальные коэффициенты равны нулю; без затухания частоты суть корни уравнения det(C − ω²M) = 0.",
    ));
}

/// The unit between a length and an angle.
fn mixed(k: usize) -> &'static str {
    ["kg m", "N s", "N"][k]
}
