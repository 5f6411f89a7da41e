//! The title page.

use super::work::Work;
use mechanics::model::Front;
use report::Block;
use words::Text;
use words::capital;

/// The page of what the file gives; lines to write on for who made and who checks it.
pub(super) fn page(work: &Work, front: &Front) -> Block {
    let language = work.language;
    let text = |text: &Text| language.text(text).to_owned();
    let or = |given: &Text, usual: &str| if text(given).is_empty() { usual.to_owned() } else { text(given) };
    let discipline = text(&front.discipline);
    let about = match discipline.is_empty() {
        true => Vec::new(),
        false => vec![language.pick(format!("Discipline: {discipline}"), format!("по дисциплине «{discipline}»"))],
    };
    let group = text(&front.group);
    let made = language.pick("Made by", "Выполнил").to_owned();
    let made = match group.is_empty() {
        true => made,
        false => language.pick(format!("{made}, group {group}"), format!("{made} студент группы {group}")),
    };
    // a line to sign on before each name
    let signed = |name: String| if name.is_empty() { name } else { format!("______________\u{a0}{name}") };
    let above = [text(&front.organisation), text(&front.department)];
    let below = [text(&front.city), front.year.clone()];
    Block::Front(report::document::Front {
        above: above.into_iter().filter(|line| !line.is_empty()).collect(),
        kind: or(&front.kind, language.pick("Calculation", "Расчётная работа")),
        subject: capital(work.text(&work.model.title)),
        about,
        people: vec![
            (made, signed(text(&front.student))),
            (language.pick("Checked by", "Проверил").to_owned(), signed(text(&front.teacher))),
        ],
        below: below.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" "),
    })
}
