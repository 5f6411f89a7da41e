//! Reactions at rest of structures and machines of bodies.
//!
//! With all rates and accelerations zero the equations of motion and the balances of released bodies are linear in the reactions λ:
//!
//! ```text
//! Σ forces_k λ_k = -h       one for each coordinate
//! Σ released_k λ_k = -rest  one for each displacement of a released body
//! ```
//!
//! Dry friction at rest and one-sided contacts limit the λ ([`crate::rest::admissible`]): of reactions that are not unique the least and greatest values are
//! given. A contact that stands open at the start carries nothing.
//!
//! A λ without influence on these (a relation among columns) makes the structure statically indeterminate; a displacement that no reaction holds (a
//! relation among rows) makes it a mechanism, and then it rests only if the loads do no work in that displacement.

use algebra::arrange::Arrange;
use algebra::elementary;
use symbolic::connections::Law;
use symbolic::{Equations, Expr};
use words::Text;

use crate::connections::assemble;
use crate::rest::admissible::{Hold, Holds, Limit};
use crate::rest::fault_of;
use crate::rest::numbers::Numbers;
use crate::rest::rows::{NOTHING, independent, rows_of, with_shares};
use crate::rest::sizes::NOISE;
use crate::studies::telling::telling;
use crate::{Fault, Quantity};
use algebra::qr::Qr;
use algebra::vectors::norm;
use words::digits::rounded;

/// Work of the loads in a free motion, relative, above which the structure does not rest.
const RESTS: f64 = 1e-9;

/// A reaction at rest.
#[derive(Clone, Debug)]
pub struct Reaction {
    /// Name as in formulas, symbol, unit, meaning.
    pub quantity: Quantity,
    /// The value; none where rigid bodies leave it open.
    pub value: Option<f64>,
    /// Least and greatest value that one-sided contacts and friction admit; infinite where nothing limits it.
    pub range: [f64; 2],
}

/// A motion that no connection prevents: shares of displacements and coordinates, the largest 1.
pub type FreeMotion = Vec<(Text, f64)>;

/// What statics finds.
#[derive(Clone, Debug, Default)]
pub struct Statics {
    /// All reactions in the order of the equations.
    pub reactions: Vec<Reaction>,
    /// Number of reactions that equilibrium leaves open.
    pub indeterminacy: usize,
    /// Motions that nothing holds.
    pub free: Vec<FreeMotion>,
    /// Largest relative remainder of an equation.
    pub remainder: f64,
    /// Remarks of the assembly.
    pub notes: Vec<Text>,
    /// Reactions, by index, of contacts that stand open and carry nothing.
    pub open: Vec<usize>,
    /// Coordinates whose equation says more than the balances of released bodies and the coordinates before it.
    pub telling: Vec<usize>,
}

/// Finds the reactions at the start of the machine, at rest.
///
/// *Errors*: no reactions at all (S060); a mechanism that the loads set in motion (S061), with the free motion; S167 a friction on a surface that moves; faults of the assembly.
pub fn statics(equations: &Equations) -> Result<Statics, Fault> {
    if equations.reactions.is_empty() {
        return Err(Fault::no_reactions());
    }
    if let Some(refused) = crate::rest::faults::journal(equations) {
        return Err(refused);
    }
    let parameters: Vec<f64> = equations.parameters.iter().map(|p| p.value).collect();
    let (start, notes) = match equations.coordinates.len() {
        0 => (Vec::new(), Vec::new()),
        _ => assemble(equations, &parameters).map(|a| (a.start, a.notes))?,
    };
    if let Some(refused) = crate::rest::surfaces::moving(equations, &parameters, &start[..equations.coordinates.len()])? {
        return Err(refused);
    }
    let system = System::at_rest(equations, &start);
    let mut found = system.solve(equations)?;
    found.notes = notes;
    found.open = (0..equations.reactions.len()).filter(|r| !system.unknowns.contains(r)).collect();
    found.telling = telling(equations, (&parameters, &start), &system.unknowns);
    Ok(found)
}

/// matrix λ = right: rows for coordinates, then balances.
struct System {
    rows: usize,
    unknowns: Vec<usize>,
    /// Row by row.
    matrix: Vec<f64>,
    right: Vec<f64>,
    /// Sizes of the rows, to compare forces with moments.
    scale: Vec<f64>,
    /// Columns of contacts.
    contacts: Vec<usize>,
    /// Frictions at rest.
    limits: Vec<Limit>,
}

impl System {
    fn at_rest(equations: &Equations, start: &[f64]) -> System {
        let (n, b) = (equations.coordinates.len(), equations.balances.len());
        let parameters: Vec<f64> = equations.parameters.iter().map(|p| p.value).collect();
        let numbers = Numbers::at_rest(equations, &parameters, start);
        let open = open_contacts(equations, &numbers, start);
        let unknowns: Vec<usize> = (0..equations.reactions.len()).filter(|r| !open.contains(r)).collect();
        let width = unknowns.len() + 1;
        let values = numbers.evaluate(&rows_of(equations, &unknowns));
        let rows = n + b;
        let (contacts, limits) = one_sided(equations, &unknowns, &numbers);
        let mut system = System { rows, unknowns, matrix: Vec::new(), right: Vec::new(), scale: Vec::new(), contacts, limits };
        for row in 0..rows {
            let part = &values[row * width..(row + 1) * width];
            let size = part[..width - 1].iter().fold(0.0_f64, |m, a| m.max(a.abs()));
            let size = if size > 0.0 { size } else { 1.0 };
            system.matrix.extend(part[..width - 1].iter().map(|a| a / size));
            system.right.push(-part[width - 1] / size);
            system.scale.push(size);
        }
        system
    }

    fn row(&self, i: usize) -> &[f64] {
        let width = self.unknowns.len();
        &self.matrix[i * width..(i + 1) * width]
    }

    fn column(&self, k: usize) -> Vec<f64> {
        (0..self.rows).map(|i| self.row(i)[k]).collect()
    }

    fn solve(&self, equations: &Equations) -> Result<Statics, Fault> {
        let columns: Vec<Vec<f64>> = (0..self.unknowns.len()).map(|k| self.column(k)).collect();
        let (kept, relations) = independent(&columns);
        let m = self.rows;
        let matrix: Vec<f64> = (0..m * kept.len()).map(|p| columns[kept[p % kept.len()]][p / kept.len()]).collect();
        let (solution, _) = if kept.is_empty() { (Vec::new(), 0.0) } else { Qr::new(&matrix, m, kept.len()).least_squares(&self.right) };
        let mut values: Vec<Option<f64>> = vec![None; self.unknowns.len()];
        // a reaction that rounding of the others makes up is zero
        let unit = |k: usize| equations.reactions[self.unknowns[k]].unit.as_str();
        let largest = |k: usize| kept.iter().zip(&solution).filter(|(j, _)| unit(**j) == unit(k)).fold(0.0_f64, |m, (_, v)| m.max(v.abs()));
        // rows are scaled, so that forces and moments compare: what the elimination leaves of the largest in every unknown is nothing
        let loads = self.right.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        let tidy = |k: usize, v: f64| if v.abs() <= (NOISE * largest(k)).max(f64::EPSILON * loads) { 0.0 } else { v };
        kept.iter().zip(&solution).for_each(|(&k, v)| values[k] = Some(tidy(k, *v)));
        for (k, shares) in &relations {
            values[*k] = None;
            shares.iter().for_each(|s| values[*s] = None);
        }
        let free = self.free_motions(equations);
        let remainder = self.remainder(&kept, &solution);
        if remainder > RESTS {
            return Err(Fault::sets_itself_in_motion(&described(&free)));
        }
        let mut hold = Hold::new(&self.matrix, &self.right, self.unknowns.len());
        (hold.contacts, hold.limits) = (self.contacts.clone(), self.limits.clone());
        let holds = hold.judge();
        if let Some(fault) = fault_of(equations, &self.unknowns, &hold, &holds) {
            return Err(fault);
        }
        let Holds::Between(ranges) = holds else { return Err(Fault::sets_itself_in_motion(&described(&free))) };
        let settled = |k: usize| values[k].or((ranges[k].0 == ranges[k].1).then_some(ranges[k].0));
        let shown = |k: usize| equations.reactions[self.unknowns[k]].law.is_reaction();
        let named = (0..self.unknowns.len()).filter(|k| shown(*k));
        let reactions = named.map(|k| reaction(equations, self.unknowns[k], settled(k), ranges[k])).collect();
        let indeterminacy = relations.iter().filter(|(k, shares)| shown(*k) || shares.iter().any(|s| shown(*s))).count();
        Ok(Statics { reactions, indeterminacy, free, remainder, ..Statics::default() })
    }

    /// The largest remainder of a row, relative to the terms that meet in all rows.
    fn remainder(&self, kept: &[usize], solution: &[f64]) -> f64 {
        let mut largest: f64 = 0.0;
        let mut worst: f64 = 0.0;
        for i in 0..self.rows {
            let terms = || kept.iter().zip(solution).map(|(&k, v)| self.row(i)[k] * v);
            let size = terms().map(f64::abs).fold(self.right[i].abs(), f64::max);
            largest = largest.max(size);
            worst = worst.max((terms().sum::<f64>() - self.right[i]).abs());
        }
        if largest > 0.0 { worst / largest } else { 0.0 }
    }

    /// Relations among rows are displacements in which no reaction works. With coordinates the balances of a body repeat what its coordinates say.
    fn free_motions(&self, equations: &Equations) -> Vec<FreeMotion> {
        let n = equations.coordinates.len();
        let rows: Vec<Vec<f64>> = (0..self.rows).map(|i| self.row(i).to_vec()).collect();
        let name = |i: usize| match equations.coordinates.get(i) {
            Some(c) => Text::same(&equations.graph.symbol_info(c.symbols[0]).name),
            None => equations.balances[i - n].name.clone(),
        };
        let mut found = Vec::new();
        for (i, shares) in with_shares(&rows) {
            let idle = shares.is_empty() && self.right[i] == 0.0 && self.row(i).iter().all(|a| *a == 0.0);
            if n > 0 && i >= n || n == 0 && idle && is_turn_of_a_point(equations, i) {
                continue;
            }
            // the dependent row less its share of the others does no work; rows were divided by their sizes
            let mut motion: Vec<(usize, f64)> = shares.into_iter().map(|(k, c)| (k, -c / self.scale[k])).collect();
            motion.push((i, 1.0 / self.scale[i]));
            let largest = motion.iter().fold(0.0_f64, |m, (_, c)| m.max(c.abs()));
            motion.arrange_by_key(|(k, _)| *k);
            found.push(motion.into_iter().filter(|(_, c)| c.abs() > NOTHING * largest).map(|(k, c)| (name(k), c / largest)).collect());
        }
        found
    }
}

/// Whether a balance is of moments on the joint of rods: a body without moments of inertia, with its mass and all that acts at its origin, whatever the
/// values. Its own turning means nothing. The moments are compared at two states that nothing distinguishes.
fn is_turn_of_a_point(equations: &Equations, balance: usize) -> bool {
    let name = &equations.balances[balance].name.en;
    let Some((body, _)) = name.split_once(", moments about ") else { return false };
    let released = &equations.released;
    let Some(frame) = released.frames.iter().find(|f| f.name.en == body) else { return true };
    let point = |b: &usize| {
        let body = &released.bodies[*b];
        body.center == frame.origin && body.inertia.iter().all(|(_, _, e)| equations.graph.is_zero(*e))
    };
    let roots: Vec<Expr> = frame.origin.iter().chain(&frame.force).chain(&frame.moment).copied().collect();
    let passes = |shift: f64| {
        let v = equations.graph.evaluate(&roots, &|s| shift + elementary::sin(1.0 + s.index() as f64));
        let (o, f, m) = (&v[0..3], &v[3..6], &v[6..9]);
        let turned = [o[1] * f[2] - o[2] * f[1], o[2] * f[0] - o[0] * f[2], o[0] * f[1] - o[1] * f[0]];
        let size = norm(o) * norm(f) + norm(m);
        (0..3).all(|k| (m[k] - turned[k]).abs() <= NOTHING * size)
    };
    frame.bodies.iter().all(point) && passes(0.3) && passes(1.7)
}

/// Contacts that stand open at the start and carry nothing.
fn open_contacts(equations: &Equations, numbers: &Numbers, start: &[f64]) -> Vec<usize> {
    let largest = start.iter().fold(1.0_f64, |m, q| m.max(q.abs()));
    let is_open = |r: &usize| match &equations.reactions[*r].law {
        Law::Contact { gap, .. } => numbers.evaluate(&[*gap])[0] > NOTHING * largest,
        _ => false,
    };
    (0..equations.reactions.len()).filter(is_open).collect()
}

/// Columns of contacts, and dry frictions with their limits.
fn one_sided(equations: &Equations, unknowns: &[usize], numbers: &Numbers) -> (Vec<usize>, Vec<Limit>) {
    let law = |k: usize| &equations.reactions[unknowns[k]].law;
    let contacts = (0..unknowns.len()).filter(|k| matches!(law(*k), Law::Contact { .. })).collect();
    let limit = |k: usize| {
        let Law::Friction(friction) = law(k) else { return None };
        let normal = friction.normal.as_ref().map(|normal| {
            let column = |r: usize| unknowns.iter().position(|own| *own == r);
            let terms = normal.terms.iter().filter_map(|(r, e)| Some((column(*r)?, numbers.evaluate(&[*e])[0])));
            (numbers.evaluate(&[normal.constant])[0], terms.collect())
        });
        Some(Limit { column: k, coefficient: numbers.evaluate(&[friction.fixed])[0], normal })
    };
    (contacts, (0..unknowns.len()).filter_map(limit).collect())
}

fn reaction(equations: &Equations, index: usize, value: Option<f64>, range: (f64, f64)) -> Reaction {
    let of = &equations.reactions[index];
    let symbol = equations.graph.symbol_info(of.symbol).name.clone();
    let unit = if of.unit.is_empty() { "1".to_owned() } else { of.unit.clone() };
    Reaction { quantity: Quantity { symbol, label: of.label.clone(), ..Quantity::new(&of.name, &unit) }, value, range: [range.0, range.1] }
}

/// "beam, forces along y: 1; ...".
fn described(free: &[FreeMotion]) -> Text {
    let mut text = Text::default();
    for (name, share) in free.iter().flatten() {
        let share = rounded(*share);
        for (line, name, share) in [(&mut text.en, &name.en, &share.en), (&mut text.ru, &name.ru, &share.ru)] {
            if !line.is_empty() {
                line.push_str("; ");
            }
            line.push_str(&format!("{name}: {share}"));
        }
    }
    text
}
