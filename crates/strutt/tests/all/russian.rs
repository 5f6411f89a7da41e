//! What a Russian reader sees of every machine of the gallery, on the terminal and on the page: no English, no Latin name of a unit.

use crate::common;

use common::{folder, gallery, in_parallel, is_written, stdout, strutt};
use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Mutex;

use studies::{Failure, Source, Watch, pipeline};
use toml::de::{DeTable, DeValue};

/// Functions and signs of formulas, indices of symbols.
const FORMULAS: &[&str] = &[
    "sin", "cos", "tg", "arctg", "arcsin", "arccos", "exp", "sign", "dt", "dE", "dx", "Re", "Im", "im", "max", "min", "xy", "pi", "tr",
    "ch",
];
/// Formats, keys of the file and programs.
const FORMATS: &[&str] = &["JSON", "CSV", "Excel", "strutt"];
/// Keys whose value is a text or symbol of the user's own.
const OWN_TEXTS: &[&str] = &["symbol", "name", "title", "label", "source", "text", "en", "ru"];
/// Names of units of more than a letter, and of a letter.
const UNITS: &[&str] = &["rad", "kg", "mm", "cm", "km", "Hz", "Pa", "MPa", "GPa", "kN", "ms", "deg", "rpm", "mol"];
const LETTERS: &str = "NmsJWKVA";

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_ascii_alphabetic()).filter(|w| !w.is_empty())
}

/// Every word that the model itself brings: names, and its own texts.
fn names(table: &DeTable, out: &mut BTreeSet<String>) {
    for (key, value) in table {
        let key = key.get_ref().as_ref();
        out.extend(words(key).map(str::to_owned));
        within(value.get_ref(), key, out);
    }
}

fn within(value: &DeValue, key: &str, out: &mut BTreeSet<String>) {
    match value {
        DeValue::Table(table) => names(table, out),
        DeValue::Array(items) => items.iter().for_each(|item| within(item.get_ref(), key, out)),
        DeValue::String(text) if OWN_TEXTS.contains(&key) => out.extend(words(text).map(str::to_owned)),
        _ => {}
    }
}

/// The text of a page without programs, styles, formulas as MathML, and tags.
fn visible(page: &str) -> String {
    let mut rest = page.to_owned();
    for tag in ["script", "style", "math"] {
        let mut kept = String::new();
        let mut tail = rest.as_str();
        while let Some(start) = tail.find(&format!("<{tag}")) {
            let end = tail[start..].find(&format!("</{tag}>")).map_or(tail.len(), |end| start + end);
            kept.push_str(&tail[..start]);
            kept.push(' ');
            tail = &tail[end..];
        }
        rest = kept + tail;
    }
    let mut text = String::new();
    let mut inside = false;
    for c in rest.chars() {
        match c {
            '<' => inside = true,
            '>' if inside => {
                inside = false;
                text.push(' ');
            }
            _ if !inside => text.push(c),
            _ => {}
        }
    }
    text.replace("&#39;", "'").replace("&quot;", "\"").replace("&amp;", "&").replace("&lt;", "<").replace("&gt;", ">")
}

/// Files, options with their values, and hashes say nothing in any language.
fn is_technical(piece: &str) -> bool {
    let bare = piece.trim_matches(|c: char| matches!(c, '(' | ')' | ',' | ';' | '`' | '"' | ':'));
    let file = [".svg", ".png", ".csv", ".json", ".toml", ".html"].iter().any(|end| bare.ends_with(end));
    file || bare.starts_with("--")
        || bare.contains('=') && bare.len() > 1
        || bare.len() == 16 && bare.bytes().all(|b| b.is_ascii_hexdigit())
}

/// Whether a Latin word is a name, a product of names, or one of formulas.
fn is_known(word: &str, names: &BTreeSet<String>) -> bool {
    let product = || word.len() < 4 && word.chars().all(|c| c == 't' || names.contains(c.to_string().as_str()));
    word.len() == 1 || names.contains(word) || FORMULAS.contains(&word) || FORMATS.contains(&word) || product()
}

/// Latin units in a line: `72 rad`, `N·m`, `x, m`.
fn units(line: &str, names: &BTreeSet<String>) -> Vec<String> {
    let mut found = Vec::new();
    let chars: Vec<char> = line.chars().collect();
    let at = |i: usize| chars.get(i).copied().unwrap_or('\n');
    for i in 0..chars.len() {
        let start = chars[i].is_ascii_alphabetic() && (i == 0 || !chars[i - 1].is_alphanumeric() && chars[i - 1] != '_');
        if !start {
            continue;
        }
        let word: String = chars[i..].iter().take_while(|c| c.is_alphanumeric()).collect();
        let after = i + word.chars().count();
        let number = i >= 2 && matches!(chars[i - 1], ' ' | '\u{a0}') && chars[i - 2].is_ascii_digit();
        let letter = word.len() == 1 && LETTERS.contains(&word);
        let head = i >= 2 && chars[i - 2..i] == [',', ' '] && (at(after) == '\n' || at(after) == ' ' && at(after + 1) == ' ');
        let joined = at(after) == '·' && at(after + 1).is_ascii_alphabetic();
        if number && UNITS.contains(&word.as_str()) && !names.contains(&word) || letter && (head || joined) {
            found.push(word);
        }
    }
    found
}

/// The foreign words of a text, each with its line.
fn foreign(text: &str, names: &BTreeSet<String>) -> Vec<String> {
    let mut found = Vec::new();
    for line in text.lines().filter(|l| !l.starts_with("дальше: ")) {
        found.extend(units(line, names).into_iter().map(|unit| format!("unit {unit}: {line}")));
        for piece in line.split_whitespace().filter(|p| !p.contains('/') || !p.contains('.')).filter(|p| !is_technical(p)) {
            let mut rest = piece;
            while let Some(start) = rest.find(|c: char| c.is_ascii_alphabetic()) {
                let tail = &rest[start..];
                let end = tail.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(tail.len());
                let called = tail[end..].starts_with('(');
                found.extend(words(&tail[..end]).filter(|w| !called && !is_known(w, names)).map(|w| format!("{w}: {line}")));
                rest = &tail[end..];
            }
        }
    }
    found
}

/// Everything that a reader of a model sees in Russian.
fn seen(model: &str, out: &Path) -> Vec<String> {
    let (file, folder) = (gallery(model), out.join(model));
    let run = |args: &[&str]| stdout(strutt().args(args).args([file.as_str(), "--lang", "ru"]));
    let mut seen = vec![run(&["check"]), run(&["equations", "--steps"]), run(&["run", "--out", folder.to_str().unwrap()])];
    assert!(!seen[2].contains("NaN"), "{model}");
    if strutt::gallery::names().any(|name| name == model) {
        is_written(model, &folder, "ru");
    }
    // a file without studies has no page
    seen.push(visible(&std::fs::read_to_string(folder.join("index.html")).unwrap_or_default()));
    seen
}

fn foreign_of(model: &str, out: &Path) -> Vec<String> {
    let text = std::fs::read_to_string(gallery(model)).unwrap();
    let mut known = words(model).map(str::to_owned).collect();
    names(DeTable::parse(&text).unwrap().get_ref(), &mut known);
    let found = seen(model, out).into_iter().flat_map(|text| foreign(&text, &known));
    found.map(|line| format!("{model}: {}", line.chars().take(160).collect::<String>())).collect()
}

#[test]
fn no_english_and_no_latin_units_in_russian_output() {
    let out = folder("russian");
    let root = format!("{}/../../gallery", env!("CARGO_MANIFEST_DIR"));
    let mut models: Vec<String> = std::fs::read_dir(root).unwrap().map(|d| d.unwrap().file_name().into_string().unwrap()).collect();
    models.retain(|name| Path::new(&gallery(name)).exists());
    models.sort();
    assert!(models.len() > 40, "{models:?}");
    let found = Mutex::new(Vec::new());
    in_parallel(&models, |model| {
        let own = foreign_of(model, &out);
        found.lock().unwrap().extend(own);
    });
    let mut found = found.into_inner().unwrap();
    found.sort();
    assert!(found.is_empty(), "{} foreign words:\n{}", found.len(), found.join("\n"));
}

#[test]
fn the_search_sees_what_it_is_for() {
    let names = ["phi", "girder", "m"].map(str::to_owned).into();
    let sees = |line: &str| !foreign(line, &names).is_empty();
    for wrong in ["наибольший growth корня", "phi_amplitude, мм", "Section girder", "жёсткость 72 N·m/rad", "не менее 5 rad", "x, m  y, м"]
    {
        assert!(sees(wrong), "{wrong}");
    }
    for right in ["Сечение «girder»", "phi, рад  y, м", "m g cos φ", "force_x(girder) = 5 Н", "motion.csv таблица", "--set phi=1"]
    {
        assert!(!sees(right), "{right}: {:?}", foreign(right, &names));
    }
}

/// A message without what it quotes from a file: names, formulas and lines as they are typed.
fn unquoted(text: &str) -> String {
    let mut out = String::new();
    let mut quote = None;
    for c in text.chars() {
        match (quote, c) {
            (None, '`' | '"') => quote = Some(c),
            (None, '[') => quote = Some(']'),
            (Some(end), c) if c == end => quote = None,
            (None, c) => out.push(c),
            _ => {}
        }
    }
    out
}

/// A decimal point, or a Latin unit, in the Russian words of a notice.
fn slips(text: &str) -> bool {
    let plain = unquoted(text);
    let chars: Vec<char> = plain.chars().collect();
    let digit = |i: usize| chars.get(i).is_some_and(char::is_ascii_digit);
    let point = (1..chars.len()).any(|i| chars[i] == '.' && digit(i - 1) && digit(i + 1));
    let letter =
        |i: usize| LETTERS.contains(chars[i]) && !chars.get(i + 1).is_some_and(|c| c.is_alphanumeric() || matches!(c, '_' | '\'' | '('));
    let unit = (2..chars.len()).any(|i| chars[i - 1] == ' ' && digit(i - 2) && letter(i));
    point || unit || !units(&plain, &BTreeSet::new()).is_empty()
}

#[test]
fn messages_have_the_numbers_and_units_of_their_language() {
    let chapters = mechanics::elements::TABLE.iter().map(|row| row.chapter).chain(["errors"]).collect::<BTreeSet<_>>();
    let chapter = |name| std::fs::read_to_string(format!("{}/../../tests/book/{name}.md", env!("CARGO_MANIFEST_DIR"))).unwrap();
    let book: String = chapters.into_iter().map(chapter).collect();
    let models = book.split("```toml\n").skip(1).filter_map(|rest| rest.split("```").next()).filter(|model| !model.starts_with("# patch"));
    let mut found = Vec::new();
    let mut count = 0;
    for model in models {
        let notices = match pipeline::build(&Source::new("model.toml", model), &[], &mut Watch::default()) {
            Ok(machine) => machine.warnings,
            Err(Failure::Findings { diagnostics, .. }) => diagnostics,
            Err(Failure::Trouble(notice) | Failure::Misuse(notice)) => vec![*notice],
            Err(Failure::ClosedPipe) => Vec::new(),
        };
        count += notices.len();
        let texts = notices.iter().flat_map(|n| [&n.what.ru, &n.why.ru, &n.help.ru].map(|text| (n.code, text)));
        found.extend(texts.filter(|(_, text)| slips(text)).map(|(code, text)| format!("{code}: {text}")));
    }
    assert!(count > 100, "{count} notices: are these the models of the chapter?");
    assert!(found.is_empty(), "\n{}", found.join("\n"));
    assert!(slips("трение покоя 5 N") && slips("радиус 0.3 м") && !slips("радиус 0,3 м, напишите `0.3`"));
}
