//! Guards of contacts and frictions: their numbers, their surfaces, and the limits that follow from reactions.
//!
//! Frictions whose sliding speeds are in a constant ratio r (two feet of a block, brakes of different radii on a shaft) stick and slide together: the first
//! leads, the others share its guards. While they stick only the sum Σ r λ of what they do on the leader's motion is determined; it is compared with
//! Σ |r| limit, and shared in proportion to the limits. Where normal forces from reactions make the limits unknown, the first takes all: that is of no
//! consequence where all of the group act alike. Where they do not (two drums on one rope, each pressed by a tension that the other changes) the limits depend
//! on the shares; then each stands for itself, and the integrator finds shares that agree with all limits (`Share`, `Side`).

use super::arrangement::{Arrangement, friction_of};
use super::expressions::Lowering;
use super::forms::Value;
use super::numbers::Numbers;
use crate::{Bounded, By, Construct, Fault, GuardOrigin, Mode, Register};
use symbolic::connections::{Friction, Law, Normal};
use symbolic::{Equations, Expr};

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
pub(super) fn ratio(lowering: &mut Lowering, equations: &Equations, friction: &Friction, leader: usize) -> Result<Value, Fault> {
    let one = lowering.literal(1.0);
    let Some(first) = friction_of(equations, leader).filter(|first| first.sliding != friction.sliding) else { return Ok(one) };
    let (own, other) = (lowering.value(friction.sliding)?, lowering.value(first.sliding)?);
    let factor = |v: Value| moving(v).and_then(|(factor, _)| factor).map_or(one, Value::Constant);
    Ok(lowering.quotient(factor(own), factor(other)))
}

/// What belongs to one way of sliding of the leader: `same` for a positive ratio, `opposite` for a negative one.
pub(super) fn by_sign(lowering: &mut Lowering, ratio: Value, [same, opposite]: [Value; 2]) -> Value {
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
