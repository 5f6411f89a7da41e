//! Options of a study on the command line, made of its keys; and their values, read as the keys say.

use crate::quantities;
use clap::builder::PossibleValuesParser;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, value_parser};
use mechanics::asked::observed::{listed, observed};
use mechanics::asked::{Asked, Key, Like, Named, Takes, Value, Way};
use mechanics::units::{Dimension, parse_unit};
use std::path::PathBuf;
use strutt::columns;
use studies::pipeline::Machine;
use studies::{Extra, STUDIES, Study, TABLE};
use studies::{Failure, plan};
use words::Language;

/// `strutt NAME` of every study, in the order of the table.
pub fn commands(language: Language) -> impl Iterator<Item = Command> {
    TABLE.iter().filter(|study| study.has_command()).map(move |study| command(*study, language))
}

fn command(study: &dyn Study, language: Language) -> Command {
    let kind = study.kind();
    let mut command = crate::args::Model::augment_args(Command::new(kind.name).about(language.pick(kind.about.0, kind.about.1)));
    let keys: Vec<&Key> = kind.keys.iter().chain(study.inner(&STUDIES)).collect();
    for key in &keys {
        command = command.args(option(key, &keys, language));
    }
    let out = ("Also write tables, plots and a page into this folder", "Записать также таблицы, графики и страницу в эту папку");
    let out = Arg::new("out").long("out").value_name("DIR").value_parser(value_parser!(PathBuf)).help(language.pick(out.0, out.1));
    command.arg(out).args(study.extras().iter().map(|extra| bare(*extra, language)))
}

/// Its name, and what it does.
fn named(extra: Extra) -> (&'static str, (&'static str, &'static str)) {
    match extra {
        Extra::HalveTolerance => (
            "halve_tolerance",
            (
                "Compute each motion once more with half the tolerance and show the difference",
                "Повторить каждый расчёт с вдвое меньшей допустимой погрешностью шага и показать расхождение",
            ),
        ),
        Extra::Check => (
            "check",
            (
                "Compute the motion once more with other steps and show which digits hold",
                "Повторить расчёт с другими шагами и показать, какие цифры верны",
            ),
        ),
        Extra::Events => (
            "events",
            (
                "Rows at the named events and switches instead of the times",
                "Строки в моменты именованных событий и переключений вместо моментов таблицы",
            ),
        ),
        Extra::Switches => (
            "switches",
            (
                "Also rows at every switch, just before and just after it",
                "Также строки при каждом переключении, непосредственно до и после него",
            ),
        ),
        Extra::Threads => (
            "threads",
            (
                "So many runs at a time; the results are the same for any number [default: one a processor]",
                "Столько расчётов одновременно; результаты от этого числа не зависят [по умолчанию: по числу процессоров]",
            ),
        ),
        Extra::Resume => (
            "resume",
            (
                "Go on from where an earlier run into the folder of --out ended",
                "Продолжить с того места, где кончился прежний запуск с той же папкой --out",
            ),
        ),
        Extra::Shard => (
            "shard",
            (
                "Only this part of the values: 2/8 is the second of eight; strutt merge puts them together",
                "Только эта часть значений: 2/8 — вторая из восьми; объединяет их strutt merge",
            ),
        ),
    }
}

fn bare(extra: Extra, language: Language) -> Arg {
    let (name, (en, ru)) = named(extra);
    let arg = Arg::new(name).long(name.replace('_', "-")).help(language.pick(en, ru));
    let flag = || arg.clone().action(ArgAction::SetTrue);
    match extra {
        Extra::Shard => arg.value_name("I/N").requires("out"),
        Extra::Threads => arg.value_name("N").value_parser(value_parser!(u16).range(1..)),
        Extra::Resume => flag().requires("out"),
        Extra::Events => flag().conflicts_with("switches"),
        Extra::HalveTolerance | Extra::Check | Extra::Switches => flag(),
    }
}

/// The name of a key's option.
fn name_of(key: &Key) -> &'static str {
    key.option.and_then(|line| line.name).unwrap_or(key.name)
}

/// `--name` as a user writes it.
fn dashed(key: &Key) -> String {
    format!("--{}", name_of(key).replace('_', "-"))
}

/// The option of a key among others: it refers to none that is not there.
fn option(key: &Key, among: &[&Key], language: Language) -> Option<Arg> {
    let line = key.option?;
    let name = name_of(key);
    let begins = match line.way {
        Way::Begins => language
            .pick("; begins a study of its own instead of the file's", "; начинает собственное исследование вместо заданного в файле"),
        Way::Instead | Way::Written => "",
    };
    let help = format!("{}{begins}", language.pick(line.help.0, line.help.1));
    let arg = Arg::new(name).long(name.replace('_', "-")).aliases(line.also).help(help);
    let there = |other: &str| among.iter().any(|key| key.option.is_some() && name_of(key) == other);
    let arg = line.needs.iter().filter(|other| there(other)).fold(arg, |arg, other| arg.requires(*other));
    let arg = key.excluded.iter().filter(|(other, _)| there(other)).fold(arg, |arg, (other, _)| arg.conflicts_with(*other));
    if line.sets.is_some() {
        return Some(arg.action(ArgAction::SetTrue));
    }
    let arg = match metavar(key.takes) {
        "" => arg,
        word => arg.value_name(word),
    };
    Some(match key.takes {
        Takes::Flag => arg.action(ArgAction::SetTrue),
        Takes::Word(choice) => arg.value_parser(PossibleValuesParser::new(choice.words)),
        Takes::Count(..) => arg.value_parser(value_parser!(usize)),
        Takes::Guess => arg.action(ArgAction::Append),
        Takes::Ranges => arg.action(ArgAction::Append).allow_hyphen_values(true),
        Takes::Results => arg.action(ArgAction::Append).value_delimiter(','),
        Takes::Observed => arg.action(ArgAction::Append),
        Takes::Between(_) => arg.num_args(2).allow_hyphen_values(true),
        Takes::Coordinate | Takes::Sought | Takes::Varied | Takes::Changed | Takes::Name | Takes::Repeatable => arg,
        _ => arg.allow_hyphen_values(true),
    })
}

/// What stands for a value in help.
fn metavar(takes: Takes) -> &'static str {
    match takes {
        Takes::End | Takes::Step | Takes::Duration | Takes::Wait => "TIME",
        Takes::Moments => "T1,T2,...",
        Takes::Number(_) | Takes::Tolerance => "NUMBER",
        Takes::Count(..) => "N",
        Takes::Quantity(..) => "QUANTITY",
        Takes::Word(choice) => choice.metavar,
        Takes::Coordinate | Takes::Sought | Takes::Varied | Takes::Changed | Takes::Name => "NAME",
        Takes::Between(_) => "QUANTITY",
        Takes::RangeOf(_) | Takes::FrequencyRange => "FROM,TO",
        Takes::Frequencies => "W1,W2,...",
        Takes::Results | Takes::Observed | Takes::Formulas => "A,B,...",
        Takes::Guess | Takes::Driven(_) | Takes::FrequencyVariable => "NAME=QUANTITY",
        Takes::Section => "FORMULA",
        Takes::Ranges | Takes::Stretch => "RANGE",
        Takes::Repeatable => "STUDY",
        Takes::Flag | Takes::Plots | Takes::OwnPlots => "",
    }
}

/// Which options are values of a study.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Taken {
    /// All that are given.
    All,
    /// Those in place of keys: the others stand in a study that the command line writes.
    Instead,
}

/// Options with their values as texts.
pub struct Line<'a> {
    study: &'a dyn Study,
    matches: &'a ArgMatches,
}

impl<'a> Line<'a> {
    /// The options of a study.
    pub fn new(study: &'a dyn Study, matches: &'a ArgMatches) -> Line<'a> {
        Line { study, matches }
    }

    /// Keys whose options are there.
    fn given(&self) -> Vec<&'static Key> {
        let keys = self.study.kind().keys.iter().chain(self.study.inner(&STUDIES));
        keys.filter(|key| key.option.is_some() && self.texts(key).is_some()).collect()
    }

    fn texts(&self, key: &Key) -> Option<Vec<String>> {
        let name = name_of(key);
        if key.option?.sets.is_some() || matches!(key.takes, Takes::Flag) {
            return self.matches.get_flag(name).then(Vec::new);
        }
        if matches!(key.takes, Takes::Count(..)) {
            return self.matches.get_one::<usize>(name).map(|n| vec![n.to_string()]);
        }
        let texts = self.matches.get_many::<String>(name)?.cloned();
        Some(if matches!(key.takes, Takes::Observed) { texts.flat_map(|text| listed(&text)).collect() } else { texts.collect() })
    }

    /// The study that the command line writes behind the file, when it begins one: so its formulas are read and checked as those of the file are.
    ///
    /// # Errors
    /// Values that a table should have are not there (C077).
    pub fn written(&self) -> Result<Option<String>, Failure> {
        let given = self.given();
        let way = |key: &Key| key.option.map(|line| line.way);
        if !given.iter().any(|key| way(key) == Some(Way::Begins)) {
            return Ok(None);
        }
        let mut text = row("kind", self.study.kind().name);
        for key in given.into_iter().filter(|key| way(key) != Some(Way::Instead)) {
            let mut texts = self.texts(key).unwrap_or_default();
            if matches!(key.takes, Takes::Ranges) {
                texts = texts.iter().map(|text| columns::expanded(text)).collect::<Result<_, _>>()?;
            }
            text += &written(key, &texts);
        }
        Ok(Some(text))
    }

    /// The tables that values are taken from.
    pub fn tables(&self) -> Vec<PathBuf> {
        let ranges = self.given().into_iter().filter(|key| matches!(key.takes, Takes::Ranges));
        ranges.flat_map(|key| self.texts(key).unwrap_or_default()).filter_map(|text| columns::table(&text)).collect()
    }

    /// The values in place of those of the file; `of` is the study they are for.
    ///
    /// # Errors
    /// A value is none (C009), a result does not exist (C008).
    pub fn values(&self, machine: &Machine, (of, taken): (&Asked, Taken)) -> Result<Asked, Failure> {
        let mut asked = Asked::new(self.study.kind().name);
        for key in self.given() {
            if taken == Taken::Instead && key.option.is_some_and(|line| line.way != Way::Instead) {
                continue;
            }
            let texts = self.texts(key).unwrap_or_default();
            let own = self.study.own_columns(machine, of);
            let value = Reading { machine, own: &own, of, before: &asked }.value(key, &texts)?;
            asked.set(key.name, value);
        }
        Ok(asked)
    }
}

/// A row `key = "value"` of a study, quoted for TOML.
fn row(key: &str, value: &str) -> String {
    format!("{key} = {}\n", toml_string(value))
}

/// The row of a key as a file would have it.
fn written(key: &Key, texts: &[String]) -> String {
    let list = || format!("[{}]", texts.iter().map(|t| toml_string(t.trim())).collect::<Vec<_>>().join(", "));
    let first = texts.first().map_or("", String::as_str);
    match key.takes {
        Takes::Ranges | Takes::Between(_) | Takes::Observed | Takes::Results | Takes::Formulas => format!("{} = {}\n", key.name, list()),
        Takes::Count(..) => format!("{} = {first}\n", key.name),
        Takes::Flag => format!("{} = true\n", key.name),
        Takes::End | Takes::Step | Takes::Duration | Takes::Wait => row(key.name, &quantities::with_unit(first, "s")),
        Takes::Quantity(Like::Is(_, unit), _) => row(key.name, &quantities::with_unit(first, unit)),
        _ => row(key.name, key.option.and_then(|line| line.sets).unwrap_or(first)),
    }
}

/// A basic string of TOML.
fn toml_string(text: &str) -> String {
    let escaped: String = text
        .chars()
        .map(|c| match c {
            '"' => "\\\"".to_owned(),
            '\\' => "\\\\".to_owned(),
            c if c.is_control() => format!("\\u{:04X}", u32::from(c)),
            c => c.to_string(),
        })
        .collect();
    format!("\"{escaped}\"")
}

/// What a value may refer to.
struct Reading<'a> {
    machine: &'a Machine,
    /// Columns that only the study knows.
    own: &'a [String],
    /// The study as it stands without the command line.
    of: &'a Asked,
    /// What stands before it on the command line.
    before: &'a Asked,
}

impl Reading<'_> {
    fn value(&self, key: &Key, texts: &[String]) -> Result<Value, Failure> {
        let (option, text) = (dashed(key), texts.first().map_or("", String::as_str));
        let option = option.as_str();
        Ok(match key.takes {
            Takes::End => Value::Number(quantities::end(option, text)?),
            Takes::Step => Value::Number(quantities::step(option, text)?),
            Takes::Duration => Value::Number(quantities::positive(option, text)?),
            Takes::Wait => Value::Number(quantities::duration(option, text)?),
            Takes::Moments => Value::Numbers(quantities::times(option, text)?),
            Takes::Number(_) => Value::Number(quantities::number(option, text)?),
            Takes::Tolerance => Value::Number(quantities::tolerance(option, text)?),
            Takes::Count(_, least) => {
                let points = text.parse().map_or(Ok(0), |points| quantities::positions(option, points, least))?;
                Value::Number(points as f64)
            }
            Takes::Quantity(like, _) => Value::Number(quantities::quantity(option, text, &self.dimension(like))?),
            Takes::Flag => Value::Flag(true),
            Takes::Coordinate => Value::Coordinate(self.coordinate(option, text)?),
            Takes::RangeOf(over) => Value::Numbers(self.range(over, text)?),
            Takes::Between(over) => Value::Numbers(quantities::ends(option, texts, &self.dimension(Like::Of(over)), self.scaled(over))?),
            Takes::FrequencyRange => Value::Numbers(band(option, text)?),
            Takes::Frequencies => Value::Numbers(quantities::frequencies(option, text)?),
            Takes::Results => Value::Words(self.results(texts)?),
            Takes::Observed => Value::Words(quantities::observed(option, texts)?),
            Takes::Guess => Value::Guess(quantities::guess(texts, self.machine)?),
            Takes::Stretch => Value::Ranges(vec![quantities::stretch(option, text, self.machine)?]),
            _ => Value::Word(key.option.and_then(|line| line.sets).unwrap_or(text).to_owned()),
        })
    }

    fn named(&self, key: &str) -> Option<&Value> {
        self.before.get(key).or_else(|| self.of.get(key))
    }

    fn dimension(&self, like: Like) -> Dimension {
        let unit = |unit: &str| parse_unit(unit).ok().map(|unit| unit.dimension);
        let of = |key: &str| match self.named(key)? {
            Value::Coordinate(named) => named.dimension,
            Value::Word(name) => unit(self.unit(name)?),
            Value::Words(texts) => {
                let of = observed(texts.first()?).ok()?.of;
                unit(&self.machine.equations.outputs.iter().find(|o| o.name == of)?.unit)
            }
            _ => None,
        };
        match like {
            Like::Is(dimension, _) => dimension,
            Like::Of(key) => of(key).unwrap_or(Dimension::NONE),
            Like::RateOf(key) => of(key).unwrap_or(Dimension::NONE).per_time(1),
        }
    }

    /// The SI unit of a parameter, a coordinate or a rate.
    fn unit(&self, name: &str) -> Option<&str> {
        let model = &self.machine.model;
        let base = name.trim_end_matches('\'');
        let coordinate = || model.coordinates.iter().find(|c| c.name == base)?.units.get(name.len() - base.len());
        model.parameters.iter().find(|p| p.name == name).map(|p| &p.unit).or_else(coordinate).map(String::as_str)
    }

    /// What another key names and the unit in which the file gives it, when that is not the SI one.
    fn scaled(&self, key: &str) -> Option<&String> {
        let Some(Value::Word(name)) = self.named(key) else { return None };
        self.machine.model.scaled.get(name)
    }

    fn coordinate(&self, option: &str, name: &str) -> Result<Named, Failure> {
        let found = self.machine.model.coordinates.iter().find(|c| c.name == name);
        let found = found.ok_or_else(|| quantities::no_coordinate(option, name, self.machine))?;
        Ok(Named { name: name.to_owned(), symbol: found.symbols[0], dimension: parse_unit(&found.units[0]).ok().map(|u| u.dimension) })
    }

    fn range(&self, over: &str, text: &str) -> Result<Vec<f64>, Failure> {
        Ok(match self.named(over) {
            Some(Value::Coordinate(named)) => quantities::between(&named.name, text, self.machine)?,
            Some(Value::Word(name)) => quantities::parameter_range(name, text, self.machine)?,
            _ => [0.0, 0.0],
        }
        .to_vec())
    }

    fn results(&self, texts: &[String]) -> Result<Vec<String>, Failure> {
        let names = trimmed(texts);
        let others: Vec<String> = names.iter().filter(|name| !self.own.contains(name)).cloned().collect();
        plan::known_columns(&others, &self.machine.equations)?;
        Ok(names)
    }
}

fn trimmed(texts: &[String]) -> Vec<String> {
    texts.iter().map(|name| name.trim().to_owned()).filter(|name| !name.is_empty()).collect()
}

/// Two frequencies.
fn band(option: &str, text: &str) -> Result<Vec<f64>, Failure> {
    let ends = quantities::frequencies(option, text)?;
    match ends[..] {
        [from, to] if to > from => Ok(ends),
        _ => Err(quantities::no_band(option, text)),
    }
}
