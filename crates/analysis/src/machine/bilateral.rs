//! The conditions of connections through an impact: J_b q' = 0 before and after it, and their impulses.
//!
//! ```text
//! | M   -F_b | | dq' |   | f |
//! | J_b   0  | | Λ_b | = | w |      f: generalized impulses, w: change of the rates asked for
//! ```
//!
//! Where conditions repeat each other the rates are unique all the same; of the impulses one choice is taken.

use algebra::cholesky::Cholesky;
use algebra::lu::Lu;
use algebra::qr::Qr;

use super::conditions::Conditions;
use crate::Fault;

/// The conditions that hold through an impact, factored.
pub(super) struct Bilateral {
    rows: Vec<usize>,
    /// The reaction of each row, and the sign of its force along the row's gradient.
    reactions: Vec<Option<(usize, f64)>>,
    way: Way,
}

enum Way {
    Regular(Lu),
    /// Conditions that repeat each other: rates are unique, of the impulses one choice is taken. C of M = C C', C^-1 J_b' factored.
    Repeated {
        factor: Cholesky,
        columns: Vec<f64>,
        qr: Qr,
    },
}

impl Bilateral {
    pub(super) fn new(c: &mut Conditions, t: f64) -> Result<Bilateral, Fault> {
        c.activate_ideal();
        let n = c.n;
        if c.has_repeated() {
            let columns = c.measured();
            let mut chosen = c.independent(&columns).independent().to_vec();
            chosen.sort_unstable();
            c.active = chosen.into_iter().map(|k| c.active[k]).collect();
        }
        let rows = c.active.clone();
        let m = rows.len();
        let size = n + m;
        let mut matrix = vec![0.0; size * size];
        let mass = &c.values[c.roots.mass.clone()];
        for i in 0..n {
            for j in 0..n {
                matrix[i * size + j] = mass[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)];
            }
        }
        let mut motors = c.motors.iter().copied();
        let mut reactions = Vec::with_capacity(m);
        for (k, &row) in rows.iter().enumerate() {
            let column = c.column(row);
            matrix[(n + k) * size..(n + k) * size + n].copy_from_slice(column);
            let reaction = c.rows[row].reaction.or_else(|| motors.next());
            let pushes = reaction.map_or(column, |r| c.push(r));
            (0..n).for_each(|i| matrix[i * size + n + k] = -pushes[i]);
            let along: f64 = pushes.iter().zip(column).map(|(p, j)| p * j).sum();
            reactions.push(reaction.map(|r| (r, along.signum())));
        }
        let lu = Lu::new(&matrix, size);
        if size == 0 || lu.solve(&vec![0.0; size]).is_some() {
            return Ok(Bilateral { rows, reactions, way: Way::Regular(lu) });
        }
        if !c.motors.is_empty() {
            return Err(Fault::undetermined_impact(t));
        }
        let factor = c.metric();
        let mut columns = vec![0.0; n * m];
        for (k, &row) in rows.iter().enumerate() {
            let mut a = c.column(row).to_vec();
            factor.forward(&mut a);
            (0..n).for_each(|i| columns[i * m + k] = a[i]);
        }
        let qr = Qr::new(&columns, n, m);
        Ok(Bilateral { rows, reactions, way: Way::Repeated { factor, columns, qr } })
    }

    /// No change of the rows.
    pub(super) fn unmoved(&self) -> Vec<f64> {
        vec![0.0; self.rows.len()]
    }

    /// What the rates of the rows still lack.
    pub(super) fn rates(&self, c: &Conditions) -> Vec<f64> {
        self.rows.iter().map(|&row| -c.rate(row)).collect()
    }

    /// Change of the rates under generalized impulses, the rows changed by `wanted`, and the impulses of all reactions.
    pub(super) fn response(&self, c: &Conditions, force: &[f64], wanted: &[f64]) -> Result<(Vec<f64>, Vec<f64>), Fault> {
        let n = c.n;
        let mut impulses = vec![0.0; c.reactions];
        let (change, own) = match &self.way {
            Way::Regular(lu) => {
                let right = [force, wanted].concat();
                let solution = lu.solve(&right).unwrap_or(right);
                (solution[..n].to_vec(), solution[n..].to_vec())
            }
            Way::Repeated { factor, columns, qr } => {
                let m = self.rows.len();
                let mut y = force.to_vec();
                factor.forward(&mut y);
                let (own, _) = qr.least_squares(&y);
                let shortest = qr.shortest(wanted);
                for i in 0..n {
                    y[i] += shortest[i] - (0..m).map(|k| columns[i * m + k] * own[k]).sum::<f64>();
                }
                factor.backward(&mut y);
                let signs = self.reactions.iter().map(|r| r.map_or(1.0, |(_, sign)| -sign));
                (y, own.iter().zip(signs).map(|(p, sign)| p * sign).collect())
            }
        };
        for (reaction, p) in self.reactions.iter().zip(own) {
            if let Some((r, _)) = reaction {
                impulses[*r] = p;
            }
        }
        Ok((change, impulses))
    }
}
