//! `strutt equations FILE`: the equations of motion as formulas.

use super::{Exit, open};
use crate::args::{self, Form};
use crate::console::{Console, quoted};
use report::Word as Title;
use report::formula::{self, Layout, Placement, Printer};
use serde_json::{Value, json};
use studies::Failure;
use studies::document;
use studies::frictions;
use studies::pipeline::{Calculation, Machine};
use studies::wording::{Word, say};
use symbolic::Equations;
use words::Language;

pub fn run(args: &args::Equations, console: &mut Console) -> Result<Exit, Failure> {
    let (_, machine) = open(&args.model, mechanics::derive::Detail::Steps, console)?;
    if let Some(tree) = console.tree() {
        console.out((tree.value)(&to_json(&machine, console.language)))?;
        return Ok(Exit::Done);
    }
    if console.page.is_some() {
        super::page(&Calculation { machine, results: Vec::new(), files: Vec::new() }, console)?;
        return Ok(Exit::Done);
    }
    let writer = Writer::new(&machine.equations, args.form, console);
    let mut text = writer.head(console.language.text(&machine.model.title));
    if args.steps {
        text.push_str(&writer.steps());
    } else {
        text.push_str(&writer.energies());
    }
    text.push_str(&writer.equations());
    text.push_str(&writer.connections());
    text.push_str(&writer.definitions());
    console.out(text)?;
    if !args.steps && !machine.equations.steps.is_empty() {
        console.next(&format!("strutt equations {} --steps", quoted(&args.model.file)));
    }
    Ok(Exit::Done)
}

struct Writer<'a> {
    equations: &'a Equations,
    printer: Printer,
    form: Form,
    language: Language,
}

impl<'a> Writer<'a> {
    fn new(equations: &'a Equations, form: Form, console: &Console) -> Writer<'a> {
        // LaTeX and MathML break lines where the text form of this width would
        let width = if form == Form::Text { console.width().saturating_sub(8) } else { 90 };
        Writer {
            equations,
            printer: report::formula::Printer::of(equations, console.language).with_width(width),
            form,
            language: console.language,
        }
    }

    fn form(&self) -> formula::Form {
        match self.form {
            Form::Text => formula::Form::Text,
            Form::Latex => formula::Form::Latex,
            Form::Mathml => formula::Form::MathMl,
        }
    }

    /// A comment, a title or a paragraph, as the form has it.
    fn words(&self, words: &str) -> String {
        match self.form {
            Form::Text => format!("{words}\n"),
            Form::Latex => format!("% {words}\n"),
            Form::Mathml => format!("<!-- {} -->\n", words.replace("--", "–")),
        }
    }

    fn head(&self, title: &str) -> String {
        match self.form {
            Form::Text => format!("{title}\n{}\n\n", "=".repeat(title.chars().count())),
            _ => self.words(title),
        }
    }

    fn written(&self, layout: &Layout) -> String {
        self.printer.write(layout, self.form(), Placement::Block)
    }

    /// A formula on lines of its own, with its number behind it in text.
    fn formula(&self, formula: &str, number: Option<usize>) -> String {
        match self.form {
            Form::Text => {
                let body = formula.replace('\n', "\n  ");
                let number = number.map_or_else(String::new, |n| format!("   ({n})"));
                format!("  {body}{number}\n")
            }
            Form::Latex if number.is_some() => format!("\\begin{{equation}}\n{formula}\n\\end{{equation}}\n"),
            Form::Latex => format!("\\[\n{formula}\n\\]\n"),
            Form::Mathml => format!("{formula}\n"),
        }
    }

    fn energies(&self) -> String {
        let graph = &self.equations.graph;
        let mut out = String::new();
        if self.equations.textbook.is_err() {
            return out;
        }
        for (word, letter, e) in document::energies(self.equations) {
            if graph.is_zero(e) {
                continue;
            }
            let left = symbolic::equations::StepName::Quantity { letter: letter.into(), index: String::new() };
            let step = symbolic::equations::StepFormula { left, right: e };
            out.push_str(&self.words(say(self.language, word)));
            out.push_str(&self.formula(&self.written(&self.printer.step(graph, &step)), None));
        }
        out.push('\n');
        out
    }

    fn steps(&self) -> String {
        let mut out = String::new();
        for step in &self.equations.steps {
            out.push_str(&self.words(self.language.text(&step.title)));
            let words = self.language.text(&step.words);
            if !words.is_empty() {
                out.push_str(&self.words(words));
            }
            for formula in &step.formulas {
                out.push_str(&self.formula(&self.written(&self.printer.step(&self.equations.graph, formula)), None));
            }
            out.push('\n');
        }
        out
    }

    fn equations(&self) -> String {
        let mut out = self.words(self.language.word(Title::Equations));
        match &self.equations.textbook {
            Err(reason) => out.push_str(&self.words(self.language.text(reason))),
            Ok(equalities) => {
                for (i, equality) in equalities.iter().enumerate() {
                    let formula = self.printer.equality(&self.equations.graph, *equality, Some(i), self.form());
                    out.push_str(&self.formula(&formula, Some(i + 1)));
                }
            }
        }
        out
    }

    /// Conditions and what the letters of reactions mean.
    fn connections(&self) -> String {
        let conditions = document::conditions(self.equations, &self.printer);
        let mut out = String::new();
        if !conditions.is_empty() {
            out.push('\n');
            out.push_str(&self.words(say(self.language, Word::Connections)));
            for (line, when) in conditions.iter().zip(document::holding(self.equations, self.language)) {
                let when = when.map(|words| self.words(&format!("{words}:"))).unwrap_or_default();
                out.push_str(&when);
                out.push_str(&self.formula(&self.written(line), None));
            }
        }
        let laws = frictions::laws(self.equations, &self.printer);
        if !laws.is_empty() {
            out.push('\n');
            out.push_str(&self.words(say(self.language, Word::FrictionLaws)));
            out.extend(laws.iter().map(|line| self.formula(&self.written(line), None)));
        }
        if self.equations.reactions.iter().any(|r| r.law.is_reaction()) {
            out.push('\n');
            out.push_str(&self.words(say(self.language, Word::Reactions)));
        }
        for reaction in self.equations.reactions.iter().filter(|r| r.law.is_reaction()) {
            let symbol = self.printer.symbol(&self.equations.graph, reaction.symbol, self.form());
            let line = format!("  {symbol} = {}: {}", reaction.name, self.language.text(&reaction.label));
            out.push_str(&self.words(&line));
        }
        out
    }

    fn definitions(&self) -> String {
        let lines = document::definitions(self.equations, &self.printer);
        if lines.is_empty() {
            return String::new();
        }
        let formulas: String = lines.iter().map(|line| self.formula(&self.written(line), None)).collect();
        self.words(say(self.language, Word::WhereText)) + &formulas
    }
}

/// Every formula in the three forms, with the fields that all studies share.
pub fn to_json(machine: &Machine, language: Language) -> Value {
    let equations = &machine.equations;
    let printer = Printer::of(equations, language);
    let graph = &equations.graph;
    let three = |write: &dyn Fn(formula::Form) -> String| json!({"text": write(formula::Form::Text), "latex": write(formula::Form::Latex), "mathml": write(formula::Form::MathMl)});
    let written: Vec<Value> = match &equations.textbook {
        Ok(list) => list.iter().enumerate().map(|(i, e)| three(&|form| printer.equality(graph, *e, Some(i), form))).collect(),
        Err(_) => Vec::new(),
    };
    let reason = equations.textbook.as_ref().err().map(|r| language.text(r));
    let all = |layouts: Vec<Layout>| -> Vec<Value> {
        layouts.iter().map(|layout| three(&|form| printer.write(layout, form, Placement::Block))).collect()
    };
    let definitions = all(document::definitions(equations, &printer));
    let conditions = all(document::conditions(equations, &printer));
    let laws = all(frictions::laws(equations, &printer));
    let reactions: Vec<Value> = equations
        .reactions
        .iter()
        .filter(|r| r.law.is_reaction())
        .map(|r| json!({"name": r.name, "symbol": graph.symbol_info(r.symbol).name, "unit": r.unit, "label": language.text(&r.label)}))
        .collect();
    let energy = |e| if equations.textbook.is_ok() { three(&|form| printer.expression(graph, e, form)) } else { Value::Null };
    let mut own = serde_json::Map::new();
    own.insert("degrees_of_freedom".into(), json!(equations.degrees_of_freedom()));
    own.insert("equations".into(), json!(written));
    own.insert("not_shown".into(), json!(reason));
    own.insert("definitions".into(), json!(definitions));
    own.insert("conditions".into(), json!(conditions));
    own.insert("friction_laws".into(), json!(laws));
    own.insert("reactions".into(), json!(reactions));
    for (key, e) in ["kinetic", "potential", "dissipation"].into_iter().zip(document::energies(equations)) {
        own.insert(key.into(), energy(e.2));
    }
    let data = studies::pipeline::no_numbers(machine);
    serde_json::from_slice(&report::json::write(&data, &own, language)).unwrap_or(Value::Null)
}
