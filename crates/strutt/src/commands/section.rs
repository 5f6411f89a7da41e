//! `strutt section FILE`: properties of the sections of a file, on the terminal, as data, or with drawings in a folder.

use super::Exit;
use crate::args;
use crate::console::{Console, quoted};
use crate::quantities;
use mechanics::section::Section;
use report::formats::Holds;
use serde_json::json;
use strutt::folder;
use strutt::wording::Word;
use studies::{Failure, sections};
use words::Notice;

pub fn run(args: &args::Section, console: &mut Console) -> Result<Exit, Failure> {
    let overrides = quantities::overrides(&args.model.overrides)?;
    let source = strutt::source::open(&args.model.file)?;
    let reading =
        studies::read(&source, &overrides).map_err(|diagnostics| Failure::Findings { source: Box::new(source.clone()), diagnostics })?;
    console.warn(&reading.warnings, &source);
    let all = &reading.model.sections;
    let chosen: Vec<Section> = match &args.name {
        Some(name) => all.iter().filter(|s| s.name == *name).cloned().collect(),
        None => all.clone(),
    };
    if chosen.is_empty() {
        return Err(Failure::Misuse(Box::new(absent(args.name.as_deref(), all))));
    }
    let language = console.language;
    match console.format.holds {
        Holds::Tree(tree) => {
            let list: Vec<_> = chosen.iter().map(|s| sections::to_json(s, language)).collect();
            let value = json!({"title": language.text(&reading.model.title), "version": studies::VERSION,
                "model_hash": source.hash(&overrides), "sections": list});
            console.out((tree.value)(&value))?;
        }
        Holds::Table(_) => console.out(sections::to_csv(&chosen))?,
        Holds::Page(_) => {
            for section in &chosen {
                console.out(format!("{}\n\n", sections::title(section, language)))?;
                console.out(report::terminal::table(&sections::table(section, language), language, console.width()))?;
                console.out("\n")?;
            }
        }
    }
    if let Some(out) = &args.out {
        let inputs = folder::inputs(&source, &reading.model);
        let paths = folder::sections(&chosen, (out.as_path(), inputs.as_slice()), language)?;
        let list: String = paths.iter().map(|p| format!("\n  {}", p.display())).collect();
        console.talk(&format!("{}{list}", console.say(Word::Written)));
    } else if console.is_text() {
        console.next(&format!("strutt section {} --out DIR", quoted(&args.model.file)));
    }
    Ok(Exit::Done)
}

fn absent(name: Option<&str>, all: &[Section]) -> Notice {
    let names: Vec<&str> = all.iter().map(|s| s.name.as_str()).collect();
    let mut trouble = match name {
        Some(name) if !all.is_empty() => Notice::new("C040", format!("there is no section `{name}`"), format!("нет сечения `{name}`")),
        _ => Notice::new("C040", "the file has no sections", "в файле нет сечений"),
    };
    trouble.help = match name.and_then(|n| words::nearest(n, names.iter().copied())) {
        Some(near) => words::Text::new(format!("did you mean `{near}`?"), format!("может быть, `{near}`?")),
        None if all.is_empty() => words::Text::new(
            "add for example [sections.beam] with rectangle = [\"10 cm\", \"20 cm\"]",
            "добавьте, например, [sections.beam] и rectangle = [\"10 см\", \"20 см\"]",
        ),
        None => words::Text::new(format!("sections: {}", names.join(", ")), format!("сечения: {}", names.join(", "))),
    };
    trouble
}
