//! Values of command-line keys: quantities, lists of times, `name=quantity`.

use mechanics::units::{Dimension, parse_angular_rate, parse_quantity};
use studies::Failure;
use studies::failure::Misuse;
use words::{Notice, Text};

/// `30`, `30s`, `2 min`: seconds.
pub fn seconds(key: &str, text: &str) -> Result<f64, Failure> {
    let value = parse_quantity(text, &Dimension::TIME).map_err(|fault| bad(key, text, &fault.what, &fault.help))?;
    if value.is_finite() { Ok(value) } else { Err(bad(key, text, &not_finite(), &Text::default())) }
}

/// A positive time.
pub fn step(key: &str, text: &str) -> Result<f64, Failure> {
    let value = seconds(key, text)?;
    let words = Text::new("the step of time must be positive", "шаг по времени должен быть положительным");
    if value > 0.0 { Ok(value) } else { Err(bad(key, text, &words, &Text::default())) }
}

/// A time that is not before the start.
pub fn end(key: &str, text: &str) -> Result<f64, Failure> {
    let value = seconds(key, text)?;
    let words = Text::new("the motion begins at t = 0", "движение начинается при t = 0");
    if value >= 0.0 { Ok(value) } else { Err(bad(key, text, &words, &Text::default())) }
}

/// How many points there are, at least so many.
pub fn positions(key: &str, points: usize, least: usize) -> Result<usize, Failure> {
    let words = Text::new(format!("there are {least} ... 1000000 points"), format!("точек бывает {least} ... 1000000"));
    if (least..=1_000_000).contains(&points) { Ok(points) } else { Err(bad(key, &points.to_string(), &words, &Text::default())) }
}

/// A duration that may be zero.
pub fn duration(key: &str, text: &str) -> Result<f64, Failure> {
    let value = seconds(key, text)?;
    let words = Text::new("a duration is not negative", "длительность не бывает отрицательной");
    if value >= 0.0 { Ok(value) } else { Err(bad(key, text, &words, &Text::default())) }
}

/// A time that is not zero.
pub fn positive(key: &str, text: &str) -> Result<f64, Failure> {
    let value = seconds(key, text)?;
    let words = Text::new("the time must be positive", "время должно быть положительным");
    if value > 0.0 { Ok(value) } else { Err(bad(key, text, &words, &Text::default())) }
}

/// A tolerance of the integrator.
pub fn tolerance(key: &str, text: &str) -> Result<f64, Failure> {
    let value = number(key, text)?;
    let words = Text::new(
        concat!("a tolerance lies between ", words::finest_tolerance!(), " and ", words::coarsest_tolerance!()),
        concat!("допустимая погрешность лежит между ", words::finest_tolerance!(), " и ", words::coarsest_tolerance!()),
    );
    if words::limits::TOLERANCES.contains(&value) { Ok(value) } else { Err(bad(key, text, &words, &Text::default())) }
}

/// What stands for a key of a study: a bare number gets the SI unit, as it does for all options; a formula stays.
pub fn with_unit(text: &str, unit: &str) -> String {
    match text.trim().replace(',', ".").parse::<f64>() {
        Ok(value) if value.is_finite() => format!("{value:e} {unit}"),
        _ => text.to_owned(),
    }
}

/// Times with commas between; with semicolons between, decimal commas are allowed.
pub fn times(key: &str, text: &str) -> Result<Vec<f64>, Failure> {
    let separator = if text.contains(';') { ';' } else { ',' };
    text.split(separator).map(|item| seconds(key, item.trim())).collect()
}

/// Frequencies in rad/s with commas between (semicolons where decimal commas are meant); Hz counts periods.
pub fn frequencies(key: &str, text: &str) -> Result<Vec<f64>, Failure> {
    let separator = if text.contains(';') { ';' } else { ',' };
    let one = |item: &str| {
        let value = parse_angular_rate(item.trim()).map_err(|fault| bad(key, text, &fault.what, &fault.help))?;
        let negative = Text::new("a frequency is not negative", "частота не бывает отрицательной");
        if value.is_finite() && value >= 0.0 { Ok(value) } else { Err(bad(key, text, &negative, &Text::default())) }
    };
    text.split(separator).map(one).collect()
}

/// A quantity of this dimension, SI.
pub fn quantity(key: &str, text: &str, dimension: &Dimension) -> Result<f64, Failure> {
    let value = parse_quantity(text, dimension).map_err(|fault| bad(key, text, &fault.what, &fault.help))?;
    if value.is_finite() { Ok(value) } else { Err(bad(key, text, &not_finite(), &Text::default())) }
}

/// A pure number.
pub fn number(key: &str, text: &str) -> Result<f64, Failure> {
    let value = parse_quantity(text, &Dimension::NONE).map_err(|fault| bad(key, text, &fault.what, &fault.help))?;
    if value.is_finite() { Ok(value) } else { Err(bad(key, text, &not_finite(), &Text::default())) }
}

/// `name=quantity` pairs.
pub fn overrides(list: &[String]) -> Result<Vec<(String, String)>, Failure> {
    let split = |text: &String| {
        let (name, value) = text.split_once('=').ok_or_else(|| {
            let what = Text::new("there is no `=`", "нет знака `=`");
            let help = Text::new("write --set m=\"10 g\" or --set \"phi'=30\"", "пишите --set m=\"10 г\" или --set \"phi'=30\"");
            bad("--set", text, &what, &help)
        })?;
        Ok((name.trim().to_owned(), value.trim().to_owned()))
    };
    list.iter().map(split).collect()
}

/// Refuses a number without a unit where the file uses another unit than the SI one.
fn has_unit(key: &str, text: &str, (number, unit): (&str, Option<&String>)) -> Result<(), Failure> {
    let bare = mechanics::units::parse_number_or_quantity(number).is_ok_and(|q| !q.has_unit && q.to_f64() != 0.0);
    let Some(unit) = unit.filter(|_| bare) else { return Ok(()) };
    let unit = Text::unit(unit);
    let what = Text::new(
        format!("a number without a unit, while the file gives it in {}", unit.en),
        format!("число без единицы, хотя в файле величина задана в {}", unit.ru),
    );
    let help = Text::new(format!("write the unit: {number} {}", unit.en), format!("напишите единицу: {number} {}", unit.ru));
    Err(bad(key, text, &what, &help))
}

/// `phi=0.1` pairs for coordinates of a model.
pub fn guess(list: &[String], machine: &studies::pipeline::Machine) -> Result<Vec<(symbolic::SymbolId, f64)>, Failure> {
    coordinates("--guess", list, machine)
}

/// A parameter, a start or a starting rate between two values: `m=2 g..60 g`.
pub fn stretch(key: &str, text: &str, machine: &studies::pipeline::Machine) -> Result<mechanics::model::SweepRange, Failure> {
    let told = |notice: Notice| bad(key, text, &notice.message.what, &notice.message.help);
    mechanics::sweep_stretch(&machine.model, text).map_err(told)
}

/// Values of coordinates, given by this key of the command line.
fn coordinates(key: &str, list: &[String], machine: &studies::pipeline::Machine) -> Result<Vec<(symbolic::SymbolId, f64)>, Failure> {
    let mut found = Vec::new();
    for text in list {
        let (name, value) = text.split_once('=').unwrap_or((text, ""));
        let Some(coordinate) = machine.model.coordinates.iter().find(|c| c.name == name.trim()) else {
            let names: Vec<&str> = machine.model.coordinates.iter().map(|c| c.name.as_str()).collect();
            let what = Text::new(format!("`{}` is no coordinate", name.trim()), format!("`{}` — не координата", name.trim()));
            let list = names.join(", ");
            let help =
                Text::new(format!("write name=value with one of: {list}"), format!("напишите имя=значение, где имя одно из: {list}"));
            return Err(bad(key, text, &what, &help));
        };
        let dimension = mechanics::units::parse_unit(&coordinate.units[0]).map(|u| u.dimension).unwrap_or(Dimension::NONE);
        has_unit(key, text, (value.trim(), machine.model.scaled.get(&coordinate.name)))?;
        let value = parse_quantity(value.trim(), &dimension).map_err(|fault| bad(key, text, &fault.what, &fault.help))?;
        if !value.is_finite() {
            return Err(bad(key, text, &not_finite(), &Text::default()));
        }
        found.push((coordinate.symbols[0], value));
    }
    Ok(found)
}

/// The ends of a parameter's range in its unit.
pub fn parameter_range(name: &str, text: &str, machine: &studies::pipeline::Machine) -> Result<[f64; 2], Failure> {
    let Some(parameter) = machine.model.parameters.iter().find(|p| p.name == name) else {
        let what = Text::new(format!("`{name}` is no parameter"), format!("`{name}` — не параметр"));
        return Err(bad("--over", name, &what, &Text::default()));
    };
    let dimension = mechanics::units::parse_unit(&parameter.unit).map(|u| u.dimension).unwrap_or(Dimension::NONE);
    let separator = if text.contains(';') { ';' } else { ',' };
    let read = |end: &str| parse_quantity(end.trim(), &dimension).map_err(|fault| bad("--range", text, &fault.what, &fault.help));
    for end in text.split(separator) {
        has_unit("--range", text, (end.trim(), machine.model.scaled.get(name)))?;
    }
    let values = text.split(separator).map(read).collect::<Result<Vec<f64>, Failure>>()?;
    match values[..] {
        [from, to] if from < to && to.is_finite() => Ok([from, to]),
        _ => {
            let what = Text::new("two values are needed, the first smaller", "нужны два значения, первое меньше второго");
            Err(bad("--range", text, &what, &Text::default()))
        }
    }
}

/// Two ascending quantities, each with its unit where the file uses one that is not the SI one.
pub fn ends(key: &str, texts: &[String], dimension: &Dimension, scaled: Option<&String>) -> Result<Vec<f64>, Failure> {
    let all = texts.join(" ");
    texts.iter().try_for_each(|text| has_unit(key, &all, (text.trim(), scaled)))?;
    let values = texts.iter().map(|text| quantity(key, text.trim(), dimension)).collect::<Result<Vec<f64>, Failure>>()?;
    match values[..] {
        [from, to] if from < to => Ok(values),
        _ => {
            let what = Text::new("two values are needed, the first smaller", "нужны два значения, первое меньше второго");
            Err(bad(key, &all, &what, &Text::default()))
        }
    }
}

/// Numbers of results.
pub fn observed(key: &str, texts: &[String]) -> Result<Vec<String>, Failure> {
    let read = |text: &String| mechanics::asked::observed::observed(text).map_err(|fault| bad(key, text, &fault.what, &fault.help));
    texts.iter().map(|text| read(text).map(|_| text.clone())).collect()
}

/// What is no coordinate, with those that there are.
pub fn no_coordinate(key: &str, name: &str, machine: &studies::pipeline::Machine) -> Failure {
    let names: Vec<&str> = machine.model.coordinates.iter().map(|c| c.name.as_str()).collect();
    let what = Text::new(format!("`{name}` is no coordinate"), format!("`{name}` — не координата"));
    let help = Text::new(format!("one of: {}", names.join(", ")), format!("одна из: {}", names.join(", ")));
    bad(key, name, &what, &help)
}

/// The ends of a coordinate's range, `-180 deg,180 deg`.
pub fn between(name: &str, text: &str, machine: &studies::pipeline::Machine) -> Result<[f64; 2], Failure> {
    let separator = if text.contains(';') { ';' } else { ',' };
    let ends: Vec<String> = text.split(separator).map(|end| format!("{}={}", name, end.trim())).collect();
    let values = coordinates("--range", &ends, machine)?;
    match values[..] {
        [(_, from), (_, to)] if from < to => Ok([from, to]),
        _ => {
            let what = Text::new("two values are needed, the first smaller", "нужны два значения, первое меньше второго");
            Err(bad("--range", text, &what, &Text::default()))
        }
    }
}

/// What are no two frequencies.
pub fn no_band(key: &str, text: &str) -> Failure {
    let what = Text::new("two frequencies are needed, the first smaller", "нужны две частоты, первая меньше второй");
    let help = Text::new("write --range 1,100 (rad/s)", "напишите --range 1,100 (рад/с)");
    bad(key, text, &what, &help)
}

fn not_finite() -> Text {
    Text::new("the value is not finite", "значение не конечно")
}

fn bad(key: &str, text: &str, what: &Text, help: &Text) -> Failure {
    let trouble = Notice::new("C009", format!("{key} {text}: {}", what.en), format!("{key} {text}: {}", what.ru));
    trouble.help(help.en.clone(), help.ru.clone()).misuse()
}
