//! Contacts and frictions whose shares are not unique: a remark beside their values.

use std::collections::BTreeSet;

use words::Text;

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
                format!("; nor are the reactions that balance them: {names}"),
                format!("; то же относится к реакциям, которые их уравновешивают: {names}"),
            ),
        };
        (!self.guards.is_empty()).then(|| {
            Text::new(
                format!("{en}: at times others hold the same motion; the motion and the sums of the forces are unique, the shares are not and are left out{also}"),
                format!("{ru}: временами то же движение удерживают и другие; движение и суммы сил определены однозначно, доли – нет и не приводятся{also_ru}"),
            )
        })
    }
}

/// Why an output has no value while these guards share a load.
pub fn not_unique<S: System + ?Sized>(system: &S, guards: &[usize]) -> Text {
    let list = |name: fn(&Text) -> &str| guards.iter().map(|g| name(&system.guards()[*g].name)).collect::<Vec<_>>().join(", ");
    let (en, ru) = (list(|n| &n.en), list(|n| &n.ru));
    let (of, of_ru) = if guards.is_empty() { (String::new(), String::new()) } else { (format!(": {en}"), format!(": {ru}")) };
    Text::new(
        format!("not determined where several hold the same motion{of}"),
        format!("не определяется там, где одно движение удерживают несколько{of_ru}"),
    )
}
