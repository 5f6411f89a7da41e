//! Tables that fit a page: how wide each column is, how small the type, and where a table that is too wide even so is parted.

use crate::document::{Inline, Rich};
use crate::formula;
use crate::symbol;
use crate::table::{Cell, Column, Table, split_number};
use words::Language;

/// Room of a letter within a word, in em; from above, so that a word never sticks out of its column.
const LETTER: f64 = 0.62;
/// The same on the average of a line.
const AVERAGE: f64 = 0.54;
/// Room of a digit, a raised digit and a mark.
const DIGIT: f64 = 0.52;
const RAISED: f64 = 0.44;
const MARK: f64 = 0.32;
/// Longest word that stays whole, in characters; longer ones may be broken anywhere.
pub(super) const LONGEST: usize = 24;
/// The widest formula of a cell that counts as whole, in em; wider ones are made smaller.
const WIDEST: f64 = 16.0;

/// A table as it is set.
pub(super) struct Fitted {
    /// Size of type, as a place in the list of sizes.
    pub size: usize,
    /// Parts below one another: columns of the table with their widths in em.
    pub parts: Vec<Vec<(usize, f64)>>,
}

/// What a page offers to a table.
pub(super) struct Room<'a> {
    /// Width between the margins, pt.
    pub width: f64,
    /// Sizes of type, pt, the usual one first.
    pub sizes: &'a [f64],
    /// Space that a column takes besides its text, pt.
    pub gap: f64,
}

impl Room<'_> {
    /// Em for the text of `n` columns.
    fn em(&self, size: usize, n: usize) -> f64 {
        (self.width - n as f64 * self.gap) / self.sizes[size]
    }
}

/// Least and natural width of a column, em.
#[derive(Clone, Copy)]
struct Need {
    least: f64,
    natural: f64,
}

/// Fits a table: the largest type in which no word has to be broken; a table too wide for the smallest is parted, its first column repeated.
pub(super) fn fit(table: &Table, language: Language, room: &Room) -> Fitted {
    let needs: Vec<Need> = (0..table.columns.len()).map(|i| need(table, i, language)).collect();
    let all: Vec<usize> = (0..needs.len()).collect();
    let fits = |size: usize, columns: &[usize]| columns.iter().map(|i| needs[*i].least).sum::<f64>() <= room.em(size, columns.len());
    let smallest = room.sizes.len() - 1;
    let size = (0..room.sizes.len()).find(|size| fits(*size, &all)).unwrap_or(smallest);
    let mut parts: Vec<Vec<usize>> = Vec::new();
    for i in all {
        match parts.last_mut() {
            Some(part) if part.len() < 2 || fits(size, &[&part[..], &[i]].concat()) => part.push(i),
            Some(_) => parts.push(vec![0, i]),
            None => parts.push(vec![i]),
        }
    }
    let widths = |part: Vec<usize>| {
        let of: Vec<Need> = part.iter().map(|i| needs[*i]).collect();
        part.into_iter().zip(share(&of, room.em(size, of.len()))).collect()
    };
    Fitted { size, parts: parts.into_iter().map(widths).collect() }
}

/// Widths of columns that share `room`: natural ones if they fit, otherwise the least and an equal share of what each would like.
fn share(needs: &[Need], room: f64) -> Vec<f64> {
    let least: f64 = needs.iter().map(|n| n.least).sum();
    let natural: f64 = needs.iter().map(|n| n.natural).sum();
    if least >= room {
        return needs.iter().map(|n| n.least * room / least).collect();
    }
    let part = if natural > least { ((room - least) / (natural - least)).min(1.0) } else { 0.0 };
    needs.iter().map(|n| n.least + part * (n.natural - n.least)).collect()
}

fn need(table: &Table, i: usize, language: Language) -> Need {
    let (whole, decimals) = number_room(table, i);
    let number = if whole + decimals > 0.0 { whole + decimals + 0.2 } else { 0.0 };
    let head = rich_need(&head(&table.columns[i]), language);
    let numbers = Need { least: number, natural: number };
    let cells = table.rows.iter().filter_map(|row| match row.get(i)? {
        Cell::Rich(rich) => Some(rich_need(rich, language)),
        Cell::Verdict(found) => Some(words_need(&super::text::verdict(*found, language))),
        Cell::Number(_) | Cell::Empty => None,
    });
    // a head over numbers is broken rather than the column widened
    let head = if number > 0.0 { Need { natural: head.least.max(number), ..head } } else { head };
    cells
        .chain([head, numbers])
        .fold(Need { least: 1.0, natural: 1.0 }, |a, b| Need { least: a.least.max(b.least), natural: a.natural.max(b.natural) })
}

/// Head and unit of a column.
pub(super) fn head(column: &Column) -> Rich {
    let mut head = column.head.clone();
    if !column.unit.is_empty() {
        head.0.push(Inline::Words(format!(", {}", column.unit)));
    }
    head
}

/// Room before and behind the decimal mark, em.
fn number_room(table: &Table, i: usize) -> (f64, f64) {
    let one = |c: char| match c {
        '0'..='9' => DIGIT,
        '−' => 0.8,
        '⁻' => 0.62,
        '⁰'..='⁹' | '¹' | '²' | '³' => RAISED,
        _ => MARK,
    };
    let width = |text: &str| text.chars().map(one).sum::<f64>();
    let numbers = table.rows.iter().filter_map(|row| if let Some(Cell::Number(n)) = row.get(i) { Some(split_number(n)) } else { None });
    numbers.fold((0.0, 0.0), |(w, d), (whole, rest)| (w.max(width(whole)), d.max(width(rest))))
}

/// The longest decimals of a column: those of all its numbers take this room, so that the marks stand below one another.
pub(super) fn longest_decimals(table: &Table, i: usize) -> &str {
    let decimals = table.rows.iter().filter_map(|row| if let Some(Cell::Number(n)) = row.get(i) { Some(split_number(n).1) } else { None });
    decimals.max_by_key(|text| text.chars().count()).unwrap_or_default()
}

/// Pieces touch one another: what stands between two spaces is one word.
fn rich_need(rich: &Rich, language: Language) -> Need {
    let (mut least, mut natural, mut word) = (0.0_f64, 0.0, 0.0);
    for piece in &rich.0 {
        let width = match piece {
            Inline::Words(text) => {
                natural += words_need(text).natural;
                for (k, part) in text.split([' ', '\n']).enumerate() {
                    word = if k == 0 { word } else { 0.0 } + word_room(part);
                    least = least.max(word);
                }
                continue;
            }
            Inline::Formula(formula) => formula::width(&formula.layout),
            Inline::Symbol(name) => formula::width(&symbol::layout(name, language)),
        };
        natural += width + AVERAGE;
        word += width.min(WIDEST) + AVERAGE;
        least = least.max(word);
    }
    Need { least, natural }
}

fn word_room(word: &str) -> f64 {
    LETTER * word.chars().count().min(LONGEST) as f64
}

fn words_need(text: &str) -> Need {
    let longest = text.split([' ', '\n']).map(word_room).fold(0.0, f64::max);
    Need { least: longest, natural: AVERAGE * text.chars().count() as f64 + LETTER }
}

/// Words that are longer than any line may have to be broken: the pieces between which that is allowed.
pub(super) fn breakable(text: &str) -> Vec<&str> {
    let mut pieces = Vec::new();
    let (mut from, mut n) = (0, 0);
    for (i, c) in text.char_indices() {
        n = if c.is_whitespace() { 0 } else { n + 1 };
        if n >= LONGEST {
            pieces.push(&text[from..i]);
            (from, n) = (i, 1);
        }
    }
    pieces.push(&text[from..]);
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: Room = Room { width: 480.0, sizes: &[10.0, 9.0, 8.0], gap: 8.0 };

    fn numbers(n: usize) -> Table {
        let mut table = Table::new((0..n).map(|i| Column::new(format!("q{i}"))).collect());
        table.row((0..n).map(|_| Cell::Number("−1,234567".into())).collect());
        table
    }

    #[test]
    fn a_narrow_table_keeps_its_widths_and_a_wide_one_is_parted() {
        let narrow = fit(&numbers(3), Language::Ru, &PAGE);
        assert_eq!((narrow.size, narrow.parts.len()), (0, 1));
        let wide = fit(&numbers(40), Language::Ru, &PAGE);
        assert!(wide.size == 2 && wide.parts.len() > 2);
        let mut seen: Vec<usize> = wide.parts.iter().flat_map(|part| part.iter().skip(1).map(|c| c.0)).collect();
        seen.insert(0, 0);
        assert_eq!(seen, (0..40).collect::<Vec<_>>());
        for part in &wide.parts {
            assert_eq!(part[0].0, 0, "the first column names the rows");
            let used: f64 = part.iter().map(|(_, em)| em * 8.0 + PAGE.gap).sum();
            assert!(used <= PAGE.width + 1e-9, "{used}");
        }
    }

    #[test]
    fn long_words_may_be_broken() {
        let text = "короткое ".to_owned() + &"д".repeat(60);
        let pieces = breakable(&text);
        assert_eq!(pieces.concat(), text);
        assert_eq!(pieces.len(), 3);
    }
}
