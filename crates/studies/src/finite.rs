//! The last gate of every study: no number that is infinite or undefined leaves with exit code 0 unless the study says what it means.
//!
//! A study states such values by [`analysis::dataset::Stated`] (an amplitude at an undamped resonance is infinite, a phase of nothing is none), a fact by
//! its words. Whatever else is not finite overflowed on the way, and the study fails with S077. Least and greatest values that leave out a row belong to
//! another quantity: S083.

use crate::Results;
use crate::pipeline::Finding;
use analysis::Dataset;
use words::Notice;

/// The finding as it may leave: with a trouble where a number has no value and nobody says why.
pub fn checked(mut finding: Finding) -> Finding {
    if finding.trouble().is_some() {
        return finding;
    }
    if let Some(name) = finding.data().outside_extremes() {
        let trouble = Notice::from(analysis::fault::outside_extremes(name));
        finding.fail(trouble);
        return finding;
    }
    if let Some(name) = unexplained(&finding) {
        let trouble = Notice::from(analysis::fault::no_value(&name));
        finding.fail(trouble);
    }
    finding
}

/// Name of a number that is infinite or undefined without a word.
pub fn unexplained(finding: &Finding) -> Option<String> {
    let fact = match finding {
        Finding::Study(results) => of_facts(results),
        _ => None,
    };
    fact.or_else(|| of_data(finding.data()))
}

fn of_facts(results: &Results) -> Option<String> {
    let silent = results.facts.iter().find(|f| !f.value.is_finite() && f.words.en.is_empty());
    silent.map(|f| f.quantity.name.clone())
}

fn of_data(data: &Dataset) -> Option<String> {
    let parameter = || data.provenance.parameters.iter().find(|p| !p.value.is_finite()).map(|p| p.quantity.name.clone());
    data.unexplained().map(str::to_owned).or_else(parameter)
}
