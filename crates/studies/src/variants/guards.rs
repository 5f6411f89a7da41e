//! What speaks against a variant: conditions that it breaks, resonance that is near, other variants with the same answers.

use super::solve::Solved;
use crate::machine::Machine;
use crate::watch::Watch;
use mechanics::asked::Asked;
use mechanics::model::{AnswerDecl, Tolerance};
use serde_json::Value;

/// Share of the natural frequency within which a load is near resonance.
const NEAR: f64 = 0.15;

/// The conditions of the file that do not hold, by name and as written. A condition without a value does not hold.
pub fn broken(machine: &Machine, solved: &Solved) -> Vec<(String, String)> {
    let model = &machine.model;
    let requirements = model.variants.iter().flat_map(|v| &v.require);
    let value = |e| model.graph.evaluate(&[e], &|s| solved.known.get(&s).copied().unwrap_or(f64::NAN))[0];
    requirements.filter(|r| value(r.holds) != 1.0).map(|r| (r.name.clone(), r.text.clone())).collect()
}

/// A load near resonance: its frequency and the natural one, rad/s. Machines without harmonic load have none.
pub fn near_resonance(machine: &mut Machine, solved: &Solved) -> Option<[f64; 2]> {
    let found = match solved.results.iter().find(|r| r.kind == crate::response::KIND.name) {
        Some(found) => found.clone(),
        None => {
            let study = machine.origin.studies.find(crate::response::KIND.name)?;
            study.run(machine, &Asked::new(study.kind().name), &mut Watch::default()).filter(|r| r.trouble.is_none())?
        }
    };
    let load = found.own.get("at_frequency")?.get("omega")?.as_f64()?;
    let natural = found.own.get("modes")?.as_array()?.iter().filter_map(|m| m.get("omega").and_then(Value::as_f64));
    let distance = |omega: f64| (load / omega - 1.0).abs();
    let nearest = natural.filter(|omega| *omega > 0.0).min_by(|a, b| distance(*a).total_cmp(&distance(*b)))?;
    (distance(nearest) < NEAR).then_some([load, nearest])
}

/// Half the width of what counts as right about `(right number, size of its quantity)`. A share of zero is nothing: where zero is right, the share is one
/// of the size that the quantity has elsewhere.
pub fn allowed(answer: &AnswerDecl, (truth, size): (f64, f64)) -> f64 {
    match answer.tolerance {
        Tolerance::Relative(share) if truth == 0.0 => share * size,
        Tolerance::Relative(share) => share * truth.abs(),
        Tolerance::Absolute(size) => size / answer.unit.factor,
    }
}

/// Whether a number is the right one within the tolerance.
pub fn within(a: f64, right: (f64, f64), answer: &AnswerDecl) -> bool {
    // rounding of the sum may not decide
    (a - right.0).abs() <= allowed(answer, right) * (1.0 + 1e-9)
}

/// Groups of variants that cannot be told apart by their answers, by place.
pub fn twins(truths: &[Vec<Option<f64>>], answers: &[AnswerDecl]) -> Vec<Vec<usize>> {
    let alike = |i: usize, j: usize| {
        let pair = |(k, answer): (usize, &AnswerDecl)| match (truths[i].get(k), truths[j].get(k)) {
            (Some(Some(a)), Some(Some(b))) => within(*a, (*b, 0.0), answer) && within(*b, (*a, 0.0), answer),
            _ => false,
        };
        !answers.is_empty() && answers.iter().enumerate().all(pair)
    };
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for j in 0..truths.len() {
        match groups.iter_mut().find(|group| alike(group[0], j)) {
            Some(group) => group.push(j),
            None => groups.push(vec![j]),
        }
    }
    groups.retain(|group| group.len() > 1);
    groups
}

#[cfg(test)]
mod tests {
    use super::*;
    use mechanics::model::{AnswerUnit, AnswerValue};
    use mechanics::units::Dimension;
    use words::Text;

    fn item(tolerance: Tolerance) -> AnswerDecl {
        let mut graph = symbolic::Graph::new();
        AnswerDecl {
            id: "a".into(),
            symbol: graph.symbol_id("a", 0),
            ask: Text::default(),
            value: AnswerValue::Formula { value: graph.zero(), factor: 1.0 },
            unit: AnswerUnit { label: String::new(), factor: 1.0, dimension: Dimension::NONE },
            tolerance,
            gives: None,
            span: 0..0,
            value_span: 0..0,
        }
    }

    #[test]
    fn twins_are_those_whose_answers_all_agree() {
        let items = [item(Tolerance::Relative(0.01)), item(Tolerance::Absolute(0.5))];
        let some = |list: &[f64]| list.iter().map(|v| Some(*v)).collect::<Vec<_>>();
        let truths = [some(&[100.0, 1.0]), some(&[100.5, 1.4]), some(&[100.0, 2.0]), vec![None, Some(1.0)], some(&[102.0, 1.0])];
        assert_eq!(twins(&truths, &items), [vec![0, 1]]);
        assert!(twins(&truths, &[]).is_empty());
    }

    #[test]
    fn the_edge_of_a_tolerance_is_inside() {
        assert!(within(1.01, (1.0, 0.0), &item(Tolerance::Relative(0.01))));
        assert!(!within(1.0101, (1.0, 0.0), &item(Tolerance::Relative(0.01))));
        assert!(within(0.0, (0.0, 0.0), &item(Tolerance::Relative(0.01))));
    }

    #[test]
    fn a_share_of_zero_is_one_of_the_size_of_its_quantity() {
        let item = item(Tolerance::Relative(0.01));
        assert!(within(0.02, (0.0, 2.0), &item) && !within(0.021, (0.0, 2.0), &item));
        assert!(within(-0.02, (0.0, 2.0), &item) && !within(1e-12, (0.0, 0.0), &item));
        // other numbers keep their own share
        assert!(!within(1.5, (1.0, 100.0), &item));
    }
}
