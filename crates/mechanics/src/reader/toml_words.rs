//! The messages of the TOML parser in Russian.

/// `WHAT, expected A, B` of the parser; what it does not know is called a wrong way of writing, never left in English.
pub(crate) fn russian(message: &str) -> String {
    let (what, expected) = match message.split_once(", expected ") {
        Some((what, expected)) => (what, Some(expected)),
        None => (message, None),
    };
    if is_date(what) {
        // no file of a machine holds one: what is expected there helps nobody
        return "неверная дата или время".to_owned();
    }
    let what = word(WHAT, what).map_or_else(|| family(what).to_owned(), ToOwned::to_owned);
    let wanted = |item: &str| match item.starts_with(['`', '\'']) {
        true => item.to_owned(),
        false => word(EXPECTED, item).unwrap_or("другая запись").to_owned(),
    };
    match expected {
        Some(list) => format!("{what}, ожидается {}", list.split(", ").map(wanted).collect::<Vec<_>>().join(", ")),
        None => what,
    }
}

/// `invalid month between 01 and 12` and so on.
fn is_date(what: &str) -> bool {
    const PARTS: [&str; 11] = ["date", "datetime", "date-time", "time", "year", "month", "day", "hour", "minute", "second", "offset"];
    let first = what.strip_prefix("invalid ").and_then(|rest| rest.split_whitespace().next()).unwrap_or_default();
    PARTS.contains(&first.trim_end_matches('s').trim_start_matches("nano"))
}

fn word(table: &[(&str, &'static str)], english: &str) -> Option<&'static str> {
    table.iter().find(|(en, _)| *en == english).map(|(_, ru)| *ru)
}

/// Messages that carry a type or a part of the text.
fn family(what: &str) -> &'static str {
    match what {
        w if w.starts_with("cannot extend value") => "нельзя дополнить уже заданное значение ключом с точкой",
        _ => "неверная запись",
    }
}

const WHAT: &[(&str, &str)] = &[
    ("`_` may only go between digits", "знак `_` может стоять только между цифрами"),
    ("cannot recurse further; max recursion depth met", "слишком глубокая вложенность"),
    ("recursion limit", "слишком глубокая вложенность"),
    ("carriage return must be followed by newline", "за возвратом каретки должен идти перевод строки"),
    ("extra `=`", "лишний знак `=`"),
    ("extra assignment between key-value pairs", "лишний знак `=` между парами"),
    ("extra comma in array", "лишняя запятая в массиве"),
    ("extra comma in inline table", "лишняя запятая во встроенной таблице"),
    ("integers with a radix cannot be signed", "у целого числа с основанием не бывает знака"),
    ("invalid comment character", "недопустимый знак в примечании"),
    ("invalid inline table element", "неверный элемент встроенной таблицы"),
    ("invalid key-value pair", "неверная пара из ключа и значения"),
    ("invalid unquoted key", "недопустимый ключ без кавычек"),
    ("invalid value", "неверное значение"),
    ("invalid string", "неверная строка"),
    ("invalid basic string", "неверная строка"),
    ("invalid multi-line basic string", "неверная многострочная строка"),
    ("invalid literal string", "неверная строка в апострофах"),
    ("invalid multi-line literal string", "неверная многострочная строка в апострофах"),
    ("invalid boolean", "неверное логическое значение"),
    ("invalid float", "неверное дробное число"),
    ("invalid integer number", "неверное целое число"),
    ("invalid hexadecimal number", "неверное шестнадцатеричное число"),
    ("invalid octal number", "неверное восьмеричное число"),
    ("invalid binary number", "неверное двоичное число"),
    ("invalid mantissa", "неверная мантисса"),
    ("invalid fraction", "неверная дробная часть"),
    ("invalid exponent", "неверный порядок числа"),
    ("invalid key", "неверный ключ"),
    ("invalid table", "неверная таблица"),
    ("key with no value", "ключ без значения"),
    ("keys cannot be multi-line basic strings", "ключ не может быть многострочной строкой"),
    ("keys cannot be multi-line literal strings", "ключ не может быть многострочной строкой"),
    ("missing array opening", "нет открывающей скобки массива"),
    ("missing assignment between key-value pairs", "нет знака `=` или перевода строки между парами"),
    ("missing comma between array elements", "нет запятой между элементами массива"),
    ("missing comma between key-value pairs", "нет запятой между парами"),
    ("missing comment start", "нет начала примечания"),
    ("missing escaped value", "нет знака после обратной косой черты"),
    ("missing inline table opening", "нет открывающей скобки встроенной таблицы"),
    ("missing key for inline table element", "нет ключа у элемента встроенной таблицы"),
    ("missing opening quote", "нет открывающей кавычки"),
    ("missing table open", "нет открывающей скобки таблицы"),
    ("missing value for key", "нет значения ключа"),
    ("missing value", "нет значения"),
    ("radix must be lowercase", "основание числа пишут строчной буквой"),
    ("redundant integer number prefix", "лишняя приставка целого числа"),
    ("redundant numeric sign", "лишний знак числа"),
    ("string values must be quoted", "строки берут в кавычки"),
    ("too few unicode value digits", "слишком мало цифр в коде знака"),
    ("unclosed array table", "заголовок массива таблиц не закрыт"),
    ("unclosed array", "массив не закрыт"),
    ("unclosed inline table", "встроенная таблица не закрыта"),
    ("unclosed table", "заголовок таблицы не закрыт"),
    ("unexpected `=` in array", "лишний знак `=` в массиве"),
    ("unexpected content between comment and newline", "лишнее между примечанием и концом строки"),
    ("unexpected content between key and value", "лишнее между ключом и значением"),
    ("unexpected content", "лишний текст"),
    ("unexpected key or value", "лишний ключ или значение"),
    ("unexpected leading zero", "лишний нуль в начале числа"),
    ("unexpected sign", "лишний знак числа"),
    ("unquoted keys cannot be empty", "ключ пуст"),
];

const EXPECTED: &[(&str, &str)] = &[
    ("basic string", "строка в кавычках"),
    ("literal string", "строка в апострофах"),
    ("multi-line basic string", "многострочная строка"),
    ("characters", "знаки"),
    ("digits", "цифры"),
    ("key", "ключ"),
    ("letters", "буквы"),
    ("newline", "перевод строки"),
    ("non-double-quote visible characters", "видимые знаки, кроме кавычек"),
    ("non-single-quote characters", "знаки, кроме апострофа"),
    ("non-single-quote visible characters", "видимые знаки, кроме апострофа"),
    ("nothing", "ничего"),
    ("numbers", "числа"),
    ("printable characters", "печатные знаки"),
    ("unicode hexadecimal value", "шестнадцатеричный код знака"),
    ("value", "значение"),
];

#[cfg(test)]
mod tests {
    use super::russian;

    /// Every text cut and damaged in many places: no message keeps an English word.
    #[test]
    fn no_message_of_the_parser_stays_english() {
        let text = "title = \"a \\u0041 b\"\n[bodies.b]\norigin = [\"x\", 0, 0x1f, 1_000]\nz = { a = 1, 'b' = '''c''' }\nd = 1979-05-27T07:32:00Z\n[[study]] # end\nok = true\n";
        let mut heads = std::collections::BTreeSet::new();
        for at in 0..text.len() {
            for put in ["", "=", ",", "]", "[", "{", "}", "\"", "'", "\\", "\r", "\u{1}", "0", "_", "x", "\n", "\"\"\"", "+", "e", "."] {
                for take in [0, 1, 3] {
                    let damaged = format!("{}{put}{}", &text[..at], &text[(at + take).min(text.len())..]);
                    let (_, errors) = toml::de::DeTable::parse_recoverable(&damaged);
                    for error in errors.iter().filter(|e| !e.message().contains("duplicate")) {
                        let ru = russian(error.message());
                        let bare: String = ru.split('`').step_by(2).collect();
                        assert!(!bare.chars().any(|c| c.is_ascii_alphabetic()), "{ru}");
                        assert!(!ru.starts_with("неверная запись") && !ru.contains("другая запись"), "{}", error.message());
                        heads.insert(error.message().split(',').next().unwrap_or_default().to_owned());
                    }
                }
            }
        }
        assert!(heads.len() > 25, "{heads:?}");
    }
}
