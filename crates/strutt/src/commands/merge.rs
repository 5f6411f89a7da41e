//! `strutt merge`: the parts of a sweep as one.

use super::Exit;
use crate::args::Merge;
use crate::console::Console;
use strutt::rows;
use strutt::shelf::Shelf;
use strutt::wording::Word;
use studies::Failure;
use words::Notice;

/// Name of the table.
const TABLE: &str = "sweep.csv";

/// Runs the command.
pub fn run(args: &Merge, console: &mut Console) -> Result<Exit, Failure> {
    let mut parts = Vec::new();
    for folder in &args.parts {
        let path = folder.join(rows::name(studies::sweep::KIND.name));
        parts.push(rows::read(&path).map_err(|error| nothing(&path, &error))?);
    }
    let (data, lines) = studies::sweep::merged(&parts)?;
    let inputs: Vec<_> = args.parts.iter().map(|folder| folder.join(rows::name(studies::sweep::KIND.name))).collect();
    let mut shelf = Shelf::open(&args.out, &inputs)?;
    let text: String = lines.iter().map(|line| format!("{line}\n")).collect();
    shelf.put(&rows::name(studies::sweep::KIND.name), Word::Table, text.as_bytes())?;
    shelf.put_by(TABLE, Word::Table, &mut |to| (report::csv::NUMBERS.data)(&data, to))?;
    let paths = shelf.close()?;
    let list: String = paths.iter().map(|p| format!("\n  {}", p.display())).collect();
    console.talk(&format!("{}{list}", console.say(Word::Written)));
    data.notes.iter().for_each(|note| console.talk(console.language.text(note)));
    Ok(if data.audits.iter().all(|audit| audit.ok) { Exit::Done } else { Exit::Failed })
}

fn nothing(path: &std::path::Path, error: &std::io::Error) -> Box<Notice> {
    let cause = strutt::system::cause(error);
    let path = path.display();
    let notice = Notice::new("C076", format!("no rows in `{path}`: {}", cause.en), format!("нет строк в `{path}`: {}", cause.ru));
    Box::new(notice.help(
        "name folders that sweep --shard I/N --out DIR has written",
        "укажите папки, записанные командой sweep --shard I/N --out ПАПКА",
    ))
}
