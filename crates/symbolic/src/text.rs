//! Wording in both languages.

/// A caption or sentence in English and Russian; whoever prints it picks one.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Text {
    /// English wording.
    pub en: String,
    /// Russian wording.
    pub ru: String,
}

impl Text {
    /// Both wordings.
    pub fn new(en: impl Into<String>, ru: impl Into<String>) -> Text {
        Text { en: en.into(), ru: ru.into() }
    }
    /// The same words in both languages (names, symbols).
    pub fn same(words: impl Into<String>) -> Text {
        let en: String = words.into();
        Text { ru: en.clone(), en }
    }
}
