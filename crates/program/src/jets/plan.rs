//! The dynamics tape as a list of steps over rows, with numbers for all coefficients.

use super::faithful::Watched;
use super::steps::{Row, Step};
use crate::curve::Curve;
use crate::{By, Coefficient, Evaluator, Mode, Operation, Register, Spare, Unary};
use std::sync::Arc;

/// Rows, steps and tables of one bound tape.
#[derive(Clone, Debug, Default)]
pub(super) struct Plan {
    /// Row of each register that has one.
    rows: Vec<Option<Row>>,
    /// Number of rows, helpers included.
    pub(super) count: u32,
    /// Rows that hold a constant, with it.
    pub(super) constants: Vec<(Row, f64)>,
    /// All steps in order; a choice appears once per side.
    planned: Vec<Planned>,
    /// (factor, row) of linear steps.
    pub(super) terms: Vec<(f64, Row)>,
    /// Mass matrices.
    pub(super) systems: Vec<System>,
    /// Matrices of motion and reactions.
    pub(super) generals: Vec<GeneralSystem>,
    /// Sources of the row of a choice, with its guard.
    sources: Vec<(Row, usize, [Row; 3])>,
    pub(super) time: Row,
    pub(super) states: Vec<Row>,
    pub(super) rates: Vec<Row>,
    /// Further roots: reactions.
    pub(super) extra: Vec<Row>,
    pub(super) guards: Vec<Row>,
}

/// One instruction's step; for a choice the step depends on the mode.
#[derive(Clone, Debug)]
enum Planned {
    Step(Register, Step),
    Choice { into: Register, guard: usize, sides: [Step; 3] },
}

/// M a = h.
#[derive(Clone, Debug)]
pub(super) struct System {
    pub(super) size: usize,
    /// Lower triangle at order 0: row, or a constant.
    pub(super) entries: Vec<Result<Row, f64>>,
    /// Entries that change in time: (i, j, row), i >= j.
    pub(super) moving: Vec<(u32, u32, Row)>,
    pub(super) right: Vec<Row>,
}

/// A x = b with the rows that may stand in A and b.
#[derive(Clone, Debug)]
pub(super) struct GeneralSystem {
    pub(super) size: usize,
    /// By rows; `None` is zero.
    pub(super) entries: Vec<Option<Row>>,
    pub(super) right: Vec<Row>,
    pub(super) spare: Option<Arc<Spare>>,
}

/// The same on the branches that some modes take: choices are replaced by what they choose, constants by numbers.
#[derive(Clone, Debug, Default)]
pub(super) struct Resolved {
    /// A at order 0: place i n + j, and row or constant; places left out are zero.
    pub(super) entries: Vec<(u32, Result<Row, f64>)>,
    /// Entries that change in time: (i, j, row).
    pub(super) moving: Vec<(u32, u32, Row)>,
    /// Right sides at order 0.
    pub(super) right: Vec<Row>,
    /// Those that change in time: (i, row).
    pub(super) driven: Vec<(u32, Row)>,
    /// Rows of which some repeat others.
    pub(super) spare: Option<Arc<Spare>>,
}

impl Plan {
    pub(super) fn new(evaluator: &Evaluator) -> Plan {
        let tape = evaluator.tape();
        let mut plan = Plan { rows: vec![None; tape.registers()], ..Plan::default() };
        plan.time = plan.fresh();
        plan.states = (0..tape.shape.states).map(|_| plan.fresh()).collect();
        for instruction in &tape.body {
            plan.add(evaluator, instruction.into, &instruction.operation);
        }
        let (rates, extra) = tape.roots.split_at(tape.shape.states.min(tape.roots.len()));
        plan.rates = rates.iter().map(|r| plan.row(evaluator, r.register)).collect();
        plan.extra = extra.iter().map(|r| plan.row(evaluator, r.register)).collect();
        plan.guards = tape.guards.iter().map(|r| r.map_or(0, |r| plan.row(evaluator, r))).collect();
        plan
    }

    fn fresh(&mut self) -> Row {
        self.count += 1;
        self.count - 1
    }

    /// The row of a register; a constant gets one on first demand.
    fn row(&mut self, evaluator: &Evaluator, r: Register) -> Row {
        if let Some(row) = self.rows[r.index()] {
            return row;
        }
        let row = self.fresh();
        self.rows[r.index()] = Some(row);
        self.constants.push((row, evaluator.value(r)));
        row
    }

    pub(super) fn row_of(&self, r: Register) -> Option<Row> {
        self.rows[r.index()]
    }

    fn add(&mut self, evaluator: &Evaluator, into: Register, operation: &Operation) {
        match operation {
            Operation::Time => self.rows[into.index()] = Some(self.time),
            Operation::State(slot) => self.rows[into.index()] = Some(self.states[*slot as usize]),
            Operation::Choose { by, sides } => self.choice(evaluator, into, *by, sides),
            operation => {
                let first = self.count;
                for k in 0..operation.width() {
                    self.rows[into.index() + k] = Some(self.fresh());
                }
                let step = self.step(evaluator, first, operation);
                self.planned.push(Planned::Step(into, step));
            }
        }
    }

    fn choice(&mut self, evaluator: &Evaluator, into: Register, by: By, sides: &[Register; 3]) {
        let sources = sides.map(|r| self.row(evaluator, r));
        let row = self.fresh();
        self.rows[into.index()] = Some(row);
        let sides = sources.map(|source| Step::Copy { row, a: source });
        if let By::Mode(guard) = by {
            self.sources.push((row, guard as usize, sources));
        }
        let planned = match by {
            By::Mode(guard) => Planned::Choice { into, guard: guard as usize, sides },
            // in the dynamics only guards over parameters go by value
            By::Value(r) if evaluator.value(r).is_nan() => Planned::Step(into, Step::Copy { row, a: self.row(evaluator, r) }),
            By::Value(r) => Planned::Step(into, sides[Mode::of(evaluator.value(r)).side()]),
        };
        self.planned.push(planned);
    }

    fn step(&mut self, evaluator: &Evaluator, row: Row, operation: &Operation) -> Step {
        let number = |c: Coefficient| evaluator.coefficient(c);
        let mut at = |r: &Register| self.row(evaluator, *r);
        match operation {
            Operation::Linear { constant, terms } => {
                let terms: Vec<(f64, Row)> = terms.iter().map(|(c, r)| (number(*c), at(r))).collect();
                let constant = number(*constant);
                if let [(factor, a)] = terms[..] {
                    return Step::Scale { row, constant, factor, a };
                }
                let start = self.terms.len() as u32;
                self.terms.extend(terms);
                Step::Linear { row, constant, start, end: self.terms.len() as u32 }
            }
            Operation::Multiply(a, b) => Step::Multiply { row, a: at(a), b: at(b) },
            Operation::Square(a) => Step::Square { row, a: at(a) },
            Operation::Divide(a, b) => Step::Divide { row, a: at(a), b: at(b) },
            Operation::Power(a, p) => Step::Power { row, a: at(a), p: number(*p), weighted: self.helpers(2) },
            Operation::Unary(f, a) => self.unary(evaluator, row, *f, a),
            Operation::Atan2(a, b) => Step::Atan2 { row, y: at(a), x: at(b), helper: self.helpers(4) },
            Operation::SinCos(a) => Step::SinCos { row, a: at(a), weighted: self.helpers(1), sign: -1.0 },
            Operation::SinhCosh(a) => Step::SinCos { row, a: at(a), weighted: self.helpers(1), sign: 1.0 },
            Operation::Solve { matrix, right } => {
                let system = self.system(evaluator, matrix, right);
                self.systems.push(system);
                Step::Solve { row, system: self.systems.len() as u32 - 1 }
            }
            Operation::System { matrix, right, spare } => {
                let entries = matrix.iter().map(|r| r.map(|r| at(&r))).collect();
                let right = right.iter().map(at).collect::<Vec<_>>();
                self.generals.push(GeneralSystem { size: right.len(), entries, right, spare: spare.clone() });
                Step::System { row, system: self.generals.len() as u32 - 1 }
            }
            _ => Step::Copy { row, a: row },
        }
    }

    fn unary(&mut self, evaluator: &Evaluator, row: Row, f: Unary, a: &Register) -> Step {
        let a = self.row(evaluator, *a);
        match f {
            Unary::SquareRoot => Step::SquareRoot { row, a },
            Unary::Exp => Step::Exp { row, a, weighted: self.helpers(1) },
            Unary::Tan => Step::Tangent { row, a, helper: self.helpers(2), sign: 1.0 },
            Unary::Tanh => Step::Tangent { row, a, helper: self.helpers(2), sign: -1.0 },
            Unary::Log | Unary::Asin | Unary::Acos | Unary::Atan | Unary::Asinh | Unary::Acosh | Unary::Atanh => {
                Step::Inverse { row, a, f, helper: self.helpers(3) }
            }
        }
    }

    fn helpers(&mut self, count: u32) -> Row {
        let first = self.count;
        self.count += count;
        first
    }

    fn system(&mut self, evaluator: &Evaluator, matrix: &[Option<Register>], right: &[Register]) -> System {
        let constants = evaluator.tape().constants();
        let (mut entries, mut moving) = (Vec::with_capacity(matrix.len()), Vec::new());
        let mut packed = matrix.iter();
        for i in 0..right.len() {
            for j in 0..=i {
                entries.push(match packed.next().copied().flatten() {
                    None => Err(0.0),
                    Some(r) if r.index() < constants => Err(evaluator.value(r)),
                    Some(r) => {
                        let row = self.row(evaluator, r);
                        moving.push((i as u32, j as u32, row));
                        Ok(row)
                    }
                });
            }
        }
        let right: Vec<Row> = right.iter().map(|r| self.row(evaluator, *r)).collect();
        System { size: right.len(), entries, moving, right }
    }

    /// The general systems on the branches taken.
    pub(super) fn resolve(&self, modes: &[Mode]) -> Vec<Resolved> {
        // what stands in a row: another row, or a constant
        let mut content: Vec<Result<Row, f64>> = (0..self.count).map(Ok).collect();
        self.constants.iter().for_each(|(row, value)| content[*row as usize] = Err(*value));
        for (row, guard, sources) in &self.sources {
            content[*row as usize] = content[sources[modes[*guard].side()] as usize];
        }
        let system = |system: &GeneralSystem| {
            let mut resolved = Resolved { spare: system.spare.clone(), ..Resolved::default() };
            for (position, entry) in system.entries.iter().enumerate() {
                let entry = entry.map_or(Err(0.0), |row| content[row as usize]);
                if let Ok(row) = entry {
                    resolved.moving.push(((position / system.size) as u32, (position % system.size) as u32, row));
                }
                if entry != Err(0.0) {
                    resolved.entries.push((position as u32, entry));
                }
            }
            for (i, row) in (0..).zip(&system.right) {
                resolved.right.push(*row);
                if let Ok(row) = content[*row as usize] {
                    resolved.driven.push((i, row));
                }
            }
            resolved
        };
        self.generals.iter().map(system).collect()
    }

    /// The steps on the branches taken.
    pub(super) fn steps(&self, modes: &[Mode], wanted: &[bool]) -> Vec<Step> {
        let mut steps = Vec::with_capacity(self.planned.len());
        for planned in &self.planned {
            match planned {
                Planned::Step(into, step) => {
                    let width = self.width(step);
                    if wanted[into.index()..into.index() + width].iter().any(|w| *w) {
                        steps.push(*step);
                    }
                }
                Planned::Choice { into, guard, sides } if wanted[into.index()] => steps.push(sides[modes[*guard].side()]),
                Planned::Choice { .. } => {}
            }
        }
        steps
    }

    /// The operations among `live` that can hide something; see `faithful.rs`. Sines and tangents move wherever their argument does.
    pub(super) fn watched(&self, live: &[Step]) -> Vec<Watched> {
        let mut list = Vec::new();
        let mut watch = |curve, a, b, c| list.push(Watched { curve, a, b, c });
        for step in live {
            match *step {
                Step::Multiply { row, a, b } => watch(Curve::Product, a, b, row),
                Step::Square { row, a } => watch(Curve::Square, a, a, row),
                Step::Divide { row, a, b } => watch(Curve::Quotient, a, b, row),
                Step::SquareRoot { row, a } => watch(Curve::Root, a, a, row),
                Step::Power { row, a, p, .. } => watch(Curve::Power(p), a, a, row),
                Step::Exp { row, a, .. } => watch(Curve::Exp, a, a, row),
                Step::SinCos { row, a, sign, .. } if sign > 0.0 => {
                    watch(Curve::Sinh, a, a, row);
                    watch(Curve::Cosh, a, a, row + 1);
                }
                Step::Tangent { row, a, sign, .. } if sign < 0.0 => watch(Curve::Tanh, a, a, row),
                Step::Inverse { row, a, f, .. } => watch(inverse(f), a, a, row),
                Step::Atan2 { row, y, x, .. } => watch(Curve::Angle, y, x, row),
                Step::Solve { row, system } => {
                    let system = &self.systems[system as usize];
                    if let ([(0, 0, entry)], [right]) = (&system.moving[..], &system.right[..]) {
                        watch(Curve::Quotient, *right, *entry, row);
                    }
                }
                _ => {}
            }
        }
        list
    }

    pub(super) fn width(&self, step: &Step) -> usize {
        match step {
            Step::System { system, .. } => self.generals[*system as usize].size,
            Step::SinCos { .. } => 2,
            Step::Solve { system, .. } => self.systems[*system as usize].size,
            _ => 1,
        }
    }

    /// The steps among `live` that active guards depend on.
    pub(super) fn guard_steps(&self, live: &[Step], active: &[bool]) -> Vec<Step> {
        let mut wanted = vec![false; self.count as usize];
        for (row, _) in self.guards.iter().zip(active).filter(|(_, a)| **a) {
            wanted[*row as usize] = true;
        }
        let mut tail = Vec::new();
        for step in live.iter().rev() {
            let first = step.row() as usize;
            if wanted[first..first + self.width(step)].iter().any(|w| *w) {
                tail.push(*step);
                step.operands(self, &mut |row| wanted[row as usize] = true);
            }
        }
        tail.reverse();
        tail
    }

    /// Rows of guards that steps of the tail write.
    pub(super) fn active_guards(&self, tail: &[Step]) -> Vec<Row> {
        let mut written = vec![false; self.count as usize];
        for step in tail {
            let first = step.row() as usize;
            written[first..first + self.width(step)].fill(true);
        }
        self.guards.iter().copied().filter(|row| written[*row as usize]).collect()
    }
}

fn inverse(f: Unary) -> Curve {
    match f {
        Unary::Asin => Curve::Asin,
        Unary::Acos => Curve::Acos,
        Unary::Atan => Curve::Atan,
        Unary::Asinh => Curve::Asinh,
        Unary::Acosh => Curve::Acosh,
        Unary::Atanh => Curve::Atanh,
        _ => Curve::Log,
    }
}
