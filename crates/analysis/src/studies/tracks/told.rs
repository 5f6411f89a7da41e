//! Modes along a parameter as a result: numbers, columns, and what is said beside them.

use crate::Quantity;
use crate::dataset::{Column, Dataset, Missing};
use crate::studies::rest::branch::Change;
use crate::studies::rest::changes;
use words::Text;

/// Modes along a parameter.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tracks {
    /// Name of the parameter.
    pub parameter: String,
    /// Its values.
    pub values: Vec<f64>,
    /// Natural frequency |λ| of each mode (outer) at each value; NaN where the mode does not oscillate.
    pub omega: Vec<Vec<f64>>,
    /// Frequency with damping |Im λ|, alike.
    pub damped: Vec<Vec<f64>>,
    /// Damping ratio of each mode at each value.
    pub ratio: Vec<Vec<f64>>,
    /// Multiples of the parameter that excite, when it is a speed: 1 and those of the loads.
    pub orders: Vec<f64>,
    /// Where a frequency |Im λ| equals an order of the parameter, when it is a speed.
    pub critical: Vec<Critical>,
    /// First value at which a motion grows, located to rounding.
    pub unstable_from: Option<f64>,
    /// Ranges of the parameter in which a motion grows, with their ends located to rounding (those of the range itself as they are).
    pub unstable: Vec<[f64; 2]>,
    /// Whether there are modes at each value: an equilibrium, or matrices that need none.
    pub known: Vec<bool>,
    /// The place of rest at each value; none where there is none.
    pub places: Vec<Option<Vec<f64>>>,
    /// Where the place that is followed changes.
    pub changes: Vec<Change>,
    /// Number of motions that connections and closed contacts leave at each value.
    pub freedom: Vec<usize>,
    /// The same as columns.
    pub data: Dataset,
}

/// A critical speed: frequency of the mode = order · speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Critical {
    /// Index of the mode.
    pub mode: usize,
    /// The speed.
    pub value: f64,
    /// Multiple of the speed that excites.
    pub order: f64,
}

/// Values that differ by less than this share are one place without an equilibrium.
pub(super) const ONE_PLACE: f64 = 1e-3;

/// A remark on values without a place of rest.
pub(super) fn without_rest(group: &[f64], parameter: &Quantity, roots: (&'static str, &'static str)) -> Text {
    let [from, to] = [group[0], group[group.len() - 1]];
    let name = &parameter.name;
    if (to - from).abs() > ONE_PLACE * from.abs().max(to.abs()) {
        let [from, to] = [from, to].map(|v| changes::written(v, parameter));
        return Text::new(
            format!("no equilibrium was found from {name} = {} to {} (it may run to infinity there); {}", from.en, to.en, roots.0),
            format!("при {name} от {} до {} равновесие не найдено (возможно, оно уходит там в бесконечность); {}", from.ru, to.ru, roots.1),
        );
    }
    let value = words::digits::ten_digits(group[group.len() / 2]);
    let unit = Text::unit(&if parameter.unit == "1" { String::new() } else { format!(" {}", parameter.unit) });
    let at = Text::new(format!("{}{}", value.en, unit.en), format!("{}{}", value.ru, unit.ru));
    Text::new(
        format!("no equilibrium was found at {name} = {} (it may run to infinity there); {}", at.en, roots.0),
        format!("при {name} = {} равновесие не найдено (возможно, оно уходит там в бесконечность); {}", at.ru, roots.1),
    )
}

/// A remark where every speed of a range is critical.
pub(super) fn runs_along(ranges: &[[f64; 2]]) -> Option<Text> {
    let ends = ranges.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], [a, b]| [low.min(*a), high.max(*b)]);
    let [from, to] = ends.map(words::digits::rounded);
    (!ranges.is_empty()).then(|| {
        Text::new(
            format!(
                "between {} and {} a frequency equals a multiple of the speed all along: no single critical speed can be named there",
                from.en, to.en
            ),
            format!(
                "между {} и {} собственная частота всё время равна кратной скорости: отдельной критической скорости там нет",
                from.ru, to.ru
            ),
        )
    })
}

pub(super) fn dataset(tracks: &Tracks, parameter: &Quantity, diverges: &[bool]) -> Dataset {
    let mut data = Dataset { axis: Some(0), ..Dataset::default() };
    data.columns.push(Column { quantity: parameter.clone(), values: tracks.values.clone() });
    // without damping both are one number, computed in two ways
    let close = |(a, b): (&f64, &f64)| a.is_nan() || (a - b).abs() <= 1e-12 * a.abs();
    let damped = tracks.omega.iter().zip(&tracks.damped).any(|(a, b)| !a.iter().zip(b).all(close));
    let mut add = |name: &str, unit: &str, words: [&str; 2], list: &[Vec<f64>]| {
        for (j, values) in list.iter().enumerate().filter(|(_, v)| v.iter().any(|x| x.is_finite())) {
            let number = j + 1;
            let label = Text::new(format!("{} of mode {number}", words[0]), format!("{} формы {number}", words[1]));
            let name = format!("{name}_{number}");
            let quantity = Quantity { label, symbol: name.clone(), ..Quantity::new(&name, unit) };
            data.columns.push(Column { quantity, values: values.clone() });
        }
    };
    add("omega", "rad/s", ["natural frequency |λ|", "собственная частота |λ|"], &tracks.omega);
    if damped {
        add("omega_d", "rad/s", ["frequency with damping |Im λ|", "частота с учётом затухания |Im λ|"], &tracks.damped);
        add("zeta", "1", ["damping ratio", "относительное затухание"], &tracks.ratio);
    }
    let names: Vec<String> = data.columns[1..].iter().map(|c| c.quantity.name.clone()).collect();
    for name in names {
        let words = Text::new(
            "the mode does not oscillate here: its roots are real, closed contacts hold it, or there is no equilibrium (the notes say where)",
            "здесь движение по этой форме без колебаний: корни вещественные, её удерживают замкнутые контакты либо равновесия нет (где именно, сказано в примечаниях)",
        );
        data.state(&name, Missing::Absent, words);
    }
    data.notes = (0..tracks.omega.len()).flat_map(|j| still(tracks, j, parameter, diverges)).collect();
    data.notes.extend(growths(tracks, parameter));
    data
}

/// Where a mode does not oscillate.
pub(super) fn still(tracks: &Tracks, j: usize, parameter: &Quantity, diverges: &[bool]) -> Vec<Text> {
    let absent: Vec<bool> = tracks.omega[j].iter().zip(&tracks.known).map(|(w, known)| *known && w.is_nan()).collect();
    let mut notes = Vec::new();
    let mut k = 0;
    while k < absent.len() {
        let length = absent[k..].iter().take_while(|a| **a).count();
        if length > 0 {
            let last = k + length - 1;
            let most = tracks.freedom.iter().copied().max().unwrap_or(0);
            let [from, to] = [tracks.values[k], tracks.values[last]].map(|v| changes::written(v, parameter));
            let (name, number) = (&parameter.name, j + 1);
            if (k..=last).all(|row| tracks.freedom[row] < most) {
                notes.push(Text::new(
                    format!(
                        "there is no mode {number} from {name} = {} to {} of the values: closed contacts leave fewer motions there",
                        from.en, to.en
                    ),
                    format!(
                        "формы {number} при значениях {name} от {} до {} нет: замкнутые контакты оставляют там меньше движений",
                        from.ru, to.ru
                    ),
                ));
                k += length;
                continue;
            }
            let grows = diverges[k..=last].iter().any(|d| *d);
            let how = if grows {
                ("a motion grows there without oscillation", "движение там растёт без колебаний")
            } else {
                ("the motion dies out there without oscillation", "движение там затухает без колебаний")
            };
            notes.push(Text::new(
                format!(
                    "mode {number} has no frequency from {name} = {} to {} of the values: its roots are real, {}",
                    from.en, to.en, how.0
                ),
                format!("у формы {number} нет частоты при значениях {name} от {} до {}: корни вещественные, {}", from.ru, to.ru, how.1),
            ));
        }
        k += length.max(1);
    }
    notes
}

/// Where a motion grows.
fn growths(tracks: &Tracks, parameter: &Quantity) -> Vec<Text> {
    let last = tracks.values.last().copied().unwrap_or(f64::NAN);
    let name = &parameter.name;
    let one = |[from, to]: &[f64; 2]| {
        let [v, w] = [*from, *to].map(|v| changes::written(v, parameter));
        if *to == last {
            Text::new(format!("from {name} = {} on a motion grows", v.en), format!("начиная с {name} = {} движение растёт", v.ru))
        } else {
            Text::new(
                format!("between {name} = {} and {} a motion grows", v.en, w.en),
                format!("между {name} = {} и {} движение растёт", v.ru, w.ru),
            )
        }
    };
    tracks.unstable.iter().map(one).collect()
}
