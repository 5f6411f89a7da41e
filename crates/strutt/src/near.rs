//! "Did you mean": the nearest name.

/// The candidate that is near enough to be meant; the first of equals.
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let candidates: Vec<&str> = candidates.into_iter().take(10_000).collect();
    if let Some(twin) = symbolic::letters::twin(word, candidates.iter().copied()) {
        return Some(twin);
    }
    let length = word.chars().count();
    let limit = (1 + length / 4).min(length.saturating_sub(1));
    let lower = word.to_lowercase();
    let near = candidates.into_iter().filter(|c| c.chars().count().abs_diff(length) <= limit && length <= 200);
    near.map(|c| (strsim::damerau_levenshtein(&lower, &c.to_lowercase()), c))
        .filter(|(distance, _)| *distance <= limit)
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
    }
}
