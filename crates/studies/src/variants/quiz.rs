//! The questions of a class for learning systems: Moodle XML and GIFT, numerical questions whose text names the unit.
//!
//! *Source*: `question/format/xml/format.php`, `question/format/gift/format.php` and `question/type/numerical/` of Moodle.

use super::guards::allowed;
use super::key::{Entry, Key};
use mechanics::Model;
use mechanics::model::AnswerDecl;
use report::escape::xml;
use std::fmt::Write;
use words::Language;

/// `qtype_numerical::UNITNONE` of Moodle.
const NO_UNIT: u8 = 3;

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
    let mut category = None;
    for (entry, (answer, given), right) in items((key, given), model) {
        if category.replace(&entry.member.name) != Some(&entry.member.name) {
            let path = format!("$course$/top/{}/{}", folder(title), folder(&entry.member.name));
            let _ = writeln!(out, "<question type=\"category\"><category><text>{}</text></category></question>", xml(&path));
        }
        let (name, text) = (format!("{}-{}", entry.member.name, answer.id), question(entry, (answer, given), language));
        let _ = writeln!(out, "<question type=\"numerical\">\n<name><text>{}</text></name>", xml(&name));
        let _ =
            writeln!(out, "<questiontext format=\"plain_text\"><text>{}</text></questiontext>\n<defaultgrade>1</defaultgrade>", xml(&text));
        let _ =
            writeln!(out, "<answer fraction=\"100\"><text>{}</text><tolerance>{}</tolerance></answer>", right.0, allowed(answer, right));
        // a number alone: a unit that is typed behind it is asked to be left out and is never taken for the one of the question
        let _ = writeln!(out, "<unitgradingtype>0</unitgradingtype><unitpenalty>0</unitpenalty><showunits>{NO_UNIT}</showunits>");
        out.push_str("</question>\n");
    }
    out.push_str("</quiz>\n");
    out
}

/// GIFT: a numerical question for each item. `given`: what each entry of the key is given.
pub fn gift((key, given): (&Key, &[String]), model: &Model, language: Language) -> String {
    let title = language.text(&model.title);
    let mut out = format!("// strutt {}, model {}\n", key.version, key.hash());
    let mut category = None;
    for (entry, (answer, given), right) in items((key, given), model) {
        if category.replace(&entry.member.name) != Some(&entry.member.name) {
            let _ = write!(out, "\n$CATEGORY: {}/{}\n", folder(title), folder(&entry.member.name));
        }
        let text = question(entry, (answer, given), language);
        let name = escaped(&format!("{}-{}", entry.member.name, answer.id));
        let _ = writeln!(out, "\n::{name}::[plain]{} {{#{}:{}}}", escaped(&text), right.0, allowed(answer, right));
    }
    out
}

/// A folder of questions: a stroke in a name is no border of folders, and a name is one line.
fn folder(name: &str) -> String {
    name.replace('/', "//").chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
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
        assert_eq!(folder("group 7/1\nA"), "group 7//1 A");
    }
}
