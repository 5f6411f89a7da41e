//! What is said about a place of rest that changes along a parameter.

use algebra::arrange::Arrange;
use words::Text;

use super::branch::{Branch, Change, Event};
use crate::Quantity;
use crate::dataset::{Column, Dataset, Missing};
use words::digits::{rounded, ten_digits};

/// Coordinates that a remark names at most.
const NAMED: usize = 3;

/// Remarks on the changes of a place along a parameter.
pub fn notes(branch: &Branch, parameter: &Quantity, coordinates: &[Quantity]) -> Vec<Text> {
    branch.changes().iter().map(|change| note(change, (parameter, branch.home()), coordinates)).collect()
}

/// A value with its unit.
pub fn written(value: f64, of: &Quantity) -> Text {
    let v = rounded(value);
    let unit = Text::unit(&if of.unit == "1" { String::new() } else { format!(" {}", of.unit) });
    Text::new(format!("{}{}", v.en, unit.en), format!("{}{}", v.ru, unit.ru))
}

/// The same of a value that is known to rounding.
fn located(value: f64, of: &Quantity) -> Text {
    let (v, short) = (ten_digits(value), written(value, of));
    let unit = |of: &Text, number: &Text| Text::new(of.en.replacen(&number.en, "", 1), of.ru.replacen(&number.ru, "", 1));
    let unit = unit(&short, &rounded(value));
    Text::new(format!("{}{}", v.en, unit.en), format!("{}{}", v.ru, unit.ru))
}

/// Coordinates of a place: those that differ from another one, most first.
pub fn place(q: &[f64], other: &[f64], coordinates: &[Quantity]) -> Text {
    let mut order: Vec<usize> = (0..q.len()).collect();
    if q.len() > NAMED {
        order.arrange_by(|i, j| (q[*j] - other[*j]).abs().total_cmp(&(q[*i] - other[*i]).abs()).then(i.cmp(j)));
    }
    order.truncate(NAMED);
    order.sort_unstable();
    let largest = q.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    // a coordinate that is rounding of the others, or of a millimetre or milliradian
    let settled = |v: f64| if v.abs() <= 1e-9 * largest.max(1e-3) { 0.0 } else { v };
    let list: Vec<(String, Text)> =
        order.iter().map(|i| (coordinates[*i].name.clone(), written(settled(q[*i]), &coordinates[*i]))).collect();
    let join = |pick: fn(&Text) -> &str, gap: &str| list.iter().map(|(n, v)| format!("{n} = {}", pick(v))).collect::<Vec<_>>().join(gap);
    Text::new(join(|t| &t.en, ", "), join(|t| &t.ru, "; "))
}

fn note(change: &Change, (parameter, home): (&Quantity, f64), coordinates: &[Quantity]) -> Text {
    let (at, name) = (located(change.value, parameter), &parameter.name);
    let here = place(&change.at, change.behind.as_ref().map_or(&change.at, |b| &b.1), coordinates);
    let side = if change.upwards { ("above", "выше") } else { ("below", "ниже") };
    let behind = change.behind.as_ref().map(|(value, q)| {
        let (place, value) = (place(q, &change.at, coordinates), written(*value, parameter));
        Text::new(format!("{} at {name} = {}", place.en, value.en), format!("{} при {name} = {}", place.ru, value.ru))
    });
    match (change.event, behind) {
        (Event::Forks(count), Some(behind)) => forks(count, (&at, name), (&here, side), &behind),
        (Event::Joins, Some(behind)) => Text::new(
            format!(
                "at {name} = {} the place of rest joins another one ({}); {} it the numbers are about that ({})",
                at.en, here.en, side.0, behind.en
            ),
            format!(
                "при {name} = {} положение равновесия сливается с другим ({}); {} результаты относятся к нему ({})",
                at.ru, here.ru, side.1, behind.ru
            ),
        ),
        (Event::Loses, _) => Text::new(
            format!(
                "at {name} = {} the place of rest {} loses its stability without oscillation, and no stable place parts from it; {} it the numbers are about this unstable \
                 place, other ones may exist: see `equilibrium`",
                at.en, here.en, side.0
            ),
            format!(
                "при {name} = {} положение равновесия {} теряет устойчивость без колебаний, и устойчивое положение от него не ответвляется; {} результаты относятся к этому \
                 неустойчивому положению, могут существовать и другие: см. `equilibrium`",
                at.ru, here.ru, side.1
            ),
        ),
        (Event::Touches, behind) => touches(change, (&at, name), &here, behind.as_ref()),
        (Event::Falls, Some(behind)) => Text::new(
            format!(
                "at {name} = {} the place of rest ends ({}); {} it the numbers are about the place to which the machine falls from there ({})",
                at.en, here.en, side.0, behind.en
            ),
            format!(
                "при {name} = {} положение равновесия исчезает ({}); {} результаты относятся к положению, в которое машина оттуда переходит ({})",
                at.ru, here.ru, side.1, behind.ru
            ),
        ),
        (_, Some(behind)) => elsewhere(&written(home, parameter), (&at, name), (&here, side), &behind),
        (_, None) => Text::new(
            format!("the place of rest ends at {name} = {} ({}); {} it no place of rest was found", at.en, here.en, side.0),
            format!("положение равновесия исчезает при {name} = {} ({}); {} положений равновесия не найдено", at.ru, here.ru, side.1),
        ),
    }
}

type Side = (&'static str, &'static str);

/// The place goes on where another one parts from it.
fn forks(count: usize, (at, name): (&Text, &str), (here, side): (&Text, Side), behind: &Text) -> Text {
    let others = if count > 1 {
        (", one of several that are stable", ", одного из нескольких устойчивых")
    } else {
        ("", "")
    };
    Text::new(
        format!(
            "at {name} = {} the place of rest {} loses its stability without oscillation; {} it the numbers are about the stable place that parts from it there \
             ({}){}",
            at.en, here.en, side.0, behind.en, others.0
        ),
        format!(
            "при {name} = {} положение равновесия {} теряет устойчивость без колебаний; {} результаты относятся к устойчивому положению, которое от него там \
             ответвляется ({}){}",
            at.ru, here.ru, side.1, behind.ru, others.1
        ),
    )
}

/// The place ends, and another one is found from the start.
fn elsewhere(from: &Text, (at, name): (&Text, &str), (here, side): (&Text, Side), behind: &Text) -> Text {
    Text::new(
        format!(
            "the place of rest that the machine has at {name} = {} ends at {name} = {} ({}); {} it the numbers are about another place, sought from the start ({})",
            from.en, at.en, here.en, side.0, behind.en
        ),
        format!(
            "положение равновесия, которое машина занимает при {name} = {}, исчезает при {name} = {} ({}); {} результаты относятся к другому положению, найденному от \
             начального ({})",
            from.ru, at.ru, here.ru, side.1, behind.ru
        ),
    )
}

/// Contacts that close and open.
fn touches(change: &Change, (at, name): (&Text, &str), here: &Text, behind: Option<&Text>) -> Text {
    let side = if change.upwards { ("above", "выше") } else { ("below", "ниже") };
    let plain = |name: &String| name.split_once('(').and_then(|(_, rest)| rest.strip_suffix(')')).unwrap_or(name).to_owned();
    let list = |names: &[String]| names.iter().map(plain).collect::<Vec<_>>().join(", ");
    let verb = |names: &[String], one: &'static str, more: &'static str| if names.len() == 1 { one } else { more };
    let mut events = Text::default();
    let (closes, opens) = (&change.closes, &change.opens);
    let gap = if closes.is_empty() || opens.is_empty() { "" } else { "; " };
    if !closes.is_empty() {
        events.en += &format!("{} {}", list(closes), verb(closes, "closes", "close"));
        events.ru += &format!("{} {}", verb(closes, "замыкается", "замыкаются"), list(closes));
    }
    if !opens.is_empty() {
        events.en += &format!("{gap}{} {}", list(opens), verb(opens, "opens", "open"));
        events.ru += &format!("{gap}{} {}", verb(opens, "размыкается", "размыкаются"), list(opens));
    }
    match behind {
        Some(behind) => Text::new(
            format!(
                "at {name} = {} {} ({}); {} it the numbers are about the place with these contacts ({})",
                at.en, events.en, here.en, side.0, behind.en
            ),
            format!(
                "при {name} = {} {} ({}); {} результаты относятся к положению с таким набором контактов ({})",
                at.ru, events.ru, here.ru, side.1, behind.ru
            ),
        ),
        None => Text::new(
            format!(
                "at {name} = {} {} ({}); {} it the equations are others, and no rows are given: ask for them with a value of {name} from there",
                at.en, events.en, here.en, side.0
            ),
            format!(
                "при {name} = {} {} ({}); {} уравнения другие, и строки не приводятся: задайте для них значение {name} из той области",
                at.ru, events.ru, here.ru, side.1
            ),
        ),
    }
}

/// Share by which a coordinate has to move for its column.
const MOVED: f64 = 1e-9;

/// Columns `equilibrium_NAME` of the coordinates that move along a parameter; rows without a place are empty.
pub fn add_columns(data: &mut Dataset, places: &[Option<Vec<f64>>], coordinates: &[Quantity]) {
    for (i, q) in coordinates.iter().enumerate() {
        let values: Vec<f64> = places.iter().map(|p| p.as_ref().map_or(f64::NAN, |p| p[i])).collect();
        let known = || values.iter().copied().filter(|v| v.is_finite());
        let (low, high) = known().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        if high.is_nan() || low > high || high - low <= MOVED * (1.0 + low.abs().max(high.abs())) {
            continue;
        }
        let name = format!("equilibrium_{}", q.name);
        let label = Text::new(format!("place of rest: {}", q.name), format!("положение равновесия: {}", q.name));
        let quantity = Quantity { label, symbol: format!("{}_0", q.symbol), ..Quantity::new(&name, &q.unit) };
        data.columns.push(Column { quantity, values });
        data.state(&name, Missing::Absent, Text::new("no place of rest here", "здесь положения равновесия нет"));
    }
}
