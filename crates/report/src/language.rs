//! The two languages of everything printed here, and the table of all words.

use symbolic::Text;

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

    /// A word of the table [`WORDS`].
    pub fn word(self, word: Word) -> &'static str {
        let (_, en, ru) = WORDS[word as usize];
        self.pick(en, ru)
    }
}

/// A table of printed words: `Key: "English", "Russian";` rows become the enum `Word` and the table `WORDS` where it stands.
#[macro_export]
macro_rules! words {
    ($($name:ident: $en:literal, $ru:literal;)*) => {
        /// Key of a printed word.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[allow(missing_docs)]
        pub enum Word { $($name),* }
        /// Every printed word: key, English, Russian.
        pub const WORDS: &[(Word, &str, &str)] = &[$((Word::$name, $en, $ru)),*];
    };
}

words! {
    Figure: "Figure", "Рисунок";
    Table: "Table", "Таблица";
    Contents: "Contents", "Содержание";
    DegreesOfFreedom: "Degrees of freedom", "Число степеней свободы";
    Coordinates: "Generalized coordinates", "Обобщённые координаты";
    Equations: "Equations of motion", "Уравнения движения";
    Derivation: "Derivation, step by step", "Вывод по шагам";
    Parameters: "Parameters", "Параметры";
    Definitions: "Definitions", "Обозначения";
    Results: "Results", "Результаты";
    Simulation: "Motion", "Движение";
    Equilibrium: "Equilibrium", "Положение равновесия";
    Checks: "Checks", "Проверки";
    Events: "Events", "События";
    Counters: "Work done", "Объём вычислений";
    Downloads: "Files", "Файлы";
    Symbol: "Symbol", "Обозначение";
    Written: "As written", "Задано";
    Value: "Value", "Значение";
    ValueSi: "Value in SI", "Значение в СИ";
    Unit: "Unit", "Единица";
    Description: "Description", "Описание";
    Check: "Check", "Проверка";
    Limit: "Limit", "Допуск";
    Verdict: "Verdict", "Вывод";
    Passed: "passed", "выполнено";
    Failed: "failed", "не выполнено";
    Time: "Time", "Время";
    Event: "Event", "Событие";
    Counter: "Counter", "Показатель";
    Number: "Number", "Количество";
    Minimum: "min", "мин.";
    Maximum: "max", "макс.";
    Final: "at the end", "в конце";
    Series: "Curve", "Кривая";
    ShowData: "Show data", "Показать данные";
    RowsOf: "rows shown of", "строк показано из";
    Version: "version", "версия";
    ModelHash: "model", "модель";
    PlotHelp: "Drag: zoom. Double click or 0: whole range. Arrow keys: cursor. L: logarithmic axis.",
        "Протяните мышью – увеличить. Двойной щелчок или 0 – весь диапазон. Стрелки – курсор. L – логарифмическая ось.";
    ResetZoom: "Whole range", "Весь диапазон";
    LogAxis: "Log axis", "Лог. ось";
    Against: "against", "от";
    From: "from", "от";
    To: "to", "до";
    Points: "points", "точек";
    NoPositive: "no positive values: a logarithmic axis is not possible", "нет положительных значений: логарифмическая ось невозможна";
    NoData: "no finite values to draw", "нет конечных значений для построения";
    Contacts: "Contacts and frictions", "Контакты и трение";
    Contact: "Contact", "Контакт";
    Before: "Before", "До";
    After: "After", "После";
    Impulse: "Impulse, SI", "Импульс, СИ";
    Impacts: "impacts", "ударов";
    StateClosed: "closed, taut", "замкнут, натянут";
    StateOpen: "open, slack", "разомкнут, провисает";
    StateSticks: "sticks", "залипание";
    StateForward: "slides forward", "скольжение вперёд";
    StateBackward: "slides back", "скольжение назад";
    StateImpact: "impact", "удар";
    Omitted: "omitted", "опущено";
    Continued: "the table is cut to the width of the terminal; all columns are in the files",
        "таблица обрезана по ширине терминала; все столбцы есть в файлах";
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_word_stands_at_its_own_place() {
        for (i, (word, en, ru)) in WORDS.iter().enumerate() {
            assert_eq!(*word as usize, i);
            assert!(!en.is_empty() && !ru.is_empty());
        }
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
