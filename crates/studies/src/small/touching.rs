//! One-sided contacts as they stand at rest, watched along forced oscillations: from which share of the load on they open or close.
//!
//! ```text
//! closed:  λ₀ + s min δλ = 0        open:  g₀ + s min δg = 0        s: share of the load
//! ```
//!
//! Small motions are those of the contacts that are closed at rest; where s < 1 the amplitudes of the whole load are not the machine's own.

use analysis::linear::LinearMachine;
use analysis::studies::rest::contacts::Contacts;
use symbolic::Expr;
use symbolic::connections::Law;
use words::Text;
use words::digits::rounded;

/// A share of the load and the frequency at which it suffices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    /// Share of the load.
    pub share: f64,
    /// rad/s.
    pub omega: f64,
}

/// A contact as it stands at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Touching {
    /// Of its reaction.
    label: Text,
    stands: Stands,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stands {
    Closed,
    Open,
}

impl Touching {
    /// What it does where its value comes to zero.
    pub(super) fn change(&self) -> &'static str {
        match self.stands {
            Stands::Closed => "opens",
            Stands::Open => "closes",
        }
    }
}

/// Contacts by name with what must not be negative: forces of those that are closed at rest, gaps of those that are open.
pub(super) fn contacts(machine: &mut LinearMachine, contacts: Option<&Contacts>) -> Vec<(String, Expr, Touching)> {
    let Some(contacts) = contacts else { return Vec::new() };
    let mut list = Vec::new();
    for (r, reaction) in machine.equations().clone().reactions.iter().enumerate() {
        let (stands, formula) = match &reaction.law {
            Law::Contact { gap, .. } => (Stands::Open, *gap),
            _ if contacts.held().contains(&r) => (Stands::Closed, machine.symbol(reaction.symbol)),
            _ => continue,
        };
        list.push((reaction.name.clone(), formula, Touching { label: reaction.label.clone(), stands }));
    }
    list
}

/// In words.
pub(super) fn remark(contact: &Touching, bands: &Text, level: Level) -> Text {
    let (share, omega) = (rounded(100.0 * level.share), rounded(level.omega));
    let label = &contact.label;
    let (stands, changes) = match contact.stands {
        Stands::Closed => (("closed", "замкнута"), ("opens", "размыкается")),
        Stands::Open => (("open", "разомкнута"), ("closes", "замыкается")),
    };
    Text::new(
        format!(
            "one-sided connection ({}), {} at rest: at ω = {} rad/s it {} within the amplitudes of the table, first at {} % of the load (ω = {} rad/s); beyond that they are not the \
             machine's own, use `periodic` or `simulate`",
            label.en, stands.0, bands.en, changes.0, share.en, omega.en
        ),
        format!(
            "односторонняя связь ({}) в покое {}: при ω = {} рад/с она в пределах амплитуд таблицы {}, раньше всего при {} % нагрузки (ω = {} рад/с); при большей нагрузке эти \
             амплитуды к машине не относятся, примените `periodic` или `simulate`",
            label.ru, stands.1, bands.ru, changes.1, share.ru, omega.ru
        ),
    )
}
