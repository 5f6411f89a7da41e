//! The study `threshold`: the value of a parameter, a start or a starting rate at which a number of a repeated study passes a level, to so many digits.
//!
//! First the range is divided and looked at: a change that is not there, or more than one, is said. The one change is closed in; then it is looked for once more with a tenth of the
//! tolerance, which shows how many of its digits are those of the machine and not of the integration. The two motions beside it are drawn.

mod digits;
mod follow;
mod motions;

use super::keys::{LEVEL, OBSERVED, PARTS, REGIMES};
use super::{Found, Given, Interrupts, Repeats, Results, Rows, Studies, Study, agreed, overlaid};
use crate::failure::{Failure, Misuse};
use crate::machine::{self, Machine};
use crate::repeat::regimes;
use crate::results::finite::checked;
use crate::results::{Conclusion, Fact};
use crate::watch::{Lap, Watch};
use crate::{provenance, repeat};
use analysis::studies::threshold::{Side, changes, close, scan, unit};
use analysis::{Dataset, Quantity};
use digits::WITHIN;
use follow::{Follow, Judge};
use mechanics::asked::{Asked, Key, Kind, Objection, Takes, Way, Words};
use words::explain::{Explanation, plain};
use words::{Language, Notice, Text};

/// Digits without a word of the user.
const DIGITS: usize = 6;
/// A number carries not quite sixteen.
const MOST_DIGITS: usize = 15;
/// Parts of the range that are looked at first, without a word of the user.
const DIVIDED: usize = 8;
/// The study.
pub struct Change;

/// Its name and its keys.
pub static KIND: Kind = Kind::new(
    "threshold",
    ("Find the value at which a regime changes, to many digits", "Найти значение, при котором сменяется режим, с большим числом цифр"),
)
.keys(&[
    Key::new(
        "parameter",
        Takes::Changed,
        (
            "what is changed: a parameter, a start `phi` or a starting rate `phi'`",
            "что изменяется: параметр, начальное значение `phi` или начальная скорость `phi'`",
        ),
        "\"m\"",
    )
    .required()
    .option(
        "What is changed: a parameter, a start or a starting rate",
        "Что изменяется: параметр, начальное значение или начальная скорость",
    )
    .way(Way::Begins),
    Key::new(
        "between",
        Takes::Between("parameter"),
        ("between which two values the change lies", "между какими двумя значениями лежит смена"),
        "[\"2 g\", \"10 g\"]",
    )
    .required()
    .option("Between which two values: --between \"2 g\" \"10 g\"", "Между какими двумя значениями: --between \"2 г\" \"10 г\"")
    .way(Way::Written),
    OBSERVED.way(Way::Written),
    LEVEL.way(Way::Written),
    REGIMES.not_with("level", "M071").way(Way::Written),
    Key::new(
        "digits",
        Takes::Count("M071", 1),
        ("significant digits of the value, at most 15", "число значащих цифр значения, не больше 15"),
        "8",
    )
    .default("6", "6")
    .option("Significant digits of the value [default: 6]", "Число значащих цифр значения [по умолчанию: 6]"),
    PARTS,
    repeat::OF,
])
.check(objections);

fn objections(asked: &Asked) -> Vec<Objection> {
    let mut found = Vec::new();
    if asked.count("digits").is_some_and(|digits| digits > MOST_DIGITS) {
        found.push(
            Objection::at("digits", "M071", "a number has no more than 15 digits", "у числа не больше 15 цифр")
                .help("write digits = 10", "напишите digits = 10"),
        );
    }
    if asked.words("observe").len() > 1 {
        found.push(
            Objection::at("observe", "M071", "a change is that of one number", "смену определяет одно число")
                .help("write observe = \"mean(x, 20 s, 30 s)\"", "напишите observe = \"mean(x, 20 с, 30 с)\""),
        );
    }
    if !(asked.flag("regimes") || asked.has("observe") && asked.has("level")) {
        found.push(
            Objection::whole(
                "M071",
                "`observe` and `level` go together, or `regimes` stands alone",
                "`observe` и `level` задают вместе, или задают одно `regimes`",
            )
            .why(
                "a change is that of a number past a level, or that of the regimes of the file",
                "смена — это переход числа через уровень или смена режимов файла",
            )
            .help(
                "write observe = \"mean(x, 20 s, 30 s)\" and level = \"1 m\", or regimes = true",
                "напишите observe = \"mean(x, 20 с, 30 с)\" и level = \"1 м\" или regimes = true",
            ),
        );
    }
    found
}

impl Study for Change {
    fn kind(&self) -> &'static Kind {
        &KIND
    }
    fn wanted(&self) -> Words {
        ("find where the regime changes", "найти границу смены режима")
    }
    fn concludes(&self, _: &Machine, results: &Results, language: Language) -> Vec<Conclusion> {
        results.facts.iter().find(|f| f.quantity.name == "value").map(|f| crate::results::found(f, language)).into_iter().collect()
    }
    fn run(&self, machine: &mut Machine, asked: &Asked, watch: &mut Watch) -> Found {
        let mut results = Results {
            kind: KIND.name,
            heading: Text::new("Threshold", "Граница смены режима"),
            rows: Rows::Summary,
            data: machine::no_numbers(machine),
            ..Results::default()
        };
        if let Err(trouble) = threshold(machine, asked, &mut results, watch) {
            results.fail(trouble);
        }
        watch.lap(Lap::Run);
        Some(checked(results))
    }
    fn merge(&self, _: &Machine, given: Given) -> Result<Asked, Failure> {
        let asked = given.written.or(given.of_file).ok_or_else(nothing_to_find)?;
        let asked = overlaid(&KIND, asked, given.line);
        agreed(&KIND, asked)
    }
    fn inner(&self, all: &Studies) -> Vec<&'static Key> {
        repeat::keys(all, &KIND)
    }
    fn interrupts(&self) -> Interrupts {
        Interrupts::Kept
    }
    fn repeats(&self) -> Repeats {
        Repeats::Never
    }
    fn explanations(&self) -> &'static [Explanation] {
        EXPLANATIONS
    }
}

fn nothing_to_find() -> Failure {
    Notice::new("C033", "the change of what?", "смену чего искать?")
        .why(
            "the file has no study `threshold`, and no --parameter was given",
            "в файле нет расчёта `threshold`, а ключ --parameter не задан",
        )
        .help(
            "add --parameter m --between \"2 g\" \"10 g\" --observe \"mean(x', 20 s, 30 s)\" --level \"1 m/s\"",
            "добавьте --parameter m --between \"2 г\" \"10 г\" --observe \"mean(x', 20 с, 30 с)\" --level \"1 м/с\"",
        )
        .misuse()
}

/// Looks, closes in, repeats, draws.
fn threshold(machine: &mut Machine, asked: &Asked, results: &mut Results, watch: &mut Watch) -> Result<(), Notice> {
    let range = asked.numbers("between").and_then(|ends| <[f64; 2]>::try_from(ends).ok()).unwrap_or_default();
    let digits = asked.count("digits").unwrap_or(DIGITS);
    let parts = asked.count("parts").unwrap_or(DIVIDED);
    let name = asked.word("parameter").unwrap_or_default();
    let parameter = repeat::quantity(machine, name);
    let inner = repeat::inner(asked, &KIND);
    let judge = if asked.flag("regimes") { Judge::Regimes } else { Judge::Level(asked.number("level").unwrap_or_default()) };
    let numbers = if judge == Judge::Regimes { regimes::numbers(machine)? } else { asked.words("observe").to_vec() };
    let asks = repeat::Asks { observe: &numbers, of: asked.word("of"), inner: &inner };
    let mut follow = Follow::new(machine, (&parameter, judge), asks, watch)?;

    follow.expect(parts + 1 + halvings(range, parts, digits));
    let looked = scan(&mut |place| follow.value(place), range, parts)?;
    let found = if judge == Judge::Regimes { follow::other_regimes(&looked) } else { changes(&looked) };
    let [ends] = found[..] else { return Err(follow.not_one(&looked, &found)) };
    let ends = follow.told_apart(ends);
    let [below, above] = close(&mut |place| follow.value(place), ends, &|a, b| WITHIN * unit(a.abs().max(b.abs()), digits))?;
    let value = 0.5 * (below.place + above.place);
    let held = digits::held(&mut follow, [below, above], digits)?;

    let mut data = Dataset { notes: held.notes(&parameter, digits), audits: held.audits(), ..Dataset::default() };
    let (checks, doubt) = follow.checks();
    data.audits.extend(checks);
    data.notes.extend(doubt);
    data.notes.extend(follow.without_impulses());
    let shown = follow.written(value, digits);
    facts(results, (&parameter, digits), (value, [below, above]), &follow);
    results.plots = motions::beside(&mut follow, ([below, above], &shown), &mut data)?;
    results.facts.push(Fact::new(
        "held",
        "n",
        "1",
        held.digits as f64,
        Text::new("digits that hold with a finer tolerance", "цифр, верных и при более строгой точности"),
    ));
    results.own.insert("held".into(), serde_json::json!(held.digits));
    results.data = provenance::stamp(data, &machine.equations, &machine.model_hash);
    Ok(())
}

/// Evaluations that halving alone takes, for the progress.
fn halvings([from, to]: [f64; 2], parts: usize, digits: usize) -> usize {
    let wanted = WITHIN * unit(from.abs().max(to.abs()), digits);
    let mut width = (to - from) / parts as f64;
    let mut count = 0;
    while width > wanted && wanted > 0.0 {
        (width, count) = (0.5 * width, count + 1);
    }
    count
}

fn facts(
    results: &mut Results,
    (parameter, digits): (&Quantity, usize),
    (value, [below, above]): (f64, [Side; 2]),
    follow: &Follow<'_, '_>,
) {
    let written = |place: f64| follow.written(place, digits);
    let shown = written(value);
    results.words.push(follow.told([below, above], &shown));
    let symbol = |mark: &str| format!("{}_{mark}", parameter.symbol);
    let place = |name: &str, mark: &str, place: f64, label: Text| Fact::new(name, &symbol(mark), &parameter.unit, place, label);
    let number = |name: &str, side: Side, label: Text| {
        let quantity = Quantity { label, ..follow.quantity(name) };
        Fact { quantity, value: side.value + follow.level(), words: Text::default() }
    };
    let regimes = follow.regimes([below, above]);
    let numbers = match &regimes {
        Some(_) => Vec::new(),
        None => vec![
            number("observed_below", below, Text::new("found before it", "найдено до неё")),
            number("observed_above", above, Text::new("found behind it", "найдено после неё")),
        ],
    };
    results.facts.extend([
        place("value", "*", value, Text::new("value at which the change lies", "значение, при котором происходит смена")),
        place("below", "1", below.place, Text::new("the last value before it", "последнее значение до неё")),
        place("above", "2", above.place, Text::new("the first value behind it", "первое значение после неё")),
    ]);
    results.facts.extend(numbers);
    results.facts.extend([Fact::new(
        "evaluations",
        "N",
        "1",
        follow.evaluations as f64,
        Text::new("runs of the repeated study", "выполнено расчётов"),
    )]);
    results.own.insert("of".into(), serde_json::json!(follow.repeated.base.kind));
    results.own.insert("parameter".into(), serde_json::json!(parameter.name));
    if let Some([before, behind]) = regimes {
        results.own.insert("regime_below".into(), serde_json::json!(before));
        results.own.insert("regime_above".into(), serde_json::json!(behind));
    } else {
        results.own.insert("observe".into(), serde_json::json!(follow.observed()));
        results.own.insert("level".into(), serde_json::json!(follow.level()));
    }
    results.own.insert("digits".into(), serde_json::json!(digits));
    results.own.insert("evaluations".into(), serde_json::json!(follow.evaluations));
}

const EXPLANATIONS: &[Explanation] = &[
    plain(
        "S145",
        ("not one change in the range", "в промежутке не одна смена"),
        (
            "The study `threshold` looks for the one value between two others at which a number passes a level. Either the number does not pass it between the values that were looked at, \
             or it passes it more than once. The message lists what was found: choose a range around one change, another level, or more `parts` when a change may hide between \
             neighbouring values.",
            "Расчёт `threshold` ищет между двумя значениями одно, при котором число переходит через уровень. Либо между просмотренными значениями оно через уровень не \
             переходит, либо переходит не один раз. В сообщении перечислено найденное: выберите промежуток вокруг одной смены, другой уровень или большее `parts`, если смена \
             может скрываться между соседними значениями.",
        ),
    ),
    plain(
        "S147",
        ("no regimes", "режимы не заданы"),
        (
            "`threshold` with `regimes` looks for the change of a regime, and the file names none. Add a table [regimes] with conditions on numbers of the motion, or ask for a number and its \
             level.",
            "Расчёт `threshold` с ключом `regimes` ищет смену режима, а в файле режимы не названы. Добавьте таблицу [regimes] с условиями на числа движения или задайте число и его \
             уровень.",
        ),
    ),
    plain(
        "S146",
        ("a value without a result", "значение без результата"),
        (
            "At a value between the two ends the repeated study has no result, so that nothing can be said of the change. The message names the value and the trouble of the study there: set \
             it with --set and run the study to see more, or choose a range without such values.",
            "При одном из значений промежутка у повторяемого расчёта нет результата, и о смене ничего сказать нельзя. В сообщении названы значение и причина: задайте его ключом --set и \
             выполните расчёт, чтобы увидеть больше, или выберите промежуток без таких значений.",
        ),
    ),
];
