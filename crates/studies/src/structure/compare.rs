//! The same frame at all levels of simplification: what massless rods, static shapes, rigid rods and resting sections cost.

use crate::frame::bind::bind;
use analysis::studies::structure_modes::{self, Modes};
use mechanics::Model;
use mechanics::structure::Structure;
use structures::continuum;
use structures::reduced::Condensation;
use words::Text;

/// Parts of each elastic rod at the refined levels.
const PARTS: usize = 16;

/// Frequencies at a level.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Key in files.
    pub key: &'static str,
    /// What is assumed.
    pub words: Text,
    /// Angular frequencies, rising.
    pub omega: Vec<f64>,
}

/// What a level assumes.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Assumed {
    key: &'static str,
    en: &'static str,
    ru: &'static str,
    /// Elastic rods have their mass.
    mass: bool,
    /// Rods are divided.
    divided: bool,
    /// Rigid rods with EI bend.
    flexible: bool,
    /// Turning of sections: as in the file, nowhere, everywhere.
    rotary: Rotary,
    exact: bool,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Rotary {
    File,
    Nowhere,
    Everywhere,
}

const fn level(
    key: &'static str,
    en: &'static str,
    ru: &'static str,
    [mass, divided, flexible, exact]: [bool; 4],
    rotary: Rotary,
) -> Assumed {
    Assumed { key, en, ru, mass, divided, flexible, rotary, exact }
}

const LEVELS: [Assumed; 8] = [
    level("massless", "elastic rods massless", "упругие стержни невесомы", [false, false, false, false], Rotary::File),
    level(
        "static_shapes",
        "rods with mass, static shapes",
        "стержни с массой, статические формы",
        [true, false, false, false],
        Rotary::File,
    ),
    level("refined", "rods with mass, refined", "стержни с массой, подробная сетка", [true, true, false, false], Rotary::File),
    level("continuum", "rods with mass, exact", "стержни с массой, точно", [true, false, false, true], Rotary::File),
    level("no_rotary", "the same, sections do not turn", "то же без инерции поворота сечений", [true, true, false, false], Rotary::Nowhere),
    level(
        "flexible",
        "rigid rods bend too, refined",
        "жёсткие стержни изгибаются, подробная сетка",
        [true, true, true, false],
        Rotary::Nowhere,
    ),
    level(
        "flexible_continuum",
        "rigid rods bend too, exact",
        "жёсткие стержни изгибаются, точно",
        [true, false, true, true],
        Rotary::Nowhere,
    ),
    level(
        "flexible_rotary",
        "and all sections turn, refined",
        "и все сечения поворачиваются, подробная сетка",
        [true, true, true, false],
        Rotary::Everywhere,
    ),
];

/// Frequencies at all levels that differ, as many as `count`.
pub fn levels(model: &Model, structure: &Structure, count: usize) -> Vec<Level> {
    let mut out: Vec<Level> = Vec::new();
    for assumed in LEVELS {
        let Some(omega) = frequencies(model, structure, assumed, count) else { continue };
        // the same numbers by another order of sums
        let same = |l: &Level| l.omega.len() == omega.len() && l.omega.iter().zip(&omega).all(|(a, b)| (a - b).abs() <= 1e-14 * b);
        if !out.iter().any(same) {
            out.push(Level { key: assumed.key, words: Text::new(assumed.en, assumed.ru), omega });
        }
    }
    out
}

fn frequencies(model: &Model, structure: &Structure, assumed: Assumed, count: usize) -> Option<Vec<f64>> {
    let mut changed = structure.clone();
    let zero = structure.rods.first()?.rotary_of_nothing;
    for rod in &mut changed.rods {
        let elastic = !rod.rigid;
        if elastic && !assumed.mass {
            (rod.mass, rod.rotary) = (zero, zero);
        }
        if assumed.flexible && rod.rigid && rod.bending.is_some() {
            rod.rigid = false;
        }
        match assumed.rotary {
            Rotary::File => {}
            Rotary::Nowhere => rod.rotary = zero,
            Rotary::Everywhere => rod.rotary = rod.section_inertia.unwrap_or(zero),
        }
        rod.divisions = Some(if assumed.divided { PARTS } else { 1 });
    }
    let frame = bind(model, &changed).frame;
    let condensation = if assumed.divided { Condensation::Massless } else { Condensation::Turns };
    let options = Modes { count, condensation, ..Modes::default() };
    let found = structure_modes::modes(&frame, None, &options).ok()?;
    let omega: Vec<f64> = found.modes.iter().map(|m| m.omega).collect();
    if assumed.exact { continuum::frequencies(&frame, &omega) } else { Some(omega) }
}
