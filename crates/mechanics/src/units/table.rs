//! The table of units: names in both alphabets, exact factors, which take prefixes.

use super::Dimension;
use algebra::elementary;
use symbolic::{Expr, Graph, Rational};

/// An exact conversion factor: number · π^pi.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Factor {
    /// The rational part.
    pub number: Rational,
    /// The power of π (degrees, revolutions).
    pub pi: i32,
}

impl Factor {
    /// One.
    pub const ONE: Factor = Factor { number: Rational::ONE, pi: 0 };

    /// The factor as an expression.
    pub fn expr(&self, graph: &mut Graph) -> Expr {
        let pi = graph.pi();
        graph.monomial(self.number.clone(), &[(pi, i64::from(self.pi).into())])
    }
    /// The nearest machine number.
    pub fn to_f64(&self) -> f64 {
        self.number.to_f64() * elementary::powi(std::f64::consts::PI, self.pi)
    }
}

/// A unit: one of it is `factor` SI units of `dimension`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Unit {
    /// SI value of one such unit.
    pub factor: Factor,
    /// Dimension.
    pub dimension: Dimension,
}

impl Unit {
    /// The unit of pure numbers.
    pub const ONE: Unit = Unit { factor: Factor::ONE, dimension: Dimension::NONE };
    /// Whether a number in this unit is another number in SI; parts of one (%) are numbers by themselves.
    pub(crate) fn is_scaled(&self) -> bool {
        self.factor != Factor::ONE && (!self.dimension.is_none() || self.dimension.is_angular())
    }
}

/// A row of the table.
struct Row {
    /// Latin names, the first is the usual one.
    latin: &'static [&'static str],
    /// Cyrillic names, the first is the usual one.
    cyrillic: &'static [&'static str],
    /// SI value as a decimal literal or a fraction of two.
    factor: &'static str,
    /// Power of π in the factor.
    pi: i32,
    dimension: Dimension,
    /// Whether SI prefixes apply.
    prefixed: bool,
}

const fn row(latin: &'static [&'static str], cyrillic: &'static [&'static str], factor: &'static str, dimension: Dimension) -> Row {
    Row { latin, cyrillic, factor, pi: 0, dimension, prefixed: false }
}
/// A unit with prefixes.
const fn prefixed(latin: &'static [&'static str], cyrillic: &'static [&'static str], factor: &'static str, dimension: Dimension) -> Row {
    Row { prefixed: true, ..row(latin, cyrillic, factor, dimension) }
}
const fn angle(latin: &'static [&'static str], cyrillic: &'static [&'static str], factor: &'static str, dimension: Dimension) -> Row {
    Row { latin, cyrillic, factor, pi: 1, dimension, prefixed: false }
}

/// A word that is not decided by the table alone is decided by order: whole names win over prefix and name (`min` is a minute).
const ROWS: &[Row] = &[
    prefixed(&["m"], &["м"], "1", Dimension::LENGTH),
    prefixed(&["g"], &["г"], "0.001", Dimension::MASS),
    prefixed(&["s", "sec"], &["с", "сек"], "1", Dimension::TIME),
    prefixed(&["A"], &["А"], "1", Dimension::base(3)),
    prefixed(&["K"], &["К"], "1", Dimension::base(4)),
    prefixed(&["mol"], &["моль"], "1", Dimension::base(5)),
    prefixed(&["cd"], &["кд"], "1", Dimension::base(6)),
    prefixed(&["rad"], &["рад"], "1", Dimension::ANGLE),
    angle(&["deg", "°"], &["град"], "1/180", Dimension::ANGLE),
    angle(&["arcmin"], &[], "1/10800", Dimension::ANGLE),
    angle(&["arcsec"], &[], "1/648000", Dimension::ANGLE),
    angle(&["rev", "turn", "r"], &["об"], "2", Dimension::ANGLE),
    angle(&["rpm"], &[], "1/30", Dimension::ANGULAR_RATE),
    prefixed(&["N"], &["Н"], "1", Dimension::FORCE),
    prefixed(&["J"], &["Дж"], "1", Dimension::ENERGY),
    prefixed(&["W"], &["Вт"], "1", Dimension::POWER),
    prefixed(&["Pa"], &["Па"], "1", Dimension::of(-1, 1, -2)),
    prefixed(&["Hz"], &["Гц"], "1", Dimension::FREQUENCY),
    row(&["t"], &["т"], "1000", Dimension::MASS),
    row(&["min"], &["мин"], "60", Dimension::TIME),
    row(&["h"], &["ч", "час"], "3600", Dimension::TIME),
    row(&["day", "d"], &["сут"], "86400", Dimension::TIME),
    prefixed(&["l", "L"], &["л"], "0.001", Dimension::of(3, 0, 0)),
    prefixed(&["bar"], &["бар"], "100000", Dimension::of(-1, 1, -2)),
    row(&["atm"], &["атм"], "101325", Dimension::of(-1, 1, -2)),
    // 133.322387415 Pa: 13.5951 g/cm^3 times 9.80665 m/s^2 times 1 mm
    row(&["mmHg"], &[], "133.322387415", Dimension::of(-1, 1, -2)),
    // one pound-force on a square inch
    row(&["psi"], &[], "4.4482216152605/0.00064516", Dimension::of(-1, 1, -2)),
    row(&["kgf"], &["кгс"], "9.80665", Dimension::FORCE),
    row(&["gf"], &["гс"], "0.00980665", Dimension::FORCE),
    row(&["tf"], &["тс"], "9806.65", Dimension::FORCE),
    // 550 foot-pounds per second, and 75 kgf m/s
    row(&["hp"], &[], "745.69987158227022", Dimension::POWER),
    row(&["PS"], &["л.с.", "лс"], "735.49875", Dimension::POWER),
    row(&["in"], &["дюйм"], "0.0254", Dimension::LENGTH),
    row(&["ft"], &["фут"], "0.3048", Dimension::LENGTH),
    row(&["lb"], &["фунт"], "0.45359237", Dimension::MASS),
    row(&["lbf"], &[], "4.4482216152605", Dimension::FORCE),
    row(&["%"], &[], "0.01", Dimension::NONE),
    prefixed(&["V"], &["В"], "1", Dimension::electric(2, 1, -3, -1)),
    prefixed(&["C"], &["Кл"], "1", Dimension::electric(0, 0, 1, 1)),
    prefixed(&["Ohm", "Ω"], &["Ом"], "1", Dimension::electric(2, 1, -3, -2)),
    prefixed(&["F"], &["Ф"], "1", Dimension::electric(-2, -1, 4, 2)),
    prefixed(&["H"], &["Гн"], "1", Dimension::electric(2, 1, -2, -2)),
    prefixed(&["Wb"], &["Вб"], "1", Dimension::electric(2, 1, -2, -1)),
    prefixed(&["T"], &["Тл"], "1", Dimension::electric(0, 1, -2, -1)),
];

const LATIN_PREFIXES: &[(&str, i64)] = &[
    ("da", 1),
    ("T", 12),
    ("G", 9),
    ("M", 6),
    ("k", 3),
    ("h", 2),
    ("d", -1),
    ("c", -2),
    ("m", -3),
    ("u", -6),
    ("µ", -6),
    ("μ", -6),
    ("n", -9),
    ("p", -12),
    ("f", -15),
];
const CYRILLIC_PREFIXES: &[(&str, i64)] = &[
    ("да", 1),
    ("мк", -6),
    ("Т", 12),
    ("Г", 9),
    ("М", 6),
    ("к", 3),
    ("г", 2),
    ("д", -1),
    ("с", -2),
    ("м", -3),
    ("н", -9),
    ("п", -12),
    ("ф", -15),
];

/// Prefixes with their powers of ten, Latin and Cyrillic, for the reference.
pub(crate) const PREFIXES: [&[(&str, i64)]; 2] = [LATIN_PREFIXES, CYRILLIC_PREFIXES];

/// A row of the table, for the reference.
pub(crate) struct Listed {
    pub names: Vec<&'static str>,
    pub value: String,
    pub value_ru: String,
    pub prefixed: bool,
}

/// Every unit, for the reference.
pub(crate) fn listed() -> Vec<Listed> {
    let row = |r: &Row| Listed {
        names: r.latin.iter().chain(r.cyrillic).copied().collect(),
        value: in_si(r, |label| label.to_owned()),
        value_ru: in_si(r, in_russian).replace('.', ","),
        prefixed: r.prefixed,
    };
    ROWS.iter().map(row).collect()
}

/// `0.001 kg`, `π/30 rad/s`, `0.01`.
fn in_si(r: &Row, print: impl Fn(&str) -> String) -> String {
    let number = match (r.pi, r.factor.split_once('/')) {
        (1, Some(("1", below))) => format!("π/{below}"),
        (1, _) => format!("{} π", r.factor),
        _ => r.factor.to_owned(),
    };
    match super::si_label(&r.dimension.without_periods()).as_str() {
        "1" => number,
        label if number == "1" && label.starts_with("1/") => print(label),
        label => format!("{number} {}", print(label)),
    }
}

/// A unit in Cyrillic letters as it is printed: `kg m^2` is `кг·м²`.
pub(crate) fn in_russian(label: &str) -> String {
    let powers = [("^2", "²"), ("^3", "³"), ("^4", "⁴"), (" ", "·")];
    powers.into_iter().fold(words::Text::unit(label).ru, |text, (from, to)| text.replace(from, to))
}

/// The unit of that name.
pub(super) fn find(name: &str) -> Option<Unit> {
    let exact = |r: &&Row| r.latin.contains(&name) || r.cyrillic.contains(&name);
    if let Some(row) = ROWS.iter().find(exact) {
        return Some(unit(row, 0));
    }
    let split = |prefixes: &[(&str, i64)], names: fn(&Row) -> &'static [&'static str]| {
        prefixes.iter().find_map(|(prefix, power)| {
            let rest = name.strip_prefix(prefix)?;
            ROWS.iter().find(|r| r.prefixed && names(r).contains(&rest)).map(|r| unit(r, *power))
        })
    };
    split(LATIN_PREFIXES, |r| r.latin).or_else(|| split(CYRILLIC_PREFIXES, |r| r.cyrillic))
}

fn unit(row: &Row, power: i64) -> Unit {
    let part = |text: &str| Rational::parse_decimal(text).unwrap_or_default();
    let number = match row.factor.split_once('/') {
        Some((above, below)) => &part(above) / &part(below),
        None => part(row.factor),
    };
    let scale = Rational::from(10).pow(power).unwrap_or(Rational::ONE);
    Unit { factor: Factor { number: &number * &scale, pi: row.pi }, dimension: row.dimension }
}

/// The known unit name nearest to a misspelt one, in the same alphabet where possible. Letters of one alphabet that look like those
/// of the other are tried first: `кg`, `H` for Н.
pub(super) fn nearest(name: &str) -> Option<String> {
    if name.chars().count() > 12 {
        return None;
    }
    for (from, to) in [(LOOKALIKE_LATIN, LOOKALIKE_CYRILLIC), (LOOKALIKE_CYRILLIC, LOOKALIKE_LATIN)] {
        let swapped: String =
            name.chars().map(|c| from.chars().position(|f| f == c).and_then(|i| to.chars().nth(i)).unwrap_or(c)).collect();
        if swapped != name && find(&swapped).is_some() {
            return Some(swapped);
        }
    }
    if name == "grad" {
        return Some("deg".to_owned());
    }
    let mut best: Option<(usize, String)> = None;
    let mut offer = |candidate: String| {
        let distance = words::half_slips(name, &candidate);
        if best.as_ref().is_none_or(|(d, _)| distance < *d) {
            best = Some((distance, candidate));
        }
    };
    for row in ROWS {
        for (names, prefixes) in [(row.latin, LATIN_PREFIXES), (row.cyrillic, CYRILLIC_PREFIXES)] {
            for n in names {
                offer((*n).to_owned());
                for (prefix, _) in prefixes.iter().filter(|_| row.prefixed) {
                    offer(format!("{prefix}{n}"));
                }
            }
        }
    }
    // `Nm` is two units run together
    let joined = name.char_indices().skip(1).map(|(i, _)| name.split_at(i)).find(|(a, b)| find(a).is_some() && find(b).is_some());
    if let Some((a, b)) = joined
        && (best.as_ref().is_none_or(|(d, _)| *d > 1) || find(a).is_some_and(|u| u.dimension == Dimension::FORCE))
    {
        return Some(format!("{a} {b}"));
    }
    let limit = if name.chars().count() <= 2 { 2 } else { 4 };
    best.filter(|(d, n)| *d <= limit && *d < 2 * n.chars().count()).map(|(_, n)| n)
}

const LOOKALIKE_LATIN: &str = "acekmopxyABCEHKMOPTX";
const LOOKALIKE_CYRILLIC: &str = "асекморхуАВСЕНКМОРТХ";

#[cfg(test)]
mod tests {
    use super::*;
    use words::Language;

    #[test]
    fn every_name_has_a_print_in_russian() {
        let is_latin = |text: &str| text.chars().any(|c| c.is_ascii_alphabetic());
        for row in ROWS {
            for name in row.latin {
                let alone = words::unit::print(name, Language::Ru);
                assert!(!is_latin(&alone), "{name}: {alone}");
                let prefixes = LATIN_PREFIXES.iter().filter(|_| row.prefixed);
                for (prefix, power) in prefixes {
                    let printed = words::unit::print(&format!("{prefix}{name}"), Language::Ru);
                    assert!(!is_latin(&printed), "{prefix}{name}: {printed}");
                    assert!(words::unit::PREFIXES.iter().any(|(label, .., p)| label == prefix && i64::from(*p) == *power), "{prefix}");
                }
            }
        }
    }
}
