//! Mutants of a model file, most of them models still: numbers, units, names and lines are changed rather than letters.

/// A generator of numbers that gives the same ones everywhere (`SplitMix64`, Steele, Lea and Flood 2014).
pub struct Dice(u64);

impl Dice {
    /// The dice of one mutant.
    pub fn of(seed: u64, index: u64) -> Dice {
        let mut dice = Dice(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ index.wrapping_mul(0xd1b5_4a32_d192_ed03));
        dice.next();
        dice
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number below `end`.
    pub fn below(&mut self, end: usize) -> usize {
        (self.next() % end.max(1) as u64) as usize
    }

    /// One of a list.
    pub fn pick<T: Clone>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())].clone()
    }
}

/// What a number becomes.
const NUMBERS: &[&str] = &[
    "0",
    "-1",
    "1e308",
    "-1e308",
    "1e-308",
    "1e-300",
    "1e300",
    "1e150",
    "1e15",
    "1e-15",
    "1e9",
    "1e-9",
    "nan",
    "inf",
    "1e999",
    "-0",
    "0.5",
    "2",
    "1000000",
    "3.141592653589793",
    "1/3",
    "0x1",
    "١",
];

/// What a word or a formula becomes.
const WORDS: &[&str] = &[
    "",
    "t",
    "x",
    "phi",
    "phi'",
    "phi''",
    "1",
    "0",
    "sqrt(-1)",
    "1/0",
    "0/0",
    "log(0)",
    "exp(1000)",
    "t^1000",
    "1/t",
    "tan(pi/2)",
    "if(t < 1 [s], 1, 0)",
    "sign(t)",
    "1 [m]",
    "1 [N m]",
    "(",
    "\\u0000",
    "\\u001b[31m",
    "🙂",
    "φ",
    "с",
    "ground",
    "force(",
    "max(x, x')",
    "atan2(0, 0)",
    "x^0.5",
    "abs(x)^-1",
];

/// Lines that are added.
const LINES: &[&str] = &[
    "[[study]]",
    "kind = \"simulate\"",
    "kind = \"modes\"",
    "kind = \"periodic\"",
    "kind = \"equilibrium\"",
    "until = \"1 s\"",
    "every = \"0 s\"",
    "tolerance = 1e-300",
    "mass = \"0 kg\"",
    "gravity = false",
    "[springs.s]",
    "along = \"x\"",
    "stiffness = \"1e300 N/m\"",
    "inertia = \"0 kg m^2\"",
    "plane = \"space\"",
    "[unknowns]",
    "outputs = []",
    "settle = \"1e9 s\"",
    "points = 0",
    "count = 1000000000",
    "start = \"1e300\"",
    "\"",
    "]",
];

/// One to four changes.
pub fn mutate(text: &str, dice: &mut Dice) -> String {
    let mut text = text.to_owned();
    for _ in 0..=dice.below(4) {
        text = match dice.below(12) {
            0..=4 => number(&text, dice),
            5 | 6 => word(&text, dice),
            7 => without_line(&text, dice),
            8 => twice_a_line(&text, dice),
            9 => with_line(&text, dice),
            10 => swapped(&text, dice),
            _ => letters(&text, dice),
        };
    }
    text
}

/// Ranges of the pieces that `belongs` holds for.
fn pieces(text: &str, belongs: impl Fn(char) -> bool, starts: impl Fn(char) -> bool) -> Vec<std::ops::Range<usize>> {
    let mut found = Vec::new();
    let mut start: Option<usize> = None;
    let mut before = ' ';
    for (i, c) in text.char_indices().chain([(text.len(), ' ')]) {
        match start {
            Some(s) if !belongs(c) || i == text.len() => {
                found.push(s..i);
                start = None;
            }
            None if starts(c) && !before.is_alphanumeric() => start = Some(i),
            _ => {}
        }
        before = c;
    }
    found
}

fn replace(text: &str, range: std::ops::Range<usize>, with: &str) -> String {
    format!("{}{with}{}", &text[..range.start], &text[range.end..])
}

fn number(text: &str, dice: &mut Dice) -> String {
    let numbers = pieces(text, |c| c.is_ascii_digit() || c == '.', |c| c.is_ascii_digit());
    if numbers.is_empty() { text.to_owned() } else { replace(text, dice.pick(&numbers), dice.pick(NUMBERS)) }
}

fn word(text: &str, dice: &mut Dice) -> String {
    let words = pieces(text, |c| c.is_alphanumeric() || matches!(c, '_' | '\''), char::is_alphabetic);
    if words.is_empty() { text.to_owned() } else { replace(text, dice.pick(&words), dice.pick(WORDS)) }
}

fn without_line(text: &str, dice: &mut Dice) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    if !lines.is_empty() {
        lines.remove(dice.below(lines.len()));
    }
    lines.join("\n")
}

fn twice_a_line(text: &str, dice: &mut Dice) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    if !lines.is_empty() {
        let line = lines[dice.below(lines.len())];
        lines.insert(dice.below(lines.len()), line);
    }
    lines.join("\n")
}

fn with_line(text: &str, dice: &mut Dice) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    lines.insert(dice.below(lines.len() + 1), dice.pick(LINES));
    lines.join("\n")
}

/// Two words change places.
fn swapped(text: &str, dice: &mut Dice) -> String {
    let words = pieces(text, |c| c.is_alphanumeric() || matches!(c, '_' | '\'' | '.'), char::is_alphanumeric);
    if words.len() < 2 {
        return text.to_owned();
    }
    let (a, b) = (dice.pick(&words), dice.pick(&words));
    let (first, second) = if a.start <= b.start { (a, b) } else { (b, a) };
    if first.end > second.start {
        return text.to_owned();
    }
    let (one, other) = (text[first.clone()].to_owned(), text[second.clone()].to_owned());
    replace(&replace(text, second, &one), first, &other)
}

/// A stretch of letters is cut out.
fn letters(text: &str, dice: &mut Dice) -> String {
    let chars: Vec<char> = text.chars().collect();
    let at = dice.below(chars.len());
    let end = (at + dice.below(12)).min(chars.len());
    chars[..at].iter().chain(&chars[end..]).collect()
}
