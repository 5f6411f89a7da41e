//! The right numbers of one machine: every answer from the studies of the file, in the unit of its question.

use crate::answers::meaning;
use crate::answers::wanted::Side;
use crate::answers::wanted::{Edge, Moment, Wanted};
use crate::failure::Failure;
use crate::machine::Machine;
use crate::observable::Observable;
use crate::results::Results;
use crate::transient::Transient;
use crate::watch::Watch;
use analysis::Dataset;
use mechanics::asked::{Asked, Value};
use mechanics::model::{AnswerDecl, AnswerValue, Values};
use mechanics::variants::{Given, Misfit, scale, symbols};
use words::Notice;

/// What a column may differ on both sides of an instant without a jump, relative.
const SAME: f64 = 1e-9;
/// A number below this share of the size of its quantity is rounding: zero.
const NOISE: f64 = 1e-11;

/// What studies gave, and what the questions make of it.
#[derive(Clone, Debug, Default)]
pub struct Solved {
    /// Results of the studies of the file, in its order.
    pub results: Vec<Results>,
    /// Right numbers, in the unit of the question.
    pub truths: Vec<Result<f64, Notice>>,
    /// Sizes of their quantities, in the same units: the largest value that the study shows of them; zero where it shows none.
    pub sizes: Vec<f64>,
    /// Numbers of n, N, parameters and answers.
    pub known: Values,
}

/// The right numbers. `given` names group, number and columns of the variant whose values the machine has.
pub fn solve(machine: &mut Machine, given: &Given, watch: &mut Watch) -> Solved {
    let results = studies(machine, watch);
    answers(machine, results, (given, &[]), watch)
}

/// The same with answers that are given already: formulas of later items use them.
pub fn answers(machine: &mut Machine, results: Vec<Results>, (given, own): (&Given, &[(usize, f64)]), watch: &mut Watch) -> Solved {
    let given = Given { values: Vec::new(), ..given.clone() };
    let known = symbols(&machine.model, machine.model.variants.as_ref(), &given);
    let mut finder = Finder { machine, results, known, watch };
    let (mut truths, mut sizes) = (Vec::new(), Vec::new());
    for (i, answer) in finder.machine.model.answers.clone().iter().enumerate() {
        let found = finder.number(answer);
        sizes.push(found.as_ref().map_or(0.0, |f| f[1]));
        let truth = found.map(|[value, size]| if value.abs() <= NOISE * size { 0.0 } else { value });
        let own = own.iter().find(|(k, _)| *k == i).map(|(_, value)| *value);
        // a student's own value is the machine's already
        if let (Some(name), None, Ok(value)) = (&answer.gives, own, &truth) {
            finder.carry(answer, name, value * answer.unit.factor);
        }
        let value = own.or_else(|| truth.as_ref().ok().copied());
        finder.known.insert(answer.symbol, value.map_or(f64::NAN, |v| v * answer.unit.factor));
        truths.push(truth);
    }
    Solved { results: finder.results, truths, sizes, known: finder.known }
}

/// Every study of the file.
pub fn studies(machine: &mut Machine, watch: &mut Watch) -> Vec<Results> {
    let all = machine.model.studies.clone();
    let mut found = Vec::new();
    for asked in &all {
        let mut inner = Watch { interrupt: watch.interrupt, ..Watch::default() };
        found.extend(machine.origin.studies.find(asked.kind).and_then(|study| study.run(machine, asked, &mut inner)));
    }
    found
}

/// Studies of a motion in time, in the order in which an answer looks for one.
fn motions() -> [&'static str; 2] {
    [crate::simulate::KIND.name, crate::transient::KIND.name]
}

struct Finder<'a, 'w> {
    machine: &'a mut Machine,
    results: Vec<Results>,
    known: Values,
    watch: &'a mut Watch<'w>,
}

/// Share by which a value that a study has found may differ from the file's own and be the same: what searches leave.
const FOUND: f64 = 1e-9;

impl Finder<'_, '_> {
    /// Computes what follows with the value that an answer gives to a parameter. Where it is none of the parameter, what follows is unknown.
    fn carry(&mut self, answer: &AnswerDecl, name: &str, value: f64) {
        let symbol = self.machine.model.parameters.iter().find(|p| p.name == name).map(|p| p.symbol);
        let number = self.machine.equations.parameters.iter().find(|p| Some(p.symbol) == symbol).map(|p| p.value);
        if number.is_some_and(|number| (number - value).abs() <= FOUND * value.abs()) {
            return;
        }
        match self.machine.given(&[(name, value)]) {
            Ok(()) => self.results = studies(self.machine, self.watch),
            Err(failure) => {
                let notice = reason(failure);
                let misfit = Misfit::new(notice.what.en.clone(), notice.what.ru.clone());
                let trouble = unknown(answer, misfit);
                self.results.iter_mut().for_each(|r| r.trouble = Some(trouble.clone()));
            }
        }
    }

    /// The number and the size of its quantity, in the unit of the question.
    fn number(&mut self, answer: &AnswerDecl) -> Result<[f64; 2], Notice> {
        let AnswerValue::Study { of, .. } = &answer.value else { return self.formula(answer).map(|value| [value, 0.0]) };
        let wanted = match meaning::wanted(&self.machine.model, answer) {
            Some(Ok(wanted)) => wanted,
            _ => return Err(nothing(answer)),
        };
        let (value, unit) = match &wanted {
            Wanted::Number(number) => self.of_studies(answer, number, of.as_deref())?,
            Wanted::Instant(moment) => (self.instant(answer, moment, of.as_deref())?, "s".to_owned()),
            Wanted::At(column, moment, edge) => self.at(answer, (column, moment, *edge), of.as_deref())?,
        };
        if !value.is_finite() {
            return Err(unknown(answer, Misfit::new("the study gives no number here", "расчёт не даёт здесь числа")));
        }
        let factor = scale(&unit, &answer.unit).map_err(|misfit| unknown(answer, misfit))?;
        Ok([value / factor, self.size(&wanted, of.as_deref()) / factor.abs()])
    }

    /// The largest magnitude that the studies show of what is asked for, SI.
    fn size(&self, wanted: &Wanted, of: Option<&str>) -> f64 {
        let results = || self.results.iter().filter(move |r| of.is_none_or(|of| r.kind == of));
        let greatest = |values: &mut dyn Iterator<Item = f64>| values.filter(|v| v.is_finite()).map(f64::abs).fold(0.0, f64::max);
        let column = match wanted {
            Wanted::Instant(_) => Some("t"),
            Wanted::At(column, ..) => Some(column.as_str()),
            Wanted::Number(number) => number.column(),
        };
        if let Some(column) = column {
            let extremes = |r: &Results| r.data.extreme(column).map(|e| [e.min, e.max]);
            let values = |r: &Results| r.data.column(column).map(|c| c.values.clone()).unwrap_or_default();
            return greatest(&mut results().flat_map(|r| values(r).into_iter().chain(extremes(r).into_iter().flatten())));
        }
        let Wanted::Number(number) = wanted else { return 0.0 };
        // a number of a study is measured by the others of its kind: reactions by reactions
        let path = number.word();
        let sizes = results().map(|r| {
            let inside = path.strip_prefix(r.kind).and_then(|rest| rest.strip_prefix('.'));
            [Some(path), inside].into_iter().flatten().map(|p| super::resting::size(r, p)).fold(0.0, f64::max)
        });
        sizes.fold(0.0, f64::max)
    }

    fn formula(&mut self, answer: &AnswerDecl) -> Result<f64, Notice> {
        let AnswerValue::Formula { value, factor } = answer.value else { return Err(nothing(answer)) };
        let known = &self.known;
        let found = self.machine.model.graph.evaluate(&[value], &|s| known.get(&s).copied().unwrap_or(f64::NAN))[0] / factor;
        let misfit = || Misfit::new("the formula has no finite value here", "формула не имеет здесь конечного значения");
        if found.is_finite() { Ok(found) } else { Err(unknown(answer, misfit())) }
    }

    /// A number of the first study that has it; one that the file does not ask for is made where it needs no keys.
    fn of_studies(&mut self, answer: &AnswerDecl, number: &Observable, of: Option<&str>) -> Result<(f64, String), Notice> {
        if let Some(found) = self.among(number, of) {
            return found;
        }
        let kind = of.or_else(|| number.word().split('.').next()).and_then(|kind| self.machine.origin.studies.find(kind)).map(|s| s.kind());
        let absent = |kind: &&mechanics::asked::Kind| self.results.iter().all(|r| r.kind != kind.name);
        if let Some(kind) = kind.filter(absent).filter(|kind| kind.keys.iter().all(|k| !k.required)) {
            self.results
                .extend(self.machine.origin.studies.find(kind.name).and_then(|s| s.run(self.machine, &Asked::new(kind.name), self.watch)));
            if let Some(found) = self.among(number, of) {
                return found;
            }
        }
        Err(nothing(answer))
    }

    fn among(&self, number: &Observable, of: Option<&str>) -> Option<Result<(f64, String), Notice>> {
        let mut trouble = None;
        let stripped = number.root().and_then(|path| path.split_once('.'));
        for results in fitting(&self.results, number).into_iter().filter(|r| of.is_none_or(|of| r.kind == of)) {
            let inside = stripped.filter(|(kind, _)| *kind == results.kind).map(|(_, rest)| Observable::field(rest));
            for wanted in [Some(number.clone()), inside].into_iter().flatten() {
                if let Some(unit) = unit(results, &wanted, &self.machine.model)
                    && let Ok(value) = wanted.of(results)
                {
                    return Some(Ok((value, unit)));
                }
            }
            // a study that ended early has none of its numbers
            trouble =
                trouble.or(results.trouble.clone().filter(|_| of.is_some() || stripped.is_some_and(|(kind, _)| kind == results.kind)));
        }
        let first = || self.results.iter().find_map(|r| r.trouble.clone()).filter(|_| of.is_none());
        trouble.or_else(first).map(Err)
    }

    /// The motion that is meant, with its place among the results.
    fn motion(&self, answer: &AnswerDecl, of: Option<&str>) -> Result<&Results, Notice> {
        let of_kind = |kind: &str| self.results.iter().find(|r| r.kind == kind);
        let any = || motions().into_iter().find_map(of_kind);
        let found = of
            .map_or_else(any, of_kind)
            .ok_or_else(|| unknown(answer, Misfit::new("the file has no study `simulate`", "в файле нет расчёта `simulate`")))?;
        found.trouble.clone().map_or(Ok(found), Err)
    }

    fn instant(&self, answer: &AnswerDecl, moment: &Moment, of: Option<&str>) -> Result<f64, Notice> {
        let data = &self.motion(answer, of)?.data;
        match moment {
            Moment::Time(t) => Ok(*t),
            Moment::Extreme(side, name) => match (data.extreme(name), side) {
                (Some(e), Side::Greatest) => Ok(e.t_max),
                (Some(e), Side::Least) => Ok(e.t_min),
                (None, _) => Err(unknown(answer, rows_only(name))),
            },
            Moment::Event(name, number) => {
                let mut events = data.events.iter().filter(|e| name.as_ref().is_none_or(|n| *n == e.name));
                let count = events.clone().count();
                events.nth(number - 1).map(|e| e.t).ok_or_else(|| {
                    unknown(
                        answer,
                        Misfit::new(format!("the motion has {count} such events"), format!("таких событий в движении: {count}")),
                    )
                })
            }
        }
    }

    fn at(
        &mut self,
        answer: &AnswerDecl,
        (column, moment, edge): (&str, &Moment, Edge),
        of: Option<&str>,
    ) -> Result<(f64, String), Notice> {
        let t = self.instant(answer, moment, of)?;
        let data = &self.motion(answer, of)?.data;
        let unit = data.column(column).map(|c| c.quantity.unit.clone()).ok_or_else(|| unknown(answer, rows_only(column)))?;
        if let Some(sides) = sides(data, column, t) {
            let value = match edge {
                Edge::Before => sides[0],
                Edge::After => sides[1],
                Edge::Either if (sides[0] - sides[1]).abs() <= SAME * sides[0].abs().max(sides[1].abs()) => sides[1],
                Edge::Either => return Err(unknown(answer, jumps(column))),
            };
            return Ok((value, unit));
        }
        let kind = self.motion(answer, of)?.kind;
        let value = self.value_at(kind, column, t).ok_or_else(|| unknown(answer, rows_only(column)))?;
        Ok((value, unit))
    }

    /// The motion of this study once more, with a row at the instant.
    fn value_at(&mut self, kind: &str, column: &str, t: f64) -> Option<f64> {
        let asked = self.machine.model.studies.iter().find(|s| s.kind == kind)?.clone();
        if asked.number("until").is_some_and(|until| t > until) {
            return None;
        }
        let mut asked = asked.with("at", Value::Numbers(vec![t])).with("outputs", Value::Words(vec![column.to_owned()]));
        ["every", "plot"].into_iter().for_each(|key| asked.unset(key));
        let study = crate::simulate::Simulate::of(&asked);
        let mut watch = Watch { interrupt: self.watch.interrupt, ..Watch::default() };
        let results = match kind == crate::transient::KIND.name {
            true => crate::transient::closed_form(self.machine, &Transient::of(&asked), &mut watch),
            false => crate::simulate::motion(self.machine, &study, &mut watch),
        };
        let axis = &results.data.columns.get(results.data.axis?)?.values;
        let row = axis.iter().rposition(|x| *x == t)?;
        results.data.column(column)?.values.get(row).copied()
    }
}

/// Results that a number may come from, in their order: a greatest, least, mean or last value is one of a motion, or where there is none of rows along
/// another axis, never of places of rest.
fn fitting<'r>(results: &'r [Results], number: &Observable) -> Vec<&'r Results> {
    if number.column().is_none() {
        return results.iter().collect();
    }
    let axis = |r: &&Results| r.data.axis.and_then(|i| r.data.columns.get(i)).map(|c| c.quantity.name.clone());
    let (moving, rows): (Vec<&Results>, Vec<&Results>) =
        results.iter().filter(|r| axis(r).is_some() || r.trouble.is_some()).partition(|r| axis(r).is_none_or(|name| name == "t"));
    moving.into_iter().chain(rows).collect()
}

/// A column just before and just after an event at this instant.
fn sides(data: &Dataset, column: &str, t: f64) -> Option<[f64; 2]> {
    let event = data.events.iter().find(|e| (e.t - t).abs() <= SAME * t.abs().max(f64::MIN_POSITIVE))?;
    let i = data.columns.iter().position(|c| c.quantity.name == column)?;
    let at = if data.axis.is_some_and(|axis| axis < i) { i - 1 } else { i };
    Some([*event.outputs[0].get(at)?, *event.outputs[1].get(at)?])
}

/// The SI unit of a number of a study.
fn unit(results: &Results, wanted: &Observable, model: &mechanics::Model) -> Option<String> {
    if let Some(column) = wanted.column() {
        return results.data.column(column).map(|c| c.quantity.unit.clone());
    }
    let Observable::Field(field) = wanted else { return Some("1".to_owned()) };
    let fact = field.fact(results).map(|fact| fact.quantity.unit.clone());
    let path = wanted.word();
    let beside = || {
        let (place, "value") = path.rsplit_once('.')? else { return None };
        let object = place.split('.').try_fold(None, |at: Option<&serde_json::Value>, step| {
            let next = match at {
                None => results.own.get(step),
                Some(at) => at.get(step).or_else(|| at.get(step.parse::<usize>().ok()?)),
            };
            next.map(Some)
        })??;
        object.get("unit")?.as_str().map(str::to_owned)
    };
    // `outputs.x.amplitude` is in the unit of x
    let of_output = || {
        let mut steps = path.rsplit('.');
        let (_, name) = (steps.next()?, steps.next()?);
        if steps.next()? == "outputs" { meaning::of_column(model, name).map(str::to_owned) } else { None }
    };
    // a named displacement of a frame or truss is a length or an angle
    let displacement = |name: &str| {
        let named = model.structure.as_ref()?.displacements.iter().find(|d| d.name == name)?;
        let turns = matches!(named.direction, mechanics::structure::Direction::Turn);
        Some(if turns { "rad" } else { "m" }.to_owned())
    };
    let resting = || super::resting::unit(results, path, &displacement);
    fact.or_else(beside).or_else(resting).or_else(|| meaning::by_name(path).map(str::to_owned)).or_else(of_output)
}

fn rows_only(column: &str) -> Misfit {
    Misfit::new(format!("the motion has no column `{column}`"), format!("в расчёте движения нет столбца `{column}`"))
        .help("name it in `outputs` of the study", "назовите его в `outputs` расчёта")
}

fn jumps(column: &str) -> Misfit {
    Misfit::new(format!("`{column}` jumps at this instant"), format!("`{column}` в этот момент меняется скачком"))
        .help("write at = \"before ...\" or \"after ...\"", "напишите at = \"before ...\" или \"after ...\"")
}

fn nothing(answer: &AnswerDecl) -> Notice {
    let text = if let AnswerValue::Study { text, .. } = &answer.value { text.as_str() } else { "" };
    let misfit = Misfit::new(
        format!("no study has a number `{text}` whose unit is known"),
        format!("ни в одном расчёте нет числа `{text}` с известной единицей"),
    );
    unknown(answer, misfit)
}

/// The first error of a failure.
pub fn reason(failure: Failure) -> Notice {
    match failure {
        Failure::Findings { diagnostics, .. } => {
            let error = diagnostics.iter().find(|d| d.severity == words::Severity::Error);
            error.or(diagnostics.first()).cloned().unwrap_or_else(|| Notice::new("C022", "not a model", "модель неверна"))
        }
        Failure::Trouble(notice) | Failure::Misuse(notice) => *notice,
        _ => Notice::new("C022", "not a model", "модель неверна"),
    }
}

/// C067: an answer has no number.
fn unknown(answer: &AnswerDecl, misfit: Misfit) -> Notice {
    let id = &answer.id;
    let mut notice = Notice::new("C067", format!("answer `{id}`: {}", misfit.what.en), format!("ответ `{id}`: {}", misfit.what.ru));
    notice.help = misfit.help;
    notice
}
