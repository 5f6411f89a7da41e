//! `strutt variants ...`: the variants of a file, all at once.

use super::Exit;
use crate::args::{self, VariantsAction};
use crate::console::{Console, INTERRUPTED, listen_to_interrupts, quoted};
use mechanics::derive::Detail;
use report::formats::Holds;
use std::sync::atomic::Ordering;
use strutt::class;
use strutt::wording::Word;
use strutt::{folder, pdf};
use studies::variants::{Class, check, sheet};
use studies::{Failure, document};

pub fn run(args: &args::Variants, console: &mut Console) -> Result<Exit, Failure> {
    listen_to_interrupts(console.language);
    match &args.action {
        VariantsAction::Check(args) => overview(args, console),
        VariantsAction::Make(args) => make(args, console),
        VariantsAction::Grade(args) => grade(args, console),
    }
}

/// `strutt variants check FILE`.
fn overview(args: &args::VariantsCheck, console: &mut Console) -> Result<Exit, Failure> {
    let source = strutt::source::open(&args.file)?;
    let reading = studies::read(&source, &[]).map_err(|diagnostics| Failure::Findings { source: Box::new(source.clone()), diagnostics })?;
    console.warn(&reading.warnings, &source);
    let members = strutt::variants::members(&reading.model, &source, args.group)?;
    let mut class = Class::new(source, Detail::Equations);
    let found = console.watched(|watch| check(&mut class, &reading.model, &members, watch));
    let language = console.language;
    match console.format.holds {
        Holds::Tree(tree) => console.out((tree.value)(&found.to_json(language)))?,
        Holds::Table(_) => console.out(found.to_csv(language))?,
        Holds::Page(_) => {
            let title = language.text(&found.title);
            console.out(document::in_terminal(title, found.blocks(language), language, console.width()))?;
            let next = if found.is_good() { "run" } else { "check" };
            let variant = found.lines.first().map_or("1", |l| l.name.as_str());
            console.next(&format!("strutt {next} {} --variant {}", quoted(&args.file), quoted(variant)));
        }
    }
    Ok(match (INTERRUPTED.load(Ordering::Relaxed), found.is_good()) {
        (true, _) => Exit::Interrupted,
        (false, true) => Exit::Done,
        (false, false) => Exit::Failed,
    })
}

/// `strutt variants make FILE --out DIR`.
fn make(args: &args::VariantsMake, console: &mut Console) -> Result<Exit, Failure> {
    if args.pdf {
        pdf::printed(&folder::PAGE)?;
    }
    let source = strutt::source::open(&args.file)?;
    let reading = studies::read(&source, &[]).map_err(|diagnostics| Failure::Findings { source: Box::new(source.clone()), diagnostics })?;
    console.warn(&reading.warnings, &source);
    let model = &reading.model;
    let members = strutt::variants::members(model, &source, args.group)?;
    let students = class::students(args.names.as_deref(), &members)?;
    let mut inputs = strutt::folder::inputs(&source, model);
    inputs.extend(args.names.as_ref().map(std::path::PathBuf::from));
    let mut of = Class::new(source.clone(), Detail::Steps);
    let language = console.language;
    let course = console.watched(|watch| class::made(&mut of, model, (&source, &members), &students, (watch, language)));
    let paths = console.timed(Word::TimeWrite, |_| class::write(&course, &args.out, &inputs))?;
    let sheets = paths.iter().filter(|p| args.pdf && p.extension().is_some_and(|e| e == folder::PAGE.extension));
    sheets.filter(|p| p.parent() != Some(args.out.as_path())).try_for_each(|p| pdf::print(p, &folder::PAGE).map(drop))?;
    let failed: Vec<&str> = course.key.entries.iter().filter(|e| !e.failure.is_empty()).map(|e| e.member.name.as_str()).collect();
    let (n, out) = (paths.len(), args.out.display());
    console.talk(&console.pick(format!("written: {out}, {n} files"), format!("записано: {out}, файлов {n}")));
    if !failed.is_empty() {
        let list = failed.join(", ");
        console.complain(&format!(
            "{}\n",
            console.pick(format!("variants that cannot be given out: {list}"), format!("варианты, которые выдать нельзя: {list}"))
        ));
    }
    let (key, answers) = (args.out.join("key.json"), args.out.join("answers.csv"));
    console.next(&format!("strutt variants grade {} {}", quoted(&key.to_string_lossy()), quoted(&answers.to_string_lossy())));
    Ok(if failed.is_empty() { Exit::Done } else { Exit::Failed })
}

/// `strutt variants grade KEY ANSWERS`.
fn grade(args: &args::VariantsGrade, console: &mut Console) -> Result<Exit, Failure> {
    let (key, model) = class::key(&args.key)?;
    let handed = class::handed(&args.answers, (&key, &model))?;
    let found = console.watched(|watch| class::graded((&key, &model), &handed, watch));
    let language = console.language;
    match console.format.holds {
        Holds::Tree(tree) => console.out((tree.value)(&class::to_json(&model, &found, language)))?,
        Holds::Table(_) => console.out(class::to_csv(&model, &found, language))?,
        Holds::Page(_) => {
            let blocks = sheet::class_blocks(&model, &found.rows, (&found.remarks, language));
            console.out(document::in_terminal(language.text(&model.title), blocks, language, console.width()))?;
        }
    }
    if let Some(out) = &args.out {
        let inputs = [&args.key, &args.answers].map(std::path::PathBuf::from);
        let paths = console.timed(Word::TimeWrite, |_| class::reports((&key, &model), &found, (out, &inputs), language))?;
        let list: String = paths.iter().map(|p| format!("\n  {}", p.display())).collect();
        console.talk(&format!("{}{list}", console.say(Word::Written)));
    }
    Ok(Exit::Done)
}
