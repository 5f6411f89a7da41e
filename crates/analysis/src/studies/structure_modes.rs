//! Natural oscillations of a frame: K x = ω² M x over the coordinates of the structure.
//!
//! Small structures are reduced by static condensation ([`structures::reduced`]) and solved densely; with rational data the frequency
//! equation det(I - λ D M) = 0, λ = ω², has exact coefficients. Large ones are solved sparse for the lowest modes.

use algebra::certify::Certificate;
use algebra::eigen;

use crate::audits::certified;
use crate::dataset::{Audit, Column, Counter, Dataset};
use crate::{Fault, Quantity};
use structures::equilibrium::{EXACT, SEARCHED, standing, stands_undivided};
use structures::lowest::{lowest_dense, lowest_sparse};
use structures::reduced::{Condensation, Reduced, quantity, reduce};
use structures::{Assembly, Frame, RodKind, continuum, dense, faults};
use symbolic::Rational;
use words::Text;

/// Largest number of degrees of freedom whose frequency equation is written out.
const EQUATION: usize = 8;

/// How shapes are scaled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Normalise {
    /// The first coordinate that moves is 1.
    #[default]
    First,
    /// The largest coordinate is 1.
    Largest,
    /// xᵀ M x = 1.
    Mass,
}

/// Options of the study.
#[derive(Clone, Debug)]
pub struct Modes {
    /// Largest number of modes.
    pub count: usize,
    /// Scaling of shapes.
    pub normalise: Normalise,
    /// What follows statically.
    pub condensation: Condensation,
    /// Whether the exact frequencies of the distributed mass stand beside.
    pub continuum: bool,
    /// Wanted relative accuracy of the frequencies against finer division; none for the divisions of the file.
    pub accuracy: Option<f64>,
}

impl Default for Modes {
    fn default() -> Modes {
        Modes { count: 10, normalise: Normalise::First, condensation: Condensation::Automatic, continuum: false, accuracy: None }
    }
}

/// A natural oscillation.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// Angular frequency, rad/s.
    pub omega: f64,
    /// Over the shown coordinates.
    pub shape: Vec<f64>,
    /// Displacements of all freedoms of the assembly, in the scale of `shape`.
    pub freedoms: Vec<f64>,
    /// Bound of the relative error of ω² by the residual.
    pub residual: f64,
    /// Number of modes below it by Sturm's count; none when no count was certain.
    pub below: Option<usize>,
}

/// What the study finds.
#[derive(Clone, Debug)]
pub struct StructureModes {
    /// A row per mode.
    pub dataset: Dataset,
    /// The modes, rising.
    pub modes: Vec<Mode>,
    /// What shapes are made of.
    pub coordinates: Vec<Quantity>,
    /// Matrices of small structures.
    pub reduced: Option<Reduced<f64>>,
    /// The same, exact, when all data are rational.
    pub exact: Option<Reduced<Rational>>,
    /// Coefficients of the frequency equation by rising powers of λ = ω², exact.
    pub equation: Option<Vec<Rational>>,
    /// Exact frequencies of the distributed mass, when asked for.
    pub continuum: Option<Vec<f64>>,
    /// The frame that was computed (divided as far as the accuracy needed) and its freedoms, for drawings.
    pub frame: Frame<f64>,
    /// Its assembly.
    pub assembly: Assembly<f64>,
}

/// Natural oscillations; `exact` is the same frame in exact numbers when it has them.
///
/// *Errors*: mechanisms, loose nodes, no inertia.
pub fn modes(frame: &Frame<f64>, exact: Option<&Frame<Rational>>, options: &Modes) -> Result<StructureModes, Fault> {
    stands_undivided(frame, exact)?;
    let mut found = match options.accuracy {
        Some(wanted) => refined(frame, options, wanted)?,
        None => {
            let mut found = plain(frame, exact, options)?;
            found.dataset.notes.extend(coarse(frame, options, &found.modes));
            found
        }
    };
    finite(&found)?;
    if options.continuum {
        beside(&mut found);
    }
    Ok(found)
}

/// The modes of the frame as it is, without further words; none when they fail.
pub fn modes_alone(frame: &Frame<f64>, options: &Modes) -> Option<Vec<Mode>> {
    plain(frame, None, options).ok().map(|found| found.modes)
}

/// Overflow is no frequency.
fn finite(found: &StructureModes) -> Result<(), Fault> {
    let good = |m: &Mode| m.omega.is_finite() && m.omega > 0.0 && m.freedoms.iter().all(|v| v.is_finite());
    if found.modes.iter().all(good) { Ok(()) } else { Err(faults::extreme(&found.frame).into()) }
}

/// Share by which a frequency may differ from that of a finer division without a remark.
const COARSE: f64 = 0.05;
/// Largest number of freedoms of a frame that is computed once more with a finer division.
const COMPARED: usize = 20_000;

/// What a division of all rods into twice as many parts says about the modes, when some are off: rods with mass take the static shape that
/// their ends give them, which is wrong where the wave is not long beside a part.
pub fn coarse(frame: &Frame<f64>, options: &Modes, modes: &[Mode]) -> Option<Text> {
    let bends = |r: &structures::Rod<f64>| matches!(r.kind, RodKind::Beam { .. }) && r.mass > 0.0;
    let parts: usize = frame.rods.iter().map(|r| 6 * r.divisions).sum();
    if !frame.rods.iter().any(bends) || parts > COMPARED {
        return None;
    }
    let mut finer = frame.clone();
    finer.rods.iter_mut().filter(|r| matches!(r.kind, RodKind::Beam { .. })).for_each(|r| r.divisions *= 2);
    let options = Modes { condensation: Condensation::Massless, count: modes.len(), ..options.clone() };
    let better = plain(&finer, None, &options).ok()?;
    let off = |(i, (m, b)): (usize, (&Mode, &Mode))| {
        let share = m.omega / b.omega - 1.0;
        (share.abs() > COARSE).then(|| (i + 1, 100.0 * share))
    };
    let list: Vec<(usize, f64)> = modes.iter().zip(&better.modes).enumerate().filter_map(off).collect();
    if list.is_empty() {
        return None;
    }
    let said = |of: &str| list.iter().map(|(i, share)| format!("{i} ({share:+.0} %)")).collect::<Vec<_>>().join(of);
    Some(Text::new(
        format!(
            "warning: coarse model: with rods in twice as many parts the frequencies of these modes differ: {}; give [structure] an `accuracy` or the rods more `divisions`",
            said(", ")
        ),
        format!(
            "внимание: грубая модель: при вдвое большем числе частей стержней частоты этих форм другие: {}; задайте `accuracy` в [structure] или большее `divisions` стержням",
            said(", ")
        ),
    ))
}

/// The exact frequencies of the distributed mass as a column, and how far the modes are from them.
fn beside(found: &mut StructureModes) {
    let estimates: Vec<f64> = found.modes.iter().map(|m| m.omega).collect();
    let data = &mut found.dataset;
    let Some(exact) = continuum::frequencies(&found.frame, &estimates) else {
        data.notes.push(Text::new(
            "no closed form for the distributed mass of this structure (turning of sections, bars with mass, or too many nodes)",
            "для распределённой массы этой конструкции нет замкнутого решения (поворот сечений, массивные стержни ферм или слишком много узлов)",
        ));
        return;
    };
    let quantity =
        |name: &str, symbol: &str, unit: &str, label: Text| Quantity { label, symbol: symbol.into(), ..Quantity::new(name, unit) };
    let label = Text::new("of the exact continuum", "точное значение для распределённой массы");
    let error = exact.iter().zip(&estimates).map(|(e, w)| w / e - 1.0).collect();
    let at = data.columns.iter().position(|c| c.quantity.name == "damping_ratio").map_or(0, |i| i + 1);
    let column = |quantity, values| Column { quantity, values };
    data.columns.insert(at, column(quantity("omega_exact", "omega_e", "rad/s", label), exact.clone()));
    let label = Text::new("relative error against the continuum", "относительная погрешность");
    data.columns.insert(at + 1, column(quantity("error", "Δ", "1", label), error));
    found.continuum = Some(exact);
}

fn plain(frame: &Frame<f64>, exact: Option<&Frame<Rational>>, options: &Modes) -> Result<StructureModes, Fault> {
    let assembly = Assembly::of(frame);
    if assembly.n() == 0 {
        return Err(faults::massless().into());
    }
    if assembly.n() > SEARCHED && options.condensation != Condensation::Turns {
        return large(frame, assembly, options);
    }
    // soft springs lie below the last digit of stiff rods
    let fine = frame.doubled();
    let double = reduce(&fine, &Assembly::of(&fine), options.condensation)?;
    let n = double.n();
    let (found, certificate) = lowest_dense(&double.stiffness, &double.mass, n, options.count)?;
    let reduced = double.rounded();
    let expand = |x: &[f64]| assembly.elimination.expand(&dense::product(&reduced.basis, x, reduced.n_q, n, 1));
    let shown = Shown::of(frame, &assembly, reduced.named.then_some(&reduced));
    let modes = shown.modes(&found, &certificate, &expand, options.normalise);
    let exact = exact.filter(|_| n <= EQUATION && assembly.n() <= EXACT);
    let exact = exact.and_then(|f| reduce(f, &Assembly::of(f), options.condensation).ok());
    let equation = exact.as_ref().map(|r| frequency_equation(r, n));
    let coordinates = shown.coordinates(&reduced.coordinates);
    let orthogonality = orthogonality(&found, &reduced.mass, n);
    let mut dataset = dataset(&modes, &coordinates, orthogonality, assembly.n());
    dataset.audits.extend(certified::audits(&certificate));
    Ok(StructureModes {
        dataset,
        modes,
        coordinates,
        reduced: Some(reduced),
        exact,
        equation,
        continuum: None,
        frame: frame.clone(),
        assembly,
    })
}

/// det(I - λ D M) without vanishing powers at its end.
fn frequency_equation(reduced: &Reduced<Rational>, n: usize) -> Vec<Rational> {
    let dm = dense::product(&reduced.flexibility, &reduced.mass, n, n, n);
    let mut coefficients = dense::characteristic(&dm, n);
    while coefficients.last().is_some_and(Rational::is_zero) {
        coefficients.pop();
    }
    coefficients
}

fn large(frame: &Frame<f64>, assembly: Assembly<f64>, options: &Modes) -> Result<StructureModes, Fault> {
    let m = assembly.mass(frame);
    if m.entries.iter().all(|e| e.2 == 0.0) {
        return Err(faults::massless().into());
    }
    let fine = frame.doubled();
    let double = Assembly::of(&fine);
    let (found, certificate) = lowest_sparse(&double.stiffness(&fine), &double.mass(&fine), options.count)?;
    let n = assembly.n();
    let shown = Shown::of(frame, &assembly, None);
    let expand = |x: &[f64]| assembly.elimination.expand(x);
    let modes = shown.modes(&found, &certificate, &expand, options.normalise);
    let coordinates = shown.coordinates(&[]);
    let worst = (0..found.values.len())
        .flat_map(|i| (0..i).map(move |j| (i, j)))
        .map(|(i, j)| m.apply(found.shape(i)).iter().zip(found.shape(j)).map(|(a, b)| a * b).sum::<f64>().abs())
        .fold(0.0, f64::max);
    let mut dataset = dataset(&modes, &coordinates, worst, n);
    dataset.audits.extend(certified::audits(&certificate));
    if options.condensation == Condensation::Automatic && frame.rods.iter().all(|r| r.divisions == 1) {
        dataset.notes.push(Text::new(
            format!("more than {SEARCHED} independent displacements: turns of nodes keep their inertia (condense = false)"),
            format!("более {SEARCHED} независимых перемещений: повороты узлов сохраняют инерцию (condense = false)"),
        ));
    }
    Ok(StructureModes {
        dataset,
        modes,
        coordinates,
        reduced: None,
        exact: None,
        equation: None,
        continuum: None,
        frame: frame.clone(),
        assembly,
    })
}

/// Largest x_iᵀ M x_j of different modes with x_iᵀ M x_i = 1.
fn orthogonality(found: &eigen::Modes, mass: &[f64], n: usize) -> f64 {
    let products = (0..found.values.len()).map(|i| dense::product(mass, found.shape(i), n, n, 1)).collect::<Vec<_>>();
    let mut worst = 0.0_f64;
    for (i, product) in products.iter().enumerate() {
        for j in 0..i {
            worst = worst.max(product.iter().zip(found.shape(j)).map(|(a, b)| a * b).sum::<f64>().abs());
        }
    }
    worst
}

/// What shapes are shown over: the named displacements when there are any, else the coordinates.
struct Shown {
    functionals: Vec<Vec<f64>>,
    quantities: Vec<Quantity>,
    direct: bool,
}

impl Shown {
    fn of(frame: &Frame<f64>, assembly: &Assembly<f64>, named: Option<&Reduced<f64>>) -> Shown {
        let rows = frame.displacements.iter().map(|d| assembly.functional(frame, &d.place, &d.component));
        let dense_row = |row: Vec<(usize, f64)>| {
            let mut out = vec![0.0; assembly.freedoms.meaning.len()];
            row.into_iter().for_each(|(i, c)| out[i] += c);
            out
        };
        let quantities = frame.displacements.iter().map(quantity).collect();
        let direct = named.is_some() || frame.displacements.is_empty();
        Shown { functionals: if direct { Vec::new() } else { rows.map(dense_row).collect() }, quantities, direct }
    }

    fn coordinates(&self, own: &[Quantity]) -> Vec<Quantity> {
        if self.direct { own.to_vec() } else { self.quantities.clone() }
    }

    fn modes(
        &self,
        found: &eigen::Modes,
        certificate: &Certificate,
        expand: &dyn Fn(&[f64]) -> Vec<f64>,
        normalise: Normalise,
    ) -> Vec<Mode> {
        let one = |j: usize| {
            let x = found.shape(j);
            let mut freedoms = expand(x);
            let mut shape: Vec<f64> = match self.direct {
                true => x.to_vec(),
                false => self.functionals.iter().map(|f| f.iter().zip(&freedoms).map(|(a, b)| a * b).sum()).collect(),
            };
            let divisor = scale(&shape, &freedoms, normalise);
            shape.iter_mut().chain(&mut freedoms).for_each(|v| *v /= divisor);
            let (residual, below) = (certificate.residuals[j], certificate.below(j));
            Mode { omega: found.values[j].max(0.0).sqrt(), shape, freedoms, residual, below }
        };
        (0..found.values.len()).map(one).collect()
    }
}

/// What a shape is divided by.
fn scale(shape: &[f64], freedoms: &[f64], normalise: Normalise) -> f64 {
    let largest = |v: &[f64]| v.iter().copied().fold(0.0_f64, |m, x| if x.abs() > m.abs() { x } else { m });
    let top = largest(shape);
    let everything = largest(freedoms);
    // what is named may rest in this mode
    let quiet = top.abs() <= 1e-9 * everything.abs();
    match normalise {
        Normalise::Mass => 1.0,
        _ if everything == 0.0 => 1.0,
        _ if quiet => everything,
        Normalise::Largest => top,
        // an entry of rounding normalises nothing
        Normalise::First => shape.iter().copied().find(|v| v.abs() > 1e-9 * top.abs()).unwrap_or(top),
    }
}

/// The same frequencies with finer and finer division until what is left of their error is less than wanted.
fn refined(frame: &Frame<f64>, options: &Modes, wanted: f64) -> Result<StructureModes, Fault> {
    let longest = frame.rods.iter().map(|r| r.divisions).max().unwrap_or(1).max(2);
    let mut divisions = longest;
    let mut last = plain(&frame.divided(divisions), None, options)?;
    let mut before: Vec<f64> = Vec::new();
    loop {
        divisions *= 2;
        let next = plain(&frame.divided(divisions), None, options)?;
        // a coarse division may have fewer modes than are wanted
        let all = last.modes.len() == next.modes.len();
        let changes: Vec<f64> = last.modes.iter().zip(&next.modes).map(|(a, b)| (a.omega / b.omega - 1.0).abs()).collect();
        let errors = changes.iter().enumerate().map(|(i, c)| left(*c, before.get(i).copied()));
        let error = errors.fold(if all { 0.0 } else { 1.0 }, f64::max);
        (last, before) = (next, changes);
        if error <= wanted || divisions >= FINEST {
            let name =
                Text::new("error of frequencies by halving the parts of rods", "погрешность частот по удвоению числа частей стержней");
            last.dataset.audits.push(Audit::at_most("refinement", name, error, wanted));
            last.dataset.notes.push(Text::new(
                format!("each elastic rod in {divisions} parts"),
                format!("каждый упругий стержень разделён на частей: {divisions}"),
            ));
            return Ok(last);
        }
    }
}

/// Parts of a rod at most.
const FINEST: usize = 256;

/// The error that is left after a change by halving the parts, of which the halving before made `before`. What is left is a + b, the part of rods that stretch,
/// which falls to a fourth, and that of rods that bend, which falls to a sixteenth: the changes are 3 a + 15 b and before 12 a + 240 b.
fn left(change: f64, before: Option<f64>) -> f64 {
    let stretched = change / 3.0;
    let Some(before) = before.filter(|b| *b > 4.0 * change) else { return stretched };
    if before >= 16.0 * change {
        return change / 15.0;
    }
    (16.0 * change - before) / 36.0 + (before - 4.0 * change) / 180.0
}

fn dataset(modes: &[Mode], coordinates: &[Quantity], orthogonality: f64, n: usize) -> Dataset {
    let labelled = |name: &str, symbol: &str, unit: &str, en: &str, ru: &str| Quantity {
        label: Text::new(en, ru),
        symbol: symbol.into(),
        ..Quantity::new(name, unit)
    };
    let column = |quantity: Quantity, value: &dyn Fn(&Mode) -> f64| Column { quantity, values: modes.iter().map(value).collect() };
    let tau = 2.0 * std::f64::consts::PI;
    let mut columns = vec![
        column(labelled("omega", "omega", "rad/s", "angular frequency", "круговая частота"), &|m| m.omega),
        column(labelled("f", "f", "Hz", "frequency", "частота"), &|m| m.omega / tau),
        column(labelled("T", "T", "s", "period", "период"), &|m| tau / m.omega),
        column(labelled("damping_ratio", "zeta", "1", "damping ratio", "относительное затухание"), &|_| 0.0),
    ];
    for (i, quantity) in coordinates.iter().enumerate() {
        columns.push(column(quantity.clone(), &|m| m.shape[i]));
    }
    let name = Text::new("orthogonality of the shapes", "ортогональность форм");
    // shapes of close frequencies lose half the digits
    let audits = vec![Audit::at_most("orthogonality", name, orthogonality, 1e-8)];
    let counters =
        vec![Counter {
            key: "freedoms", name: Text::new("independent displacements", "независимых перемещений"), value: n as f64
        }];
    Dataset { columns, audits, counters, ..Dataset::default() }
}

/// Degree of statical indeterminacy and free motions, for reports.
///
/// *Errors*: those of the equations of equilibrium.
pub fn degree(frame: &Frame<f64>) -> Result<usize, Fault> {
    let simple = frame.divided(1);
    Ok(standing(&simple, &Assembly::of(&simple))?.degree())
}
