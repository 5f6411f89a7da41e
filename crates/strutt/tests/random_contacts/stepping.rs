//! Moreau's time stepping: no events, one set of inclusions for the velocities at the end of every step, solved by sweeps over the contacts.
//!
//! ```text
//! q_m = q + h v/2;   v⁺ = v + M⁻¹ (f h + Σ W p);   q⁺ = q_m + h v⁺/2
//! where the gap at q_m is not positive:   0 <= p_n,  u_n⁺ + e u_n >= 0,  p_n (u_n⁺ + e u_n) = 0;   |p_t| <= μ p_n,  p_t against u_t⁺
//! ```
//!
//! Where impacts follow one another the stepping has a resolution of its own: contacts that close faster than a few steps of any acceleration of the scenes strike, the fastest
//! first, each alone,
//!
//! ```text
//! u_n⁺ = -e u_n,   u_t⁺ = 0 with |p_t| <= μ p_n,  or  p_t = ∓ μ p_n against u_t⁺
//! ```
//!
//! until none closes so fast; what is slower is decided with the inclusions of the step, without rebound. A blow that gives energy ends the motion.
//!
//! Of first order in h. *Source*: J. J. Moreau, Unilateral contact and dry friction in finite freedom dynamics, CISM 302 (1988); M. Jean, The non-smooth
//! contact dynamics method, CMAME 177 (1999).

use super::scene::{GRAVITY, Impacts, Kind, Scene, directions};

/// Sweeps of one step.
const SWEEPS: usize = 3000;

/// Acceleration that no scene exceeds by much, m/s²: rates below that of a step are no impacts.
const ACCELERATION: f64 = 100.0;
/// Blows of one step.
const BLOWS: usize = 20_000;
/// Share of its terms above which the work of a blow is a gain.
const GAIN: f64 = 1e-9;

/// How a motion ended.
#[derive(Clone, Debug, PartialEq)]
pub enum End {
    /// Coordinates at the end of the scene.
    Reached(Vec<f64>),
    /// A blow gave energy.
    Gained,
}

#[derive(Clone)]
struct Row {
    normal: Vec<f64>,
    tangent: Vec<f64>,
    contact: usize,
    before: f64,
}

/// The end of the scene by steps of h.
pub fn end(scene: &Scene, h: f64) -> End {
    let steps = (scene.until / h).round() as usize;
    let h = scene.until / steps as f64;
    let mut q: Vec<f64> = scene.bodies.iter().flat_map(|b| b.q.clone()).collect();
    let mut v: Vec<f64> = scene.bodies.iter().flat_map(|b| b.v.clone()).collect();
    let inverse: Vec<f64> = scene.bodies.iter().flat_map(|b| inverse_masses(&b.kind)).collect();
    for _ in 0..steps {
        q.iter_mut().zip(&v).for_each(|(q, v)| *q += 0.5 * h * v);
        let mut rows = rows(scene, &q, &v);
        if scene.impacts == Impacts::InSequence && !strike(scene, &mut rows, ACCELERATION * h, (&inverse, &mut v)) {
            return End::Gained;
        }
        let force = forces(scene, &q);
        (0..v.len()).for_each(|i| v[i] += h * inverse[i] * force[i]);
        sweep(scene, &rows, (&inverse, &mut v));
        q.iter_mut().zip(&v).for_each(|(q, v)| *q += 0.5 * h * v);
    }
    End::Reached(q)
}

/// Blows one after another; false where one gives energy. Contacts that close equally fast, as far as the step tells, strike together. What is left closes
/// without rebound.
fn strike(scene: &Scene, rows: &mut [Row], least: f64, (inverse, v): (&[f64], &mut [f64])) -> bool {
    for _ in 0..BLOWS {
        let rates: Vec<f64> = rows.iter().map(|row| product(&row.normal, v)).collect();
        let worst = rates.iter().copied().fold(0.0, f64::min);
        if worst >= -least {
            break;
        }
        let taking: Vec<usize> = (0..rows.len()).filter(|i| rates[*i] <= worst + least).collect();
        let before: Vec<[f64; 2]> = taking.iter().map(|i| speeds(scene, &rows[*i], v)).collect();
        let impulses = match taking[..] {
            [i] => {
                let contact = &scene.contacts[rows[i].contact];
                let impulses = blow(&rows[i], inverse, (contact.restitution, contact.friction), before[0]);
                give(&rows[i].normal, impulses[0], (inverse, v));
                give(&rows[i].tangent, impulses[1], (inverse, v));
                vec![impulses]
            }
            _ => {
                let together: Vec<Row> = taking.iter().map(|i| Row { before: rates[*i], ..rows[*i].clone() }).collect();
                sweep(scene, &together, (inverse, v))
            }
        };
        let (mut work, mut terms) = (0.0, 0.0);
        for ((i, p), before) in taking.iter().zip(&impulses).zip(&before) {
            let after = speeds(scene, &rows[*i], v);
            for k in 0..2 {
                work += 0.5 * p[k] * (before[k] + after[k]);
                terms += 0.5 * p[k].abs() * (before[k].abs() + after[k].abs());
            }
        }
        if work > GAIN * terms {
            return false;
        }
    }
    // Newton's rule of the sweep is that of a contact without rebound
    rows.iter_mut().for_each(|row| row.before = 0.0);
    true
}

/// Rate of the gap, sliding speed against the surface.
fn speeds(scene: &Scene, row: &Row, v: &[f64]) -> [f64; 2] {
    [product(&row.normal, v), product(&row.tangent, v) - scene.contacts[row.contact].belt]
}

/// Normal and tangential impulse of one contact.
fn blow(row: &Row, inverse: &[f64], (restitution, friction): (f64, f64), [u_n, u_t]: [f64; 2]) -> [f64; 2] {
    let mobility = |a: &[f64], b: &[f64]| a.iter().zip(b).zip(inverse).map(|((a, b), m)| a * b * m).sum::<f64>();
    let (nn, nt, tt) = (mobility(&row.normal, &row.normal), mobility(&row.normal, &row.tangent), mobility(&row.tangent, &row.tangent));
    let wanted = -(1.0 + restitution) * u_n;
    let determinant = nn * tt - nt * nt;
    let stuck = [(wanted * tt + u_t * nt) / determinant, (-u_t * nn - wanted * nt) / determinant];
    if friction > 0.0 && stuck[0] >= 0.0 && stuck[1].abs() <= friction * stuck[0] {
        return stuck;
    }
    let slides = |sign: f64| {
        let p = wanted / (nn - sign * friction * nt);
        let after = u_t + (nt - sign * friction * tt) * p;
        (p >= 0.0 && sign * after >= 0.0).then_some([p, -sign * friction * p])
    };
    slides(u_t.signum()).or_else(|| slides(-u_t.signum())).unwrap_or([wanted / nn, 0.0])
}

fn product(row: &[f64], v: &[f64]) -> f64 {
    row.iter().zip(v).map(|(a, b)| a * b).sum()
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

/// Gauss-Seidel over the contacts until the impulses stand; these.
fn sweep(scene: &Scene, rows: &[Row], (inverse, v): (&[f64], &mut [f64])) -> Vec<[f64; 2]> {
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
        // the sweeps over the contacts end where impulses move by rounding
        if change < 1e-13 {
            break;
        }
    }
    impulses
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
