//! How wide a text is about.

/// Upper estimate of the width of a text in DejaVu Sans, the widest of the usual sans-serif fonts.
pub fn text_width(text: &str, size: f64) -> f64 {
    let em = |c: char| match c {
        'i' | 'l' | 'j' | '.' | ',' | '\'' | '′' | ' ' | '\u{a0}' | 'I' | ':' | '|' => 0.34,
        '\u{202f}' => 0.2,
        '0'..='9' => 0.64,
        '⁰'..='⁹' | '₀'..='₉' | '¹' | '²' | '³' | '⁻' => 0.44,
        'm' | 'w' | 'M' | 'W' | 'ж' | 'ш' | 'щ' | 'ю' | 'ы' | 'Ж' | 'Ш' | 'Щ' | 'Ю' | 'Ы' | '−' => 0.92,
        c if c.is_uppercase() => 0.78,
        _ => 0.66,
    };
    text.chars().map(em).sum::<f64>() * size
}
