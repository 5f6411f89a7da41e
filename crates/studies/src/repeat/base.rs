//! The study of the file that is repeated.

use super::asking::{Asks, changed, observing};
use super::number::rows_only;
use super::wanted::Noted;
use crate::machine::Machine;
use crate::{Finds, Repeats, periodic, simulate, statics};
use mechanics::asked::{Asked, Kind};
use words::Notice;

/// Results of the study `periodic` that no other study has.
const OF_PERIODIC: [&str; 5] = ["period", "frequency", "multiplier", "stable", "gain"];
/// Studies that find what they need without a word of the file.
static ALONE: [&Kind; 2] = [&periodic::KIND, &statics::KIND];

/// The study to repeat, with the columns that are wanted.
pub(super) fn base(machine: &Machine, asks: Asks<'_>, wanted: &[Noted]) -> Result<(Asked, Option<usize>), Notice> {
    let fields = || wanted.iter().filter_map(|(_, w)| w.root());
    let of_periodic = fields().any(|name| OF_PERIODIC.iter().any(|p| name.starts_with(p)));
    let kind = asks.of.or(of_periodic.then_some(periodic::KIND.name));
    let first = |fits: &dyn Fn(&Asked) -> bool| machine.model.studies.iter().position(fits);
    let repeatable = |asked: &Asked| sort(machine, asked) != Repeats::Never;
    let of = match kind {
        Some(kind) => first(&|asked| asked.kind == kind),
        // greatest values are those of a motion, else of a place of rest: a shape of modes has no size
        None if wanted.iter().any(|(_, w)| w.root().is_none()) => {
            first(&|asked| moves(machine, asked)).or_else(|| first(&|asked| rests(machine, asked))).or_else(|| first(&repeatable))
        }
        None => first(&repeatable),
    };
    let in_file = of.map(|k| &machine.model.studies[k]);
    let column = wanted.iter().find_map(|(_, w)| w.column());
    if let (Some(Finds::Shapes), Some(name)) = (in_file.map(|asked| machine.origin.studies.finds(asked.kind)), column) {
        return Err(rows_only(name));
    }
    let mut base = match (in_file, kind) {
        (Some(asked), _) => changed(machine, asked.kind, Some(asked.clone()), asks.inner)?,
        (None, Some(kind)) if ALONE.iter().any(|study| study.name == kind) => changed(machine, kind, None, asks.inner)?,
        (None, Some(kind)) if machine.origin.studies.find(kind).is_some() && !asks.inner.values().is_empty() => {
            changed(machine, kind, None, asks.inner)?
        }
        (None, None) if asks.inner.has("until") => changed(machine, simulate::KIND.name, None, asks.inner)?,
        _ => {
            let list = machine.origin.studies.kinds().repeated.join(", ");
            return Err(Notice::new("C032", "there is no study to repeat", "нет расчёта, который надо повторять")
                .why(format!("a sweep repeats a study of the file: {list}"), format!("серия повторяет расчёт из файла: {list}"))
                .help("add that study to the file, or observe the period", "добавьте такой расчёт в файл или наблюдайте период (period)"));
        }
    };
    observing(machine, &mut base, wanted);
    Ok((base, of))
}

fn sort(machine: &Machine, asked: &Asked) -> Repeats {
    machine.origin.studies.find(asked.kind).map_or(Repeats::Never, |study| study.repeats())
}

/// Whether a study follows a motion.
pub fn moves(machine: &Machine, asked: &Asked) -> bool {
    sort(machine, asked) == Repeats::Motion
}

/// Whether a study finds places of rest.
pub fn rests(machine: &Machine, asked: &Asked) -> bool {
    sort(machine, asked) == Repeats::Rest
}
