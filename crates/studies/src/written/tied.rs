//! Linearisation of a machine whose connections leave one degree of freedom: of J q'' + J' q'²/2 = M(q, q') near the place of rest q₀ where M(q₀, 0) = 0
//!
//! ```text
//! a = J(q₀),  b = −∂M/∂q',  c = −dM/dq = −Σ u_k ∂M/∂q_k,   a q'' + b q' + c q = 0 in deviations
//! ```
//!
//! The coefficients are written only where c/a is the square of the natural frequency that the study `modes` found from the equations with reactions.

use super::coefficients::{form, free, only_load, units};
use super::pen::{Coefficients, Pen, inline, words};
use super::quantity::{line_at, with_unit};
use super::work::Work;
use crate::Finds;
use crate::small::Small;
use report::document::Formula;
use report::formula::{Layout, Relation};
use symbolic::transfer::{Reduced, reduce};
use symbolic::{Derivation, Expr, Graph, Substitution, SymbolId, Textbook};

/// Coordinates nearer to zero than this are zero.
const NEAR: f64 = 1e-12;
/// More nodes than this are not written as a formula.
const READABLE: usize = 70;
/// How far c/a may lie from the square of the frequency that was found otherwise.
const AGREES: f64 = 1e-8;

/// a, b, c over parameters and coordinates, and their numbers.
struct Linearised {
    graph: Graph,
    entries: [Expr; 3],
    numbers: [f64; 3],
    values: Vec<(SymbolId, f64)>,
}

pub(super) fn write(work: &Work, small: &Small, pen: &mut Pen) -> Option<Coefficients> {
    let leading = super::machine::leading(work)?;
    let reduced = reduce(work.equations, leading)?;
    let found = linearised(work, &reduced, &small.place.q);
    let [a, b, c] = found.numbers;
    if !agrees(work, c / a) {
        return None;
    }
    let title = work.language.pick("Linearisation about the equilibrium", "Линеаризация около положения равновесия");
    pen.section(title, |pen| told(work, (&reduced, &found, small.place.q[leading]), pen));
    Some(Coefficients { a, b, c, p: only_load(work, small.machine.linear(), &found.values) })
}

/// Whether the study of natural frequencies found this square of the frequency.
fn agrees(work: &Work, square: f64) -> bool {
    let modes = work.results_that(|finds| finds == Finds::Shapes).next();
    let omega = modes.and_then(|r| r.data.column("omega")).map(|column| column.values.clone());
    matches!(omega.as_deref(), Some([omega]) if (omega * omega - square).abs() <= AGREES * square.abs())
}

fn linearised(work: &Work, reduced: &Reduced, place: &[f64]) -> Linearised {
    let mut graph = reduced.graph.clone();
    let coordinates = &work.equations.coordinates;
    let rate = coordinates[reduced.leading].symbols[1];
    let mut whole = vec![graph.one(); coordinates.len()];
    reduced.ratios.iter().for_each(|r| whole[r.coordinate] = r.whole);
    let resisting = Derivation::partial(&mut graph, rate).apply(&mut graph, reduced.whole_moment);
    let returning =
        Derivation::new(coordinates.iter().zip(&whole).map(|(c, u)| (c.symbols[0], *u))).apply(&mut graph, reduced.whole_moment);
    let zero = graph.zero();
    // loads that repeat are deviations from rest: a sine begins with zero
    let still = coordinates.iter().zip(place).filter(|(_, q)| q.abs() <= NEAR).map(|(c, _)| (c.symbols[0], zero));
    let mut put = Substitution::new(still.chain([(rate, zero), (work.equations.time, zero)]).collect::<Vec<_>>());
    let entries = [reduced.whole, resisting, returning].map(|e| put.apply(&mut graph, e));
    let entries = [entries[0], graph.neg(entries[1]), graph.neg(entries[2])];
    let constants = work.equations.parameters.iter().map(|p| p.symbol);
    let mut textbook = Textbook::new(&mut graph, constants, &[]);
    let entries = entries.map(|e| textbook.tidy(&mut graph, e));
    let mut values: Vec<(SymbolId, f64)> = work.equations.parameters.iter().map(|p| (p.symbol, p.value)).collect();
    values.extend(coordinates.iter().zip(place).map(|(c, q)| (c.symbols[0], *q)));
    let find = |s: SymbolId| values.iter().find(|(n, _)| *n == s).map_or(f64::NAN, |(_, v)| *v);
    let numbers = graph.evaluate(&entries, &find);
    let numbers = [numbers[0], numbers[1], numbers[2]];
    Linearised { graph, entries, numbers, values }
}

fn told(work: &Work, (reduced, found, place): (&Reduced, &Linearised, f64), pen: &mut Pen) {
    let coordinate = &work.equations.coordinates[reduced.leading];
    let [q, rate, _] = coordinate.symbols.map(|s| work.printer.symbol_layout(&reduced.graph, s));
    let at = Layout::Related(Box::new(q.clone()), Relation::Equal, Box::new(with_unit(place, &coordinate.unit, work.language)));
    pen.tell(vec![
        words(work.language.pick("The machine rests at ", "Положение равновесия механизма: ")),
        inline(at),
        words(work.language.pick(
            ". Near it the equation of the machine is kept to the first order in deviations and rates: ",
            ". Вблизи него в уравнении движения машины сохраняем слагаемые первого порядка малости: ",
        )),
        inline(form(work, coordinate, found.numbers)),
        words(work.language.pick(" with the coefficients", " с коэффициентами")),
    ]);
    let letter = |name: &str| Layout::Symbol(work.printer.named(name));
    let bracket = |argument| Layout::Fence(report::formula::Bracket::Round, Box::new(argument));
    let d = |of: Layout, mark: &str| Layout::Row(vec![Layout::Words(mark.into()), of]);
    let slope = |by: Layout, mark: &str| {
        let fraction = Layout::Fraction(Box::new(d(letter("M"), mark)), Box::new(d(by, mark)));
        Layout::Sum(vec![(report::formula::Sign::Minus, fraction)])
    };
    let meant = [Layout::Row(vec![letter("J"), bracket(q.clone())]), slope(rate, "∂"), slope(q, "d")];
    for (k, (name, meant)) in ["a", "b", "c"].into_iter().zip(meant).enumerate() {
        let (entry, unit) = (found.entries[k], units(&coordinate.unit)[k]);
        if found.graph.is_zero(entry) {
            continue;
        }
        let name = free(work, name, found.numbers[k]);
        // c = c says nothing
        let own = work.printer.layout(&found.graph, entry) == letter(&name);
        let name = Layout::Related(Box::new(letter(&name)), Relation::Equal, Box::new(meant));
        let formula: Formula = match !own && found.graph.reachable(&[entry]).len() <= READABLE {
            true => line_at(work, (name, unit), (&found.graph, entry), &found.values),
            false => super::quantity::chain(&work.printer, vec![name, with_unit(found.numbers[k], unit, work.language)]),
        };
        pen.numbered(formula);
    }
}
