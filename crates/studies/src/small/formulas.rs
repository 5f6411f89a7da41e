//! The equations of small motions as formulas, M q'' + B q' + C q = loads, while they stay readable.

use crate::small::Small;
use symbolic::equations::Equality;
use symbolic::{Equations, Expr, Function, Graph, Linear, Node, Substitution, SymbolId};

/// More coordinates than this are not written out.
const LARGEST: usize = 6;
/// More nodes than this are not read by anybody.
const LONGEST: usize = 400;
/// Coordinates nearer to a simple exact value than this are taken to be it.
const NEAR: f64 = 1e-12;

/// Equations in the user's symbols; coordinates stand for deviations from the equilibrium.
#[derive(Clone, Debug)]
pub struct Written {
    /// Owner of the formulas; its symbols are those of the equations of motion.
    pub graph: Graph,
    /// One for each coordinate.
    pub equations: Vec<Equality>,
}

/// The linear system with the exact place put in, where it is exactly known: zero, or the start. None when a coefficient still contains a
/// coordinate.
pub fn at_place(equations: &Equations, small: &Small) -> Option<Linear> {
    let still = |linear: &mut Linear, (symbol, _): (SymbolId, Expr)| {
        let e = linear.graph.symbol(symbol);
        Some(small.machine.values_of(&[e], &small.place).ok()?[0] > 0.0)
    };
    placed(small.machine.linear().clone(), (equations, small), still)
}

/// The same for any linear system of these equations; `still` says whether a rate vanishes.
fn placed(
    mut linear: Linear,
    (equations, small): (&Equations, &Small),
    still: impl Fn(&mut Linear, (SymbolId, Expr)) -> Option<bool>,
) -> Option<Linear> {
    let mut place: Vec<(SymbolId, Expr)> = Vec::new();
    for (coordinate, q) in equations.coordinates.iter().zip(&small.place.q) {
        let start = small.machine.values_of(&[coordinate.start], &small.place).ok()?[0];
        let e = match () {
            () if q.abs() <= NEAR => linear.graph.zero(),
            () if (q - start).abs() <= NEAR * q.abs() => coordinate.start,
            () => continue,
        };
        place.push((coordinate.symbols[0], e));
    }
    for (symbol, formula) in linear.stills.list.clone() {
        let still = still(&mut linear, (symbol, formula))?;
        place.push((symbol, if still { linear.graph.one() } else { linear.graph.zero() }));
    }
    let linear = linear.at(&place);
    let coordinate = |s: SymbolId| linear.coordinates.iter().any(|c| c.contains(&s)) || linear.multipliers.contains(&s);
    let shaped = linear.shaped.iter().flat_map(|(_, factors)| factors);
    let loads = linear.loads.iter().flat_map(|l| l.cos.iter().chain(&l.sin)).chain(shaped);
    let entries = linear.mass.entries().iter().chain(linear.damping.entries()).chain(linear.stiffness.entries()).chain(loads);
    let entries: Vec<Expr> = entries.copied().collect();
    let open = entries.iter().any(|e| linear.graph.contains(*e, coordinate)) || divides_by_zero(&linear.graph, &entries);
    (!open).then_some(linear)
}

/// Whether a zero stands in a denominator: a length that vanishes in the exact place, of which the numbers beside it show the limit.
fn divides_by_zero(graph: &Graph, entries: &[Expr]) -> bool {
    graph.reachable(entries).into_iter().any(|e| match graph.node(e) {
        Node::Product { factors, .. } => factors.iter().any(|(base, exponent)| exponent.to_f64() < 0.0 && graph.is_zero(*base)),
        _ => false,
    })
}

/// The equations, when they are short enough.
pub fn write(equations: &Equations, small: &Small) -> Option<Written> {
    let n = equations.coordinates.len();
    if n > LARGEST || !small.machine.linear().conditions.is_empty() {
        return None;
    }
    let mut linear = match stepped(small.machine.equations()) {
        Some((named, values)) => {
            let find = |s: SymbolId| values.iter().find(|(n, _)| *n == s).map_or(f64::NAN, |(_, v)| *v);
            let still = |linear: &mut Linear, (_, formula): (SymbolId, Expr)| Some(linear.graph.evaluate(&[formula], &find)[0] > 0.0);
            placed(Linear::new(&named, small.machine.linear().about), (equations, small), still)?
        }
        None => at_place(equations, small)?,
    };
    let means = means(small, &mut linear.graph);
    let linear = linear.at(&means);
    let mut graph = linear.graph.clone();
    let mut list = Vec::with_capacity(n);
    for i in 0..n {
        let mut terms = Vec::new();
        for (matrix, order) in [(&linear.mass, 2), (&linear.damping, 1), (&linear.stiffness, 0)] {
            for j in 0..n {
                let q = graph.symbol(linear.coordinates[j][order]);
                terms.push(graph.mul(matrix.get(i, j), q));
            }
        }
        let left = graph.sum(&terms);
        let mut waves = Vec::new();
        for load in &linear.loads {
            let time = graph.symbol(linear.time());
            let argument = graph.mul(load.rate, time);
            for (function, amplitude) in [(Function::Cos, load.cos[i]), (Function::Sin, load.sin[i])] {
                let wave = graph.call(function, &[argument]);
                waves.push(graph.mul(amplitude, wave));
            }
        }
        for (form, factors) in &linear.shaped {
            let wave = waveform(&linear, *form, &mut graph);
            let mean = means[*form].1;
            // the mean stands in the equilibrium
            waves.push(graph.mul(factors[i], wave));
            let level = graph.mul(factors[i], mean);
            waves.push(graph.neg(level));
        }
        let right = graph.sum(&waves);
        if graph.reachable(&[left, right]).len() > LONGEST {
            return None;
        }
        list.push(Equality { left, right });
    }
    Some(Written { graph, equations: list })
}

/// The equations with quantities that time switches between constants as constants: in print they stay letters with a unit, and do not become the number
/// that they begin with; with the values of parameters and definitions. None where there is none.
fn stepped(equations: &Equations) -> Option<(Equations, Vec<(SymbolId, f64)>)> {
    let mut named = equations.clone();
    let mut values: Vec<(SymbolId, f64)> = vec![(equations.time, 0.0)];
    values.extend(equations.parameters.iter().map(|p| (p.symbol, p.value)));
    let mut some = false;
    for definition in &mut named.definitions {
        let find = |s: SymbolId| values.iter().find(|(n, _)| *n == s).map_or(f64::NAN, |(_, v)| *v);
        let timed = |graph: &Graph, e| graph.contains(e, |s| s == equations.time);
        if timed(&named.graph, definition.formula)
            && let Some(branch) = at_start(&mut named.graph, definition.formula, (equations.time, &find))
            && !timed(&named.graph, branch)
        {
            definition.formula = branch;
            some = true;
        }
        let value = named.graph.evaluate(&[definition.formula], &find)[0];
        values.push((definition.symbol, value));
    }
    some.then_some((named, values))
}

/// What a switch is just after t = 0; none where its guard has no value there.
fn at_start(graph: &mut Graph, mut e: Expr, (time, find): (SymbolId, &dyn Fn(SymbolId) -> f64)) -> Option<Expr> {
    while let Node::Switch { guard, then, otherwise, .. } = *graph.node(e) {
        let rate = graph.derivative(guard, time);
        let at = graph.evaluate(&[guard, rate], find);
        let side = if at[0] == 0.0 { at[1] } else { at[0] };
        if !side.is_finite() {
            return None;
        }
        e = if side >= 0.0 { then } else { otherwise };
    }
    Some(e)
}

/// Digits of the mean of a waveform in print.
const DIGITS: usize = 6;
/// Means below this share of the waveform's harmonics are zero.
const LEVEL: f64 = 1e-12;

/// The means of the waveforms over a period as numbers of [`DIGITS`] digits, for the parameters as they are.
fn means(small: &Small, graph: &mut Graph) -> Vec<(SymbolId, Expr)> {
    let number = |shape: &analysis::waveform::Shape| {
        let wave = &shape.wave;
        let size = wave.cos.iter().chain(&wave.sin).fold(0.0_f64, |m, v| m.max(v.abs()));
        if wave.mean.abs() <= LEVEL * size { None } else { symbolic::Rational::parse_decimal(&format!("{:.*e}", DIGITS - 1, wave.mean)) }
    };
    let mut list = Vec::new();
    for (form, shape) in small.machine.linear().forms.iter().zip(small.machine.shapes()) {
        let mean = match number(shape) {
            Some(r) => graph.number(r),
            None => graph.zero(),
        };
        list.push((form.mean, mean));
    }
    list
}

/// A waveform as a formula of time.
fn waveform(linear: &Linear, form: usize, graph: &mut Graph) -> Expr {
    let wave = linear.forms[form].wave;
    let time = graph.symbol(linear.time());
    let phase = graph.mul(wave.rate, time);
    Substitution::new([(linear.time(), phase)]).apply(graph, wave.shape)
}
