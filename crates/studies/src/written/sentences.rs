//! What studies tell, as sentences of a calculation: names of the file give way to their symbols, a paragraph begins with a capital and ends with a full stop.

use super::work::Work;
use crate::results::{Extent, Results, View};
use report::document::{Inline, Rich};
use report::{Block, Cell, Table};
use words::Language;

/// Names of the file with what is printed for them.
pub(super) struct Symbols {
    list: Vec<(String, String)>,
    /// Connections with their labels.
    labels: Vec<(String, String)>,
    /// Events with theirs.
    events: Vec<(String, String)>,
    language: Language,
}

impl Symbols {
    /// Names that a reader would take for a foreign word; a name that is its own symbol stays.
    pub fn of(work: &Work) -> Symbols {
        let equations = work.equations;
        let shown = |name: &str| equations.notation.iter().find(|(n, _)| n == name).map_or_else(|| name.to_owned(), |(_, s)| s.clone());
        let coordinates = equations.coordinates.iter().map(|c| equations.graph.symbol_info(c.symbols[0]).name.clone());
        let outputs = work.model.outputs.iter().map(|o| o.name.clone());
        let parameters = equations.parameters.iter().map(|p| equations.graph.symbol_info(p.symbol).name.clone());
        let names = coordinates.chain(outputs).chain(parameters);
        let labelled = work.model.connections.iter().filter(|c| !work.text(&c.label).is_empty());
        let labels = labelled.map(|c| (c.name.clone(), work.text(&c.label).to_owned()));
        let labels = labels.collect();
        let events = work.model.events.iter().filter(|e| !work.text(&e.label).is_empty());
        let events = events.map(|e| (e.name.clone(), work.text(&e.label).to_owned())).collect();
        Symbols { list: names.map(|name| (shown(&name), name)).map(|(s, n)| (n, s)).collect(), labels, events, language: work.language }
    }

    /// The printed symbol of a token, with its primes.
    fn symbol(&self, token: &str) -> Option<String> {
        let bare = token.trim_end_matches('\'');
        let primes = &token[bare.len()..];
        // a letter with an index is a symbol already: q_в, ω_d, t_*
        if bare.split_once('_').is_some_and(|(letter, index)| letter.chars().count() == 1 && !index.is_empty()) {
            let shown = self.list.iter().find(|(name, _)| name == bare).map_or(bare, |(_, shown)| shown);
            return Some(format!("{shown}{primes}"));
        }
        let (_, shown) = self.list.iter().find(|(name, _)| name == bare)?;
        // an English word may be a name: "force", "a"
        let plain = bare.chars().all(|c| c.is_ascii_lowercase()) && shown == bare;
        (!primes.is_empty() || !plain || self.language == Language::Ru && bare.is_ascii()).then(|| format!("{shown}{primes}"))
    }

    /// Words with symbols among them.
    pub fn split(&self, text: &str) -> Vec<Inline> {
        let text = without_commands(text);
        let (mut pieces, mut plain, mut rest) = (Vec::new(), String::new(), text.as_str());
        while !rest.is_empty() {
            let end = rest.find(|c: char| !is_of_name(c)).unwrap_or(rest.len());
            let end = if rest[..end].ends_with('_') && rest[end..].starts_with('*') { end + 1 } else { end };
            let (token, behind) = rest.split_at(end);
            // a call, a path, something quoted as the file has it
            let quoted =
                behind.starts_with(['(', '.', '`', '=']) && !behind.starts_with(". ") && behind != "." || plain.ends_with(['`', '.']);
            match self.symbol(token).filter(|_| !quoted) {
                Some(shown) => {
                    if !plain.is_empty() {
                        pieces.push(Inline::Words(std::mem::take(&mut plain)));
                    }
                    pieces.push(Inline::Symbol(shown));
                }
                None => plain.push_str(token),
            }
            let next = behind.find(is_of_name).unwrap_or(behind.len());
            plain.push_str(&behind[..next]);
            rest = &behind[next..];
        }
        if !plain.is_empty() {
            pieces.push(Inline::Words(plain));
        }
        pieces
    }

    fn rich(&self, rich: Rich) -> Rich {
        let pieces = rich.0.into_iter().flat_map(|piece| match piece {
            Inline::Words(text) => self.split(&text),
            other => vec![other],
        });
        Rich(pieces.collect())
    }

    /// The label of a connection whose name stands there alone.
    fn called(&self, rich: &Rich) -> Option<Rich> {
        let [Inline::Words(only)] = &rich.0[..] else { return None };
        self.labels.iter().chain(&self.events).find(|(name, _)| name == only).map(|(_, label)| Rich::from(label.clone()))
    }

    /// Blocks of a study as a calculation has them.
    pub fn finished(&self, blocks: Vec<Block>) -> Vec<Block> {
        blocks.into_iter().filter(|block| !is_advice(block, self.language)).map(|block| self.block(block)).collect()
    }

    /// A table with symbols among the words of its cells.
    pub fn table(&self, mut table: Table) -> Table {
        for cell in table.rows.iter_mut().flatten() {
            if let Cell::Rich(rich) = cell {
                *rich = self.called(rich).unwrap_or_else(|| self.rich(std::mem::take(rich)));
            }
        }
        table
    }

    fn block(&self, block: Block) -> Block {
        match block {
            Block::Paragraph(rich) => Block::Paragraph(sentence(self.rich(rich), self.language)),
            Block::Table(table) => Block::Table(self.table(table)),
            Block::Figure(mut figure) => {
                for happening in &mut figure.strip {
                    // an event with a label needs no words about its formula
                    let own = happening.what.split_once(": ").and_then(|(name, _)| self.events.iter().find(|(n, _)| n == name));
                    happening.what = own.map_or_else(|| Rich(self.split(&happening.what)).plain(self.language), |(_, label)| label.clone());
                }
                Block::Figure(figure)
            }
            Block::Details { summary, blocks } => Block::Details { summary, blocks: self.finished(blocks) },
            other => other,
        }
    }
}

/// Whether a paragraph tells the user of the program what to do.
fn is_advice(block: &Block, language: Language) -> bool {
    const SAID: [&str; 6] = ["ключом", "with the key", "JSON", "`outputs`", "key outputs", "strutt "];
    match block {
        Block::Paragraph(rich) => SAID.iter().any(|said| rich.plain(language).contains(said)),
        _ => false,
    }
}

/// Words without what is said of the command line, which nobody has before them who reads the calculation.
fn without_commands(text: &str) -> String {
    // what the user of the program is to raise
    if let Some(at) = ["; take more `", "; увеличьте `"].iter().find_map(|told| text.find(told)) {
        return text[..at].to_owned();
    }
    let Some(at) = text.find("--set") else { return text.to_owned() };
    match (text[..at].rfind(" ("), text[at..].find(')')) {
        (Some(open), Some(close)) => format!("{}{}", &text[..open], &text[at + close + 1..]),
        _ => text.to_owned(),
    }
}

/// A letter, a digit, a prime of a name.
fn is_of_name(c: char) -> bool {
    c.is_alphanumeric() || matches!(c, '_' | '\'')
}

/// A capital at the start, a full stop at the end; a lead-in of formulas stays as it is.
fn sentence(mut rich: Rich, language: Language) -> Rich {
    let text = rich.plain(language);
    let text = text.trim();
    if text.is_empty() || text.chars().count() < 6 {
        return rich;
    }
    if let Some(Inline::Words(first)) = rich.0.first_mut() {
        let mut chars = first.chars();
        let (a, b) = (chars.next(), chars.next());
        // a Latin letter alone is a symbol
        let letter = |c: char| c.is_lowercase() && c.is_alphabetic() && !is_greek(c);
        let word = a.is_some_and(letter) && b.is_none_or(|b| letter(b) || b == ' ' && a.is_some_and(|a| !a.is_ascii()));
        if word {
            *first = words::capital(first);
        }
    }
    if !text.ends_with(['.', ':', ';', '!', '?', '…', ',']) {
        rich.0.push(Inline::Words(".".into()));
    }
    rich
}

fn is_greek(c: char) -> bool {
    ('α'..='ω').contains(&c)
}

/// What a study tells below its heading, in sentences.
pub(super) fn below(work: &Work, results: &Results) -> Vec<Block> {
    let view = View { equations: work.equations, extent: Extent::Page, language: work.language };
    Symbols::of(work).finished(results.below(&view))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn symbols(language: Language) -> Symbols {
        let list = [("phi2", "φ_2"), ("force", "force"), ("y", "y")].map(|(a, b)| (a.to_owned(), b.to_owned()));
        let labelled = |name: &str, label: &str| vec![(name.to_owned(), label.to_owned())];
        Symbols { list: list.into(), labels: labelled("floor", "пол"), events: labelled("back", "возвращение"), language }
    }

    fn told(text: &str, language: Language) -> String {
        match symbols(language).block(Block::paragraph(text)) {
            Block::Paragraph(rich) => rich.plain(language),
            _ => String::new(),
        }
    }

    #[test]
    fn a_note_becomes_a_sentence_with_symbols() {
        assert_eq!(told("найдено: phi2 = 1,7 рад, y' = 2", Language::Ru), "Найдено: φ₂ = 1,7 рад, y' = 2.");
        assert_eq!(told("speeds are zero", Language::En), "Speeds are zero.");
        assert_eq!(told("ω = |λ| – частота", Language::Ru), "ω = |λ| – частота.");
        assert_eq!(told("Общее решение:", Language::Ru), "Общее решение:");
        assert_eq!(told("n = k: граница", Language::Ru), "n = k: граница.");
        assert_eq!(told("в начале покой", Language::Ru), "В начале покой.");
    }

    #[test]
    fn letters_with_an_index_are_symbols_and_commands_are_left_out() {
        assert_eq!(told("здесь q_в и ω_d малы", Language::Ru), "Здесь q_в и ω_d малы.");
        let split = symbols(Language::Ru).split("до t_* и q_в");
        assert_eq!(split.iter().filter(|piece| matches!(piece, Inline::Symbol(_))).count(), 2);
        assert_eq!(told("Сохраняют фазу (другое толкование: --set phases=restarts).", Language::Ru), "Сохраняют фазу.");
    }

    #[test]
    fn words_and_quoted_names_stay() {
        assert_eq!(told("the force of force(AB) grows.", Language::En), "The force of force(AB) grows.");
        assert_eq!(told("see `phi2` there", Language::En), "See `phi2` there.");
    }
}
