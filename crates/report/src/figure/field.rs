//! What fills a plane behind its curves: tiles of one size, tinted by a class or by a number, hatched where something is unstable or has no result.

use super::axis::Axis;
use crate::wording::Word;
use words::Language;

/// Steps of a scale of colours: neighbours are not told apart by eye.
pub const STEPS: usize = 48;
/// Room for the bar of a scale on the right.
pub const BAR: f64 = 92.0;
/// A filling.
#[derive(Clone, Debug)]
pub struct Field {
    /// Tiles along x.
    pub across: usize,
    /// Ends of x and of y, SI.
    pub ends: [[f64; 2]; 2],
    /// Tiles row by row from below, as many in each row.
    pub tiles: Vec<Tile>,
    /// What tints mean.
    pub key: Key,
    /// What a page does with the place that is clicked.
    pub pick: Pick,
}

/// A tile.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tile {
    /// Index of a class, or a step of the scale; none where there is no value.
    pub tint: Option<usize>,
    /// Lines over it.
    pub hatch: Hatch,
}

/// Lines over a tile.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Hatch {
    /// None.
    #[default]
    Plain,
    /// What is found is unstable.
    Unstable,
    /// There is no result.
    Failed,
}

/// What tints mean.
#[derive(Clone, Debug)]
pub enum Key {
    /// Classes by name.
    Classes(Vec<String>),
    /// A number between its least and greatest value, SI.
    Scale(Axis, [f64; 2]),
}

/// What a page does with the place that is clicked: its values and a command line with them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Pick {
    /// Names of what x and y are, as a command takes them.
    pub names: [String; 2],
    /// Their SI units, as a command takes them; empty for none.
    pub units: [String; 2],
    /// The command line, to which the values are added; empty when there is none.
    pub command: String,
}

impl Field {
    /// The step of a value on a scale.
    pub fn step([low, high]: [f64; 2], value: f64) -> Option<usize> {
        let share = if high > low { (value - low) / (high - low) } else { 0.5 };
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        share.is_finite().then(|| ((share * STEPS as f64).max(0.0) as usize).min(STEPS - 1))
    }

    /// Entries of the legend: a tile and what it means.
    pub fn entries(&self, language: Language) -> Vec<(Tile, String)> {
        let mut out: Vec<(Tile, String)> = match &self.key {
            Key::Classes(names) => {
                let has = |k: &usize| self.tiles.iter().any(|tile| tile.tint == Some(*k));
                let shown = (0..names.len()).filter(has);
                shown.map(|k| (Tile { tint: Some(k), hatch: Hatch::Plain }, names[k].clone())).collect()
            }
            Key::Scale(..) => Vec::new(),
        };
        for (hatch, word) in [(Hatch::Unstable, Word::Unstable), (Hatch::Failed, Word::NoResult)] {
            if self.tiles.iter().any(|tile| tile.hatch == hatch) {
                out.push((Tile { tint: None, hatch }, language.word(word).into()));
            }
        }
        out
    }

    /// The picture in words: how much of it each class has, or between which values the number lies.
    pub fn summary(&self, language: Language) -> String {
        let all = self.tiles.len().max(1) as f64;
        let share = |fits: &dyn Fn(&Tile) -> bool| 100.0 * self.tiles.iter().filter(|tile| fits(tile)).count() as f64 / all;
        let percent = |name: &str, share: f64| format!("  {name}: {} %\n", crate::number::short(share, 3, language));
        let mut out = String::new();
        match &self.key {
            Key::Classes(names) => {
                for (k, name) in names.iter().enumerate() {
                    out += &percent(name, share(&|tile| tile.tint == Some(k)));
                }
            }
            Key::Scale(axis, [low, high]) => {
                let shown =
                    |v: f64| crate::number::with_unit(&crate::number::short(v / axis.scale.size, 4, language), &axis.unit(0, language));
                let (least, most) = (language.word(Word::Minimum), language.word(Word::Maximum));
                out += &format!("  {least} {}, {most} {}\n", shown(*low), shown(*high));
            }
        }
        for (hatch, word) in [(Hatch::Unstable, Word::Unstable), (Hatch::Failed, Word::NoResult)] {
            let share = share(&|tile| tile.hatch == hatch);
            if share > 0.0 {
                out += &percent(language.word(word), share);
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::{Field, Hatch, Key, Pick, STEPS, Tile};
    use words::Language;

    #[test]
    fn steps_reach_both_ends_and_nothing_has_none() {
        assert_eq!(Field::step([1.0, 3.0], 1.0), Some(0));
        assert_eq!(Field::step([1.0, 3.0], 3.0), Some(STEPS - 1));
        assert_eq!(Field::step([1.0, 3.0], f64::NAN), None);
        assert_eq!(Field::step([2.0, 2.0], 2.0), Some(STEPS / 2));
    }

    #[test]
    fn the_legend_has_what_is_drawn() {
        let tile = |tint, hatch| Tile { tint, hatch };
        let field = Field {
            across: 2,
            ends: [[0.0, 1.0]; 2],
            tiles: vec![tile(Some(1), Hatch::Plain), tile(None, Hatch::Failed)],
            key: Key::Classes(vec!["a".into(), "b".into()]),
            pick: Pick::default(),
        };
        let names: Vec<String> = field.entries(Language::En).into_iter().map(|(_, name)| name).collect();
        assert_eq!(names, ["b", "no result"]);
        assert_eq!(field.summary(Language::En), "  a: 0 %\n  b: 50 %\n  no result: 50 %\n");
    }
}
