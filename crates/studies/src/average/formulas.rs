//! The equations of a machine for averaging: residuals of all coordinates and their derivatives, as formulas.

use crate::machine::Machine;
use analysis::studies::average::{Instant, Place, Turning};
use mechanics::asked::Named;
use program::lower::{self, Inputs};
use program::{Evaluator, Point, Tape};
use std::cell::RefCell;
use std::sync::Arc;
use symbolic::{Equations, Expr, Graph, SymbolId};
use words::{Notice, Text};

/// Instants of a turn at which it is looked whether auxiliary states matter.
const LOOKED: usize = 7;
/// Difference of what repeats after a turn, as a share of the largest value.
const ROUNDING: f64 = 1e-9;

/// M q'' - h of a machine with its numbers.
#[derive(Clone, Debug)]
pub(super) struct Formulas {
    /// Number of coordinates besides the angle.
    rest: usize,
    /// Over q of the rest, φ, q' of the rest, φ', auxiliary states; q'' of the rest, φ'': residuals of the rest and of the angle; the same, M_φφ, then the derivatives of the former.
    tapes: [Arc<Tape>; 2],
    /// With the numbers of the parameters; they write into registers of their own.
    evaluators: RefCell<[Evaluator; 2]>,
    /// Numbers of the parameters.
    numbers: Vec<f64>,
    /// Parameters, by number, in the equations of the rest, and whether time is.
    of_rest: Vec<usize>,
    /// The instant at which formulas of time stand, s.
    instant: f64,
    /// Auxiliary states; they must not matter.
    auxiliaries: usize,
}

/// Which of the tapes.
#[derive(Clone, Copy)]
enum Asked {
    Residuals,
    All,
}

impl Formulas {
    /// *Errors*: S161.
    pub(super) fn of(machine: &Machine, angle: &Named, instant: f64) -> Result<Formulas, Notice> {
        let equations = &machine.equations;
        let Some(own) = equations.coordinates.iter().position(|c| c.symbols[0] == angle.symbol) else {
            return Err(refused(("the angle is none of the coordinates", "угол не входит в число координат")));
        };
        if !equations.conditions.is_empty() {
            return Err(refused((
                "connections, contacts or dry friction tie its coordinates",
                "координаты связаны соединениями, контактами или сухим трением",
            )));
        }
        let mut graph = equations.graph.clone();
        let n = equations.coordinates.len();
        let rest: Vec<[SymbolId; 3]> = (0..n).filter(|i| *i != own).map(|i| equations.coordinates[i].symbols).collect();
        let symbols = equations.coordinates[own].symbols;
        let roots = roots(equations, own, &mut graph);
        // of the angle's own equation and its inertia the answers of the rest do not depend
        let answered: Vec<Expr> = roots.iter().enumerate().filter(|(k, _)| *k != n - 1 && *k != n).map(|(_, e)| *e).collect();
        let met = graph.symbols_in(&answered);
        let of_rest = (0..equations.parameters.len()).filter(|k| met.contains(&equations.parameters[*k].symbol)).collect();
        let order = |which: usize| rest.iter().chain([&symbols]).map(move |own| own[which]);
        let inputs = Inputs {
            parameters: equations.parameters.iter().map(|p| p.symbol).collect(),
            time: Some(equations.time),
            states: order(0).chain(order(1)).chain(equations.auxiliaries.iter().map(|a| a.symbol)).collect(),
            accelerations: order(2).collect(),
            ..Inputs::default()
        };
        let tape = |name: &str, roots: &[Expr]| -> Result<Arc<Tape>, Notice> {
            let named: Vec<(String, Expr)> = roots.iter().enumerate().map(|(k, e)| (format!("{name} {}", k + 1), *e)).collect();
            lower::expressions(&graph, name, &inputs, &named).map(Arc::new).map_err(|fault| analysis::Fault::from(fault).into())
        };
        let tapes = [tape("residual", &roots[..n])?, tape("turn", &roots)?];
        let numbers: Vec<f64> = equations.parameters.iter().map(|p| p.value).collect();
        let evaluators = RefCell::new(bound(&tapes, &numbers)?);
        let formulas = Formulas { rest: n - 1, tapes, evaluators, numbers, of_rest, instant, auxiliaries: equations.auxiliaries.len() };
        if formulas.depends_on_clocks() {
            return Err(refused((
                "another rotation (an unbalanced rotor with a speed of its own) acts on it besides the angle",
                "кроме этого угла на неё действует другое вращение (неуравновешенный ротор со своей скоростью)",
            )));
        }
        if !formulas.repeats() {
            return Err(refused((
                "its equations are not the same after a turn of the angle",
                "через оборот этого угла её уравнения другие",
            )));
        }
        Ok(formulas)
    }

    /// Whether the equations are the same a turn further, where angles are rounded.
    fn repeats(&self) -> bool {
        let still = vec![0.0; self.rest];
        let at =
            |angle: f64| self.values(&Place { angle, speed: 1.0, values: &still, rates: &still, accelerations: &still }, 0.0, Asked::All);
        (0..LOOKED).all(|k| {
            let (here, there) = (at(k as f64), at(k as f64 + std::f64::consts::TAU));
            let largest = here.iter().fold(0.0_f64, |l, v| l.max(v.abs()));
            here.iter().zip(&there).all(|(a, b)| (a - b).abs() <= ROUNDING * largest)
        })
    }

    /// Takes over the numbers of the parameters.
    ///
    /// *Errors*: values with which a formula of them has none.
    pub(super) fn put(&mut self, equations: &Equations) -> Result<(), Notice> {
        self.numbers = equations.parameters.iter().map(|p| p.value).collect();
        self.evaluators = RefCell::new(bound(&self.tapes, &self.numbers)?);
        Ok(())
    }

    /// The numbers in the equations of the rest: where they are the same, its answers are.
    pub(super) fn basis(&self) -> Vec<f64> {
        self.of_rest.iter().map(|k| self.numbers[*k]).collect()
    }

    /// Whether a residual changes with an auxiliary state.
    fn depends_on_clocks(&self) -> bool {
        let still = vec![0.0; self.rest];
        let at = |k: usize, clock: f64| {
            let angle = std::f64::consts::TAU * k as f64 / LOOKED as f64;
            self.values(&Place { angle, speed: 1.0, values: &still, rates: &still, accelerations: &still }, clock, Asked::Residuals)
        };
        (0..LOOKED).any(|k| {
            let before = at(k, 0.0);
            [1.0, 2.3].iter().any(|clock| at(k, *clock) != before)
        })
    }

    /// What is asked, with the auxiliary states at a value; not-a-number where one of them has no value.
    fn values(&self, place: &Place<'_>, clock: f64, asked: Asked) -> Vec<f64> {
        let states: Vec<f64> = place
            .values
            .iter()
            .chain([&place.angle])
            .chain(place.rates)
            .chain([&place.speed])
            .copied()
            .chain(std::iter::repeat_n(clock, self.auxiliaries))
            .collect();
        let accelerations: Vec<f64> = place.accelerations.iter().copied().chain([0.0]).collect();
        let point = Point { time: self.instant, states: &states, accelerations: &accelerations, ..Point::default() };
        let count = self.tapes[asked as usize].roots.len();
        self.evaluators.borrow_mut()[asked as usize].evaluate(&point).map_or_else(|_| vec![f64::NAN; count], <[f64]>::to_vec)
    }
}

impl Turning for Formulas {
    fn others(&self) -> usize {
        self.rest
    }
    fn at(&self, place: &Place<'_>) -> Instant {
        let all = self.values(place, 0.0, Asked::All);
        let n = self.rest + 1;
        Instant { residuals: all[..n].to_vec(), inertia: all[n], slopes: all[n + 1..].to_vec() }
    }
    fn residuals(&self, place: &Place<'_>) -> Vec<f64> {
        self.values(place, 0.0, Asked::Residuals)
    }
}

/// The tapes with the numbers of the parameters.
fn bound(tapes: &[Arc<Tape>; 2], numbers: &[f64]) -> Result<[Evaluator; 2], Notice> {
    let of = |tape: &Arc<Tape>| Evaluator::new(tape, numbers).map_err(|fault| Notice::from(analysis::Fault::from(fault)));
    Ok([of(&tapes[0])?, of(&tapes[1])?])
}

/// Residuals of the rest and of the angle, M_φφ, then the derivatives of the former by q, q', q''.
fn roots(equations: &Equations, own: usize, graph: &mut Graph) -> Vec<Expr> {
    let n = equations.coordinates.len();
    let order: Vec<usize> = (0..n).filter(|i| *i != own).chain([own]).collect();
    let residual = |i: usize, graph: &mut Graph| {
        let mut terms = Vec::with_capacity(n + 1);
        for j in 0..n {
            let (mass, acceleration) = (equations.mass.get(i, j), graph.symbol(equations.coordinates[j].symbols[2]));
            terms.push(graph.mul(mass, acceleration));
        }
        let force = graph.neg(equations.force[i]);
        terms.push(force);
        let sum = graph.sum(&terms);
        equations.inlined(graph, sum)
    };
    let mut roots: Vec<Expr> = order.iter().map(|i| residual(*i, graph)).collect();
    let rest: Vec<[SymbolId; 3]> = order[..n - 1].iter().map(|i| equations.coordinates[*i].symbols).collect();
    let symbols = equations.coordinates[own].symbols;
    let inertia = graph.derivative(roots[n - 1], symbols[2]);
    roots.push(inertia);
    for (i, which) in (0..n - 1).flat_map(|i| (0..3).map(move |which| (i, which))) {
        for other in &rest {
            let slope = graph.derivative(roots[i], other[which]);
            roots.push(slope);
        }
    }
    roots
}

/// S161.
pub(super) fn refused(why: (&str, &str)) -> Notice {
    Notice::new("S161", "the machine cannot be averaged over this angle", "осреднить машину по этому углу нельзя")
        .because(Text::new(why.0, why.1))
        .help(
            "name an angle that turns freely, of a machine without connections: --angle phi",
            "назовите свободно вращающийся угол машины без связей: --angle phi",
        )
}
