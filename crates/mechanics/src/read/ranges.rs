//! Ranges of values: `v=linspace(1 m/s, 3 m/s, 21)`, `c=logspace(1 N/m, 1 kN/m, 4)`, `m=1 kg, 2 kg, 5 kg`.
//!
//! Commas separate; where a semicolon is found, semicolons do, and commas are decimal marks.

use crate::model::{Model, SweepRange};
use crate::units::{Dimension, parse_number_or_quantity, parse_unit, si_label, si_label_ru};
use algebra::elementary;
use algebra::random::Random;
use std::f64::consts::TAU;
use std::ops::Range as Span;
use words::{Notice, Place};

/// More values than this are a slip.
const MAX_VALUES: usize = 1_000_000;

/// A range as written; values in SI.
#[derive(Clone, Debug)]
pub(super) struct Range {
    pub name: String,
    pub values: Vec<f64>,
    /// Of the values with a unit, each as written: how a turning is counted is a matter of each value. Empty when all are bare numbers, which are SI.
    pub dimensions: Vec<Dimension>,
    /// The first value other than zero without a unit.
    bare: Option<String>,
    /// Where the name and the whole text stand, in bytes.
    pub named: Span<usize>,
    whole: Span<usize>,
}

impl Range {
    /// Whether the values have the dimension of what they are given to, and units where the file uses another unit than the SI one.
    pub(super) fn fits(&self, wanted: &Dimension, scaled: Option<&String>) -> Result<(), Notice> {
        if let (Some(unit), Some(number)) = (scaled, &self.bare) {
            return Err(super::parameters::without_unit(self.whole.clone(), (&self.name, unit), number));
        }
        if let Some(d) = self.dimensions.iter().find(|d| !d.same(wanted)) {
            let (en, ru) = (
                format!("the values are {}, but {} is {}", si_label(d), self.name, si_label(wanted)),
                format!("значения в {}, а {} — в {}", si_label_ru(d), self.name, si_label_ru(wanted)),
            );
            return Err(Notice::piece("M024", self.whole.clone(), en, ru));
        }
        // one value counts periods where another counts radians: whatever is wanted, one of them is meant otherwise
        let turning = self.dimensions.iter().find(|d| d.has_radians()).unwrap_or(wanted);
        let in_field = |wanted: &Dimension| self.dimensions.iter().find_map(|d| crate::units::in_field(d, wanted, self.whole.clone()));
        match in_field(wanted).or_else(|| in_field(turning)) {
            Some(fault) => Err(Notice { severity: words::Severity::Error, ..fault }),
            None => Ok(()),
        }
    }
}

/// A range for a parameter, a start or a starting rate of a model, as on the command line.
///
/// # Errors
/// The text is no range (M070), the model has no such name (M068), or the dimension is another (M024).
pub fn sweep_range(model: &Model, text: &str) -> Result<SweepRange, Notice> {
    of_model(model, parse(text)?)
}

/// The same between two values, `m=2 g..60 g`.
///
/// # Errors
/// As for a range.
pub fn sweep_stretch(model: &Model, text: &str) -> Result<SweepRange, Notice> {
    of_model(model, stretch(text)?)
}

fn of_model(model: &Model, range: Range) -> Result<SweepRange, Notice> {
    let parameter = model.parameters.iter().find(|p| p.name == range.name).map(|p| p.unit.as_str());
    let coordinate = || {
        let base = range.name.trim_end_matches('\'');
        let order = range.name.len() - base.len();
        let found = model.coordinates.iter().find(|c| c.name == base)?;
        found.units.get(order).filter(|_| order <= 1).map(String::as_str)
    };
    let Some(unit) = parameter.or_else(coordinate) else {
        let names = model.parameters.iter().map(|p| p.name.as_str()).chain(model.coordinates.iter().map(|c| c.name.as_str()));
        return Err(unknown_name(&range.name, range.named.clone(), words::nearest(&range.name, names)));
    };
    if let Ok(unit) = parse_unit(unit) {
        range.fits(&unit.dimension, model.scaled.get(&range.name))?;
    }
    Ok(SweepRange { name: range.name, values: range.values })
}

/// The fault of a name that cannot be given other values.
pub(super) fn unknown_name(name: &str, span: Span<usize>, near: Option<&str>) -> Notice {
    let shown = crate::reader::short(name);
    let fault = Notice::piece(
        "M068",
        span,
        format!("the model has no parameter or coordinate `{shown}`"),
        format!("в модели нет параметра или координаты `{shown}`"),
    );
    match near {
        Some(near) => fault.meant(name, near),
        None => fault,
    }
}

/// Reads a range.
pub(super) fn parse(text: &str) -> Result<Range, Notice> {
    let whole = 0..text.len();
    let Some((name, list)) = text.split_once('=').filter(|(name, _)| !name.trim().is_empty()) else {
        return Err(no_range(whole));
    };
    let start = name.len() - name.trim_start().len();
    let (name, list) = (name.trim().to_owned(), list.trim());
    let named = start..start + name.len();
    let (kind, inner) = match list.strip_suffix(')').and_then(|l| l.split_once('(')) {
        Some((kind, inner)) => (kind.trim(), inner),
        None => ("", list),
    };
    let inner = inner.trim_matches(['[', ']']);
    let separator = if inner.contains(';') { ';' } else { ',' };
    if inner.contains("..") {
        return Err(no_range(whole));
    }
    let items: Vec<&str> = inner.split(separator).map(str::trim).collect();
    let mut dimensions = Vec::new();
    let values = match (kind, items.as_slice()) {
        ("linspace", [from, to, count]) => {
            let ends = two([from, to], &mut dimensions, &whole)?;
            evenly(ends, number_of(count, &whole)?)
        }
        ("logspace", [from, to, count]) => {
            let ends = two([from, to], &mut dimensions, &whole)?;
            by_factors(ends, number_of(count, &whole)?, &whole)?
        }
        ("uniform", [from, to, count, seed]) => {
            let ends = two([from, to], &mut dimensions, &whole)?;
            uniform(ends, number_of(count, &whole)?, seed_of(seed, &whole)?)
        }
        ("normal", [mean, deviation, count, seed]) => {
            let both = two([mean, deviation], &mut dimensions, &whole)?;
            normal(both, number_of(count, &whole)?, seed_of(seed, &whole)?)
        }
        ("", items) => {
            if separator == ',' && decimal_comma(inner, items) {
                return Err(comma(whole));
            }
            items.iter().map(|item| quantity(item, &mut dimensions, &whole)).collect::<Result<Vec<f64>, Notice>>()?
        }
        _ => return Err(no_range(whole)),
    };
    let given = if kind.is_empty() { items.len() } else { 2 };
    let is_bare = |item: &&str| parse_number_or_quantity(item).is_ok_and(|q| !q.has_unit && q.to_f64() != 0.0);
    let bare = items.iter().take(given).copied().find(|item| is_bare(item)).map(str::to_owned);
    Ok(Range { name, values, dimensions, bare, named, whole })
}

/// Reads a stretch, `m=2 g..60 g`: its two ends, the first smaller.
pub(super) fn stretch(text: &str) -> Result<Range, Notice> {
    let whole = 0..text.len();
    let no_stretch = || {
        Notice::piece("M070", whole.clone(), "this is no stretch between two values", "это не промежуток между двумя значениями")
            .help("write \"m=2 g..60 g\", the smaller value first", "напишите \"m=2 г..60 г\", меньшее значение первым")
    };
    let parts = text.split_once('=').and_then(|(name, ends)| Some((name, ends.split_once("..").or_else(|| ends.split_once('…'))?)));
    let Some((name, (from, to))) = parts.filter(|(name, _)| !name.trim().is_empty()) else { return Err(no_stretch()) };
    let start = name.len() - name.trim_start().len();
    let name = name.trim().to_owned();
    let mut dimensions = Vec::new();
    let values = two([from, to], &mut dimensions, &whole)?;
    if values[0] >= values[1] {
        return Err(no_stretch());
    }
    let is_bare = |item: &&str| parse_number_or_quantity(item).is_ok_and(|q| !q.has_unit && q.to_f64() != 0.0);
    let bare = [from.trim(), to.trim()].into_iter().find(|item| is_bare(item)).map(str::to_owned);
    let named = start..start + name.len();
    Ok(Range { name, values: values.to_vec(), dimensions, bare, named, whole })
}

/// Whether a comma between two digits leaves a bare number beside values with units: `1,5 kg, 2 kg`.
fn decimal_comma(list: &str, items: &[&str]) -> bool {
    let digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
    let tight = list.match_indices(',').any(|(at, _)| digit(list[..at].chars().next_back()) && digit(list[at + 1..].chars().next()));
    let units = |item: &&str| parse_number_or_quantity(item).map(|q| q.has_unit);
    let found = || items.iter().map(units);
    tight && found().any(|u| u == Ok(true)) && found().any(|u| u == Ok(false))
}

fn comma(whole: Span<usize>) -> Notice {
    Notice::piece(
        "M070",
        whole,
        "a comma between digits: is it a decimal mark, or does it separate values?",
        "запятая между цифрами: это десятичный знак или разделитель значений?",
    )
    .help(
        "separate with semicolons (`1,5 kg; 2 kg`), or write points (`1.5 kg, 2 kg`)",
        "разделяйте точкой с запятой (`1,5 кг; 2 кг`) или пишите точки (`1.5 кг, 2 кг`)",
    )
}

fn two([from, to]: [&str; 2], dimensions: &mut Vec<Dimension>, whole: &Span<usize>) -> Result<[f64; 2], Notice> {
    Ok([quantity(from, dimensions, whole)?, quantity(to, dimensions, whole)?])
}

/// A quantity of the same dimension as the ones before it.
fn quantity(text: &str, dimensions: &mut Vec<Dimension>, whole: &Span<usize>) -> Result<f64, Notice> {
    let quantity = parse_number_or_quantity(text).map_err(|fault| Notice { place: Place::Piece(whole.clone()), ..fault })?;
    let own = quantity.unit.dimension;
    if let Some(first) = dimensions.first().filter(|first| quantity.has_unit && !first.same(&own)) {
        let (a, b) = (si_label(first), si_label(&own));
        let (a_ru, b_ru) = (si_label_ru(first), si_label_ru(&own));
        return Err(Notice::piece(
            "M025",
            whole.clone(),
            format!("the values differ in dimension: {a} and {b}"),
            format!("значения разной размерности: {a_ru} и {b_ru}"),
        ));
    }
    if quantity.has_unit && !dimensions.contains(&own) {
        dimensions.push(own);
    }
    let value = quantity.to_f64();
    if value.is_finite() { Ok(value) } else { Err(crate::units::out_of_range(whole.clone())) }
}

fn number_of(text: &str, whole: &Span<usize>) -> Result<usize, Notice> {
    text.parse().ok().filter(|n| (2..=MAX_VALUES).contains(n)).ok_or_else(|| {
        Notice::piece(
            "M070",
            whole.clone(),
            format!("`{}` is no number of values: 2 ... {MAX_VALUES}", crate::reader::short(text)),
            format!("`{}` — не число значений: от 2 до {MAX_VALUES}", crate::reader::short(text)),
        )
    })
}

fn seed_of(text: &str, whole: &Span<usize>) -> Result<u64, Notice> {
    text.parse().map_err(|_| {
        Notice::piece(
            "M070",
            whole.clone(),
            format!("`{}` is no seed: a whole number that is not negative", crate::reader::short(text)),
            format!("`{}` — не начальное число датчика: нужно целое неотрицательное", crate::reader::short(text)),
        )
    })
}

/// Values drawn between two ends, each of them as likely; the same seed gives the same values.
fn uniform([from, to]: [f64; 2], count: usize, seed: u64) -> Vec<f64> {
    let mut random = Random::new(seed);
    (0..count).map(|_| random.between(from, to)).collect()
}

/// Values with a normal distribution: z = sqrt(-2 ln u) cos 2 pi v, of pairs of numbers 0 < u <= 1 and 0 <= v < 1.
///
/// *Source*: G. E. P. Box, M. E. Muller, A note on the generation of random normal deviates, Ann. Math. Stat. 29 (1958) 610.
fn normal([mean, deviation]: [f64; 2], count: usize, seed: u64) -> Vec<f64> {
    let mut random = Random::new(seed);
    let mut one = || {
        let (u, v) = (1.0 - random.between(0.0, 1.0), random.between(0.0, TAU));
        mean + deviation * (-2.0 * elementary::ln(u)).sqrt() * elementary::cos(v)
    };
    (0..count).map(|_| one()).collect()
}

/// Values at equal distances.
fn evenly([from, to]: [f64; 2], count: usize) -> Vec<f64> {
    between([from, to], count, |part| from + (to - from) * part)
}

/// Values at equal ratios.
fn by_factors([from, to]: [f64; 2], count: usize, whole: &Span<usize>) -> Result<Vec<f64>, Notice> {
    if !(from > 0.0 && to > 0.0) {
        return Err(Notice::piece("M070", whole.clone(), "logspace needs positive ends", "у logspace концы положительны"));
    }
    let at = |part: f64| elementary::exp(elementary::ln(from) + (elementary::ln(to) - elementary::ln(from)) * part);
    Ok(between([from, to], count, at))
}

/// Values at equal parts of the way, both ends exactly as written.
fn between([from, to]: [f64; 2], count: usize, at: impl Fn(f64) -> f64) -> Vec<f64> {
    let last = count - 1;
    #[allow(clippy::cast_precision_loss)]
    let value = |i: usize| match i {
        0 => from,
        i if i == last => to,
        _ => at(i as f64 / last as f64),
    };
    (0..count).map(value).collect()
}

fn no_range(span: Span<usize>) -> Notice {
    Notice::piece("M070", span, "this is no range of values", "это не набор значений").help(
        "write \"v=linspace(1 m/s, 3 m/s, 21)\", \"v=logspace(1 N/m, 1 kN/m, 4)\", \"m=1 kg, 2 kg\", \"m=uniform(1 kg, 2 kg, 100, 7)\" or \"m=normal(1 kg, 0.1 kg, 100, 7)\" (mean, deviation, number, seed)",
        "напишите \"v=linspace(1 м/с, 3 м/с, 21)\", \"c=logspace(1 Н/м, 1 кН/м, 4)\", \"m=1 кг, 2 кг\", \"m=uniform(1 кг, 2 кг, 100, 7)\" или \"m=normal(1 кг, 0.1 кг, 100, 7)\" (среднее, отклонение, число, начальное число датчика)",
    )
}

#[cfg(test)]
mod tests {
    use super::{parse, stretch};

    #[test]
    fn ranges_hit_both_ends_exactly() {
        let range = parse("v=linspace(1 m/s, 3 m/s, 21)").unwrap();
        assert_eq!((range.name.as_str(), range.values.len(), range.values[0], range.values[20]), ("v", 21, 1.0, 3.0));
        // a step of linspace: the last place
        assert!((range.values[1] - 1.1).abs() < 1e-15);
        assert_eq!(parse("c = logspace(1 N/m; 1 kN/m; 4)").unwrap().values[3], 1000.0);
        assert_eq!(parse("m=1,5 kg; 2 kg").unwrap().values, [1.5, 2.0]);
        assert_eq!(parse("phi'=[0.1, 0.2]").unwrap().name, "phi'");
    }

    /// Mean and deviation of 20 000 draws, each within five times its own deviation; the seed decides.
    #[test]
    fn draws_have_their_distribution_and_repeat() {
        let n = 20_000;
        for (text, mean, deviation) in
            [("m=uniform(1 kg, 3 kg, 20000, 7)", 2.0, 1.0 / 3.0_f64.sqrt()), ("m=normal(5 kg, 0.5 kg, 20000, 7)", 5.0, 0.5)]
        {
            let values = parse(text).unwrap().values;
            assert_eq!(values, parse(text).unwrap().values);
            assert_ne!(values, parse(&text.replace(", 7)", ", 8)")).unwrap().values);
            let (count, sum) = (f64::from(n), values.iter().sum::<f64>());
            let spread = (values.iter().map(|v| (v - sum / count) * (v - sum / count)).sum::<f64>() / count).sqrt();
            assert!(values.len() == 20_000 && (sum / count - mean).abs() < 5.0 * deviation / count.sqrt(), "{text}: {}", sum / count);
            // the deviation of a deviation is less than that of a mean
            assert!((spread - deviation).abs() < 5.0 * deviation / count.sqrt(), "{text}: {spread}");
        }
        for text in ["m=uniform(1 kg, 3 kg, 20)", "m=normal(1 kg, 3 kg, 20, -1)", "m=normal(1 kg, 3 s, 20, 1)"] {
            assert!(parse(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_stretch_has_two_ascending_ends() {
        let range = stretch("m = 2 g..60 g").unwrap();
        assert_eq!((range.name.as_str(), range.values), ("m", vec![0.002, 0.06]));
        for (text, code) in [("m=2 g", "M070"), ("m=2 g..1 g", "M070"), ("=1..2", "M070"), ("m=1 g..2 s", "M025")] {
            assert_eq!(stretch(text).err().map(|f| f.code), Some(code), "{text}");
        }
    }

    #[test]
    fn what_is_no_range_is_refused() {
        for (text, code) in [
            ("v", "M070"),
            ("=1", "M070"),
            ("v=linspace(1, 2)", "M070"),
            ("v=linspace(1, 2, 1)", "M070"),
            ("v=linspace(1, 2, 99999999999999)", "M070"),
            ("v=logspace(0, 2, 3)", "M070"),
            ("v=range(0, 2, 3)", "M070"),
            ("v=linspace(1 m, 2 s, 3)", "M025"),
            ("v=1 kq", "M021"),
            ("v=", "M020"),
        ] {
            assert_eq!(parse(text).err().map(|f| f.code), Some(code), "{text}");
        }
    }
}
