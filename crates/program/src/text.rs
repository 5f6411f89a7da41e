//! Tapes as text, and back. Reading what was written gives the same tape (all but the origins of instructions), every bit of every
//! literal included: numbers are written in their shortest form that reads back exactly.
//!
//! ```text
//! tape NAME
//! inputs parameters=1 states=2 accelerations=0 modes=1
//! prologue
//!   %0 = parameter 0
//!   %1 = number 9.81
//! body
//!   %2 = state 0
//!   %3 = linear 0 + -1*%2 + %0*%2       constant, then coefficient*register
//!   %4 %5 = sincos %2
//!   %6 = choose mode 0 %1 %1 %4         negative, zero, positive; or: choose value %2 ...
//!   %7 %8 = solve %0 - %3 | %4 %5       lower triangle by rows, - is zero; right sides after |
//!   %9 = solve-general %0 | %4          the same with the whole matrix, by rows; behind it may stand | count | rows that stay | row:unknown:size | sizes of
//!                                       columns: rows of which `count` repeat others
//! guards
//!   %2                                  - when this tape does not compute it
//! bounds                                absent when there are none
//!   1 of 0                              guard 1 counts while guard 0 is zero
//! roots
//!   %7 NAME
//! ```

use crate::{Bounded, By, Coefficient, Fault, Instruction, Operation, Real, Register, Root, Shape, Spare, Tape, Unary, verify::verify};
use std::fmt::{self, Display, Write};
use std::sync::Arc;

impl Display for Register {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "%{}", self.0)
    }
}

impl Display for Coefficient {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Coefficient::Number(v) => write!(f, "{:?}", v.0),
            Coefficient::Register(r) => r.fmt(f),
        }
    }
}

impl Display for Operation {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.kind())?;
        match self {
            Operation::Number(v) => write!(f, " {:?}", v.0),
            Operation::Parameter(slot) | Operation::State(slot) | Operation::Acceleration(slot) => write!(f, " {slot}"),
            Operation::Time => Ok(()),
            Operation::Linear { constant, terms } => {
                write!(f, " {constant}")?;
                terms.iter().try_for_each(|(c, r)| write!(f, " + {c}*{r}"))
            }
            Operation::Multiply(a, b) | Operation::Divide(a, b) | Operation::Atan2(a, b) => write!(f, " {a} {b}"),
            Operation::Power(a, p) => write!(f, " {a} {p}"),
            Operation::Square(a) | Operation::Unary(_, a) | Operation::SinCos(a) | Operation::SinhCosh(a) => write!(f, " {a}"),
            Operation::Choose { by, sides: [n, z, p] } => match by {
                By::Mode(g) => write!(f, " mode {g} {n} {z} {p}"),
                By::Value(r) => write!(f, " value {r} {n} {z} {p}"),
            },
            Operation::Solve { matrix, right } => write_system(f, matrix, right),
            Operation::System { matrix, right, spare } => {
                write_system(f, matrix, right)?;
                spare.iter().try_for_each(|spare| write_spare(f, spare))
            }
        }
    }
}

fn write_system(f: &mut fmt::Formatter, matrix: &[Option<Register>], right: &[Register]) -> fmt::Result {
    matrix.iter().try_for_each(|r| write!(f, " {}", Entry(*r)))?;
    f.write_str(" |")?;
    right.iter().try_for_each(|r| write!(f, " {r}"))
}

fn write_spare(f: &mut fmt::Formatter, spare: &Spare) -> fmt::Result {
    write!(f, " | {} |", spare.count)?;
    spare.fixed.iter().try_for_each(|row| write!(f, " {row}"))?;
    f.write_str(" |")?;
    spare.pairs.iter().try_for_each(|(row, unknown, size)| write!(f, " {row}:{unknown}:{:?}", size.0))?;
    f.write_str(" |")?;
    spare.columns.iter().try_for_each(|size| write!(f, " {:?}", size.0))
}

struct Entry(Option<Register>);

impl Display for Entry {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.0 {
            Some(r) => r.fmt(f),
            None => f.write_char('-'),
        }
    }
}

impl Display for Instruction {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for k in 0..self.operation.width() as u32 {
            write!(f, "%{} ", self.into.0 + k)?;
        }
        write!(f, "= {}", self.operation)
    }
}

impl Display for Tape {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Shape { parameters, states, accelerations, modes } = self.shape;
        writeln!(f, "tape {}", self.name)?;
        writeln!(f, "inputs parameters={parameters} states={states} accelerations={accelerations} modes={modes}")?;
        f.write_str("prologue\n")?;
        self.prologue.iter().try_for_each(|i| writeln!(f, "  {i}"))?;
        f.write_str("body\n")?;
        self.body.iter().try_for_each(|i| writeln!(f, "  {i}"))?;
        f.write_str("guards\n")?;
        self.guards.iter().try_for_each(|g| writeln!(f, "  {}", Entry(*g)))?;
        if !self.bounds.is_empty() {
            f.write_str("bounds\n")?;
            self.bounds.iter().try_for_each(|b| writeln!(f, "  {} of {}", b.guard, b.of))?;
        }
        f.write_str("roots\n")?;
        self.roots.iter().try_for_each(|r| writeln!(f, "  {} {}", r.register, r.name))
    }
}

/// Reads a tape and verifies it.
///
/// *Errors*: P021 with the line that cannot be read, P020 when the tape breaks a rule.
pub fn parse(text: &str) -> Result<Tape, Fault> {
    let tape = parse_unchecked(text)?;
    verify(&tape)?;
    Ok(tape)
}

/// [`parse`] without the verifier.
pub(crate) fn parse_unchecked(text: &str) -> Result<Tape, Fault> {
    let mut tape = Tape::default();
    let mut section = "";
    for (i, line) in text.lines().enumerate() {
        read_line(line, &mut section, &mut tape).ok_or_else(|| Fault::about("P021", format!("{}: {}", i + 1, line.trim())))?;
    }
    Ok(tape)
}

fn read_line<'t>(line: &'t str, section: &mut &'t str, tape: &mut Tape) -> Option<()> {
    let Some(entry) = line.strip_prefix("  ") else {
        match line.split_once(' ').unwrap_or((line, "")) {
            ("tape", name) => tape.name = name.to_owned(),
            ("inputs", sizes) => tape.shape = read_shape(sizes)?,
            ("prologue" | "body" | "guards" | "bounds" | "roots", "") => *section = line,
            _ => return None,
        }
        return Some(());
    };
    match *section {
        "prologue" => tape.prologue.push(read_instruction(entry)?),
        "body" => tape.body.push(read_instruction(entry)?),
        "guards" => tape.guards.push(read_entry(entry)?),
        "bounds" => {
            let (guard, of) = entry.split_once(" of ")?;
            tape.bounds.push(Bounded { guard: guard.parse().ok()?, of: of.parse().ok()? });
        }
        "roots" => {
            let (register, name) = entry.split_once(' ')?;
            tape.roots.push(Root { name: name.to_owned(), register: read_register(register)? });
        }
        _ => return None,
    }
    Some(())
}

fn read_shape(sizes: &str) -> Option<Shape> {
    let mut sizes = sizes.split(' ');
    let mut next = |name: &str| sizes.next()?.strip_prefix(name)?.strip_prefix('=')?.parse().ok();
    Some(Shape { parameters: next("parameters")?, states: next("states")?, accelerations: next("accelerations")?, modes: next("modes")? })
}

fn read_instruction(entry: &str) -> Option<Instruction> {
    let (left, right) = entry.split_once(" = ")?;
    let into: Vec<Register> = left.split(' ').map(read_register).collect::<Option<_>>()?;
    let operation = read_operation(right)?;
    let first = *into.first()?;
    let sequence = into.iter().zip(first.0..).all(|(r, n)| r.0 == n);
    (sequence && into.len() == operation.width()).then_some(Instruction { into: first, operation, origin: None })
}

fn read_operation(words: &str) -> Option<Operation> {
    let (verb, rest) = words.split_once(' ').unwrap_or((words, ""));
    if let Some((u, _)) = Unary::ALL.iter().find(|(_, n)| *n == verb) {
        return Some(Operation::Unary(*u, read_register(rest)?));
    }
    let two = || {
        let (a, b) = rest.split_once(' ')?;
        Some((read_register(a)?, read_register(b)?))
    };
    Some(match verb {
        "number" => Operation::Number(crate::Real(rest.parse().ok()?)),
        "parameter" => Operation::Parameter(rest.parse().ok()?),
        "time" => Operation::Time,
        "state" => Operation::State(rest.parse().ok()?),
        "acceleration" => Operation::Acceleration(rest.parse().ok()?),
        "linear" => read_linear(rest)?,
        "multiply" => two().map(|(a, b)| Operation::Multiply(a, b))?,
        "square" => Operation::Square(read_register(rest)?),
        "divide" => two().map(|(a, b)| Operation::Divide(a, b))?,
        "atan2" => two().map(|(a, b)| Operation::Atan2(a, b))?,
        "power" => {
            let (a, p) = rest.split_once(' ')?;
            Operation::Power(read_register(a)?, read_coefficient(p)?)
        }
        "sincos" => Operation::SinCos(read_register(rest)?),
        "sinhcosh" => Operation::SinhCosh(read_register(rest)?),
        "choose" => read_choice(rest)?,
        "solve" => read_system(rest).map(|(matrix, right)| Operation::Solve { matrix, right })?,
        "solve-general" => read_general(rest)?,
        _ => return None,
    })
}

type SystemOperands = (Box<[Option<Register>]>, Box<[Register]>);

fn read_general(rest: &str) -> Option<Operation> {
    let parts: Vec<&str> = rest.splitn(3, " |").collect();
    let spare = match parts.get(2) {
        Some(text) => Some(Arc::new(read_spare(text)?)),
        None => None,
    };
    let (matrix, right) = read_system(&rest[..rest.len() - parts.get(2).map_or(0, |text| text.len() + 2)])?;
    Some(Operation::System { matrix, right, spare })
}

fn read_spare(text: &str) -> Option<Spare> {
    let parts: Vec<&str> = text.split('|').collect();
    let [count, fixed, pairs, columns] = parts[..] else { return None };
    let pair = |word: &str| {
        let mut words = word.split(':');
        Some((words.next()?.parse().ok()?, words.next()?.parse().ok()?, Real(words.next()?.parse().ok()?)))
    };
    Some(Spare {
        count: count.trim().parse().ok()?,
        fixed: fixed.split_whitespace().map(|word| word.parse().ok()).collect::<Option<_>>()?,
        pairs: pairs.split_whitespace().map(pair).collect::<Option<_>>()?,
        columns: columns.split_whitespace().map(|word| word.parse().ok().map(Real)).collect::<Option<_>>()?,
    })
}

fn read_system(rest: &str) -> Option<SystemOperands> {
    let (matrix, right) = rest.split_once(" | ")?;
    let matrix = matrix.split(' ').map(read_entry).collect::<Option<_>>()?;
    Some((matrix, right.split(' ').map(read_register).collect::<Option<_>>()?))
}

fn read_linear(rest: &str) -> Option<Operation> {
    let mut parts = rest.split(" + ");
    let constant = read_coefficient(parts.next()?)?;
    let term = |part: &str| {
        let (c, r) = part.split_once('*')?;
        Some((read_coefficient(c)?, read_register(r)?))
    };
    Some(Operation::Linear { constant, terms: parts.map(term).collect::<Option<_>>()? })
}

fn read_choice(rest: &str) -> Option<Operation> {
    let words: Vec<&str> = rest.split(' ').collect();
    let [by, which, negative, zero, positive] = words[..] else { return None };
    let by = match by {
        "mode" => By::Mode(which.parse().ok()?),
        "value" => By::Value(read_register(which)?),
        _ => return None,
    };
    Some(Operation::Choose { by, sides: [read_register(negative)?, read_register(zero)?, read_register(positive)?] })
}

fn read_register(word: &str) -> Option<Register> {
    word.strip_prefix('%')?.parse().ok().map(Register)
}

fn read_entry(word: &str) -> Option<Option<Register>> {
    if word == "-" { Some(None) } else { read_register(word).map(Some) }
}

fn read_coefficient(word: &str) -> Option<Coefficient> {
    read_register(word).map(Coefficient::Register).or_else(|| word.parse().ok().map(Coefficient::number))
}

#[cfg(test)]
mod tests {
    use super::parse;

    #[test]
    fn unreadable_lines_are_named() {
        let head = "tape a\ninputs parameters=0 states=0 accelerations=0 modes=0\nprologue\n";
        for line in [
            "  %0 = nothing 1",
            "  %0 = number",
            "  %0 = number x",
            "  %0",
            "  %0 %1 = number 1",
            "  %0 %2 = sincos %0",
            "prologues",
            "\u{444}",
        ] {
            let fault = parse(&format!("{head}{line}\n")).unwrap_err();
            assert_eq!(fault.code, "P021", "{line}");
            assert!(fault.what.en.contains('4'), "{}", fault.what.en);
        }
    }

    #[test]
    fn every_bit_of_a_literal_survives() {
        for value in [0.1, 1e300, 5e-324, -2.5e-17, 1.0 / 3.0, f64::MAX] {
            let text = format!(
                "tape a\ninputs parameters=0 states=0 accelerations=0 modes=0\nprologue\n  %0 = number {value:?}\nbody\nguards\nroots\n  %0 r\n"
            );
            assert_eq!(parse(&text).unwrap().to_string(), text);
        }
    }
}
