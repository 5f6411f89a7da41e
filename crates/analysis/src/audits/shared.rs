//! Contacts and frictions whose shares are not unique: a remark beside their values.

use std::collections::BTreeSet;

use words::Text;

use crate::integrate::Step;
use crate::{GuardKind, Mode, System};

/// Collects the guards of contacts that hold the same motion as others.
#[derive(Clone, Debug, Default)]
pub struct Shared {
    guards: BTreeSet<usize>,
    /// Modes of the last step in which something was shared.
    modes: Vec<Mode>,
    /// Whether the motion went by a share.
    moves: bool,
}

impl Shared {
    /// Looks at a step.
    pub fn look<S: System + ?Sized>(&mut self, system: &mut S, step: &Step) {
        let modes = &step.modes;
        let known = self.guards.len();
        let mut shares = false;
        for (guard, mode) in system.guards().iter().zip(modes) {
            if let GuardKind::Share { of } = guard.kind
                && *mode != Mode::Positive
                && modes[of] == Mode::Zero
            {
                self.guards.insert(of);
                shares = true;
            }
        }
        if shares && (known < self.guards.len() || self.modes != *modes) {
            let mut x = vec![0.0; system.states().len()];
            step.state_after(0.0, &mut x);
            self.moves |= system.moves_otherwise(step.start.high, &x, modes);
            self.modes.clone_from(modes);
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
        if self.moves {
            return Some(Text::new(
                format!(
                    "{en}: at times others hold the same motion, and a friction that slides is pressed by one of them alone: neither the shares nor the motion are unique; shown is one of the motions that obey the laws{also}"
                ),
                format!(
                    "{ru}: временами то же движение удерживают и другие, а скользящее трение прижато лишь одной из этих реакций: ни доли, ни само движение не определены однозначно; показано одно из движений, отвечающих законам{also_ru}"
                ),
            ));
        }
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
