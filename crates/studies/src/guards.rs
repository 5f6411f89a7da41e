//! Names of switching functions, as the user would write them.

use program::Program;
use report::formula::{Form, Printer};
use symbolic::Equations;
use words::{Language, Text};

/// Longer formulas are cut: the name stands in a line of the list of events.
const LONGEST: usize = 48;

/// The name of each guard of a program.
pub fn names(equations: &Equations, program: &Program) -> Vec<Text> {
    let [en, ru] = [Language::En, Language::Ru].map(|language| Printer::of(equations, language).with_width(usize::MAX));
    let graph = &equations.graph;
    let name = |guard: &program::GuardOrigin| {
        if let Some(reaction) = reaction(guard.kind).and_then(|r| equations.reactions.get(r)) {
            return without_part(&reaction.label, &reaction.name);
        }
        let write = |printer: &report::formula::Printer| {
            let left = printer.inline(graph, guard.left, Form::Text);
            let text = match guard.right {
                Some(right) => format!("{left} − ({})", printer.inline(graph, right, Form::Text)),
                None => left,
            };
            if text.chars().count() <= LONGEST { text } else { text.chars().take(LONGEST - 1).chain(['…']).collect() }
        };
        Text::new(write(&en), write(&ru))
    };
    program.guards.iter().map(name).collect()
}

/// `rope T, tension` is the rope T.
fn without_part(label: &Text, name: &str) -> Text {
    let head = |words: &str| words.split(", ").next().unwrap_or_default().to_owned();
    if label.en.is_empty() { Text::same(name) } else { Text::new(head(&label.en), head(&label.ru)) }
}

/// The reaction whose law a guard switches.
fn reaction(kind: program::Construct) -> Option<usize> {
    use program::Construct::{ContactForce, Gap, Limit, Normal, Share, Side, Sliding};
    match kind {
        Sliding { reaction, .. }
        | Limit { reaction, .. }
        | Normal { reaction }
        | Gap { reaction, .. }
        | ContactForce { reaction, .. }
        | Share { reaction, .. }
        | Side { reaction, .. } => Some(reaction),
        _ => None,
    }
}
