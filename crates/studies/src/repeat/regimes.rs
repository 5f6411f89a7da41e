//! The regime of a motion, by the conditions of the file.

use super::wanted::Noted;
use crate::machine::Machine;
use analysis::Quantity;
use words::Notice;

/// The numbers that the conditions ask for, each once.
///
/// # Errors
/// The file has no regimes (S147).
pub fn numbers(machine: &Machine) -> Result<Vec<String>, Notice> {
    let mut texts: Vec<String> = Vec::new();
    for (text, _) in machine.model.regimes.iter().flat_map(|regime| &regime.numbers) {
        if !texts.contains(text) {
            texts.push(text.clone());
        }
    }
    if texts.is_empty() {
        return Err(Notice::new("S147", "the file names no regimes", "в файле не заданы режимы").help(
            "add [regimes] with a condition: fast = \"mean(phi', 20 s, 30 s) > 250 [rad/s]\"",
            "добавьте [regimes] с условием: fast = \"mean(phi', 20 с, 30 с) > 250 [рад/с]\"",
        ));
    }
    Ok(texts)
}

/// Which regime it is with these values of the numbers: the first whose condition holds, counted from 0; their number where none does.
pub fn which(machine: &Machine, numbers: &[(String, f64)]) -> usize {
    let regimes = &machine.model.regimes;
    let parameter = |symbol| machine.equations.parameters.iter().find(|p| p.symbol == symbol).map_or(f64::NAN, |p| p.value);
    let holds = |regime: &mechanics::model::RegimeDecl| {
        let number = |symbol| {
            let text = regime.numbers.iter().find(|(_, s)| *s == symbol).map(|(text, _)| text);
            text.and_then(|text| numbers.iter().find(|(t, _)| t == text)).map(|(_, value)| *value)
        };
        let value = |symbol| number(symbol).unwrap_or_else(|| parameter(symbol));
        machine.model.graph.evaluate(&[regime.holds], &value).first().is_some_and(|v| *v == 1.0)
    };
    regimes.iter().position(holds).unwrap_or(regimes.len())
}

/// The name of a regime by its number; none behind the last.
pub fn name(machine: &Machine, which: usize) -> Option<&str> {
    machine.model.regimes.get(which).map(|regime| regime.name.as_str())
}

/// Whether the numbers of all conditions are among those that are noted.
pub(crate) fn are_noted(machine: &Machine, noted: &[Noted]) -> bool {
    let regimes = &machine.model.regimes;
    let is_noted = |text: &String| noted.iter().any(|(_, wanted)| wanted.to_string() == *text);
    !regimes.is_empty() && regimes.iter().flat_map(|regime| &regime.numbers).all(|(text, _)| is_noted(text))
}

/// The regime of a study whose numbers are these; none where the file has no regimes, or one of their numbers is not noted or has no value; a number of events may have no end.
pub fn of(machine: &Machine, noted: &[Noted], found: &[(f64, Option<Quantity>)]) -> Option<usize> {
    let numbers: Vec<(String, f64)> = noted.iter().zip(found).map(|((_, wanted), (value, _))| (wanted.to_string(), *value)).collect();
    let known = |text: &String| numbers.iter().any(|(own, value)| own == text && !value.is_nan());
    let regimes = &machine.model.regimes;
    (!regimes.is_empty() && regimes.iter().flat_map(|regime| &regime.numbers).all(|(text, _)| known(text)))
        .then(|| which(machine, &numbers))
}
