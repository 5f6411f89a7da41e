//! Moreau's time stepping: no events, one set of inclusions for the velocities at the end of every step, solved by sweeps over the contacts.
//!
//! ```text
//! q_m = q + h v/2;   v⁺ = v + M⁻¹ (f h + Σ W p);   q⁺ = q_m + h v⁺/2
//! where the gap at q_m is not positive:   0 <= p_n,  u_n⁺ + e u_n >= 0,  p_n (u_n⁺ + e u_n) = 0;   |p_t| <= μ p_n,  p_t against u_t⁺
//! ```
//!
//! Of first order in h. *Source*: J. J. Moreau, Unilateral contact and dry friction in finite freedom dynamics, CISM 302 (1988); M. Jean, The non-smooth
//! contact dynamics method, CMAME 177 (1999).

use super::scene::{GRAVITY, Kind, Scene, directions};

/// Sweeps of one step.
const SWEEPS: usize = 3000;

struct Row {
    normal: Vec<f64>,
    tangent: Vec<f64>,
    contact: usize,
    before: f64,
}

/// Coordinates at the end of the scene by steps of h.
pub fn end(scene: &Scene, h: f64) -> Vec<f64> {
    let steps = (scene.until / h).round() as usize;
    let h = scene.until / steps as f64;
    let mut q: Vec<f64> = scene.bodies.iter().flat_map(|b| b.q.clone()).collect();
    let mut v: Vec<f64> = scene.bodies.iter().flat_map(|b| b.v.clone()).collect();
    let inverse: Vec<f64> = scene.bodies.iter().flat_map(|b| inverse_masses(&b.kind)).collect();
    for _ in 0..steps {
        q.iter_mut().zip(&v).for_each(|(q, v)| *q += 0.5 * h * v);
        let rows = rows(scene, &q, &v);
        let force = forces(scene, &q);
        (0..v.len()).for_each(|i| v[i] += h * inverse[i] * force[i]);
        sweep(scene, &rows, (&inverse, &mut v));
        q.iter_mut().zip(&v).for_each(|(q, v)| *q += 0.5 * h * v);
    }
    q
}

fn inverse_masses(kind: &Kind) -> Vec<f64> {
    match *kind {
        Kind::Free { mass, inertia } => vec![1.0 / mass, 1.0 / mass, 1.0 / inertia],
        Kind::Shift { mass } => vec![1.0 / mass; 2],
        Kind::Swing { inertia, .. } => vec![1.0 / inertia],
    }
}

fn forces(scene: &Scene, q: &[f64]) -> Vec<f64> {
    let mut list = Vec::with_capacity(q.len());
    for body in &scene.bodies {
        let first = q[list.len()];
        let pull = -body.spring * first;
        match body.kind {
            Kind::Free { mass, .. } => list.extend([pull, -mass * GRAVITY, 0.0]),
            Kind::Shift { mass } => list.extend([pull, -mass * GRAVITY]),
            Kind::Swing { mass, center, .. } => list.push(pull - mass * GRAVITY * center * first.sin()),
        }
    }
    list
}

fn first_of(scene: &Scene, body: usize) -> usize {
    scene.bodies[..body].iter().map(|b| b.q.len()).sum()
}

/// Place of a point of a body and its derivatives by the body's coordinates.
fn point(scene: &Scene, body: usize, at: [f64; 2], q: &[f64]) -> ([f64; 2], Vec<[f64; 2]>) {
    let q = &q[first_of(scene, body)..];
    let turned = |f: f64| [f.cos() * at[0] - f.sin() * at[1], f.sin() * at[0] + f.cos() * at[1]];
    match scene.bodies[body].kind {
        Kind::Free { .. } => {
            let arm = turned(q[2]);
            ([q[0] + arm[0], q[1] + arm[1]], vec![[1.0, 0.0], [0.0, 1.0], [-arm[1], arm[0]]])
        }
        Kind::Shift { .. } => ([q[0] + at[0], q[1] + at[1]], vec![[1.0, 0.0], [0.0, 1.0]]),
        Kind::Swing { pivot, .. } => {
            let arm = turned(q[0]);
            ([pivot[0] + arm[0], pivot[1] + arm[1]], vec![[-arm[1], arm[0]]])
        }
    }
}

/// Closed contacts.
fn rows(scene: &Scene, q: &[f64], v: &[f64]) -> Vec<Row> {
    let mut list = Vec::new();
    for (index, contact) in scene.contacts.iter().enumerate() {
        let (n, t) = directions(contact.normal);
        let (place, derivatives) = point(scene, contact.body, contact.at, q);
        let (base, moved) = match contact.on {
            Some(b) => point(scene, b, contact.through, q),
            None => (contact.through, Vec::new()),
        };
        if dot(n, [place[0] - base[0], place[1] - base[1]]) > contact.radius {
            continue;
        }
        let (mut normal, mut tangent) = (vec![0.0; q.len()], vec![0.0; q.len()]);
        let mut add = |body: usize, derivatives: &[[f64; 2]], sign: f64| {
            for (k, d) in derivatives.iter().enumerate() {
                normal[first_of(scene, body) + k] += sign * dot(n, *d);
                tangent[first_of(scene, body) + k] += sign * dot(t, *d);
            }
        };
        add(contact.body, &derivatives, 1.0);
        if let Some(b) = contact.on {
            add(b, &moved, -1.0);
        }
        if matches!(scene.bodies[contact.body].kind, Kind::Free { .. }) {
            tangent[first_of(scene, contact.body) + 2] += contact.radius;
        }
        let before = normal.iter().zip(v).map(|(a, b)| a * b).sum();
        list.push(Row { normal, tangent, contact: index, before });
    }
    list
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// Gauss-Seidel over the contacts until the impulses stand.
fn sweep(scene: &Scene, rows: &[Row], (inverse, v): (&[f64], &mut [f64])) {
    let mut impulses = vec![[0.0_f64; 2]; rows.len()];
    for _ in 0..SWEEPS {
        let mut change = 0.0_f64;
        for (row, p) in rows.iter().zip(&mut impulses) {
            let contact = &scene.contacts[row.contact];
            let wanted = -contact.restitution * row.before;
            let pushed = (p[0] + toward(&row.normal, (inverse, v), wanted)).max(0.0);
            change = change.max(give(&row.normal, pushed - p[0], (inverse, v)));
            p[0] = pushed;
            if contact.friction > 0.0 {
                let most = contact.friction * p[0];
                let rubbed = (p[1] + toward(&row.tangent, (inverse, v), contact.belt)).clamp(-most, most);
                change = change.max(give(&row.tangent, rubbed - p[1], (inverse, v)));
                p[1] = rubbed;
            }
        }
        if change < 1e-13 {
            break;
        }
    }
}

/// Impulse along a row that gives it the rate wanted.
fn toward(row: &[f64], (inverse, v): (&[f64], &[f64]), wanted: f64) -> f64 {
    let rate: f64 = row.iter().zip(v).map(|(a, b)| a * b).sum();
    let mobility: f64 = row.iter().zip(inverse).map(|(a, m)| a * a * m).sum();
    (wanted - rate) / mobility
}

/// Changes the velocities; returns the impulse without sign.
fn give(row: &[f64], impulse: f64, (inverse, v): (&[f64], &mut [f64])) -> f64 {
    row.iter().zip(inverse).zip(v).for_each(|((a, m), v)| *v += a * m * impulse);
    impulse.abs()
}
