//! The model file as an appendix shows it: texts in the language of the reader, remarks of the other language left out. What it says of the machine stays.

use words::Language;

/// The file in one language.
pub(super) fn in_language(source: &str, language: Language) -> String {
    let mut out: Vec<String> = Vec::new();
    let lines: Vec<&str> = source.lines().collect();
    let mut long = false;
    for (i, line) in lines.iter().enumerate() {
        // within texts of several lines nothing is a remark
        let marks = line.matches("\"\"\"").count() + line.matches("'''").count();
        let inside = long;
        long ^= marks % 2 == 1;
        if inside || marks > 0 {
            out.push((*line).to_owned());
            continue;
        }
        let near = [i.checked_sub(1), Some(i + 1)].into_iter().flatten().filter_map(|k| lines.get(k));
        if begins(line, other(language)) && near.clone().any(|l| begins(l, code(language))) {
            continue;
        }
        let told = chosen(&remarked(line, language), language);
        if !told.trim().is_empty() || line.trim().is_empty() {
            out.push(told.trim_end().to_owned());
        }
    }
    // one empty line where a remark stood between two
    out.dedup_by(|a, b| a.is_empty() && b.is_empty());
    out.join("\n")
}

fn code(language: Language) -> &'static str {
    language.pick("en", "ru")
}

fn other(language: Language) -> &'static str {
    language.pick("ru", "en")
}

/// Whether a line gives the text of a language.
fn begins(line: &str, code: &str) -> bool {
    line.trim_start().strip_prefix(code).is_some_and(|rest| rest.trim_start().starts_with('='))
}

/// The line without a remark in the other language.
fn remarked(line: &str, language: Language) -> String {
    let Some(at) = remark(line) else { return line.to_owned() };
    let (told, said) = line.split_at(at);
    let russian = said.chars().any(|c| ('а'..='я').contains(&c.to_lowercase().next().unwrap_or(c)));
    let letters = said.chars().any(char::is_alphabetic);
    if letters && russian != (language == Language::Ru) { told.trim_end().to_owned() } else { line.to_owned() }
}

/// Where a remark begins: # outside of texts.
fn remark(line: &str) -> Option<usize> {
    let (mut quote, mut escaped) = (None, false);
    for (at, c) in line.char_indices() {
        match (quote, c) {
            _ if escaped => escaped = false,
            (Some('"'), '\\') => escaped = true,
            (Some(open), c) if c == open => quote = None,
            (Some(_), _) => {}
            (None, '"' | '\'') => quote = Some(c),
            (None, '#') => return Some(at),
            _ => {}
        }
    }
    None
}

/// `{ en = "mass", ru = "масса" }` as the text of the language.
fn chosen(line: &str, language: Language) -> String {
    let (mut out, mut rest) = (String::new(), line);
    while let Some(at) = rest.find('{') {
        let (before, table) = rest.split_at(at);
        out.push_str(before);
        match pair(table) {
            Some((texts, end)) => {
                let (_, text) = texts.iter().find(|(key, _)| *key == code(language)).unwrap_or(&texts[0]);
                out.push_str(text);
                rest = &table[end..];
            }
            None => {
                out.push('{');
                rest = &table[1..];
            }
        }
    }
    out + rest
}

/// A table of nothing but `en` and `ru`: keys with their quoted texts, and where it ends.
fn pair(table: &str) -> Option<([(&str, &str); 2], usize)> {
    let mut at = 1;
    let mut found = Vec::new();
    for ending in [',', '}'] {
        let rest = &table[at..];
        let key = ["en", "ru"].into_iter().find(|key| begins(rest, key))?;
        let open = at + rest.find('"')?;
        if table[at..open].trim_start().trim_start_matches(key).trim() != "=" {
            return None;
        }
        let close = open + 1 + closing(&table[open + 1..])?;
        found.push((key, &table[open..=close]));
        let behind = &table[close + 1..];
        let gap = behind.len() - behind.trim_start().len();
        if !behind[gap..].starts_with(ending) {
            return None;
        }
        at = close + 1 + gap + 1;
    }
    let [first, second] = found[..] else { return None };
    (first.0 != second.0).then_some(([first, second], at))
}

/// The mark that closes a text.
fn closing(text: &str) -> Option<usize> {
    let mut escaped = false;
    for (at, c) in text.char_indices() {
        match c {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            '"' => return Some(at),
            _ => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = "title = { en = \"A # mark\", ru = \"Знак\" }   # what it is\n\n# only a remark\n[description]\nen = \"Words.\"\nru = \"Слова.\"\n\n[parameters]\nm = { value = \"2 kg\", label = { ru = \"масса \\\"m\\\"\", en = \"mass\" } } # масса\n";

    #[test]
    fn texts_and_remarks_are_those_of_the_language() {
        let ru = "title = \"Знак\"\n\n[description]\nru = \"Слова.\"\n\n[parameters]\nm = { value = \"2 kg\", label = \"масса \\\"m\\\"\" } # масса";
        assert_eq!(in_language(FILE, Language::Ru), ru);
        let en = "title = \"A # mark\"   # what it is\n\n# only a remark\n[description]\nen = \"Words.\"\n\n[parameters]\nm = { value = \"2 kg\", label = \"mass\" }";
        assert_eq!(in_language(FILE, Language::En), en);
    }

    #[test]
    fn tables_of_other_keys_and_long_texts_stay() {
        let text = "a = { en = \"x\" }\nb = { en = \"x\", de = \"y\" }\nc = \"\"\"\n# no remark\n\"\"\"";
        assert_eq!(in_language(text, Language::Ru), text);
    }
}
