//! What linearised equations of one freedom are written with, with connections and without: form, units, letters, load.

use super::work::Work;
use report::formula::{Layout, Relation, Sign};
use symbolic::equations::Coordinate;
use symbolic::{Linear, SymbolId};

/// The frequency of the load, where there is one, and its symbol in the file.
pub(super) fn only_load(work: &Work, linear: &Linear, values: &[(SymbolId, f64)]) -> Option<(f64, Layout)> {
    let [only] = &linear.loads[..] else { return None };
    let find = |s: SymbolId| values.iter().find(|(n, _)| *n == s).map_or(f64::NAN, |(_, v)| *v);
    let p = Some(linear.graph.evaluate(&[only.rate], &find)[0]).filter(|p| *p > 0.0 && p.is_finite())?;
    let own = || Layout::Symbol(work.printer.named(&free(work, "p", p)));
    Some((p, linear.graph.as_symbol(only.rate).map_or_else(own, |symbol| work.printer.symbol_layout(&linear.graph, symbol))))
}

/// a q'' + b q' + c q = Q.
pub(super) fn form(work: &Work, coordinate: &Coordinate, numbers: [f64; 3]) -> Layout {
    let term = |(letter, k): (&str, usize)| {
        let symbol = work.printer.symbol_layout(&work.equations.graph, coordinate.symbols[k]);
        let letter = free(work, letter, numbers[2 - k]);
        (Sign::Plus, Layout::Product(vec![Layout::Symbol(work.printer.named(&letter)), symbol]))
    };
    let left = Layout::Sum([("a", 2), ("b", 1), ("c", 0)].map(term).to_vec());
    Layout::Related(Box::new(left), Relation::Equal, Box::new(Layout::Symbol(work.printer.named("Q"))))
}

/// Unit of a coefficient of a coordinate's acceleration, rate and deviation in the balance of that coordinate.
pub(super) fn units(unit: &str) -> [&'static str; 3] {
    match unit {
        "rad" => ["kg m^2", "N m s/rad", "N m/rad"],
        "m" => ["kg", "N s/m", "N/m"],
        _ => ["", "", ""],
    }
}

/// A letter for a quantity of this chapter: another one where the file uses it for something else.
pub(super) fn free(work: &Work, letter: &str, value: f64) -> String {
    let wanted = work.printer.shown(letter);
    // a value that is another one of the file to nine digits is that one
    let same = |x: f64| (x - value).abs() <= 1e-9 * value.abs();
    let number = |symbol: SymbolId| work.equations.parameters.iter().find(|p| p.symbol == symbol).map(|p| p.value);
    let named = |name: &str| work.printer.shown(name) == wanted;
    let taken = work.model.parameters.iter().any(|p| named(&p.name) && !p.number.or_else(|| number(p.symbol)).is_some_and(same))
        || work.model.coordinates.iter().any(|c| named(&c.name))
        || work.model.outputs.iter().any(|o| named(&o.name));
    let other = work.language.pick("lin", "лин");
    if taken { format!("{letter}_{other}") } else { letter.to_owned() }
}
