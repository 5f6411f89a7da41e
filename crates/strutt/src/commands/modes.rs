//! `strutt modes FILE`: natural frequencies, shapes, the frequency equation.

use super::{Exit, judge, open};
use crate::args::{self, Normalise};
use crate::console::{Console, Shape, quoted};
use crate::quantities;
use mechanics::derive::Detail;
use mechanics::model::{Modes, ParameterRange, Scale, StudyKind};
use report::Document;
use strutt::{Failure, folder, pipeline, small, structure};

pub fn run(args: &args::Modes, console: &mut Console) -> Result<Exit, Failure> {
    let (_, mut machine) = open(&args.model, Detail::Equations, console)?;
    let of_file = machine.model.studies.iter().find_map(|s| match &s.kind {
        StudyKind::Modes(study) => Some(study.clone()),
        _ => None,
    });
    let mut study: Modes = of_file.unwrap_or_default();
    if !args.guess.is_empty() {
        study.guess = quantities::guess(&args.guess, &machine)?;
    }
    study.about_start |= args.about_start;
    if let (Some(name), Some(range)) = (&args.over, &args.range) {
        let [from, to] = quantities::parameter_range(name, range, &machine)?;
        let points = args.points.map_or(Ok(101), |points| quantities::positions("--points", points))?;
        study.over = Some(ParameterRange { name: name.clone(), from, to, points });
    }
    if let Some(scale) = args.normalise {
        study.scale = match scale {
            Normalise::Largest => Scale::Largest,
            Normalise::First => Scale::First,
            Normalise::Mass => Scale::Mass,
        };
    }
    let finding = console.watched(|watch| pipeline::modes(&mut machine, &study, watch));
    let (data, language) = (finding.data(), console.language);
    match console.shape {
        Shape::Json => console.out(report::json::write(data, &folder::own_fields(&finding), language))?,
        Shape::Csv => console.out(report::csv::write(data, report::csv::Dialect::Plain))?,
        Shape::Text => {
            let blocks = match &finding {
                pipeline::Finding::Modes(found) => small::show::modes(found, language, false),
                pipeline::Finding::Structure(found) => structure::blocks(found, language, false),
                _ => Vec::new(),
            };
            if !blocks.is_empty() {
                let title = language.text(&machine.model.title).to_owned();
                let document = Document {
                    language,
                    title,
                    description: String::new(),
                    blocks,
                    version: strutt::VERSION.into(),
                    model_hash: machine.model_hash.clone(),
                };
                console.out(report::terminal::write(&document, console.width()))?;
            }
            console.next(&format!("strutt run {}", quoted(&args.model.file)));
        }
    }
    Ok(judge(&finding, console))
}
