//! Stability along a parameter: verdicts, and the boundaries located.

use super::asked::{Range, Stability};
use super::boundaries::{Root, Side, Smooth, roots, settled};
use super::point::{self, Care, Point};
use super::reduction::{Reduction, reduced};
use super::show::Shown;
use super::single::of_scalar;
use crate::failure::in_words;
use crate::machine::Machine;
use crate::provenance;
use crate::results::{Body, Fact, Results, Rows};
use crate::watch::Watch;
use analysis::dataset::{Audit, Column};
use analysis::studies::stability::{Criterion, Verdict};
use analysis::{Dataset, Quantity};
use mechanics::model::Plot;
use serde_json::{Value, json};
use std::sync::Arc;
use words::{Notice, Text};

/// Values without a wish.
const VALUES: usize = 201;
/// Neighbouring values may differ by this much in √d: a tongue lies at each whole number.
const APART: f64 = 0.2;
/// Every so many values the motion itself is followed, with its checks, where the verdict could do without.
const CHECKED: usize = 16;
/// Halvings of an interval between values.
const DEPTH: usize = 12;

/// The machine with other values of the parameter.
struct Walk<'a> {
    study: &'a Stability,
    name: &'a str,
    /// As the file has it.
    written: Option<Stability>,
    machine: Machine,
    reduction: Option<Reduction>,
}

impl Walk<'_> {
    fn at(&mut self, value: f64, watch: &mut Watch) -> Result<Point, Notice> {
        self.with(value, Care::Verdict, watch)
    }

    fn with(&mut self, value: f64, care: Care, watch: &mut Watch) -> Result<Point, Notice> {
        let binding = self.machine.bind(&[(self.name, value)]).map_err(in_words)?;
        let study = self.study.reread([self.written.clone(), self.study.in_file(&self.machine)]);
        reduced(&mut self.reduction, &self.machine, (&study, binding))?;
        let mut inner = Watch { interrupt: watch.interrupt, ..Watch::default() };
        point::at(&mut self.machine, &study, self.reduction.as_ref(), care, &mut inner)
    }
}

/// Fills in the results.
pub(super) fn walk(
    machine: &mut Machine,
    (study, range): (&Stability, &Range),
    results: &mut Results,
    watch: &mut Watch,
) -> Result<(), Notice> {
    machine.number(&range.name)?;
    let mut walk = Walk { study, name: &range.name, written: study.in_file(machine), machine: machine.clone(), reduction: None };
    let found = sampled(&mut walk, range, study.points.unwrap_or(VALUES), watch)?;
    results.data = provenance::stamp(dataset(machine, range, &found), &machine.equations, &machine.model_hash);
    // the facts say what was found; files have the rows
    results.rows = Rows::Hidden;
    if watch.is_interrupted() {
        results.data.partial = true;
    }
    let boundaries = located(&mut walk, &found, watch)?;
    tell(machine, range, (&found, &boundaries), results);
    let reduction = walk.reduction.take();
    results.body = Body::After(Arc::new(Shown { reduction, scalar: None }));
    Ok(())
}

/// Points in ascending order of the parameter, closer where tongues are.
fn sampled(walk: &mut Walk<'_>, range: &Range, count: usize, watch: &mut Watch) -> Result<Vec<(f64, Point)>, Notice> {
    let mut found: Vec<(f64, Point)> = Vec::with_capacity(count);
    for k in 0..count {
        if watch.is_interrupted() {
            break;
        }
        if let Some(progress) = &mut watch.progress {
            progress(k as f64 / count as f64);
        }
        let value = range.from + (range.to - range.from) * k as f64 / (count - 1) as f64;
        let care = if k % CHECKED == 0 { Care::Checked } else { Care::Verdict };
        let next = (value, walk.with(value, care, watch)?);
        let mut between = match found.last() {
            Some(last) => refined(walk, (last, &next), watch)?,
            None => Vec::new(),
        };
        found.append(&mut between);
        found.push(next);
    }
    Ok(found)
}

/// Points between two whose √d differ too much.
fn refined(walk: &mut Walk<'_>, ends: (&(f64, Point), &(f64, Point)), watch: &mut Watch) -> Result<Vec<(f64, Point)>, Notice> {
    let Some(off) = root_of_d(&ends.0.1).zip(root_of_d(&ends.1.1)).map(|(a, b)| (a - b).abs()) else { return Ok(Vec::new()) };
    let parts = ((off / APART).ceil() as usize).clamp(1, 1 << DEPTH);
    let (a, b) = (ends.0.0, ends.1.0);
    let mut between = Vec::new();
    for k in 1..parts {
        let value = a + (b - a) * k as f64 / parts as f64;
        between.push((value, walk.at(value, watch)?));
    }
    Ok(between)
}

fn root_of_d(point: &Point) -> Option<f64> {
    point.scalar.as_ref().map(|scalar| scalar.d().max(0.0).sqrt())
}

/// A boundary of a verdict.
pub(super) struct Boundary {
    by: Option<Criterion>,
    root: Root,
}

/// Which quantity is a boundary where it changes its sign.
fn excess(point: &Point, by: Option<Criterion>) -> f64 {
    match (&point.scalar, by) {
        (Some(scalar), Some(by)) => scalar.excess(by),
        _ if point.verdict == Verdict::Unstable => 1.0,
        _ => -1.0,
    }
}

fn located(walk: &mut Walk<'_>, found: &[(f64, Point)], watch: &mut Watch) -> Result<Vec<Boundary>, Notice> {
    let scalar = found.iter().all(|(_, p)| p.scalar.is_some());
    let kinds: Vec<Option<Criterion>> =
        if scalar { [Criterion::Hill, Criterion::Mathieu, Criterion::Classical].map(Some).into() } else { vec![None] };
    let mut list = Vec::new();
    for by in kinds {
        let mut samples: Vec<(f64, f64)> = found.iter().map(|(value, p)| (*value, excess(p, by))).collect();
        settled(&mut samples, |k| by.is_none_or(|by| found[k].1.scalar.as_ref().is_some_and(|s| s.verdict(by) != Verdict::Limit)));
        let smooth = if by.is_some() { Smooth::Yes } else { Smooth::No };
        let at = |value: f64| walk.at(value, watch).map(|point| excess(&point, by));
        list.extend(roots(&samples, smooth, at)?.into_iter().map(|root| Boundary { by, root }));
    }
    Ok(list)
}

fn dataset(machine: &Machine, range: &Range, found: &[(f64, Point)]) -> Dataset {
    let declared = machine.model.parameters.iter().find(|p| p.name == range.name);
    let column = |name: &str, (symbol, unit): (&str, &str), label: Text, value: &dyn Fn(&(f64, Point)) -> f64| Column {
        quantity: Quantity { symbol: symbol.into(), label, ..Quantity::new(name, unit) },
        values: found.iter().map(value).collect(),
    };
    let unit = declared.map_or("1", |p| p.unit.as_str());
    let label = declared.map(|p| p.label.clone()).unwrap_or_default();
    let sign = |p: &(f64, Point)| match p.1.verdict {
        Verdict::Stable => 1.0,
        Verdict::Limit => 0.0,
        Verdict::Unstable => -1.0,
    };
    let words = Text::new("1 stable, −1 unstable, 0 limit", "1 — устойчиво, −1 — неустойчиво, 0 — граница");
    let mut columns = vec![column(&range.name, (&range.name, unit), label, &|p| p.0), column("stable", ("stable", "1"), words, &sign)];
    if found.iter().all(|(_, p)| p.growth.is_some()) {
        let label = Text::new("greatest growth of a disturbance", "наибольший показатель роста возмущений");
        columns.push(column("growth", ("σ", "1/s"), label, &|p| p.1.growth.unwrap_or(f64::NAN)));
    }
    if found.iter().all(|(_, p)| p.scalar.is_some()) {
        let of =
            |take: fn(&analysis::studies::stability::Scalar) -> f64| move |p: &(f64, Point)| p.1.scalar.as_ref().map_or(f64::NAN, take);
        columns.push(column("d", ("d", "1"), Text::default(), &of(|s| s.d())));
        columns.push(column("e", ("e", "1"), Text::default(), &of(|s| s.e())));
        let label = Text::new("trace, Hill's equation", "след, уравнение Хилла");
        columns.push(column("trace", ("tr M", "1"), label, &of(|s| s.trace())));
        let label = Text::new("trace, Mathieu's equation", "след, уравнение Матьё");
        columns.push(column("trace_of_mathieu", ("tr M_M", "1"), label, &of(|s| s.trace_of_mathieu())));
    }
    let mut audits: Vec<Audit> = Vec::new();
    for audit in found.iter().flat_map(|(_, p)| &p.audits) {
        match audits.iter_mut().find(|a| a.key == audit.key) {
            Some(worst) if worst.value >= audit.value => {}
            Some(worst) => *worst = audit.clone(),
            None => audits.push(audit.clone()),
        }
    }
    Dataset { axis: Some(0), columns, audits, ..Dataset::default() }
}

fn tell(machine: &Machine, range: &Range, (found, boundaries): (&[(f64, Point)], &[Boundary]), results: &mut Results) {
    let declared = machine.model.parameters.iter().find(|p| p.name == range.name);
    let unit = declared.map_or("1", |p| p.unit.as_str());
    let symbol = machine.model.notation.iter().find(|(n, _)| *n == range.name).map_or(range.name.as_str(), |(_, s)| s.as_str());
    for (k, boundary) in boundaries.iter().enumerate() {
        let fact = Fact::new(&format!("boundary_{}", k + 1), symbol, unit, boundary.root.at, boundary.label());
        results.facts.push(fact);
    }
    if boundaries.is_empty() {
        let verdict = found.first().map_or(Verdict::Limit, |(_, p)| p.verdict);
        let (en, ru) = ("the verdict is the same everywhere: ", "вердикт всюду один: ");
        let word = super::show::word(verdict);
        results.words.push(Text::new(
            format!("No boundary in this range; {en}{}.", word.en),
            format!("Границ в этом промежутке нет; {ru}{}.", word.ru),
        ));
    }
    if boundaries.iter().any(|b| b.by.is_none()) || found.iter().any(|(_, p)| p.scalar.is_none()) {
        results.words.push(Text::new(
            "Boundaries are sought between the values of the table: a region of instability that lies between two of them is not seen. Take more `points` where tongues are narrow.",
            "Границы ищутся между значениями таблицы: область неустойчивости, целиком лежащая между соседними значениями, не видна. Где области узкие, увеличьте `points`.",
        ));
    }
    let row = |(value, p): &(f64, Point)| {
        let mut row = crate::results::fields(json!({"value": value, "verdict": p.verdict.key(), "growth": p.growth}));
        row.extend(p.scalar.as_ref().map(of_scalar).unwrap_or_default());
        Value::Object(row)
    };
    results.own.insert("parameter".into(), json!({"name": range.name, "unit": unit, "from": range.from, "to": range.to}));
    results.own.insert("rows".into(), found.iter().map(row).collect());
    results.own.insert("boundaries".into(), boundaries.iter().map(Boundary::to_json).collect());
    let drawn = |name: &str| results.data.columns.iter().any(|c| c.quantity.name == name);
    let y: Vec<String> = ["trace", "trace_of_mathieu", "growth"].into_iter().filter(|n| drawn(n)).map(str::to_owned).collect();
    results.plots = match y.split_last() {
        Some((growth, [])) => vec![Plot { title: Text::default(), x: None, y: vec![growth.clone()] }],
        Some((growth, traces)) => [traces.to_vec(), vec![growth.clone()]].map(|y| Plot { title: Text::default(), x: None, y }).into(),
        None => Vec::new(),
    };
}

impl Boundary {
    fn label(&self) -> Text {
        let (en, ru) = match self.by {
            Some(Criterion::Hill) => ("Hill's equation", "уравнение Хилла"),
            Some(Criterion::Mathieu) => ("Mathieu's equation", "уравнение Матьё"),
            Some(Criterion::Classical) => ("classical criterion", "классический критерий"),
            None => ("multipliers", "мультипликаторы"),
        };
        match self.root.rises {
            Side::Rises => Text::new(format!("{en}: unstable above"), format!("{ru}: выше — неустойчиво")),
            Side::Falls => Text::new(format!("{en}: stable above"), format!("{ru}: выше — устойчиво")),
        }
    }

    fn to_json(&self) -> Value {
        let unstable = if self.root.rises == Side::Rises { "above" } else { "below" };
        json!({"value": self.root.at, "by": self.by.map_or("multipliers", Criterion::key), "unstable": unstable})
    }
}
