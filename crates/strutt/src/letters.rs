//! Texts of spreadsheets: UTF-8, with or without a mark, UTF-16 with one ("Unicode text"), or Windows-1251.

/// 0x80 ... 0xBF of Windows-1251 (Microsoft code page 1251); 0xC0 ... 0xFF are the letters А ... я in order. 0x98 is free.
const UPPER: &str = "ЂЃ‚ѓ„…†‡€‰Љ‹ЊЌЋЏђ‘’“”•–—\u{98}™љ›њќћџ\u{a0}ЎўЈ¤Ґ¦§Ё©Є«¬\u{ad}®Ї°±Ііґµ¶·ё№є»јЅѕї";

/// The text of bytes: UTF-16 where its mark stands, UTF-8 where they are UTF-8, else Windows-1251.
pub fn decoded(bytes: &[u8]) -> String {
    let pairs = |rest: &[u8], word: fn([u8; 2]) -> u16| -> String {
        let words: Vec<u16> = rest.chunks_exact(2).map(|pair| word([pair[0], pair[1]])).collect();
        String::from_utf16_lossy(&words)
    };
    match bytes {
        [0xff, 0xfe, rest @ ..] => return pairs(rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => return pairs(rest, u16::from_be_bytes),
        _ => {}
    }
    let bytes = bytes.strip_prefix(&[0xef, 0xbb, 0xbf]).unwrap_or(bytes);
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|b| letter(*b)).collect(),
    }
}

fn letter(byte: u8) -> char {
    match byte {
        0..=0x7f => char::from(byte),
        0x80..=0xbf => UPPER.chars().nth(usize::from(byte - 0x80)).unwrap_or('\u{fffd}'),
        _ => char::from_u32(0x0410 + u32::from(byte - 0xc0)).unwrap_or('\u{fffd}'),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_encodings_give_the_same_text() {
        let words: Vec<u16> = "\u{feff}Ёлкина №1".encode_utf16().collect();
        for bytes in [words.iter().flat_map(|w| w.to_le_bytes()).collect::<Vec<u8>>(), words.iter().flat_map(|w| w.to_be_bytes()).collect()]
        {
            assert_eq!(decoded(&bytes), "Ёлкина №1");
        }
        assert_eq!(decoded("\u{feff}Ёлкина №1".as_bytes()), "Ёлкина №1");
        assert_eq!(decoded(b"\xa8\xeb\xea\xe8\xed\xe0 \xb91; \xdf\xff"), "Ёлкина №1; Яя");
        assert_eq!(UPPER.chars().count(), 64);
    }
}
