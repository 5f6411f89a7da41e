//! What is asked of a simulation, and whether it can be done.

use algebra::arrange::Arrange;
use std::sync::atomic::AtomicBool;
use words::Text;

use crate::dataset::Dataset;
use crate::integrate::stiff::Method;
use crate::integrate::taylor::check_tolerance;
use crate::marks::named::Named;
use crate::marks::pushes::Push;
use crate::marks::windows::Window;
use crate::{Fault, Quantity};
use words::digits::number;

/// Times at which results are wanted.
#[derive(Clone, Debug, PartialEq, Default)]
pub enum Grid {
    /// 0, dt, 2 dt, ... up to the end.
    Every(f64),
    /// Exactly these, in this order.
    At(Vec<f64>),
    /// 1001 equidistant times.
    #[default]
    Auto,
    /// As many equidistant times as the motion needs to be drawn ([`parts`]), which shows when its steps are known.
    Fitted,
}

/// What is kept of a motion beside its rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Kept {
    /// Its way, for pictures.
    #[default]
    Way,
    /// Nothing: only numbers are asked for.
    Numbers,
}

/// Options of the study.
pub struct Simulate<'a> {
    /// End of the run, s; it begins at 0.
    pub until: f64,
    /// Times of the result.
    pub grid: Grid,
    /// Relative tolerance of a step; see [`crate::integrate::taylor`]. Default 1e-12.
    pub tolerance: f64,
    /// Outputs by name; all when absent.
    pub outputs: Option<Vec<String>>,
    /// Formulas whose zeros are events, some of which end the motion.
    pub events: Vec<Named>,
    /// Normal forces that only push; where one becomes negative is an event.
    pub pushes: Vec<Push>,
    /// Outputs among those shown that are powers: their integrals are compared with the energy.
    pub works: Vec<String>,
    /// Outputs of which least, greatest and mean values between two instants are wanted.
    pub windows: Vec<Window>,
    /// Order of the Taylor polynomials; absent: as the tolerance and the motion ask.
    pub order: Option<usize>,
    /// Run again with other steps and see which digits hold.
    pub check: bool,
    /// Run again with half the tolerance and compare.
    pub tolerance_halving: bool,
    /// Set from outside to stop early; what is done is returned.
    pub interrupt: Option<&'a AtomicBool>,
    /// Told the finished share of the run, 0..1, now and then.
    pub progress: Option<&'a mut dyn FnMut(f64)>,
    /// Largest table, bytes; while it is made and handed over the process takes up to three times as much. Default 1e9.
    pub memory: f64,
    /// How the motion is integrated. Default auto.
    pub method: Method,
    /// Most steps: a run whose pace shows that it needs more is given up with a fault. Default 1e10.
    pub most_steps: f64,
    /// What is kept beside the rows. Default: the way.
    pub kept: Kept,
    /// Seed of the audits' random states.
    pub seed: u64,
    /// Instants at which the motion goes on from given states: one that magnifies its start beyond all digits is kept on its way by the starts of its parts.
    pub joints: Vec<(f64, Vec<f64>)>,
}

impl Simulate<'_> {
    /// Defaults for a run of this length.
    pub fn until(until: f64) -> Self {
        Simulate {
            until,
            grid: Grid::Auto,
            // as for a flow
            tolerance: 1e-12,
            outputs: None,
            events: Vec::new(),
            pushes: Vec::new(),
            works: Vec::new(),
            windows: Vec::new(),
            order: None,
            check: false,
            tolerance_halving: false,
            interrupt: None,
            progress: None,
            memory: 1e9,
            method: Method::Auto,
            most_steps: 1e10,
            kept: Kept::Way,
            seed: 1,
            joints: Vec::new(),
        }
    }
}

/// A result, and what ended the study early, if anything did.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outcome {
    /// What was found.
    pub dataset: Dataset,
    /// Why there is not more.
    pub fault: Option<Fault>,
}

/// Most events that are kept one by one.
pub(in crate::studies) const EVENTS: usize = 100_000;

const AUTO: usize = 1000;
/// Rows of a step, which spans about a radian of the quickest oscillation.
const ROWS_OF_STEP: u64 = 4;
/// Parts of a quicker motion; steps beyond those of the last do not make more.
const FINER: [u64; 4] = [2000, 5000, 10_000, 20_000];

/// Into how many parts the time is divided to draw a motion of so many steps; none where 1000 are enough.
pub fn parts(steps: u64) -> Option<u64> {
    let rows = ROWS_OF_STEP.saturating_mul(steps);
    let finest = FINER[FINER.len() - 1];
    (rows > AUTO as u64).then(|| FINER.into_iter().find(|parts| *parts >= rows).unwrap_or(finest))
}

/// Whether more steps leave the parts as they are.
pub(super) fn settled(steps: u64) -> bool {
    parts(steps) == FINER.last().copied()
}

/// Times in ascending order with the row each belongs to.
pub(in crate::studies) fn requested(options: &Simulate<'_>, columns: usize) -> Result<Vec<(f64, usize)>, Fault> {
    let rows = match &options.grid {
        Grid::Every(dt) => (options.until / dt).floor() + 1.0,
        Grid::At(times) => times.len() as f64,
        Grid::Auto | Grid::Fitted => AUTO as f64 + 1.0,
    };
    if rows * columns as f64 * 8.0 > options.memory {
        return Err(Fault::memory(rows, columns, options.memory));
    }
    let mut times: Vec<(f64, usize)> = match &options.grid {
        Grid::At(times) => times.iter().copied().enumerate().map(|(row, t)| (t, row)).collect(),
        Grid::Every(dt) => equidistant(options.until, *dt).into_iter().enumerate().map(|(row, t)| (t, row)).collect(),
        Grid::Auto | Grid::Fitted => (0..=AUTO).map(|k| (options.until * k as f64 / AUTO as f64, k)).collect(),
    };
    times.arrange_by(|a, b| a.0.total_cmp(&b.0));
    Ok(times)
}

/// 0, dt, 2 dt, ... rounded once: 3 * 0.1 is 0.3, not 0.30000000000000004.
fn equidistant(until: f64, dt: f64) -> Vec<f64> {
    // a quotient of two decimals is a whole number but for rounding
    let whole = |ratio: f64| ((ratio - ratio.round()).abs() <= 1e-12 * ratio).then(|| ratio.round());
    let steps = until / dt;
    let n = whole(steps).unwrap_or(steps.floor()) as u64;
    let per_second = whole(1.0 / dt);
    (0..=n)
        .map(|k| match (whole(steps), per_second) {
            // a tenth of a second is 0.1, whatever the end is
            (_, Some(per_second)) => (k as f64 / per_second).min(until),
            (Some(steps), None) => until * k as f64 / steps,
            (None, None) => k as f64 * dt,
        })
        .collect()
}

pub(in crate::studies) fn check(options: &Simulate<'_>) -> Result<(), Fault> {
    check_tolerance(options.tolerance)?;
    if !(options.until.is_finite() && options.until >= 0.0) {
        let n = number(options.until);
        let what = Text::new(format!("the run cannot end at t = {} s", n.en), format!("расчёт не может кончиться при t = {} с", n.ru));
        return Err(Fault::option(what, Text::new("give a positive `until`", "задайте положительное `until`")));
    }
    let step = match options.grid {
        Grid::Every(dt) if !(dt.is_finite() && dt > 0.0) => Some(dt),
        _ => None,
    };
    if let Some(dt) = step {
        let n = number(dt);
        let what = Text::new(format!("results every {} s make no grid", n.en), format!("шаг вывода {} с не образует сетки", n.ru));
        return Err(Fault::option(what, Text::new("give a positive `every`", "задайте положительный шаг `every`")));
    }
    let Grid::At(times) = &options.grid else { return Ok(()) };
    let Some(t) = times.iter().find(|t| !(**t >= 0.0 && **t <= options.until)) else { return Ok(()) };
    let (n, end) = (number(*t), number(options.until));
    Err(Fault::option(
        Text::new(
            format!("t = {} s is outside the run, 0 ... {} s", n.en, end.en),
            format!("момент t = {} с вне расчёта, 0 ... {} с", n.ru, end.ru),
        ),
        Text::new("change `at` or `until`", "измените `at` или `until`"),
    ))
}

/// Indices of the wanted outputs.
pub(in crate::studies) fn choose(outputs: &[Quantity], wanted: Option<&[String]>) -> Result<Vec<usize>, Fault> {
    let Some(wanted) = wanted else { return Ok((0..outputs.len()).collect()) };
    let find = |name: &String| {
        outputs.iter().position(|q| &q.name == name).ok_or_else(|| {
            let known: Vec<String> = outputs.iter().map(|q| q.name.clone()).collect();
            Fault::unknown_output(name, &known)
        })
    };
    wanted.iter().map(find).collect()
}

/// A remark on quantities that could not be followed everywhere between the rows.
pub(in crate::studies) fn untraced(names: &[String]) -> Option<Text> {
    let names = names.join(", ");
    (!names.is_empty()).then(|| {
        Text::new(
            format!("{names}: too quick or too rough to be followed everywhere between the rows; least, greatest and mean values and events may miss a part"),
            format!("{names}: изменяется слишком быстро или нерегулярно, чтобы проследить везде между строками; экстремумы, средние и события могут быть неполны"),
        )
    })
}
