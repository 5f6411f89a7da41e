//! Findings as text: the user's line with a caret for people, one line for editors, JSON for machines.

use crate::wording::{Word, say};
use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet, normalize_untrusted_str as clean};
use serde_json::{Value, json};
use std::ops::Range;
use studies::Source;
use words::{Language, Notice, Place, Severity};

/// How findings are shown.
#[derive(Clone, Copy, Debug)]
pub struct Style {
    /// Language of the messages.
    pub language: Language,
    /// Colours.
    pub colour: bool,
}

/// All findings with the user's lines, then how many there are and where to read more.
pub fn render(diagnostics: &[Notice], source: &Source, style: Style) -> String {
    let lines = Lines::of(&source.text);
    let mut out = String::new();
    for diagnostic in diagnostics {
        out.push_str(&picture(diagnostic, source, &lines, style));
        out.push_str("\n\n");
    }
    out.push_str(&closing(diagnostics, style.language));
    out
}

fn picture(diagnostic: &Notice, source: &Source, lines: &Lines, style: Style) -> String {
    let language = style.language;
    let (level, word) = match diagnostic.severity {
        Severity::Error => (Level::ERROR, Word::Error),
        Severity::Warning => (Level::WARNING, Word::Warning),
    };
    let title = level.with_name(say(language, word)).primary_title(language.text(&diagnostic.what)).id(diagnostic.code);
    let group = match snippet(diagnostic, source, lines, language) {
        Some(snippet) => title.element(snippet),
        None => Group::with_title(title),
    };
    renderer(style).render(&[remarks(group, &diagnostic.why, &diagnostic.help, language)])
}

/// The lines from the first to the last place that belongs to the finding.
fn snippet<'a>(
    diagnostic: &'a Notice,
    source: &'a Source,
    lines: &Lines,
    language: Language,
) -> Option<Snippet<'a, annotate_snippets::Annotation<'a>>> {
    let span = match &diagnostic.place {
        Place::Override { text, span, .. } => {
            let span = within(text, span);
            return Some(Snippet::source(text.as_str()).path("--set").annotation(AnnotationKind::Primary.span(span)));
        }
        Place::CommandLine { text, span } => {
            let span = within(text, span);
            let path = language.pick("command line", "командная строка");
            return Some(Snippet::source(text.as_str()).path(path).annotation(AnnotationKind::Primary.span(span)));
        }
        Place::File(span) => within(&source.text, span),
        Place::Nowhere | Place::Piece(_) => return None,
    };
    let related: Vec<(Range<usize>, &str)> =
        diagnostic.related.iter().map(|(span, text)| (within(&source.text, span), language.text(text))).collect();
    let places = || related.iter().map(|(span, _)| span).chain([&span]);
    let first = lines.number(places().map(|s| s.start).min().unwrap_or(0));
    let last = lines.number(places().map(|s| s.end).max().unwrap_or(0));
    let from = lines.starts[first];
    let to = lines.starts.get(last + 1).copied().unwrap_or(source.text.len());
    let shown = |span: &Range<usize>| span.start - from..span.end - from;
    let mut snippet = Snippet::source(&source.text[from..to])
        .path(source.path.as_str())
        .line_start(first + 1)
        .annotation(AnnotationKind::Primary.span(shown(&span)));
    for (span, text) in &related {
        snippet = snippet.annotation(AnnotationKind::Context.span(shown(span)).label(*text));
    }
    Some(snippet)
}

fn remarks<'a>(group: Group<'a>, why: &'a words::Text, help: &'a words::Text, language: Language) -> Group<'a> {
    let mut group = group;
    for (text, level, word) in [(why, Level::NOTE, Word::Why), (help, Level::HELP, Word::Help)] {
        let text = language.text(text);
        if !text.is_empty() {
            group = group.element(level.with_name(say(language, word)).message(clean(text)));
        }
    }
    group
}

fn renderer(style: Style) -> Renderer {
    if style.colour { Renderer::styled() } else { Renderer::plain() }
}

/// How many findings there are, and how to read about the first.
fn closing(diagnostics: &[Notice], language: Language) -> String {
    let count = |severity| diagnostics.iter().filter(|d| d.severity == severity).count();
    let (errors, warnings) = (count(Severity::Error), count(Severity::Warning));
    let mut parts = Vec::new();
    if errors > 0 {
        parts.push(language.pick(plural(errors, "error"), format!("ошибок: {errors}")));
    }
    if warnings > 0 {
        parts.push(language.pick(plural(warnings, "warning"), format!("предупреждений: {warnings}")));
    }
    let worst = diagnostics.iter().min_by_key(|d| d.severity);
    let more = worst.map_or_else(String::new, |d| format!("; {} strutt explain {}", say(language, Word::MoreAbout), d.code));
    format!("{}{more}\n", parts.join(", "))
}

fn plural(n: usize, word: &str) -> String {
    if n == 1 { format!("1 {word}") } else { format!("{n} {word}s") }
}

/// A trouble in the same manner, without a snippet.
pub fn render_trouble(trouble: &Notice, style: Style) -> String {
    let language = style.language;
    let title = Level::ERROR.with_name(say(language, Word::Error)).primary_title(language.text(&trouble.what));
    let title = if trouble.code.is_empty() { title } else { title.id(trouble.code) };
    let group = remarks(Group::with_title(title), &trouble.why, &trouble.help, language);
    let mut out = renderer(style).render(&[group]);
    out.push('\n');
    if !trouble.code.is_empty() {
        out.push_str(&format!("{} strutt explain {}\n", say(language, Word::MoreAbout), trouble.code));
    }
    out
}

/// One line per finding: `file:line:column: error[M021]: what`.
pub fn short(diagnostics: &[Notice], source: &Source, language: Language) -> String {
    let lines = Lines::of(&source.text);
    let mut out = String::new();
    for d in diagnostics {
        let place = match &d.place {
            Place::File(span) => {
                let (line, column) = lines.position(&source.text, span.start);
                format!("{}:{line}:{column}", source.path)
            }
            Place::Override { text, span, .. } => {
                let before = &text[..within(text, span).start];
                format!("--set {text}:1:{}", before.chars().count() + 1)
            }
            Place::CommandLine { text, span } => {
                let before = &text[..within(text, span).start];
                format!("{text}:1:{}", before.chars().count() + 1)
            }
            Place::Nowhere | Place::Piece(_) => source.path.clone(),
        };
        let word = say(language, if d.severity == Severity::Error { Word::Error } else { Word::Warning });
        let what = language.text(&d.what).replace('\n', " ");
        out.push_str(&format!("{place}: {word}[{}]: {what}\n", d.code));
    }
    out
}

/// Findings as JSON. Lines and columns count from 1, columns in characters.
pub fn to_json(diagnostics: &[Notice], source: &Source, language: Language) -> Value {
    let lines = Lines::of(&source.text);
    let place = |span: &Range<usize>| {
        let (line, column) = lines.position(&source.text, span.start);
        let (end_line, end_column) = lines.position(&source.text, span.end);
        json!({"line": line, "column": column, "end_line": end_line, "end_column": end_column})
    };
    let one = |d: &Notice| {
        let mut value = json!({
            "code": d.code,
            "severity": if d.severity == Severity::Error { "error" } else { "warning" },
            "what": language.text(&d.what), "why": language.text(&d.why), "help": language.text(&d.help),
            "related": d.related.iter().map(|(span, text)| json!({"place": place(span), "what": language.text(text)})).collect::<Vec<_>>(),
        });
        match &d.place {
            Place::File(span) => value["place"] = place(span),
            Place::Override { text, .. } => value["set"] = json!(text),
            Place::CommandLine { text, .. } => value["option"] = json!(text),
            Place::Nowhere | Place::Piece(_) => {}
        }
        value
    };
    Value::Array(diagnostics.iter().map(one).collect())
}

/// The range cut to the text and to whole characters.
fn within(text: &str, span: &Range<usize>) -> Range<usize> {
    let floor = |mut i: usize| {
        i = i.min(text.len());
        while !text.is_char_boundary(i) {
            i -= 1;
        }
        i
    };
    let start = floor(span.start);
    start..floor(span.end).max(start)
}

/// Where lines start.
struct Lines {
    starts: Vec<usize>,
}

impl Lines {
    fn of(text: &str) -> Lines {
        Lines { starts: std::iter::once(0).chain(text.match_indices('\n').map(|(i, _)| i + 1)).collect() }
    }

    /// Number of the line, from 0.
    fn number(&self, byte: usize) -> usize {
        self.starts.partition_point(|&s| s <= byte) - 1
    }

    /// Line and column, from 1.
    fn position(&self, text: &str, byte: usize) -> (usize, usize) {
        let byte = within(text, &(byte..byte)).start;
        let line = self.number(byte);
        (line + 1, text[self.starts[line]..byte].chars().count() + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use words::Text;

    fn plain(language: Language) -> Style {
        Style { language, colour: false }
    }

    fn finding(text: &str, word: &str) -> Notice {
        let start = text.find(word).unwrap();
        Notice::file("M021", start..start + word.len(), Text::new("unknown name", "неизвестное имя"))
            .why("a cause", "причина")
            .help("a cure", "средство")
    }

    #[test]
    fn the_caret_stands_under_cyrillic_text() {
        let source = Source::new("м.toml", "a = 1\nмасса = \"груз + ж\"\n");
        let text = render(&[finding(&source.text, "груз")], &source, plain(Language::Ru));
        let lines: Vec<&str> = text.lines().collect();
        let user = lines.iter().position(|l| l.contains("масса")).unwrap();
        let column = |line: &str, what: &str| line[..line.find(what).unwrap()].chars().count();
        assert_eq!(column(lines[user], "груз"), column(lines[user + 1], "^^^^"), "\n{text}");
        assert!(text.starts_with("ошибка[M021]: неизвестное имя"), "\n{text}");
        assert!(text.contains("м.toml:2:10"), "\n{text}");
        assert!(text.ends_with("ошибок: 1; подробнее: strutt explain M021\n"), "\n{text}");
    }

    #[test]
    fn places_outside_the_text_do_no_harm() {
        let source = Source::new("a.toml", "я");
        for span in [0..0, 1..1, 5..9, 1..2, 2..2, 0..usize::MAX] {
            let d = Notice::file("M001", span.clone(), Text::same("x")).related(span, Text::same("y"));
            assert!(!render(std::slice::from_ref(&d), &source, plain(Language::En)).is_empty());
            assert!(short(std::slice::from_ref(&d), &source, Language::En).starts_with("a.toml:1:"));
            assert!(to_json(&[d], &source, Language::En).is_array());
        }
    }

    #[test]
    fn editors_get_one_line() {
        let source = Source::new("a.toml", "m = 1\nk = m + q\n");
        assert_eq!(short(&[finding(&source.text, "q")], &source, Language::En), "a.toml:2:9: error[M021]: unknown name\n");
    }
}
