//! What is checked of answers when the file is read: names and dimensions.

use super::wanted::Wanted;
use mechanics::Model;
use mechanics::model::{AnswerDecl, AnswerValue};
use mechanics::variants::{Misfit, scale};
use words::{Notice, Text};

/// SI units of numbers that studies name themselves, by the last word of their path.
const UNITS: [(&str, &str); 29] = [
    ("f", "Hz"),
    ("frequency", "Hz"),
    ("omega", "rad/s"),
    ("omega_d", "rad/s"),
    ("load_omega", "rad/s"),
    ("omega_max", "rad/s"),
    ("omega_min", "rad/s"),
    ("omega_mean", "rad/s"),
    ("T", "s"),
    ("t", "s"),
    ("period", "s"),
    ("least_period", "s"),
    ("phase", "rad"),
    ("work", "J"),
    ("excess_work", "J"),
    ("J_mean", "kg m^2"),
    ("damping_ratio", "1"),
    ("decrement", "1"),
    ("quality_factor", "1"),
    ("dynamic_coefficient", "1"),
    ("irregularity", "1"),
    ("irregularity_max", "1"),
    ("energy_share", "1"),
    ("stable", "1"),
    ("abs", "1"),
    ("re", "1"),
    ("im", "1"),
    ("events", "1"),
    ("modes_below", "1"),
];

/// The SI unit of a number of a study by its path; none where only the study can tell.
pub fn by_name(path: &str) -> Option<&'static str> {
    let mut words = path.rsplit('.');
    let last = words.next().unwrap_or(path);
    // `work.M`: M is a motor, whatever its name means elsewhere
    if words.next() == Some("work") {
        return Some("J");
    }
    UNITS.iter().find(|(name, _)| *name == last).map(|(_, unit)| *unit)
}

/// The unit of an output, coordinate or rate.
pub fn of_column<'m>(model: &'m Model, name: &str) -> Option<&'m str> {
    let base = name.trim_end_matches('\'');
    let output = model.outputs.iter().find(|o| o.name == name).map(|o| o.unit.as_str());
    let coordinate = || model.coordinates.iter().find(|c| c.name == base).and_then(|c| c.units.get(name.len() - base.len()));
    output.or_else(|| coordinate().map(String::as_str))
}

/// What an answer asks a study for.
///
/// # Errors
/// It means nothing.
pub fn wanted(model: &Model, answer: &AnswerDecl) -> Option<Result<Wanted, Text>> {
    let AnswerValue::Study { text, at, .. } = &answer.value else { return None };
    Some(Wanted::read(text, at.as_deref(), &|name| of_column(model, name).is_some()))
}

/// Findings about the answers of a file.
pub fn findings(model: &Model, kinds: &dyn Fn(&str) -> bool) -> Vec<Notice> {
    model.answers.iter().filter_map(|answer| finding(model, answer, kinds)).collect()
}

fn finding(model: &Model, answer: &AnswerDecl, kinds: &dyn Fn(&str) -> bool) -> Option<Notice> {
    let AnswerValue::Study { of, .. } = &answer.value else { return None };
    let at = |misfit: Misfit, code| {
        let mut notice = Notice::file(code, answer.value_span.clone(), misfit.what);
        notice.help = misfit.help;
        notice
    };
    if let Some(of) = of.as_ref().filter(|of| !kinds(of)) {
        return Some(at(Misfit::new(format!("there is no study `{of}`"), format!("нет расчёта вида `{of}`")), "M375"));
    }
    let wanted = match wanted(model, answer)? {
        Ok(wanted) => wanted,
        Err(what) => {
            let help = Text::new(
                "ask for max(x), x with at = \"0.5 s\", modes.1.f, period, event(1)",
                "запросите max(x), x и at = \"0.5 s\", modes.1.f, period, event(1)",
            );
            return Some(at(Misfit { what, help }, "M375"));
        }
    };
    let unit = match &wanted {
        Wanted::Instant(_) => Some("s"),
        Wanted::At(column, ..) => of_column(model, column),
        Wanted::Number(number) => number.column().map_or_else(|| by_name(number.word()), |c| of_column(model, c)),
    };
    scale(unit?, &answer.unit).err().map(|misfit| at(misfit, "M376"))
}
