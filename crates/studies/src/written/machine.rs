//! The equation of a machine with one degree of freedom, J φ'' + J' φ'²/2 = M, beside the equations with reactions.

use super::pen::{Pen, inline, words};
use super::quantity::{chain, sum_with_unit};
use super::work::Work;
use report::formula::{Layout, Relation, SymbolClass};
use symbolic::transfer::{Reduced, reduce};
use symbolic::{Expr, Graph, Node, Rational, Substitution, SymbolId};

/// Longest formula that is also written with numbers.
const READABLE: usize = 90;
/// States at which the equation is laid against those it came from.
const STATES: u32 = 8;
/// States that are tried for that: from each distance of the start as many.
const TRIED: u32 = STATES * REACHES.len() as u32;
/// Distances of the start, SI: formulas of places need not have a value a metre away.
const REACHES: [f64; 5] = [1.0, 0.3, 0.1, 0.03, 0.01];
/// Largest deviation there, a share of the largest term.
const AGREES: f64 = 1e-9;

pub(super) fn write(work: &Work, pen: &mut Pen) {
    let Some(reduced) = leading(work).and_then(|i| reduce(work.equations, i)) else { return };
    // states at which a formula has no value say nothing
    let found: Vec<f64> = (0..TRIED).map(|k| deviation(work, &reduced, k)).filter(|d| !d.is_nan()).take(STATES as usize).collect();
    let worst = found.iter().copied().fold(0.0, f64::max);
    if found.len() < STATES as usize || worst > AGREES {
        return;
    }
    let title = if work.equations.coordinates[reduced.leading].unit == "rad" {
        work.language.pick("Equation of the machine with its reduced inertia", "Уравнение движения машины с приведённым моментом инерции")
    } else {
        work.language.pick("Equation of the machine with its reduced mass", "Уравнение движения машины с приведённой массой")
    };
    pen.section(title, |pen| told(work, (&reduced, worst), pen));
}

/// The angle of the cycle, else the first coordinate with a given start or rate.
pub(super) fn leading(work: &Work) -> Option<usize> {
    let coordinates = &work.equations.coordinates;
    let cycle = work.model.studies.iter().find_map(|s| s.coordinate("angle"));
    let asked = cycle.and_then(|angle| coordinates.iter().position(|c| c.symbols[0] == angle.symbol));
    asked.or_else(|| coordinates.iter().position(|c| c.given[1])).or_else(|| coordinates.iter().position(|c| c.given[0])).or(Some(0))
}

/// The deviation in the k-th state: parameters as they are, coordinates beside their starts, everything else spread over (0.2, 1.2).
fn deviation(work: &Work, reduced: &Reduced, k: u32) -> f64 {
    let equations = work.equations;
    let spread = |s: SymbolId| 0.2 + (0.618_034 * f64::from(k + 1) * (s.index() as f64 + 1.0)).fract();
    let mut known: Vec<(SymbolId, f64)> = equations.parameters.iter().map(|p| (p.symbol, p.value)).collect();
    let reach = REACHES[(k / STATES) as usize % REACHES.len()];
    for coordinate in &equations.coordinates {
        let find = |s: SymbolId| known.iter().find(|(n, _)| *n == s).map_or(0.0, |(_, v)| *v);
        let start = equations.graph.evaluate(&[coordinate.start], &find)[0];
        known.push((coordinate.symbols[0], start + reach * spread(coordinate.symbols[0])));
    }
    for definition in &equations.definitions {
        let find = |s: SymbolId| known.iter().find(|(n, _)| *n == s).map_or_else(|| spread(s), |(_, v)| *v);
        let value = equations.graph.evaluate(&[definition.formula], &find)[0];
        known.push((definition.symbol, value));
    }
    reduced.deviation(equations, &|s| known.iter().find(|(n, _)| *n == s).map_or_else(|| spread(s), |(_, v)| *v))
}

fn told(work: &Work, (reduced, worst): (&Reduced, f64), pen: &mut Pen) {
    let graph = &reduced.graph;
    let coordinates = &work.equations.coordinates;
    let leading = &coordinates[reduced.leading];
    let printer = reduced.ratios.iter().fold(work.own.clone(), |p, r| p.with_class(r.symbol, SymbolClass::Coordinate, r.coordinate as u32));
    let symbol = |s: SymbolId| printer.symbol_layout(graph, s);
    pen.tell(vec![
        words(work.language.pick("With the generalized coordinate ", "Обобщённая координата – ")),
        inline(symbol(leading.symbols[0])),
        words(work.language.pick(
            " the rates of the dependent ones follow from the equations of the connections by the transfer functions",
            ". Скорости зависимых координат выражаются через её скорость из уравнений связей при помощи передаточных функций",
        )),
    ]);
    for ratio in &reduced.ratios {
        let above = Layout::Row(vec![Layout::Words("d".into()), symbol(coordinates[ratio.coordinate].symbols[0])]);
        let below = Layout::Row(vec![Layout::Words("d".into()), symbol(leading.symbols[0])]);
        let fraction = Layout::Fraction(Box::new(above), Box::new(below));
        pen.numbered(chain(&printer, vec![symbol(ratio.symbol), fraction, printer.layout(graph, ratio.formula)]));
    }
    let angle = leading.unit == "rad";
    let (en, ru) = if angle {
        ("reduced moment of inertia", "приведённым моментом инерции")
    } else {
        ("reduced mass", "приведённой массой")
    };
    pen.tell(vec![
        words(work.language.pick("The kinetic energy of all bodies is ", "Кинетическая энергия всех тел равна ")),
        inline(half_square(work, symbol(leading.symbols[1]))),
        words(work.language.pick(format!(" with the {en}"), format!(" с {ru}"))),
    ]);
    let inertia = of(work, "J", symbol(leading.symbols[0]));
    pen.numbered(chain(&printer, vec![inertia.clone(), printer.layout(graph, reduced.inertia)]));
    numbers(work, (graph, reduced.whole, if angle { "kg m^2" } else { "kg" }), &inertia, pen);
    let (en, ru) = if angle {
        ("moment", "Приведённый момент определяется")
    } else {
        ("force", "Приведённая сила определяется")
    };
    pen.say(work.language.pick(
        format!("The reduced {en} does the power of all loads; the reactions of ideal connections do none:"),
        format!("{ru} из равенства мощностей всех нагрузок; мощность реакций идеальных связей равна нулю:"),
    ));
    let moment = Layout::Symbol(printer.named(if angle { "M_пр" } else { "F_пр" }));
    let moment =
        if work.language == ::words::Language::En { Layout::Symbol(printer.named(if angle { "M_r" } else { "F_r" })) } else { moment };
    let mut opened = graph.clone();
    let formula = opened_switches(&mut opened, reduced.moment);
    pen.numbered(chain(&printer, vec![moment.clone(), printer.layout(&opened, formula)]));
    pen.say(work.language.pick("The equation of the machine is", "Уравнение движения машины"));
    pen.numbered(printer.block(equation(work, reduced, moment)));
    // nothing is closer than the last digit
    let worst = report::number::short(worst.max(1e-16), 2, work.language);
    pen.say(work.language.pick(
        format!(
            "It was laid against the equations with reactions at {STATES} states: the largest difference is {worst} of the largest term."
        ),
        format!("Оно сопоставлено с уравнениями с реакциями в {STATES} состояниях: наибольшее расхождение {worst} наибольшего слагаемого."),
    ));
}

/// A sum whose products with a bracket around a switch are multiplied out: a switch behind two signs and a bracket is read by nobody.
fn opened_switches(graph: &mut Graph, e: Expr) -> Expr {
    let Node::Sum { constant, terms } = graph.node(e).clone() else { return opened(graph, e) };
    let mut list = vec![graph.number(constant)];
    for (term, factor) in &terms {
        let term = opened(graph, *term);
        list.push(graph.scale(term, factor));
    }
    graph.sum(&list)
}

/// A product with such a bracket as a sum.
fn opened(graph: &mut Graph, e: Expr) -> Expr {
    let Node::Product { coefficient, factors } = graph.node(e).clone() else { return e };
    let switched = |graph: &Graph, base: Expr| match graph.node(base) {
        Node::Sum { terms, .. } => {
            terms.iter().any(|(term, _)| graph.reachable(&[*term]).iter().any(|n| matches!(graph.node(*n), Node::Switch { .. })))
        }
        _ => false,
    };
    let Some(at) = factors.iter().position(|(base, power)| *power == Rational::from(1) && switched(graph, *base)) else { return e };
    let Node::Sum { constant, terms } = graph.node(factors[at].0).clone() else { return e };
    let mut outer = graph.number(coefficient);
    for (i, (base, power)) in factors.iter().enumerate() {
        if i != at {
            let factor = graph.pow(*base, power);
            outer = graph.mul(outer, factor);
        }
    }
    let first = graph.number(constant);
    let mut list = vec![graph.mul(outer, first)];
    for (term, factor) in &terms {
        let term = graph.scale(*term, factor);
        list.push(graph.mul(outer, term));
    }
    graph.sum(&list)
}

/// name(argument).
fn of(work: &Work, name: &str, argument: Layout) -> Layout {
    let bracketed = Layout::Fence(report::formula::Bracket::Round, Box::new(argument));
    Layout::Row(vec![Layout::Symbol(work.printer.named(name)), bracketed])
}

/// T = J rate²/2 on a line.
fn half_square(work: &Work, rate: Layout) -> Layout {
    let two = || Layout::Number { mantissa: "2".into(), exponent: None };
    let square = Layout::Power(Box::new(rate), Box::new(two()));
    let product = Layout::Product(vec![Layout::Symbol(work.printer.named("J")), square]);
    let right = Layout::Row(vec![product, Layout::Words("/2".into())]);
    Layout::Related(Box::new(Layout::Symbol(work.printer.named("T"))), Relation::Equal, Box::new(right))
}

/// J φ'' + (1/2) dJ/dφ φ'² = M.
fn equation(work: &Work, reduced: &Reduced, moment: Layout) -> Layout {
    let [q, qd, qdd] = work.equations.coordinates[reduced.leading].symbols.map(|s| work.printer.symbol_layout(&reduced.graph, s));
    let number = |text: &str| Layout::Number { mantissa: text.into(), exponent: None };
    let letter = Layout::Symbol(work.printer.named("J"));
    let d = |of: Layout| Layout::Row(vec![Layout::Words("d".into()), of]);
    let slope = Layout::Fraction(Box::new(d(letter.clone())), Box::new(d(q)));
    let half = Layout::Fraction(Box::new(number("1")), Box::new(number("2")));
    let square = Layout::Power(Box::new(qd), Box::new(number("2")));
    let plus = report::formula::Sign::Plus;
    let mut terms = vec![(plus, Layout::Product(vec![letter, qdd]))];
    if !reduced.graph.is_zero(reduced.slope) {
        terms.push((plus, Layout::Product(vec![half, slope, square])));
    }
    Layout::Related(Box::new(Layout::Sum(terms)), Relation::Equal, Box::new(moment))
}

/// The same with the numbers of the parameters, where that is short.
fn numbers(work: &Work, (graph, whole, unit): (&Graph, Expr, &str), name: &Layout, pen: &mut Pen) {
    let mut graph = graph.clone();
    let mut list: Vec<(SymbolId, Expr)> = Vec::new();
    for p in &work.equations.parameters {
        let Some(r) = Rational::parse_decimal(&format!("{}", p.value)) else { return };
        list.push((p.symbol, graph.number(r)));
    }
    let put = Substitution::new(list).apply(&mut graph, whole);
    let put = symbolic::Textbook::new(&mut graph, [], &[]).tidy(&mut graph, put);
    if matches!(graph.node(put), Node::Number(_)) || graph.reachable(&[put]).len() > READABLE {
        return;
    }
    let printer = work.printer.clone().rounded();
    let right = sum_with_unit(printer.layout(&graph, put), unit, work.language);
    pen.formula(chain(&printer, vec![name.clone(), right]));
}

#[cfg(test)]
mod tests {
    use super::*;
    use symbolic::Edge;

    #[test]
    fn switches_leave_their_brackets_and_the_value_stays() {
        let mut graph = Graph::default();
        let [u, g, f, v] = ["u", "g", "f", "v"].map(|name| graph.symbol_id(name, 0));
        let [eu, eg, ef, ev] = [u, g, f, v].map(|s| graph.symbol(s));
        let zero = graph.zero();
        let switch = graph.switch(ev, Edge::Closed, ef, zero);
        let bracket = graph.sub(eg, switch);
        let product = graph.mul(eu, bracket);
        let minus = graph.neg(product);
        // -u (g - {f; 0}) - v
        let whole = graph.sub(minus, ev);
        let opened = opened_switches(&mut graph, whole);
        let Node::Sum { terms, .. } = graph.node(opened).clone() else { panic!("a sum") };
        assert_eq!(terms.len(), 3);
        for value in [-1.5, 2.5] {
            let find = |s: SymbolId| if s == v { value } else { 1.0 + 0.25 * s.index() as f64 };
            let [before, after] = [whole, opened].map(|e| graph.evaluate(&[e], &find)[0]);
            // three terms near 1
            assert!((before - after).abs() < 1e-15, "{before} {after}");
        }
        // a bracket without a switch stays as it is
        let plain = graph.sub(eg, ev);
        let product = graph.mul(eu, plain);
        assert_eq!(opened_switches(&mut graph, product), product);
    }
}
