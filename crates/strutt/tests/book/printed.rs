//! Claims about equations: their print, their value at the start.

use crate::claim::Claim;
use report::formula::{Form, Printer};
use studies::pipeline::Machine;
use symbolic::SymbolId;
use words::Language;

pub fn equations(machine: &Machine, claim: &Claim) -> Result<(), String> {
    let equations = &machine.equations;
    let printer = Printer::of(equations, Language::En).with_width(100_000);
    let same = |found: String, expected: &str| {
        let plain = |s: &str| s.split_whitespace().collect::<Vec<_>>().join(" ");
        if plain(&found) == plain(expected) { Ok(()) } else { Err(format!("printed {}", plain(&found))) }
    };
    match claim {
        Claim::Equation { number, text } => {
            let list = equations.textbook.as_ref().map_err(|e| e.en.clone())?;
            let equality = *list.get(number - 1).ok_or("no such equation")?;
            same(printer.equality(&equations.graph, equality, Some(number - 1), Form::Text), text)
        }
        Claim::Energy { kind, text } => {
            let e = &equations.energy;
            let e = match *kind {
                "kinetic:" => e.kinetic,
                "potential:" => e.potential,
                _ => e.dissipation,
            };
            same(printer.expression(&equations.graph, e, Form::Text), text)
        }
        Claim::Inertia { name, expected, tolerance } => {
            let i = equations.coordinates.iter().position(|c| equations.graph.symbol_info(c.symbols[0]).name == *name);
            let i = i.ok_or_else(|| format!("no coordinate `{name}`"))?;
            tolerance.check("inertia", at_start(machine, equations.mass.get(i, i)), *expected)
        }
        _ => Err("the model is accepted".into()),
    }
}

/// The value of an expression at the start of the motion, by the plain evaluator of the graph.
fn at_start(machine: &Machine, e: symbolic::Expr) -> f64 {
    let equations = &machine.equations;
    let mut values = vec![0.0; equations.graph.symbol_count()];
    equations.parameters.iter().for_each(|p| values[p.symbol.index()] = p.value);
    for d in &equations.definitions {
        let known = |s: SymbolId| values[s.index()];
        values[d.symbol.index()] = equations.graph.evaluate(&[d.formula], &known)[0];
    }
    for c in &equations.coordinates {
        let known = |s: SymbolId| values[s.index()];
        let start = equations.graph.evaluate(&[c.start, c.rate], &known);
        (values[c.symbols[0].index()], values[c.symbols[1].index()]) = (start[0], start[1]);
    }
    equations.graph.evaluate(&[e], &|s| values[s.index()])[0]
}
