//! Digits that hold: the motion is computed once more with a tighter tolerance and another order, and only what both agree on is a digit.
//!
//! Two solutions with different steps make different errors; where the motion amplifies errors (chaos, a separatrix, a long run) they part, and what has
//! parted is no digit of either. A row beside a jump is left out when the instants of the jump differ by more than the row's distance from it: there
//! the time holds and the value does not mean anything. It is no audit: a chaotic motion is not wrong, its late digits are.

use algebra::elementary;
use words::Text;

use crate::dataset::{Column, Dataset, Digits, Event, Extreme, Held};
use words::digits::number;

/// More digits than a number has are not claimed.
const MOST: f64 = 15.0;
/// Fewer than so many digits of a column are worth a remark.
const FEW: i32 = 4;
/// A value must exceed the tolerance of the terms behind it so many times to be more than that.
const CERTAIN: f64 = 16.0;
/// Share of the largest value of the same unit below which a value is the rounding of a zero: a rate of 1e-15 beside one of 100 has no digit.
const ROUNDING: f64 = 1e-13;

/// Compares a motion with its repetition; `tolerance` and `order` are those of the repetition.
pub fn compare(data: &Dataset, again: &Dataset, tolerance: f64, order: usize) -> Digits {
    let left_out = beside_jumps(data, again);
    let axis = data.axis;
    let columns = (0..data.columns.len()).filter(|i| Some(*i) != axis && !data.columns[*i].values.is_empty());
    let columns = columns.filter(|i| again.columns.get(*i).is_some_and(|c| c.values.len() == data.columns[*i].values.len()));
    Digits { tolerance, order, columns: columns.map(|i| held(data, again, i, (&left_out, 10.0 * tolerance))).collect() }
}

/// Number of digits of a value of this size that a deviation leaves.
pub fn digits(size: f64, deviation: f64) -> i32 {
    if deviation == 0.0 {
        return MOST as i32;
    }
    // half a unit of the last digit is not less than the deviation
    let digits = (elementary::log10(size).floor() - elementary::log10(2.0 * deviation)).floor() + 1.0;
    if digits.is_nan() { 0 } else { digits.clamp(0.0, MOST) as i32 }
}

/// Size up to which the values of a column are zero within the tolerance of the terms that meet in them; 0 where both motions agree on digits.
fn noise(data: &Dataset, again: &Dataset, i: usize, tolerance: f64) -> f64 {
    let largest = |c: &Column| c.values.iter().filter(|v| v.is_finite()).fold(0.0_f64, |m, v| m.max(v.abs()));
    let [a, b] = [&data.columns[i], &again.columns[i]];
    let worst = a.values.iter().zip(&b.values).map(|(a, b)| apart(*a, *b)).fold(0.0, f64::max);
    if digits(largest(a), worst) >= FEW {
        return 0.0;
    }
    let alike = data.columns.iter().filter(|c| c.quantity.unit == a.quantity.unit);
    let beside = ROUNDING * alike.map(largest).fold(0.0, f64::max);
    // the states are off by the tolerance, as by rounding
    let terms = again.rounding.get(i).copied().unwrap_or(0.0) / f64::EPSILON;
    beside.max(CERTAIN * terms * tolerance.max(f64::EPSILON))
}

fn held(data: &Dataset, again: &Dataset, i: usize, (left_out, tolerance): (&[bool], f64)) -> Held {
    let (a, b) = (&data.columns[i].values, &again.columns[i].values);
    let noise = noise(data, again, i, tolerance);
    let apart = |a: f64, b: f64| if a.abs().max(b.abs()) <= noise { 0.0 } else { apart(a, b) };
    let rows = || a.iter().zip(b).enumerate().filter(|(row, _)| left_out.get(*row) != Some(&true));
    let size = a.iter().filter(|v| v.is_finite()).fold(0.0_f64, |m, v| m.max(v.abs()));
    let worst = rows().map(|(_, (a, b))| apart(*a, *b)).fold(0.0, f64::max);
    let of = |list: &[Extreme]| list.iter().find(|e| e.column == i).cloned();
    let both = of(&data.extremes).zip(of(&again.extremes));
    let extreme = |pick: fn(&Extreme) -> f64| both.as_ref().map_or(worst, |(a, b)| apart(pick(a), pick(b)));
    let last = a.len() - 1;
    let limit = size * elementary::powi(10f64, -FEW);
    let lost = rows().find(|(_, (a, b))| apart(**a, **b) > 0.5 * limit).map(|(row, _)| row);
    Held {
        column: i,
        digits: digits(size, worst),
        deviations: [apart(a[0], b[0]), extreme(|e| e.min), extreme(|e| e.max), apart(a[last], b[last])],
        instants: [extreme(|e| e.t_min), extreme(|e| e.t_max)],
        lost: lost.and_then(|row| data.axis.map(|axis| data.columns[axis].values[row])),
        noise,
    }
}

fn apart(a: f64, b: f64) -> f64 {
    if a == b || (a.is_nan() && b.is_nan()) { 0.0 } else { (a - b).abs() }
}

/// Rows nearer to a jump than its instant is known.
fn beside_jumps(data: &Dataset, again: &Dataset) -> Vec<bool> {
    let Some(axis) = data.axis else { return Vec::new() };
    if data.events.len() != again.events.len() {
        return Vec::new();
    }
    let shifts: Vec<(f64, f64)> = data.events.iter().zip(&again.events).map(|(a, b)| (a.t, 2.0 * (a.t - b.t).abs())).collect();
    data.columns[axis].values.iter().map(|t| shifts.iter().any(|(at, width)| (t - at).abs() <= *width && *width > 0.0)).collect()
}

/// Says where digits are lost; none when every column keeps at least four.
pub fn note(found: &Digits, data: &Dataset) -> Option<Text> {
    let few = found.columns.iter().filter(|c| c.digits < FEW).min_by_key(|c| c.digits)?;
    let quantity = data.columns.get(few.column)?;
    let name = &quantity.quantity.name;
    let from = few.lost.map(words::digits::rounded);
    let (en, ru) = match &from {
        Some(t) => (format!(" from t = {} s on", t.en), format!(" начиная с t = {} с", t.ru)),
        None => (String::new(), String::new()),
    };
    let n = number(found.tolerance);
    Some(Text::new(
        format!(
            "a repetition with tolerance {} and order {} agrees with {} of {name} in {} digits only{en}: the motion is sensitive or long, later digits mean nothing",
            n.en, found.order, "the rows", few.digits
        ),
        format!(
            "повторный расчёт с точностью {} и порядком {} совпадает по {name} лишь в {} цифрах{ru}: движение чувствительно или слишком длинно, дальнейшие цифры ничего не значат",
            n.ru, found.order, few.digits
        ),
    ))
}

/// Digits of an instant that the list of events shows.
const SHOWN: i32 = 6;

/// Events with their places in the list, without those that follow one of the same kind within the digits shown: of infinitely many impacts before an instant either
/// motion has as many as its rounding lets it see.
fn apart_events(events: &[Event]) -> Vec<(usize, &Event)> {
    let near = |a: &Event, b: &Event| (a.t - b.t).abs() <= elementary::powi(10f64, 1 - SHOWN) * b.t.abs();
    let mut list: Vec<(usize, &Event)> = Vec::new();
    for (k, event) in events.iter().enumerate() {
        let alike = |kept: &&(usize, &Event)| (kept.1.guard, &kept.1.name) == (event.guard, &event.name);
        if !list.iter().rev().find(alike).is_some_and(|kept| near(kept.1, event)) {
            list.push((k, event));
        }
    }
    list
}

/// Says from which event on the list is not the same in both motions, to the digits that it shows.
pub fn note_of_events(data: &Dataset, again: &Dataset) -> Option<Text> {
    let (own, other) = (apart_events(&data.events), apart_events(&again.events));
    let parts = |((_, a), (_, b)): &(&(usize, &Event), &(usize, &Event))| {
        (a.guard, &a.name) != (b.guard, &b.name) || digits(a.t.abs(), (a.t - b.t).abs()) < SHOWN
    };
    // of an event that only the repetition has nothing is shown
    let behind = own.get(other.len());
    let (first, event) = *own.iter().zip(&other).find(parts).map(|(own, _)| own).or(behind)?;
    let t = number(event.t);
    Some(Text::new(
        format!(
            "the list of events agrees with the repetition up to number {first}: the instants from t = {} s on hold fewer than {SHOWN} digits, and which events follow is open",
            t.en
        ),
        format!(
            "список событий совпадает с повторным расчётом до номера {first}: у моментов начиная с t = {} с меньше {SHOWN} верных цифр, и сами дальнейшие события не определены",
            t.ru
        ),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn events_are_told_from_where_they_part() {
        let at =
            |list: &[f64]| Dataset { events: list.iter().map(|t| Event { t: *t, ..Event::default() }).collect(), ..Dataset::default() };
        let said = |a: &[f64], b: &[f64]| note_of_events(&at(a), &at(b)).map(|text| text.en);
        assert_eq!(said(&[1.0, 2.0, 3.0], &[1.0, 2.0, 3.0]), None);
        // 2.0000001 and 2 share seven digits, 3.01 and 3 do not share six
        let text = said(&[1.0, 2.0, 3.0, 4.0], &[1.0, 2.0000001, 3.01, 4.5]).unwrap();
        assert!(text.contains("up to number 2") && text.contains("t = 3 s"), "{text}");
        // one more in the motion that is shown
        assert!(said(&[1.0, 2.0], &[1.0]).unwrap().contains("t = 2 s"));
        assert_eq!(said(&[1.0], &[1.0, 2.0]), None);
    }

    #[test]
    fn digits_count_what_two_numbers_share() {
        assert_eq!(digits(1.0, 0.0), 15);
        // 2.5182 and 2.5183: four digits, 2.518
        assert_eq!(digits(2.5182, 1e-4), 4);
        assert_eq!(digits(3.0, 1.0), 0);
        assert_eq!(digits(3.0, 0.4), 1);
        assert_eq!(digits(1.0, 3.0), 0);
        assert_eq!(digits(0.0, 1.0), 0);
    }
}
