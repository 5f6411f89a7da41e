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
//! Frictions pressed by a force of two components are not linear: `journals.rs`.
//!
//! Frictions whose sliding speeds are in a constant ratio r (two feet of a block, brakes of different radii on a shaft) stick and slide together: the first
//! leads, the others share its guards. While they stick only the sum Σ r λ of what they do on the leader's motion is determined; it is compared with
//! Σ |r| limit, and shared in proportion to the limits. Where normal forces from reactions make the limits unknown, the first takes all: that is of no
//! consequence where all of the group act alike. Where they do not (two drums on one rope, each pressed by a tension that the other changes) the limits depend
//! on the shares; then each stands for itself, and the integrator finds shares that agree with all limits (`Share`, `Side`).

use super::expressions::Lowering;
use super::forms::Value;
use super::numbers::{Journal, Numbers};
use crate::{Bounded, By, Construct, Fault, GuardOrigin, Mode, Real, Register, Spare};
use std::sync::Arc;
use symbolic::connections::{Balance, Condition, Friction, Law, Normal};
use symbolic::{Equations, Expr};
use words::Text;

/// What takes part of the connections of some equations. A condition that repeats others is dropped together with the reaction that owns it.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Selection {
    /// Conditions that are equations.
    pub conditions: Vec<bool>,
    /// Reactions that are unknowns.
    pub reactions: Vec<bool>,
    /// Balances that are equations.
    pub balances: Vec<bool>,
    /// Conditions that take part, and of which some repeat others wherever the machine is.
    pub repeated: Option<Repeated>,
}

/// Conditions of which `count` repeat the others in every position, but not the same ones in every position: see [`crate::Spare`].
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Repeated {
    /// How many of them.
    pub count: usize,
    /// Conditions with a reaction: index, typical size of its gradient over `reach`.
    pub members: Vec<(usize, f64)>,
    /// Conditions without one, that hold together with the members.
    pub fixed: Vec<usize>,
    /// Typical size of the gradients by coordinate.
    pub reach: Vec<f64>,
}

impl Selection {
    /// Everything takes part.
    pub fn all(equations: &Equations) -> Selection {
        Selection {
            conditions: vec![true; equations.conditions.len()],
            reactions: vec![true; equations.reactions.len()],
            balances: vec![true; equations.balances.len()],
            repeated: None,
        }
    }
}

/// Rows and unknowns of the dynamics and of the supports, by index.
#[derive(Clone, Debug)]
pub(super) struct Arrangement {
    pub(super) conditions: Vec<usize>,
    /// Unknown in the dynamics.
    pub(super) solved: Vec<usize>,
    /// Balances among the rows of the dynamics.
    pub(super) joined: Vec<usize>,
    /// Supports that follow from `balances` afterwards.
    pub(super) supports: Vec<usize>,
    pub(super) balances: Vec<usize>,
    /// Rows of the dynamics of which some repeat others.
    pub(super) spare: Option<Arc<Spare>>,
}

impl Arrangement {
    /// *Errors*: P012 when equations and unknowns differ in number, P014 for a friction that is pressed by a reaction that was dropped.
    pub(super) fn new(equations: &Equations, selection: &Selection) -> Result<Arrangement, Fault> {
        let sizes = |a: usize, b: usize| if a == b { Ok(()) } else { Err(Fault::about("P012", format!("{a} != {b}"))) };
        sizes(selection.conditions.len(), equations.conditions.len())?;
        sizes(selection.reactions.len(), equations.reactions.len())?;
        sizes(selection.balances.len(), equations.balances.len())?;
        let chosen = |flags: &[bool]| -> Vec<usize> { (0..flags.len()).filter(|i| flags[*i]).collect() };
        let (conditions, reactions, balances) = (chosen(&selection.conditions), chosen(&selection.reactions), chosen(&selection.balances));
        for &r in &reactions {
            let owned = equations.reactions[r].law.condition();
            if owned.is_some_and(|c| selection.conditions.get(c) != Some(&true)) {
                return Err(Fault::about("P012", equations.reactions[r].name.clone()));
            }
            if let Some(lost) = pressing(equations, r).find(|k| selection.reactions.get(*k) != Some(&true)) {
                return Err(Fault::about("P014", equations.reactions.get(lost).map_or("?", |r| &r.name)));
            }
        }
        let support = |r: &usize| equations.reactions[*r].law.is_hidden();
        let joins = reactions.iter().any(|r| pressing(equations, *r).any(|k| support(&k)));
        let (supports, solved): (Vec<usize>, Vec<usize>) = reactions.iter().partition(|r| support(r) && !joins);
        let (joined, balances) = if joins { (balances, Vec::new()) } else { (Vec::new(), balances) };
        let mismatch = |rows: usize, unknowns: usize| {
            let en = format!("{rows} conditions for {unknowns} unknown reactions and motors");
            let ru = format!("условий {rows}, неизвестных реакций и моторов {unknowns}");
            if rows == unknowns { Ok(()) } else { Err(Fault::new("P012", &Text::new(en, ru))) }
        };
        mismatch(conditions.len() + joined.len(), solved.len())?;
        mismatch(balances.len(), supports.len())?;
        let spare = selection.repeated.as_ref().map(|repeated| {
            let columns = equations.coordinates.len();
            let row = |c: &usize| conditions.iter().position(|k| k == c).map(|row| row as u32);
            let unknown =
                |c: usize| solved.iter().position(|r| equations.reactions[*r].law.condition() == Some(c)).map(|k| (columns + k) as u32);
            let pair = |(c, size): &(usize, f64)| Some((row(c)?, unknown(*c)?, Real(*size)));
            Arc::new(Spare {
                count: repeated.count as u32,
                fixed: repeated.fixed.iter().filter_map(row).collect(),
                pairs: repeated.members.iter().filter_map(pair).collect(),
                columns: repeated.reach.iter().map(|r| Real(*r)).collect(),
            })
        });
        Ok(Arrangement { conditions, solved, joined, supports, balances, spare })
    }

    /// The balances that take part, wherever they stand.
    pub(super) fn kept(&self) -> &[usize] {
        if self.joined.is_empty() { &self.balances } else { &self.joined }
    }

    /// Their unknowns, in the order of the reactions.
    pub(super) fn hidden(&self, equations: &Equations) -> Vec<usize> {
        let all = if self.joined.is_empty() { &self.supports } else { &self.solved };
        all.iter().copied().filter(|r| equations.reactions[*r].law.is_hidden()).collect()
    }

    /// Whether the equations of motion stand alone.
    pub(super) fn is_free(&self) -> bool {
        self.solved.is_empty()
    }

    /// Names of the rows of the dynamics.
    pub(super) fn rows(&self, equations: &Equations, unknowns: &[String]) -> Vec<Text> {
        let conditions = self.conditions.iter().map(|c| equations.conditions[*c].name.clone());
        let motion = |a: &String| Text::new(format!("equation of motion for {a}"), format!("уравнение движения для {a}"));
        let motions = unknowns[..equations.coordinates.len()].iter().map(motion);
        conditions.chain(motions).chain(self.joined.iter().map(|b| equations.balances[*b].name.clone())).collect()
    }
}

/// Reactions that a friction's normal force consists of.
fn pressing(equations: &Equations, reaction: usize) -> impl Iterator<Item = usize> + '_ {
    let friction = friction_of(equations, reaction);
    friction.into_iter().flat_map(|f| f.components().flat_map(|n| n.terms.iter().map(|t| t.0)))
}

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
                    let signed = self.lowering.branch(By::Mode(sliding), [back, zero, forth]);
                    let coefficient = self.lowering.branch(By::Mode(unique), [zero, signed, signed]);
                    self.journals.push(Journal { row: self.right.len(), law: friction, sliding, unique, coefficient });
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

/// Reserves the numbers of the guards of contacts and frictions and finds their surfaces; formulas that follow share these guards.
pub(super) fn reserve(lowering: &mut Lowering, equations: &Equations, arrangement: &Arrangement) -> Result<Vec<Option<Numbers>>, Fault> {
    let mut numbers = vec![None; equations.reactions.len()];
    let shared = if arrangement.conditions.len() > 1 { Sharing::Possible } else { Sharing::Never };
    for &reaction in &arrangement.solved {
        numbers[reaction] = match &equations.reactions[reaction].law {
            Law::Contact { gap, .. } => Some(contact(lowering, reaction, *gap, shared)?),
            Law::Friction(friction) => {
                let leader = leader(lowering, equations, arrangement, reaction)?;
                Some(sliding(lowering, reaction, friction, (numbers[leader], shared))?)
            }
            Law::Rough { condition, contact } => {
                let slip = equations.conditions[*condition].rate;
                numbers[*contact].map(|contact| rough(lowering, (reaction, slip), contact, shared))
            }
            _ => None,
        };
    }
    Ok(numbers)
}

fn friction_of(equations: &Equations, reaction: usize) -> Option<&Friction> {
    match &equations.reactions.get(reaction)?.law {
        Law::Friction(friction) => Some(friction),
        _ => None,
    }
}

/// The first friction that slides in a constant ratio to this one and acts like it, this one itself if there is none before it.
fn leader(lowering: &mut Lowering, equations: &Equations, arrangement: &Arrangement, reaction: usize) -> Result<usize, Fault> {
    let Some(friction) = friction_of(equations, reaction) else { return Ok(reaction) };
    let own = lowering.value(friction.sliding)?;
    for r in arrangement.solved.iter().filter(|r| alike(equations, **r, reaction)) {
        let Some(other) = friction_of(equations, *r) else { continue };
        let other = lowering.value(other.sliding)?;
        if moving(own).is_some_and(|own| moving(other).is_some_and(|other| own.1 == other.1)) {
            return Ok(*r);
        }
    }
    Ok(reaction)
}

/// Whether a share that goes from one to the other leaves the limits of both as they are.
fn alike(equations: &Equations, a: usize, b: usize) -> bool {
    let Some(both) = friction_of(equations, a).zip(friction_of(equations, b)) else { return false };
    let limits = |f: &Friction| f.normal.iter().chain(&f.across).flat_map(|normal| &normal.terms).map(|(k, _)| *k).collect::<Vec<usize>>();
    let [own, other] = [limits(both.0), limits(both.1)];
    let rubs = |k: &usize| friction_of(equations, *k).is_some();
    if a == b || own.is_empty() && other.is_empty() {
        return true;
    }
    let [first, second] = [a, b].map(|k| &equations.reactions[k]);
    !own.iter().chain(&other).any(rubs) && first.forces == second.forces && first.released == second.released
}

/// Factor over parameters (none is 1) and the register that it multiplies.
fn moving(value: Value) -> Option<(Option<Register>, Register)> {
    match value {
        Value::Constant(_) => None,
        Value::Plain(rest) => Some((None, rest)),
        Value::Scaled(factor, rest) => Some((Some(factor), rest)),
    }
}

/// Sliding speed by that of the leader.
fn ratio(lowering: &mut Lowering, equations: &Equations, friction: &Friction, leader: usize) -> Result<Value, Fault> {
    let one = lowering.literal(1.0);
    let Some(first) = friction_of(equations, leader).filter(|first| first.sliding != friction.sliding) else { return Ok(one) };
    let (own, other) = (lowering.value(friction.sliding)?, lowering.value(first.sliding)?);
    let factor = |v: Value| moving(v).and_then(|(factor, _)| factor).map_or(one, Value::Constant);
    Ok(lowering.quotient(factor(own), factor(other)))
}

/// What belongs to one way of sliding of the leader: `same` for a positive ratio, `opposite` for a negative one.
fn by_sign(lowering: &mut Lowering, ratio: Value, [same, opposite]: [Value; 2]) -> Value {
    let zero = lowering.literal(0.0);
    match ratio {
        Value::Constant(r) => lowering.branch(By::Value(r), [opposite, zero, same]),
        _ => same,
    }
}

/// Whether other conditions may hold the same motion.
#[derive(Clone, Copy, PartialEq)]
enum Sharing {
    Never,
    Possible,
}

/// A guard that no formula moves: the integrator alone sets its mode.
fn switch(lowering: &mut Lowering, kind: Construct, left: Expr, usual: f64) -> u32 {
    let number = lowering.reserve(GuardOrigin { kind, left, right: None });
    let usual = lowering.literal(usual);
    lowering.define_guard(number, usual);
    number
}

fn contact(lowering: &mut Lowering, reaction: usize, left: Expr, shared: Sharing) -> Result<Numbers, Fault> {
    let surface = lowering.register(left)?;
    let of = lowering.next_guard();
    let force = of + 1;
    let gap = lowering.surface(GuardOrigin { kind: Construct::Gap { reaction, force }, left, right: None }, surface);
    let force = lowering.reserve(GuardOrigin { kind: Construct::ContactForce { reaction, of }, left, right: None });
    lowering.bound(Bounded { guard: force, of: gap });
    let share = (shared == Sharing::Possible).then(|| switch(lowering, Construct::Share { reaction, of }, left, 1.0));
    Ok(Numbers::Gap { gap, force, share })
}

/// What follows a contact may be left to others like the contact itself.
fn rough(lowering: &mut Lowering, (reaction, left): (usize, Expr), contact: Numbers, shared: Sharing) -> Numbers {
    let of = contact.switch();
    let share = (shared == Sharing::Possible).then(|| switch(lowering, Construct::Share { reaction, of }, left, 1.0));
    Numbers::Rough { gap: of as u32, share }
}

fn sliding(
    lowering: &mut Lowering,
    reaction: usize,
    friction: &Friction,
    (led, shared): (Option<Numbers>, Sharing),
) -> Result<Numbers, Fault> {
    let left = friction.sliding;
    if let Some(Numbers::Sliding { leader, sliding, limits, .. }) = led {
        return Ok(Numbers::Sliding { leader, sliding, limits, normal: normal_guard(lowering, reaction, friction), shares: None });
    }
    let surface = lowering.register(left)?;
    let of = lowering.next_guard();
    let kind = Construct::Sliding { reaction, limits: [of + 1, of + 2] };
    let sliding = lowering.surface(GuardOrigin { kind, left, right: None }, surface);
    let limits = [Mode::Negative, Mode::Positive].map(|exit| {
        let limit = lowering.reserve(GuardOrigin { kind: Construct::Limit { reaction, of, exit }, left, right: None });
        lowering.bound(Bounded { guard: limit, of: sliding });
        limit
    });
    let normal = normal_guard(lowering, reaction, friction);
    let shares = (shared == Sharing::Possible).then(|| {
        let share = switch(lowering, Construct::Share { reaction, of }, left, 1.0);
        [share, switch(lowering, Construct::Side { reaction, of }, left, 0.0)]
    });
    Ok(Numbers::Sliding { leader: reaction, sliding, limits, normal, shares })
}

fn normal_guard(lowering: &mut Lowering, reaction: usize, friction: &Friction) -> Option<u32> {
    let guard = GuardOrigin { kind: Construct::Normal { reaction }, left: friction.sliding, right: None };
    friction.normal.as_ref().map(|_| lowering.reserve(guard))
}

/// Computes the surfaces of numbered guards in another tape, before the choices that go by them.
pub(super) fn surfaces(lowering: &mut Lowering, equations: &Equations, numbers: &[Option<Numbers>]) -> Result<(), Fault> {
    for (reaction, numbers) in equations.reactions.iter().zip(numbers) {
        let (guard, surface) = match (&reaction.law, numbers) {
            (Law::Contact { gap, .. }, Some(Numbers::Gap { gap: guard, .. })) => (*guard, *gap),
            (Law::Friction(friction), Some(Numbers::Sliding { sliding, .. })) => (*sliding, friction.sliding),
            _ => continue,
        };
        let surface = lowering.value(surface)?;
        lowering.define_guard(guard, surface);
    }
    Ok(())
}

/// Static limits and forces of frictions that stick together.
struct Group {
    leader: usize,
    limits: [u32; 2],
    capacity: Vec<(f64, Value)>,
    load: Vec<(f64, Value)>,
}

/// Gives the guards that follow from reactions their registers; `first` is the first register of the solution.
pub(super) fn fill(
    lowering: &mut Lowering,
    equations: &Equations,
    arrangement: &Arrangement,
    numbers: &[Option<Numbers>],
    first: Register,
) -> Result<(), Fault> {
    let n = equations.coordinates.len();
    let force = |reaction: usize| {
        let position = arrangement.solved.iter().position(|r| *r == reaction).unwrap_or(0);
        Value::Plain(Register(first.0 + (n + position) as u32))
    };
    let mut groups: Vec<Group> = Vec::new();
    for (reaction, numbers) in numbers.iter().enumerate() {
        match (numbers, &equations.reactions[reaction].law) {
            (Some(Numbers::Gap { force: guard, .. }), _) => lowering.define_guard(*guard, force(reaction)),
            (Some(Numbers::Sliding { leader, limits, normal, .. }), Law::Friction(friction)) => {
                let limit = limit(lowering, friction, *normal, &force)?;
                if *leader == reaction {
                    groups.push(Group { leader: reaction, limits: *limits, capacity: Vec::new(), load: Vec::new() });
                }
                if let Some(group) = groups.iter_mut().find(|g| g.leader == *leader) {
                    let ratio = ratio(lowering, equations, friction, *leader)?;
                    let backwards = lowering.sum(&[(-1.0, ratio)]);
                    let size = by_sign(lowering, ratio, [ratio, backwards]);
                    group.capacity.push((1.0, lowering.times(size, limit)));
                    group.load.push((1.0, lowering.times(ratio, force(reaction))));
                }
            }
            _ => {}
        }
    }
    for group in groups {
        let (capacity, load) = (lowering.sum(&group.capacity), lowering.sum(&group.load));
        for (guard, sign) in group.limits.iter().zip([1.0, -1.0]) {
            let left = lowering.sum(&[(1.0, capacity), (sign, load)]);
            lowering.define_guard(*guard, left);
        }
    }
    Ok(())
}

/// The static limit; |N| by the sign of N, whose guard gets its register here, or from two components.
fn limit(lowering: &mut Lowering, friction: &Friction, guard: Option<u32>, force: &dyn Fn(usize) -> Value) -> Result<Value, Fault> {
    let fixed = lowering.value(friction.fixed)?;
    let (Some(guard), Some(normal)) = (guard, &friction.normal) else { return Ok(fixed) };
    let pressure = component(lowering, normal, force)?;
    if let Some(across) = &friction.across {
        let across = component(lowering, across, force)?;
        let squares = [pressure, across].map(|part| (1.0, lowering.times(part, part)));
        let square = lowering.sum(&squares);
        let magnitude = lowering.root(square);
        return Ok(lowering.times(fixed, magnitude));
    }
    lowering.define_guard(guard, pressure);
    let sides = [lowering.sum(&[(-1.0, pressure)]), lowering.literal(0.0), pressure];
    let magnitude = lowering.branch(By::Mode(guard), sides);
    Ok(lowering.times(fixed, magnitude))
}

/// A component of a normal force from the solved reactions.
fn component(lowering: &mut Lowering, normal: &Normal, force: &dyn Fn(usize) -> Value) -> Result<Value, Fault> {
    let mut items = vec![(1.0, lowering.value(normal.constant)?)];
    for (k, e) in &normal.terms {
        let factor = lowering.value(*e)?;
        items.push((1.0, lowering.times(factor, force(*k))));
    }
    Ok(lowering.sum(&items))
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
