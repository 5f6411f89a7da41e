//! The place about which small motions are taken.

use super::form::{self, Form};
use super::load::Load;
use crate::studies::equilibrium::{self, Equilibrium};
use crate::{Fault, System};
use algebra::lu::Lu;
use symbolic::Equations;
use words::{Message, Text};

/// The equilibrium under the mean loads of the first phase: where the search from the start ends, then Newton's method on the forms.
///
/// *Errors*: no place of rest, or forms that are not linear.
pub fn place<S: System + ?Sized>(system: &mut S, equations: &Equations, start: &[f64], span: &[f64]) -> Result<Vec<f64>, Fault> {
    let n = system.n_coordinates();
    let found = equilibrium::equilibrium(system, start, &Equilibrium::default());
    let row = found.dataset.columns.iter().take(n).map(|c| c.values.first().copied()).collect::<Option<Vec<f64>>>();
    let mut q = row.unwrap_or_else(|| start[..n].to_vec());
    let failed = || found.fault.clone().unwrap_or_else(nowhere);
    for _ in 0..100 {
        let form = form::forms(equations, span, Some(&q))?.pop().ok_or_else(nowhere)?;
        // h(q0) - C (q - q0) = 0, and the mean load is h(q0) + C q0
        let mean: Vec<f64> = form.loads.iter().map(Load::mean).collect();
        if balanced(&form, &mean, &q) && Lu::new(&form.stiffness, n).solve(&mean).is_none() {
            // along a free motion any place is as good
            return Ok(q);
        }
        let step = newton(&form, &mean, &q).ok_or_else(failed)?;
        q.iter_mut().zip(&step).for_each(|(q, d)| *q += d);
        let largest = |v: &[f64]| v.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
        if !largest(&step).is_finite() {
            break;
        }
        // a nanometre or nanoradian: a place at the origin has no size
        if largest(&step) <= 8.0 * f64::EPSILON * largest(&q).max(1e-9) {
            return Ok(q);
        }
    }
    Err(failed())
}

/// C δ = mean - C q; where C is singular, C with a little of M, which leaves free motions alone when nothing acts along them.
fn newton(form: &Form, mean: &[f64], q: &[f64]) -> Option<Vec<f64>> {
    let n = form.n;
    let rest: Vec<f64> = (0..n).map(|i| mean[i] - (0..n).map(|j| form.stiffness[i * n + j] * q[j]).sum::<f64>()).collect();
    Lu::new(&form.stiffness, n).solve(&rest).or_else(|| {
        let size = |a: &[f64]| a.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        // so little that what is held moves by rounding, so much that what is free has a pivot
        let share = 1e-9 * size(&form.stiffness) / size(&form.mass);
        let c: Vec<f64> = form.stiffness.iter().zip(&form.mass).map(|(c, m)| c + share * m).collect();
        Lu::new(&c, n).solve(&rest)
    })
}

/// Whether C q equals the mean load within rounding of its terms.
fn balanced(form: &Form, mean: &[f64], q: &[f64]) -> bool {
    mean.iter().enumerate().all(|(i, load)| {
        let terms = q.iter().zip(&form.stiffness[i * form.n..]).map(|(q, c)| c * q);
        let (sum, size) = terms.fold((-load, load.abs()), |(sum, size), t| (sum + t, size + t.abs()));
        // a place in balance leaves rounding of its terms
        sum.abs() <= 1e-10 * size
    })
}

fn nowhere() -> Fault {
    Fault::new(Message {
        code: "S075",
        what: Text::new("no equilibrium to linearise about", "нет положения равновесия, около которого линеаризовать"),
        why: Text::new(
            "under the mean loads of the first phase the machine has no isolated equilibrium near its start",
            "при средних нагрузках первого этапа вблизи начала движения нет изолированного положения равновесия",
        ),
        help: Text::new("begin nearer to the equilibrium; see the study equilibrium", "начните ближе к равновесию; см. расчёт equilibrium"),
    })
}
