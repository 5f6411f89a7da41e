//! Contacts and frictions whose shares are not unique: a remark beside their values.

use std::collections::BTreeSet;

use symbolic::Text;

use crate::{GuardKind, Mode, System};

/// Collects the guards of contacts that hold the same motion as others.
#[derive(Clone, Debug, Default)]
pub struct Shared {
    guards: BTreeSet<usize>,
}

impl Shared {
    /// Looks at the modes of a step.
    pub fn look<S: System + ?Sized>(&mut self, system: &S, modes: &[Mode]) {
        for (guard, mode) in system.guards().iter().zip(modes) {
            if let GuardKind::Share { of } = guard.kind
                && *mode != Mode::Positive
                && modes[of] == Mode::Zero
            {
                self.guards.insert(of);
            }
        }
    }

    /// Which reactions show one of many admissible values.
    pub fn note<S: System + ?Sized>(&self, system: &S) -> Option<Text> {
        let list = |name: fn(&Text) -> &str| {
            self.guards.iter().map(|g| format!("`{}`", name(&system.guards()[*g].name))).collect::<Vec<_>>().join(", ")
        };
        let (en, ru) = (list(|n| &n.en), list(|n| &n.ru));
        let leaning = system.layout().leaning.join(", ");
        let (also, also_ru) = match leaning.as_str() {
            "" => (String::new(), String::new()),
            names => (
                format!("; so are the reactions that balance them: {names}"),
                format!("; то же относится к реакциям, которые их уравновешивают: {names}"),
            ),
        };
        (!self.guards.is_empty()).then(|| {
            Text::new(
                format!("{en}: at times others hold the same motion; the motion and the sums of the forces are unique, the share of each is one admissible value{also}"),
                format!("{ru}: временами то же движение удерживают и другие; движение и суммы сил определены однозначно, доля каждого – одно из допустимых значений{also_ru}"),
            )
        })
    }
}
