//! `strutt simulate FILE`: one motion, as a table.

use super::{Exit, judge, open};
use crate::args;
use crate::console::{Console, Shape, listen_to_interrupts, quoted};
use crate::quantities;
use mechanics::derive::Detail;
use mechanics::model::Times;
use strutt::pipeline::{self, Calculation, Finding, Machine};
use strutt::plan::{self, Wishes};
use strutt::wording::Word;
use strutt::{Failure, document, folder};

pub fn run(args: &args::Simulate, console: &mut Console) -> Result<Exit, Failure> {
    let wishes = wishes(args)?;
    // a page shows the written derivation
    let detail = if args.out.is_some() { Detail::Steps } else { Detail::Equations };
    let (_, mut machine) = open(&args.model, detail, console)?;
    let study = plan::simulation(&machine.model, &machine.equations, wishes)?;
    listen_to_interrupts(console.language);
    let finding = console.watched(|watch| {
        watch.halve_tolerance = args.halve_tolerance;
        watch.check = args.check;
        pipeline::simulate(&mut machine, &study, watch)
    });
    console.timed(Word::TimeWrite, |console| show(&finding, args, console))?;
    tell_checks(&finding, console);
    let exit = judge(&finding, console);
    if let Some(out) = &args.out {
        write(machine, finding, out, console)?;
    }
    Ok(exit)
}

pub(super) fn wishes(args: &args::Simulate) -> Result<Wishes, Failure> {
    let until = args.until.as_deref().map(|text| quantities::end("--until", text)).transpose()?;
    let tolerance = args.tolerance.as_deref().map(|text| quantities::tolerance("--tolerance", text)).transpose()?;
    let times = match (&args.at, &args.every) {
        (Some(at), _) => Some(Times::At(quantities::times("--at", at)?)),
        (None, Some(every)) => Some(Times::Every(quantities::step("--every", every)?)),
        (None, None) => None,
    };
    let outputs =
        args.outputs.as_ref().map(|list| list.iter().map(|name| name.trim().to_owned()).filter(|name| !name.is_empty()).collect());
    let method = args.method.map(args::Method::of_model);
    Ok(Wishes { until, tolerance, method, times, outputs })
}

/// CSV in pipes, a summary on terminals, unless said otherwise.
pub(super) fn show(finding: &Finding, args: &args::Simulate, console: &Console) -> Result<(), Failure> {
    let data = finding.data();
    if data.columns.is_empty() && console.shape != Shape::Json {
        return Ok(());
    }
    match console.shape {
        Shape::Json => console.out(report::json::write(data, &folder::own_fields(finding), console.language)),
        _ if args.events => console.out(report::csv::write_events(data, report::csv::Dialect::Plain, console.language)),
        Shape::Text if args.out.is_some() => Ok(()),
        _ if args.switches => console.out(report::csv::write(&data.with_switches(), report::csv::Dialect::Plain)),
        Shape::Text if console.terminal => {
            let table = document::results(data, console.language);
            console.out(report::terminal::table(&table, console.language, console.width()))?;
            console.next(&format!("strutt simulate {} --csv > motion.csv", quoted(&args.model.file)));
            Ok(())
        }
        _ => console.out(report::csv::write(data, report::csv::Dialect::Plain)),
    }
}

/// The checks of the run, beside the data.
pub(super) fn tell_checks(finding: &Finding, console: &Console) {
    let number = |x| report::number::short(x, 2, console.language);
    let passed = finding.data().audits.iter().filter(|a| a.ok);
    let lines: Vec<String> = passed.map(|a| format!("✓ {}: {}", console.language.text(&a.name), number(a.value))).collect();
    if !lines.is_empty() {
        console.talk(&lines.join("\n"));
    }
}

pub(super) fn write(machine: Machine, finding: Finding, out: &std::path::Path, console: &mut Console) -> Result<(), Failure> {
    let mut calculation = Calculation { machine, findings: vec![finding], files: Vec::new() };
    let language = console.language;
    let paths = console.timed(Word::TimeWrite, |_| folder::write(&mut calculation, out, language))?;
    let list: String = paths.iter().map(|p| format!("\n  {}", p.display())).collect();
    console.talk(&format!("{}{list}", console.say(Word::Written)));
    Ok(())
}
