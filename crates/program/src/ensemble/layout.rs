//! What is done at each order, the same in all lanes: the operations of several tapes over one list of rows. Numbers are apart, since each lane has its own.
//!
//! Tapes that were specialised for the numbers of one machine become the layout of that machine and its numbers. Machines whose layouts are equal go in lanes beside each other; where a number is zero in one
//! of them and its operations have fallen away, the layouts differ. So what is computed in a lane follows from its own machine alone. Numbers are named by their first appearance: what is equal in the
//! list of a layout is equal in every lane, and equal operations are done once, though they come from tapes that were lowered apart.

use crate::{By, Coefficient, Operation, Register, Tape, Unary};
use rustc_hash::FxHashMap;

/// A row: coefficients of one quantity in all lanes.
pub(super) type Row = u32;
/// A number that each lane has by itself.
pub(super) type Number = u32;

/// Degree of a row that is no polynomial of time.
pub(super) const UNBOUNDED: usize = usize::MAX;

/// An operation; rows behind `row` that it needs are its own.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(super) enum What {
    Literal(Number),
    Time,
    State(u32),
    Linear {
        constant: Number,
        terms: Box<[(Number, Row)]>,
    },
    Multiply(Row, Row),
    Square(Row),
    Divide(Row, Row),
    Root(Row),
    /// With two rows of its own.
    Power(Row, Number),
    /// One.
    Exp(Row),
    /// One.
    Log(Row),
    /// Sine or, where `hyperbolic`, its hyperbolic counterpart; the cosine follows, then one row.
    SinCos {
        a: Row,
        hyperbolic: bool,
    },
    /// tanh, with two.
    Tanh(Row),
    Choose {
        guard: u32,
        sides: [Row; 3],
    },
    /// n results, then n² of the factors.
    Solve {
        matrix: Box<[Option<Row>]>,
        right: Box<[Row]>,
    },
}

impl What {
    /// Rows of results, and rows of its own.
    fn widths(&self) -> [u32; 2] {
        match self {
            What::SinCos { .. } => [2, 1],
            What::Exp(_) | What::Log(_) => [1, 1],
            What::Power(..) | What::Tanh(_) => [1, 2],
            What::Solve { right, .. } => [right.len() as u32, (right.len() * right.len()) as u32],
            _ => [1, 0],
        }
    }

    /// Rows of its own.
    pub(super) fn own(&self) -> u32 {
        self.widths()[1]
    }

    pub(super) fn operands(&self, visit: &mut dyn FnMut(Row)) {
        match self {
            What::Literal(_) | What::Time | What::State(_) => {}
            What::Linear { terms, .. } => terms.iter().for_each(|term| visit(term.1)),
            What::Multiply(a, b) | What::Divide(a, b) => [*a, *b].into_iter().for_each(visit),
            What::Square(a) | What::Root(a) | What::Power(a, _) | What::Exp(a) | What::Log(a) | What::Tanh(a) | What::SinCos { a, .. } => {
                visit(*a);
            }
            What::Choose { sides, .. } => sides.iter().copied().for_each(visit),
            What::Solve { matrix, right } => matrix.iter().flatten().chain(right.iter()).copied().for_each(visit),
        }
    }
}

/// An operation and where its results stand.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Step {
    pub(super) row: Row,
    /// First row of its own.
    pub(super) own: Row,
    /// Number of results.
    pub(super) width: u32,
    pub(super) what: What,
}

/// The tapes of a motion in lanes, without choices by value and with numbers for all parameters.
#[derive(Clone, Copy, Debug)]
pub struct Parts<'a> {
    /// x' and the guards; roots behind x' are prescribed velocities.
    pub dynamics: &'a Tape,
    /// T and Π.
    pub levels: &'a Tape,
    /// Powers of loads and drives, and what is dissipated.
    pub supply: &'a Tape,
    /// Number of coordinates, whose accelerations the powers may read.
    pub coordinates: usize,
}

/// Operations of a motion, see the head of the file.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Layout {
    pub(super) steps: Vec<Step>,
    pub(super) count: u32,
    pub(super) numbers: usize,
    pub(super) coordinates: usize,
    pub(super) states: Vec<Row>,
    pub(super) rates: Vec<Row>,
    /// Velocities that formulas of time prescribe.
    pub(super) jumping: Vec<Row>,
    pub(super) levels: Vec<Row>,
    pub(super) supply: Vec<Row>,
    pub(super) guards: usize,
    /// Steps, by index, on the way to the rates, whose series is wanted.
    pub(super) series: Vec<u32>,
    /// Those on the way to the rates, the prescribed velocities and the energies, which are wanted at the ends of steps.
    pub(super) ends: Vec<u32>,
    /// Those on the way to the powers, which are wanted inside of steps. They read accelerations as numbers that are given.
    pub(super) powers: Vec<u32>,
    /// Slots that the powers read: states, and behind them accelerations.
    pub(super) read: Vec<u32>,
    /// Highest power of time in a row.
    pub(super) degrees: Vec<usize>,
}

impl Layout {
    /// The layout of these tapes and the numbers of its machine.
    ///
    /// *Errors*: the name of the first operation that lanes do not have.
    pub fn of(parts: &Parts<'_>) -> Result<(Layout, Vec<f64>), &'static str> {
        let mut making = Making::default();
        (making.layout.guards, making.layout.coordinates) = (parts.dynamics.shape.modes, parts.coordinates);
        making.layout.states = (0..parts.dynamics.shape.states).map(|i| making.put(What::State(i as u32))).collect();
        let n_x = making.layout.states.len();
        let roots = making.add(parts.dynamics, 0)?;
        let (rates, jumping) = roots.split_at_checked(n_x).ok_or("reactions")?;
        (making.layout.rates, making.layout.jumping) = (rates.to_vec(), jumping.to_vec());
        making.layout.levels = making.add(parts.levels, 0)?;
        making.layout.supply = making.add(parts.supply, parts.coordinates)?;
        let Making { mut layout, numbers, .. } = making;
        layout.series = layout.on_the_way(&layout.rates);
        layout.ends = layout.on_the_way(&[&layout.states[..], &layout.rates, &layout.jumping, &layout.levels].concat());
        layout.powers = layout.on_the_way(&layout.supply);
        let slot = |i: &u32| if let What::State(slot) = layout.steps[*i as usize].what { Some(slot) } else { None };
        layout.read = layout.powers.iter().filter_map(slot).collect();
        layout.numbers = numbers.len();
        Ok((layout, numbers))
    }

    /// Steps that these rows follow from.
    fn on_the_way(&self, rows: &[Row]) -> Vec<u32> {
        let mut wanted = vec![false; self.count as usize];
        rows.iter().for_each(|row| wanted[*row as usize] = true);
        let mut list = Vec::new();
        for (i, step) in self.steps.iter().enumerate().rev() {
            if (step.row..step.row + step.width).any(|row| wanted[row as usize]) {
                step.what.operands(&mut |row| wanted[row as usize] = true);
                list.push(i as u32);
            }
        }
        list.reverse();
        list
    }

    /// Number of states.
    pub fn states(&self) -> usize {
        self.states.len()
    }

    /// Rows that matter in these modes: those on the way to the rates.
    pub(super) fn live(&self, modes: &[u8]) -> Vec<bool> {
        let mut wanted = vec![false; self.count as usize];
        self.rates.iter().for_each(|row| wanted[*row as usize] = true);
        for step in self.steps.iter().rev() {
            if !(step.row..step.row + step.width).any(|row| wanted[row as usize]) {
                continue;
            }
            match &step.what {
                What::Choose { guard, sides } => wanted[sides[usize::from(modes[*guard as usize])] as usize] = true,
                what => what.operands(&mut |row| wanted[row as usize] = true),
            }
        }
        wanted
    }
}

#[derive(Default)]
struct Making {
    layout: Layout,
    numbers: Vec<f64>,
    by_bits: FxHashMap<u64, Number>,
    done: FxHashMap<What, Row>,
}

impl Making {
    fn number(&mut self, value: f64) -> Number {
        let numbers = &mut self.numbers;
        *self.by_bits.entry(value.to_bits()).or_insert_with(|| {
            numbers.push(value);
            numbers.len() as Number - 1
        })
    }

    /// The first row of the results of an operation, done once.
    fn put(&mut self, what: What) -> Row {
        if let Some(row) = self.done.get(&what) {
            return *row;
        }
        let layout = &mut self.layout;
        let ([width, own], row) = (what.widths(), layout.count);
        let degree = degree(&what, &layout.degrees);
        layout.degrees.extend(std::iter::repeat_n(degree, width as usize));
        layout.degrees.extend(std::iter::repeat_n(UNBOUNDED, own as usize));
        layout.count += width + own;
        layout.steps.push(Step { row, own: row + width, width, what: what.clone() });
        self.done.insert(what, row);
        row
    }

    /// The rows of the roots of a tape, which may read so many accelerations.
    fn add(&mut self, tape: &Tape, accelerations: usize) -> Result<Vec<Row>, &'static str> {
        let mut rows: Vec<Row> = vec![0; tape.registers()];
        for instruction in tape.instructions() {
            let into = instruction.into.index();
            let first = match &instruction.operation {
                Operation::State(slot) => self.layout.states[*slot as usize],
                Operation::Acceleration(slot) if (*slot as usize) < accelerations => {
                    let slot = self.layout.states.len() as u32 + slot;
                    self.put(What::State(slot))
                }
                Operation::Acceleration(_) => return Err("reactions"),
                operation => {
                    let what = self.what(operation, &rows)?;
                    self.put(what)
                }
            };
            (0..instruction.operation.width()).for_each(|k| rows[into + k] = first + k as Row);
        }
        Ok(tape.roots.iter().map(|root| rows[root.register.index()]).collect())
    }

    fn coefficient(&mut self, c: Coefficient, rows: &[Row]) -> Result<Number, &'static str> {
        match c {
            Coefficient::Number(value) => Ok(self.number(value.0)),
            Coefficient::Register(r) => {
                let row = rows[r.index()];
                let step = self.layout.steps.iter().find(|step| step.row == row);
                match step.map(|step| &step.what) {
                    Some(What::Literal(number)) => Ok(*number),
                    _ => Err("coefficient"),
                }
            }
        }
    }

    fn what(&mut self, operation: &Operation, rows: &[Row]) -> Result<What, &'static str> {
        let at = |r: &Register| rows[r.index()];
        Ok(match operation {
            Operation::Number(value) => What::Literal(self.number(value.0)),
            Operation::Time => What::Time,
            Operation::Linear { constant, terms } => {
                let constant = self.coefficient(*constant, rows)?;
                let terms: Result<_, &'static str> = terms.iter().map(|(c, r)| Ok((self.coefficient(*c, rows)?, at(r)))).collect();
                What::Linear { constant, terms: terms? }
            }
            // the order of the factors does not matter
            Operation::Multiply(a, b) => What::Multiply(at(a).min(at(b)), at(a).max(at(b))),
            Operation::Square(a) => What::Square(at(a)),
            Operation::Divide(a, b) => What::Divide(at(a), at(b)),
            Operation::Power(a, p) => What::Power(at(a), self.coefficient(*p, rows)?),
            Operation::Unary(Unary::SquareRoot, a) => What::Root(at(a)),
            Operation::Unary(Unary::Exp, a) => What::Exp(at(a)),
            Operation::Unary(Unary::Log, a) => What::Log(at(a)),
            Operation::Unary(Unary::Tanh, a) => What::Tanh(at(a)),
            Operation::SinCos(a) => What::SinCos { a: at(a), hyperbolic: false },
            Operation::SinhCosh(a) => What::SinCos { a: at(a), hyperbolic: true },
            Operation::Choose { by: By::Mode(guard), sides } => What::Choose { guard: *guard, sides: [0, 1, 2].map(|i| at(&sides[i])) },
            Operation::Solve { matrix, right } => {
                What::Solve { matrix: matrix.iter().map(|r| r.as_ref().map(at)).collect(), right: right.iter().map(at).collect() }
            }
            other => return Err(other.kind()),
        })
    }
}

fn degree(what: &What, degrees: &[usize]) -> usize {
    let of = |row: &Row| degrees[*row as usize];
    match what {
        What::Literal(_) => 0,
        What::Time => 1,
        What::State(_) => UNBOUNDED,
        What::Linear { terms, .. } => terms.iter().map(|term| of(&term.1)).max().unwrap_or(0),
        What::Multiply(a, b) => of(a).saturating_add(of(b)),
        What::Square(a) => of(a).saturating_mul(2),
        What::Choose { sides, .. } => sides.iter().map(of).max().unwrap_or(0),
        other => {
            let mut most = 0;
            other.operands(&mut |row| most = most.max(of(&row)));
            if most == 0 { 0 } else { UNBOUNDED }
        }
    }
}
