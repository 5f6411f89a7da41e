//! Reactions near a state of rest.
//!
//! With all reactions λ, the equations of motion and the balances of released bodies are rows
//!
//! ```text
//! e(q, q', q'', t) - A(q) λ = 0,     e = M q'' - h,  or  m_b q'' - rest_b
//! ```
//!
//! At rest λ0 = A⁺ e. Nearby, with r = e - A λ0 as a function of the state,
//!
//! ```text
//! δλ = A⁺ (∂r/∂q δq + ∂r/∂q' δq' + ∂r/∂q'' δq'' + r's harmonics)
//! ```
//!
//! There are at least as many rows as reactions, and they agree where δq is a motion of the machine. A quantity y(q, q', q'', t, λ) then has, by the chain rule
//! with ∂y/∂λ, the same form as one without reactions. Dry friction and open contacts are left out, as in all small motions; contacts that are closed at the place stay closed.

use std::sync::Arc;
use words::Message;

use program::lower::{self, Inputs};
use program::{Evaluator, Point, Tape};
use symbolic::connections::Law;
use symbolic::{Expr, SymbolId};
use words::Text;

use super::machine::{LinearMachine, Place};
use super::seen::Seen;
use crate::Fault;
use algebra::elementary;
use algebra::qr::{DEPENDENT, Qr};
use symbolic::linear::LinearOutput;

/// The number of waves of a row and the forms that follow them.
type Waves = (usize, Vec<usize>);
/// Levels of derivative and coordinates with which a row swings.
type Swings = Vec<(usize, usize)>;

/// Entries of the rows below this many bounds of their rounding are zero.
const SURE: f64 = 16.0;
/// What excites, where it is not everything in the equations.
#[derive(Clone, Debug, Default)]
pub struct LoadParts {
    /// (index of a coordinate, generalized force).
    pub forces: Vec<(usize, Expr)>,
    /// (index of a balance, work there).
    pub released: Vec<(usize, Expr)>,
}

/// Rows and outputs as a tape.
#[derive(Clone, Debug)]
pub(super) struct Reactions {
    /// By index in the equations.
    unknowns: Vec<usize>,
    /// Number of rows.
    rows: usize,
    tape: Arc<Tape>,
    /// The mean of each row.
    means: Vec<Expr>,
    /// The same without the slopes of formulas by reactions, which need their values.
    balances: Arc<Tape>,
    /// Waveforms known to the tape.
    forms: usize,
    /// (row, unknown) of the entries of A.
    entries: Vec<(usize, usize)>,
    /// Number of amplitudes of what oscillates in each entry.
    pulses: Vec<usize>,
    /// Harmonics and waveforms of each row's load.
    waves: Vec<Waves>,
    /// What oscillates in each row's slopes: level, coordinate.
    swings: Vec<Swings>,
    /// (output, reaction) of the slopes ∂y/∂λ, and the number of amplitudes of what oscillates in each.
    slopes: Vec<(usize, usize, usize)>,
    /// Where the rows' loads come from.
    named: bool,
}

/// What rows have of the motion and of their loads.
struct ForcedRows {
    waves: Vec<Waves>,
    swings: Vec<Swings>,
    means: Vec<Expr>,
}

/// A row near the state.
#[derive(Clone, Debug, Default)]
struct Row {
    mean: f64,
    by: [Vec<f64>; 3],
    /// Bounds of the rounding in `by`.
    roundings: [Vec<f64>; 3],
    /// The mean, sines and waveforms of what excites it.
    load: f64,
    waves: Vec<(f64, f64, f64)>,
    forms: Vec<(usize, f64)>,
    /// Level, coordinate and amplitude of what oscillates in the slopes.
    swings: Vec<(usize, usize, f64)>,
}

/// Reactions near the state: values, and what a unit of each row gives to each.
struct Solved {
    values: Vec<f64>,
    /// A⁺, row-major: unknowns by rows.
    inverse: Vec<f64>,
    /// Combinations of unknowns that the rows leave open.
    open: Vec<Vec<f64>>,
}

impl LinearMachine {
    /// Symbols of all reactions, as far as they are no states already.
    pub(super) fn reaction_symbols(&self) -> Vec<SymbolId> {
        let all = self.equations.reactions.iter().map(|r| r.symbol);
        all.filter(|s| !self.linear.multipliers.contains(s)).collect()
    }

    /// Whether a formula contains a reaction, directly or through definitions.
    pub fn asks_for_reactions(&self, formula: Expr) -> bool {
        let graph = &self.linear.graph;
        let mut all = vec![formula];
        let found = graph.symbols_in(&all);
        all.extend(self.equations.definitions.iter().filter(|d| found.contains(&d.symbol)).map(|d| d.formula));
        let found = graph.symbols_in(&all);
        self.equations.reactions.iter().any(|r| found.contains(&r.symbol))
    }

    /// A unit load on a coordinate. It has no place on a body.
    ///
    /// *Errors*: S089 for a formula with a reaction that depends on the place.
    pub fn unit_load(&mut self, coordinate: usize, formulas: &[Expr]) -> Result<LoadParts, Fault> {
        let hidden = self.equations.reactions.iter().filter(|r| r.law.is_hidden());
        for reaction in hidden {
            if formulas.iter().any(|f| self.linear.graph.contains(*f, |s| s == reaction.symbol)) {
                return Err(without_amplitude(&reaction.name, Why::NoPlace));
            }
        }
        let one = self.linear.graph.one();
        Ok(LoadParts { forces: vec![(coordinate, one)], released: Vec::new() })
    }

    /// Rows for the reactions in formulas; none where no formula asks for one.
    pub(super) fn rows_of_reactions(&mut self, formulas: &[Expr], load: Option<&LoadParts>) -> Result<Option<Reactions>, Fault> {
        if !formulas.iter().any(|f| self.asks_for_reactions(*f)) {
            return Ok(None);
        }
        let equations = Arc::clone(&self.equations);
        let acts = |law: &Law| matches!(law, Law::Ideal { .. } | Law::Motor) || law.is_hidden();
        let unknowns: Vec<usize> = (0..equations.reactions.len()).filter(|k| acts(&equations.reactions[*k].law)).collect();
        let n = equations.coordinates.len();
        let rows = n + equations.balances.len();
        let mut roots: Vec<(String, Expr)> = Vec::new();
        let (mut entries, mut pulses) = (Vec::new(), Vec::new());
        let mut sums: Vec<Vec<Expr>> = vec![Vec::new(); rows];
        for (k, r) in unknowns.iter().enumerate() {
            let reaction = &equations.reactions[*r];
            let places = reaction.forces.iter().map(|(i, e)| (*i, *e)).chain(reaction.released.iter().map(|(b, e)| (n + b, *e)));
            for (row, e) in places {
                let entry = self.linear.output(&equations, e);
                roots.push((format!("A {row} {k}"), entry.mean));
                pulses.push(push_pulses(&mut roots, &entry));
                entries.push((row, k));
                let graph = &mut self.linear.graph;
                let symbol = graph.symbol(reaction.symbol);
                let force = graph.mul(e, symbol);
                sums[row].push(graph.neg(force));
            }
        }
        self.add_balances(&mut sums);
        let ForcedRows { waves, swings, means } = self.forced_rows(&sums, load, &mut roots);
        let alone = roots.len();
        let slopes = self.slopes_by_reactions(formulas, &mut roots);
        self.learn()?;
        let inputs = self.with_reactions();
        // formulas such as a magnitude have no slope before the reactions are known
        let balances = Arc::new(lower::expressions(&self.linear.graph, "balances", &inputs, &roots[..alone])?);
        let tape = Arc::new(lower::expressions(&self.linear.graph, "reactions", &inputs, &roots)?);
        Ok(Some(Reactions {
            unknowns,
            rows,
            tape,
            means,
            balances,
            forms: self.shapes.len(),
            entries,
            pulses,
            waves,
            swings,
            slopes,
            named: load.is_some(),
        }))
    }

    /// What each row has of the motion itself and of its load: the levels of its waves and of what swings.
    fn forced_rows(&mut self, sums: &[Vec<Expr>], load: Option<&LoadParts>, roots: &mut Vec<(String, Expr)>) -> ForcedRows {
        let equations = Arc::clone(&self.equations);
        let (mut waves, mut swings, mut means) = (Vec::new(), Vec::new(), Vec::new());
        for (row, sum) in sums.iter().enumerate() {
            let formula = self.linear.graph.sum(sum);
            let own = self.linear.output(&equations, formula);
            roots.push((format!("row {row}"), own.mean));
            means.push(own.mean);
            let by = own.by_place.iter().chain(&own.by_rate).chain(&own.by_acceleration);
            roots.extend(by.map(|e| (format!("row {row}"), *e)));
            roots.extend(own.swings.iter().map(|(.., e)| (format!("swing {row}"), *e)));
            swings.push(own.swings.iter().map(|(level, j, _)| (*level, *j)).collect());
            let excited = load.map_or(own, |parts| self.excited(parts, row));
            roots.push((format!("load {row}"), excited.mean));
            for wave in &excited.waves {
                roots.extend([wave.rate, wave.cos, wave.sin].map(|e| (format!("wave {row}"), e)));
            }
            roots.extend(excited.forms.iter().map(|(_, factor)| (format!("factor {row}"), *factor)));
            waves.push((excited.waves.len(), excited.forms.iter().map(|f| f.0).collect()));
        }
        ForcedRows { waves, swings, means }
    }

    /// What a load alone gives to a row.
    fn excited(&mut self, load: &LoadParts, row: usize) -> LinearOutput {
        let equations = Arc::clone(&self.equations);
        let n = equations.coordinates.len();
        let (list, i) = if row < n { (&load.forces, row) } else { (&load.released, row - n) };
        let terms: Vec<Expr> = list.iter().filter(|(k, _)| *k == i).map(|(_, e)| *e).collect();
        let sum = self.linear.graph.sum(&terms);
        let against = self.linear.graph.neg(sum);
        self.linear.output(&equations, against)
    }

    /// Adds the inertia and the loads of each equation of motion and of each balance to its sum.
    fn add_balances(&mut self, sums: &mut [Vec<Expr>]) {
        let equations = Arc::clone(&self.equations);
        let n = equations.coordinates.len();
        for (row, sum) in sums.iter_mut().enumerate() {
            let graph = &mut self.linear.graph;
            if row < n {
                for (j, c) in equations.coordinates.iter().enumerate() {
                    let a = graph.symbol(c.symbols[2]);
                    sum.push(graph.mul(equations.mass.get(row, j), a));
                }
                sum.push(graph.neg(equations.force[row]));
            } else {
                let balance = &equations.balances[row - n];
                for (j, e) in &balance.columns {
                    let a = graph.symbol(equations.coordinates[*j].symbols[2]);
                    sum.push(graph.mul(*e, a));
                }
                sum.push(graph.neg(balance.rest));
            }
        }
    }

    /// How formulas depend on reactions: (formula, reaction), each with a root of its own.
    fn slopes_by_reactions(&mut self, formulas: &[Expr], roots: &mut Vec<(String, Expr)>) -> Vec<(usize, usize, usize)> {
        let equations = Arc::clone(&self.equations);
        let mut slopes = Vec::new();
        for (output, formula) in formulas.iter().enumerate() {
            for (r, reaction) in equations.reactions.iter().enumerate() {
                let slope = self.linear.graph.derivative(*formula, reaction.symbol);
                if !self.linear.graph.is_zero(slope) {
                    let slope = self.linear.output(&equations, slope);
                    roots.push((format!("slope {output}"), slope.mean));
                    slopes.push((output, r, push_pulses(roots, &slope)));
                }
            }
        }
        slopes
    }

    /// The inputs of tapes that read reactions: those of all tapes, then the reactions.
    pub(super) fn with_reactions(&self) -> Inputs {
        let mut inputs = self.inputs.clone();
        inputs.states.extend(self.reaction_symbols());
        inputs
    }

    /// States for such tapes, `forms` waveforms long.
    pub(super) fn states_with(&self, place: &Place, forms: usize, reactions: &[f64]) -> Vec<f64> {
        let mut states = self.states(place);
        let first = 2 * self.names.len();
        states.truncate(first + self.linear.multipliers.len() + forms);
        for (i, symbol) in self.linear.multipliers.iter().enumerate() {
            if let Some(value) = self.equations.reactions.iter().position(|r| r.symbol == *symbol).and_then(|r| reactions.get(r)) {
                states[first + i] = *value;
            }
        }
        let rest = self.equations.reactions.iter().enumerate().filter(|(_, r)| !self.linear.multipliers.contains(&r.symbol));
        states.extend(rest.map(|(r, _)| reactions.get(r).copied().unwrap_or(0.0)));
        states
    }

    /// Values of all reactions at a place of rest; zero for those that do not act there.
    pub(super) fn reactions_at(&self, prepared: &Reactions, place: &Place) -> Result<Vec<f64>, Fault> {
        let nothing = vec![0.0; self.equations.reactions.len()];
        let Evaluated { matrix, rows, .. } = self.evaluate_rows(prepared, (&prepared.balances, &[]), place, &nothing)?;
        let solved = Solved::new(prepared, &matrix, &rows);
        let mut values = nothing;
        prepared.unknowns.iter().zip(&solved.values).for_each(|(r, v)| values[*r] = *v);
        Ok(values)
    }

    /// Adds to outputs what they have by the reactions in them.
    pub(super) fn add_reactions(&self, prepared: &Reactions, place: &Place, values: &[f64], seen: &mut [Seen]) -> Result<(), Fault> {
        let Evaluated { matrix, rows, slopes, pulses } = self.evaluate_rows(prepared, (&prepared.tape, &prepared.slopes), place, values)?;
        let solved = Solved::new(prepared, &matrix, &rows);
        for (output, y) in seen.iter_mut().enumerate() {
            let mut share = vec![0.0; prepared.unknowns.len()];
            for ((_, r, _), (slope, pulse)) in prepared.slopes.iter().zip(&slopes).filter(|((o, ..), _)| *o == output) {
                let Some(k) = prepared.unknowns.iter().position(|u| u == r) else {
                    return Err(without_amplitude(&self.equations.reactions[*r].name, Why::LeftOut));
                };
                share[k] += slope;
                solved.swing((k, *pulse), &rows, y);
            }
            if share.iter().all(|s| *s == 0.0) {
                continue;
            }
            solved.refuse_open(&share, |k| self.equations.reactions[prepared.unknowns[k]].name.as_str())?;
            let mut doubt = Doubt::of(y);
            for (i, row) in rows.iter().enumerate() {
                let part = |k: usize| share[k] * solved.inverse[k * prepared.rows + i];
                let (gain, terms) = (0..share.len()).map(part).fold((0.0, 0.0), |(sum, terms), v| (sum + v, terms + v.abs()));
                if gain != 0.0 {
                    row.add(gain, y);
                    if prepared.named {
                        y.constant += gain * row.load;
                    }
                }
                doubt.add(row, terms);
                for ((_, k), pulse) in prepared.entries.iter().zip(&pulses).filter(|((r, _), p)| *r == i && **p > 0.0) {
                    solved.swing((*k, gain * pulse), &rows, y);
                }
            }
            doubt.settle(y);
        }
        Ok(())
    }

    fn evaluate_rows(
        &self,
        prepared: &Reactions,
        (tape, slopes): (&Arc<Tape>, &[(usize, usize, usize)]),
        place: &Place,
        values: &[f64],
    ) -> Result<Evaluated, Fault> {
        let mut evaluator = Evaluator::new(tape, &self.values)?;
        let states = self.states_with(place, prepared.forms, values);
        let found = evaluator.evaluate(&Point { states: &states, accelerations: &place.accelerations, ..Point::default() })?.to_vec();
        let bounds = evaluator.root_roundings();
        let (n, k) = (self.names.len(), prepared.unknowns.len());
        let mut at = 0;
        let mut take = |count: usize| {
            at += count;
            (&found[at - count..at], &bounds[at - count..at])
        };
        let mut matrix = vec![0.0; prepared.rows * k];
        let mut entry_pulses = Vec::with_capacity(prepared.entries.len());
        for ((row, column), pulses) in prepared.entries.iter().zip(&prepared.pulses) {
            let (value, rounding) = take(1);
            // an entry that may be rounding is zero: rows and columns are scaled, and one of nothing but rounding would become an equation
            if value[0].abs() > SURE * rounding[0] {
                matrix[row * k + column] += value[0];
            }
            entry_pulses.push(sum_of_sizes(take(*pulses).0));
        }
        let mut rows: Vec<Row> = Vec::with_capacity(prepared.rows);
        for ((waves, forms), swings) in prepared.waves.iter().zip(&prepared.swings) {
            let (mean, rounding) = take(1);
            let mean = if mean[0].abs() <= rounding[0] { 0.0 } else { mean[0] };
            let slopes = [take(n), take(n), take(n)];
            let swings = swings.iter().map(|(level, j)| (*level, *j, take(1).0[0])).collect();
            let load = take(1).0[0];
            let waves = (0..*waves).map(|_| take(3).0).map(|w| (w[0], w[1], w[2])).collect();
            let forms = forms.iter().map(|form| (*form, take(1).0[0])).collect();
            rows.push(Row { mean, by: slopes.map(|s| s.0.to_vec()), roundings: slopes.map(|s| s.1.to_vec()), load, waves, forms, swings });
        }
        if !place.below.is_empty() {
            // forces of hard springs are differences below the last digits of the place
            let known = |s: SymbolId| self.equations.reactions.iter().position(|r| r.symbol == s).map(|r| values[r]);
            for (row, mean) in rows.iter_mut().zip(&prepared.means) {
                self.doubles_with(&[*mean], place, &known).into_iter().for_each(|found| row.mean = found[0].round());
            }
        }
        let slopes = slopes.iter().map(|(.., pulses)| (take(1).0[0], sum_of_sizes(take(*pulses).0))).collect();
        Ok(Evaluated { matrix, rows, slopes, pulses: entry_pulses })
    }
}

/// Roots for what oscillates in a factor; how many.
fn push_pulses(roots: &mut Vec<(String, Expr)>, factor: &LinearOutput) -> usize {
    let waves = factor.waves.iter().flat_map(|w| [w.cos, w.sin]);
    let all: Vec<Expr> = waves.chain(factor.forms.iter().map(|f| f.1)).collect();
    roots.extend(all.iter().map(|e| ("pulse".to_owned(), *e)));
    all.len()
}

fn sum_of_sizes(values: &[f64]) -> f64 {
    values.iter().map(|v| v.abs()).sum()
}

/// The balances near a state.
struct Evaluated {
    /// A.
    matrix: Vec<f64>,
    rows: Vec<Row>,
    /// Slopes of the outputs by the unknowns, and the amplitude of what oscillates in each.
    slopes: Vec<(f64, f64)>,
    /// The same of the entries of A.
    pulses: Vec<f64>,
}

impl Reactions {
    /// Whether anything in the balances, or in the slopes by reactions, may oscillate.
    pub(super) fn swing(&self) -> bool {
        self.pulses.iter().any(|k| *k > 0) || self.swings.iter().any(|s| !s.is_empty()) || self.slopes.iter().any(|s| s.2 > 0)
    }
}

/// Bounds of the rounding in the slopes of an output.
struct Doubt([Vec<f64>; 3]);

/// Share of the terms that sums over A⁺ lose at most.
const LOST: f64 = 256.0 * f64::EPSILON;

/// Rounding of the entries of A⁺.
const UNKNOWN: f64 = 8.0 * f64::EPSILON;

impl Doubt {
    /// Of an output's own slopes.
    fn of(y: &Seen) -> Doubt {
        Doubt([&y.by_place, &y.by_rate, &y.by_acceleration].map(|v| v.iter().map(|v| LOST * v.abs()).collect()))
    }

    /// A row that enters with gains whose absolute values add up to `terms`.
    fn add(&mut self, row: &Row, terms: f64) {
        for ((sum, own), bounds) in self.0.iter_mut().zip(&row.by).zip(&row.roundings) {
            sum.iter_mut().zip(own.iter().zip(bounds)).for_each(|(s, (v, b))| *s += terms * (LOST * v.abs() + b));
        }
    }

    /// Slopes that may be rounding are zero.
    fn settle(&self, y: &mut Seen) {
        for (slopes, bounds) in [&mut y.by_place, &mut y.by_rate, &mut y.by_acceleration].into_iter().zip(&self.0) {
            slopes.iter_mut().zip(bounds).filter(|(v, b)| v.abs() <= **b).for_each(|(v, _)| *v = 0.0);
        }
    }
}

impl Row {
    fn add(&self, gain: f64, y: &mut Seen) {
        for (sum, own) in [&mut y.by_place, &mut y.by_rate, &mut y.by_acceleration].into_iter().zip(&self.by) {
            sum.iter_mut().zip(own).for_each(|(s, v)| *s += gain * v);
        }
        y.waves.extend(self.waves.iter().map(|(rate, c, s)| (*rate, gain * c, gain * s)));
        y.forms.extend(self.forms.iter().map(|(form, factor)| (*form, gain * factor)));
        self.swings.iter().for_each(|(level, j, amplitude)| y.swing((*level, *j), gain * amplitude));
    }
}

impl Solved {
    /// Rows and columns of A are scaled alike first: forces and moments stand in them.
    fn new(prepared: &Reactions, matrix: &[f64], rows: &[Row]) -> Solved {
        let (m, k) = (prepared.rows, prepared.unknowns.len());
        let size = |values: &mut dyn Iterator<Item = f64>| {
            let largest = values.fold(0.0_f64, |s, v| s.max(v.abs()));
            if largest > 0.0 { largest } else { 1.0 }
        };
        let heights: Vec<f64> = (0..m).map(|i| size(&mut (0..k).map(|c| matrix[i * k + c]))).collect();
        let widths: Vec<f64> = (0..k).map(|c| size(&mut (0..m).map(|i| matrix[i * k + c] / heights[i]))).collect();
        let scaled: Vec<f64> = (0..m * k).map(|p| matrix[p] / heights[p / k] / widths[p % k]).collect();
        let qr = Qr::alike(&scaled, m, k, DEPENDENT);
        let unit = |i: usize| (0..m).map(|p| f64::from(u8::from(p == i))).collect::<Vec<f64>>();
        let columns: Vec<Vec<f64>> = (0..m).map(|i| qr.least_squares(&unit(i)).0).collect();
        // entries of A⁺ are known to ε ‖A‖ ‖A⁺‖² with ‖A‖ about 1
        let largest = columns.iter().flatten().fold(1.0_f64, |s, v| s.max(v.abs()));
        let settled = |x: f64| if x.abs() <= UNKNOWN * largest * largest { 0.0 } else { x };
        let inverse: Vec<f64> = (0..k * m).map(|e| settled(columns[e % m][e / m]) / widths[e / m] / heights[e % m]).collect();
        let value = |c: usize| {
            let parts = rows.iter().enumerate().map(|(i, row)| inverse[c * m + i] * row.mean);
            let (sum, terms) = parts.fold((0.0, 0.0), |(sum, terms): (f64, f64), v| (sum + v, terms + v.abs()));
            if sum.abs() <= SURE * f64::EPSILON * terms { 0.0 } else { sum }
        };
        let values = (0..k).map(value).collect();
        let unscaled = |v: Vec<f64>| v.iter().zip(&widths).map(|(v, w)| v / w).collect();
        Solved { values, inverse, open: qr.null_space().into_iter().map(unscaled).collect() }
    }

    /// Adds to an output what a factor of the unknown k that oscillates with an amplitude makes of its change.
    fn swing(&self, (k, amplitude): (usize, f64), rows: &[Row], y: &mut Seen) {
        if amplitude == 0.0 {
            return;
        }
        let mut change = Seen { by_place: vec![0.0; y.by_place.len()], ..Seen::default() };
        (change.by_rate, change.by_acceleration) = (change.by_place.clone(), change.by_place.clone());
        let gains = &self.inverse[k * rows.len()..(k + 1) * rows.len()];
        rows.iter().zip(gains).filter(|(_, gain)| **gain != 0.0).for_each(|(row, gain)| row.add(*gain, &mut change));
        for (level, slopes) in [&change.by_place, &change.by_rate, &change.by_acceleration].into_iter().enumerate() {
            slopes.iter().enumerate().filter(|(_, v)| **v != 0.0).for_each(|(j, v)| y.swing((level, j), amplitude * v));
        }
        let waves = change.waves.iter().map(|(_, c, s)| elementary::hypot(*c, *s));
        let forms = change.forms.iter().map(|(_, factor)| factor.abs());
        y.loose += amplitude.abs() * waves.chain(forms).sum::<f64>();
    }

    /// *Errors*: S019 for a combination of reactions that the rows leave open.
    fn refuse_open<'n>(&self, share: &[f64], name: impl Fn(usize) -> &'n str) -> Result<(), Fault> {
        for way in &self.open {
            let change: f64 = share.iter().zip(way).map(|(s, v)| s * v).sum();
            let terms: f64 = share.iter().zip(way).map(|(s, v)| (s * v).abs()).sum();
            // terms that cancel leave rounding of the null vector
            if change.abs() > 1e-9 * terms {
                let k = (0..share.len()).find(|k| share[*k] * way[*k] != 0.0).unwrap_or(0);
                return Err(Fault::open_reaction(name(k), name(k)));
            }
        }
        Ok(())
    }
}

/// Why a reaction has no amplitude.
#[derive(Clone, Copy)]
enum Why {
    /// Dry friction, an open contact.
    LeftOut,
    /// Hidden, under a unit load on a coordinate.
    NoPlace,
}

fn without_amplitude(reaction: &str, why: Why) -> Fault {
    let (why, help) = match why {
        Why::LeftOut => (
            Text::new(
                "dry friction and contacts that are open at the place of rest are left out of small motions, and with them their forces",
                "сухое трение и контакты, разомкнутые в положении равновесия, в малых движениях не учитываются, а с ними и их силы",
            ),
            Text::new(
                "take the force from `simulate` once the motion has settled",
                "возьмите силу из `simulate` после установления движения",
            ),
        ),
        Why::NoPlace => (
            Text::new(
                "the reaction follows from the balance of a body, and a unit load on a coordinate acts at no point of it",
                "реакция следует из уравнений равновесия тела, а единичная нагрузка по координате не приложена ни к какой точке",
            ),
            Text::new("name a force of the file as the load", "укажите в качестве нагрузки силу из файла"),
        ),
    };
    Fault::new(Message {
        code: "S089",
        what: Text::new(format!("`{reaction}` has no amplitude"), format!("у `{reaction}` нет амплитуды")),
        why,
        help,
    })
}
