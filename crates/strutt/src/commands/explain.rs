//! `strutt explain CODE`.

use super::Exit;
use crate::args;
use crate::console::Console;
use serde_json::json;
use strutt::explain;
use studies::Failure;
use studies::failure::Misuse;
use words::Notice;
use words::explain::Explanation;

pub fn run(args: &args::Explain, console: &mut Console) -> Result<Exit, Failure> {
    let Some(code) = &args.code else {
        list(console)?;
        return Ok(Exit::Done);
    };
    let explanation = explain::find(code).ok_or_else(|| unknown(code))?;
    let text = match console.tree() {
        Some(tree) => (tree.value)(&to_json(explanation, console)),
        None => write(explanation, console),
    };
    console.out(text)?;
    Ok(Exit::Done)
}

fn list(console: &Console) -> Result<(), Failure> {
    let mut all: Vec<_> = explain::all().collect();
    all.sort_by_key(|e| (rooms(e.code), e.code));
    if let Some(tree) = console.tree() {
        let list: Vec<_> = all.iter().map(|e| to_json(e, console)).collect();
        return console.out((tree.value)(&json!(list)));
    }
    let lines: String = all.iter().map(|e| format!("{}  {}\n", e.code, e.title(console.language))).collect();
    console.out(lines)
}

/// Codes of the model first, then of its evaluation, of studies, of the command line.
fn rooms(code: &str) -> usize {
    "MPSC".find(&code[..1]).unwrap_or(4)
}

fn write(e: &Explanation, console: &Console) -> String {
    let language = console.language;
    let title = format!("{}: {}", e.code, e.title(language));
    let body = wrap(e.text(language), console.width().min(100));
    let mut out = format!("{title}\n{}\n{body}", "-".repeat(title.chars().count()));
    for (heading, example) in [(console.pick("Wrong:", "Неверно:"), e.wrong), (console.pick("Right:", "Верно:"), e.right)] {
        if !example.is_empty() {
            let lines: String = example.trim_end().lines().map(|l| format!("  {l}\n")).collect();
            out.push_str(&format!("\n{heading}\n{lines}"));
        }
    }
    out
}

/// Paragraphs filled to the width.
fn wrap(text: &str, width: usize) -> String {
    let mut out = String::new();
    for paragraph in text.lines() {
        let mut used = 0;
        for word in paragraph.split(' ').filter(|w| !w.is_empty()) {
            let n = word.chars().count();
            if used > 0 {
                out.push(if used + 1 + n > width { '\n' } else { ' ' });
                used = if used + 1 + n > width { 0 } else { used + 1 };
            }
            out.push_str(word);
            used += n;
        }
        out.push('\n');
    }
    out
}

fn to_json(e: &Explanation, console: &Console) -> serde_json::Value {
    let language = console.language;
    json!({"code": e.code, "title": e.title(language), "body": e.text(language), "wrong": e.wrong, "right": e.right})
}

fn unknown(code: &str) -> Failure {
    let trouble = Notice::new("C010", format!("there is no code `{code}`"), format!("нет кода `{code}`"));
    match explain::near(code) {
        Some(near) => trouble.help(format!("did you mean {near}?"), format!("может быть, {near}?")),
        None => trouble.help("`strutt explain` lists all codes", "`strutt explain` показывает все коды"),
    }
    .misuse()
}
