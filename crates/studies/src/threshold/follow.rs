//! The number that is followed along the parameter.

use crate::failure::in_words;
use crate::machine::Machine;
use crate::observable::Observable;
use crate::repeat::gathered::{doubt, judged};
use crate::repeat::regimes;
use crate::repeat::{Asks, At, Repeated, number, one, without_impulses};
use crate::results::Results;
use crate::simulate::{self, Simulate};
use crate::watch::Watch;
use analysis::dataset::Audit;
use analysis::studies::threshold::Side;
use analysis::{Dataset, Quantity};
use words::digits::{seven_digits, ten_digits};
use words::{Notice, Text};

/// Values that are listed in a message.
const LISTED: usize = 12;

/// What a change is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Judge {
    /// A number passes this level, SI.
    Level(f64),
    /// Another regime of the file holds.
    Regimes,
}

/// Neighbours with different regimes.
pub(super) fn other_regimes(looked: &[Side]) -> Vec<[Side; 2]> {
    looked.windows(2).filter(|pair| pair[0].value != pair[1].value).map(|pair| [pair[0], pair[1]]).collect()
}

/// A repeated study along a parameter.
pub(super) struct Follow<'a, 'w> {
    parameter: &'a Quantity,
    judge: Judge,
    /// The regime that counts as that before the change.
    before: Option<f64>,
    /// Regimes that were found.
    seen: Vec<(f64, f64)>,
    pub(super) repeated: Repeated,
    pub(super) at: At,
    /// Runs so far.
    pub(super) evaluations: usize,
    /// Runs that are to be expected.
    expected: usize,
    /// Runs that were checked, those of which a check failed, and the first of these.
    checked: usize,
    failed: usize,
    doubtful: Option<(f64, Audit)>,
    pub(super) watch: &'a mut Watch<'w>,
}

impl<'a, 'w> Follow<'a, 'w> {
    pub(super) fn new(
        machine: &Machine,
        (parameter, judge): (&'a Quantity, Judge),
        asks: Asks<'_>,
        watch: &'a mut Watch<'w>,
    ) -> Result<Follow<'a, 'w>, Notice> {
        let repeated = Repeated::new(machine, asks)?;
        if repeated.noted.len() > 1 && judge != Judge::Regimes {
            return Err(which(asks.observe));
        }
        Ok(Follow {
            parameter,
            judge,
            before: None,
            seen: Vec::new(),
            repeated,
            at: At::of(machine),
            evaluations: 0,
            expected: 0,
            checked: 0,
            failed: 0,
            doubtful: None,
            watch,
        })
    }

    /// How many runs are to be expected.
    pub(super) fn expect(&mut self, runs: usize) {
        self.expected = runs.max(1);
    }

    /// The number at a value of the parameter, less the level; or the number of its regime, and when one of them is that before the change, -1 for this one and 1 for others. It does
    /// not depend on what was found before.
    pub(super) fn value(&mut self, place: f64) -> Result<f64, Notice> {
        let results = self.run(place)?;
        let mut numbers = Vec::with_capacity(self.repeated.noted.len());
        for (_, wanted) in &self.repeated.noted {
            let value = number(&results, wanted).map_err(|trouble| self.without_result(place, trouble))?.0;
            // of events there may be infinitely many
            if value.is_nan() {
                return Err(self.without_result(place, no_value(&wanted.to_string())));
            }
            numbers.push((wanted.to_string(), value));
        }
        if let Judge::Level(level) = self.judge {
            return Ok(numbers.first().map_or(f64::NAN, |(_, value)| value - level));
        }
        let found = regimes::which(&self.at.machine, &numbers) as f64;
        self.seen.push((place, found));
        Ok(self.before.map_or(found, |before| if found == before { -1.0 } else { 1.0 }))
    }

    /// The ends of a range with one change: what was found below it counts as that before it.
    pub(super) fn told_apart(&mut self, ends: [Side; 2]) -> [Side; 2] {
        if self.judge != Judge::Regimes {
            return ends;
        }
        self.before = Some(ends[0].value);
        [Side { value: -1.0, ..ends[0] }, Side { value: 1.0, ..ends[1] }]
    }

    /// Names of the regimes on both sides.
    pub(super) fn regimes(&self, sides: [Side; 2]) -> Option<[String; 2]> {
        (self.judge == Judge::Regimes).then(|| sides.map(|side| self.regime(side.place)))
    }

    fn regime(&self, place: f64) -> String {
        let found = self.seen.iter().rev().find(|(at, _)| *at == place).map(|(_, found)| *found as usize);
        found.and_then(|which| regimes::name(&self.at.machine, which)).unwrap_or("-").to_owned()
    }

    /// What changes where, in a sentence.
    pub(super) fn told(&self, sides: [Side; 2], shown: &Text) -> Text {
        let (what, symbol) = (self.observed(), &self.parameter.symbol);
        if let Some([before, behind]) = self.regimes(sides) {
            return Text::new(
                format!("At {symbol} = {} the regime `{before}` gives way to `{behind}`.", shown.en),
                format!("При {symbol} = {} режим `{before}` сменяется режимом `{behind}`.", shown.ru),
            );
        }
        let level = self.level_words();
        Text::new(
            format!("{what} passes {} at {symbol} = {}.", level.en, shown.en),
            format!("{what} переходит через {} при {symbol} = {}.", level.ru, shown.ru),
        )
    }

    /// The level; 0 where regimes change.
    pub(super) fn level(&self) -> f64 {
        if let Judge::Level(level) = self.judge { level } else { 0.0 }
    }

    /// The repeated study at a value of the parameter.
    pub(super) fn run(&mut self, place: f64) -> Result<Results, Notice> {
        if self.watch.is_interrupted() {
            return Err(interrupted(self.evaluations));
        }
        self.evaluations += 1;
        if let Some(progress) = &mut self.watch.progress {
            progress((self.evaluations as f64 / self.expected.max(self.evaluations + 1) as f64).min(1.0));
        }
        let values = [(self.parameter.name.clone(), place)];
        let results = one(&mut self.at, &self.repeated, &values, self.watch).map_err(|trouble| self.without_result(place, trouble))?;
        let audits = &results.data.audits;
        self.checked += usize::from(!audits.is_empty());
        if let Some(audit) = audits.iter().find(|audit| !audit.ok) {
            self.failed += 1;
            self.doubtful.get_or_insert_with(|| (place, audit.clone()));
        }
        Ok(results)
    }

    /// The checks of all runs, and where the first one failed.
    pub(super) fn checks(&self) -> (Option<Audit>, Option<Text>) {
        let first = self.doubtful.as_ref().map(|(place, audit)| doubt(&[(self.parameter.name.clone(), *place)], audit));
        ((self.checked > 0).then(|| judged(self.failed)), first)
    }

    /// The motion at a value of the parameter, row by row.
    pub(super) fn shown(&mut self, place: f64, study: &Simulate) -> Result<Dataset, Notice> {
        let machine = &mut self.at.machine;
        let bound = machine.bind(&[(self.parameter.name.as_str(), place)]).map_err(in_words);
        let done = bound.and_then(|_| {
            let results = simulate::motion(machine, study, &mut Watch { interrupt: self.watch.interrupt, ..Watch::default() });
            results.trouble.map_or(Ok(results.data), Err)
        });
        done.map_err(|trouble| self.without_result(place, trouble))
    }

    /// On which side of the change a motion is, for a legend.
    pub(super) fn side(&self, value: &Text, side: usize) -> Text {
        let symbol = &self.parameter.symbol;
        let (en, ru) = [("just below", "чуть меньше"), ("just above", "чуть больше")][side.min(1)];
        Text::new(format!("{symbol} {en} {}", value.en), format!("{symbol} {ru} {}", value.ru))
    }

    /// The trouble of a study at one of the values.
    pub(super) fn without_result(&self, place: f64, trouble: Notice) -> Notice {
        let value = self.typed(place);
        let name = &self.parameter.name;
        let Notice { message, .. } = trouble;
        Notice::new(
            "S146",
            format!("no result at {name} = {}: {} [{}]", value.en, message.what.en, message.code),
            format!("нет результата при {name} = {}: {} [{}]", value.ru, message.what.ru, message.code),
        )
        .because(message.why.clone())
        .cure(message.help.clone())
    }

    /// S145: the number does not pass its level, or passes it more than once.
    pub(super) fn not_one(&self, looked: &[Side], found: &[[Side; 2]]) -> Notice {
        if self.judge == Judge::Regimes {
            return self.not_one_regime(looked, found);
        }
        let (what, level, name) = (self.observed(), self.level_words(), &self.parameter.name);
        if found.is_empty() {
            let list: Vec<[Text; 2]> = looked.iter().take(LISTED).map(|s| [self.typed(s.place), self.found(*s)]).collect();
            let pick =
                |text: fn(&Text) -> &str| list.iter().map(|[p, v]| format!("{}: {}", text(p), text(v))).collect::<Vec<_>>().join("; ");
            return Notice::new(
                "S145",
                format!("{what} does not pass {} between these values of {name}", level.en),
                format!("между этими значениями {name} число {what} не переходит через {}", level.ru),
            )
            .why(format!("found: {}", pick(|t| &t.en)), format!("найдено: {}", pick(|t| &t.ru)))
            .help(
                "choose a wider range or another level; a change between neighbouring values is found with more `parts`",
                "выберите более широкий промежуток или другой уровень; смена между соседними значениями находится при большем `parts`",
            );
        }
        let pairs: Vec<[Text; 2]> = found.iter().take(LISTED).map(|pair| pair.map(|side| self.typed(side.place))).collect();
        let pick =
            |text: fn(&Text) -> &str| pairs.iter().map(|[a, b]| format!("{} ... {}", text(a), text(b))).collect::<Vec<_>>().join("; ");
        Notice::new(
            "S145",
            format!("{what} passes {} {} times between these values of {name}", level.en, found.len()),
            format!("между этими значениями {name} число {what} переходит через {} несколько раз: {}", level.ru, found.len()),
        )
        .why(format!("there are changes at {}", pick(|t| &t.en)), format!("смены лежат в промежутках {}", pick(|t| &t.ru)))
        .help("look for them one by one: --between with the ends of one of these", "ищите их по одной: --between с концами одного из них")
    }

    fn not_one_regime(&self, looked: &[Side], found: &[[Side; 2]]) -> Notice {
        let name = &self.parameter.name;
        let list: Vec<[Text; 2]> = looked.iter().take(LISTED).map(|s| [self.typed(s.place), Text::same(self.regime(s.place))]).collect();
        let pick = |text: fn(&Text) -> &str| list.iter().map(|[p, v]| format!("{}: {}", text(p), text(v))).collect::<Vec<_>>().join("; ");
        let (en, ru) = match found.len() {
            0 => (format!("the regime is the same at all these values of {name}"), format!("при всех этих значениях {name} режим один")),
            n => (
                format!("the regime changes {n} times between these values of {name}"),
                format!("между этими значениями {name} режим сменяется несколько раз: {n}"),
            ),
        };
        Notice::new("S145", en, ru).why(format!("found: {}", pick(|t| &t.en)), format!("найдено: {}", pick(|t| &t.ru))).help(
            "choose a range around one change: --between with neighbouring values of these",
            "выберите промежуток вокруг одной смены: --between с соседними из этих значений",
        )
    }

    /// The number as it is observed.
    pub(super) fn observed(&self) -> String {
        self.repeated.noted.first().map_or_else(String::new, |(_, observable)| observable.to_string())
    }

    /// That the mean of a force leaves out impacts.
    pub(super) fn without_impulses(&self) -> Option<Text> {
        without_impulses(&self.at.machine, &self.repeated.noted)
    }

    /// The quantity that is made into the number.
    pub(super) fn of(&self) -> Option<&str> {
        self.repeated.noted.first().and_then(|(_, observable): &(Quantity, Observable)| observable.column())
    }

    /// The quantity of the number under another name.
    pub(super) fn quantity(&self, name: &str) -> Quantity {
        let own = self.repeated.noted.first().map(|(quantity, _)| quantity.clone()).unwrap_or_default();
        Quantity { name: name.into(), ..own }
    }

    /// The level with its unit.
    pub(super) fn level_words(&self) -> Text {
        self.with_unit(seven_digits(self.level()), &self.quantity("").unit)
    }

    fn found(&self, side: Side) -> Text {
        self.with_unit(seven_digits(side.value + self.level()), &self.quantity("").unit)
    }

    /// A value of the parameter, as it is typed in again.
    fn typed(&self, place: f64) -> Text {
        self.with_unit(ten_digits(place), &self.parameter.unit)
    }

    /// A value of the parameter with so many digits and its unit.
    pub(super) fn written(&self, place: f64, digits: usize) -> Text {
        let short: f64 = format!("{place:.*e}", digits.saturating_sub(1)).parse().unwrap_or(place);
        self.with_unit(words::digits::number(short), &self.parameter.unit)
    }

    fn with_unit(&self, number: Text, unit: &str) -> Text {
        let unit = Text::unit(unit);
        if unit.en.is_empty() || unit.en == "1" {
            return number;
        }
        Text::new(format!("{} {}", number.en, unit.en), format!("{} {}", number.ru, unit.ru))
    }
}

/// An output by its bare name is two numbers.
fn which(observe: &[String]) -> Notice {
    let name = observe.first().map_or("", String::as_str);
    Notice::new("S085", format!("which number of `{name}`?"), format!("какое число величины `{name}`?"))
        .help(format!("write max({name}), mean({name}, 20 s, 30 s)"), format!("напишите max({name}), mean({name}, 20 с, 30 с)"))
}

fn no_value(what: &str) -> Notice {
    Notice::new("S085", format!("there is no number `{what}`"), format!("числа `{what}` нет"))
}

fn interrupted(runs: usize) -> Notice {
    Notice::new("C035", format!("interrupted after {runs} runs"), format!("прервано; выполнено расчётов: {runs}"))
}
