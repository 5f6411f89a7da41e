//! Which names of a file are words of a language, and which are letters of a drawing.

/// Whether a name is an English word rather than a letter with or without an index: `shaft`, but not `A`, `O_1` or `AB`. A Russian text has no use for it.
pub fn is_word(name: &str) -> bool {
    name.chars().count() > 2 && name.chars().all(|c| c.is_ascii_lowercase() || c == '_')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_with_an_index_are_no_words() {
        assert!(["shaft", "left", "motor_b"].iter().all(|name| is_word(name)));
        assert!(!["A", "O_1", "AB", "BC", "s", "c1", "вал"].iter().any(|name| is_word(name)));
    }
}
