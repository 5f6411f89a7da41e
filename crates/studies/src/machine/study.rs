//! What a study is: its keys, its run, what becomes of it on the command line; and the table of all studies that a machine was read with.

use super::built::Machine;
use crate::failure::{Failure, Misuse};
use crate::results::{Conclusion, Results};
use crate::watch::Watch;
use mechanics::asked::{Asked, Key, Kind, Kinds, Objection, Words};
use words::explain::Explanation;
use words::{Language, Notice, Text};

/// What a study found; none where it computes no numbers.
pub type Found = Option<Results>;

/// A study.
pub trait Study: Sync {
    /// Name, keys, and what the values contradict.
    fn kind(&self) -> &'static Kind;

    /// Carries it out as a file asks for it.
    fn run(&self, machine: &mut Machine, asked: &Asked, watch: &mut Watch) -> Found;

    /// What a calculation asks for, in a sentence: "find the positions of equilibrium".
    fn wanted(&self) -> Words;

    /// The chapter of the written calculation that tells it, by its name in `[report]`.
    fn chapter(&self) -> &'static str {
        "regime"
    }

    /// What it finds.
    fn finds(&self) -> Finds {
        Finds::Numbers
    }

    /// What its result allows to say at the end of a calculation.
    fn concludes(&self, _: &Machine, _: &Results, _: Language) -> Vec<Conclusion> {
        Vec::new()
    }

    /// Carries it out for a command of its own: exactly the rows that are asked for, no repetition that nobody asked for.
    fn command(&self, machine: &mut Machine, asked: &Asked, watch: &mut Watch) -> Found {
        self.run(machine, asked, watch)
    }

    /// Whether it has a command `strutt NAME` made of its keys.
    fn has_command(&self) -> bool {
        true
    }

    /// Kinds of studies of the file that the command takes its values from, the preferred ones first; none: its own.
    fn of_file(&self) -> &'static [&'static [&'static str]] {
        &[]
    }

    /// The study of a command: that of the file, changed by what the command line says.
    ///
    /// # Errors
    /// Something is missing, or contradicts.
    fn merge(&self, _: &Machine, given: Given) -> Result<Asked, Failure> {
        Ok(overlaid(self.kind(), given.written.or(given.of_file).unwrap_or_else(|| Asked::new(self.kind().name)), given.line))
    }

    /// Keys of other studies that its command takes too, because it carries these out.
    fn inner(&self, _: &Studies) -> Vec<&'static Key> {
        Vec::new()
    }

    /// Columns that it adds to the outputs of the file.
    fn own_columns(&self, _: &Machine, _: &Asked) -> Vec<String> {
        Vec::new()
    }

    /// Options of its command that are no keys.
    fn extras(&self) -> &'static [Extra] {
        &[]
    }

    /// What becomes of it when it is interrupted.
    fn interrupts(&self) -> Interrupts {
        Interrupts::Short
    }

    /// The codes that only it raises.
    fn explanations(&self) -> &'static [Explanation] {
        &[]
    }

    /// Whether a study that repeats another may name it, and what its repetition over values of parameters gives: the one place that says so.
    fn repeats(&self) -> Repeats {
        Repeats::Numbers
    }
}

/// What a study finds: what others do with its result goes by this, and not by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Finds {
    /// Numbers of its own sort.
    Numbers,
    /// Formulas and no numbers.
    Formulas,
    /// A motion from its start, row by row.
    Motion,
    /// What a prescribed motion takes, row by row.
    Drives,
    /// A motion from its start in closed form.
    ClosedForm,
    /// Points of a motion from its start.
    Points,
    /// A motion that repeats itself, row by row.
    Regime,
    /// Positions over a driven coordinate.
    Positions,
    /// Places of rest.
    Rest,
    /// Shapes of small motions.
    Shapes,
    /// Amplitudes of small motions over a frequency.
    Amplitudes,
    /// Whether small disturbances grow: a verdict that needs no number.
    Verdict,
}

/// What a command line says about a study.
pub struct Given<'a> {
    /// A new study that it writes, as the reader read it.
    pub written: Option<Asked>,
    /// The study of the file.
    pub of_file: Option<Asked>,
    /// Values in place of those of the file.
    pub line: &'a Asked,
    /// Whether plots are drawn.
    pub drawn: bool,
}

/// An option of a command that is no key of the study.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extra {
    /// The motion once more with half the tolerance.
    HalveTolerance,
    /// The motion once more with other steps.
    Check,
    /// Rows at events.
    Events,
    /// Rows at switches.
    Switches,
    /// So many runs at a time.
    Threads,
    /// On from where an earlier run ended.
    Resume,
    /// One part of several.
    Shard,
}

impl Extra {
    /// Those of every study that integrates one motion.
    pub const OF_A_MOTION: &'static [Extra] = &[Extra::HalveTolerance, Extra::Check, Extra::Events, Extra::Switches];
}

/// What becomes of a study that is interrupted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interrupts {
    /// What is done is kept.
    Kept,
    /// It ends.
    Ending,
    /// It takes no time worth speaking of.
    Short,
}

/// What the repetition of a study gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Repeats {
    /// It is not repeated.
    Never,
    /// Least and greatest values of a motion, and its numbers.
    Motion,
    /// Values at rest, and its numbers.
    Rest,
    /// Its numbers.
    Numbers,
}

/// The studies that a file may ask for.
pub struct Studies {
    rows: &'static [&'static dyn Study],
    kinds: Kinds,
}

impl std::fmt::Debug for Studies {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_list().entries(self.rows.iter().map(|study| study.kind().name)).finish()
    }
}

impl Studies {
    /// Studies in the order of help and reference.
    pub fn new(rows: &'static [&'static dyn Study]) -> Studies {
        let repeated = rows.iter().filter(|study| study.repeats() != Repeats::Never).map(|study| study.kind().name);
        Studies { rows, kinds: Kinds::new(rows.iter().map(|study| study.kind()).collect(), repeated.collect()) }
    }

    /// Every study.
    pub fn iter(&self) -> impl Iterator<Item = &'static dyn Study> {
        self.rows.iter().copied()
    }

    /// The study of that name.
    pub fn find(&self, name: &str) -> Option<&'static dyn Study> {
        self.iter().find(|study| study.kind().name == name)
    }

    /// What the study of that name finds; numbers where none has the name.
    pub fn finds(&self, name: &str) -> Finds {
        self.find(name).map_or(Finds::Numbers, Study::finds)
    }

    /// Their kinds, as the reader and the reference need them.
    pub fn kinds(&self) -> &Kinds {
        &self.kinds
    }
}

/// The first study of the file of one of these kinds.
pub fn of_file<'m>(machine: &'m Machine, kinds: &[&str]) -> Option<&'m Asked> {
    machine.model.studies.iter().find(|asked| kinds.contains(&asked.kind))
}

/// A study with the values of the command line in place of its own.
pub fn overlaid(kind: &Kind, mut asked: Asked, line: &Asked) -> Asked {
    for (key, value) in line.values() {
        let excluded = |key: &Key, other: &str| key.excluded.is_some_and(|(name, _)| name == other);
        let partners = kind.keys.iter().filter(|k| excluded(k, key) || kind.key(key).is_some_and(|own| excluded(own, k.name)));
        partners.for_each(|k| asked.unset(k.name));
        asked.set(key, value.clone());
    }
    asked
}

/// What the file and the command line ask together, where the study's own check has nothing against it.
///
/// *Errors*: its first objection.
pub fn agreed(kind: &Kind, asked: Asked) -> Result<Asked, Failure> {
    match (kind.check)(&asked).into_iter().next() {
        Some(Objection { code, what, why, help, .. }) => Err(Notice::new(code, what.en, what.ru).because(why).cure(help).misuse()),
        None => Ok(asked),
    }
}

/// C054: `--turns` without a section that turns.
///
/// *Errors*: the section is no angle.
pub fn turns_of_an_angle(line: &Asked, asked: &Asked) -> Result<(), Failure> {
    if line.has("turns") && asked.coordinate("section").is_none() {
        let (en, ru) = ("only a section that is an angle has turns: --section phi", "обороты есть только у сечения-угла: --section phi");
        return Err(idle("--turns", &Text::new(en, ru)));
    }
    Ok(())
}

/// C054: an option that would change nothing.
pub fn idle(option: &str, needs: &Text) -> Failure {
    Notice::new("C054", format!("{option} would change nothing"), format!("ключ {option} ничего не изменил бы"))
        .why(needs.en.clone(), needs.ru.clone())
        .misuse()
}
