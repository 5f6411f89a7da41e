//! How states are named to the user, and a configuration in one line.

use symbolic::Equations;
use words::Text;

use crate::Quantity;
use words::digits::rounded;

/// `phi1 = 1.5708 rad, x = 0.3 m`.
pub(crate) fn configuration<'q>(places: impl Iterator<Item = (&'q Quantity, &'q f64)>) -> Text {
    let (mut en, mut ru) = (Vec::new(), Vec::new());
    for (state, value) in places {
        let (n, unit) = (rounded(*value), Text::unit(&state.unit));
        en.push(format!("{} = {} {}", state.name, n.en, unit.en));
        ru.push(format!("{} = {} {}", state.name, n.ru, unit.ru));
    }
    Text::new(en.join(", "), ru.join(", "))
}

/// The user's symbol of a name, primes kept: `phi1'` is `φ_в'` where the file says so.
pub(crate) fn notation(equations: &Equations, name: &str) -> String {
    let bare = name.trim_end_matches('\'');
    let shown = equations.notation.iter().find(|(n, _)| n == bare).map_or(bare, |(_, symbol)| symbol);
    format!("{shown}{}", &name[bare.len()..])
}
