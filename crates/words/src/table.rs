//! How a room writes its table of printed words.

use crate::{Language, Text};

impl Language {
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
        #[cfg(test)]
        mod rows {
            #[test]
            fn every_word_stands_at_its_own_place() {
                for (i, (word, en, ru)) in super::WORDS.iter().enumerate() {
                    assert_eq!(*word as usize, i);
                    assert!(!en.is_empty() && !ru.is_empty());
                }
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
}
