//! The written solution of each phase: formula, substitution, result.
//!
//! ```text
//! a q'' + b q' + c q = H sin pt;   n = b/(2a),  k = sqrt(c/a),  h = H/a
//! q = e^(-nτ)(C1 cos k1 τ + C2 sin k1 τ) + D sin(pt - ε),   D = h/sqrt((k² - p²)² + 4 n² p²),  tg ε = 2 n p/(k² - p²)
//! ```
//!
//! The letters are those of the textbooks (A. A. Yablonskii, S. S. Noreiko, Course of the theory of vibrations); they belong to this section
//! only and may differ from the user's.

use super::found::Phases;
use super::principal;
use super::setting::Setting;
use super::tables::state_table;
use super::writer::{System, Writer};
use analysis::studies::transient::Phase;
use report::Block;
use report::formula::Printer;
use symbolic::Equations;
use words::Language;

/// Share by which a parameter of the same letter may lie beside what the letter means.
const SAME: f64 = 1e-9;
/// Digits of instants in headings.
const DIGITS: usize = 6;

/// The solution of all phases.
pub fn blocks(equations: &Equations, found: &Phases, language: Language, width: usize) -> Vec<Block> {
    let (phases, names) = (&found.list, &found.names);
    let printer = Printer::of(equations, language).with_width(width);
    let taken = taken(equations, phases, &printer);
    let setting = Setting { printer, language, taken };
    let mut blocks: Vec<Block> = reading(found, language).into_iter().collect();
    let mut before: Option<&Phase> = None;
    for (i, phase) in phases.iter().enumerate() {
        let span = |t: f64| report::number::short(t, DIGITS, language);
        let (start, end) = (span(phase.start), span(phase.end));
        blocks.push(Block::heading(
            2,
            language.pick(format!("Phase {}: from {start} to {end} s", i + 1), format!("Этап {}: от {start} до {end} с", i + 1)),
        ));
        let listed = phase.listed();
        match listed.as_slice() {
            [] => blocks.push(Block::paragraph(language.pick(
                "The modes do not uncouple the equations (damping that is not proportional, gyroscopic or follower forces): the state and the loads are carried by one matrix exponential, which is exact.",
                "Собственные формы не разделяют уравнения (непропорциональное сопротивление, гироскопические или следящие силы): состояние и нагрузки переносит одна матричная экспонента, это точное решение.",
            ))),
            [only] if phase.form.n == 1 => {
                let coordinate = Writer::new(&setting, equations, only, phase);
                let same = before.is_some_and(|b| b.form.mass == phase.form.mass && b.form.damping == phase.form.damping && b.form.stiffness == phase.form.stiffness);
                blocks.extend(coordinate.solution(if same { System::AsBefore } else { System::New }));
            }
            modes => blocks.extend(principal::blocks(&setting, equations, modes, phase)),
        }
        before = Some(phase);
    }
    if !phases.is_empty() {
        blocks.push(Block::heading(2, language.pick("States at the switches", "Состояния при переключениях")));
        blocks.push(Block::Table(state_table(equations, phases, names, language)));
    }
    blocks
}

/// Letters of the textbooks that the file gives to other quantities: to coordinates, results, and parameters of another value.
fn taken(equations: &Equations, phases: &[Phase], printer: &Printer) -> Vec<String> {
    let listed = phases.first().map(Phase::listed).unwrap_or_default();
    let known: Vec<(&str, f64)> = match listed.as_slice() {
        [only] => {
            let (a, o) = (only.inertia, &only.mode.oscillator);
            let load = only.forcing.first().map(|f| (f.harmonic.h, f.harmonic.p));
            let loads = load.map(|(h, p)| vec![("h", h), ("p", p), ("H", a * h)]).unwrap_or_default();
            [("a", a), ("b", 2.0 * o.n * a), ("c", o.k2 * a), ("n", o.n), ("k", o.k2.max(0.0).sqrt())].into_iter().chain(loads).collect()
        }
        _ => Vec::new(),
    };
    let letters = ["a", "b", "c", "n", "k", "h", "p", "H", "D", "A", "B", "C1", "C2", "k1", "T1", "r1", "r2"];
    let is_taken = |letter: &str| {
        let shown = printer.shown(letter);
        let own = known.iter().find(|(name, _)| *name == letter).map(|(_, value)| *value);
        let named = |symbol| printer.shown(&equations.graph.symbol_info(symbol).name) == shown;
        let differs = |value: f64| own.is_none_or(|own: f64| (value - own).abs() > SAME * own.abs());
        equations.parameters.iter().any(|p| named(p.symbol) && differs(p.value))
            || equations.coordinates.iter().any(|c| named(c.symbols[0]))
    };
    letters.into_iter().filter(|letter| is_taken(letter)).map(str::to_owned).collect()
}

/// How the loads pass the switches, when there are switches and harmonic loads.
fn reading(found: &Phases, language: Language) -> Option<Block> {
    let harmonic = |p: &Phase| p.form.loads.iter().flat_map(|l| &l.0).any(|t| t.rate.im != 0.0);
    let later = found.list.get(1..)?.iter().filter(|p| harmonic(p));
    let restarts: Vec<bool> = later.map(|p| found.restarts(p)).collect();
    let (first, mixed) = (*restarts.first()?, restarts.iter().any(|r| *r != restarts[0]));
    Some(Block::paragraph(match (first, mixed) {
        (_, true) => language.pick(
            "At some switches the loads keep their phase, at others they begin anew.",
            "При одних переключениях нагрузки сохраняют фазу, при других начинаются заново.",
        ),
        (false, _) => language.pick(
            "The loads keep their phase at the switches (other reading: --set phases=restarts).",
            "При переключениях нагрузки сохраняют фазу (другое толкование: --set phases=restarts).",
        ),
        (true, _) => language.pick(
            "The loads begin anew at the switches (other reading: --set phases=keeps).",
            "При переключениях нагрузки начинаются заново (другое толкование: --set phases=keeps).",
        ),
    }))
}
