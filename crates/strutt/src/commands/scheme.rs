//! `strutt scheme FILE`: the scheme of the machine, on standard output or as files.

use super::Exit;
use crate::args;
use crate::console::{Console, quoted};
use crate::quantities;
use mechanics::derive::Detail;
use report::Scheme;
use report::formats::Holds;
use serde_json::json;
use strutt::folder;
use strutt::wording::Word;
use studies::scheme::{Instant, Options};
use studies::{Failure, Machine, scheme};

pub fn run(args: &args::Scheme, console: &mut Console) -> Result<Exit, Failure> {
    let (source, mut machine) = super::open(&args.model, Detail::Equations, console)?;
    let at = match &args.at {
        Some(text) => Some(instant(&mut machine, text, console)?),
        None => None,
    };
    let options = Options { at, body: args.body.clone() };
    let language = console.language;
    let drawn = scheme::asked(&machine, &options, language)?;
    let svg = drawn.svg(language);
    let inputs = folder::inputs(&source, &machine.model);
    let mut written = Vec::new();
    if let Some(path) = &args.svg {
        folder::picture(path, svg.as_bytes(), &inputs)?;
        written.push(path);
    }
    if let Some(path) = &args.png {
        folder::picture(path, &folder::pixels(&svg, &drawn.name)?, &inputs)?;
        written.push(path);
    }
    match console.format.holds {
        Holds::Tree(tree) => console.out((tree.value)(&to_json(&drawn, &svg, console)))?,
        _ if written.is_empty() => console.out(svg)?,
        _ => {
            let list: String = written.iter().map(|p| format!("\n  {}", p.display())).collect();
            console.talk(&format!("{}{list}", console.say(Word::Written)));
            console.next(&format!("strutt run {}", quoted(&args.model.file)));
        }
    }
    Ok(Exit::Done)
}

fn to_json(scheme: &Scheme, svg: &str, console: &Console) -> serde_json::Value {
    let items = scheme.items.iter().map(|item| {
        let place = &item.place;
        json!({"path": item.path, "symbol": item.symbol.name, "at": place.at, "to": place.to, "size": place.size, "turn": place.turn})
    });
    json!({"title": scheme.title.plain(console.language), "version": studies::VERSION, "summary": scheme.summary,
        "items": items.collect::<Vec<_>>(), "svg": svg})
}

/// A time of the motion, or the place of rest.
fn instant(machine: &mut Machine, text: &str, console: &mut Console) -> Result<Instant, Failure> {
    if matches!(text.trim(), "rest" | "equilibrium") {
        return console.watched(|watch| scheme::at_rest(machine, watch)).map_err(Failure::from);
    }
    let time = quantities::duration("--at", text)?;
    console.watched(|watch| scheme::at_time(machine, time, watch)).map_err(Failure::from)
}
