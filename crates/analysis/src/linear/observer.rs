//! Formulas of a machine near a state: what they show of its small motions.

use std::sync::Arc;

use program::{Evaluator, Point, Tape, lower};
use symbolic::{Derivation, Expr, SymbolId};

use super::machine::values::Values;
use super::machine::{LinearMachine, Place};
use super::reactions::{LoadParts, Reactions};
use super::seen::Seen;
use crate::Fault;

/// Formulas near a state as a tape.
#[derive(Clone, Debug)]
pub struct Observer {
    n: usize,
    tape: Arc<Tape>,
    /// The mean of each formula.
    means: Vec<Expr>,
    /// Number of harmonics of each formula.
    rows: Vec<usize>,
    /// Waveforms of each formula.
    forms: Vec<Vec<usize>>,
    /// Formulas that had to be taken at t = 0: they change with time and do not repeat.
    pub frozen: Vec<usize>,
    /// Rows for the reactions in them.
    reactions: Option<Reactions>,
    /// Waveforms known to the tape.
    known: usize,
    /// Under a load alone: the formulas that depend on time by themselves. What they do so (the motion of a base) is no effect of the load, and is left out.
    pub timed: Option<Vec<usize>>,
    /// Formulas that are not linear in the reactions within them: their lines hold for small motions only.
    pub by_reactions: Vec<usize>,
    /// What oscillates in the slopes of each formula: level, coordinate.
    swings: Vec<Vec<(usize, usize)>>,
}

impl Observer {
    /// The formulas that, apart from the reactions in them, contain what time prescribes (the motion of a base).
    pub fn prescribed(&self) -> Vec<usize> {
        (0..self.rows.len()).filter(|k| self.rows[*k] > 0 || !self.forms[*k].is_empty()).collect()
    }
}

impl LinearMachine {
    /// An observer of formulas of the equations near the state, under the loads of the equations or under a load alone.
    ///
    /// *Errors*: a formula that cannot be lowered.
    pub fn observer(&mut self, formulas: &[Expr], load: Option<&LoadParts>) -> Result<Observer, Fault> {
        let reactions = self.rows_of_reactions(formulas, load)?;
        let mut roots = Vec::new();
        let (mut rows, mut forms, mut frozen, mut means) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let mut swings: Vec<Vec<(usize, usize)>> = Vec::new();
        for (k, formula) in formulas.iter().enumerate() {
            let output = self.linear.output(&self.equations, *formula);
            if output.frozen {
                frozen.push(k);
            }
            let mut push = |what: &str, e: Expr| roots.push((format!("output {} {what}", k + 1), e));
            push("mean", output.mean);
            means.push(output.mean);
            output.by_place.iter().for_each(|e| push("by q", *e));
            output.by_rate.iter().for_each(|e| push("by q'", *e));
            output.by_acceleration.iter().for_each(|e| push("by q''", *e));
            for wave in &output.waves {
                push("rate", wave.rate);
                push("cos", wave.cos);
                push("sin", wave.sin);
            }
            output.forms.iter().for_each(|(_, factor)| push("factor", *factor));
            output.swings.iter().for_each(|(.., e)| push("swing", *e));
            swings.push(output.swings.iter().map(|(level, j, _)| (*level, *j)).collect());
            rows.push(output.waves.len());
            forms.push(output.forms.iter().map(|f| f.0).collect::<Vec<usize>>());
        }
        let timed = |k: &usize| rows[*k] > 0 || !forms[*k].is_empty();
        let timed: Option<Vec<usize>> = load.map(|_| (0..formulas.len()).filter(timed).collect());
        self.learn()?;
        let inputs = if reactions.is_some() { self.with_reactions() } else { self.inputs.clone() };
        let tape = Arc::new(lower::expressions(&self.linear.graph, "observer", &inputs, &roots)?);
        Ok(Observer {
            n: self.names.len(),
            tape,
            means,
            rows,
            forms,
            frozen,
            reactions,
            known: self.shapes.len(),
            timed,
            by_reactions: self.bent_by_reactions(formulas),
            swings,
        })
    }

    fn bent_by_reactions(&mut self, formulas: &[Expr]) -> Vec<usize> {
        let reactions: Vec<SymbolId> = self.equations.reactions.iter().map(|r| r.symbol).collect();
        let graph = &mut self.linear.graph;
        let mut bends = |formula: Expr| {
            let own: Vec<SymbolId> = graph.symbols_in(&[formula]).into_iter().filter(|s| reactions.contains(s)).collect();
            own.iter().any(|symbol| {
                let one = graph.one();
                let slope = Derivation::new([(*symbol, one)]).apply(graph, formula);
                graph.contains(slope, |s| own.contains(&s))
            })
        };
        (0..formulas.len()).filter(|k| bends(formulas[*k])).collect()
    }

    /// Formulas of the equations without what time alone does to them, as functions of the whole state; zero for those over reactions.
    ///
    /// *Errors*: a formula that cannot be lowered.
    pub fn whole(&mut self, formulas: &[Expr]) -> Result<Values, Fault> {
        let zero = self.linear.graph.zero();
        let equations = Arc::clone(&self.equations);
        let over_reactions =
            |linear: &symbolic::Linear, e: Expr| linear.graph.contains(e, |s| equations.reactions.iter().any(|r| r.symbol == s));
        let one = |e: &Expr| if over_reactions(&self.linear, *e) { zero } else { self.linear.output(&equations, *e).whole };
        let list: Vec<Expr> = formulas.iter().map(one).collect();
        self.learn()?;
        self.prepare(&list)
    }

    /// Amplitudes |M₁|, |B₁|, |C₁| (row-major n x n each) of what oscillates in the coefficients, at a place.
    ///
    /// *Errors*: an entry has no finite value there.
    pub fn pulsation(&self, place: &Place) -> Result<[Vec<f64>; 3], Fault> {
        let square = self.names.len() * self.names.len();
        let list: Vec<Expr> = self.linear.pulsation.iter().map(|p| p.1).collect();
        let mut out = [(); 3].map(|()| vec![0.0; square]);
        for ((entry, _), value) in self.linear.pulsation.iter().zip(self.values_of(&list, place)?) {
            out[entry / square][entry % square] += value.abs();
        }
        Ok(out)
    }

    /// Whether slopes of its formulas, or of the rows of their reactions, may oscillate in time.
    pub fn swings(&self, observer: &Observer) -> bool {
        observer.swings.iter().any(|s| !s.is_empty()) || observer.reactions.as_ref().is_some_and(Reactions::swing)
    }

    /// What an observer sees at a place, with the parameters as they are now.
    ///
    /// *Errors*: an output has no finite value there.
    pub fn observe(&self, observer: &Observer, place: &Place) -> Result<Vec<Seen>, Fault> {
        let mut evaluator = Evaluator::new(&observer.tape, &self.values)?;
        let reactions = match &observer.reactions {
            Some(prepared) => self.reactions_at(prepared, place)?,
            None => Vec::new(),
        };
        let states = match &observer.reactions {
            Some(_) => self.states_with(place, observer.known, &reactions),
            None => self.states(place),
        };
        let values = evaluator.evaluate(&Point { states: &states, accelerations: &place.accelerations, ..Point::default() })?.to_vec();
        let bounds = evaluator.root_roundings();
        let n = observer.n;
        let mut rest = &values[..];
        let mut take = |k: usize| {
            let (head, tail) = rest.split_at(k);
            rest = tail;
            head.to_vec()
        };
        // a difference of terms that is rounding is zero
        let mut first = 0;
        let mut mean = |further: usize| {
            let at = first;
            first += 1 + 3 * n + further;
            if values[at].abs() <= bounds[at] { 0.0 } else { values[at] }
        };
        let seen = observer.rows.iter().zip(&observer.forms).zip(&observer.swings).map(|((waves, forms), swings)| {
            let mut seen = Seen {
                mean: (take(1), mean(3 * waves + forms.len() + swings.len())).1,
                by_place: take(n),
                by_rate: take(n),
                by_acceleration: take(n),
                waves: (0..*waves).map(|_| take(3)).map(|w| (w[0], w[1], w[2])).collect(),
                forms: forms.iter().map(|form| (*form, take(1)[0])).collect(),
                ..Seen::default()
            };
            swings.iter().for_each(|at| seen.swing(*at, take(1)[0]));
            seen
        });
        let mut seen: Vec<Seen> = seen.collect();
        if !place.below.is_empty() {
            // the force of a hard spring is a difference below the last digits of the place
            for (seen, mean) in seen.iter_mut().zip(&observer.means) {
                self.doubles(&[*mean], place).into_iter().for_each(|found| seen.mean = found[0].round());
            }
        }
        for k in observer.timed.iter().flatten() {
            (seen[*k].waves, seen[*k].forms) = Default::default();
        }
        if let Some(prepared) = &observer.reactions {
            self.add_reactions(prepared, place, &reactions, &mut seen)?;
        }
        Ok(seen)
    }
}
