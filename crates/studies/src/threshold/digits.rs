//! How many digits of a change hold: it is looked for once more with a finer tolerance.

use super::follow::Follow;
use analysis::Quantity;
use analysis::dataset::Audit;
use analysis::studies::threshold::{Side, close, unit};
use mechanics::asked::Value;
use words::limits::TOLERANCES;
use words::{Notice, Text};

/// Share of the unit of the last digit within which the value is closed in: what is printed is then off by less than that unit, however it is rounded.
pub(super) const WITHIN: f64 = 0.1;
/// Share of the tolerance with which the change is looked for again.
const FINER: f64 = 0.1;
/// A range that does not hold the change any more is widened by this factor; a digit takes two of them.
const WIDER: f64 = 4.0;
/// How often; then it is no longer the same change.
const WIDENINGS: usize = 25;
/// A change that moved is looked for this much finer than it moved: enough to count its digits.
const ROUGH: f64 = 0.125;

/// What the repetition says.
pub(super) struct Held {
    /// How far the change lies from where it was, at most; none without a finer tolerance.
    moved: Option<f64>,
    /// Half of the unit of the last digit.
    limit: f64,
    /// The tolerances.
    tolerances: [f64; 2],
    /// Digits that hold.
    pub(super) digits: usize,
}

/// Looks again with a finer tolerance; a study without one is as exact as it is.
pub(super) fn held(follow: &mut Follow<'_, '_>, found: [Side; 2], digits: usize) -> Result<Held, Notice> {
    let value = 0.5 * (found[0].place + found[1].place);
    let limit = 0.5 * unit(value, digits);
    let asked = follow.repeated.tolerance(&follow.at.machine);
    let [usual, finer] = [asked.unwrap_or(0.0), (FINER * asked.unwrap_or(0.0)).max(*TOLERANCES.start())];
    if asked.is_none() || finer >= usual {
        return Ok(Held { moved: None, limit, tolerances: [usual, finer], digits });
    }
    follow.repeated.set("tolerance", Value::Number(finer));
    let again = again(follow, found, digits);
    follow.repeated.set("tolerance", Value::Number(usual));
    let moved = again?.map(|place| (place - value).abs());
    let digits = moved.map_or(0, |moved| (0..=digits).rev().find(|n| moved <= 0.5 * unit(value, *n)).unwrap_or(0));
    Ok(Held { moved: Some(moved.unwrap_or(f64::INFINITY)), limit, tolerances: [usual, finer], digits })
}

/// Where the change is with the finer tolerance; none where it is not near.
fn again(follow: &mut Follow<'_, '_>, found: [Side; 2], digits: usize) -> Result<Option<f64>, Notice> {
    let middle = 0.5 * (found[0].place + found[1].place);
    let sides = found.map(|side| side.is_above());
    let wanted = WITHIN * unit(middle, digits);
    let mut half = (0.5 * (found[1].place - found[0].place)).max(f64::EPSILON * middle.abs());
    let mut known: [Option<Side>; 2] = [None, None];
    for _ in 0..WIDENINGS {
        let mut ends = [Side { place: middle - half, value: 0.0 }, Side { place: middle + half, value: 0.0 }];
        for end in &mut ends {
            end.value = follow.value(end.place)?;
        }
        if ends.each_ref().map(Side::is_above) == sides {
            // what lay outside before bounds it from one side
            let near =
                [0, 1].map(|k| known.iter().flatten().find(|s| s.is_above() == sides[k] && inside(s, &ends)).copied().unwrap_or(ends[k]));
            let width = near[1].place - near[0].place;
            let rough = wanted.max(ROUGH * width);
            let [a, b] = if width > 2.0 * wanted { close(&mut |place| follow.value(place), near, &|_, _| rough)? } else { near };
            return Ok(Some(0.5 * (a.place + b.place)));
        }
        known = ends.map(Some);
        half *= WIDER;
    }
    Ok(None)
}

fn inside(side: &Side, ends: &[Side; 2]) -> bool {
    side.place > ends[0].place && side.place < ends[1].place
}

impl Held {
    /// The check: the change moves by less than half of its last digit.
    pub(super) fn audits(&self) -> Vec<Audit> {
        let name = Text::new(
            "shift of the threshold with a finer tolerance, of half a unit of its last digit",
            "сдвиг границы при более строгой точности, в долях половины единицы последней цифры",
        );
        self.moved.map(|moved| Audit::at_most("threshold_digits", name, moved / self.limit, 1.0)).into_iter().collect()
    }

    /// What is to be said of the digits.
    pub(super) fn notes(&self, parameter: &Quantity, wanted: usize) -> Vec<Text> {
        let [usual, finer] = self.tolerances.map(words::digits::rounded);
        let name = &parameter.symbol;
        match self.moved {
            None if self.tolerances[0] > 0.0 => vec![Text::new(
                format!("the digits of {name} were not confirmed: there is no tolerance finer than {}", usual.en),
                format!("цифры {name} не подтверждены: точности строже {} нет", usual.ru),
            )],
            None => Vec::new(),
            Some(_) if self.digits >= wanted => vec![Text::new(
                format!("with the tolerance {} in place of {} the same {wanted} digits are found", finer.en, usual.en),
                format!("при точности {} вместо {} получаются те же цифры ({wanted})", finer.ru, usual.ru),
            )],
            Some(_) => vec![Text::new(
                format!(
                    "with the tolerance {} in place of {} only the first {} of {wanted} digits are the same: ask for fewer digits, or give a finer tolerance",
                    finer.en, usual.en, self.digits
                ),
                format!(
                    "при точности {} вместо {} совпадают лишь первые цифры: {} из {wanted}; запросите меньше цифр или задайте более строгую точность",
                    finer.ru, usual.ru, self.digits
                ),
            )],
        }
    }
}
