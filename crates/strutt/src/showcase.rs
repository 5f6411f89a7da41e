//! The page of the whole gallery: a picture of each example that moves where the example does, and its own page behind it.

use crate::folder;
use crate::gallery::{EXAMPLES, Example};
use crate::shelf::Shelf;
use crate::wording::Word;
use report::page::{Card, cards};
use std::path::{Path, PathBuf};
use studies::pipeline::{self, Calculation};
use studies::scheme::{Options, scheme};
use studies::{Failure, Source, Watch};
use words::{Language, Notice};

/// Frames of a picture on the page.
const FRAMES: usize = 90;

/// Writes the page and the pages of all examples; the path of the first one.
///
/// # Errors
/// The disk refuses (C005).
pub fn write(examples: &[&Example], out: &Path, language: Language) -> Result<PathBuf, Failure> {
    let mut shelf = Shelf::open(out, &[])?;
    let mut list = Vec::new();
    for example in examples {
        list.push(card(example, (&mut shelf, out), language)?);
    }
    let (title, lead) = (
        language.pick("Gallery of strutt", "Галерея strutt"),
        language.pick(
            "Machines that come with the program, in motion where they move. Each leads to its page: equations, checks, results.",
            "Машины, которые поставляются с программой, – в движении, если они движутся. За каждой – её страница: уравнения, проверки, результаты.",
        ),
    );
    shelf.put("index.html", Word::Page, cards((title, lead), &list, language).as_bytes())?;
    let paths = shelf.close()?;
    Ok(paths.last().cloned().unwrap_or_else(|| out.join("index.html")))
}

/// All examples, or those named.
///
/// # Errors
/// One of them does not exist.
pub fn chosen<E>(names: &[String], find: impl Fn(&str) -> Result<&'static Example, E>) -> Result<Vec<&'static Example>, E> {
    if names.is_empty() { Ok(EXAMPLES.iter().collect()) } else { names.iter().map(|name| find(name)).collect() }
}

fn card(example: &Example, (shelf, out): (&mut Shelf, &Path), language: Language) -> Result<Card, Failure> {
    let source = Source::new(&format!("{}/model.toml", example.name), example.text);
    let mut calculation = pipeline::run(&source, &[], &mut Watch::default())?;
    let (picture, still) = pictures(&calculation, language);
    let folder = out.join(example.name);
    folder::write(&mut calculation, (&folder, &[]), (folder::PAGE, language))?;
    let put = |shelf: &mut Shelf, end: &str, svg: Option<String>| -> Result<Option<String>, Box<Notice>> {
        svg.map(|svg| shelf.put(&format!("{}{end}.svg", example.name), Word::Thumbnail, svg.as_bytes())).transpose()
    };
    let model = &calculation.machine.model;
    Ok(Card {
        name: example.name.to_owned(),
        title: language.text(&model.title).to_owned(),
        words: language.text(&model.description).lines().next().unwrap_or_default().to_owned(),
        page: format!("{}/index.html", example.name),
        still: put(shelf, "-still", still)?,
        moving: put(shelf, "", picture)?,
    })
}

/// The picture that moves, of the first study that has one, and the one that does not.
fn pictures(calculation: &Calculation, language: Language) -> (Option<String>, Option<String>) {
    let machine = &calculation.machine;
    let still = scheme(machine, &Options::default(), language).map(|s| s.svg(language));
    let moving = calculation.results.iter().flat_map(|r| studies::scheme::played(machine, r, language)).next();
    (moving.map(|m| m.animated(FRAMES, language)), still)
}
