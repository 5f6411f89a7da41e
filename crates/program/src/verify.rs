//! The verifier: what every tape satisfies.
//!
//! 1. Registers are numbered without gaps in the order of the instructions, prologue first; an operand is written before it is read.
//! 2. The prologue reads parameters only; literals and parameters stand nowhere else; coefficients and exponents are of the prologue.
//! 3. Slots lie within the shape; every mode has a guard entry.
//! 4. A choice by mode comes after the register of its guard, when the tape computes it, unless a general system stands between them: such a
//!    guard depends on the reactions that the system gives.
//! 5. A symmetric system has n(n+1)/2 entries, a general one n², with n right sides and at least one row.
//! 6. Roots and guards are registers of the tape; bounds name guards.

use crate::{By, Coefficient, Fault, Instruction, Operation, Register, Tape};

/// Checks a tape.
///
/// *Errors*: P020 naming the first instruction that breaks a rule.
pub fn verify(tape: &Tape) -> Result<(), Fault> {
    let constants = tape.constants();
    let mut next = 0;
    for (position, instruction) in tape.instructions().enumerate() {
        let place = |words: &str| Fault::about("P020", format!("{}, %{}: {words}", tape.name, instruction.into.0));
        if instruction.into.index() != next {
            return Err(place("register out of sequence"));
        }
        check_operands(instruction).map_err(place)?;
        let part = if position < tape.prologue.len() { Part::Prologue } else { Part::Body };
        check_section(instruction, part, constants).map_err(place)?;
        check_slots(tape, instruction).map_err(place)?;
        next += instruction.operation.width();
    }
    check_ends(tape, next)
}

/// [`verify`] in debug builds; a failure there is a fault of the pass.
pub(crate) fn verified(tape: Tape) -> Result<Tape, Fault> {
    if cfg!(debug_assertions) {
        verify(&tape)?;
    }
    Ok(tape)
}

type Broken = Result<(), &'static str>;

fn check_operands(instruction: &Instruction) -> Broken {
    let mut early = false;
    instruction.operation.operands(&mut |r| early |= r >= instruction.into);
    if early { Err("operand is read before it is written") } else { Ok(()) }
}

/// The parts of a tape: what no state changes, and the rest.
#[derive(Clone, Copy, PartialEq)]
enum Part {
    Prologue,
    Body,
}

fn check_section(instruction: &Instruction, part: Part, constants: usize) -> Broken {
    let prologue = part == Part::Prologue;
    let state = matches!(
        instruction.operation,
        Operation::Time
            | Operation::State(_)
            | Operation::Acceleration(_)
            | Operation::Solve { .. }
            | Operation::System { .. }
            | Operation::Choose { by: By::Mode(_), .. }
    );
    let leaf = matches!(instruction.operation, Operation::Number(_) | Operation::Parameter(_));
    if prologue && state {
        return Err("state in the prologue");
    }
    if !prologue && leaf {
        return Err("literal or parameter in the body");
    }
    let inner = |c: &Coefficient| matches!(c, Coefficient::Register(r) if r.index() >= constants);
    let varying = match &instruction.operation {
        Operation::Linear { constant, terms } => inner(constant) || terms.iter().any(|(c, _)| inner(c)),
        Operation::Power(_, p) => inner(p),
        _ => false,
    };
    if varying { Err("coefficient is not of the prologue") } else { Ok(()) }
}

fn check_slots(tape: &Tape, instruction: &Instruction) -> Broken {
    let shape = &tape.shape;
    let inside = |slot: &u32, count: usize| if (*slot as usize) < count { Ok(()) } else { Err("slot out of range") };
    match &instruction.operation {
        Operation::Parameter(slot) => inside(slot, shape.parameters),
        Operation::State(slot) => inside(slot, shape.states),
        Operation::Acceleration(slot) => inside(slot, shape.accelerations),
        Operation::Choose { by: By::Mode(g), .. } => {
            inside(g, shape.modes.min(tape.guards.len()))?;
            match tape.guards[*g as usize] {
                Some(r) if r >= instruction.into && !system_between(tape, instruction.into, r) => Err("choice before its guard"),
                _ => Ok(()),
            }
        }
        Operation::Solve { matrix, right } => {
            let n = right.len();
            if n > 0 && matrix.len() == n * (n + 1) / 2 { Ok(()) } else { Err("system has the wrong shape") }
        }
        Operation::System { matrix, right, spare } => {
            let n = right.len();
            let fits = spare.as_ref().is_none_or(|spare| spare.fits(n));
            if n > 0 && matrix.len() == n * n && fits { Ok(()) } else { Err("system has the wrong shape") }
        }
        _ => Ok(()),
    }
}

fn system_between(tape: &Tape, first: Register, last: Register) -> bool {
    tape.body.iter().any(|i| matches!(i.operation, Operation::System { .. }) && first < i.into && i.into <= last)
}

fn check_ends(tape: &Tape, registers: usize) -> Result<(), Fault> {
    let fault = |words: &str| Err(Fault::about("P020", format!("{}: {words}", tape.name)));
    let outside = |r: &Register| r.index() >= registers;
    if tape.guards.len() != tape.shape.modes {
        return fault("guards and modes differ in number");
    }
    if tape.guards.iter().flatten().any(outside) {
        return fault("guard is not a register");
    }
    if tape.bounds.iter().any(|b| [b.guard, b.of].iter().any(|g| *g as usize >= tape.guards.len())) {
        return fault("bound is not a guard");
    }
    if tape.roots.iter().any(|root| outside(&root.register)) {
        return fault("root is not a register");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::verify;
    use crate::{Tape, text};

    const SOUND: &str = "\
tape sample
inputs parameters=1 states=2 accelerations=0 modes=1
prologue
  %0 = parameter 0
  %1 = number 0.5
body
  %2 = state 0
  %3 = linear %0 + %1*%2 + 2*%2
  %4 %5 = sincos %2
  %6 = choose mode 0 %1 %4 %5
  %7 = solve %3 | %6
  %8 = power %2 %0
guards
  %2
roots
  %7 x'
  %8 y
";

    fn broken(from: &str, to: &str) -> String {
        assert!(SOUND.contains(from));
        let tape: Tape = text::parse_unchecked(&SOUND.replace(from, to)).unwrap();
        verify(&tape).unwrap_err().what.en.clone()
    }

    #[test]
    fn sound_tape_passes() {
        verify(&text::parse(SOUND).unwrap()).unwrap();
    }
    #[test]
    fn operand_from_the_future_is_caught() {
        assert!(broken("sincos %2", "sincos %7").contains("before it is written"));
    }
    #[test]
    fn gap_in_numbers_is_caught() {
        assert!(broken("%6 = choose", "%9 = choose").contains("sequence"));
    }
    #[test]
    fn state_in_prologue_is_caught() {
        assert!(broken("%1 = number 0.5", "%1 = time").contains("state in the prologue"));
    }
    #[test]
    fn literal_in_body_is_caught() {
        assert!(broken("%2 = state 0", "%2 = number 3").contains("in the body"));
    }
    #[test]
    fn varying_coefficient_is_caught() {
        assert!(broken("%1*%2", "%2*%2").contains("coefficient"));
        assert!(broken("power %2 %0", "power %2 %3").contains("coefficient"));
    }
    #[test]
    fn slot_out_of_range_is_caught() {
        assert!(broken("parameter 0", "parameter 1").contains("slot"));
        assert!(broken("state 0", "state 2").contains("slot"));
        assert!(broken("mode 0", "mode 1").contains("slot"));
    }
    #[test]
    fn choice_before_its_guard_is_caught() {
        assert!(broken("guards\n  %2", "guards\n  %6").contains("before its guard"));
    }
    #[test]
    fn wrong_system_is_caught() {
        assert!(broken("solve %3 | %6", "solve %3 %3 | %6").contains("shape"));
    }
    #[test]
    fn wrong_general_system_is_caught() {
        assert!(broken("solve %3 | %6", "solve-general %3 %3 | %6").contains("shape"));
    }
    #[test]
    fn guard_after_a_system_may_follow_its_choice() {
        // the guard is computed from the solution: %8 = x^p
        let late = SOUND.replace("guards\n  %2", "guards\n  %8");
        assert!(verify(&text::parse_unchecked(&late).unwrap()).unwrap_err().what.en.contains("before its guard"));
        verify(&text::parse_unchecked(&late.replace("solve %3", "solve-general %3")).unwrap()).unwrap();
    }
    #[test]
    fn bound_of_no_guard_is_caught() {
        assert!(broken("roots\n", "bounds\n  0 of 1\nroots\n").contains("bound"));
    }
    #[test]
    fn ends_outside_are_caught() {
        assert!(broken("guards\n  %2", "guards\n  %20").contains("guard"));
        assert!(broken("  %8 y", "  %80 y").contains("root"));
        assert!(broken("modes=1", "modes=2").contains("differ"));
    }
}
