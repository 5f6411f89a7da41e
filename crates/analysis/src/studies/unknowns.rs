//! Unknown parameters from statics: numbers u for which a given place is a place of rest.
//!
//! ```text
//! F(q, u) + Jᵀ λ = 0        n equations for u and the reactions λ of connections
//! ```
//!
//! Gauss-Newton: ∂F/∂u is exact (numbers of a frame, which no formula gives, enter by differences), the equations are scaled by rows and columns, dependent unknowns and forces that nothing balances are
//! faults, never a least-squares compromise.

use words::Text;
use words::digits::number;

use crate::Fault;
use crate::linear::{LinearMachine, Place};
use crate::rest::faults::{force_unit, unbalanced, undetermined};
use algebra::qr::{DEPENDENT, Qr};

const STEPS: usize = 100;
/// Unbalanced force relative to the terms that balance in it.
const UNBALANCED: f64 = 1e-9;

/// Changes the parameters so that `q` is a place of rest; the reactions found are returned with the place.
///
/// *Errors*: S036 when an unknown changes no force, when unknowns cannot be told apart, or when a force stays unbalanced.
pub fn unknowns(machine: &mut LinearMachine, parameters: &[usize], q: &[f64]) -> Result<Place, Fault> {
    let n = q.len();
    let whole = Forces::of(machine, parameters)?;
    let mut place = Place::rest(q);
    let k = parameters.len() + machine.linear().multipliers.len();
    place.multipliers = vec![0.0; machine.linear().multipliers.len()];
    for _ in 0..STEPS {
        let values = whole.at(machine, &place)?;
        let (force, slopes) = values.split_at(n);
        // column-wise ∂F/∂u, then row-wise Jᵀ
        let entry = |i: usize, c: usize| {
            if c < parameters.len() {
                slopes[c * n + i]
            } else {
                slopes[parameters.len() * n + i * (k - parameters.len()) + c - parameters.len()]
            }
        };
        let size = |list: &mut dyn Iterator<Item = f64>| list.fold(0.0_f64, |m, v| m.max(v.abs()));
        let columns: Vec<f64> = (0..k).map(|c| size(&mut (0..n).map(|i| entry(i, c)))).collect();
        if let Some(c) = (0..parameters.len()).find(|c| columns[*c] == 0.0) {
            return Err(undetermined(&machine.parameters()[parameters[c]].name));
        }
        let columns: Vec<f64> = columns.into_iter().map(|c| if c == 0.0 { 1.0 } else { c }).collect();
        let rows: Vec<f64> = (0..n).map(|i| size(&mut (0..k).map(|c| entry(i, c) / columns[c]))).collect();
        let row = |i: usize| if rows[i] == 0.0 { 1.0 } else { rows[i] };
        let matrix: Vec<f64> = (0..n * k).map(|p| entry(p / k, p % k) / (columns[p % k] * row(p / k))).collect();
        let right: Vec<f64> = (0..n).map(|i| -force[i] / row(i)).collect();
        let qr = Qr::alike(&matrix, n, k, DEPENDENT);
        if let Some(c) = qr.dependent().iter().find(|c| **c < parameters.len()) {
            return Err(undetermined(&machine.parameters()[parameters[*c]].name));
        }
        let (step, _) = qr.least_squares(&right);
        let mut moved: f64 = 0.0;
        for (c, s) in step.iter().enumerate() {
            let change = s / columns[c];
            let old = if c < parameters.len() { machine.value(parameters[c]) } else { place.multipliers[c - parameters.len()] };
            moved = moved.max(change.abs() / (old + change).abs().max(f64::MIN_POSITIVE));
            if c < parameters.len() {
                machine.set(parameters[c], old + change)?;
            } else {
                place.multipliers[c - parameters.len()] = old + change;
            }
        }
        if moved <= 4.0 * f64::EPSILON || step.iter().all(|s| *s == 0.0) {
            break;
        }
    }
    balanced(machine, parameters, &whole, &place)?;
    Ok(place)
}

/// The mean forces, their derivatives by the unknowns (unknown by unknown), and the reach of the reactions.
struct Forces {
    unknowns: Vec<usize>,
    /// Numbers that follow from unknowns without a formula.
    followers: Vec<usize>,
    prepared: crate::linear::Values,
}

impl Forces {
    fn of(machine: &mut LinearMachine, unknowns: &[usize]) -> Result<Forces, Fault> {
        let mut followers: Vec<usize> = Vec::new();
        for u in unknowns {
            followers.extend(machine.followers(*u)?.into_iter().map(|f| f.0));
        }
        followers.sort_unstable();
        followers.dedup();
        let all: Vec<usize> = unknowns.iter().chain(&followers).copied().collect();
        Ok(Forces { unknowns: unknowns.to_vec(), followers, prepared: machine.forces_by(&all)? })
    }

    /// dF/du = ∂F/∂u + Σ ∂F/∂k · dk/du over the numbers k that follow.
    fn at(&self, machine: &LinearMachine, place: &Place) -> Result<Vec<f64>, Fault> {
        let n = place.q.len();
        let mut values = machine.values(&self.prepared, place)?;
        let first = (1 + self.unknowns.len()) * n;
        for (c, u) in self.unknowns.iter().enumerate() {
            for (number, slope) in machine.followers(*u)? {
                let Some(k) = self.followers.iter().position(|f| *f == number) else { continue };
                for i in 0..n {
                    values[(1 + c) * n + i] += slope * values[first + k * n + i];
                }
            }
        }
        values.drain(first..first + self.followers.len() * n);
        Ok(values)
    }
}

/// Every force must vanish beside its terms.
fn balanced(machine: &mut LinearMachine, parameters: &[usize], whole: &Forces, place: &Place) -> Result<(), Fault> {
    let n = place.q.len();
    let values = whole.at(machine, place)?;
    let matrices = machine.at(place)?;
    let m = place.multipliers.len();
    for i in 0..n {
        let elastic: f64 = (0..n).map(|j| matrices.stiffness[i * n + j].abs() * place.q[j].abs()).sum();
        let found: f64 = parameters.iter().enumerate().map(|(c, p)| (values[(c + 1) * n + i] * machine.value(*p)).abs()).sum();
        let reach = (parameters.len() + 1) * n + i * m;
        let held: f64 = (0..m).map(|c| (values[reach + c] * place.multipliers[c]).abs()).sum();
        let scale = elastic + found + held;
        if values[i].abs() > UNBALANCED * scale && values[i] != 0.0 {
            return Err(unbalanced(&machine.coordinates()[i].name, values[i], force_unit(&machine.coordinates()[i].unit)));
        }
    }
    Ok(())
}

/// A found number with its name, for a remark.
pub fn remark(name: &str, value: f64, unit: &str) -> Text {
    let v = number(value);
    let unit = Text::unit(&if unit == "1" { String::new() } else { format!(" {unit}") });
    Text::new(
        format!("found from statics: {name} = {}{}", v.en, unit.en),
        format!("найдено из условий равновесия: {name} = {}{}", v.ru, unit.ru),
    )
}
