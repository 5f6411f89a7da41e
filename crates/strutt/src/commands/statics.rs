//! `strutt statics FILE`: reactions and internal forces at rest.

use super::{Exit, judge, open};
use crate::args;
use crate::console::{Console, Shape, quoted};
use mechanics::derive::Detail;
use report::Document;
use strutt::{Failure, folder, pipeline, structure, studies};

pub fn run(args: &args::Statics, console: &mut Console) -> Result<Exit, Failure> {
    let (_, mut machine) = open(&args.model, Detail::Equations, console)?;
    let Some(finding) = structure::statics(&machine) else {
        // no nodes: bodies with supports and joints
        let finding = studies::statics::run(&mut machine);
        return super::study::finish(machine, finding, None, console);
    };
    let (data, language) = (finding.data(), console.language);
    match console.shape {
        Shape::Json => console.out(report::json::write(data, &folder::own_fields(&finding), language))?,
        Shape::Csv => console.out(report::csv::write(data, report::csv::Dialect::Plain))?,
        Shape::Text => {
            if let pipeline::Finding::Structure(found) = &finding
                && found.trouble.is_none()
            {
                let title = language.text(&machine.model.title).to_owned();
                let blocks = structure::blocks(found, language, false);
                let (version, model_hash) = (strutt::VERSION.into(), machine.model_hash.clone());
                let document = Document { language, title, description: String::new(), blocks, version, model_hash };
                console.out(report::terminal::write(&document, console.width()))?;
            }
            console.next(&format!("strutt run {}", quoted(&args.model.file)));
        }
    }
    Ok(judge(&finding, console))
}
