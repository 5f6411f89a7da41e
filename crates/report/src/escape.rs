//! Making user text harmless inside HTML, SVG and script data.

/// Text for HTML and SVG content and for attribute values in any quotes.
pub fn markup(text: &str) -> String {
    xml(text).replace('\'', "&#39;")
}

/// Text for XML content and for attribute values in double quotes. Control characters that XML forbids become spaces.
pub fn xml(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c if (c.is_control() && !matches!(c, '\n' | '\t')) || matches!(c, '\u{fffe}' | '\u{ffff}') => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

/// JSON for the inside of a `<script>` element: `<`, `>` and `&` become escapes, so that no tag can be opened or closed there.
pub fn script_json(json: &str) -> String {
    json.replace('<', "\\u003c")
        .replace('>', "\\u003e")
        .replace('&', "\\u0026")
        .replace('\u{2028}', "\\u2028")
        .replace('\u{2029}', "\\u2029")
}

/// A name for files: letters, digits, `-` and `_` stay, everything else becomes `-`.
pub fn file_name(name: &str) -> String {
    let kept: String = name.chars().map(|c| if c.is_alphanumeric() || matches!(c, '-' | '_') { c } else { '-' }).collect();
    let trimmed = kept.trim_matches('-');
    if trimmed.is_empty() { "figure".into() } else { trimmed.chars().take(80).collect() }
}

/// A file name as a relative address: it cannot become a scheme, a host or a script.
pub fn address(name: &str) -> String {
    let mut out = String::from("./");
    for byte in name.bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'_' | b'.' | b'/' => out.push(byte as char),
            other => out.push_str(&format!("%{other:02X}")),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tags_and_quotes_are_harmless() {
        assert_eq!(markup("<script>\"a\" & 'b'\u{1}</script>"), "&lt;script&gt;&quot;a&quot; &amp; &#39;b&#39; &lt;/script&gt;");
        assert!(!script_json("\"</script><!--\"").contains('<'));
    }

    #[test]
    fn file_names_are_plain() {
        assert_eq!(file_name("phi', x/../y"), "phi---x----y");
        assert_eq!(file_name("///"), "figure");
    }
}
