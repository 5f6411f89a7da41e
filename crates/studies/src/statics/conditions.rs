//! What holds at rest, in words: the balances of released bodies, the equations along coordinates that say more than these, the limits of frictions and contacts.
//!
//! ```text
//! Σ released λ + rest = 0      one a balance
//! Σ forces λ + h = 0           one a coordinate
//! λ = ± μ |N|, |λ| ≤ μ |N|     a friction about to slide, any other
//! N ≥ 0                        a contact
//! ```

use analysis::studies::statics::Statics;
use report::formula::{Form, Placement, Printer};
use symbolic::connections::{Friction, Law, Reaction};
use symbolic::equations::Equality;
use symbolic::{Equations, Expr, Graph, Substitution};
use words::{Language, Text};

use crate::machine::Machine;
use crate::machine::unknowns::impending;

/// One line each. What an earlier line says, perhaps with the other sign, is not told again.
pub(super) fn told(machine: &Machine, found: &Statics) -> Vec<Text> {
    let equations = &machine.equations;
    let mut graph = equations.graph.clone();
    let mut still = still(equations, &mut graph, &found.open);
    let mut sums: Vec<(Text, Expr)> = Vec::new();
    for (name, terms) in lines(equations, &mut graph, &found.telling) {
        let terms: Vec<Expr> = terms.into_iter().map(|e| still.apply(&mut graph, e)).collect();
        let sum = graph.sum(&terms);
        let told = |graph: &mut Graph, earlier: Expr| {
            let both = graph.add(earlier, sum);
            earlier == sum || graph.is_zero(both)
        };
        if !sums.iter().any(|(_, earlier)| told(&mut graph, *earlier)) {
            sums.push((name, sum));
        }
    }
    let line = |(name, sum): &(Text, Expr), language: Language| {
        format!("{}: {} = 0", language.text(name), Printer::of(equations, language).inline(&graph, *sum, Form::Text))
    };
    let mut words: Vec<Text> = sums.iter().map(|sum| Text::new(line(sum, Language::En), line(sum, Language::Ru))).collect();
    let about = impending(&machine.model, equations);
    let held = (0..equations.reactions.len()).filter(|r| !found.open.contains(r));
    words.extend(held.filter_map(|r| {
        let direction = about.iter().find(|(friction, _)| *friction == r).map(|(_, direction)| *direction);
        limit(equations, (&mut graph, &mut still), &equations.reactions[r], direction)
    }));
    words
}

/// Rates, accelerations and what open contacts carry are zero.
fn still(equations: &Equations, graph: &mut Graph, open: &[usize]) -> Substitution {
    let zero = graph.zero();
    let rates = equations.coordinates.iter().flat_map(|c| [c.symbols[1], c.symbols[2]]);
    let open = open.iter().map(|r| equations.reactions[*r].symbol);
    Substitution::new(rates.chain(open).map(|symbol| (symbol, zero)).collect::<Vec<_>>())
}

/// Names and terms of all balances, then of these coordinates.
fn lines(equations: &Equations, graph: &mut Graph, telling: &[usize]) -> Vec<(Text, Vec<Expr>)> {
    let mut with = |row: usize, free: Expr, list: fn(&Reaction) -> &[(usize, Expr)]| {
        let given = equations.reactions.iter().flat_map(|r| list(r).iter().filter(|(i, _)| *i == row).map(|(_, e)| (r.symbol, *e)));
        let carried = given.map(|(symbol, e)| {
            let force = graph.symbol(symbol);
            graph.mul(e, force)
        });
        std::iter::once(free).chain(carried).collect::<Vec<Expr>>()
    };
    let mut lines = Vec::new();
    for (row, balance) in equations.balances.iter().enumerate() {
        lines.push((balance.name.clone(), with(row, balance.rest, |r| &r.released)));
    }
    for &j in telling {
        let symbol = &equations.graph.symbol_info(equations.coordinates[j].symbols[0]).name;
        let name = Text::new(format!("along the coordinate {symbol}"), format!("по координате {symbol}"));
        lines.push((name, with(j, equations.force[j], |r| &r.forces)));
    }
    lines
}

/// What bounds a reaction; nothing bounds those of joints.
fn limit(
    equations: &Equations,
    (graph, still): (&mut Graph, &mut Substitution),
    reaction: &Reaction,
    impending: Option<f64>,
) -> Option<Text> {
    let force = graph.symbol(reaction.symbol);
    let (told, bound) = match &reaction.law {
        Law::Friction(friction) => (about_to_slide(impending), Some(bound(equations, (&mut *graph, still), friction, (force, impending)))),
        Law::Contact { .. } => (Text::default(), None),
        _ => return None,
    };
    let line = |language: Language| {
        let printer = Printer::of(equations, language);
        let formula = match (bound, impending) {
            (None, _) => format!("{} ≥ 0", printer.inline(graph, force, Form::Text)),
            (Some(bound), Some(_)) => printer.write(&printer.equality_layout(graph, bound, None), Form::Text, Placement::Inline),
            (Some(bound), None) => printer.write(&printer.at_most(graph, bound), Form::Text, Placement::Inline),
        };
        format!("{}{}: {formula}", language.text(&reaction.label), language.text(&told))
    };
    Some(Text::new(line(Language::En), line(Language::Ru)))
}

/// λ = ± μ |N| or |λ| ≤ μ |N|.
fn bound(
    equations: &Equations,
    (graph, still): (&mut Graph, &mut Substitution),
    friction: &Friction,
    (force, impending): (Expr, Option<f64>),
) -> Equality {
    let limit = crate::frictions::limit(equations, graph, friction);
    let limit = still.apply(graph, limit);
    match impending {
        Some(direction) if direction < 0.0 => Equality { left: force, right: graph.neg(limit) },
        Some(_) => Equality { left: force, right: limit },
        None => Equality { left: graph.call(symbolic::Function::Abs, &[force]), right: limit },
    }
}

fn about_to_slide(direction: Option<f64>) -> Text {
    match direction {
        None => Text::default(),
        Some(d) if d < 0.0 => Text::new(", about to slide backward", ", на грани скольжения назад"),
        Some(_) => Text::new(", about to slide forward", ", на грани скольжения вперёд"),
    }
}
