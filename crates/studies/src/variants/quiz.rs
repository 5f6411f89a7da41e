//! The questions of a class for learning systems: Moodle XML (numerical questions with units) and GIFT.

use super::guards::allowed;
use super::key::{Entry, Key};
use mechanics::Model;
use mechanics::model::AnswerDecl;
use report::escape::xml;
use std::fmt::Write;
use words::Language;

/// What a question says: what is given to the variant, then what is asked.
fn question(entry: &Entry, (answer, given): (&AnswerDecl, &str), language: Language) -> String {
    let unit = report::unit::print(&answer.unit.label, language);
    let unit = if unit.is_empty() { String::new() } else { format!(", {unit}") };
    let variant = language.pick("Variant", "Вариант");
    let given = given.trim_end_matches('.');
    let given = if given.is_empty() { String::new() } else { format!(" {given}.") };
    format!("{variant} {}.{given} {}{unit}?", entry.member.name, language.text(&answer.ask))
}

/// An item that has a right number (with the size of its quantity), with what is given.
type Item<'k> = (&'k Entry, (&'k AnswerDecl, &'k str), (f64, f64));

fn items<'k>((key, given): (&'k Key, &'k [String]), model: &'k Model) -> impl Iterator<Item = Item<'k>> {
    let of = |(e, given): (&'k Entry, &'k String)| {
        let right = move |i: usize| Some((e.truths.get(i).copied().flatten()?, e.sizes.get(i).copied().unwrap_or(0.0)));
        model.answers.iter().enumerate().filter_map(move |(i, a)| Some((e, (a, given.as_str()), right(i)?)))
    };
    key.entries.iter().zip(given).flat_map(of)
}

/// Moodle XML: a category for each variant, a numerical question for each item. `given`: what each entry of the key is given.
pub fn moodle((key, given): (&Key, &[String]), model: &Model, language: Language) -> String {
    let title = language.text(&model.title);
    let mut out = format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<quiz>\n<!-- strutt {}, model {} -->\n", key.version, key.hash());
    let mut category = String::new();
    for (entry, (answer, given), right) in items((key, given), model) {
        if category != entry.member.name {
            category.clone_from(&entry.member.name);
            let path = format!("$course$/top/{}/{category}", title.replace('/', "//"));
            let _ = writeln!(out, "<question type=\"category\"><category><text>{}</text></category></question>", xml(&path));
        }
        let (name, text) = (format!("{}-{}", entry.member.name, answer.id), question(entry, (answer, given), language));
        let _ = writeln!(out, "<question type=\"numerical\">\n<name><text>{}</text></name>", xml(&name));
        let _ =
            writeln!(out, "<questiontext format=\"plain_text\"><text>{}</text></questiontext>\n<defaultgrade>1</defaultgrade>", xml(&text));
        let _ =
            writeln!(out, "<answer fraction=\"100\"><text>{}</text><tolerance>{}</tolerance></answer>", right.0, allowed(answer, right));
        if !answer.unit.label.is_empty() {
            let unit = report::unit::print(&answer.unit.label, language);
            let _ = writeln!(out, "<units><unit><multiplier>1</multiplier><unit_name>{}</unit_name></unit></units>", xml(&unit));
            // the unit may be left out: the question names it
            let _ = writeln!(out, "<unitgradingtype>0</unitgradingtype><unitpenalty>0</unitpenalty><showunits>3</showunits>");
        }
        out.push_str("</question>\n");
    }
    out.push_str("</quiz>\n");
    out
}

/// GIFT: a numerical question for each item. `given`: what each entry of the key is given.
pub fn gift((key, given): (&Key, &[String]), model: &Model, language: Language) -> String {
    let title = language.text(&model.title);
    let mut out = format!("// strutt {}, model {}\n", key.version, key.hash());
    let mut category = String::new();
    for (entry, (answer, given), right) in items((key, given), model) {
        if category != entry.member.name {
            category.clone_from(&entry.member.name);
            let _ = write!(out, "\n$CATEGORY: {}/{category}\n", title.replace('/', "//").replace('\n', " "));
        }
        let text = question(entry, (answer, given), language);
        let name = escaped(&format!("{}-{}", entry.member.name, answer.id));
        let _ = writeln!(out, "\n::{name}::{} {{#{}:{}}}", escaped(&text), right.0, allowed(answer, right));
    }
    out
}

fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '~' | '=' | '#' | '{' | '}' | ':' | '\\' => out.extend(['\\', c]),
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn special_characters_are_escaped() {
        assert_eq!(xml("a < b & \"c\"\u{1}"), "a &lt; b &amp; &quot;c&quot; ");
        assert_eq!(escaped("r = {5:3}"), "r \\= \\{5\\:3\\}");
    }
}
