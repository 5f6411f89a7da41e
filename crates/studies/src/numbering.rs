//! Numbers of bodies, the same on the scheme and in sentences. A body that its label numbers ("bar 3") has that number: masses, lengths and angles of the file
//! go by it. The others take the numbers that are left, in the order of the file.

use mechanics::Model;
use mechanics::model::{Frame, FrameId};
use words::Text;

/// Larger numbers in a label are no places in a list of bodies: "motor 1500".
const LARGEST: usize = 99;

/// The number of each frame of the model; none of frames that are no bodies.
pub fn numbers(model: &Model) -> Vec<Option<usize>> {
    let bodies: Vec<usize> = (0..model.frames.len()).filter(|i| model.frames[*i].is_body).collect();
    let mut numbers = vec![None; model.frames.len()];
    let written: Vec<Option<usize>> = bodies.iter().map(|i| own(&model.frames[*i])).collect();
    // a number that stands twice is the number of none
    let once = |n: usize| written.iter().filter(|other| **other == Some(n)).count() == 1;
    let written: Vec<Option<usize>> = written.iter().map(|own| own.filter(|n| once(*n))).collect();
    let mut left = (1..).filter(|n| !written.contains(&Some(*n)));
    for (i, own) in bodies.iter().zip(&written) {
        numbers[*i] = own.or_else(|| left.next());
    }
    numbers
}

/// The number of a body; none of the ground and of frames.
pub fn number(model: &Model, frame: FrameId) -> Option<usize> {
    numbers(model).get(frame.index()).copied().flatten()
}

/// A label without the number at its end: "bar" of "bar 3", which follows "body 3".
pub fn bare(label: &str) -> &str {
    ending(label).map_or(label, |(words, _)| words)
}

/// The number that a label ends with, the same in both languages.
fn own(frame: &Frame) -> Option<usize> {
    let Text { en, ru } = &frame.label;
    let [en, ru] = [en, ru].map(|label| ending(label).map(|(_, n)| n));
    if frame.label.en.is_empty() || frame.label.ru.is_empty() { en.or(ru) } else { en.filter(|n| ru == Some(*n)) }
}

/// The words of a label and the whole number behind them.
fn ending(label: &str) -> Option<(&str, usize)> {
    let (words, number) = label.trim_end().rsplit_once([' ', '\u{a0}'])?;
    let digits = number.bytes().all(|b| b.is_ascii_digit()) && !number.starts_with('0');
    let number: usize = number.parse().ok().filter(|_| digits)?;
    (number <= LARGEST && words.chars().any(char::is_alphabetic)).then(|| (words.trim_end(), number))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The numbers of bodies with these labels.
    fn of(labels: &[&str]) -> Vec<usize> {
        let mut text = String::from("[parameters]\nm = \"1 kg\"\n[coordinates]\nx = { unit = \"m\" }\n");
        for (i, label) in labels.iter().enumerate() {
            text.push_str(&format!("[bodies.b{i}]\nlabel = \"{label}\"\norigin = [\"x\", \"{i} m\"]\nmass = \"m\"\n"));
        }
        let reading = crate::read(&crate::Source::new("model.toml", &text), &[]).unwrap_or_else(|found| panic!("{found:?}"));
        numbers(&reading.model).into_iter().flatten().collect()
    }

    #[test]
    fn a_body_has_the_number_of_its_label_and_the_others_what_is_left() {
        assert_eq!(of(&["bar 3", "bar 2", "bar 1"]), [3, 2, 1]);
        assert_eq!(of(&["wheel", "rod", "piston"]), [1, 2, 3]);
        assert_eq!(of(&["load 1", "axle", "roller 2", "pulley 3"]), [1, 4, 2, 3]);
        // twice the same, beyond a list, none at all
        assert_eq!(of(&["bar 2", "bar 2", "motor 1500", "2"]), [1, 2, 3, 4]);
        assert_eq!(of(&["bar 0", "disc 02", "mass 7"]), [1, 2, 7]);
    }

    #[test]
    fn every_body_has_a_number_of_its_own() {
        // labels by chance, of words with and without numbers
        let mut seed = 1_u64;
        let mut next = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 33) as usize
        };
        for _ in 0..30 {
            let labels: Vec<String> =
                (0..1 + next() % 7).map(|_| ["bar", "bar 1", "disc 2", "mass 5", "rod 3", "x"][next() % 6].into()).collect();
            let labels: Vec<&str> = labels.iter().map(String::as_str).collect();
            let found = of(&labels);
            let different: std::collections::BTreeSet<usize> = found.iter().copied().collect();
            assert_eq!((found.len(), different.len()), (labels.len(), labels.len()), "{labels:?}: {found:?}");
        }
    }

    #[test]
    fn what_follows_the_number_of_a_body_does_not_say_it_again() {
        assert_eq!(bare("стержень 3"), "стержень");
        assert_eq!(bare("motor 1500"), "motor 1500");
        assert_eq!(bare("груз"), "груз");
    }
}
