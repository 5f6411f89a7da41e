//! Functions of time as sums of harmonics: e = mean + Σ c_k cos(ν_k t) + s_k sin(ν_k t), exactly.
//!
//! Sums, products and whole powers of sines and cosines of arguments affine in time are such sums; products are split by
//! 2 cos α cos β = cos(α - β) + cos(α + β) and its companions. Other periodic functions of time are kept whole, each a [`Waveform`] times
//! a factor free of time. Everything else that depends on time is neither.

use crate::waveform::{Waveform, waveform};
use crate::{Expr, Function, Graph, Node, Rational, SymbolId};
use rustc_hash::FxHashMap;

/// c cos(ν t) + s sin(ν t).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wave {
    /// ν, free of time.
    pub rate: Expr,
    /// c.
    pub cos: Expr,
    /// s.
    pub sin: Expr,
}

/// An expression as a sum of harmonics. Rates are distinct, none is the opposite of another.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Harmonics {
    /// The part free of time.
    pub mean: Expr,
    /// Sines and cosines.
    pub waves: Vec<Wave>,
    /// Other periodic functions: waveform and factor.
    pub forms: Vec<(Waveform, Expr)>,
}

/// Products with more harmonics than this are given up.
const MOST_WAVES: usize = 64;
/// Largest power of a harmonic that is multiplied out.
const LARGEST_POWER: i64 = 4;

/// Decides on which side of zero a guard is that depends on time; none when that is not known.
pub type Decide<'d> = dyn FnMut(&mut Graph, Expr) -> Option<bool> + 'd;

/// A decomposition; remembers its results, so use one for many expressions.
pub struct Decomposition<'d> {
    time: SymbolId,
    /// What moves with the machine, and so belongs to no waveform.
    states: Vec<SymbolId>,
    decide: &'d mut Decide<'d>,
    memo: FxHashMap<Expr, Option<Harmonics>>,
}

impl<'d> Decomposition<'d> {
    /// By the symbols of time and of the states; `decide` settles switches whose guard depends on time: whether the guard is not negative.
    pub fn new(time: SymbolId, states: &[SymbolId], decide: &'d mut Decide<'d>) -> Decomposition<'d> {
        Decomposition { time, states: states.to_vec(), decide, memo: FxHashMap::default() }
    }

    /// The harmonics of `e`; none when it depends on time in another way.
    pub fn apply(&mut self, graph: &mut Graph, e: Expr) -> Option<Harmonics> {
        for e in graph.pending(&[e], &self.memo) {
            let found = self.step(graph, e).or_else(|| self.form(graph, e));
            self.memo.insert(e, found);
        }
        self.memo[&e].clone()
    }

    fn step(&mut self, graph: &mut Graph, e: Expr) -> Option<Harmonics> {
        let constant = |e| Some(Harmonics::still(e));
        match graph.node(e).clone() {
            Node::Symbol(s) if s == self.time => None,
            Node::Number(_) | Node::Pi | Node::Symbol(_) => constant(e),
            Node::Sum { constant, terms } => self.sum(graph, &constant, &terms),
            Node::Product { coefficient, factors } => self.product(graph, &coefficient, &factors),
            Node::Call { function: function @ (Function::Sin | Function::Cos), arguments } => self.wave(graph, e, function, arguments[0]),
            Node::Switch { guard, then, otherwise, .. } => self.switch(graph, e, guard, (then, otherwise)),
            Node::Power { .. } | Node::Call { .. } => {
                let children = graph.children(e);
                self.still(graph, e, &children)
            }
        }
    }

    /// `e` when none of its operands moves, with switches in them settled.
    fn still(&self, graph: &mut Graph, e: Expr, children: &[Expr]) -> Option<Harmonics> {
        for c in children {
            self.memo.get(c)?.as_ref().filter(|h| h.is_still())?;
        }
        let replace = |c: Expr| self.memo.get(&c).and_then(|h| h.as_ref()).map_or(c, |h| h.mean);
        Some(Harmonics::still(graph.rebuild(e, replace)))
    }

    /// `e` as one waveform.
    fn form(&self, graph: &mut Graph, e: Expr) -> Option<Harmonics> {
        if graph.contains(e, |s| self.states.contains(&s)) {
            return None;
        }
        let found = waveform(graph, self.time, e)?;
        let (zero, one) = (graph.zero(), graph.one());
        Some(Harmonics { forms: vec![(found, one)], ..Harmonics::still(zero) })
    }

    fn switch(&mut self, graph: &mut Graph, e: Expr, guard: Expr, (then, otherwise): (Expr, Expr)) -> Option<Harmonics> {
        if graph.contains(guard, |s| s == self.time) {
            if let Some(found) = self.form(graph, e).or_else(|| self.chopped(graph, e)) {
                return Some(found);
            }
            let side = if (self.decide)(graph, guard)? { then } else { otherwise };
            return self.memo.get(&side)?.clone();
        }
        self.still(graph, e, &[guard, then, otherwise])
    }

    /// A periodic guard between two sides free of time: otherwise + (then - otherwise) χ with χ = 1 while the guard holds, else 0.
    fn chopped(&mut self, graph: &mut Graph, e: Expr) -> Option<Harmonics> {
        let Node::Switch { guard, edge, then, otherwise } = graph.node(e).clone() else { return None };
        let side = |e: Expr| self.memo.get(&e)?.as_ref().filter(|h| h.is_still()).map(|h| h.mean);
        let (then, otherwise) = (side(then)?, side(otherwise)?);
        let (zero, one) = (graph.zero(), graph.one());
        let switch = graph.switch(guard, edge, one, zero);
        let mut found = self.form(graph, switch)?;
        let difference = graph.sub(then, otherwise);
        found.forms.iter_mut().for_each(|f| f.1 = difference);
        found.mean = otherwise;
        Some(found)
    }

    /// sin(ν t + α) = sin α cos ν t + cos α sin ν t, and so on.
    fn wave(&mut self, graph: &mut Graph, e: Expr, function: Function, argument: Expr) -> Option<Harmonics> {
        if !graph.contains(argument, |s| s == self.time) {
            return Some(Harmonics::still(e));
        }
        let rate = graph.derivative(argument, self.time);
        if graph.contains(rate, |s| s == self.time) || graph.is_zero(rate) {
            return None;
        }
        let zero = graph.zero();
        let phase = crate::Substitution::new([(self.time, zero)]).apply(graph, argument);
        let (s, c) = (graph.call(Function::Sin, &[phase]), graph.call(Function::Cos, &[phase]));
        let (cos, sin) = if function == Function::Sin { (s, c) } else { (c, graph.neg(s)) };
        let mut found = Harmonics::still(zero);
        found.add(graph, Wave { rate, cos, sin });
        Some(found)
    }

    fn sum(&self, graph: &mut Graph, constant: &Rational, terms: &[(Expr, Rational)]) -> Option<Harmonics> {
        let mut means = Vec::with_capacity(terms.len());
        let mut found = Harmonics::still(graph.zero());
        for (term, factor) in terms {
            let part = self.memo.get(term)?.clone()?;
            means.push((part.mean, factor.clone()));
            for (form, own) in part.forms {
                let own = graph.scale(own, factor);
                found.add_form(graph, form, own);
            }
            for wave in part.waves {
                let (cos, sin) = (graph.scale(wave.cos, factor), graph.scale(wave.sin, factor));
                found.add(graph, Wave { cos, sin, ..wave });
            }
        }
        found.mean = graph.linear(constant.clone(), &means);
        Some(found)
    }

    fn product(&self, graph: &mut Graph, coefficient: &Rational, factors: &[(Expr, Rational)]) -> Option<Harmonics> {
        let mut still: Vec<(Expr, Rational)> = Vec::new();
        let mut moving: Vec<(Harmonics, Expr, Rational)> = Vec::new();
        for (base, exponent) in factors {
            let part = self.memo.get(base)?.clone()?;
            if part.is_still() {
                still.push((part.mean, exponent.clone()));
                continue;
            }
            moving.push((part, *base, exponent.clone()));
        }
        let outer = Harmonics::still(graph.monomial(coefficient.clone(), &still));
        if let Some(found) = expanded(graph, &outer, &moving) {
            return Some(found);
        }
        let whole: Vec<(Expr, Rational)> = moving.into_iter().map(|(_, base, exponent)| (base, exponent)).collect();
        let whole = graph.monomial(Rational::ONE, &whole);
        self.form(graph, whole)?.times(graph, &outer)
    }
}

/// The product of sums of harmonics; none when it has too many terms, or when two waveforms meet.
fn expanded(graph: &mut Graph, outer: &Harmonics, moving: &[(Harmonics, Expr, Rational)]) -> Option<Harmonics> {
    let mut found = outer.clone();
    for (factor, _, exponent) in moving {
        let power = exponent.to_i64().filter(|n| (1..=LARGEST_POWER).contains(n))?;
        for _ in 0..power {
            found = found.times(graph, factor)?;
        }
    }
    Some(found)
}

impl Harmonics {
    /// What does not depend on time.
    pub fn still(mean: Expr) -> Harmonics {
        Harmonics { mean, waves: Vec::new(), forms: Vec::new() }
    }

    /// Whether it does not depend on time.
    pub fn is_still(&self) -> bool {
        self.waves.is_empty() && self.forms.is_empty()
    }

    fn add_form(&mut self, graph: &mut Graph, form: Waveform, factor: Expr) {
        match self.forms.iter_mut().find(|(f, _)| *f == form) {
            Some((_, own)) => *own = graph.add(*own, factor),
            None => self.forms.push((form, factor)),
        }
        self.forms.retain(|(_, factor)| !graph.is_zero(*factor));
    }

    /// Adds a wave to the one of the same rate.
    fn add(&mut self, graph: &mut Graph, wave: Wave) {
        if graph.is_zero(wave.cos) && graph.is_zero(wave.sin) {
            return;
        }
        if graph.is_zero(wave.rate) {
            self.mean = graph.add(self.mean, wave.cos);
            return;
        }
        let wave = canonical(graph, wave);
        match self.waves.iter().position(|w| w.rate == wave.rate) {
            Some(i) => {
                let (cos, sin) = (graph.add(self.waves[i].cos, wave.cos), graph.add(self.waves[i].sin, wave.sin));
                self.waves[i] = Wave { cos, sin, ..wave };
                if graph.is_zero(cos) && graph.is_zero(sin) {
                    self.waves.remove(i);
                }
            }
            None => self.waves.push(wave),
        }
    }

    fn times(&self, graph: &mut Graph, other: &Harmonics) -> Option<Harmonics> {
        if (!self.forms.is_empty() && !other.is_still()) || (!other.forms.is_empty() && !self.is_still()) {
            return None;
        }
        let mut found = Harmonics::still(graph.mul(self.mean, other.mean));
        for (mean, forms) in [(self.mean, &other.forms), (other.mean, &self.forms)] {
            for (form, factor) in forms {
                let factor = graph.mul(mean, *factor);
                found.add_form(graph, *form, factor);
            }
        }
        for (mean, waves) in [(self.mean, &other.waves), (other.mean, &self.waves)] {
            for wave in waves {
                let (cos, sin) = (graph.mul(mean, wave.cos), graph.mul(mean, wave.sin));
                found.add(graph, Wave { cos, sin, ..*wave });
            }
        }
        for a in &self.waves {
            for b in &other.waves {
                split(graph, &mut found, *a, *b);
            }
            if found.waves.len() > MOST_WAVES {
                return None;
            }
        }
        Some(found)
    }
}

/// (a_c cos α + a_s sin α)(b_c cos β + b_s sin β) as waves of α - β and α + β.
fn split(graph: &mut Graph, found: &mut Harmonics, a: Wave, b: Wave) {
    let [cc, ss, cs, sc] = [(a.cos, b.cos), (a.sin, b.sin), (a.cos, b.sin), (a.sin, b.cos)].map(|(x, y)| graph.mul(x, y));
    let half = |graph: &mut Graph, x: Expr, y: Expr, sign: Rational| {
        let y = graph.scale(y, &sign);
        let sum = graph.add(x, y);
        graph.scale(sum, &Rational::HALF)
    };
    let (difference, sum) = (graph.sub(a.rate, b.rate), graph.add(a.rate, b.rate));
    let (cos, sin) = (half(graph, cc, ss, Rational::ONE), half(graph, sc, cs, Rational::MINUS_ONE));
    found.add(graph, Wave { rate: difference, cos, sin });
    let (cos, sin) = (half(graph, cc, ss, Rational::MINUS_ONE), half(graph, sc, cs, Rational::ONE));
    found.add(graph, Wave { rate: sum, cos, sin });
}

/// Of ν and -ν the one that carries no leading minus, so that both are one wave.
fn canonical(graph: &mut Graph, wave: Wave) -> Wave {
    let opposite = graph.neg(wave.rate);
    let flip = match (graph.is_negative(wave.rate), graph.is_negative(opposite)) {
        (negative, other) if negative != other => negative,
        _ => opposite < wave.rate,
    };
    if flip { Wave { rate: opposite, cos: wave.cos, sin: graph.neg(wave.sin) } } else { wave }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The decomposition equals the expression at any instant.
    #[test]
    fn products_of_waves_are_sums_of_waves() {
        let mut g = Graph::new();
        let [t, p, w, a] = ["t", "p", "w", "a"].map(|n| g.var(n));
        let time = g.symbol_id("t", 0);
        let (pt, wt) = (g.mul(p, t), g.mul(w, t));
        let shifted = g.sub(a, wt);
        let (x, y) = (g.call(Function::Sin, &[pt]), g.call(Function::Cos, &[shifted]));
        let cube = g.pow(x, &Rational::from(3));
        let product = g.product(&[cube, y, a]);
        let e = g.add(product, y);
        let mut never = |_: &mut Graph, _: Expr| None;
        let found = Decomposition::new(time, &[], &mut never).apply(&mut g, e).expect("harmonic");
        let value = |s: SymbolId| [0.37, 1.3, 0.4, 0.9][s.index()];
        let mut sum = g.evaluate(&[found.mean], &value)[0];
        for wave in &found.waves {
            let v = g.evaluate(&[wave.rate, wave.cos, wave.sin], &value);
            sum += v[1] * (v[0] * 0.37).cos() + v[2] * (v[0] * 0.37).sin();
        }
        let direct = g.evaluate(&[e], &value)[0];
        // units of the last place of a sum of a few terms
        assert!((sum - direct).abs() < 1e-15, "{sum} {direct}");
        assert_eq!(found.waves.len(), 5);
    }

    #[test]
    fn growth_is_not_harmonic() {
        let mut g = Graph::new();
        let t = g.var("t");
        let time = g.symbol_id("t", 0);
        let s = g.call(Function::Sin, &[t]);
        let e = g.mul(t, s);
        let mut never = |_: &mut Graph, _: Expr| None;
        assert_eq!(Decomposition::new(time, &[], &mut never).apply(&mut g, e), None);
    }
}
