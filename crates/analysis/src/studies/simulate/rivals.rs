//! Instants at which the laws of friction allow another motion than the one that is followed; what events say besides.

use words::Text;
use words::digits::{number, rounded};

use crate::System;
use crate::dataset::Impulse;
use crate::integrate::crossings::words::rivals;
use crate::integrate::taylor::Flow;

/// The first of such instants, what frictions would do in the other motion, and how many instants there are.
#[derive(Clone, Debug, Default)]
pub(super) struct Rivals {
    first: Option<(f64, Text)>,
    instants: u64,
}

impl Rivals {
    /// Looks at the end of a step; what the other motion does, if there is one.
    pub(super) fn look<S: System + ?Sized>(&mut self, flow: &mut Flow<'_, S>) -> Option<Text> {
        if flow.rivals().is_empty() {
            return None;
        }
        let (t, found) = (flow.time(), flow.rivals().to_vec());
        let words = rivals(&found, flow.system().guards());
        self.instants += 1;
        self.first.get_or_insert((t, words.clone()));
        Some(words)
    }

    /// The remark beside the motion.
    pub(super) fn note(&self) -> Option<Text> {
        let (t, Text { en, ru }) = self.first.as_ref()?;
        let n = number(*t);
        let (more, more_ru) = match self.instants {
            1 => (String::new(), String::new()),
            instants => (format!("; there are {instants} such instants"), format!("; всего таких моментов: {instants}")),
        };
        Some(Text::new(
            format!(
                "at t = {} s another motion obeys the laws of friction, too ({en}); shown is the one that sticks before it slides and goes on as before{more}",
                n.en
            ),
            format!(
                "при t = {} с законам трения отвечает и другое движение ({ru}); показано то, в котором залипание предпочтено скольжению, а прежнее состояние – новому{more_ru}",
                n.ru
            ),
        ))
    }
}

/// An event at an instant with another motion.
pub(super) fn beside(what: &Text, other: &Text) -> Text {
    Text::new(
        format!("{}; another motion obeys the laws, too ({})", what.en, other.en),
        format!("{}; законам отвечает и другое движение ({})", what.ru, other.ru),
    )
}

/// `..., impulses: force_x(O) = 3 N s`.
pub(super) fn with_impulses(what: &Text, impulses: &[Impulse]) -> Text {
    let one = |p: &Impulse, ru: bool| {
        if p.value.is_nan() {
            return format!("{} {}", p.name, if ru { "не определяется однозначно" } else { "is not unique" });
        }
        let (n, unit) = (rounded(p.value), Text::unit(&p.unit));
        if ru { format!("{} = {} {}", p.name, n.ru, unit.ru) } else { format!("{} = {} {}", p.name, n.en, unit.en) }
    };
    let list = |ru: bool| impulses.iter().map(|p| one(p, ru)).collect::<Vec<_>>().join("; ");
    Text::new(format!("{}, impulses: {}", what.en, list(false)), format!("{}, импульсы: {}", what.ru, list(true)))
}
