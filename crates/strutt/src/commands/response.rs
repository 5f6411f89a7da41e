//! `strutt response FILE`: forced oscillations over the frequency of a load.

use super::{Exit, judge, open};
use crate::args;
use crate::console::{Console, Shape, quoted};
use crate::quantities;
use mechanics::derive::Detail;
use mechanics::model::{Response, StudyKind};
use report::Document;
use strutt::failure::Misuse;
use strutt::{Failure, folder, pipeline, plan, small};
use words::Notice;

pub fn run(args: &args::Response, console: &mut Console) -> Result<Exit, Failure> {
    let (_, mut machine) = open(&args.model, Detail::Equations, console)?;
    let of_file = machine.model.studies.iter().find_map(|s| match &s.kind {
        StudyKind::Response(study) => Some(study.clone()),
        _ => None,
    });
    let study = changed(of_file.unwrap_or_default(), args, &machine)?;
    let finding = console.watched(|watch| pipeline::response(&mut machine, &study, watch));
    let (data, language) = (finding.data(), console.language);
    match console.shape {
        Shape::Json => console.out(report::json::write(data, &folder::own_fields(&finding), language))?,
        Shape::Csv => console.out(report::csv::write(data, report::csv::Dialect::Plain))?,
        Shape::Text => {
            if let pipeline::Finding::Response(found) = &finding
                && found.trouble.is_none()
            {
                let document = Document {
                    language,
                    title: language.text(&machine.model.title).to_owned(),
                    description: String::new(),
                    blocks: small::show::response(found, language, false),
                    version: strutt::VERSION.into(),
                    model_hash: machine.model_hash.clone(),
                };
                console.out(report::terminal::write(&document, console.width()))?;
                console.next(&format!("strutt response {} --csv", quoted(&args.model.file)));
            }
        }
    }
    Ok(judge(&finding, console))
}

/// The study of the file, changed by what the command line asks.
fn changed(mut study: Response, args: &args::Response, machine: &pipeline::Machine) -> Result<Response, Failure> {
    if !args.guess.is_empty() {
        study.guess = quantities::guess(&args.guess, machine)?;
    }
    study.load = args.load.clone().or(study.load);
    study.frequency = args.over.clone().or(study.frequency);
    if let Some(text) = &args.range {
        let ends = quantities::frequencies("--range", text)?;
        let [from, to] = ends[..] else { return Err(no_range(text)) };
        if to <= from {
            return Err(no_range(text));
        }
        study.range = Some([from, to]);
    }
    if let Some(points) = args.points {
        study.points = Some(quantities::positions("--points", points)?);
    }
    study.log |= args.log;
    if let Some(names) = &args.outputs {
        names.iter().try_for_each(|name| plan::known(name.trim(), &machine.equations))?;
        study.outputs = names.iter().map(|n| n.trim().to_owned()).collect();
    }
    if let Some(text) = &args.shapes {
        study.shapes = quantities::frequencies("--shapes", text)?;
    }
    Ok(study)
}

fn no_range(text: &str) -> Failure {
    let trouble = Notice::new(
        "C009",
        format!("--range {text}: two frequencies are needed, the first smaller"),
        format!("--range {text}: нужны две частоты, первая меньше второй"),
    );
    trouble.help("write --range 1,100 (rad/s)", "напишите --range 1,100 (рад/с)").misuse()
}
