//! Small motions about a state: M δq'' + B δq' + C δq = F(t).
//!
//! With h(q, q', t) of the equations of motion M q'' = h and the state (q, q', q'') about which is linearised:
//!
//! ```text
//! B = -∂h/∂q'          symmetric part damping, antisymmetric part gyroscopic
//! C = -∂h/∂q           symmetric part stiffness, antisymmetric part circulatory      (at rest)
//! C = ∂(M q'' - h)/∂q                                                                (about a motion)
//! ```
//!
//! Ideal connections add their reactions λ to h, so that C contains the stiffness that they have by the change of their directions,
//! -Σ λ_k ∂²c_k/∂q², and conditions stand beside the equations: J δq = 0, of conditions G(q) q' + g(q) = 0 on rates
//! G δq' + ∂(G q' + g)/∂q δq = 0. Dry friction and contacts are left out; those that stay closed are given as lasting connections.
//!
//! Loads in time are split into their mean, which decides the equilibrium, and harmonics c cos ν t + s sin ν t, which force small
//! oscillations. Turn angles of prescribed speed are speed·t. *Source*: D. R. Merkin, Introduction to the Theory of Stability, ch. 6.

mod resting;
mod timing;

pub use resting::{Resting, at_rest};
pub use timing::{Form, Stills, Timing};

use crate::connections::Law;
use crate::harmonics::Harmonics;
use crate::waveform::Waveform;
use crate::{Derivation, Equations, Expr, Graph, Matrix, Rational, Substitution, SymbolId};
use timing::{averaged, known, moving, moving_parts, split, still};

/// About what the equations are linearised.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum About {
    /// A state of rest: q' = q'' = 0.
    #[default]
    Rest,
    /// A steady motion: q' and q'' stay as symbols.
    Motion,
}

/// The linearised equations over q (and q', q'' about a motion), parameters and definitions; numbers for q come in later.
#[derive(Clone, Debug)]
pub struct Linear {
    /// Owner of the expressions.
    pub graph: Graph,
    /// About what.
    pub about: About,
    /// q, q', q'' of each coordinate.
    pub coordinates: Vec<[SymbolId; 3]>,
    /// M, averaged over the oscillations of the loads.
    pub mass: Matrix,
    /// B = -∂h/∂q'.
    pub damping: Matrix,
    /// C.
    pub stiffness: Matrix,
    /// The mean of h - M q'': zero at an equilibrium.
    pub force: Vec<Expr>,
    /// M q'' - h with the means of the loads and the reactions of ideal connections, as functions of the whole state.
    pub bent: Vec<Expr>,
    /// Harmonic loads, by rate.
    pub loads: Vec<HarmonicLoad>,
    /// Waveforms of the loads and of what is observed.
    pub forms: Vec<Form>,
    /// Which rates vanish.
    pub stills: Stills,
    /// Loads of these forms: index of the form, factor on each coordinate.
    pub shaped: Vec<(usize, Vec<Expr>)>,
    /// λ of the ideal connections.
    pub multipliers: Vec<SymbolId>,
    /// What vanishes in every place the connections allow; zero for conditions on rates.
    pub conditions: Vec<Expr>,
    /// J: the conditions on δq, one row each.
    pub jacobian: Matrix,
    /// ∂(G q' + g)/∂q of conditions on rates, one row each like [`Linear::jacobian`]; zeros for conditions that have a place.
    pub drift: Matrix,
    /// Which conditions are on rates only.
    pub on_rates: Vec<bool>,
    /// d/dt of each condition without the terms with q'', about a motion.
    pub remainders: Vec<Expr>,
    /// Generalized force on each coordinate (row) per unit of each λ (column).
    pub reach: Matrix,
    /// Amplitudes of what oscillates in M, B and C: position in the three matrices, row-major one after another.
    pub pulsation: Vec<(usize, Expr)>,
    /// Symbols that stand for formulas over parameters.
    pub definitions: Vec<(SymbolId, Expr)>,
    /// Replaces time-dependent definitions and turn angles; what outputs need.
    moving: Vec<(SymbolId, Expr)>,
    time: SymbolId,
    /// How time was treated.
    pub timing: Timing,
}

/// Loads that repeat: mean, sines, waveforms (index, factors).
pub type Loads = (Vec<Expr>, Vec<HarmonicLoad>, Vec<(usize, Vec<Expr>)>);

/// Σ_i e_i (c_i cos ν t + s_i sin ν t), one entry for each equation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HarmonicLoad {
    /// ν.
    pub rate: Expr,
    /// c.
    pub cos: Vec<Expr>,
    /// s.
    pub sin: Vec<Expr>,
}

/// A quantity y(q, q', q'', t) near the state: y0 + ∂y/∂q δq + ∂y/∂q' δq' + ∂y/∂q'' δq'' + harmonics.
#[derive(Clone, Debug)]
pub struct LinearOutput {
    /// Its mean over the oscillations of time alone, as a function of q, q' and q''.
    pub whole: Expr,
    /// The mean at the state.
    pub mean: Expr,
    /// ∂y/∂q.
    pub by_place: Vec<Expr>,
    /// ∂y/∂q'.
    pub by_rate: Vec<Expr>,
    /// ∂y/∂q''.
    pub by_acceleration: Vec<Expr>,
    /// (rate, cos, sin) of what time does to it directly.
    pub waves: Vec<crate::harmonics::Wave>,
    /// Waveforms by index, with their factors.
    pub forms: Vec<(usize, Expr)>,
    /// What oscillates in the slopes: level (by q, by q', by q''), coordinate, an amplitude.
    pub swings: Vec<(usize, usize, Expr)>,
    /// Whether it had to be taken at t = 0.
    pub frozen: bool,
}

impl Linear {
    /// Linearises equations of motion.
    pub fn new(equations: &Equations, about: About) -> Linear {
        let mut graph = equations.graph.clone();
        let moving = moving(equations, &mut graph);
        let mut inline = Substitution::new(moving.iter().copied());
        let n = equations.coordinates.len();
        let mass: Vec<Expr> = equations.mass.entries().iter().map(|e| inline.apply(&mut graph, *e)).collect();
        let force: Vec<Expr> = equations.force.iter().map(|e| inline.apply(&mut graph, *e)).collect();
        let coordinates: Vec<[SymbolId; 3]> = equations.coordinates.iter().map(|c| c.symbols).collect();

        let mut timing = Timing::default();
        let all: Vec<Expr> = force.iter().chain(&mass).copied().collect();
        let split = split(equations, &mut graph, &all, &mut timing);
        let (split_force, split_mass) = split.split_at(n);
        timing.varying = split_mass.iter().any(|h| !h.is_still());
        timing.averaged = split_force.iter().any(|h| !h.is_still());
        let (mut forms, mut stills) = (Vec::new(), Stills { list: Vec::new(), time: equations.time });
        let mean: Vec<Expr> = split_force.iter().map(|h| averaged(&mut graph, (&mut forms, &mut stills), h)).collect();
        let mass = split_mass.iter().map(|h| averaged(&mut graph, (&mut forms, &mut stills), h)).collect();
        let mass = Matrix::from_rows(&rows(mass, n));

        let mut linear = Linear {
            about,
            mass,
            multipliers: Vec::new(),
            conditions: Vec::new(),
            jacobian: Matrix::zeros(&mut graph, 0, n),
            drift: Matrix::zeros(&mut graph, 0, n),
            on_rates: Vec::new(),
            remainders: Vec::new(),
            reach: Matrix::zeros(&mut graph, n, 0),
            damping: Matrix::zeros(&mut graph, n, n),
            stiffness: Matrix::zeros(&mut graph, n, n),
            force: Vec::new(),
            bent: Vec::new(),
            loads: Vec::new(),
            shaped: Vec::new(),
            pulsation: Vec::new(),
            forms,
            stills,
            definitions: still(equations, &moving),
            coordinates,
            moving,
            time: equations.time,
            timing,
            graph,
        };
        linear.connect(equations);
        linear.differentiate(&mean);
        linear.gather_loads(split_force);
        linear.gather_pulsation(split_force, split_mass);
        linear.define_stills();
        linear
    }

    /// Definitions of the symbols of rates that vanish, as far as they are not there yet.
    fn define_stills(&mut self) {
        let known = |symbol: SymbolId| self.definitions.iter().any(|d| d.0 == symbol);
        let new: Vec<(SymbolId, Expr)> = self.stills.list.iter().copied().filter(|s| !known(s.0)).collect();
        self.definitions.extend(new);
    }

    /// Conditions and reactions of the ideal connections.
    fn connect(&mut self, equations: &Equations) {
        let n = self.coordinates.len();
        let ideal = |condition: usize| equations.reactions.iter().find(|r| matches!(r.law, Law::Ideal { condition: c } if c == condition));
        let graph = &mut self.graph;
        let zero = graph.zero();
        let mut inline = Substitution::new(self.moving.iter().copied());
        let mut start = Substitution::new([(equations.time, zero)]);
        let rest: Vec<(SymbolId, Expr)> = self.coordinates.iter().flat_map(|[_, v, a]| [(*v, zero), (*a, zero)]).collect();
        let mut rest = Substitution::new(if self.about == About::Rest { rest } else { Vec::new() });
        let mut settle = |graph: &mut Graph, e: Expr, timing: &mut Timing| {
            let e = inline.apply(graph, e);
            timing.driven |= graph.contains(e, |s| s == equations.time);
            let e = start.apply(graph, e);
            rest.apply(graph, e)
        };
        let (mut rows, mut columns, mut drifts) = (Vec::new(), Vec::new(), Vec::new());
        let mut by_place: Vec<Derivation> = self.coordinates.iter().map(|[q, ..]| Derivation::partial(graph, *q)).collect();
        let mut whole = Substitution::new(self.moving.iter().copied());
        for (c, condition) in equations.conditions.iter().enumerate() {
            let reaction = ideal(c);
            if condition.reaction.is_some() && reaction.is_none() {
                continue;
            }
            let mut row = vec![zero; n];
            for (j, e) in &condition.columns {
                row[*j] = settle(graph, *e, &mut self.timing);
            }
            rows.push(row);
            let mut drift = vec![zero; n];
            if condition.place.is_none() {
                let rate = whole.apply(graph, condition.rate);
                for (e, derivation) in drift.iter_mut().zip(&mut by_place) {
                    let slope = derivation.apply(graph, rate);
                    *e = settle(graph, slope, &mut self.timing);
                }
                self.timing.driven |= graph.contains(rate, |s| s == equations.time);
            }
            drifts.push(drift);
            self.on_rates.push(condition.place.is_none());
            if self.about == About::Motion {
                let mut driven = Timing::default();
                self.remainders.push(settle(graph, condition.remainder, &mut driven));
            }
            let place = condition.place.map_or(zero, |e| settle(graph, e, &mut self.timing));
            self.conditions.push(place);
            let Some(reaction) = reaction else { continue };
            let mut column = vec![zero; n];
            for (j, e) in &reaction.forces {
                column[*j] = settle(graph, *e, &mut self.timing);
            }
            self.multipliers.push(reaction.symbol);
            columns.push(column);
        }
        if rows.is_empty() {
            return;
        }
        self.jacobian = Matrix::from_rows(&rows);
        self.drift = Matrix::from_rows(&drifts);
        self.reach = if columns.is_empty() { Matrix::zeros(graph, n, 0) } else { Matrix::from_rows(&columns).transpose() };
    }

    /// B, C and the mean force.
    fn differentiate(&mut self, mean: &[Expr]) {
        let n = mean.len();
        let graph = &mut self.graph;
        let zero = graph.zero();
        let mut rest = Substitution::new(match self.about {
            About::Rest => self.coordinates.iter().flat_map(|[_, v, a]| [(*v, zero), (*a, zero)]).collect::<Vec<_>>(),
            About::Motion => Vec::new(),
        });
        for j in 0..n {
            let mut by_rate = Derivation::partial(graph, self.coordinates[j][1]);
            for (i, h) in mean.iter().enumerate() {
                let d = by_rate.apply(graph, *h);
                self.timing.bent |= graph.contains(d, |s| self.coordinates.iter().any(|c| c[1] == s));
                let d = rest.apply(graph, d);
                let d = graph.neg(d);
                self.damping.set(i, j, d);
            }
        }
        for (i, h) in mean.iter().enumerate() {
            let product = |j: usize| {
                let acceleration = graph.symbol(self.coordinates[j][2]);
                graph.mul(self.mass.get(i, j), acceleration)
            };
            let inertia: Vec<Expr> = (0..n).map(product).collect();
            let inertia = graph.sum(&inertia);
            self.bent.push(graph.sub(inertia, *h));
            let at_rest = rest.apply(graph, *h);
            let force = match self.about {
                About::Rest => at_rest,
                About::Motion => {
                    let mut terms = vec![at_rest];
                    for j in 0..n {
                        let a = graph.symbol(self.coordinates[j][2]);
                        let term = graph.mul(self.mass.get(i, j), a);
                        terms.push(graph.neg(term));
                    }
                    graph.sum(&terms)
                }
            };
            let mut terms = vec![force];
            for (k, multiplier) in self.multipliers.iter().enumerate() {
                let multiplier = graph.symbol(*multiplier);
                terms.push(graph.mul(self.reach.get(i, k), multiplier));
            }
            let force = graph.sum(&terms);
            let reached = graph.sum(&terms[1..]);
            self.bent[i] = graph.sub(self.bent[i], reached);
            self.force.push(force);
        }
        for j in 0..n {
            let mut by_place = Derivation::partial(graph, self.coordinates[j][0]);
            for (i, r) in self.force.iter().enumerate() {
                let d = by_place.apply(graph, *r);
                let d = graph.neg(d);
                self.stiffness.set(i, j, d);
            }
        }
    }

    /// Harmonics of all equations sorted by rate, at rest; those that depend on q or q' vary the coefficients.
    fn gather_loads(&mut self, split: &[Harmonics]) {
        let n = split.len();
        let graph = &mut self.graph;
        let zero = graph.zero();
        let mut rest = Substitution::new(match self.about {
            About::Rest => self.coordinates.iter().map(|[_, v, _]| (*v, zero)).collect::<Vec<_>>(),
            About::Motion => Vec::new(),
        });
        for (i, harmonics) in split.iter().enumerate() {
            for wave in &harmonics.waves {
                for part in [wave.cos, wave.sin] {
                    self.timing.varying |= graph.contains(part, |s| self.coordinates.iter().any(|c| c.contains(&s)));
                }
                let (cos, sin) = (rest.apply(graph, wave.cos), rest.apply(graph, wave.sin));
                let [cos, sin] = [cos, sin].map(|e| self.stills.moving(graph, wave.rate, e));
                if graph.is_zero(cos) && graph.is_zero(sin) {
                    continue;
                }
                let place = match self.loads.iter().position(|l| l.rate == wave.rate) {
                    Some(place) => place,
                    None => {
                        self.loads.push(HarmonicLoad { rate: wave.rate, cos: vec![zero; n], sin: vec![zero; n] });
                        self.loads.len() - 1
                    }
                };
                self.loads[place].cos[i] = cos;
                self.loads[place].sin[i] = sin;
            }
            for (wave, factor) in &harmonics.forms {
                self.timing.varying |= graph.contains(*factor, |s| self.coordinates.iter().any(|c| c.contains(&s)));
                let factor = rest.apply(graph, *factor);
                let factor = self.stills.moving(graph, wave.rate, factor);
                if graph.is_zero(factor) {
                    continue;
                }
                let form = known(graph, &mut self.forms, *wave);
                let place = self.shaped.iter().position(|(f, _)| *f == form).unwrap_or_else(|| {
                    self.shaped.push((form, vec![zero; n]));
                    self.shaped.len() - 1
                });
                self.shaped[place].1[i] = factor;
            }
        }
    }

    /// What oscillates in M, and in B and C by loads that depend on q' and q.
    fn gather_pulsation(&mut self, forces: &[Harmonics], masses: &[Harmonics]) {
        let n = forces.len();
        let graph = &mut self.graph;
        let zero = graph.zero();
        let rates = match self.about {
            About::Rest => self.coordinates.iter().map(|[_, v, _]| (*v, zero)).collect::<Vec<_>>(),
            About::Motion => Vec::new(),
        };
        let mut rest = Substitution::new(rates);
        let stills = &mut self.stills;
        let mut parts = |graph: &mut Graph, h: &Harmonics| moving_parts(graph, stills, h);
        let mut found: Vec<(usize, Expr)> = Vec::new();
        for (entry, mass) in masses.iter().enumerate() {
            found.extend(parts(graph, mass).into_iter().map(|e| (entry, rest.apply(graph, e))));
        }
        for j in 0..n {
            let mut by = [1, 0].map(|level| Derivation::partial(graph, self.coordinates[j][level]));
            for (i, force) in forces.iter().enumerate() {
                for part in parts(graph, force) {
                    for (matrix, derivation) in by.iter_mut().enumerate() {
                        let slope = derivation.apply(graph, part);
                        found.push(((matrix + 1) * n * n + i * n + j, rest.apply(graph, slope)));
                    }
                }
            }
        }
        found.retain(|(_, e)| !graph.is_zero(*e));
        self.pulsation = found;
    }

    /// An output near the state. `formula` is one of the equations that were linearised.
    pub fn output(&mut self, equations: &Equations, formula: Expr) -> LinearOutput {
        let graph = &mut self.graph;
        let formula = Substitution::new(self.moving.iter().copied()).apply(graph, formula);
        let mut timing = Timing::default();
        let harmonics = split(equations, graph, &[formula], &mut timing).remove(0);
        let average = averaged(graph, (&mut self.forms, &mut self.stills), &harmonics);
        let zero = graph.zero();
        let mut rest = Substitution::new(match self.about {
            About::Rest => self.coordinates.iter().flat_map(|[_, v, a]| [(*v, zero), (*a, zero)]).collect::<Vec<_>>(),
            About::Motion => Vec::new(),
        });
        let mut by = |graph: &mut Graph, level: usize| -> Vec<Expr> {
            let derive = |c: &[SymbolId; 3]| {
                let d = graph.derivative(average, c[level]);
                rest.apply(graph, d)
            };
            self.coordinates.iter().map(derive).collect()
        };
        let (by_place, by_rate, by_acceleration) = (by(graph, 0), by(graph, 1), by(graph, 2));
        let mean = rest.apply(graph, average);
        let waves =
            harmonics.waves.iter().map(|w| crate::harmonics::Wave { cos: rest.apply(graph, w.cos), sin: rest.apply(graph, w.sin), ..*w });
        let waves: Vec<crate::harmonics::Wave> = waves.collect();
        let form = |(wave, factor): &(Waveform, Expr)| (known(graph, &mut self.forms, *wave), rest.apply(graph, *factor));
        let forms = harmonics.forms.iter().map(form).collect();
        let mut swings = Vec::new();
        for part in moving_parts(graph, &mut self.stills, &harmonics) {
            for (j, symbols) in self.coordinates.iter().enumerate() {
                for (level, symbol) in symbols.iter().enumerate() {
                    let slope = graph.derivative(part, *symbol);
                    swings.push((level, j, rest.apply(graph, slope)));
                }
            }
        }
        swings.retain(|(.., e)| !graph.is_zero(*e));
        self.define_stills();
        LinearOutput { whole: average, mean, by_place, by_rate, by_acceleration, waves, forms, swings, frozen: timing.frozen }
    }

    /// Generalized forces of the equations (index of a coordinate, force) at rest, with the time in them.
    pub fn over_time(&mut self, forces: &[(usize, Expr)]) -> Vec<Expr> {
        let n = self.coordinates.len();
        let zero = self.graph.zero();
        let mut all = vec![zero; n];
        let mut inline = Substitution::new(self.moving.iter().copied());
        let mut rest = Substitution::new(self.coordinates.iter().flat_map(|[_, v, a]| [(*v, zero), (*a, zero)]));
        for (i, force) in forces {
            let force = inline.apply(&mut self.graph, *force);
            let force = rest.apply(&mut self.graph, force);
            all[*i] = self.graph.add(all[*i], force);
        }
        all
    }

    /// Mean and harmonics of further generalized forces (index of a coordinate, force), at rest; none when they do not repeat.
    pub fn harmonics_of(&mut self, equations: &Equations, forces: &[(usize, Expr)]) -> Option<Loads> {
        let all = self.over_time(forces);
        let mut timing = Timing::default();
        let found = split(equations, &mut self.graph, &all, &mut timing);
        if timing.frozen {
            return None;
        }
        let (loads, shaped) = (std::mem::take(&mut self.loads), std::mem::take(&mut self.shaped));
        let varying = self.timing.varying;
        self.gather_loads(&found);
        self.timing.varying = varying;
        let (waves, forms) = (std::mem::replace(&mut self.loads, loads), std::mem::replace(&mut self.shaped, shaped));
        let mean = found.iter().map(|h| averaged(&mut self.graph, (&mut self.forms, &mut self.stills), h)).collect();
        self.define_stills();
        Some((mean, waves, forms))
    }

    /// The same with expressions in place of the coordinates (and definitions), for print.
    pub fn at(&self, place: &[(SymbolId, Expr)]) -> Linear {
        let mut at = self.clone();
        let mut substitution = Substitution::new(place.iter().copied());
        let graph = &mut at.graph;
        for matrix in [&mut at.mass, &mut at.damping, &mut at.stiffness] {
            for i in 0..matrix.rows() {
                for j in 0..matrix.columns() {
                    let e = substitution.apply(graph, matrix.get(i, j));
                    matrix.set(i, j, e);
                }
            }
        }
        at.force.iter_mut().for_each(|e| *e = substitution.apply(graph, *e));
        for load in &mut at.loads {
            load.rate = substitution.apply(graph, load.rate);
            load.cos.iter_mut().chain(&mut load.sin).for_each(|e| *e = substitution.apply(graph, *e));
        }
        for (_, factors) in &mut at.shaped {
            factors.iter_mut().for_each(|e| *e = substitution.apply(graph, *e));
        }
        at
    }

    /// The symmetric and the antisymmetric part of a square matrix of this graph.
    pub fn parts(&mut self, matrix: &Matrix) -> (Matrix, Matrix) {
        let n = matrix.rows();
        let graph = &mut self.graph;
        let (mut even, mut odd) = (matrix.clone(), Matrix::zeros(graph, n, n));
        for i in 0..n {
            for j in 0..n {
                let (a, b) = (matrix.get(i, j), matrix.get(j, i));
                if a == b {
                    continue;
                }
                let (sum, difference) = (graph.add(a, b), graph.sub(a, b));
                let (sum, difference) = (graph.scale(sum, &Rational::HALF), graph.scale(difference, &Rational::HALF));
                even.set(i, j, sum);
                odd.set(i, j, difference);
            }
        }
        (even, odd)
    }

    /// The symbol of time, which occurs in no expression here.
    pub fn time(&self) -> SymbolId {
        self.time
    }
}

fn rows(entries: Vec<Expr>, n: usize) -> Vec<Vec<Expr>> {
    entries.chunks(n.max(1)).map(<[Expr]>::to_vec).collect()
}
