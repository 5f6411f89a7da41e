//! Stability at one set of values: multipliers, verdict, Hill's equation, checks.

use super::asked::{About, Stability};
use super::reduction::{Reduction, refused};
use crate::machine::{Machine, explained};
use crate::periodic;
use crate::watch::Watch;
use analysis::dataset::Audit;
use analysis::studies::periodic::Multiplier;
use analysis::studies::stability::{self as floquet, Criterion, Exponent, Resonance, Scalar, Verdict};
use analysis::{Fault, System};
use std::f64::consts::TAU;
use words::{Notice, Text};

/// Two ways to the multipliers may differ by this share of the largest.
const TWO_WAYS: f64 = 1e-8;
/// Error of a multiplier of Hill's equation, beside the largest.
const OF_HILL: f64 = 1e-11;
/// By how much the determinant may miss Liouville's formula.
const LIOUVILLE: f64 = 1e-10;
/// Instants that the collocation may use.
const INSTANTS: usize = 128;

/// What was found.
#[derive(Clone, Debug)]
pub(super) struct Point {
    /// Period of the coefficients, s.
    pub(super) period: f64,
    /// Largest first.
    pub(super) multipliers: Vec<Multiplier>,
    /// Of each multiplier.
    pub(super) exponents: Vec<Option<Exponent>>,
    /// The verdict.
    pub(super) verdict: Verdict,
    /// Greatest growth, 1/s.
    pub(super) growth: Option<f64>,
    /// Hill's equation, where there is one.
    pub(super) scalar: Option<Scalar>,
    /// Why disturbances grow.
    pub(super) resonance: Option<Resonance>,
    /// By how much Liouville's formula is missed.
    pub(super) liouville: f64,
    /// Checks.
    pub(super) audits: Vec<Audit>,
    /// Remarks.
    pub(super) notes: Vec<Text>,
}

/// How much is asked of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Care {
    /// The second way and the name of the resonance too.
    Full,
    /// The verdict with the checks of the motion.
    Checked,
    /// The verdict alone.
    Verdict,
}

/// About a motion of the machine, or its place of rest.
pub(super) fn of_motion(machine: &mut Machine, study: &periodic::Periodic, care: Care, watch: &mut Watch) -> Result<Point, Notice> {
    if let Some(point) = of_rest(machine, study, care) {
        return Ok(point);
    }
    let outcome = periodic::regime(machine, study, watch);
    if let Some(fault) = outcome.fault {
        return Err(explained(fault, &machine.equations));
    }
    let regime = outcome.regime;
    if regime.multipliers.is_empty() {
        return Err(no_multipliers(regime.dataset.notes.iter().find(|note| note.en.starts_with("no multipliers"))));
    }
    let clocks = clocks(machine, &regime.coefficients);
    // one that nothing feels is a translation, and has no multiplier already
    let counted = clocks.iter().filter(|state| regime.returning.contains(state)).count();
    let multipliers = floquet::without_clocks(&regime.multipliers, counted);
    let rows = without(&regime.coefficients, &clocks);
    let lone = multipliers.iter().any(|m| m.trivial);
    let scalar = if lone { None } else { Scalar::of_coefficients(regime.period, &rows) };
    let mut audits: Vec<Audit> = regime.dataset.audits.into_iter().filter(|a| KEPT.contains(&a.key.as_str())).collect();
    let liouville = audits.iter().find(|a| a.key == "liouville").map_or(f64::NAN, |a| a.value);
    audits.extend(scalar.as_ref().map(|scalar| against_hill(scalar, &multipliers)));
    let exponents = floquet::exponents(&multipliers, regime.period);
    let verdict = scalar.as_ref().map_or_else(|| floquet::verdict(&multipliers), |s| s.verdict(Criterion::Hill));
    let mut point = Point {
        period: regime.period,
        growth: floquet::growth(&multipliers, regime.period),
        resonance: None,
        notes: regime.dataset.notes,
        multipliers,
        exponents,
        verdict,
        scalar,
        liouville,
        audits,
    };
    if care == Care::Full {
        point.examine(&rows).map_err(|fault| explained(fault, &machine.equations))?;
    }
    Ok(point)
}

/// About a place where the machine rests at every instant: Hill's equation from its coefficients, where the verdict alone is wanted. Whatever speaks against it is left to the motion.
pub(super) fn of_rest(machine: &mut Machine, study: &periodic::Periodic, care: Care) -> Option<Point> {
    let period = study.period.filter(|_| care == Care::Verdict && study.section == periodic::Section::Time && study.settle == 0.0)?;
    if !machine.equations.conditions.is_empty() {
        return None;
    }
    let start = machine.system.start().ok()?;
    (analysis::made::STANDING)(&mut machine.system, &start, period).ok().flatten().map(of_scalar)
}

/// About the positions of a machine whose coordinate runs uniformly.
pub(super) fn of_running(reduction: &Reduction, (start, speed): (f64, f64), care: Care) -> Result<Point, Notice> {
    let period = TAU / speed.abs();
    let at = |t: f64| reduction.at(start + speed * t);
    if !repeats(reduction, start) {
        return Err(refused(
            ("its coefficients do not repeat after a turn", "его коэффициенты не повторяются через оборот"),
            ("`angle` must be an angle that turns", "`angle` должен быть углом, который поворачивается"),
        ));
    }
    let over = |value: f64, inertia: f64| (inertia > 0.0 && value.is_finite()).then(|| value / inertia);
    let stiffness = |t: f64| over(at(t)[1], at(t)[0]);
    let decay = |t: f64| if reduction.is_undamped() { Some(0.0) } else { over(0.5 * at(t)[2], at(t)[0]) };
    let scalar = Scalar::of(period, stiffness, decay).ok_or_else(not_smooth)?;
    let mut point = of_scalar(scalar);
    if care == Care::Full {
        let rows = sampled(&point);
        point.examine(&rows).map_err(Notice::from)?;
    }
    Ok(point)
}

/// Positions at which it is looked whether coefficients repeat: no divisor of those at which a harmonic of the turn vanishes.
const LOOKED: usize = 11;
/// Share of the largest value of a coefficient by which it may differ a turn further: angles are rounded there; one of another period differs by its size. One of its own values may be 0 to rounding, as
/// that of a damping without a mean is somewhere.
const REPEATED: f64 = 1e-9;

/// Whether the coefficients are the same a turn further; what has no value is left to those who need it.
fn repeats(reduction: &Reduction, start: f64) -> bool {
    let pairs: Vec<[[f64; 3]; 2]> =
        (0..LOOKED).map(|k| start + TAU * k as f64 / LOOKED as f64).map(|phi| [reduction.at(phi), reduction.at(phi + TAU)]).collect();
    (0..3).all(|i| {
        let size = pairs.iter().flatten().map(|known| known[i].abs()).filter(|v| v.is_finite()).fold(0.0, f64::max);
        !pairs.iter().any(|[here, there]| (here[i] - there[i]).abs() > REPEATED * size)
    })
}

fn of_scalar(scalar: Scalar) -> Point {
    let period = scalar.hill.period;
    let pair = scalar.multipliers();
    let largest = pair.iter().map(|[re, im]| algebra::elementary::hypot(*re, *im)).fold(1.0, f64::max);
    let multiplier = |[re, im]: [f64; 2]| Multiplier { re, im, error: OF_HILL * largest, ..Multiplier::default() };
    let multipliers: Vec<Multiplier> = pair.into_iter().map(multiplier).collect();
    let name =
        Text::new("Liouville's formula: the determinant of Hill's equation is 1", "формула Лиувилля: определитель уравнения Хилла равен 1");
    Point {
        period,
        exponents: floquet::exponents(&multipliers, period),
        growth: floquet::growth(&multipliers, period),
        verdict: scalar.verdict(Criterion::Hill),
        resonance: None,
        liouville: scalar.liouville(),
        audits: vec![Audit::at_most("liouville", name, scalar.liouville(), LIOUVILLE)],
        notes: Vec::new(),
        multipliers,
        scalar: Some(scalar),
    }
}

/// Checks of a motion that say something of its multipliers.
const KEPT: [&str; 3] = ["closure", "liouville", "trivial_multiplier"];

impl Point {
    /// The second way, and why disturbances grow.
    fn examine(&mut self, rows: &[Vec<f64>]) -> Result<(), Fault> {
        let stride = (rows.len() / INSTANTS).max(1);
        let thinned: Vec<Vec<f64>> = rows.iter().step_by(stride).cloned().collect();
        if let Some(off) = floquet::by_collocation(self.period, &thinned, &self.multipliers)? {
            let name = Text::new(
                "multipliers by steps in time against trigonometric collocation: difference",
                "мультипликаторы по шагам во времени против тригонометрической коллокации: расхождение",
            );
            self.audits.push(Audit::at_most("two_ways", name, off, TWO_WAYS));
        } else {
            self.notes.push(Text::new(
                "no second way to the multipliers: the coefficients switch, are tied by connections, or change too quickly for 128 instants of the period",
                "второго способа для мультипликаторов нет: коэффициенты переключаются, состояния связаны или 128 моментов периода слишком мало",
            ));
        }
        let own = self.exponents.iter().zip(&self.multipliers).filter(|(_, m)| !m.trivial);
        let growing = own.filter_map(|(s, _)| *s).reduce(|a, b| if b.growth > a.growth { b } else { a });
        if let (Verdict::Unstable, Some(growing)) = (self.verdict, growing) {
            self.resonance = floquet::resonance(self.period, rows, growing)?;
        }
        Ok(())
    }
}

/// Coefficients of q'' + 2h q' + k q = 0 with the mean of h, from ψ: what the second way and the names of resonances need.
fn sampled(point: &Point) -> Vec<Vec<f64>> {
    let Some(scalar) = &point.scalar else { return Vec::new() };
    let h = scalar.decay;
    let row = |k: usize| {
        let t = point.period * k as f64 / INSTANTS as f64;
        vec![0.0, 1.0, -(scalar.hill.value(t) + h * h), -2.0 * h]
    };
    (0..INSTANTS).map(row).collect()
}

/// The sum of the multipliers from steps of the variations against that of Hill's equation.
fn against_hill(scalar: &Scalar, multipliers: &[Multiplier]) -> Audit {
    let name = Text::new(
        "trace of the monodromy matrix: steps of the variations against Hill's equation",
        "след матрицы монодромии: решения в вариациях против уравнения Хилла",
    );
    let power = |[re, im]: [f64; 2]| {
        let (size, angle) = (algebra::elementary::hypot(re, im), algebra::elementary::atan2(im, re));
        let whole = algebra::elementary::powi(size, i32::try_from(scalar.parts).unwrap_or(1));
        whole * algebra::elementary::cos(scalar.parts as f64 * angle)
    };
    let hill: f64 = scalar.multipliers().map(power).iter().sum();
    let found: f64 = multipliers.iter().map(|m| m.re).sum();
    Audit::at_most("hill", name, (found - hill).abs() / hill.abs().max(1.0), TWO_WAYS)
}

/// Auxiliary states that nothing disturbs: functions of time alone.
fn clocks(machine: &Machine, rows: &[Vec<f64>]) -> Vec<usize> {
    let n = machine.system.states().len();
    let first = 2 * machine.equations.coordinates.len();
    let still = |i: &usize| rows.iter().all(|a| a[i * n..(i + 1) * n].iter().all(|v| *v == 0.0));
    if rows.is_empty() { Vec::new() } else { (first..n).filter(still).collect() }
}

/// The matrices without the rows and columns of some states.
fn without(rows: &[Vec<f64>], states: &[usize]) -> Vec<Vec<f64>> {
    let Some(first) = rows.first().filter(|_| !states.is_empty()) else { return rows.to_vec() };
    let n = (first.len() as f64).sqrt().round() as usize;
    let kept = |e: &usize| !states.contains(&(e / n)) && !states.contains(&(e % n));
    rows.iter().map(|a| (0..n * n).filter(kept).map(|e| a[e]).collect()).collect()
}

/// S141.
fn no_multipliers(note: Option<&Text>) -> Notice {
    let Some(note) = note else {
        return Notice::new(
            "S141",
            "nothing but the shift along this motion can be disturbed: it has no multipliers, and is stable",
            "возмутить можно лишь сдвиг вдоль этого движения: мультипликаторов у него нет, и оно устойчиво",
        )
        .why(
            "closed contacts and frictions that stick take every other direction away within a period",
            "замкнутые контакты и залипание за период убирают все остальные направления",
        );
    };
    let notice = Notice::new(
        "S141",
        "small disturbances of this motion have no multipliers",
        "у малых возмущений этого движения нет мультипликаторов",
    );
    notice.why(note.en.clone(), note.ru.clone()).help(
        "change a parameter a little, so that the motion does not touch the switch",
        "немного измените параметр, чтобы движение не касалось переключения",
    )
}

/// S142 for coefficients.
fn not_smooth() -> Notice {
    refused(
        (
            "its inertia is not positive everywhere, or its coefficients jump or have kinks within a turn",
            "приведённый момент инерции не везде положителен, либо коэффициенты за оборот имеют скачки или изломы",
        ),
        (
            "look at J and K over a turn (`strutt cycle`), or ask for the motion itself with `period`",
            "посмотрите J и K за оборот (`strutt cycle`) или исследуйте само движение, задав `period`",
        ),
    )
}

/// What a study asks for, at the machine as it is.
pub(super) fn at(
    machine: &mut Machine,
    study: &Stability,
    reduction: Option<&Reduction>,
    care: Care,
    watch: &mut Watch,
) -> Result<Point, Notice> {
    match (&study.about, reduction) {
        (About::Motion(motion), _) => of_motion(machine, motion, care, watch),
        (About::Running { angle, .. }, None) => of_running(&Reduction::of(machine, *angle)?, running(machine, study)?, care),
        (About::Running { .. }, Some(reduction)) => of_running(reduction, running(machine, study)?, care),
    }
}

/// Start and rate of the coordinate that runs.
pub(super) fn running(machine: &mut Machine, study: &Stability) -> Result<(f64, f64), Notice> {
    let start = machine.system.start().map_err(|fault| explained(fault, &machine.equations))?;
    let n = machine.equations.coordinates.len();
    let About::Running { speed, .. } = &study.about else { return Ok((0.0, 0.0)) };
    let own = start.get(n).copied().unwrap_or(0.0);
    match speed.unwrap_or(own) {
        0.0 => Err(refused(
            ("the coordinate does not run: its starting rate is 0", "координата не меняется: её начальная скорость равна 0"),
            ("add speed = \"250 rad/s\", or --speed", "добавьте speed = \"250 рад/с\" или --speed"),
        )),
        speed => Ok((start.first().copied().unwrap_or(0.0), speed)),
    }
}
