//! `strutt equilibrium FILE`: positions of equilibrium.

use super::{Exit, judge, open};
use crate::args;
use crate::console::{Console, Shape, quoted};
use mechanics::model::StudyKind;
use strutt::{Failure, document, folder, pipeline};

pub fn run(args: &args::Equilibrium, console: &mut Console) -> Result<Exit, Failure> {
    let (_, mut machine) = open(&args.model, mechanics::derive::Detail::Equations, console)?;
    let of_file = machine.model.studies.iter().find_map(|s| match &s.kind {
        StudyKind::Equilibrium { guess, over } => Some((guess.clone(), *over)),
        _ => None,
    });
    let (of_file, mut over) = of_file.unwrap_or_default();
    if let (Some(name), Some(range)) = (&args.over, &args.range) {
        over = Some(crate::quantities::between(name, range, &machine)?);
    }
    let guess = if args.guess.is_empty() { of_file } else { crate::quantities::guess(&args.guess, &machine)? };
    let finding = console.watched(|watch| pipeline::equilibrium_over(&mut machine, &guess, over, watch));
    let (data, language) = (finding.data(), console.language);
    match console.shape {
        Shape::Json => console.out(report::json::write(data, &folder::own_fields(&finding), language))?,
        Shape::Csv => console.out(report::csv::write(data, report::csv::Dialect::Plain))?,
        Shape::Text if finding.trouble().is_none() => {
            if !data.columns.is_empty() {
                console.out(report::terminal::table(&document::equilibria(data, language), language, console.width()))?;
            }
            for note in &data.notes {
                console.out(format!("{}\n", language.text(note)))?;
            }
            console.next(&format!("strutt run {}", quoted(&args.model.file)));
        }
        Shape::Text => {}
    }
    Ok(judge(&finding, console))
}
