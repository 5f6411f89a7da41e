//! Numbers and equations of frames as they are written.

use structures::truss::Term;
use words::Language;

/// Significant digits.
pub(super) const DIGITS: usize = 6;

pub(super) fn number(v: f64, language: Language) -> String {
    report::number::short(v, DIGITS, language)
}

/// `0.6 S_AB + S_AC + 3 = 0`.
pub fn equation(terms: &[Term], language: Language) -> String {
    let mut out = String::new();
    for t in terms {
        // unknown forces by name, known ones by their numbers
        let (size, negative, name) = match t.unknown {
            true => (t.coefficient.abs(), t.coefficient < 0.0, format!("S_{}", t.name)),
            false => ((t.coefficient * t.force).abs(), t.coefficient * t.force < 0.0, String::new()),
        };
        if size == 0.0 {
            continue;
        }
        out.push_str(match (out.is_empty(), negative) {
            (true, true) => "−",
            (true, false) => "",
            (false, true) => " − ",
            (false, false) => " + ",
        });
        // a component of a unit vector along an axis is rounded
        let one = (size - 1.0).abs() < 1e-12 && !name.is_empty();
        if !one {
            out.push_str(&number(size, language));
        }
        if !name.is_empty() {
            if !one {
                out.push(' ');
            }
            out.push_str(&name);
        }
    }
    if out.is_empty() { "0 = 0".into() } else { out + " = 0" }
}
