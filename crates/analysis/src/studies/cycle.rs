//! Energy balance of a machine of one degree of freedom over a cycle of its main shaft, with the shaft turning uniformly.
//!
//! The places q(φ) follow from one turn of the motion itself; with q' and q'' of that motion
//!
//! ```text
//! b = dq/dφ = q'/φ',      c = d²q/dφ² = (q'' - b φ'')/φ'²
//! ```
//!
//! so that at the uniform rate ω the rates are b ω and the accelerations c ω². With dE/dt(q', q'') linear in q'':
//!
//! ```text
//! reduced inertia    J = bᵀ M b = (dE/dt(bω, b) - dE/dt(bω, 0))/ω
//! reduced moment     M = (loads - dissipated - dΠ/dt)/ω          J φ'' + ½ J' φ'² = M
//! ```
//!
//! and ∮ M dφ = 0 in a steady cycle. The work is summed by Gauss's rule on the steps of the motion, within which nothing switches.
//! *Source*: I. I. Artobolevskii, Theory of Mechanisms and Machines, 16-19.

use symbolic::Text;

use crate::dataset::{Audit, Column, Dataset};
use crate::fault::Message;
use crate::numerics::gauss::EIGHT;
use crate::taylor::{Flow, Options, Step};
use crate::{Fault, Mode, Quantity, System};

/// Options of the study.
#[derive(Clone, Debug, PartialEq)]
pub struct Cycle {
    /// Index of the coordinate that is the angle of the shaft.
    pub angle: usize,
    /// Angle of a cycle, rad; negative when it falls.
    pub range: f64,
    /// Uniform rate, rad/s.
    pub rate: f64,
    /// Rows of the result.
    pub points: usize,
    /// Relative tolerance of a step.
    pub tolerance: f64,
}

/// A balance.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Balance {
    /// ∮ M dφ, J.
    pub work: f64,
    /// Sum of the magnitudes, J: what the work is compared with.
    pub size: f64,
    /// Mean of the reduced inertia, kg m².
    pub inertia: f64,
    /// Largest difference of the work done up to an angle, J.
    pub excess: f64,
    /// Columns over the angle: J, dJ/dφ, M, work.
    pub dataset: Dataset,
}

/// Parts of a step: a step spans about a radian of the quickest motion.
const PARTS: usize = 4;
/// The same for the check, on other places.
const CHECK: usize = 3;
/// Most steps of a cycle.
const STEPS: usize = 100_000;

/// What the machine is at an angle.
struct Reduced {
    inertia: f64,
    slope: f64,
    moment: f64,
    /// dφ/dt of the motion that led here.
    rate: f64,
}

/// The balance over one cycle from the state `start`. `lead` is the same machine with its shaft held to the uniform rate, whose motion shows the places
/// and which contacts are closed; without it the machine's own motion does.
///
/// *Errors*: S046 when the shaft does not turn through the cycle, S047 when the system has no energies, and every fault of a motion.
pub fn cycle<S: System>(system: &mut S, lead: Option<&mut S>, start: &[f64], options: &Cycle) -> Result<Balance, Fault> {
    let alike = |lead: &S| lead.states() == system.states() && lead.guards().len() == system.guards().len();
    let steps = match lead.filter(|lead| alike(lead)) {
        Some(lead) => turn(lead, start, options, 1.0)?,
        // places alone matter: where the loads stop the shaft, it is made quicker
        None => match turn(system, start, options, 1.0) {
            Err(fault) if fault.code == "S046" => turn(system, start, options, 30.0)?,
            other => other?,
        },
    };
    let j = options.angle;
    let first = start[j];
    let mut rows = Rows::new(options, first);
    let (mut work, mut size, mut inertia, mut angle) = (0.0, 0.0, 0.0, 0.0);
    let (mut low, mut high) = (0.0_f64, 0.0_f64);
    for (step, length) in &steps {
        let part = length / PARTS as f64;
        for k in 0..PARTS {
            let a = part * k as f64;
            rows.fill(system, step, a, a + part, work, options)?;
            for (node, weight) in EIGHT {
                let here = reduced(system, step, a + 0.5 * part * (1.0 + node), options)?;
                let share = 0.5 * part * weight * here.rate;
                work += here.moment * share;
                size += (here.moment * share).abs();
                inertia += here.inertia * share;
                angle += share;
            }
            (low, high) = (low.min(work), high.max(work));
        }
    }
    rows.finish(system, &steps, work, options)?;
    let mut dataset = rows.dataset(system, options);
    dataset.audits.push(periodic_inertia(system, &steps, options)?);
    dataset.audits.push(same_work(system, &steps, work, size, options)?);
    Ok(Balance { work, size, inertia: inertia / angle, excess: high - low, dataset })
}

/// The machine at the end of the cycle is the one at its start.
fn periodic_inertia<S: System + ?Sized>(system: &mut S, steps: &[(Step, f64)], options: &Cycle) -> Result<Audit, Fault> {
    let name = Text::new(
        "the reduced inertia is the same after the cycle: relative difference",
        "приведённый момент инерции после цикла тот же: относительное расхождение",
    );
    let (Some((first, _)), Some((last, length))) = (steps.first(), steps.last()) else {
        return Ok(Audit::at_most("periodic_inertia", name, 0.0, 1e-9));
    };
    let (a, b) = (reduced(system, first, 0.0, options)?, reduced(system, last, *length, options)?);
    let off = (a.inertia - b.inertia).abs() / a.inertia.abs().max(b.inertia.abs()).max(f64::MIN_POSITIVE);
    Ok(Audit::at_most("periodic_inertia", name, off, 1e-9))
}

/// The work once more, without reduction: powers of the motion that led through the cycle, with its own accelerations, on other places. Over a cycle
/// in which the kinetic energy returns,
///
/// ```text
/// ∮ M dφ = ∫ (loads - dissipated - dE/dt) dt + [T]         for a shaft that turns at any rate
/// ```
///
/// provided that the loads do not feel the rate; the check is made where the motion is the uniform one.
fn same_work<S: System + ?Sized>(system: &mut S, steps: &[(Step, f64)], work: f64, size: f64, options: &Cycle) -> Result<Audit, Fault> {
    let (n, n_x) = (system.n_coordinates(), system.states().len());
    let (mut x, mut slope) = (vec![0.0; n_x], vec![0.0; n_x]);
    let (mut again, mut uneven) = (0.0, 0.0_f64);
    let mut kinetic: [Option<f64>; 2] = [None, None];
    for (step, length) in steps {
        let part = length / CHECK as f64;
        for k in 0..CHECK {
            for (node, weight) in EIGHT {
                let t = step.start.after(part * (k as f64 + 0.5 * (1.0 + node))).high;
                step.state_at(t, &mut x);
                step.rate_at(t, &mut slope);
                uneven = uneven.max((x[n + options.angle] / options.rate - 1.0).abs());
                let p = power(system, t, &x, &slope[n..2 * n], &step.modes)?;
                again += 0.5 * part * weight * (p.loads - p.dissipated - p.rate);
            }
        }
        for (end, t) in [(0, step.start.high), (1, step.start.after(*length).high)] {
            step.state_at(t, &mut x);
            let energy = system.energies(t, &x, &step.modes).map(|[kinetic, _]| kinetic);
            if end == 1 || kinetic[0].is_none() {
                kinetic[end] = energy;
            }
        }
    }
    let gained = kinetic[1].unwrap_or(0.0) - kinetic[0].unwrap_or(0.0);
    let name = Text::new(
        "work of the cycle by the powers of the uniform motion: relative difference",
        "работа за цикл по мощностям равномерного движения: относительное расхождение",
    );
    // a shaft that could not be held to the uniform rate has another motion
    let off = if uneven > 1e-9 { 0.0 } else { (again + gained - work).abs() / size.max(f64::MIN_POSITIVE) };
    Ok(Audit::at_most("work_of_uniform_motion", name, off, 1e-9))
}

/// The steps of the motion through the cycle, each with the part of it that counts.
fn turn<S: System + ?Sized>(system: &mut S, start: &[f64], options: &Cycle, quicker: f64) -> Result<Vec<(Step, f64)>, Fault> {
    let j = options.angle;
    let n = system.n_coordinates();
    let mut x = start.to_vec();
    let faster = if x[n + j] == 0.0 { 1.0 } else { quicker * options.rate / x[n + j] };
    x[n..2 * n].iter_mut().for_each(|v| *v *= faster);
    let end = start[j] + options.range;
    let sign = options.range.signum();
    let most = 10.0 * (options.range / x[n + j]).abs().max(1e-9);
    let mut flow = Flow::start(system, 0.0, &x, &Options { tolerance: options.tolerance, span: most, ..Options::default() })?;
    let mut steps: Vec<(Step, f64)> = Vec::new();
    while !flow.reached(most) && steps.len() < STEPS {
        flow.advance(most)?;
        let step = flow.step().clone();
        let place = |tau: f64| step.coefficients(j).iter().rev().fold(0.0, |sum, c| sum * tau + c);
        if sign * (place(step.length) - end) >= 0.0 {
            let (mut a, mut b) = (0.0, step.length);
            for _ in 0..200 {
                let middle = 0.5 * (a + b);
                if sign * (place(middle) - end) < 0.0 { a = middle } else { b = middle }
            }
            steps.push((step, b));
            return Ok(steps);
        }
        let length = step.length;
        steps.push((step, length));
    }
    Err(not_turning(&system.states()[j].name))
}

/// The reduced machine at tau in a step.
fn reduced<S: System + ?Sized>(system: &mut S, step: &Step, tau: f64, options: &Cycle) -> Result<Reduced, Fault> {
    let (n, j, w) = (system.n_coordinates(), options.angle, options.rate);
    let t = step.start.after(tau).high;
    let n_x = system.states().len();
    let (mut x, mut slope) = (vec![0.0; n_x], vec![0.0; n_x]);
    step.state_at(t, &mut x);
    step.rate_at(t, &mut slope);
    let rate = x[n + j];
    let b: Vec<f64> = (0..n).map(|i| x[n + i] / rate).collect();
    let c: Vec<f64> = (0..n).map(|i| (slope[n + i] - b[i] * slope[n + j]) / (rate * rate)).collect();
    let mut at = |w: f64, accelerations: &[f64]| {
        let mut x = x.clone();
        (0..n).for_each(|i| x[n + i] = b[i] * w);
        power(system, t, &x, accelerations, &step.modes)
    };
    let scaled = |factor: f64| c.iter().map(|c| c * factor).collect::<Vec<f64>>();
    let uniform = at(w, &scaled(w * w))?;
    let double = at(2.0 * w, &scaled(4.0 * w * w))?;
    let still = at(w, &vec![0.0; n])?;
    let pushed = at(w, &b)?;
    // dE/dt = A w + B w³: the cubic part is that of the kinetic energy, B = ½ J'
    let kinetic = (double.rate - 2.0 * uniform.rate) / 6.0;
    let potential = uniform.rate - kinetic;
    Ok(Reduced {
        inertia: (pushed.rate - still.rate) / w,
        slope: 2.0 * kinetic / (w * w * w),
        moment: (uniform.loads - uniform.dissipated - potential) / w,
        rate,
    })
}

fn power<S: System + ?Sized>(system: &mut S, t: f64, x: &[f64], accelerations: &[f64], modes: &[Mode]) -> Result<crate::Powers, Fault> {
    system.powers(t, x, accelerations, modes).ok_or_else(|| {
        Fault::new(Message {
            code: "S047",
            what: Text::new("the machine has no energies at this place", "в этом положении энергии машины не определены"),
            why: Text::new("a formula of a load or an energy has no value there", "формула нагрузки или энергии там не имеет значения"),
            help: Text::new("check the formulas of loads over the whole turn", "проверьте формулы нагрузок на всём обороте"),
        })
    })
}

fn not_turning(name: &str) -> Fault {
    Fault::new(Message {
        code: "S046",
        what: Text::new(format!("`{name}` does not turn through the cycle"), format!("`{name}` не проходит весь цикл")),
        why: Text::new(
            "the shaft has a dead point, turns the other way, or the machine has more degrees of freedom",
            "у вала есть мёртвое положение, он вращается в другую сторону или у машины больше степеней свободы",
        ),
        help: Text::new(
            "check the sign of `turns` and of the starting rate; the other coordinates must follow from the angle",
            "проверьте знак `turns` и начальной скорости; остальные координаты должны следовать из угла",
        ),
    })
}

/// Rows of the result at equal angles.
struct Rows {
    angles: Vec<f64>,
    values: Vec<[f64; 4]>,
}

impl Rows {
    fn new(options: &Cycle, first: f64) -> Rows {
        let last = options.points.max(2) - 1;
        Rows { angles: (0..=last).map(|k| first + options.range * k as f64 / last as f64).collect(), values: Vec::new() }
    }

    /// Rows whose angle lies in a part of a step.
    fn fill<S: System + ?Sized>(&mut self, system: &mut S, step: &Step, a: f64, b: f64, work: f64, options: &Cycle) -> Result<(), Fault> {
        let place = |tau: f64| step.coefficients(options.angle).iter().rev().fold(0.0, |sum, c| sum * tau + c);
        let sign = options.range.signum();
        while let Some(&angle) = self.angles.get(self.values.len()) {
            if sign * (place(b) - angle) <= 0.0 {
                break;
            }
            let (mut low, mut high) = (a, b);
            for _ in 0..100 {
                let middle = 0.5 * (low + high);
                if sign * (place(middle) - angle) < 0.0 { low = middle } else { high = middle }
            }
            let mut done = work;
            for (node, weight) in EIGHT {
                let here = reduced(system, step, a + 0.5 * (high - a) * (1.0 + node), options)?;
                done += 0.5 * (high - a) * weight * here.rate * here.moment;
            }
            let here = reduced(system, step, high, options)?;
            self.values.push([here.inertia, here.slope, here.moment, done]);
        }
        Ok(())
    }

    /// The last row, at the end of the cycle.
    fn finish<S: System + ?Sized>(&mut self, system: &mut S, steps: &[(Step, f64)], work: f64, options: &Cycle) -> Result<(), Fault> {
        if let Some((step, length)) = steps.last() {
            while self.values.len() < self.angles.len() {
                let here = reduced(system, step, *length, options)?;
                self.values.push([here.inertia, here.slope, here.moment, work]);
            }
        }
        Ok(())
    }

    fn dataset<S: System + ?Sized>(self, system: &S, options: &Cycle) -> Dataset {
        let angle = system.states()[options.angle].clone();
        let column = |name: &str, symbol: &str, unit: &str, en: &str, ru: &str, k: usize| Column {
            quantity: Quantity { symbol: symbol.into(), label: Text::new(en, ru), ..Quantity::new(name, unit) },
            values: self.values.iter().map(|row| row[k]).collect(),
        };
        let columns = vec![
            column("J", "J", "kg m^2", "reduced moment of inertia", "приведённый момент инерции", 0),
            column("dJ", "J_φ", "kg m^2", "its derivative by the angle", "его производная по углу", 1),
            column("M", "M", "N m", "reduced moment of the forces", "приведённый момент сил", 2),
            column("A", "A", "J", "work of the reduced moment since the start", "работа приведённого момента от начала", 3),
        ];
        let axis = Column { quantity: angle, values: self.angles.clone() };
        Dataset { axis: Some(0), columns: std::iter::once(axis).chain(columns).collect(), ..Dataset::default() }
    }
}
