//! The written solution of several degrees of freedom: principal coordinates, each with the whole of its motion, and the sums that give the
//! coordinates of the machine,
//!
//! ```text
//! q_i'' + 2 n_i q_i' + k_i² q_i = h_i(t),   x = Σ X_i q_i
//! ```

use super::setting::{Setting, fence, plus, product, square, whole};
use super::tables::{harmonic_table, mode_table};
use super::writer::Writer;
use analysis::studies::transient::Phase;
use analysis::studies::transient::constants::Listed;
use report::Block;
use report::formula::Layout;
use symbolic::Equations;

/// Letters for the principal coordinates, in order of choice; the others are those of the solution.
const LETTERS: [&str; 5] = ["q", "z", "u", "w", "y"];

/// The solution on one phase.
pub fn blocks(set: &Setting, equations: &Equations, modes: &[Listed], phase: &Phase) -> Vec<Block> {
    let language = set.language;
    let letter = letter(equations);
    let words = |en: &str, ru: &str| Block::paragraph(language.pick(en, ru).to_owned());
    let line = |parts| Block::Equation { formula: set.chain(parts), numbered: false };
    let mut blocks = vec![
        words(
            "Principal coordinates (modes of mass 1), each an oscillator of its own:",
            "Главные координаты (формы с единичной массой), каждая колеблется независимо:",
        ),
        line(oscillator(set, letter)),
        Block::Table(mode_table(modes, letter, language)),
    ];
    if let Some(table) = harmonic_table(modes, language) {
        blocks.push(words(
            "Harmonic loads h sin(pt + δ) and what they force, D sin(pt + δ − ε):",
            "Гармонические нагрузки h sin(pt + δ) и вызванные ими колебания D sin(pt + δ − ε):",
        ));
        blocks.push(Block::Table(table));
    }
    if phase.start > 0.0 {
        blocks.push(line(vec![set.letter("τ"), super::setting::minus(set.letter("t"), set.size(phase.start))]));
    }
    blocks.push(words("The motion on this phase:", "Движение на этом этапе:"));
    for (i, mode) in modes.iter().enumerate() {
        blocks.extend(Writer::of_mode(set, &format!("{letter}{}", i + 1), mode, phase).in_numbers());
    }
    blocks.extend((0..phase.form.n).map(|j| line(sum(set, equations, modes, letter, j))));
    blocks
}

/// A letter that no coordinate of the machine begins with.
fn letter(equations: &Equations) -> &'static str {
    let name = |c: &symbolic::equations::Coordinate| equations.graph.symbol_info(c.symbols[0]).name.clone();
    let taken: Vec<String> = equations.coordinates.iter().map(name).collect();
    LETTERS.into_iter().find(|l| !taken.iter().any(|t| t.starts_with(l))).unwrap_or("η")
}

/// q_i'' + 2 n_i q_i' + k_i² q_i = h_i(t).
fn oscillator(set: &Setting, letter: &str) -> Vec<Layout> {
    let l = |name: &str| set.letter(name);
    let q = |primes: &str| l(&format!("{letter}_i{primes}"));
    let left = plus(vec![q("''"), product(vec![whole(2), l("n_i"), q("'")]), product(vec![square(l("k_i")), q("")])]);
    vec![left, Layout::Row(vec![l("h_i"), fence(l("t"))])]
}

/// The j-th coordinate as the sum over the modes.
fn sum(set: &Setting, equations: &Equations, modes: &[Listed], letter: &str, j: usize) -> Vec<Layout> {
    let info = equations.graph.symbol_info(equations.coordinates[j].symbols[0]);
    let share = |(i, m): (usize, &Listed)| set.term(m.mode.shape[j], vec![set.letter(&format!("{letter}{}", i + 1))]);
    let terms: Vec<_> = modes.iter().enumerate().filter(|(_, m)| m.mode.shape[j] != 0.0).map(share).collect();
    let right = if terms.is_empty() { whole(0) } else { Layout::Sum(terms) };
    vec![Layout::Symbol(set.printer.identifier(info)), right]
}
