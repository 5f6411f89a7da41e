//! Equations with connections: one general system for accelerations and reactions.
//!
//! ```text
//! rows                                    unknowns: q'', then reactions λ
//! conditions   J q''              = -remainder        (or the alternative of a contact or a friction)
//! motions      M q'' - Σ forces λ = h
//! balances     m q'' - Σ released λ = rest            (here only when a friction presses with the force of a support)
//! ```
//!
//! Conditions come first, so that what they hold is held exactly ([`crate::Operation::System`]). The alternatives stand in the same rows: each entry is
//! a choice by the mode of the contact's gap or of the sliding speed, so that the modes select the equations and a jet stays on one smooth piece.
//! Limits, normal forces and contact forces are guards whose values follow from the solution.
//!
//! Where closed contacts and sticking frictions repeat each other (two feet of a block that rests), some of their rows are replaced: their conditions hold
//! through the others, and their reactions are set. Which ones is a mode too (`Share`, `Side`), chosen by the integrator.
//!
//! Frictions pressed by a force of two components are not linear: `journals.rs`. Guards of contacts and frictions: `guards.rs`.

use super::arrangement::{Arrangement, friction_of};
use super::expressions::Lowering;
use super::forms::Value;
use super::guards::{by_sign, ratio};
use super::numbers::{Journal, Numbers};
use crate::{By, Fault, Register};
use symbolic::connections::{Balance, Condition, Friction, Law};
use symbolic::{Equations, Expr};

/// A row under construction: entries by column, right side.
type Row = (Vec<(usize, Value)>, Value);

/// The system of the dynamics on a tape.
pub(super) struct Connected<'e, 'a, 'g, 't> {
    pub(super) lowering: &'a mut Lowering<'g, 't>,
    equations: &'e Equations,
    pub(super) arrangement: &'e Arrangement,
    /// Column of each reaction.
    pub(super) columns: Vec<Option<usize>>,
    pub(super) size: usize,
    pub(super) matrix: Vec<Option<Register>>,
    pub(super) right: Vec<Register>,
    journals: Vec<Journal<'e>>,
}

impl<'e, 'a, 'g, 't> Connected<'e, 'a, 'g, 't> {
    pub(super) fn new(lowering: &'a mut Lowering<'g, 't>, equations: &'e Equations, arrangement: &'e Arrangement) -> Self {
        let n = equations.coordinates.len();
        let mut columns = vec![None; equations.reactions.len()];
        for (i, r) in arrangement.solved.iter().enumerate() {
            columns[*r] = Some(n + i);
        }
        let size = n + arrangement.solved.len();
        Connected {
            lowering,
            equations,
            arrangement,
            columns,
            size,
            matrix: Vec::with_capacity(size * size),
            right: Vec::with_capacity(size),
            journals: Vec::new(),
        }
    }

    /// First register of q'', then the solved reactions; none without unknowns.
    pub(super) fn solve(mut self, numbers: &[Option<Numbers>]) -> Result<Option<Register>, Fault> {
        if self.size == 0 {
            return Ok(None);
        }
        for c in &self.arrangement.conditions {
            self.condition(&self.equations.conditions[*c], numbers)?;
        }
        for i in 0..self.equations.coordinates.len() {
            self.motion(i)?;
        }
        for b in &self.arrangement.joined {
            self.balance(*b)?;
        }
        let journals = std::mem::take(&mut self.journals);
        self.press_journals(&journals)?;
        Ok(Some(self.lowering.system(self.matrix, self.right, self.arrangement.spare.clone())))
    }

    fn push(&mut self, (entries, right): Row) {
        let mut row = vec![None; self.size];
        for (column, value) in entries {
            let register = self.lowering.whole(value);
            row[column] = (!self.lowering.is_zero(register)).then_some(register);
        }
        self.matrix.extend(row);
        let right = self.lowering.whole(right);
        self.right.push(right);
    }

    fn motion(&mut self, i: usize) -> Result<(), Fault> {
        let n = self.equations.coordinates.len();
        let mut row = Vec::new();
        for j in 0..n {
            row.push((j, self.lowering.value(self.equations.mass.get(i.max(j), i.min(j)))?));
        }
        for (column, e) in self.loads(|r| &r.forces, i) {
            row.push((column, self.lowering.negative(e)?));
        }
        let right = self.lowering.value(self.equations.force[i])?;
        self.push((row, right));
        Ok(())
    }

    fn balance(&mut self, b: usize) -> Result<(), Fault> {
        let Balance { columns, rest, .. } = &self.equations.balances[b];
        let mut row = Vec::new();
        for (j, e) in columns {
            row.push((*j, self.lowering.value(*e)?));
        }
        for (column, e) in self.loads(|r| &r.released, b) {
            row.push((column, self.lowering.negative(e)?));
        }
        let right = self.lowering.value(*rest)?;
        self.push((row, right));
        Ok(())
    }

    /// (column, factor) of the solved reactions in row `i` of `part`.
    fn loads(&self, part: impl Fn(&symbolic::connections::Reaction) -> &Vec<(usize, Expr)>, i: usize) -> Vec<(usize, Expr)> {
        let mut found = Vec::new();
        for r in &self.arrangement.solved {
            let column = self.columns[*r].unwrap_or(0);
            found.extend(part(&self.equations.reactions[*r]).iter().filter(|(k, _)| *k == i).map(|(_, e)| (column, *e)));
        }
        found
    }

    fn condition(&mut self, condition: &'e Condition, numbers: &[Option<Numbers>]) -> Result<(), Fault> {
        let mut entries = Vec::new();
        for (j, e) in &condition.columns {
            entries.push((*j, self.lowering.value(*e)?));
        }
        let held = (entries, self.lowering.negative(condition.remainder)?);
        let owner = condition.reaction.and_then(|r| Some((r, self.columns[r]?, (*numbers.get(r)?)?)));
        let Some((reaction, column, numbers)) = owner else {
            self.push(held);
            return Ok(());
        };
        match (&self.equations.reactions[reaction].law, numbers) {
            (Law::Friction(friction), Numbers::Sliding { leader, sliding, normal, shares, .. }) => {
                let ratio = ratio(self.lowering, self.equations, friction, leader)?;
                let held = match shares {
                    _ if leader != reaction => self.share(friction, column, leader, ratio)?,
                    Some(shares) => self.carried(friction, column, (held, shares, normal))?,
                    None => held,
                };
                let kinetic = [self.lowering.negative(friction.kinetic[0])?, self.lowering.value(friction.kinetic[1])?];
                let [back, forth] = [kinetic, [kinetic[1], kinetic[0]]].map(|sides| by_sign(self.lowering, ratio, sides));
                if let (Some(_), Some(unique)) = (&friction.across, normal) {
                    let zero = self.lowering.literal(0.0);
                    let rests = match shares {
                        Some(shares) if leader == reaction => self.taken(friction, shares)?,
                        _ => zero,
                    };
                    let signed = self.lowering.branch(By::Mode(sliding), [back, rests, forth]);
                    let share = shares.filter(|_| leader == reaction).map(|[share, _]| share);
                    let coefficient = self.lowering.branch(By::Mode(unique), [zero, signed, signed]);
                    self.journals.push(Journal { row: self.right.len(), law: friction, sliding, unique, share, coefficient });
                }
                let sides = [self.slip(friction, column, back, normal)?, held, self.slip(friction, column, forth, normal)?];
                let row = self.alternatives(sliding, sides);
                self.push(row);
            }
            (_, Numbers::Gap { gap, share, .. } | Numbers::Rough { gap, share }) => {
                let open = (vec![(column, self.lowering.literal(1.0))], self.lowering.literal(0.0));
                let held = match share {
                    Some(share) => self.alternatives(share, [open.clone(), open.clone(), held]),
                    None => held,
                };
                let row = self.alternatives(gap, [held.clone(), held, open]);
                self.push(row);
            }
            _ => self.push(held),
        }
        Ok(())
    }

    /// λ - kinetic |N| = 0 with the sign of sliding in `kinetic`; |N| = σ N with the sign σ of N by its mode.
    fn slip(&mut self, friction: &Friction, column: usize, kinetic: Value, normal: Option<u32>) -> Result<Row, Fault> {
        let mut entries = vec![(column, self.lowering.literal(1.0))];
        if friction.across.is_some() {
            // what stands on the right is known when both components are
            return Ok((entries, self.lowering.literal(0.0)));
        }
        let (Some(normal), Some(number)) = (&friction.normal, normal) else {
            return Ok((entries, kinetic));
        };
        let signs = [-1.0, 0.0, 1.0].map(|sign| self.lowering.literal(sign));
        let sign = self.lowering.branch(By::Mode(number), signs);
        let factor = self.lowering.times(kinetic, sign);
        for (k, e) in &normal.terms {
            let term = self.lowering.value(*e)?;
            let term = self.lowering.times(factor, term);
            entries.push((self.columns[*k].unwrap_or(0), self.lowering.sum(&[(-1.0, term)])));
        }
        let constant = self.lowering.value(normal.constant)?;
        Ok((entries, self.lowering.times(factor, constant)))
    }

    /// λ fixed(leader) - sign(r) λ(leader) fixed = 0; λ = 0 where both limits vanish, or are not known beforehand.
    fn share(&mut self, friction: &Friction, column: usize, leader: usize, ratio: Value) -> Result<Row, Fault> {
        let (one, zero) = (self.lowering.literal(1.0), self.lowering.literal(0.0));
        let Some((first, lead)) = friction_of(self.equations, leader).zip(self.columns[leader]) else {
            return Ok((vec![(column, one)], zero));
        };
        if friction.normal.is_some() || first.normal.is_some() {
            return Ok((vec![(column, one)], zero));
        }
        let (mut own, own_limit) = (self.lowering.value(first.fixed)?, self.lowering.value(friction.fixed)?);
        let sum = self.lowering.sum(&[(1.0, own), (1.0, own_limit)]);
        if let Value::Constant(sum) = sum {
            own = self.lowering.branch(By::Value(sum), [one, one, own]);
        }
        let other = self.lowering.sum(&[(-1.0, own_limit)]);
        let other = by_sign(self.lowering, ratio, [other, own_limit]);
        Ok((vec![(column, own), (lead, other)], zero))
    }

    /// The condition, or λ = side · static limit where other conditions imply it.
    fn carried(
        &mut self,
        friction: &Friction,
        column: usize,
        (held, [share, side], normal): (Row, [u32; 2], Option<u32>),
    ) -> Result<Row, Fault> {
        let fixed = self.lowering.value(friction.fixed)?;
        let (less, zero) = (self.lowering.sum(&[(-1.0, fixed)]), self.lowering.literal(0.0));
        let limit = self.lowering.branch(By::Mode(side), [less, zero, fixed]);
        let taken = self.slip(friction, column, limit, normal)?;
        Ok(self.alternatives(share, [taken.clone(), taken, held]))
    }

    /// Its coefficient where others imply the condition: side · static coefficient; zero where it holds itself.
    fn taken(&mut self, friction: &Friction, [share, side]: [u32; 2]) -> Result<Value, Fault> {
        let fixed = self.lowering.value(friction.fixed)?;
        let (less, zero) = (self.lowering.sum(&[(-1.0, fixed)]), self.lowering.literal(0.0));
        let limit = self.lowering.branch(By::Mode(side), [less, zero, fixed]);
        Ok(self.lowering.branch(By::Mode(share), [limit, limit, zero]))
    }

    fn alternatives(&mut self, guard: u32, sides: [Row; 3]) -> Row {
        let mut row = Vec::new();
        for column in 0..self.size {
            let values = sides.each_ref().map(|(entries, _)| {
                let items: Vec<(f64, Value)> = entries.iter().filter(|e| e.0 == column).map(|e| (1.0, e.1)).collect();
                self.lowering.sum(&items)
            });
            if sides.iter().any(|(entries, _)| entries.iter().any(|e| e.0 == column)) {
                row.push((column, self.lowering.branch(By::Mode(guard), values)));
            }
        }
        let right = self.lowering.branch(By::Mode(guard), sides.map(|side| side.1));
        (row, right)
    }
}

/// Registers of the supports, from the balances: Σ released λ = columns q'' - rest - Σ released (solved) λ.
pub(super) fn supports(
    lowering: &mut Lowering,
    equations: &Equations,
    arrangement: &Arrangement,
    first: Option<Register>,
) -> Result<Option<Register>, Fault> {
    let n = equations.coordinates.len();
    let solution = |i: usize| Value::Plain(Register(first.map_or(0, |f| f.0) + i as u32));
    let (mut matrix, mut right) = (Vec::new(), Vec::new());
    for &b in &arrangement.balances {
        let balance = &equations.balances[b];
        let entry = |r: &usize| equations.reactions[*r].released.iter().filter(move |(k, _)| *k == b).map(|(_, e)| *e);
        for r in &arrangement.supports {
            let mut items = Vec::new();
            for e in entry(r) {
                items.push((1.0, lowering.value(e)?));
            }
            let sum = lowering.sum(&items);
            let register = lowering.whole(sum);
            matrix.push((!lowering.is_zero(register)).then_some(register));
        }
        let mut items = vec![(-1.0, lowering.value(balance.rest)?)];
        for (j, e) in &balance.columns {
            let inertia = lowering.value(*e)?;
            items.push((1.0, lowering.times(inertia, solution(*j))));
        }
        for (i, r) in arrangement.solved.iter().enumerate() {
            for e in entry(r) {
                let factor = lowering.value(e)?;
                items.push((-1.0, lowering.times(factor, solution(n + i))));
            }
        }
        let sum = lowering.sum(&items);
        right.push(lowering.whole(sum));
    }
    if right.is_empty() {
        return Ok(None);
    }
    Ok(Some(lowering.system(matrix, right, None)))
}
