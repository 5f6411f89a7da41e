//! What a wrong number looks like, in the order in which slips are usual. Only "looks like": a likeness is no proof.

use super::guards::within;
use mechanics::model::AnswerDecl;
use mechanics::units::parse_unit;
use mechanics::variants::scale;
use std::f64::consts::{PI, SQRT_2, TAU};
use words::Text;

/// A likeness is looked for within this share at most, however wide the tolerance.
const CLOSE: f64 = 0.02;
/// Acceleration of gravity of a student's slip.
const G: [f64; 3] = [9.81, 9.8, 10.0];
/// Units in which a number may have been meant.
const UNITS: [&str; 48] = [
    "m", "mm", "cm", "km", "um", "kg", "g", "t", "s", "ms", "min", "h", "N", "kN", "MN", "J", "kJ", "MJ", "W", "kW", "MW", "Pa", "kPa",
    "MPa", "GPa", "m/s", "mm/s", "cm/s", "km/h", "m/s^2", "mm/s^2", "cm/s^2", "N m", "kN m", "N/m", "kN/m", "N/mm", "N/cm", "kg m^2",
    "kg cm^2", "g cm^2", "Hz", "kHz", "m^2", "cm^2", "mm^2", "cm^4", "mm^4",
];

/// What a wrong number looks like.
#[derive(Clone, Debug, PartialEq)]
pub enum Likeness {
    /// The right number in another unit.
    Unit(String),
    /// Off by a power of ten.
    Power(i32),
    /// The opposite sign.
    Sign,
    /// Periods a second against radians a second.
    Turns,
    /// Degrees against radians.
    Degrees,
    /// Twice the right number.
    Double,
    /// Half of it.
    Half,
    /// Effective value against amplitude.
    Rms,
    /// Without the static deflection.
    Static,
    /// Weight in place of mass.
    Weight,
    /// The answer of another variant.
    Neighbour(String),
    /// Damping left out.
    Undamped,
}

/// Numbers that only another calculation gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Other {
    /// With the static deflection left out.
    Static,
    /// With weights in place of masses.
    Weight,
    /// Without damping.
    Undamped,
}

/// What a wrong number may be compared with: neighbours by name, and other calculations, made only when they are asked for.
pub struct Around<'a> {
    /// Answers of the neighbouring variants.
    pub neighbours: &'a [(String, f64)],
    /// Numbers of another calculation, in the unit of the question.
    pub other: &'a mut dyn FnMut(Other) -> Vec<f64>,
}

/// What a number that is not right looks like; all numbers are in the unit of the question.
pub fn likeness(answer: &AnswerDecl, (truth, given): (f64, f64), around: &mut Around<'_>) -> Option<Likeness> {
    if given == 0.0 || truth == 0.0 || within(given, (truth, 0.0), answer) {
        return None;
    }
    let is = |candidate: f64| (given - candidate).abs() <= CLOSE.min(share(answer, truth)) * candidate.abs();
    let ratio = |factor: f64| is(truth * factor);
    let either = |factor: f64| ratio(factor) || ratio(1.0 / factor);
    if let Some(label) = UNITS.iter().find(|label| other_unit(label, answer).is_some_and(ratio)) {
        return Some(Likeness::Unit((*label).to_owned()));
    }
    if let Some(power) = (1..=9).flat_map(|k| [k, -k]).find(|k| ratio(algebra::elementary::powi(10.0, *k))) {
        return Some(Likeness::Power(power));
    }
    if is(-truth) {
        return Some(Likeness::Sign);
    }
    let turns = answer.unit.dimension.same(&rate()) && (either(TAU) || either(60.0) || either(30.0 / PI));
    if turns {
        return Some(Likeness::Turns);
    }
    let turning = answer.unit.dimension.is_angular() || answer.unit.dimension.is_none() || answer.unit.dimension.same(&rate());
    if turning && either(180.0 / PI) {
        return Some(Likeness::Degrees);
    }
    let simple = [(2.0, Likeness::Double), (0.5, Likeness::Half), (SQRT_2, Likeness::Rms), (1.0 / SQRT_2, Likeness::Rms)];
    if let Some((_, likeness)) = simple.into_iter().find(|(factor, _)| ratio(*factor)) {
        return Some(likeness);
    }
    behind(&is, &either, around)
}

/// Likenesses that need more than the number itself.
fn behind(is: &dyn Fn(f64) -> bool, either: &dyn Fn(f64) -> bool, around: &mut Around<'_>) -> Option<Likeness> {
    if (around.other)(Other::Static).into_iter().any(is) {
        return Some(Likeness::Static);
    }
    if G.iter().any(|g| either(*g)) || (around.other)(Other::Weight).into_iter().any(is) {
        return Some(Likeness::Weight);
    }
    if let Some((name, _)) = around.neighbours.iter().find(|(_, value)| is(*value)) {
        return Some(Likeness::Neighbour(name.clone()));
    }
    (around.other)(Other::Undamped).into_iter().any(is).then_some(Likeness::Undamped)
}

fn rate() -> mechanics::units::Dimension {
    mechanics::units::Dimension::ANGULAR_RATE
}

/// How far a right number may be off, as a share of it.
fn share(answer: &AnswerDecl, truth: f64) -> f64 {
    match answer.tolerance {
        mechanics::model::Tolerance::Relative(share) => share,
        mechanics::model::Tolerance::Absolute(size) => size / answer.unit.factor / truth.abs(),
    }
}

/// What the right number would be multiplied by in another unit of its dimension.
fn other_unit(label: &str, answer: &AnswerDecl) -> Option<f64> {
    let unit = parse_unit(label).ok()?;
    let own = &answer.unit;
    // periods and radians are another slip
    let counts = own.dimension.counts_periods() != unit.dimension.counts_periods();
    let factor = own.factor / unit.factor.to_f64();
    // the same unit under another name differs by rounding
    let fits = unit.dimension.same(&own.dimension) && !counts && !own.dimension.is_angular() && (factor - 1.0).abs() > 1e-9;
    (fits && scale(&mechanics::units::si_label(&own.dimension), own).is_ok()).then_some(factor)
}

impl Likeness {
    /// In words.
    pub fn words(&self) -> Text {
        let text = |en: &str, ru: &str| Text::new(en, ru);
        match self {
            Likeness::Unit(label) => {
                let unit = Text::unit(label);
                Text::new(format!("looks like the number in {}", unit.en), format!("похоже на значение в {}", unit.ru))
            }
            Likeness::Power(k) => {
                let power = report::number::superscript(&k.to_string());
                Text::new(format!("looks like an error by the factor 10{power}"), format!("похоже на ошибку в 10{power} раз"))
            }
            Likeness::Sign => text("looks like the opposite sign", "похоже на обратный знак"),
            Likeness::Turns => text("looks like periods a second against rad/s (a factor 2π)", "похоже, что спутаны Гц (об/мин) и рад/с"),
            Likeness::Degrees => text("looks like degrees against radians", "похоже, что спутаны градусы и радианы"),
            Likeness::Double => text("looks like twice the value", "похоже на удвоенное значение"),
            Likeness::Half => text("looks like half the value", "похоже на половину значения"),
            Likeness::Rms => text(
                "looks like an effective value against an amplitude (a factor √2)",
                "похоже, что спутаны действующее и амплитудное значения (множитель √2)",
            ),
            Likeness::Static => text("looks like a forgotten static deflection", "похоже, что не учтено статическое отклонение"),
            Likeness::Weight => text("looks like weight in place of mass", "похоже, что вместо массы подставлен вес (или наоборот)"),
            Likeness::Neighbour(name) => {
                Text::new(format!("looks like the value of variant {name}"), format!("похоже на значение для варианта {name}"))
            }
            Likeness::Undamped => text("looks like the value without damping", "похоже на значение без учёта сопротивления"),
        }
    }

    /// Its place in the order in which they are tried.
    pub fn rank(&self) -> usize {
        match self {
            Likeness::Unit(_) => 0,
            Likeness::Power(_) => 1,
            Likeness::Sign => 2,
            Likeness::Turns => 3,
            Likeness::Degrees => 4,
            Likeness::Double | Likeness::Half => 5,
            Likeness::Rms => 6,
            Likeness::Static => 7,
            Likeness::Weight => 8,
            Likeness::Neighbour(_) => 9,
            Likeness::Undamped => 10,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mechanics::model::{AnswerUnit, AnswerValue, Tolerance};

    fn item(label: &str, tolerance: f64) -> AnswerDecl {
        let mut graph = symbolic::Graph::new();
        let unit = parse_unit(label).unwrap();
        AnswerDecl {
            id: "a".into(),
            symbol: graph.symbol_id("a", 0),
            ask: Text::default(),
            value: AnswerValue::Formula { value: graph.zero(), factor: 1.0 },
            unit: AnswerUnit { label: label.into(), factor: unit.factor.to_f64(), dimension: unit.dimension },
            tolerance: Tolerance::Relative(tolerance),
            gives: None,
            span: 0..0,
            value_span: 0..0,
        }
    }
    fn of(answer: &AnswerDecl, truth: f64, given: f64) -> Option<Likeness> {
        let mut other = |which: Other| match which {
            Other::Static => vec![truth * 1.37],
            Other::Weight => vec![truth * 2.71],
            Other::Undamped => vec![truth * 1.13],
        };
        let neighbours = [("8".to_owned(), truth * 1.21)];
        likeness(answer, (truth, given), &mut Around { neighbours: &neighbours, other: &mut other })
    }

    /// Random numbers without a crate: Knuth's multiplier, top bits.
    fn dice(state: &mut u64) -> f64 {
        *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*state >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Each slip is found, or one that comes before it and fits as well; a right number has none.
    #[test]
    fn slips_are_found_over_random_answers_and_right_answers_have_none() {
        let mut seed = 7;
        let units = ["N", "mm", "rad/s", "Hz", "s", "kg", "m/s", "rad", "1"];
        for round in 0..4000 {
            let answer = item(units[round % units.len()], 0.001 + 0.02 * dice(&mut seed));
            let truth = (10.0 * dice(&mut seed) + 0.1) * if dice(&mut seed) < 0.5 { -1.0 } else { 1.0 };
            let Tolerance::Relative(share) = answer.tolerance else { continue };
            let right = truth * (1.0 + share * (2.0 * dice(&mut seed) - 1.0));
            assert_eq!(of(&answer, truth, right), None, "{truth} {right}");
            let slips = [
                (truth * 10.0, 1),
                (-truth, 2),
                (truth * 2.0, 5),
                (truth / 2.0, 5),
                (truth * SQRT_2, 6),
                (truth * 1.37, 7),
                (truth * 2.71, 8),
                (truth * 1.21, 9),
                (truth * 1.13, 10),
            ];
            for (given, rank) in slips {
                let given = given * (1.0 + 0.3 * share * (2.0 * dice(&mut seed) - 1.0));
                let found = of(&answer, truth, given).unwrap_or_else(|| panic!("{truth} {given} in {}", answer.unit.label));
                assert!(found.rank() <= rank, "{found:?} for {truth} {given}");
            }
        }
    }

    #[test]
    fn slips_have_their_names() {
        assert_eq!(of(&item("N", 0.01), 5.0, 5000.0), None.or(Some(Likeness::Power(3))));
        assert_eq!(of(&item("kN", 0.01), 5.0, 5000.0), Some(Likeness::Unit("N".into())));
        assert_eq!(of(&item("m", 0.01), 0.25, 250.0), Some(Likeness::Unit("mm".into())));
        assert_eq!(of(&item("N", 0.01), 5.0, 0.5), Some(Likeness::Power(-1)));
        assert_eq!(of(&item("rad/s", 0.01), 5.0, 5.0 / TAU), Some(Likeness::Turns));
        assert_eq!(of(&item("Hz", 0.01), 5.0, 5.0 * TAU), Some(Likeness::Turns));
        assert_eq!(of(&item("rad", 0.01), 0.5, 28.6479), Some(Likeness::Degrees));
        assert_eq!(of(&item("kg", 0.01), 5.0, 49.05), Some(Likeness::Weight));
        assert_eq!(of(&item("N", 0.01), 5.0, 5.0 * 1.21), Some(Likeness::Neighbour("8".into())));
        assert_eq!(of(&item("N", 0.01), 5.0, 7.77), None);
        assert_eq!(of(&item("N", 0.01), 0.0, 7.77), None);
    }
}
