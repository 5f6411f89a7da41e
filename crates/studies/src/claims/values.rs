//! Values of the motion, of the equilibrium and of modes.

use super::laid::{Laid, output_name};
use super::verdict::Verdict;
use crate::equilibrium::Between;
use crate::machine::Machine;
use crate::machine::study::of_file;
use crate::small::asked::Modes;
use crate::watch::Watch;
use analysis::studies::simulate::{Grid, Kept, Simulate, simulate};
use analysis::{Dataset, System};
use mechanics::model::{ClaimDecl, ClaimInstant, ClaimKind};
use words::Text;

/// Judges the claims of values among those that can be judged, by number.
pub fn judge(
    machine: &mut Machine,
    laid: &mut Laid,
    (claims, judged, verdicts): (&[ClaimDecl], &[usize], &mut [Verdict]),
    watch: &mut Watch,
) {
    let mut asked: Vec<(usize, f64)> = Vec::new();
    let mut resting: Vec<usize> = Vec::new();
    for &i in judged {
        match &claims[i].kind {
            ClaimKind::Value { at: ClaimInstant::At(t), .. } => asked.push((i, *t)),
            ClaimKind::Value { at: ClaimInstant::Rest, .. } => resting.push(i),
            _ => {}
        }
    }
    motion(laid, &asked, verdicts);
    rest(machine, laid, (&resting, claims), verdicts, watch);
    for (claim, verdict) in claims.iter().zip(verdicts) {
        if let ClaimKind::Value { published, .. } | ClaimKind::Frequency { published, .. } = &claim.kind {
            verdict.published = *published;
            let difference = (verdict.value - published).abs();
            verdict.deviation = if verdict.value == 0.0 { difference } else { difference / verdict.value.abs() };
            // half a digit is half a digit: rounding of the product may not decide
            let (off, of) = if claim.stated { (verdict.deviation, 1.0) } else { (difference, published.abs()) };
            // half a digit is half a digit: rounding of the product may not decide
            verdict.ok = off <= claim.tolerance * of * (1.0 + 1e-12);
        }
    }
}

/// Values at instants of one motion.
fn motion(laid: &mut Laid, asked: &[(usize, f64)], verdicts: &mut [Verdict]) {
    let Some(until) = asked.iter().map(|a| a.1).reduce(f64::max) else { return };
    let names: Vec<String> = asked.iter().map(|(i, _)| output_name(*i, 0)).collect();
    let times: Vec<f64> = asked.iter().map(|a| a.1).collect();
    let pushes = crate::plan::pushes(&laid.machine.model, &laid.machine.equations);
    let options = Simulate { grid: Grid::At(times.clone()), outputs: Some(names), pushes, kept: Kept::Numbers, ..Simulate::until(until) };
    let system = &mut laid.machine.system;
    let outcome = system.start().map(|start| simulate(system, &start, options));
    let outcome = match outcome {
        Ok(outcome) => outcome,
        Err(fault) => return say(asked.iter().map(|a| a.0), verdicts, &fault.what),
    };
    if let Some(fault) = &outcome.fault {
        say(asked.iter().map(|a| a.0), verdicts, &fault.what);
    }
    let data = &outcome.dataset;
    let axis = data.axis.and_then(|i| data.columns.get(i)).map(|c| c.values.clone()).unwrap_or_default();
    for (i, t) in asked {
        let row = axis.iter().rposition(|x| x == t);
        let column = data.column(&output_name(*i, 0));
        verdicts[*i].value = row.and_then(|r| column?.values.get(r).copied()).unwrap_or(f64::NAN);
    }
}

/// Values in equilibrium: of several, the one nearest to what is published.
fn rest(machine: &Machine, laid: &mut Laid, (resting, claims): (&[usize], &[ClaimDecl]), verdicts: &mut [Verdict], watch: &mut Watch) {
    if resting.is_empty() {
        return;
    }
    let asked = of_file(machine, &[crate::equilibrium::KIND.name]).cloned().unwrap_or_default();
    let finding = crate::equilibrium::places(&mut laid.machine, asked.guess(), Between::of(&asked), watch);
    if let Some(trouble) = &finding.trouble {
        return say(resting.iter().copied(), verdicts, &trouble.what);
    }
    let rows = observed(laid, &finding.data);
    let places: Vec<Option<usize>> = resting.iter().map(|i| output(laid, &output_name(*i, 0))).collect();
    for (&i, place) in resting.iter().zip(places) {
        let ClaimKind::Value { published, .. } = claims[i].kind else { continue };
        let distance = |v: &f64| (v - published).abs();
        let values = rows.iter().filter_map(|row| row.get(place?).copied()).filter(|v| v.is_finite());
        verdicts[i].value = values.min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(f64::NAN);
    }
}

fn output(laid: &Laid, name: &str) -> Option<usize> {
    laid.machine.system.outputs().iter().position(|q| q.name == name)
}

/// All outputs at each equilibrium, everything at rest.
fn observed(laid: &mut Laid, data: &Dataset) -> Vec<Vec<f64>> {
    let system = &mut laid.machine.system;
    let names: Vec<String> = system.states().iter().map(|q| q.name.clone()).collect();
    let (n, wanted): (usize, Vec<usize>) = (system.n_coordinates(), (0..system.outputs().len()).collect());
    let count = names.first().and_then(|name| data.column(name)).map_or(0, |c| c.values.len());
    let mut rows = Vec::new();
    for row in 0..count {
        let place = |name: &String| data.column(name).and_then(|c| c.values.get(row).copied()).unwrap_or(0.0);
        let x: Vec<f64> = names.iter().enumerate().map(|(i, name)| if (n..2 * n).contains(&i) { 0.0 } else { place(name) }).collect();
        let mut values = vec![f64::NAN; wanted.len()];
        let known = system.show(&wanted).is_ok();
        if let Some(modes) = system.modes_by_value(0.0, &x).filter(|_| known)
            && system.observe(0.0, &x, &modes, &mut values).is_ok()
        {
            rows.push(values);
        }
    }
    rows
}

/// A natural frequency, as the study `modes` finds it.
pub fn frequency(machine: &mut Machine, (mode, published): (usize, f64), verdict: &mut Verdict, watch: &mut Watch) {
    let asked = of_file(machine, &[crate::modes::KIND.name]).cloned().unwrap_or_default();
    let finding = crate::modes::natural(machine, &Modes::of(&asked), watch);
    verdict.published = published;
    if let Some(trouble) = &finding.trouble {
        verdict.words = trouble.what.clone();
        return;
    }
    let found = finding.own.get("modes").and_then(|m| m.get(mode - 1)).and_then(|m| m.get("omega")).and_then(serde_json::Value::as_f64);
    verdict.value = found.unwrap_or(f64::NAN);
    if found.is_none() {
        verdict.words = Text::new(format!("there is no mode {mode}"), format!("формы с номером {mode} нет"));
    }
}

fn say(which: impl Iterator<Item = usize>, verdicts: &mut [Verdict], words: &Text) {
    which.for_each(|i| verdicts[i].words = words.clone());
}
