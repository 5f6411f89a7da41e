//! The data of the moving pictures of a page as compact JSON.

use crate::scheme::Moving;
use crate::symbol;
use crate::wording::Word;
use serde_json::{Value, json};
use words::Language;

/// Words that the script prints.
const WORDS: &[(&str, Word)] = &[
    ("play", Word::Play),
    ("pause", Word::Pause),
    ("repeat", Word::Repeat),
    ("pace", Word::Pace),
    ("instant", Word::Instant),
    ("help", Word::MovingHelp),
];

/// JSON of all moving pictures.
pub(super) fn write(played: &[&Moving], language: Language) -> String {
    let words: serde_json::Map<String, Value> = WORDS.iter().map(|(key, word)| ((*key).into(), language.word(*word).into())).collect();
    let one = |moving: &&Moving| {
        let mut data = moving.data();
        let clock = &moving.clock;
        data["clock"]["name"] = json!(clock.symbol);
        data["clock"]["symbol"] = json!(symbol::plain(&clock.symbol, language));
        data["clock"]["unit"] = json!(crate::unit::print(&clock.unit, language));
        data
    };
    json!({"mark": language.decimal_mark().to_string(), "words": words, "movies": played.iter().map(one).collect::<Vec<_>>()}).to_string()
}
