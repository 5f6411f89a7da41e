//! Assembly of a machine with connections: a start that closes all loops, and which conditions and reactions are independent.
//!
//! Given start values are kept; of the others as few as can be move (`choice.rs`), as little as possible (`closing.rs`). Then the conditions are compared with one
//! another (`rank.rs`): one that repeats others is left out with its reaction, and reactions that share a load in a way that rigid bodies
//! leave open are marked as not unique. What a condition on rates gives along a way stands in `way.rs` and `surface.rs`.

mod apart;
mod bench;
mod choice;
mod closing;
mod guess;
mod level;
mod lowered;
mod piecewise;
mod rank;
mod starts;
pub(crate) mod surface;
pub(crate) mod way;

use std::sync::Arc;

use program::Program;
use program::lower::Selection;
use symbolic::Equations;
use symbolic::connections::Condition;
use words::Text;

use crate::Fault;
use bench::Bench;

pub(crate) use bench::listed;
pub use guess::closed_guess;
pub use lowered::{conditions, selected};
pub(crate) use piecewise::{is_bent, is_piecewise};
pub use starts::settle_starts;

/// A machine put together.
#[derive(Clone, Debug, Default)]
pub struct Assembly {
    /// State at the start.
    pub start: Vec<f64>,
    /// What takes part in the equations.
    pub selection: Selection,
    /// Reactions that have no value.
    pub undetermined: Undetermined,
    /// Remarks.
    pub notes: Vec<Text>,
}

/// Reactions that the equations of rigid bodies leave open, by index.
#[derive(Clone, Debug, Default)]
pub struct Undetermined {
    /// All of them.
    pub open: Vec<usize>,
    /// Those that depend on the place of a load, with this load.
    pub placed: Vec<(usize, usize)>,
}

/// Puts the machine together for these parameters, in the order of `Equations::parameters`.
///
/// *Errors*: S015 given values that do not fit together, with the values that do; S016 loops that cannot close; S017 conditions that
/// contradict each other; S018 a start in a singular configuration.
pub fn assemble(equations: &Equations, parameters: &[f64]) -> Result<Assembly, Fault> {
    assemble_with(&conditions(equations)?, equations, parameters)
}

/// [`assemble`] with the program of [`conditions`] at hand.
///
/// *Errors*: those of [`assemble`].
pub fn assemble_with(program: &Arc<Program>, equations: &Equations, parameters: &[f64]) -> Result<Assembly, Fault> {
    let mut bench = Bench::new(program, equations, parameters)?;
    let mut notes = Vec::new();
    let before = bench.x.clone();
    if !equations.conditions.is_empty() {
        bench.close_places(&mut notes)?;
        bench.keep_apart()?;
        bench.check_starts()?;
        bench.moved = (0..bench.n).map(|j| bench.x[j] != before[j]).collect();
        bench.close_rates(&mut notes)?;
    }
    let (selection, undetermined) = bench.select(&mut notes)?;
    notes.extend(bench.moved_values(&before));
    notes.extend(guides_by_guess(equations));
    Ok(Assembly { start: bench.x, selection, undetermined, notes })
}

/// Sliders without a point of their guide, whose place at the start hangs on a guess.
fn guides_by_guess(equations: &Equations) -> Vec<Text> {
    let guessed = |j: &usize| equations.coordinates[*j].guessed[0] && !equations.coordinates[*j].given[0];
    let one = |condition: &Condition| {
        let is_slider = condition.name.en.starts_with("slider ") && condition.place.is_none();
        let list: Vec<String> = condition
            .columns
            .iter()
            .map(|(j, _)| *j)
            .filter(guessed)
            .map(|j| equations.graph.symbol_info(equations.coordinates[j].symbols[0]).name.clone())
            .collect();
        let head = |text: &str| text.split(", ").next().unwrap_or_default().to_owned();
        (is_slider && !list.is_empty()).then(|| {
            let (en, ru, list) = (head(&condition.name.en), head(&condition.name.ru), list.join(", "));
            Text::new(
                format!("{en}: its guide passes through its place at the start, which the guess of {list} decides; give `through` to fix the guide"),
                format!("{ru}: направляющая проходит через начальное положение, которое зависит от приближения для {list}; чтобы её закрепить, задайте `through`"),
            )
        })
    };
    let mut notes: Vec<Text> = equations.conditions.iter().filter_map(one).collect();
    notes.dedup();
    notes
}
