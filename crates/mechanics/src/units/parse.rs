//! Reading units (`N m s/rad`, `кг·м²`) and quantities (`12,5 кг`, `-27 N m`, `30°`).
//!
//! A unit is a product: factors stand side by side or with `*` or `·` between; `/` applies to the next factor only, so `N m/s/rad` has
//! two divisors, and parentheses group. A number is exact; its decimal mark is a point or a comma, groups of three digits may be set
//! off by spaces.

use super::table::{find, nearest};
use super::{Dimension, Factor, Unit};
use std::ops::Range;
use symbolic::{Expr, Graph, Rational};
use words::Notice;

/// A number with a unit.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Quantity {
    /// The number as written.
    pub number: Rational,
    /// The unit.
    pub unit: Unit,
    /// Whether a unit was written at all.
    pub has_unit: bool,
}

impl Quantity {
    /// A pure number.
    pub fn pure(number: Rational) -> Quantity {
        Quantity { number, unit: Unit::ONE, has_unit: false }
    }
    /// The exact value in SI.
    pub fn si(&self, graph: &mut Graph) -> Expr {
        let factor = self.unit.factor.expr(graph);
        graph.scale(factor, &self.number)
    }
    /// The nearest machine number of the value in SI.
    pub fn to_f64(&self) -> f64 {
        Factor { number: &self.number * &self.unit.factor.number, pi: self.unit.factor.pi }.to_f64()
    }
}

/// Whether a string is a number with or without a unit rather than a formula: a number, then nothing but what units are made of.
pub(crate) fn is_quantity(text: &str) -> bool {
    let text = text.trim();
    let Some((_, end)) = scan_number(text) else { return false };
    let rest = &text[end..];
    let first = rest.trim_start().chars().next();
    let starts_unit = match first {
        None => true,
        Some('1' | '(') => rest.starts_with(char::is_whitespace),
        Some(c) => c.is_alphabetic() || "°%".contains(c),
    };
    // `30 rad/s^2 * t` is a formula that lacks brackets around its unit, not a quantity in tonnes: a tonne comes first or not at all
    let words = rest.split(|c: char| !c.is_alphanumeric()).filter(|w| !w.is_empty());
    let time = words.skip(1).any(|w| w == "t");
    let mut previous = ' ';
    starts_unit
        && !time
        && rest.chars().all(|c| {
            let fits = c.is_alphanumeric() || " \u{a0}\u{202f}\u{2009}\t*·⋅×/^().°%⁻".contains(c) || c == '-' && "^(".contains(previous);
            if !c.is_whitespace() {
                previous = c;
            }
            fits
        })
}

/// Reads a quantity whose dimension is known, as on the command line: a bare number counts as SI.
///
/// # Errors
/// What is no quantity, or one of another dimension.
pub fn parse_quantity(text: &str, expected: &Dimension) -> Result<f64, Notice> {
    let quantity = parse_number_or_quantity(text)?;
    let dimension = quantity.unit.dimension;
    if quantity.has_unit && !dimension.same(expected) {
        return Err(super::fit::mismatch_of_number(0..text.len(), &dimension, expected));
    }
    if let Some(fault) = super::fit::in_field(&dimension, expected, 0..text.len()) {
        return Err(Notice { severity: words::Severity::Error, ..fault });
    }
    Ok(quantity.to_f64())
}

/// Reads an angular rate: periods per second (Hz, 1/min) become radians per second; a bare number is in rad/s.
///
/// # Errors
/// The text is no quantity, or none of that dimension.
pub fn parse_angular_rate(text: &str) -> Result<f64, Notice> {
    let value = parse_quantity(text, &Dimension::ANGULAR_RATE.without_angle())?;
    let quantity = parse_number_or_quantity(text)?;
    Ok(if quantity.unit.dimension.counts_periods() { std::f64::consts::TAU * value } else { value })
}

/// Reads `number` or `number unit`.
///
/// # Errors
/// M020: no number; those of [`parse_unit`].
pub fn parse_number_or_quantity(text: &str) -> Result<Quantity, Notice> {
    let start = text.len() - text.trim_start().len();
    let body = text.trim();
    let Some((number, end)) = scan_number(body) else {
        return Err(Notice::piece("M020", 0..text.len(), "expected a number with a unit", "ожидается число с единицей")
            .help("write for example \"12.5 kg\" or \"1450 rpm\"", "напишите, например, \"12,5 кг\" или \"1450 об/мин\""));
    };
    let number = number.ok_or_else(|| out_of_range(start..start + end))?;
    let rest = &body[end..];
    if rest.trim().is_empty() {
        return Ok(Quantity::pure(number));
    }
    let unit = parse_unit(rest).map_err(|fault| fault.shifted(start + end))?;
    let quantity = Quantity { number, unit, has_unit: true };
    let value = quantity.to_f64();
    if !value.is_finite() || value == 0.0 && !quantity.number.is_zero() {
        return Err(out_of_range(0..text.len()));
    }
    Ok(quantity)
}

/// The unit behind the number that a text begins with, as written: `mm` of `-5.2e3 mm` and of `5 [mm]`.
pub(crate) fn written_unit(text: &str) -> Option<&str> {
    let body = text.trim();
    let (_, end) = scan_number(body)?;
    Some(body[end..].trim().trim_start_matches('[').trim_end_matches(']').trim()).filter(|unit| parse_unit(unit).is_ok())
}

/// A warning for `1,450 rpm`: with a Latin unit and exactly three digits behind it the comma may group thousands.
pub(crate) fn doubtful_comma(text: &str) -> Option<Notice> {
    let body = text.trim();
    let (whole, rest) = body.split_once(',')?;
    let digits = rest.len() - rest.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    let signless = whole.trim_start_matches(['+', '-', '−']);
    let counts = (1..=3).contains(&signless.len()) && signless.bytes().all(|b| b.is_ascii_digit()) && !signless.starts_with('0');
    let unit = rest[digits..].trim_start();
    let latin = unit.starts_with(|c: char| c.is_ascii_alphabetic()) && unit.is_ascii();
    (counts && digits == 3 && latin && is_quantity(text)).then(|| {
        let (number, grouped) = (format!("{whole}.{}", &rest[..digits]), format!("{whole}{}", &rest[..digits]));
        Notice::piece(
            "M142",
            0..text.len(),
            format!("the comma is read as a decimal mark: {number}, not {grouped}"),
            format!("запятая читается как десятичная: `{number}`, а не `{grouped}`"),
        )
        .help(format!("write `{number} {unit}` or `{grouped} {unit}`"), format!("напишите `{number} {unit}` или `{grouped} {unit}`"))
        .warning()
    })
}

/// The fault of a number beyond what machine numbers hold.
pub(crate) fn out_of_range(span: Range<usize>) -> Notice {
    Notice::piece(
        "M022",
        span,
        "the number is out of range: its size must lie between 1e-307 and 1e308",
        "число вне допустимых пределов: по модулю от 1e-307 до 1e308",
    )
    .why("the exponent is probably a slip", "вероятно, описка в показателе степени")
    .help("choose a unit with a prefix and a number of moderate size", "возьмите единицу с приставкой и число умеренной величины")
}

/// The exact value of a decimal literal when machine numbers hold it.
pub(crate) fn bounded_decimal(digits: &str) -> Option<Rational> {
    let value = if digits.len() <= 400 { Rational::parse_decimal(digits) } else { None }?;
    let machine = value.to_f64();
    (machine.is_finite() && (machine != 0.0 || value.is_zero())).then_some(value)
}

/// The number a text begins with and where it ends; the inner `None` when it is out of range.
fn scan_number(text: &str) -> Option<(Option<Rational>, usize)> {
    let mut digits = String::new();
    let mut at = 0;
    for (sign, written) in [("+", ""), ("-", "-"), ("−", "-")] {
        if let Some(rest) = text.strip_prefix(sign) {
            digits.push_str(written);
            at = text.len() - rest.len();
            break;
        }
    }
    let bytes = text.as_bytes();
    let signed = digits.len();
    let first = scan_digits(text, at);
    digits.push_str(&text[at..first]);
    at = first;
    while let Some(next) = digit_group(text, at) {
        digits.push_str(&text[next - 3..next]);
        at = next;
    }
    if matches!(bytes.get(at), Some(b'.' | b',')) {
        let end = scan_digits(text, at + 1);
        if end > at + 1 || digits.len() > signed {
            digits.push('.');
            digits.push_str(&text[at + 1..end]);
            at = end;
        }
    }
    if digits.len() == signed {
        return None;
    }
    if matches!(bytes.get(at), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(at + 1), Some(b'+' | b'-')));
        let end = scan_digits(text, at + 1 + sign);
        if end > at + 1 + sign {
            digits.push_str(&text[at..end]);
            at = end;
        }
    }
    if let Some((power, end)) = scan_power_of_ten(text, at) {
        digits.push_str(&format!("e{power}"));
        at = end;
    }
    Some((bounded_decimal(&digits), at))
}

fn scan_digits(text: &str, from: usize) -> usize {
    from + text.as_bytes()[from.min(text.len())..].iter().take_while(|b| b.is_ascii_digit()).count()
}

/// The end of a group of exactly three digits after one space: `1 450`.
fn digit_group(text: &str, at: usize) -> Option<usize> {
    if at == 0 || !text.as_bytes()[at - 1].is_ascii_digit() {
        return None;
    }
    let space = text[at..].chars().next().filter(|c| " \u{a0}\u{202f}\u{2009}".contains(*c))?;
    let from = at + space.len_utf8();
    let end = scan_digits(text, from);
    (end == from + 3).then_some(end)
}

/// `·10^-3`, `·10⁻³`.
fn scan_power_of_ten(text: &str, at: usize) -> Option<(i32, usize)> {
    let rest = text[at..].trim_start().strip_prefix(['·', '⋅', '×', '*'])?.trim_start().strip_prefix("10")?;
    if let Some(rest) = rest.strip_prefix('^') {
        let digits = rest.len() - rest.trim_start_matches(['-', '+']).len();
        let end = scan_digits(rest, digits);
        let power = rest[..end].parse().ok()?;
        return Some((power, text.len() - rest.len() + end));
    }
    let (power, length) = superscript(rest)?;
    Some((power, text.len() - rest.len() + length))
}

/// A superscript whole number at the start and its length in bytes.
pub(crate) fn superscript(text: &str) -> Option<(i32, usize)> {
    let mut digits = String::new();
    let mut length = 0;
    for c in text.chars() {
        let plain = match c {
            '⁻' if digits.is_empty() => '-',
            '⁰' => '0',
            '¹' => '1',
            '²' => '2',
            '³' => '3',
            '⁴'..='⁹' => char::from_digit(c as u32 - '⁴' as u32 + 4, 10)?,
            _ => break,
        };
        digits.push(plain);
        length += c.len_utf8();
    }
    digits.parse().ok().map(|n| (n, length))
}

/// Reads a unit: `N m s/rad`, `kg*m^2`, `кг·м²`, `1/s`, `m^(1/2)`.
///
/// # Errors
/// M021: what is no unit.
pub fn parse_unit(text: &str) -> Result<Unit, Notice> {
    if text.len() > 200 {
        return Err(Notice::piece("M021", 0..text.len(), "this unit is longer than 200 bytes", "обозначение единицы длиннее 200 байт"));
    }
    let mut parser = Parser { text, at: 0, depth: 0 };
    let unit = parser.product()?;
    parser.skip_space();
    if parser.at < text.len() {
        return Err(parser.unexpected());
    }
    Ok(per_minute(unit))
}

/// `1/min`, `1/h`: nobody measures an angular rate in radians per minute, so these count turns or periods, as `Hz` does. `1/s` may
/// be either and stays what it is.
fn per_minute(unit: Unit) -> Unit {
    let (above, below) = unit.factor.number.digits();
    let minutes = above == "1" && below.parse::<u64>().is_ok_and(|n| n % 60 == 0);
    let rate = unit.dimension.is_of_time() && unit.dimension.pow(&Rational::MINUS_ONE).is_some_and(|d| d.is_duration());
    if minutes && rate { Unit { dimension: unit.dimension.in_periods(), ..unit } } else { unit }
}

struct Parser<'a> {
    text: &'a str,
    at: usize,
    depth: usize,
}

impl Parser<'_> {
    fn peek(&self) -> Option<char> {
        self.text[self.at..].chars().next()
    }
    fn skip_space(&mut self) {
        let rest = &self.text[self.at..];
        self.at += rest.len() - rest.trim_start().len();
    }
    fn take(&mut self, wanted: &[char]) -> bool {
        self.skip_space();
        let found = self.peek().filter(|c| wanted.contains(c));
        self.at += found.map_or(0, char::len_utf8);
        found.is_some()
    }
    fn unexpected(&self) -> Notice {
        let found = self.peek().map_or_else(|| "?".to_owned(), |c| c.to_string());
        let end = self.at + self.peek().map_or(0, char::len_utf8);
        let before = &self.text[..self.at];
        if self.peek().is_some_and(|c| c.is_ascii_digit()) && before.ends_with(char::is_alphabetic) {
            let word = before.len() - before.chars().rev().take_while(|c| c.is_alphabetic()).map(char::len_utf8).sum::<usize>();
            let (unit, power) = (&before[word..], &found);
            return Notice::piece("M021", word..end, format!("`{unit}{power}` is no unit"), format!("`{unit}{power}` — не единица"))
                .help(format!("write the power as `{unit}^{power}`"), format!("степень пишут так: `{unit}^{power}`"));
        }
        Notice::piece("M021", self.at..end, format!("unexpected `{found}` in a unit"), format!("лишний знак `{found}` в единице")).help(
            "units look like `N m s/rad`, `kg*m^2`, `m/s^2`; a formula needs its units in square brackets: `30 [rad/s^2] * t`",
            "единицы пишут так: `Н м с/рад`, `кг·м²`, `м/с^2`; в формуле единицы стоят в квадратных скобках: `30 [рад/с^2] * t`",
        )
    }
    fn product(&mut self) -> Result<Unit, Notice> {
        let mut unit = self.factor()?;
        loop {
            let from = self.at;
            let divide = self.take(&['/']);
            if !divide {
                self.take(&['*', '·', '⋅', '×']);
            }
            self.skip_space();
            if !divide && (self.peek().is_none() || self.peek() == Some(')')) {
                return Ok(unit);
            }
            let next = self.factor()?;
            let next = if divide { raise(&next, &Rational::MINUS_ONE) } else { Some(next) };
            unit = next.and_then(|n| times(&unit, &n)).ok_or_else(|| too_big(from..self.at))?;
        }
    }
    fn factor(&mut self) -> Result<Unit, Notice> {
        self.skip_space();
        let from = self.at;
        let base = self.atom()?;
        let exponent = self.exponent()?;
        match exponent {
            None => Ok(base),
            Some(e) => raise(&base, &e).ok_or_else(|| too_big(from..self.at)),
        }
    }
    fn atom(&mut self) -> Result<Unit, Notice> {
        let from = self.at;
        if self.take(&['(']) {
            self.depth += 1;
            if self.depth > 16 {
                return Err(self.unexpected());
            }
            let unit = self.product()?;
            self.depth -= 1;
            return if self.take(&[')']) { Ok(unit) } else { Err(self.unexpected()) };
        }
        if self.text[from..].starts_with('1') && !self.text[from + 1..].starts_with(|c: char| c.is_alphanumeric() || c == '.') {
            self.at += 1;
            return Ok(Unit::ONE);
        }
        let end = from + word_length(&self.text[from..]);
        if end == from {
            return Err(self.unexpected());
        }
        self.at = end;
        let name = &self.text[from..end];
        if let Some(fault) = celsius(name, &self.text[end..], from) {
            return Err(fault);
        }
        find(name).ok_or_else(|| unknown(name, from..end))
    }
    fn exponent(&mut self) -> Result<Option<Rational>, Notice> {
        if let Some((n, length)) = superscript(&self.text[self.at..]) {
            self.at += length;
            return Ok(Some(i64::from(n).into()));
        }
        let rest = self.text[self.at..].trim_start();
        let Some(rest) = rest.strip_prefix("**").or_else(|| rest.strip_prefix('^')) else { return Ok(None) };
        self.at = self.text.len() - rest.trim_start().len();
        let rest = &self.text[self.at..];
        let (inner, length) = match rest.strip_prefix('(') {
            Some(inner) => inner.split_once(')').map(|(inner, _)| (inner, inner.len() + 2)).ok_or_else(|| self.unexpected())?,
            None => {
                let signed = rest.len() - rest.trim_start_matches(['-', '+']).len();
                let length = rest[signed..].bytes().take_while(|b| b.is_ascii_digit() || *b == b'.').count() + signed;
                (&rest[..length], length)
            }
        };
        let exponent = fraction(inner).ok_or_else(|| self.unexpected())?;
        self.at += length;
        Ok(Some(exponent))
    }
}

/// Letters of a unit name; `л.с.` keeps its points.
fn word_length(text: &str) -> usize {
    if text.starts_with("л.с.") {
        return "л.с.".len();
    }
    if let Some(c) = text.chars().next().filter(|c| "°%".contains(*c)) {
        return c.len_utf8();
    }
    text.find(|c: char| !c.is_alphabetic()).unwrap_or(text.len())
}

fn fraction(text: &str) -> Option<Rational> {
    let number = |t: &str| if t.trim().len() > 10 { None } else { Rational::parse_decimal(t.trim()) };
    match text.split_once('/') {
        Some((above, below)) => Some(&number(above)? * &number(below)?.recip()?),
        None => number(text),
    }
}

fn times(a: &Unit, b: &Unit) -> Option<Unit> {
    let factor = Factor { number: &a.factor.number * &b.factor.number, pi: a.factor.pi.checked_add(b.factor.pi)? };
    bounded(Unit { factor, dimension: a.dimension.mul(&b.dimension)? })
}

/// unit^exponent when its factor stays exact.
fn raise(unit: &Unit, exponent: &Rational) -> Option<Unit> {
    let dimension = unit.dimension.pow(exponent)?;
    let number = match exponent.to_i64() {
        Some(n) => unit.factor.number.pow(n)?,
        None => {
            let (above, below) = exponent.digits();
            unit.factor.number.root(below.parse().ok().filter(|d| *d <= 12)?)?.pow(above.parse().ok()?)?
        }
    };
    let pi = &Rational::from(i64::from(unit.factor.pi)) * exponent;
    let factor = Factor { number, pi: i32::try_from(pi.to_i64()?).ok()? };
    bounded(Unit { factor, dimension })
}

fn bounded(unit: Unit) -> Option<Unit> {
    let size = unit.factor.to_f64();
    (size.is_finite() && size != 0.0).then_some(unit)
}

fn too_big(span: Range<usize>) -> Notice {
    Notice::piece(
        "M021",
        span,
        "this power of a unit is out of bounds or has no exact factor",
        "такая степень единицы недопустима или не имеет точного множителя",
    )
}

/// `20 °C` is no angle times a charge.
fn celsius(name: &str, rest: &str, from: usize) -> Option<Notice> {
    let scale = rest.trim_start().chars().next().filter(|c| "CСF".contains(*c))?;
    let letters = rest.trim_start().chars().take_while(|c| c.is_alphabetic()).count();
    (name == "°" && letters == 1).then(|| {
        Notice::piece(
            "M021",
            from..from + name.len() + (rest.len() - rest.trim_start().len()) + scale.len_utf8(),
            format!("°{scale} has a zero of its own and is no unit of a quantity"),
            format!("у °{scale} свой нуль, это не единица величины"),
        )
        .help("give the temperature, or the difference of temperatures, in K", "задайте температуру или разность температур в К")
    })
}

fn unknown(name: &str, span: Range<usize>) -> Notice {
    let fault = Notice::piece("M021", span, format!("unknown unit `{name}`"), format!("неизвестная единица `{name}`"));
    match nearest(name) {
        Some(near) => fault.help(format!("did you mean `{near}`?"), format!("может быть, `{near}`?")),
        None => fault.help(
            "if a product is meant, write `*`: `2*x`; the known units are listed in docs/model-file/units.md",
            "если это произведение, поставьте `*`: `2*x`; список единиц — в docs/model-file/units.ru.md",
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::super::si_label;
    use super::*;

    fn si(text: &str) -> (f64, String) {
        let q = parse_number_or_quantity(text).unwrap_or_else(|f| panic!("{text}: {f:?}"));
        (q.to_f64(), si_label(&q.unit.dimension))
    }

    #[test]
    fn quantities_in_both_alphabets_mean_the_same() {
        for (text, value, label) in [
            ("20 g", 0.02, "kg"),
            ("12,5 кг", 12.5, "kg"),
            ("-27 N m", -27.0, "N m"),
            ("−27 Н·м", -27.0, "N m"),
            ("1e-4 N m s", 1e-4, "N m s"),
            ("400 kN/m", 4e5, "N/m"),
            ("400 кН/м", 4e5, "N/m"),
            ("4 cm^2", 4e-4, "m^2"),
            ("4 см²", 4e-4, "m^2"),
            ("1 kgf", 9.80665, "N"),
            ("1 кгс", 9.80665, "N"),
            ("2 т", 2000.0, "kg"),
            ("10 МПа", 1e7, "Pa"),
            ("3 мПа", 3e-3, "Pa"),
            ("5 min", 300.0, "s"),
            ("5 мин", 300.0, "s"),
            ("2 ч", 7200.0, "s"),
            ("50 Гц", 50.0, "Hz"),
            ("1 л.с.", 735.49875, "W"),
            ("5 1/s", 5.0, "1/s"),
            ("5", 5.0, "1"),
            ("1 450 кг", 1450.0, "kg"),
            ("1,2·10⁻³ кг", 1.2e-3, "kg"),
            ("1.2*10^-3 kg", 1.2e-3, "kg"),
            ("2 kg*m**2", 2.0, "kg m^2"),
            ("25 N s/m", 25.0, "N s/m"),
            ("30 rad/s^2", 30.0, "rad/s^2"),
            ("2 мкм", 2e-6, "m"),
            ("0.5 (N m)/(rad/s)", 0.5, "N m s"),
        ] {
            assert_eq!(si(text), (value, label.to_owned()), "{text}");
            assert!(is_quantity(text), "{text}");
        }
    }

    #[test]
    fn revolutions_per_minute_are_exact() {
        let mut graph = Graph::new();
        for text in ["1450 rpm", "1450 об/мин", "1450 rev/min"] {
            let value = parse_number_or_quantity(text).unwrap().si(&mut graph);
            let pi = graph.pi();
            let exact = graph.scale(pi, &Rational::new(145, 3).unwrap());
            assert_eq!(value, exact, "{text}");
        }
        for text in ["15 deg", "15°", "15 град"] {
            let value = parse_number_or_quantity(text).unwrap().si(&mut graph);
            let pi = graph.pi();
            let exact = graph.scale(pi, &Rational::new(1, 12).unwrap());
            assert_eq!(value, exact, "{text}");
        }
    }

    #[test]
    fn division_applies_to_the_next_factor_only() {
        assert_eq!(si("1 N m/s rad").1, "W");
        assert_eq!(si("1 m/s/s").1, "m/s^2");
    }

    #[test]
    fn formulas_are_not_quantities() {
        for text in ["2*pi", "2 - x", "1/2", "m", "-x", "", "2 [m]*x", "x'", "20 g + 5 g", "2^3", "sin(x)", "30 [rad/s^2] * t"] {
            assert!(!is_quantity(text), "{text}");
        }
    }

    #[test]
    fn misspelt_units_get_the_nearest() {
        for (text, near) in [("5 кq", "к"), ("5 Кг", "кг"), ("5 кg", ""), ("5 Nm", "N m"), ("5 rmp", "rpm"), ("5 раd", "рад")] {
            let fault = parse_number_or_quantity(text).unwrap_err();
            assert_eq!(fault.code, "M021");
            assert!(fault.help.en.contains(near), "{text}: {}", fault.help.en);
        }
    }

    #[test]
    fn hostile_quantities_are_refused() {
        for text in ["1e999 m", "1e-999 m", "1 m^1e9", "1 m^99999", "5 km^200", "1 (((((((((((((((((((m", "3 /m/", "2 m^(1/0)", "1e308 km"]
        {
            assert!(parse_number_or_quantity(text).is_err(), "{text}");
        }
    }
}
