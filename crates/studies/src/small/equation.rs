//! The frequency equation as text with exact coefficients.

use crate::machine::Machine;
use crate::small::Small;
use crate::small::formulas::at_place;
use mechanics::model::{FrequencyVariable, ParameterValue};
use symbolic::{Expr, Linear, Rational, Substitution, SymbolId};

/// det(C - ω² M) = 0 in a variable.
#[derive(Clone, Debug, PartialEq)]
pub struct FrequencyEquation {
    /// The letter of the unknown.
    pub variable: String,
    /// What it stands for: `omega^2`, or the user's formula.
    pub meaning: Expr,
    /// Coefficients, beginning with the constant.
    pub coefficients: Vec<Rational>,
    /// `504 z^3 - 729 z^2 + 94 z - 1 = 0`.
    pub text: String,
}

/// Integers up to so many digits are written out.
const DIGITS: usize = 10;

/// The equation when all data are rational (or become so in the user's variable).
pub fn find(machine: &Machine, small: &Small, variable: Option<&FrequencyVariable>) -> Option<(FrequencyEquation, Linear)> {
    let mut linear = exact(machine, small)?;
    let mut map = Substitution::new(numbers(machine));
    let factor = match variable {
        // the study's formula belongs to the graph of the model, of which that of the equations is an extension
        Some(v) => Some(map.apply(&mut linear.graph, v.factor)),
        None => None,
    };
    if let Some(factor) = factor {
        for i in 0..linear.stiffness.rows() {
            for j in 0..linear.stiffness.columns() {
                let e = linear.graph.mul(linear.stiffness.get(i, j), factor);
                linear.stiffness.set(i, j, e);
            }
        }
    }
    let coefficients = symbolic::characteristic(&linear.graph, &linear.stiffness, &linear.mass)?;
    let name = variable.map_or("z", |v| v.name.as_str()).to_owned();
    let text = write(&coefficients, &name, if variable.is_some() { Digits::Whole } else { Digits::Shortest });
    let one = linear.graph.one();
    Some((FrequencyEquation { variable: name, meaning: factor.unwrap_or(one), coefficients, text }, linear))
}

/// M and C with exact numbers for parameters and coordinates; none when an equilibrium is not exactly known.
fn exact(machine: &Machine, small: &Small) -> Option<Linear> {
    let mut linear = at_place(&machine.equations, small)?;
    // definitions are formulas over parameters and earlier definitions
    for (symbol, formula) in linear.definitions.clone().into_iter().rev() {
        linear = linear.at(&[(symbol, formula)]);
    }
    Some(linear.at(&numbers(machine)))
}

/// Exact values of parameters with a number.
fn numbers(machine: &Machine) -> Vec<(SymbolId, Expr)> {
    let number = |p: &mechanics::model::ParameterDecl| match p.value {
        ParameterValue::Number { si } => Some((p.symbol, si)),
        ParameterValue::Formula(_) => None,
    };
    // a number that was found has no exact form, nor one of a frame that was computed and not given: its binary digits are no data
    let computed = |p: &mechanics::model::ParameterDecl| p.span.is_none() && p.written.is_empty();
    let known = |p: &&mechanics::model::ParameterDecl| !machine.model.unknowns.contains(&p.symbol) && !computed(p);
    machine.model.parameters.iter().filter(known).filter_map(number).collect()
}

/// How coefficients are written.
#[derive(Clone, Copy, PartialEq)]
enum Digits {
    /// As whole numbers.
    Whole,
    /// As decimals where these are shorter.
    Shortest,
}

/// Highest power first. In the user's variable whole numbers; in ω² decimals with the leading coefficient 1 when these are shorter.
fn write(coefficients: &[Rational], name: &str, digits: Digits) -> String {
    let longest = coefficients.iter().map(|c| c.digits().0.len()).max().unwrap_or(0);
    let lead = coefficients.last().and_then(Rational::recip);
    let decimals = || lead.as_ref().and_then(|lead| coefficients.iter().map(|c| decimal(&(c * lead))).collect::<Option<Vec<_>>>());
    let list = if digits == Digits::Whole || longest <= DIGITS { None } else { decimals() };
    let list = list.unwrap_or_else(|| coefficients.iter().map(|c| (c.is_negative(), c.abs().digits().0)).collect());
    let mut out = String::new();
    for (power, (negative, digits)) in list.iter().enumerate().rev() {
        if digits == "0" {
            continue;
        }
        let sign = match (out.is_empty(), negative) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => " + ",
            (false, true) => " - ",
        };
        out.push_str(sign);
        let letter = match power {
            0 => String::new(),
            1 => name.to_owned(),
            _ => format!("{name}^{power}"),
        };
        match (digits == "1" && power > 0, power) {
            (true, _) => out.push_str(&letter),
            (false, 0) => out.push_str(digits),
            (false, _) => out.push_str(&format!("{digits} {letter}")),
        }
    }
    out + " = 0"
}

/// Sign and digits of a terminating decimal of moderate length.
fn decimal(r: &Rational) -> Option<(bool, String)> {
    let magnitude = r.abs();
    for places in 0..=16usize {
        let scaled = &magnitude * &Rational::from(10).pow(places as i64)?;
        if !scaled.is_integer() {
            continue;
        }
        let mut digits = scaled.digits().0;
        if digits.len() > 17 {
            return None;
        }
        if places > 0 {
            digits = format!("{digits:0>width$}", width = places + 1);
            digits.insert(digits.len() - places, '.');
        }
        return Some((r.is_negative(), digits));
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equations_read_as_textbooks_have_them() {
        let list = |v: &[i64]| v.iter().map(|c| Rational::from(*c)).collect::<Vec<_>>();
        assert_eq!(write(&list(&[-1, 94, -729, 504]), "z", Digits::Whole), "504 z^3 - 729 z^2 + 94 z - 1 = 0");
        assert_eq!(write(&list(&[0, -3, 1]), "z", Digits::Whole), "z^2 - 3 z = 0");
        let long = [Rational::from(961_234_567_890_123), Rational::from(-39_240_000_000_000), Rational::from(1_000_000_000_000)];
        assert_eq!(write(&long, "z", Digits::Shortest), "z^2 - 39.24 z + 961.234567890123 = 0");
    }
}
