//! Time in equations that are made linear: what repeats is split into harmonics, its means into symbols, and what does not is taken at t = 0.

use crate::graph::Edge;
use crate::harmonics::{Decomposition, Harmonics};
use crate::waveform::Waveform;
use crate::{Equations, Expr, Function, Graph, Node, Rational, Substitution, SymbolId};

/// How the time in the equations was treated.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Timing {
    /// The loads are no sum of harmonics: everything was taken at t = 0.
    pub frozen: bool,
    /// Switches of time were settled as they stand at t = 0.
    pub settled: bool,
    /// A prescribed motion is a condition that changes with time; it was taken at t = 0.
    pub driven: bool,
    /// M, B or C contain harmonics, of which the mean was taken (parametric excitation).
    pub varying: bool,
    /// The forces are not linear in the rates.
    pub bent: bool,
    /// Loads that repeat decide the place of rest by their means over a period.
    pub averaged: bool,
}

/// A periodic function of time with a symbol for its mean over a period, which is a number of the parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Form {
    /// The function.
    pub wave: Waveform,
    /// Stands for its mean in [`super::Linear::force`] and in the matrices.
    pub mean: SymbolId,
}

/// Definitions and turn angles that depend on time, as formulas of time, definitions and parameters that do not.
pub(super) fn moving(equations: &Equations, graph: &mut Graph) -> Vec<(SymbolId, Expr)> {
    let mut moving: Vec<(SymbolId, Expr)> = Vec::new();
    for definition in &equations.definitions {
        let formula = Substitution::new(moving.iter().copied()).apply(graph, definition.formula);
        if graph.contains(formula, |s| s == equations.time) {
            moving.push((definition.symbol, formula));
        }
    }
    for auxiliary in &equations.auxiliaries {
        let rate = Substitution::new(moving.iter().copied()).apply(graph, auxiliary.rate);
        let time = graph.symbol(equations.time);
        // a rate that changes with time leaves no harmonic behind, and the angle is taken at the start
        let turned = graph.mul(rate, time);
        let angle = graph.add(auxiliary.start, turned);
        moving.push((auxiliary.symbol, angle));
    }
    moving
}

/// The definitions that are left.
pub(super) fn still(equations: &Equations, moving: &[(SymbolId, Expr)]) -> Vec<(SymbolId, Expr)> {
    let list = equations.definitions.iter().filter(|d| moving.iter().all(|(s, _)| *s != d.symbol));
    list.map(|d| (d.symbol, d.formula)).collect()
}

/// The index of a waveform.
pub(super) fn known(graph: &mut Graph, forms: &mut Vec<Form>, wave: Waveform) -> usize {
    // no name in a file holds a space
    forms.iter().position(|f| f.wave == wave).unwrap_or_else(|| {
        let mean = graph.symbol_id(&format!("mean {}", forms.len() + 1), 0);
        forms.push(Form { wave, mean });
        forms.len() - 1
    })
}

/// The mean of a sum of harmonics, with symbols for the means of its waveforms. What has the rate zero stands still: cos 0t = 1.
pub(super) fn averaged(graph: &mut Graph, (forms, stills): (&mut Vec<Form>, &mut Stills), harmonics: &Harmonics) -> Expr {
    let mut terms = vec![harmonics.mean];
    for wave in &harmonics.waves {
        if let Some(still) = stills.of(graph, wave.rate) {
            terms.push(graph.mul(wave.cos, still));
        }
    }
    for (wave, factor) in &harmonics.forms {
        let form = known(graph, forms, *wave);
        let mean = graph.symbol(forms[form].mean);
        let mean = stills.moving(graph, wave.rate, mean);
        terms.push(graph.mul(*factor, mean));
        if let Some(still) = stills.of(graph, wave.rate) {
            let zero = graph.zero();
            let start = Substitution::new([(stills.time, zero)]).apply(graph, wave.shape);
            terms.push(graph.product(&[*factor, still, start]));
        }
    }
    graph.sum(&terms)
}

/// Symbols that are 1 where a rate over parameters vanishes and 0 elsewhere, with their formulas.
#[derive(Clone, Debug)]
pub struct Stills {
    /// The symbols.
    pub list: Vec<(SymbolId, Expr)>,
    pub(super) time: SymbolId,
}

impl Stills {
    /// The symbol of a rate; none of a number.
    pub(super) fn of(&mut self, graph: &mut Graph, rate: Expr) -> Option<Expr> {
        if graph.symbols_in(&[rate]).is_empty() {
            return None;
        }
        let formula = vanishes(graph, rate);
        let symbol = self.list.iter().find(|s| s.1 == formula).map(|s| s.0).unwrap_or_else(|| {
            // no name in a file holds a space
            let symbol = graph.symbol_id(&format!("still {}", self.list.len() + 1), 0);
            self.list.push((symbol, formula));
            symbol
        });
        Some(graph.symbol(symbol))
    }

    /// `e` where the rate does not vanish, else zero.
    pub(super) fn moving(&mut self, graph: &mut Graph, rate: Expr, e: Expr) -> Expr {
        let Some(still) = self.of(graph, rate) else { return e };
        let one = graph.one();
        let factor = graph.sub(one, still);
        graph.mul(e, factor)
    }
}

/// Amplitudes of what oscillates in a formula.
pub(super) fn moving_parts(graph: &mut Graph, stills: &mut Stills, h: &Harmonics) -> Vec<Expr> {
    let waves = h.waves.iter().flat_map(|w| [(w.rate, w.cos), (w.rate, w.sin)]);
    let all: Vec<(Expr, Expr)> = waves.chain(h.forms.iter().map(|(form, factor)| (form.rate, *factor))).collect();
    all.into_iter().map(|(rate, e)| stills.moving(graph, rate, e)).collect()
}

/// 1 where a rate is zero, a difference to twelve digits, else 0.
fn vanishes(graph: &mut Graph, rate: Expr) -> Expr {
    let square = graph.mul(rate, rate);
    let mut guard = graph.neg(square);
    if let Node::Sum { terms, .. } = graph.node(rate).clone() {
        let sizes: Vec<Expr> = terms
            .iter()
            .map(|(term, factor)| {
                let term = graph.scale(*term, factor);
                graph.call(Function::Abs, &[term])
            })
            .collect();
        let size = graph.sum(&sizes);
        let share = Rational::new(1, 1_000_000_000_000).unwrap_or(Rational::ZERO);
        let size = graph.scale(size, &share);
        let least = graph.mul(size, size);
        guard = graph.sub(least, square);
    }
    let (one, zero) = (graph.one(), graph.zero());
    graph.switch(guard, Edge::Closed, one, zero)
}

/// Splits expressions into harmonics; when one of them is none, all are taken at t = 0.
pub(super) fn split(equations: &Equations, graph: &mut Graph, list: &[Expr], timing: &mut Timing) -> Vec<Harmonics> {
    let mut settled = false;
    let mut decide = |graph: &mut Graph, guard: Expr| {
        let value = at_start(equations, graph, guard)?;
        settled = true;
        Some(value >= 0.0)
    };
    let states: Vec<SymbolId> =
        equations.coordinates.iter().flat_map(|c| c.symbols).chain(equations.reactions.iter().map(|r| r.symbol)).collect();
    let mut decomposition = Decomposition::new(equations.time, &states, &mut decide);
    let found: Option<Vec<Harmonics>> = list.iter().map(|e| decomposition.apply(graph, *e)).collect();
    timing.settled |= settled;
    found.unwrap_or_else(|| {
        timing.frozen = true;
        let zero = graph.zero();
        let mut start = Substitution::new([(equations.time, zero)]);
        list.iter().map(|e| Harmonics::still(start.apply(graph, *e))).collect()
    })
}

/// The value of a guard over time and parameters just after t = 0.
fn at_start(equations: &Equations, graph: &mut Graph, guard: Expr) -> Option<f64> {
    let known = |s: SymbolId| {
        s == equations.time || equations.parameters.iter().any(|p| p.symbol == s) || equations.definitions.iter().any(|d| d.symbol == s)
    };
    if graph.contains(guard, |s| !known(s)) {
        return None;
    }
    let rate = graph.derivative(guard, equations.time);
    let mut values: Vec<(SymbolId, f64)> = vec![(equations.time, 0.0)];
    values.extend(equations.parameters.iter().map(|p| (p.symbol, p.value)));
    for definition in &equations.definitions {
        let value = graph.evaluate(&[definition.formula], &|s| find(&values, s))[0];
        values.push((definition.symbol, value));
    }
    let at = graph.evaluate(&[guard, rate], &|s| find(&values, s));
    let value = if at[0] == 0.0 { at[1] } else { at[0] };
    value.is_finite().then_some(value)
}

fn find(values: &[(SymbolId, f64)], symbol: SymbolId) -> f64 {
    values.iter().find(|(s, _)| *s == symbol).map_or(f64::NAN, |(_, v)| *v)
}
