//! Letters of reactions on paper. One that an output of the file shows has its symbol; the force of a rope called S2 is S₂ and not S with the index S2; an index
//! that is a whole word gives way to a number.

use crate::model::Model;
use symbolic::connections::Reaction;
use symbolic::equations::Output;
use symbolic::{Graph, Node};

/// Names of reactions in formulas with what is printed for them, where that is another one.
pub(in crate::derive) fn letters(model: &Model, graph: &Graph, (reactions, outputs): (&[Reaction], &[Output])) -> Vec<(String, String)> {
    let shown = |name: &str| model.notation.iter().find(|(n, _)| n == name).map_or(name, |(_, s)| s.as_str()).to_owned();
    let names = model.parameters.iter().map(|p| p.name.as_str()).chain(model.coordinates.iter().map(|c| c.name.as_str()));
    let mut taken: Vec<String> = names.chain(outputs.iter().map(|o| o.name.as_str())).map(|name| plain(&shown(name))).collect();
    let symbols: Vec<String> = reactions.iter().map(|r| graph.symbol_info(r.symbol).name.clone()).collect();
    taken.extend(symbols.iter().map(|s| plain(s)));
    let mut found = Vec::new();
    for (reaction, symbol) in reactions.iter().zip(&symbols) {
        let same = |o: &&Output| matches!(graph.node(o.formula), Node::Symbol(s) if *s == reaction.symbol);
        if let Some(output) = outputs.iter().find(same) {
            found.push((symbol.clone(), shown(&output.name)));
            continue;
        }
        let Some((letter, index)) = symbol.split_once('_') else { continue };
        let numbered = || (1..=reactions.len()).map(|k| format!("{letter}_{k}"));
        let wanted: Vec<String> = match own(letter, index) {
            Some(own) => vec![own],
            None if is_word(index) => std::iter::once(letter.to_owned()).chain(numbered()).collect(),
            None => continue,
        };
        if let Some(free) = wanted.into_iter().find(|w| !taken.contains(&plain(w))) {
            taken.push(plain(&free));
            found.push((symbol.clone(), free));
        }
    }
    found
}

/// S1 and S_1 are one letter on paper.
fn plain(symbol: &str) -> String {
    symbol.replace('_', "")
}

/// `S_2` of the rope S2 or S_2, also where the letter of its force is F; none where the name is no letter of a force with an index.
fn own(letter: &str, name: &str) -> Option<String> {
    let first = name.chars().next().filter(|c| letter.starts_with(*c) || letter == "F" && *c == 'S')?;
    let rest = &name[first.len_utf8()..];
    let index = rest.strip_prefix('_').unwrap_or(rest);
    let fits = |c: char| c.is_ascii_digit() || rest.starts_with('_') && c.is_alphanumeric();
    match index {
        "" => Some(first.to_string()),
        _ if index.chars().all(fits) => Some(format!("{first}_{index}")),
        _ => None,
    }
}

/// Three small Latin letters or more.
fn is_word(index: &str) -> bool {
    index.len() > 2 && index.chars().all(|c| c.is_ascii_lowercase() || c == '_')
}

#[cfg(test)]
mod tests {
    use super::{is_word, own};

    #[test]
    fn forces_with_a_name_of_their_own_keep_it() {
        for (letter, name, wanted) in [
            ("S", "S2", Some("S_2")),
            ("S", "S", Some("S")),
            ("F", "S1", Some("S_1")),
            ("S", "S_CH", Some("S_CH")),
            ("N", "N", Some("N")),
            ("S", "AB", None),
            ("S", "Stay", None),
            ("F", "K", None),
        ] {
            assert_eq!(own(letter, name).as_deref(), wanted, "{name}");
        }
        assert!(is_word("floor") && !is_word("AB") && !is_word("K") && !is_word("b1"));
    }
}
