//! `strutt examples [NAME]`: the embedded models.

use super::Exit;
use crate::args;
use crate::console::Console;
use serde_json::json;
use strutt::gallery;
use studies::failure::Misuse;
use studies::{Failure, Source};
use words::{Notice, nearest};

pub fn run(args: &args::Examples, console: &mut Console) -> Result<Exit, Failure> {
    match &args.name {
        Some(name) => console.out(find(name)?.text)?,
        None => list(console)?,
    }
    Ok(Exit::Done)
}

/// The example with a name.
pub fn find(name: &str) -> Result<&'static gallery::Example, Failure> {
    gallery::find(name).ok_or_else(|| {
        let trouble = Notice::new("C010", format!("there is no example `{name}`"), format!("нет примера `{name}`"));
        match nearest(name, gallery::names()) {
            Some(near) => trouble.help(format!("did you mean `{near}`?"), format!("может быть, `{near}`?")),
            None => trouble.help("`strutt examples` lists all of them", "`strutt examples` показывает все примеры"),
        }
        .misuse()
    })
}

fn list(console: &Console) -> Result<(), Failure> {
    let rows: Vec<(&str, String)> = gallery::EXAMPLES.iter().map(|e| (e.name, title(e, console))).collect();
    if let Some(tree) = console.tree() {
        let list: Vec<_> = rows.iter().map(|(name, title)| json!({"name": name, "title": title})).collect();
        return console.out((tree.value)(&json!(list)));
    }
    let width = rows.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
    let lines: String = rows.iter().map(|(name, title)| format!("{name:<width$}  {title}\n")).collect();
    console.out(lines)?;
    let first = "pendulum-on-shaft";
    console.next(&format!("strutt new {first} && strutt run {first}.toml"));
    Ok(())
}

fn title(example: &gallery::Example, console: &Console) -> String {
    let source = Source::new(example.name, example.text);
    let reading = studies::read(&source, &[]);
    reading.map_or_else(|_| String::new(), |r| console.language.text(&r.model.title).to_owned())
}
