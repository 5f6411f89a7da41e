//! What was handed in against the right numbers: a verdict for each item, what a wrong one looks like, and whether later items follow from it.

use super::cell::Written;
use super::course::{Class, Member};
use super::diagnose::{Around, Likeness, Other, likeness};
use super::guards::within;
use super::solve;
use crate::answers::meaning;
use crate::answers::wanted::Wanted;
use crate::results::Results;
use crate::watch::Watch;
use mechanics::asked::Asked;
use mechanics::model::{AnswerDecl, AnswerValue, Class as Dependence};
use mechanics::units::{Dimension, parse_unit};
use words::{Language, Text};

/// Most that rounding may take from an answer: what two digits say.
const COARSE: f64 = 0.05;

/// What is thought of an answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// Within the tolerance.
    Right,
    /// The right number, rounded to fewer digits than the tolerance asks for.
    Rounded,
    /// Right with the student's own earlier value.
    Follows,
    /// The right number in another unit, or a unit of another dimension.
    Unit,
    /// Off by this share; infinite where zero is right.
    Wrong(f64),
    /// No answer.
    Missing,
    /// No number.
    Unreadable,
    /// There is no right number to compare with.
    Unknown,
}

/// One item of a student.
#[derive(Clone, Debug, PartialEq)]
pub struct Graded {
    /// As handed in.
    pub given: String,
    /// What is thought of it.
    pub verdict: Verdict,
    /// What a wrong number looks like.
    pub likeness: Option<Likeness>,
}

impl Verdict {
    /// Whether it counts as right.
    pub fn counts(&self) -> bool {
        matches!(self, Verdict::Right | Verdict::Rounded | Verdict::Follows)
    }

    /// A mark for tables.
    pub fn mark(&self, language: Language) -> String {
        match self {
            Verdict::Right => "✓".into(),
            Verdict::Rounded => "✓ ≈".into(),
            Verdict::Follows => "✓ →".into(),
            Verdict::Unit => language.pick("unit", "ед.").into(),
            Verdict::Wrong(share) if share.is_infinite() => "✗ ≠ 0".into(),
            Verdict::Wrong(share) => format!("✗ {}", percent(*share, language)),
            Verdict::Missing => "–".into(),
            Verdict::Unreadable => "?".into(),
            Verdict::Unknown => language.pick("no key", "нет ключа").into(),
        }
    }

    /// In words.
    pub fn words(&self) -> Text {
        match self {
            Verdict::Right => Text::new("right", "верно"),
            Verdict::Rounded => Text::new("right, but coarsely rounded", "верно, но грубо округлено"),
            Verdict::Follows => Text::new("right with the own earlier value", "верно при собственном предыдущем значении"),
            Verdict::Unit => Text::new("the unit is wrong", "неверна единица"),
            Verdict::Wrong(share) if share.is_infinite() => Text::new("wrong, it is zero", "неверно, должен быть ноль"),
            Verdict::Wrong(share) => Text::new(
                format!("wrong by {}", percent(*share, Language::En)),
                format!("неверно, отклонение {}", percent(*share, Language::Ru)),
            ),
            Verdict::Missing => Text::new("no answer", "нет ответа"),
            Verdict::Unreadable => Text::new("not a number", "не число"),
            Verdict::Unknown => Text::new("this variant has no right number", "для этого варианта нет верного значения"),
        }
    }

    /// A word for files.
    pub fn key(&self) -> &'static str {
        match self {
            Verdict::Right => "right",
            Verdict::Rounded => "rounded",
            Verdict::Follows => "follows",
            Verdict::Unit => "unit",
            Verdict::Wrong(_) => "wrong",
            Verdict::Missing => "missing",
            Verdict::Unreadable => "unreadable",
            Verdict::Unknown => "unknown",
        }
    }
}

fn percent(share: f64, language: Language) -> String {
    if share > 10.0 {
        return language.pick("> 1000 %", "> 1000 %").to_owned();
    }
    format!("{} %", report::number::short(100.0 * share, 2, language))
}

/// The verdict on a number by itself. `truth`: the right number and the size of its quantity.
pub fn verdict(answer: &AnswerDecl, truth: Option<(f64, f64)>, written: &Written) -> Verdict {
    match (written, truth) {
        (Written::Missing, _) => Verdict::Missing,
        (Written::Unreadable, _) => Verdict::Unreadable,
        (_, None) => Verdict::Unknown,
        (Written::Foreign(_), _) => Verdict::Unit,
        (Written::Number { value, .. }, Some(right)) if within(*value, right, answer) => Verdict::Right,
        // one digit alone says too little
        (Written::Number { value, half }, Some((truth, _)))
            // half a digit is half a digit: its decimal form is rounded
            if (value - truth).abs() <= (half * (1.0 + 1e-9)).min(COARSE * truth.abs()) && *value != 0.0 =>
        {
            Verdict::Rounded
        }
        (Written::Number { value, .. }, Some((truth, _))) => {
            Verdict::Wrong(if truth == 0.0 { f64::INFINITY } else { ((value - truth) / truth).abs() })
        }
    }
}

/// A student: variant and right numbers.
#[derive(Clone, Debug)]
pub struct Pupil<'a> {
    /// The variant.
    pub member: &'a Member,
    /// Right numbers, in the unit of the question.
    pub truths: &'a [Option<f64>],
    /// Sizes of the quantities that are asked for, in the same units; zero where they are not known.
    pub sizes: &'a [f64],
    /// Right numbers of the neighbouring variants, by name.
    pub neighbours: &'a [(String, Vec<Option<f64>>)],
}

/// Every item of a student. The class computes what follows from wrong values, and other calculations, where they are needed.
pub fn grade(class: &mut Class, answers: &[AnswerDecl], pupil: &Pupil<'_>, cells: &[(String, Written)]) -> Vec<Graded> {
    let mut done: Vec<Graded> = Vec::new();
    let mut own: Vec<(usize, f64)> = Vec::new();
    let mut others = Others::default();
    let mut kept: Kept = None;
    for (i, answer) in answers.iter().enumerate() {
        let (given, written) = cells.get(i).cloned().unwrap_or((String::new(), Written::Missing));
        let truth = pupil.truths.get(i).copied().flatten();
        let size = pupil.sizes.get(i).copied().unwrap_or(0.0);
        let mut item = Graded { given, verdict: verdict(answer, truth.map(|t| (t, size)), &written), likeness: None };
        if let (Verdict::Wrong(_), Written::Number { value, .. }, Some(truth)) = (&item.verdict, &written, truth) {
            if follows(class, (answers, i), pupil, (&own, &written), &mut kept) {
                item.verdict = Verdict::Follows;
            } else {
                item.likeness = looks(class, (answers, i), pupil, ((truth, *value), &mut others));
                if matches!(item.likeness, Some(Likeness::Unit(_))) {
                    item.verdict = Verdict::Unit;
                }
            }
            // a right value in another unit is carried as the right one
            if item.verdict != Verdict::Unit {
                own.push((i, *value));
            }
        }
        done.push(item);
    }
    done
}

/// Whether an item is right with the wrong values before it.
fn follows(
    class: &mut Class,
    (answers, i): (&[AnswerDecl], usize),
    pupil: &Pupil<'_>,
    (own, written): (&[(usize, f64)], &Written),
    kept: &mut Kept,
) -> bool {
    let carries = own.iter().any(|(k, _)| answers[*k].gives.is_some()) || matches!(answers[i].value, AnswerValue::Formula { .. });
    if own.is_empty() || !carries {
        return false;
    }
    let truth = carried(class, answers, pupil.member, own, kept).and_then(|truths| truths.get(i).copied().flatten());
    truth.is_some() && verdict(&answers[i], truth.map(|t| (t, 0.0)), written).counts()
}

/// What the studies of a variant give with a student's own values of parameters: more wrong items do not ask for them again.
type Kept = Option<(Vec<(String, f64)>, Vec<Results>)>;

/// The numbers that follow from a student's own values.
fn carried(class: &mut Class, answers: &[AnswerDecl], member: &Member, own: &[(usize, f64)], kept: &mut Kept) -> Option<Vec<Option<f64>>> {
    let values: Vec<(String, f64)> =
        own.iter().filter_map(|(k, value)| answers[*k].gives.clone().map(|name| (name, value * answers[*k].unit.factor))).collect();
    let changed = changed(class, member, &values)?;
    let machine = class.machine(&changed).ok()?;
    if kept.as_ref().is_none_or(|(of, _)| *of != values) {
        *kept = Some((values, solve::studies(machine, &mut Watch::default())));
    }
    let results = kept.as_ref().map(|(_, results)| results.clone()).unwrap_or_default();
    let solved = solve::answers(machine, results, (&member.given, own), &mut Watch::default());
    Some(solved.truths.into_iter().map(Result::ok).collect())
}

/// A variant with other values, SI.
fn changed(class: &mut Class, member: &Member, values: &[(String, f64)]) -> Option<Member> {
    let machine = class.machine(member).ok()?;
    let texts: Vec<(String, String)> = values.iter().map(|(name, value)| (name.clone(), machine.written(name, *value))).collect();
    let mut member = member.clone();
    member.overrides.retain(|(n, _)| texts.iter().all(|(name, _)| n != name));
    member.overrides.extend(texts);
    Some(member)
}

/// Other calculations of one student, each made once.
#[derive(Default)]
struct Others {
    weight: Option<Vec<Option<f64>>>,
    undamped: Option<Vec<Option<f64>>>,
}

fn looks(
    class: &mut Class,
    (answers, i): (&[AnswerDecl], usize),
    pupil: &Pupil<'_>,
    (pair, others): ((f64, f64), &mut Others),
) -> Option<Likeness> {
    let neighbours: Vec<(String, f64)> =
        pupil.neighbours.iter().filter_map(|(name, truths)| Some((name.clone(), truths.get(i).copied().flatten()?))).collect();
    let mut other = |which: Other| match which {
        Other::Static => still(class, &answers[i], pupil.member).map(|d| vec![pair.0 - d, pair.0 + d]).unwrap_or_default(),
        Other::Weight => at(others.weight.get_or_insert_with(|| with(class, pupil.member, &["kg"], &|m| 9.81 * m)), i),
        Other::Undamped => at(others.undamped.get_or_insert_with(|| with(class, pupil.member, &["N s/m", "N m s"], &|_| 0.0)), i),
    };
    likeness(&answers[i], pair, &mut Around { neighbours: &neighbours, other: &mut other })
}

fn at(list: &[Option<f64>], i: usize) -> Vec<f64> {
    list.get(i).copied().flatten().into_iter().collect()
}

/// The answers with every parameter of these dimensions changed.
fn with(class: &mut Class, member: &Member, units: &[&str], change: &dyn Fn(f64) -> f64) -> Vec<Option<f64>> {
    let Ok(machine) = class.machine(member) else { return Vec::new() };
    let dimensions: Vec<Dimension> = units.iter().filter_map(|u| parse_unit(u).ok()).map(|u| u.dimension).collect();
    let of = |label: &str| parse_unit(label).is_ok_and(|u| dimensions.iter().any(|d| d.same(&u.dimension)));
    let parameters = machine.model.parameters.iter().filter(|p| p.class == Dependence::Constant && of(&p.unit));
    let values: Vec<(String, f64)> = parameters.filter_map(|p| Some((p.name.clone(), change(p.number?)))).collect();
    if values.is_empty() {
        return Vec::new();
    }
    let Some(changed) = changed(class, member, &values) else { return Vec::new() };
    let Ok(machine) = class.machine(&changed) else { return Vec::new() };
    let solved = solve::solve(machine, &member.given, &mut Watch::default());
    solved.truths.into_iter().map(Result::ok).collect()
}

/// The static value of the column that an answer is of, in the unit of the question; none where it is zero.
fn still(class: &mut Class, answer: &AnswerDecl, member: &Member) -> Option<f64> {
    let machine = class.machine(member).ok()?;
    let column = match meaning::wanted(&machine.model, answer)?.ok()? {
        Wanted::Number(number) => number.column()?.to_owned(),
        Wanted::At(column, ..) => column,
        Wanted::Instant(_) => return None,
    };
    let kind = crate::equilibrium::KIND.name;
    let study = machine.origin.studies.find(kind)?;
    let found = study.run(machine, &Asked::new(kind), &mut Watch::default()).filter(|r| r.trouble.is_none())?;
    let value = *found.data.column(&column)?.values.first()?;
    (value.is_finite() && value != 0.0).then(|| value / answer.unit.factor)
}
