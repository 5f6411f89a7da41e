//! Wording in both languages.

use crate::{Language, unit};

/// A caption or sentence in English and Russian; whoever prints it picks one.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Text {
    /// English wording.
    pub en: String,
    /// Russian wording.
    pub ru: String,
}

impl Language {
    /// The wording of a [`Text`]; an empty wording falls back to the other language.
    pub fn text(self, text: &Text) -> &str {
        let (first, second) = self.pick((&text.en, &text.ru), (&text.ru, &text.en));
        if first.is_empty() { second } else { first }
    }
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
    /// The label of a unit: `kg m^2`, `кг м^2`.
    pub fn unit(label: &str) -> Text {
        let mut ru = String::with_capacity(2 * label.len());
        let mut rest = label;
        while let Some(c) = rest.chars().next() {
            let end = rest.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(rest.len()).max(c.len_utf8());
            ru.push_str(&unit::print(&rest[..end], Language::Ru));
            rest = &rest[end..];
        }
        Text { en: label.to_owned(), ru }
    }
}

/// The words with the first letter large.
pub fn capital(words: &str) -> String {
    let mut chars = words.chars();
    chars.next().map_or(String::new(), |first| first.to_uppercase().chain(chars).collect())
}

#[cfg(test)]
mod tests {
    use super::{Language, Text};

    #[test]
    fn units_have_a_russian_label() {
        for (label, russian) in
            [("kg m^2", "кг м^2"), ("N m/rad", "Н м/рад"), ("kN/m", "кН/м"), ("1/s", "1/с"), ("mm", "мм"), ("Н м", "Н м")]
        {
            assert_eq!(Text::unit(label).ru, russian);
        }
    }

    #[test]
    fn a_missing_wording_falls_back() {
        assert_eq!(Language::Ru.text(&Text::new("only", "")), "only");
    }
}
