//! The scheme of a machine: symbols placed where its points and bodies are. Positions are evaluated from the formulas of the derivation about the place that is
//! drawn; what a group of bodies looks like follows from what holds it.
//!
//! | step | file |
//! |---|---|
//! | numbers of positions in some states near the place | `numbers.rs` |
//! | frames that are one piece, their joints | `groups.rs` |
//! | what is seen of each group | `looks.rs` |
//! | what formulas of pathways measure; energies that are springs, dissipations that are dampers | `ends.rs`; `laws.rs` |
//! | hinges that follow from formulas | `pinned.rs` |
//! | metres to pixels | `stage.rs` |
//! | symbols | `sketch.rs` and the files beside it; what connections have on a layer, `paper.rs` |
//! | a motion: frames along it, tracks, which studies have one | `course.rs`, `moving.rs`, `played.rs` |
//! | which symbols each table of the file has | `vocabulary.rs` |

#![allow(clippy::disallowed_methods, reason = "places on paper, rounded to hundredths of a pixel")]

mod apart;
mod bodies;
mod course;
mod ends;
mod groups;
mod holds;
mod instants;
mod isolate;
mod laws;
mod letters;
mod looks;
mod moving;
mod numbers;
mod paper;
mod pinned;
mod played;
mod pulls;
mod shafts;
mod signs;
mod sketch;
mod sketched;
mod stage;
mod structure;
mod ties;
pub mod vocabulary;

pub(crate) use instants::bent;
pub use instants::{at_rest, at_time};
pub use moving::along;
pub use numbers::{Instant, STILL, known};
pub use played::of as played;

use crate::machine::Machine;
use mechanics::model::FrameId;
use report::{Block, Scheme};
use words::{Language, Notice, Text};

/// What is drawn.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The place; none for the start.
    pub at: Option<Instant>,
    /// One body alone; none for the machine.
    pub body: Option<String>,
}

/// The scheme as a block of a page; none where there is nothing to draw.
pub fn figure(machine: &Machine, language: Language) -> Option<Block> {
    scheme(machine, &Options::default(), language).map(Block::Scheme)
}

/// The scheme that a user asks for.
///
/// # Errors
/// There is no such body (C055), or nothing to draw (C056).
pub fn asked(machine: &Machine, options: &Options, language: Language) -> Result<Scheme, Notice> {
    if let Some(name) = &options.body {
        let bodies = || machine.model.frames.iter().skip(1).filter(|f| f.is_body).map(|f| f.name.as_str());
        if !bodies().any(|b| b == name) {
            return Err(no_body(name, &bodies().collect::<Vec<_>>()));
        }
    }
    scheme(machine, options, language).ok_or_else(|| {
        Notice::new("C056", "the file has nothing that could be drawn", "в файле нечего чертить")
            .why("it has no bodies and no rods", "в нём нет ни тел, ни стержней")
            .help("for sections alone: strutt section FILE --out DIR", "для одних сечений: strutt section FILE --out DIR")
    })
}

fn no_body(name: &str, bodies: &[&str]) -> Notice {
    let mut notice = Notice::new("C055", format!("there is no body `{name}`"), format!("нет тела `{name}`"));
    notice.help = match words::nearest(name, bodies.iter().copied()) {
        Some(near) => Text::new(format!("did you mean `{near}`?"), format!("может быть, `{near}`?")),
        None => Text::new(format!("bodies: {}", bodies.join(", ")), format!("тела: {}", bodies.join(", "))),
    };
    notice
}

/// Whether a body is the massless axle of a wheel with which it is one body: the wheel's free-body diagram is its own.
pub fn is_axle(machine: &Machine, body: FrameId) -> bool {
    sketch::is_axle(machine, body)
}

/// The scheme; none where there is nothing to draw.
pub fn scheme(machine: &Machine, options: &Options, language: Language) -> Option<Scheme> {
    let at = options.at.clone().unwrap_or_else(|| Instant::start(machine));
    if let Some(name) = &options.body {
        let body = machine.model.frames.iter().position(|f| f.is_body && f.name == *name)?;
        return Some(sketch::body(machine, &at, (FrameId(body), language)));
    }
    let mut scheme = sketch::draw(machine, &at, language);
    let stretched = options.at.is_none() && sketch::is_stretched(&scheme);
    if let Some(clearer) = stretched.then(|| instants::bent(machine)).flatten() {
        scheme = sketch::draw(machine, &clearer, language);
    }
    (!scheme.items.is_empty()).then_some(scheme)
}
