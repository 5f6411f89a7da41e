//! Formula text to tokens.

use crate::units::{Unit, parse_unit};
use std::ops::Range;
use symbolic::Rational;
use words::Notice;

/// Longest formula, bytes.
pub(super) const MAX_LENGTH: usize = 100_000;

#[derive(Clone, PartialEq, Debug)]
pub(super) enum Token {
    Number(Rational),
    /// Name and primes.
    Name(String, u8),
    /// `[rad/s^2]`
    Unit(Box<Unit>),
    Plus,
    Minus,
    Star,
    Slash,
    Caret,
    Open,
    Close,
    Comma,
    Dot,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    End,
}

pub(super) type Spanned = (Token, Range<usize>);

/// Whether text is a name as formulas know them.
pub(crate) fn is_identifier(text: &str) -> bool {
    text.chars().next().is_some_and(starts_name) && text.chars().all(continues_name) && !is_too_long(text)
}

/// Whether a name is longer than names may be.
pub(crate) fn is_too_long(text: &str) -> bool {
    text.len() > 200
}

fn starts_name(c: char) -> bool {
    c.is_alphabetic() || c == '_'
}
fn continues_name(c: char) -> bool {
    c.is_alphabetic() || c.is_ascii_digit() || c == '_'
}

/// Splits a formula into tokens; the last one is `End`.
pub(super) fn tokens(text: &str) -> Result<Vec<Spanned>, Notice> {
    if text.len() > MAX_LENGTH {
        return Err(Notice::piece(
            "M032",
            0..text.len(),
            format!("the formula is {} bytes long; the limit is {MAX_LENGTH}", text.len()),
            format!("длина формулы {} байт; предел {MAX_LENGTH}", text.len()),
        )
        .help("split it into named parameters or outputs", "разбейте её на именованные параметры или выходные величины"));
    }
    let mut lexer = Lexer { text, at: 0 };
    let mut tokens = Vec::with_capacity(text.len() / 3 + 2);
    loop {
        let rest = &text[lexer.at..];
        lexer.at += rest.len() - rest.trim_start().len();
        let from = lexer.at;
        let token = lexer.next()?;
        let end = token == Token::End;
        tokens.push((token, from..lexer.at));
        if end {
            return Ok(tokens);
        }
        if let Some((power, length)) = crate::units::superscript(&text[lexer.at..]) {
            let span = lexer.at..lexer.at + length;
            lexer.at += length;
            tokens.push((Token::Caret, span.clone()));
            if power < 0 {
                tokens.push((Token::Minus, span.clone()));
            }
            tokens.push((Token::Number(i64::from(power).abs().into()), span));
        }
    }
}

struct Lexer<'a> {
    text: &'a str,
    at: usize,
}

impl Lexer<'_> {
    fn next(&mut self) -> Result<Token, Notice> {
        let rest = &self.text[self.at..];
        let Some(c) = rest.chars().next() else { return Ok(Token::End) };
        if starts_name(c) {
            return Ok(self.name());
        }
        if c.is_ascii_digit() || c == '.' && rest[1..].starts_with(|d: char| d.is_ascii_digit()) {
            return self.number();
        }
        if c == '[' {
            return self.unit();
        }
        const SIGNS: [(&str, Token); 20] = [
            ("<=", Token::LessEqual),
            (">=", Token::GreaterEqual),
            ("**", Token::Caret),
            ("≤", Token::LessEqual),
            ("≥", Token::GreaterEqual),
            ("<", Token::Less),
            (">", Token::Greater),
            ("+", Token::Plus),
            ("-", Token::Minus),
            ("−", Token::Minus),
            ("*", Token::Star),
            ("·", Token::Star),
            ("⋅", Token::Star),
            ("×", Token::Star),
            ("/", Token::Slash),
            ("^", Token::Caret),
            ("(", Token::Open),
            (")", Token::Close),
            (",", Token::Comma),
            (".", Token::Dot),
        ];
        for (sign, token) in SIGNS {
            if rest.starts_with(sign) {
                self.at += sign.len();
                return Ok(token);
            }
        }
        Err(stray(c, self.at))
    }

    fn name(&mut self) -> Token {
        let rest = &self.text[self.at..];
        let length = rest.find(|c| !continues_name(c)).unwrap_or(rest.len());
        let name = rest[..length].to_owned();
        let mut primes = 0u8;
        self.at += length;
        for c in rest[length..].chars() {
            let more = match c {
                '\'' | '′' | '’' => 1,
                '″' | '"' => 2,
                _ => break,
            };
            primes = primes.saturating_add(more);
            self.at += c.len_utf8();
        }
        Token::Name(name, primes)
    }

    fn number(&mut self) -> Result<Token, Notice> {
        let bytes = self.text.as_bytes();
        let from = self.at;
        let digits = |at: usize| at + bytes[at..].iter().take_while(|b| b.is_ascii_digit()).count();
        let mut end = digits(from);
        if bytes.get(end) == Some(&b'.') {
            end = digits(end + 1);
        }
        if matches!(bytes.get(end), Some(b'e' | b'E')) {
            let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
            let tail = digits((end + 1 + sign).min(bytes.len()));
            if tail > end + 1 + sign {
                end = tail;
            }
        }
        self.at = end;
        match crate::units::bounded_decimal(&self.text[from..end]) {
            Some(value) => Ok(Token::Number(value)),
            None => Err(crate::units::out_of_range(from..end)),
        }
    }

    fn unit(&mut self) -> Result<Token, Notice> {
        let from = self.at;
        let Some(length) = self.text[from..].find(']') else {
            return Err(Notice::piece("M030", from..from + 1, "`[` is never closed", "скобка `[` не закрыта")
                .help("square brackets hold a unit: `30 [rad/s^2]`", "в квадратных скобках стоит единица: `30 [рад/с^2]`"));
        };
        self.at = from + length + 1;
        let unit = parse_unit(&self.text[from + 1..from + length]).map_err(|f| f.shifted(from + 1))?;
        Ok(Token::Unit(Box::new(unit)))
    }
}

fn stray(c: char, at: usize) -> Notice {
    let shown: String = if c.is_control() { c.escape_default().collect() } else { c.to_string() };
    let fault = Notice::piece(
        "M030",
        at..at + c.len_utf8(),
        format!("`{shown}` cannot stand in a formula"),
        format!("знак `{shown}` недопустим в формуле"),
    );
    match c {
        '=' | '!' => fault.help(
            "conditions compare with < <= > >=; equality of two changing quantities never holds exactly",
            "условия сравнивают знаками < <= > >=; точное равенство меняющихся величин не наступает",
        ),
        '&' | '|' => fault.help("conditions are joined by and, or, not", "условия соединяют словами and, or, not"),
        ';' => fault.help("arguments are separated by a comma", "аргументы разделяют запятой"),
        '°' => fault.help("write the unit in brackets: 30 [deg]", "напишите единицу в скобках: 30 [град]"),
        '\u{300}'..='\u{36f}' => fault.help(
            "a derivative is written with a prime: phi'; accents over letters cannot be used",
            "производную обозначают штрихом: phi'; надстрочные знаки не используются",
        ),
        '₀'..='₉' => fault.help(
            "write an index as m1 or m_1 and the printed form as symbol = \"m_1\"",
            "пишите индекс как m1 или m_1, а печатный вид — symbol = \"m_1\"",
        ),
        '{' | '}' | ']' => fault.help("formulas use round brackets", "в формулах ставят круглые скобки"),
        _ => fault,
    }
}
