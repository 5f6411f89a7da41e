//! Lyapunov's exponents of a motion: how quickly small disturbances of it grow on average, whether it comes back or not.
//!
//! ```text
//! Y = Φ(t + τ, t) Q = Q' R      columns of Q' orthonormal, R triangular (Gram and Schmidt, twice)
//! λ_k = Σ ln R_kk / Σ τ         the largest first
//! ```
//!
//! Φ comes from the variational equations, with saltation where the motion switches. The mean of the parts of the motion tells what is known of it: their spread over the root of their number, by
//! Student's distribution. *Source*: G. Benettin, L. Galgani, A. Giorgilli, J.-M. Strelcyn, Meccanica 15 (1980) 9-30.

use crate::integrate::taylor::{Options as Tolerances, check_tolerance};
use crate::studies::periodic::{CORRECTS, Listener, Look, Piece, Stage, piece, tangent_of};
use crate::{Fault, Guard, GuardKind, Mode, System};
use algebra::elementary;
use algebra::random::Random;
use algebra::vectors::{dot, norm};

/// Share of the time in which a disturbance turns into the direction that grows most: nothing counts before.
const TURNS_IN: f64 = 0.1;
/// Parts whose means are compared.
const PARTS: usize = 20;
/// Student's quantile of 95 % for 19 degrees of freedom.
const STUDENT: f64 = 2.093;
/// Pieces of a part, at least.
const PIECES: usize = 5;
/// Every so many pieces Liouville's formula is looked at.
const LOOKED_AT: usize = 8;
/// Share of a piece that is left of the time by rounding of its sum, and is none.
const REST: f64 = 1e-9;
/// Rows of the state that are those of 1 by this: a state that nothing disturbs.
const UNTOUCHED: f64 = 1e-14;
/// From a tenth of the time to its end a disturbance that grows like t⁴ gains 10⁴: what grows by less than the next power of ten, e^11.5, may have no exponent.
const GROWN: f64 = 11.5;
/// Openings of contacts, in the time that counts, from which on what they take away is taken again and again.
const AGAIN: usize = 2;
/// By how much the directions of a piece may grow apart, as powers of e: ten digits, of sixteen.
const FAR_APART: f64 = 23.0;
/// Share of the longest piece below which a direction that is gone has been taken away, and has not died.
const SHORTEST: f64 = 1e-3;
/// Exponents that are further apart than this in a piece, as powers of e, drown in the rounding of its matrix.
const DROWNED: f64 = 25.0;

/// Where the numbers begin that mix directions; any do.
const SEED: u64 = 5;

/// What is asked.
#[derive(Clone, Copy)]
pub struct Options<'a> {
    /// Motion that is let pass before, s.
    pub settle: f64,
    /// Motion that counts, s.
    pub duration: f64,
    /// Relative tolerance of a step.
    pub tolerance: f64,
    /// Who listens.
    pub listener: Listener<'a>,
}

/// An exponent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rate {
    /// 1/s.
    pub value: f64,
    /// Half of the interval in which it lies with 95 % by the spread of the parts, and what the digits of the matrices leave open, 1/s.
    pub error: f64,
}

/// What becomes of disturbances in the long run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fate {
    /// They grow like an exponential: chaotic, where the motion stays bounded.
    Grow,
    /// They die out.
    Die,
    /// They do neither, as far as this time tells.
    Neither,
}

impl Fate {
    /// Name in files.
    pub fn key(self) -> &'static str {
        match self {
            Fate::Grow => "grows",
            Fate::Die => "dies",
            Fate::Neither => "undecided",
        }
    }
}

/// The exponents of a motion.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lyapunov {
    /// The largest first; those that a switch or rounding takes away are left out from there on.
    pub exponents: Vec<Rate>,
    /// Time and mean growth of the largest up to it.
    pub history: Vec<[f64; 2]>,
    /// By how much Liouville's formula is missed in a piece, at most.
    pub liouville: f64,
    /// Time that counts, s.
    pub counted: f64,
    /// Whether the motion was interrupted.
    pub partial: bool,
    /// When a direction came back, once, that a closed contact or a friction that sticks had taken away in the time that counts: nothing is known of it.
    pub opened: Option<f64>,
}

impl Lyapunov {
    /// What becomes of disturbances; where a switch takes all of them away, for good or again and again, they die.
    pub fn fate(&self) -> Fate {
        match self.exponents.first() {
            Some(rate) if rate.value > rate.error && rate.value * self.counted > GROWN => Fate::Grow,
            _ if self.opened.is_some() => Fate::Neither,
            None => Fate::Die,
            Some(rate) if rate.value < -rate.error => Fate::Die,
            Some(_) => Fate::Neither,
        }
    }

    /// The dimension of Kaplan and Yorke, k + (λ₁ + ... + λ_k)/|λ_(k+1)| with the largest k whose sum is not negative; none where disturbances do not grow, or not all exponents are known.
    pub fn dimension(&self, states: usize) -> Option<f64> {
        if self.fate() != Fate::Grow || self.exponents.len() < states {
            return None;
        }
        let mut sum = 0.0;
        for (k, rate) in self.exponents.iter().enumerate() {
            if sum + rate.value < 0.0 {
                return Some(k as f64 + sum / rate.value.abs());
            }
            sum += rate.value;
        }
        None
    }
}

/// ln R_kk of a piece, and when it ended.
struct Stretch {
    end: f64,
    length: f64,
    logs: Vec<f64>,
}

/// The exponents of the motion from a start, and how many directions may be disturbed.
///
/// *Errors*: those of a motion; S054, S055, S122 and S141 where it has no derivative by its start.
pub fn lyapunov<S: System + ?Sized>(system: &mut S, start: &[f64], options: &Options<'_>) -> Result<(Lyapunov, usize), Fault> {
    check_tolerance(options.tolerance)?;
    let end = options.settle + options.duration;
    let flow = Tolerances { tolerance: options.tolerance, span: end, ..Tolerances::default() };
    let counts = options.settle + TURNS_IN * options.duration;
    let most = (1.0 - TURNS_IN) * options.duration / (PARTS * PIECES) as f64;
    let (mut t, mut x) = (0.0, start.to_vec());
    let mut frame: Option<Frame> = None;
    let mut openings = Openings::default();
    let mut stretches: Vec<Stretch> = Vec::new();
    let mut found = Lyapunov { counted: (1.0 - TURNS_IN) * options.duration, ..Lyapunov::default() };
    let (mut number, mut reach, mut hopeless) = (0, most, false);
    let can_hold = system.guards().iter().any(|guard| is_one_sided(&guard.kind));
    while end - t > REST * most {
        if options.listener.interrupt.is_some_and(|flag| flag.load(std::sync::atomic::Ordering::Relaxed)) {
            found.partial = true;
            break;
        }
        if let Some(told) = options.listener.told {
            told(Stage::Settling(t, end));
        }
        let look = if number % LOOKED_AT == 0 { Look::Close } else { Look::Quick };
        let last = if t < counts { counts } else { end };
        let follow = |system: &mut S, until: f64| piece(system, (t, &x), until, &flow, (look, Listener { told: None, ..options.listener }));
        let mut next = follow(system, (t + reach).min(last))?;
        let frame = match &mut frame {
            Some(frame) => frame,
            none => none.insert(Frame::new(system, (t, &x), &next)?),
        };
        // over a long piece what dies most quickly is rounding beside what lives: a shorter one keeps it
        let before = reach;
        while !hopeless && frame.parts_in(&next) {
            reach = 0.5 * (next.end.0 - t);
            hopeless = reach < SHORTEST * most;
            next = follow(system, (t + reach).min(last))?;
        }
        if hopeless {
            reach = reach.max(before);
        }
        if frame.is_held(system, &next.modes) {
            let free = frame.free(system, (t, &x, &next.modes), &next.scales)?;
            frame.onto(&free);
            // without contacts and frictions nothing takes a direction away: what is missing has died
            match t < counts || !can_hold {
                true => frame.take(free),
                false => openings.seen(t, (free.len(), frame.columns.len())),
            }
        }
        let logs = frame.carry(&next.matrix);
        found.liouville = found.liouville.max(next.liouville);
        if t >= counts {
            stretches.push(Stretch { end: next.end.0, length: next.end.0 - t, logs });
        }
        (t, x) = next.end;
        number += 1;
    }
    found.opened = openings.first.filter(|_| openings.count < AGAIN);
    let known = stretches.iter().map(|s| s.logs.len()).min().unwrap_or(0);
    found.exponents = (0..known).map_while(|k| rate(&stretches, k, (counts, end))).collect();
    // equal ones come in the order of their spread
    found.exponents.sort_by(|a, b| b.value.total_cmp(&a.value));
    found.history = history(&stretches);
    Ok((found, frame.map_or(0, |frame| frame.states)))
}

/// Time and mean growth of the largest exponent up to it.
fn history(stretches: &[Stretch]) -> Vec<[f64; 2]> {
    let (mut sum, mut time) = (0.0, 0.0);
    let known = stretches.iter().filter(|s| !s.logs.is_empty());
    known
        .map(|stretch| {
            sum += stretch.logs[0];
            time += stretch.length;
            [stretch.end, sum / time]
        })
        .collect()
}

/// Directions that come back while exponents are counted.
#[derive(Default)]
struct Openings {
    first: Option<f64>,
    count: usize,
    open: bool,
}

impl Openings {
    /// So many directions are free at a time, and so many are followed.
    fn seen(&mut self, t: f64, (free, followed): (usize, usize)) {
        let open = free > followed;
        if open && !self.open {
            self.count += 1;
            self.first = self.first.or(Some(t));
        }
        self.open = open;
    }
}

/// The mean of an exponent with its error; none where it drowns in rounding.
fn rate(stretches: &[Stretch], k: usize, (from, to): (f64, f64)) -> Option<Rate> {
    if stretches.iter().any(|s| s.logs[0] - s.logs[k] > DROWNED) {
        return None;
    }
    let mut parts = [[0.0; 2]; PARTS];
    for stretch in stretches {
        let middle = stretch.end - 0.5 * stretch.length;
        let part = ((middle - from) / (to - from) * PARTS as f64) as usize;
        let [sum, time] = &mut parts[part.min(PARTS - 1)];
        *sum += stretch.logs[k];
        *time += stretch.length;
    }
    let [sum, time] = parts.iter().fold([0.0, 0.0], |[s, t], [sum, time]| [s + sum, t + time]);
    let means: Vec<f64> = parts.iter().filter(|part| part[1] > 0.0).map(|[sum, time]| sum / time).collect();
    let (value, count) = (sum / time, means.len() as f64);
    let spread = means.iter().map(|mean| (mean - value) * (mean - value)).sum::<f64>() / (count - 1.0).max(1.0);
    // each matrix is known to so many digits, all of which may be off to one side
    let digits = CORRECTS * stretches.len() as f64 / time;
    value.is_finite().then_some(Rate { value, error: STUDENT * (spread / count).sqrt() + digits })
}

/// Orthonormal disturbances, in scales.
struct Frame {
    scales: Vec<f64>,
    columns: Vec<Vec<f64>>,
    /// States that are functions of time alone.
    clocks: Vec<bool>,
    /// Directions that are free where no contact is closed and no friction sticks.
    states: usize,
}

impl Frame {
    /// All directions that are free at the start of a piece.
    fn new<S: System + ?Sized>(system: &mut S, (t, x): (f64, &[f64]), first: &Piece) -> Result<Frame, Fault> {
        let n = first.scales.len();
        let untouched = |i: usize| (0..n).all(|j| (first.matrix[i * n + j] - if i == j { 1.0 } else { 0.0 }).abs() <= UNTOUCHED);
        let clocks = (0..n).map(|i| i >= 2 * system.n_coordinates() && untouched(i)).collect();
        let mut frame = Frame { scales: first.scales.clone(), columns: Vec::new(), clocks, states: 0 };
        let loose = |(guard, mode): (&Guard, &Mode)| if is_one_sided(&guard.kind) { Mode::Positive } else { *mode };
        let open: Vec<Mode> = system.guards().iter().zip(&first.modes).map(loose).collect();
        frame.states = frame.free(system, (t, x, &open), &first.scales)?.len();
        Ok(frame)
    }

    /// The directions that connections, closed contacts and frictions that stick leave free, without those of states that are functions of time alone.
    fn free<S: System + ?Sized>(&self, system: &mut S, place: (f64, &[f64], &[Mode]), scales: &[f64]) -> Result<Vec<Vec<f64>>, Fault> {
        let (free, basis) = tangent_of(system, place, scales)?;
        let own = free.iter().zip(basis).filter(|(i, _)| !self.clocks[**i]);
        Ok(own.map(|(_, column)| column.iter().zip(&self.scales).map(|(c, s)| c / s).collect()).collect())
    }

    /// Whether fewer directions are free, or followed, than there are states.
    fn is_held<S: System + ?Sized>(&self, system: &S, modes: &[Mode]) -> bool {
        let shut = |(guard, mode): (&Guard, &Mode)| is_one_sided(&guard.kind) && *mode == Mode::Zero;
        let own = self.clocks.iter().filter(|clock| !**clock).count();
        self.columns.len() < own || system.guards().iter().zip(modes).any(shut)
    }

    /// Takes out of the disturbances what leads off the conditions. Rounding alone leads there, but what it leaves neither grows nor dies, and would outlive a disturbance that dies.
    fn onto(&mut self, free: &[Vec<f64>]) {
        let mut basis = Vec::new();
        extend(&mut basis, free.to_vec());
        for column in &mut self.columns {
            let mut off = column.clone();
            without(&mut off, &basis);
            column.iter_mut().zip(off).for_each(|(c, off)| *c -= off);
        }
    }

    /// Takes directions that are free and not followed yet, and mixes all of them. The first disturbance finds what grows most only if it has a part in every direction: in a machine that falls
    /// apart into pieces one along a coordinate would stay in its own piece for ever.
    fn take(&mut self, free: Vec<Vec<f64>>) {
        let before = self.columns.len();
        extend(&mut self.columns, free);
        let k = self.columns.len();
        if k == before {
            return;
        }
        let mut random = Random::new(SEED);
        let mixed = |_| {
            let mut sum = vec![0.0; self.scales.len()];
            for column in &self.columns {
                let share = random.between(-1.0, 1.0);
                sum.iter_mut().zip(column).for_each(|(s, c)| *s += share * c);
            }
            sum
        };
        self.columns = (0..k).map(mixed).collect();
        self.orthonormal();
    }

    /// The disturbances at the end of a piece, and the logarithms of their growth. What a switch takes away is no more.
    fn carry(&mut self, matrix: &[f64]) -> Vec<f64> {
        let n = self.scales.len();
        for column in &mut self.columns {
            let old: Vec<f64> = column.iter().zip(&self.scales).map(|(c, s)| c * s).collect();
            for (i, entry) in column.iter_mut().enumerate() {
                *entry = dot(&matrix[i * n..(i + 1) * n], &old) / self.scales[i];
            }
        }
        self.orthonormal()
    }

    /// Whether the directions that are followed grow so far apart in a piece in which nothing switches that one of them is lost: there it has died, and has not been taken away.
    fn parts_in(&self, piece: &Piece) -> bool {
        let mut after = Frame { scales: self.scales.clone(), columns: self.columns.clone(), clocks: Vec::new(), states: 0 };
        let logs = after.carry(&piece.matrix);
        let ends = logs.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], log| [least.min(*log), most.max(*log)]);
        !piece.switches && (logs.len() < self.columns.len() || ends[1] - ends[0] > FAR_APART)
    }

    /// Makes the columns orthonormal; logarithms of what they had been long beside those before them.
    fn orthonormal(&mut self) -> Vec<f64> {
        let (mut logs, mut kept): (Vec<f64>, Vec<Vec<f64>>) = (Vec::new(), Vec::new());
        for mut column in std::mem::take(&mut self.columns) {
            let whole = norm(&column);
            without(&mut column, &kept);
            let length = norm(&column);
            // what is rounding of the sums has no direction
            if length > f64::EPSILON * whole && length.is_normal() {
                logs.push(elementary::ln(length));
                column.iter_mut().for_each(|c| *c /= length);
                kept.push(column);
            }
        }
        self.columns = kept;
        logs
    }
}

/// Takes out of a column what lies along orthonormal others; once more for what rounding leaves of the first time.
fn without(column: &mut [f64], others: &[Vec<f64>]) {
    for _ in 0..2 {
        for other in others {
            let share = dot(column, other);
            column.iter_mut().zip(other).for_each(|(c, o)| *c -= share * o);
        }
    }
}

/// Whether a guard's mode of zero holds something: a contact that is closed, a friction that sticks.
fn is_one_sided(kind: &GuardKind) -> bool {
    matches!(kind, GuardKind::Contact { .. } | GuardKind::Friction { .. })
}

/// Adds to orthonormal columns those of the others that are not there yet, the farthest from what is there first, until they are as many.
fn extend(columns: &mut Vec<Vec<f64>>, others: Vec<Vec<f64>>) {
    let whole = others.len();
    let mut left = others;
    for column in &mut left {
        let size = norm(column);
        column.iter_mut().for_each(|c| *c /= size);
    }
    while columns.len() < whole && !left.is_empty() {
        left.iter_mut().for_each(|column| without(column, columns));
        let longest = (0..left.len()).fold(0, |best, k| if norm(&left[k]) > norm(&left[best]) { k } else { best });
        let mut column = left.swap_remove(longest);
        let size = norm(&column);
        if !size.is_normal() {
            return;
        }
        column.iter_mut().for_each(|c| *c /= size);
        columns.push(column);
    }
}
