//! Chapter 4, linearisation: the coefficients of the equations of small motions with their numbers; for one coordinate n, k and what follows from them.

use super::Work;
use super::pen::{Pen, inline, words};
use super::quantity::{chain, line_at, with_unit};
use crate::small::formulas;
use report::formula::{Layout, Relation};
use symbolic::{Linear, Matrix, SymbolId};

/// More coordinates than this are not written out.
const LARGEST: usize = 4;

pub(super) fn write(work: &Work, pen: &mut Pen) {
    let study = work.model.studies.iter().find(|s| matches!(s.kind, "modes" | "response" | "transient"));
    let Some(study) = study.filter(|_| work.model.structure.is_none()) else { return };
    let n = work.equations.coordinates.len();
    if n == 0 || n > LARGEST || study.word("about").is_some() {
        return;
    }
    let Ok(small) = crate::small::about_rest(&work.calculation.machine, study.guess()) else { return };
    if !small.machine.linear().conditions.is_empty() {
        return;
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
    pen.section(title, |pen| told(work, (&linear, &values, &small.place.q), pen));
}

fn told(work: &Work, (linear, values, place): (&Linear, &[(SymbolId, f64)], &[f64]), pen: &mut Pen) {
    let graph = &work.equations.graph;
    let mut pieces = vec![words(work.language.pick("The equilibrium is ", "Положение равновесия: "))];
    for (i, (c, q)) in work.equations.coordinates.iter().zip(place).enumerate() {
        pieces.push(words(if i == 0 { "" } else { ", " }));
        let symbol = work.printer.symbol_layout(graph, c.symbols[0]);
        pieces.push(inline(Layout::Related(Box::new(symbol), Relation::Equal, Box::new(with_unit(*q, &c.unit, work.language)))));
    }
    let form = if place.len() == 1 { "a q'' + b q' + c q" } else { "" };
    pieces.push(words(work.language.pick(
        ". Near it T, Π and Φ are kept to the second order in deviations and rates; the coefficients of the linear equation",
        ". Вблизи него T, Π и Φ сохраняем с точностью до второго порядка по отклонениям и скоростям; коэффициенты линейных уравнений",
    )));
    pieces.push(words(if form.is_empty() { ":".to_owned() } else { format!(" {form}:") }));
    pen.tell(pieces);
    match place.len() {
        1 => one(work, (linear, values), pen),
        _ => several(work, (linear, values), pen),
    }
}

/// Unit of a coefficient of a coordinate's acceleration, rate and deviation in the balance of that coordinate.
fn units(unit: &str) -> [&'static str; 3] {
    match unit {
        "rad" => ["kg m^2", "N m s/rad", "N m/rad"],
        "m" => ["kg", "N s/m", "N/m"],
        _ => ["", "", ""],
    }
}

/// a, b, c, n, k.
fn one(work: &Work, (linear, values): (&Linear, &[(SymbolId, f64)]), pen: &mut Pen) {
    let units = units(&work.equations.coordinates[0].unit);
    let letter = |name: &str| Layout::Symbol(work.printer.named(name));
    let mut found = [0.0; 3];
    for (k, (name, matrix)) in [("a", &linear.mass), ("b", &linear.damping), ("c", &linear.stiffness)].into_iter().enumerate() {
        let entry = matrix.get(0, 0);
        let find = |s: SymbolId| values.iter().find(|(n, _)| *n == s).map_or(f64::NAN, |(_, v)| *v);
        found[k] = linear.graph.evaluate(&[entry], &find)[0];
        if !linear.graph.is_zero(entry) {
            pen.numbered(line_at(work, (letter(name), units[k]), (&linear.graph, entry), values));
        }
    }
    let [a, b, c] = found;
    if !(a > 0.0 && c > 0.0) {
        return;
    }
    let (n, k) = (b / (2.0 * a), (c / a).sqrt());
    if b > 0.0 {
        damping(work, (a, b, n), pen);
    }
    frequency(work, (a, c, k), pen);
    let language = work.language;
    let number = |x: f64| report::number::short(x, 6, language);
    pen.say(match () {
        () if b == 0.0 => language.pick("There is no damping: the free oscillations are harmonic with the frequency k.".to_owned(), "Затухания нет: свободные колебания гармонические с частотой k.".to_owned()),
        () if (n - k).abs() <= 1e-9 * k => language.pick("n = k: the damping is critical, the free motion does not oscillate.".to_owned(), "n = k: затухание критическое, свободное движение апериодическое.".to_owned()),
        () if n > k => language.pick("n > k: the free motion does not oscillate.".to_owned(), "n > k: свободное движение апериодическое (большое сопротивление).".to_owned()),
        () => {
            let damped = (k * k - n * n).sqrt();
            let (omega, period, decrement) = (number(damped), number(std::f64::consts::TAU / damped), number(std::f64::consts::TAU * n / damped));
            language.pick(
                format!("n < k: damped oscillations with the frequency k₁ = √(k² − n²) = {omega} rad/s, the period T₁ = 2π/k₁ = {period} s and the logarithmic decrement δ = n T₁ = {decrement}."),
                format!("n < k: затухающие колебания с частотой k₁ = √(k² − n²) = {omega} рад/с, периодом T₁ = 2π/k₁ = {period} с и логарифмическим декрементом δ = n T₁ = {decrement}."),
            )
        }
    });
}

fn size(x: f64, work: &Work) -> Layout {
    report::formula::value(x, 6, work.language)
}

/// n = b/(2a) = numbers = value.
fn damping(work: &Work, (a, b, n): (f64, f64, f64), pen: &mut Pen) {
    let letter = |name: &str| Layout::Symbol(work.printer.named(name));
    let over = |above: Layout, below: Layout| {
        let two = Layout::Number { mantissa: "2".into(), exponent: None };
        Layout::Fraction(Box::new(above), Box::new(Layout::Product(vec![two, below])))
    };
    let parts = vec![letter("n"), over(letter("b"), letter("a")), over(size(b, work), size(a, work)), with_unit(n, "1/s", work.language)];
    pen.numbered(chain(&work.printer, parts));
}

/// k = √(c/a) = numbers = value.
fn frequency(work: &Work, (a, c, k): (f64, f64, f64), pen: &mut Pen) {
    let letter = |name: &str| Layout::Symbol(work.printer.named(name));
    let root =
        |above: Layout, below: Layout| Layout::Root { degree: 2, radicand: Box::new(Layout::Fraction(Box::new(above), Box::new(below))) };
    let parts = vec![letter("k"), root(letter("c"), letter("a")), root(size(c, work), size(a, work)), with_unit(k, "rad/s", work.language)];
    pen.numbered(chain(&work.printer, parts));
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
