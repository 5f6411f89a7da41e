//! Letters of names: spelled Greek ones, and letters of different alphabets that look alike.

/// Spelled Greek letters with their character.
const GREEK: [(&str, char); 53] = [
    ("alpha", 'α'),
    ("beta", 'β'),
    ("gamma", 'γ'),
    ("delta", 'δ'),
    ("epsilon", 'ε'),
    ("varepsilon", 'ε'),
    ("eps", 'ε'),
    ("zeta", 'ζ'),
    ("eta", 'η'),
    ("theta", 'θ'),
    ("vartheta", 'ϑ'),
    ("iota", 'ι'),
    ("kappa", 'κ'),
    ("lambda", 'λ'),
    ("mu", 'μ'),
    ("nu", 'ν'),
    ("xi", 'ξ'),
    ("omicron", 'ο'),
    ("pi", 'π'),
    ("rho", 'ρ'),
    ("varrho", 'ρ'),
    ("sigma", 'σ'),
    ("tau", 'τ'),
    ("upsilon", 'υ'),
    ("phi", 'φ'),
    ("varphi", 'φ'),
    ("chi", 'χ'),
    ("psi", 'ψ'),
    ("omega", 'ω'),
    ("Alpha", 'Α'),
    ("Beta", 'Β'),
    ("Gamma", 'Γ'),
    ("Delta", 'Δ'),
    ("Epsilon", 'Ε'),
    ("Zeta", 'Ζ'),
    ("Eta", 'Η'),
    ("Theta", 'Θ'),
    ("Iota", 'Ι'),
    ("Kappa", 'Κ'),
    ("Lambda", 'Λ'),
    ("Mu", 'Μ'),
    ("Nu", 'Ν'),
    ("Xi", 'Ξ'),
    ("Omicron", 'Ο'),
    ("Pi", 'Π'),
    ("Rho", 'Ρ'),
    ("Sigma", 'Σ'),
    ("Tau", 'Τ'),
    ("Upsilon", 'Υ'),
    ("Phi", 'Φ'),
    ("Chi", 'Χ'),
    ("Psi", 'Ψ'),
    ("Omega", 'Ω'),
];

/// The letter of a spelled Greek name.
pub fn greek(word: &str) -> Option<char> {
    GREEK.iter().find(|(name, _)| *name == word).map(|(_, letter)| *letter)
}

/// Letters that print alike: each stands above the Latin (or usual Greek) one.
const SAME: [(&str, &str); 4] = [
    ("асеорхуіѕјһԛԝ", "aceopxyisjhqw"),
    ("АВСЕНКМОРТХІЅЈԚԜ", "ABCEHKMOPTXISJQW"),
    ("οΑΒΕΖΗΙΚΜΝΟΡΤΥΧ", "oABEZHIKMNOPTYX"),
    ("\u{b5}\u{3d5}\u{3d1}\u{3f5}\u{3f0}\u{3f1}\u{2126}\u{212a}", "μφθεκρΩK"),
];
/// Letters that are told apart in print but mistaken at the keyboard.
const NEAR: [(&str, &str); 2] = [("кмтпУ", "kmtnY"), ("ανυκιωχγ", "avukiwxy")];

fn folded(c: char, tables: &[(&str, &str)]) -> char {
    let find = |(from, to): &(&str, &str)| from.chars().position(|f| f == c).and_then(|i| to.chars().nth(i));
    tables.iter().find_map(find).unwrap_or(c)
}

/// A name in which letters that print alike are one letter: two names with the same skeleton cannot be told apart by eye.
pub fn skeleton(name: &str) -> String {
    name.chars().map(|c| folded(c, &SAME)).collect()
}

/// A coarser skeleton: spelled Greek letters are letters, `m_1` is `m1`, and letters that resemble each other are one.
fn rough(name: &str) -> String {
    let mut out = String::new();
    for part in name.split('_') {
        let letters = part.trim_end_matches(|c: char| c.is_ascii_digit());
        match greek(letters) {
            Some(letter) => out.push(letter),
            None => out.push_str(letters),
        }
        out.push_str(&part[letters.len()..]);
    }
    out.chars().map(|c| folded(folded(c, &SAME), &NEAR)).collect()
}

/// The candidate that differs from a word only in the alphabet of a letter (с and c), its spelling (φ and phi) or its index (m1 and m_1).
pub fn twin<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let (own, exact) = (rough(word), skeleton(word));
    let mut found = None;
    // what prints alike comes before what only resembles
    for candidate in candidates.into_iter().filter(|c| *c != word) {
        if skeleton(candidate) == exact {
            return Some(candidate);
        }
        if found.is_none() && rough(candidate) == own {
            found = Some(candidate);
        }
    }
    found
}

/// The first letters in which two look-alike names differ.
pub fn difference(a: &str, b: &str) -> Option<(char, char)> {
    let same_length = a.chars().count() == b.chars().count();
    a.chars().zip(b.chars()).find(|(a, b)| a != b).filter(|_| same_length)
}

/// The alphabet of a letter, in English and Russian.
pub fn alphabet(c: char) -> (&'static str, &'static str) {
    match c {
        'a'..='z' | 'A'..='Z' => ("Latin", "латинская"),
        '\u{400}'..='\u{52f}' => ("Cyrillic", "русская"),
        '\u{b5}' => ("micro sign", "знак «микро»"),
        '\u{2126}' => ("ohm sign", "знак «ом»"),
        '\u{212a}' => ("kelvin sign", "знак «кельвин»"),
        '\u{3d0}'..='\u{3d6}' | '\u{3f0}'..='\u{3f5}' => ("Greek symbol", "греческий символ"),
        '\u{370}'..='\u{3ff}' => ("Greek", "греческая"),
        _ => ("other", "другая"),
    }
}

#[cfg(test)]
mod tests {
    use super::{skeleton, twin};

    #[test]
    fn letters_that_print_alike_are_one() {
        assert_eq!(skeleton("с"), skeleton("c"));
        assert_eq!(skeleton("\u{b5}"), skeleton("μ"));
        assert_ne!(skeleton("v"), skeleton("ν"));
        assert_ne!(skeleton("a"), skeleton("α"));
    }

    #[test]
    fn a_twin_is_found_and_a_stranger_is_not() {
        for (word, names, wanted) in [
            ("с", vec!["m", "c"], Some("c")),
            ("φ", vec!["x", "phi"], Some("phi")),
            ("phi1", vec!["φ1"], Some("φ1")),
            ("m_1", vec!["m", "m1"], Some("m1")),
            ("\u{b5}", vec!["m", "mu"], Some("mu")),
            ("к", vec!["k"], Some("k")),
            ("q", vec!["p", "x"], None),
        ] {
            assert_eq!(twin(word, names), wanted, "{word}");
        }
    }
}
