//! The two languages of everything that is printed, and how a room writes its table of printed words.

use crate::Text;

/// Language of the output. Reading it from the environment or the command line is the caller's job.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Language {
    /// English: decimal point, Latin unit names.
    #[default]
    En,
    /// Russian: decimal comma, Cyrillic unit names.
    Ru,
}

impl Language {
    /// The code for `lang` attributes: `en` or `ru`.
    pub fn code(self) -> &'static str {
        self.pick("en", "ru")
    }

    /// The language of a locale name such as `ru_RU.UTF-8`, `ru`, `en_GB`, `C`; everything that is not Russian is English.
    pub fn of_locale(locale: &str) -> Language {
        let lower = locale.to_ascii_lowercase();
        let name = lower.split(['_', '.', '-', '@']).next().unwrap_or("");
        if matches!(name, "ru" | "rus" | "russian") { Language::Ru } else { Language::En }
    }

    /// The wording of a [`Text`]; an empty wording falls back to the other language.
    pub fn text(self, text: &Text) -> &str {
        let (first, second) = self.pick((&text.en, &text.ru), (&text.ru, &text.en));
        if first.is_empty() { second } else { first }
    }

    /// One of two values.
    pub fn pick<T>(self, en: T, ru: T) -> T {
        match self {
            Language::En => en,
            Language::Ru => ru,
        }
    }

    /// The decimal mark.
    pub fn decimal_mark(self) -> char {
        self.pick('.', ',')
    }

    /// A word of a table written with [`table`](crate::table).
    pub fn word(self, word: impl Printed) -> &'static str {
        let (en, ru) = word.wording();
        self.pick(en, ru)
    }
}

/// A word that has a row in a table of printed words.
pub trait Printed {
    /// The row, English and Russian.
    fn wording(self) -> (&'static str, &'static str);

    /// The word in both languages.
    fn text(self) -> Text
    where
        Self: Sized,
    {
        let (en, ru) = self.wording();
        Text::new(en, ru)
    }
}

/// A table of printed words: `Key: "English", "Russian";` rows become the enum `Word` and the table `WORDS` where it stands.
#[macro_export]
macro_rules! table {
    ($($name:ident: $en:literal, $ru:literal;)*) => {
        /// Key of a printed word.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[allow(missing_docs)]
        pub enum Word { $($name),* }
        /// Every printed word: key, English, Russian.
        pub const WORDS: &[(Word, &str, &str)] = &[$((Word::$name, $en, $ru)),*];
        impl $crate::Printed for Word {
            fn wording(self) -> (&'static str, &'static str) {
                // a row stands at the place of its key: the macro writes both in one order
                let (_, en, ru) = WORDS[self as usize];
                (en, ru)
            }
        }
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    crate::table! {
        Table: "Table", "Таблица";
        Number: "Number", "Количество";
    }

    #[test]
    fn a_word_is_printed_in_its_language() {
        assert_eq!(Language::Ru.word(Word::Number), "Количество");
        assert_eq!(Language::En.word(Word::Table), "Table");
    }

    #[test]
    fn locales_choose_the_language() {
        assert_eq!(Language::of_locale("ru_RU.UTF-8"), Language::Ru);
        assert_eq!(Language::of_locale("ru"), Language::Ru);
        assert_eq!(Language::of_locale("rw_RW"), Language::En);
        assert_eq!(Language::of_locale("C"), Language::En);
        assert_eq!(Language::of_locale(""), Language::En);
    }

    #[test]
    fn a_missing_wording_falls_back() {
        assert_eq!(Language::Ru.text(&Text::new("only", "")), "only");
    }
}
