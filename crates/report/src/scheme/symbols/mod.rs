//! The table of symbols, after the manner of ГОСТ 2.770 and ISO 3952: one file a family, one row a symbol.

mod elastic;
mod ground;
mod joints;
mod loads;
mod masses;
mod shafts;
mod signs;
mod symbol;
mod ties;
mod wheels;

pub use symbol::Symbol;
pub(crate) use symbol::{across, middle};

/// All families.
pub const TABLE: &[&[Symbol]] =
    &[ground::ROWS, joints::ROWS, masses::ROWS, elastic::ROWS, wheels::ROWS, ties::ROWS, shafts::ROWS, loads::ROWS, signs::ROWS];

/// The symbol of a name.
pub fn find(name: &str) -> Option<&'static Symbol> {
    TABLE.iter().flat_map(|family| family.iter()).find(|symbol| symbol.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scheme::{Fit, Ink, Place};

    #[test]
    fn every_symbol_has_a_name_of_its_own_words_in_both_languages_and_draws_something() {
        for symbol in TABLE.iter().flat_map(|family| family.iter()) {
            let same = TABLE.iter().flat_map(|family| family.iter()).filter(|s| s.name == symbol.name).count();
            assert_eq!(same, 1, "{}", symbol.name);
            assert!(!symbol.words.0.is_empty() && symbol.words.1.chars().any(|c| ('а'..='я').contains(&c)), "{}", symbol.name);
            let mut ink = Ink::default();
            (symbol.draw)(&(symbol.sample)(), &mut ink);
            let points: Vec<_> = ink.strokes.iter().flat_map(crate::scheme::Stroke::points).collect();
            assert!(!points.is_empty() && points.iter().flatten().all(|c| c.is_finite() && c.abs() < 75.0), "{}", symbol.name);
        }
    }

    #[test]
    fn what_stretches_keeps_its_strokes() {
        let drawn = |symbol: &Symbol, long: f64| {
            let mut ink = Ink::default();
            (symbol.draw)(&Place { to: [long, 0.0], at: [0.0; 2], other: 60.0, ..(symbol.sample)() }, &mut ink);
            ink.strokes.iter().map(|s| s.polyline().0.len()).collect::<Vec<_>>()
        };
        for symbol in TABLE.iter().flat_map(|family| family.iter()).filter(|s| s.fit == Fit::Stretch) {
            assert_eq!(drawn(symbol, 12.0), drawn(symbol, 300.0), "{}", symbol.name);
        }
    }

    #[test]
    fn symbols_of_no_size_draw_no_nonsense() {
        for symbol in TABLE.iter().flat_map(|family| family.iter()) {
            let mut ink = Ink::default();
            (symbol.draw)(&Place::default(), &mut ink);
            let points = ink.strokes.iter().flat_map(crate::scheme::Stroke::points);
            assert!(points.flatten().all(f64::is_finite), "{}", symbol.name);
        }
    }
}
