//! Guards: the functions whose signs decide branches.
//!
//! sign, abs, if, min and max are piecewise smooth; their pieces are chosen by the sign of a guard function. Each distinct guard
//! function (up to a constant factor) has one number. In the dynamics the sign is not read off the value but given as a [`Mode`], so
//! that a Taylor expansion stays on one smooth piece up to an event; the integrator watches the guard polynomial for its zero.
//!
//! A guard matters only when the branch in which it stands is taken: [`crate::Bound::active`] finds the ones that matter by a backward
//! walk from the results through the branches taken.

use crate::mode::Mode;
use crate::{By, Evaluator, Operation, Register};
use symbolic::Expr;

/// The construct that a guard came from first. Reactions are numbered as in `Equations::reactions`, guards as in `Program::guards`.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[allow(missing_docs)]
pub enum Construct {
    Sign,
    Abs,
    If,
    Min,
    Max,
    /// Sliding speed of a dry friction: slides back, sticks (`Zero`: the condition holds), slides forth.
    Sliding {
        reaction: usize,
        /// The guards of kind `Limit`: towards negative and towards positive sliding. Both count only while this guard is `Zero`.
        limits: [usize; 2],
    },
    /// What a sticking friction has left: static limit + λ (exit `Negative`), static limit - λ (exit `Positive`).
    Limit {
        reaction: usize,
        /// The guard of kind `Sliding`.
        of: usize,
        /// How it slides when this falls below zero.
        exit: Mode,
    },
    /// The normal force of a friction, where it is computed from reactions and may have either sign; an ordinary switch.
    Normal {
        reaction: usize,
    },
    /// Whether the condition of a closed contact or a sticking friction is an equation (`Positive`) or is met through the others, so that the reaction
    /// follows from `Side`: 0 for a contact, a share of the static limit for a friction. Decided by the integrator where conditions repeat each other.
    Share {
        reaction: usize,
        /// The guard of kind `Gap` or `Sliding`.
        of: usize,
    },
    /// Sign of the static limit at which a friction whose condition is met through others stands; 0: it takes nothing.
    Side {
        reaction: usize,
        /// The guard of kind `Sliding`.
        of: usize,
    },
    /// Gap of a contact: open (`Positive`), closed (`Zero`; `Negative` is the same).
    Gap {
        reaction: usize,
        /// The guard of kind `ContactForce`. It counts only while this guard is `Zero`.
        force: usize,
    },
    /// Force of a closed contact.
    ContactForce {
        reaction: usize,
        /// The guard of kind `Gap`.
        of: usize,
    },
}

/// A guard function, left - right; handles are of the graph of the equations.
///
/// `Limit`, `Normal` and `ContactForce` are no expressions but follow from the solved reactions; `left` is then that of the friction's or
/// the contact's first guard, and a name for people is made of the reaction's.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct GuardOrigin {
    /// Where it first occurs.
    pub kind: Construct,
    /// The expression, or the first argument of min and max.
    pub left: Expr,
    /// The second argument of min and max; 0 when absent.
    pub right: Option<Expr>,
}

/// Marks what the roots of a tape need in given modes: registers and guards.
pub(crate) fn needed(dynamics: &Evaluator, modes: &[Mode]) -> (Vec<bool>, Vec<bool>) {
    let tape = dynamics.tape();
    let mut needs = Needs { wanted: vec![false; tape.registers()], active: vec![false; tape.guards.len()] };
    for root in &tape.roots {
        needs.wanted[root.register.index()] = true;
    }
    // a guard may follow the choice that goes by it (its value needs the solved reactions), so one walk is not always enough
    while needs.walk(dynamics, modes) {}
    (needs.wanted, needs.active)
}

struct Needs {
    wanted: Vec<bool>,
    active: Vec<bool>,
}

impl Needs {
    /// One walk backwards; true when it marked a register that it had passed already.
    fn walk(&mut self, dynamics: &Evaluator, modes: &[Mode]) -> bool {
        let tape = dynamics.tape();
        let mut again = false;
        for instruction in tape.body.iter().rev() {
            let first = instruction.into.index();
            if !self.wanted[first..first + instruction.operation.width()].iter().any(|w| *w) {
                continue;
            }
            match &instruction.operation {
                Operation::Choose { by: By::Mode(g), sides } => {
                    self.wanted[sides[modes[*g as usize].side()].index()] = true;
                    again |= self.activate(dynamics, *g as usize, instruction.into);
                }
                Operation::Choose { by: By::Value(r), sides } if r.index() < tape.constants() => {
                    self.wanted[sides[Mode::of(dynamics.value(*r)).side()].index()] = true;
                }
                operation => operation.operands(&mut |r| self.wanted[r.index()] = true),
            }
        }
        for bound in &tape.bounds {
            let of = bound.of as usize;
            if self.active[of] && modes[of] == Mode::Zero {
                again |= self.activate(dynamics, bound.guard as usize, Register(0));
            }
        }
        again
    }

    fn activate(&mut self, dynamics: &Evaluator, guard: usize, passed: Register) -> bool {
        self.active[guard] = true;
        let Some(r) = dynamics.tape().guards[guard] else { return false };
        let fresh = !std::mem::replace(&mut self.wanted[r.index()], true);
        fresh && r >= passed
    }
}

pub(crate) fn active(dynamics: &Evaluator, modes: &[Mode]) -> Vec<bool> {
    needed(dynamics, modes).1
}

/// (guard, time) of guards a + b t.
pub(crate) fn scheduled(dynamics: &Evaluator) -> Vec<(usize, f64)> {
    let tape = dynamics.tape();
    let mut affine: Vec<Option<(f64, f64)>> = vec![None; tape.registers()];
    for (r, line) in (0..).zip(affine.iter_mut().take(tape.constants())) {
        *line = Some((dynamics.value(Register(r)), 0.0));
    }
    for instruction in &tape.body {
        affine[instruction.into.index()] = match &instruction.operation {
            Operation::Time => Some((0.0, 1.0)),
            Operation::Linear { constant, terms } => terms.iter().try_fold((dynamics.coefficient(*constant), 0.0), |(a, b), (c, r)| {
                let (c, (inner_a, inner_b)) = (dynamics.coefficient(*c), affine[r.index()]?);
                Some((a + c * inner_a, b + c * inner_b))
            }),
            _ => None,
        };
    }
    let mut times: Vec<(usize, f64)> = tape
        .guards
        .iter()
        .enumerate()
        .filter_map(|(g, r)| affine[(*r)?.index()].map(|line| (g, line)))
        .filter(|(_, (a, b))| *b != 0.0 && (a / b).is_finite())
        .map(|(g, (a, b))| (g, -a / b))
        .collect();
    times.sort_by(|x, y| x.1.total_cmp(&y.1).then(x.0.cmp(&y.0)));
    times
}
