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
    /// The label of an SI unit: `kg m^2`, `кг м^2`.
    pub fn unit(label: &str) -> Text {
        let mut ru = String::with_capacity(2 * label.len());
        let mut rest = label;
        while let Some(c) = rest.chars().next() {
            let end = rest.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(rest.len()).max(c.len_utf8());
            let word = &rest[..end];
            ru.push_str(RUSSIAN.iter().find(|(latin, _)| *latin == word).map_or(word, |(_, russian)| russian));
            rest = &rest[end..];
        }
        Text { en: label.to_owned(), ru }
    }
}

const RUSSIAN: [(&str, &str); 18] = [
    ("m", "м"),
    ("kg", "кг"),
    ("s", "с"),
    ("A", "А"),
    ("K", "К"),
    ("mol", "моль"),
    ("cd", "кд"),
    ("rad", "рад"),
    ("N", "Н"),
    ("W", "Вт"),
    ("Pa", "Па"),
    ("C", "Кл"),
    ("V", "В"),
    ("Ohm", "Ом"),
    ("F", "Ф"),
    ("H", "Гн"),
    ("Wb", "Вб"),
    ("Hz", "Гц"),
];
