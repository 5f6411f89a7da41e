//! All variants at a glance: values, answers, what speaks against them.

use super::course::{Class, Member};
use super::{guards, solve};
use crate::watch::Watch;
use mechanics::Model;
use mechanics::model::AnswerDecl;
use report::table::Column;
use report::{Block, Cell, Table};
use serde_json::{Value, json};
use std::fmt::Write;
use words::{Language, Notice, Text};

/// Significant digits of tables.
const DIGITS: usize = 5;

/// What is known of one variant.
#[derive(Clone, Debug, Default)]
pub struct Line {
    /// Its name.
    pub name: String,
    /// Values in place of those of the file, as written.
    pub values: Vec<(String, String)>,
    /// Right numbers, in the unit of the question.
    pub truths: Vec<Result<f64, Notice>>,
    /// Conditions that do not hold: name, condition.
    pub broken: Vec<(String, String)>,
    /// Frequency of a load and of the natural oscillation next to it, rad/s.
    pub near: Option<[f64; 2]>,
    /// Checks of studies that did not hold.
    pub doubts: Vec<Text>,
    /// Why there is nothing else.
    pub failure: Option<Notice>,
}

impl Line {
    /// Whether students can be given it.
    pub fn is_good(&self) -> bool {
        self.failure.is_none() && self.broken.is_empty() && self.doubts.is_empty() && self.truths.iter().all(Result::is_ok)
    }

    /// The same in a few words: codes, names of conditions.
    fn short(&self, language: Language) -> Vec<String> {
        let mut list: Vec<String> = self.failure.iter().map(|n| n.code.to_owned()).collect();
        list.extend(self.truths.iter().filter_map(|t| t.as_ref().err()).map(|n| n.code.to_owned()));
        list.extend(self.broken.iter().map(|(name, _)| name.clone()));
        list.extend(self.near.map(|_| language.pick("resonance", "резонанс").to_owned()));
        list.extend(self.doubts.iter().map(|_| language.pick("check", "проверка").to_owned()));
        list.dedup();
        list
    }

    /// What is to be said of it.
    pub fn remarks(&self) -> Vec<Text> {
        let mut list = Vec::new();
        list.extend(self.failure.iter().map(coded));
        list.extend(self.truths.iter().filter_map(|t| t.as_ref().err()).map(coded));
        list.extend(self.broken.iter().map(|(name, text)| {
            Text::new(format!("condition `{name}` does not hold: {text}"), format!("не выполнено условие `{name}`: {text}"))
        }));
        list.extend(self.near.map(|[load, natural]| {
            let number = |x: f64, language| report::number::short(x, 4, language);
            Text::new(
                format!(
                    "near resonance: load {} rad/s, natural frequency {} rad/s",
                    number(load, Language::En),
                    number(natural, Language::En)
                ),
                format!(
                    "близко к резонансу: частота нагрузки {} рад/с, собственная {} рад/с",
                    number(load, Language::Ru),
                    number(natural, Language::Ru)
                ),
            )
        }));
        list.extend(
            self.doubts
                .iter()
                .map(|audit| Text::new(format!("a check failed: {}", audit.en), format!("не выполнена проверка: {}", audit.ru))),
        );
        let mut seen = std::collections::BTreeSet::new();
        list.retain(|text: &Text| seen.insert(text.en.clone()));
        list
    }
}

/// A notice as one line.
pub(super) fn coded(notice: &Notice) -> Text {
    let why = |words: &str| if words.is_empty() { String::new() } else { format!(" ({words})") };
    let (code, what, cause) = (notice.code, &notice.what, &notice.why);
    Text::new(format!("{}{} [{code}]", what.en, why(&cause.en)), format!("{}{} [{code}]", what.ru, why(&cause.ru)))
}

/// All variants.
#[derive(Clone, Debug, Default)]
pub struct Overview {
    /// Title of the machine.
    pub title: Text,
    /// The questions.
    pub answers: Vec<AnswerDecl>,
    /// The variants.
    pub lines: Vec<Line>,
    /// Groups of variants with the same answers, by place.
    pub twins: Vec<Vec<usize>>,
    /// How often the file was read.
    pub readings: usize,
    /// Whether it was interrupted.
    pub partial: bool,
}

/// Looks at every variant; one that could not be made has its reason in place of its values.
pub fn check(class: &mut Class, model: &Model, members: &[(String, Result<Member, Notice>)], watch: &mut Watch) -> Overview {
    let mut overview = Overview { title: model.title.clone(), answers: model.answers.clone(), ..Overview::default() };
    for (i, (name, member)) in members.iter().enumerate() {
        if watch.is_interrupted() {
            overview.partial = true;
            break;
        }
        overview.lines.push(match member {
            Ok(member) => line(class, member, watch),
            Err(notice) => Line { name: name.clone(), failure: Some(notice.clone()), ..Line::default() },
        });
        if let Some(progress) = &mut watch.progress {
            progress((i + 1) as f64 / members.len() as f64);
        }
    }
    let truths: Vec<Vec<Option<f64>>> =
        overview.lines.iter().map(|l| l.truths.iter().map(|t| t.as_ref().ok().copied()).collect()).collect();
    overview.twins = guards::twins(&truths, &overview.answers);
    overview.readings = class.readings;
    overview
}

fn line(class: &mut Class, member: &Member, watch: &mut Watch) -> Line {
    let mut line = Line { name: member.name.clone(), values: member.overrides.clone(), ..Line::default() };
    match class.machine(member) {
        Err(failure) => line.failure = Some(solve::reason(failure)),
        Ok(machine) => {
            let mut inner = Watch { interrupt: watch.interrupt, ..Watch::default() };
            let solved = solve::solve(machine, &member.given, &mut inner);
            line.broken = guards::broken(machine, &solved);
            line.near = guards::near_resonance(machine, &solved);
            line.doubts = solved.results.iter().flat_map(|r| &r.data.audits).filter(|a| !a.ok).map(|a| a.name.clone()).collect();
            line.failure = solved.results.iter().find_map(|r| r.trouble.clone());
            line.truths = solved.truths;
        }
    }
    line
}

impl Overview {
    /// Whether every variant can be given to students.
    pub fn is_good(&self) -> bool {
        self.lines.iter().all(Line::is_good)
    }

    /// The heads of the columns of answers: `f1, Hz`.
    fn heads(&self, language: Language) -> Vec<String> {
        let unit = |a: &AnswerDecl| report::unit::print(&a.unit.label, language);
        self.answers.iter().map(|a| if a.unit.label.is_empty() { a.id.clone() } else { format!("{}, {}", a.id, unit(a)) }).collect()
    }

    /// As blocks of a document.
    pub fn blocks(&self, language: Language) -> Vec<Block> {
        let heads = [language.pick("variant", "вариант").to_owned()].into_iter().chain(self.heads(language));
        let heads = heads.chain([language.pick("remarks", "замечания").to_owned()]);
        let mut table = Table::new(heads.map(Column::new).collect());
        for line in &self.lines {
            let mut row = vec![Cell::words(line.name.clone())];
            let truth = |i: usize| line.truths.get(i).and_then(|t| t.as_ref().ok());
            row.extend((0..self.answers.len()).map(|i| truth(i).map_or(Cell::Empty, |v| Cell::number(*v, DIGITS, language))));
            let short = line.short(language);
            row.push(Cell::words(if short.is_empty() { "–".to_owned() } else { short.join(", ") }));
            table.row(row);
        }
        let mut blocks = vec![Block::Table(table)];
        let remarks = self.remarks(language);
        if !remarks.is_empty() {
            blocks.push(Block::paragraph(remarks.join("\n")));
        }
        blocks.push(Block::paragraph(self.summary(language)));
        blocks
    }

    /// Lines of what speaks against variants.
    fn remarks(&self, language: Language) -> Vec<String> {
        let variant = language.pick("variant", "вариант");
        let mut list = Vec::new();
        for line in &self.lines {
            list.extend(line.remarks().iter().map(|r| format!("{variant} {}: {}", line.name, language.text(r))));
        }
        for group in &self.twins {
            let names: Vec<&str> = group.iter().map(|i| self.lines[*i].name.as_str()).collect();
            let words = language.pick("variants with the same answers", "варианты с одинаковыми ответами");
            list.push(format!("{words}: {}", names.join(", ")));
        }
        list
    }

    fn summary(&self, language: Language) -> String {
        let good = self.lines.iter().filter(|l| l.is_good()).count();
        let all = self.lines.len();
        let mut text = language.pick(format!("{good} of {all} variants are good"), format!("пригодных вариантов {good} из {all}"));
        if self.partial {
            text.push_str(language.pick("; interrupted", "; прервано"));
        }
        text
    }

    /// As JSON.
    pub fn to_json(&self, language: Language) -> Value {
        let item = |a: &AnswerDecl| json!({"id": a.id, "ask": language.text(&a.ask), "unit": a.unit.label});
        let line = |l: &Line| {
            let answers: serde_json::Map<String, Value> =
                self.answers.iter().zip(&l.truths).map(|(a, t)| (a.id.clone(), t.as_ref().map_or(Value::Null, |v| json!(v)))).collect();
            let values: serde_json::Map<String, Value> = l.values.iter().map(|(n, v)| (n.clone(), json!(v))).collect();
            let broken: Vec<&str> = l.broken.iter().map(|(name, _)| name.as_str()).collect();
            let remarks: Vec<String> = l.remarks().iter().map(|r| language.text(r).to_owned()).collect();
            json!({"variant": l.name, "ok": l.is_good(), "values": values, "answers": answers, "broken": broken,
                "near_resonance": l.near, "failure": l.failure.as_ref().map(|n| n.code), "remarks": remarks})
        };
        let twins: Vec<Vec<&str>> = self.twins.iter().map(|g| g.iter().map(|i| self.lines[*i].name.as_str()).collect()).collect();
        json!({"title": language.text(&self.title), "answers": self.answers.iter().map(item).collect::<Vec<_>>(),
            "variants": self.lines.iter().map(line).collect::<Vec<_>>(), "twins": twins, "readings": self.readings})
    }

    /// As CSV: variant, answers in the units of the questions, remarks.
    pub fn to_csv(&self, language: Language) -> String {
        let quoted =
            |text: &str| if text.contains([',', '"', '\n']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() };
        let heads =
            self.answers.iter().map(|a| if a.unit.label.is_empty() { a.id.clone() } else { format!("{} [{}]", a.id, a.unit.label) });
        let mut out = format!("variant,{}remarks\n", heads.map(|h| format!("{},", quoted(&h))).collect::<String>());
        for line in &self.lines {
            let truth = |i: usize| line.truths.get(i).and_then(|t| t.as_ref().ok());
            let numbers: String = (0..self.answers.len()).map(|i| truth(i).map_or(",".to_owned(), |v| format!("{v},"))).collect();
            let remarks: Vec<String> = line.remarks().iter().map(|r| language.text(r).to_owned()).collect();
            // writing to a string does not fail
            let _ = writeln!(out, "{},{numbers}{}", quoted(&line.name), quoted(&remarks.join("; ")));
        }
        out
    }
}
