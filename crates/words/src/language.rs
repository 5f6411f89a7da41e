//! The two languages of everything that is printed.

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
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn locales_choose_the_language() {
        assert_eq!(Language::of_locale("ru_RU.UTF-8"), Language::Ru);
        assert_eq!(Language::of_locale("ru"), Language::Ru);
        assert_eq!(Language::of_locale("rw_RW"), Language::En);
        assert_eq!(Language::of_locale("C"), Language::En);
        assert_eq!(Language::of_locale(""), Language::En);
    }
}
