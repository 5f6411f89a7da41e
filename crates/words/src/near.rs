//! "Did you mean": the nearest name.

use crate::letters;

/// Longer words and more names are not searched: a file of a hundred thousand names must not cost their square.
const LONGEST: usize = 60;
const MOST: usize = 5000;

/// How far two words are apart, in halves of a slip (a letter too many, missing, wrong, or two that changed places): a wrong case is half a slip.
pub fn half_slips(word: &str, candidate: &str) -> usize {
    let exact = 2 * strsim::damerau_levenshtein(word, candidate);
    if exact == 0 {
        return 0;
    }
    exact.min(1 + 2 * strsim::damerau_levenshtein(&word.to_lowercase(), &candidate.to_lowercase()))
}

/// The candidate that is near enough to a misspelt word to be meant; the first of equals. One that only looks like it comes first.
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let length = word.chars().count();
    if length > LONGEST {
        return None;
    }
    let candidates: Vec<&str> = candidates.into_iter().take(MOST).collect();
    if let Some(twin) = letters::twin(word, candidates.iter().copied()) {
        return Some(twin);
    }
    // of a short word something must be left
    let limit = (1 + length / 4).min(length.saturating_sub(1));
    let near = candidates.into_iter().filter(|c| c.chars().count().abs_diff(length) <= limit);
    near.map(|c| (half_slips(word, c), c))
        .filter(|(distance, _)| *distance <= 2 * limit + 1)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, c)| c)
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn a_slip_is_found_and_a_stranger_is_not() {
        assert_eq!(nearest("oscilator", ["top", "oscillator"]), Some("oscillator"));
        assert_eq!(nearest("Top", ["top"]), Some("top"));
        assert_eq!(nearest("engine", ["top", "oscillator"]), None);
        assert_eq!(nearest("", ["a"]), None);
        assert_eq!(nearest("x", ["y"]), None);
        assert_eq!(nearest("M", ["m"]), Some("m"));
        assert_eq!(nearest("Mas", ["mass", "Mass"]), Some("Mass"));
    }
}
