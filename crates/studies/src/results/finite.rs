//! The last gate of every study: no number that is infinite or undefined leaves with exit code 0 unless the study says what it means.
//!
//! A study states such values by [`analysis::dataset::Stated`] (an amplitude at an undamped resonance is infinite, a phase of nothing is none), a fact by
//! its words. Whatever else is not finite overflowed on the way, and the study fails with S077. Least and greatest values that leave out a row belong to
//! another quantity: S083.

use super::Results;
use analysis::Dataset;
use words::Notice;

/// The results as they may leave: with a trouble where a number has no value and nobody says why.
pub fn checked(mut results: Results) -> Results {
    if results.trouble.is_some() {
        return results;
    }
    if let Some(name) = results.data.outside_extremes() {
        let trouble = Notice::from(analysis::fault::outside_extremes(name));
        results.fail(trouble);
        return results;
    }
    if let Some(name) = unexplained(&results) {
        results.fail(Notice::from(analysis::fault::no_value(&name)));
    }
    results
}

/// Name of a number that is infinite or undefined without a word.
fn unexplained(results: &Results) -> Option<String> {
    of_facts(results).or_else(|| of_data(&results.data))
}

fn of_facts(results: &Results) -> Option<String> {
    let silent = results.facts.iter().find(|f| !f.value.is_finite() && f.words.en.is_empty());
    silent.map(|f| f.quantity.name.clone())
}

fn of_data(data: &Dataset) -> Option<String> {
    let parameter = || data.provenance.parameters.iter().find(|p| !p.value.is_finite()).map(|p| p.quantity.name.clone());
    data.unexplained().map(str::to_owned).or_else(parameter)
}
