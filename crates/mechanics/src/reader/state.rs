//! The state of reading: what is known so far, and the findings.

use super::draft::Draft;
use super::evaluate::Values;
use super::syntax::Value;
use super::wording::{short, wrong_type};
use crate::formula::{self, Builder, Context, Depends, Formula, Kind, KinematicFunction, Scope, check, lower};
use crate::model::{ObservedDecl, ParameterDecl, Premise, Reliance};
use crate::snippet::{Site, Snippet};
use crate::units::{self, Dimension, Quantity, Unit, mismatch, mismatch_of_number};
use std::borrow::Cow;
use std::collections::HashMap;
use std::ops::Range;
use symbolic::{Expr, Rational, SymbolId};
use toml::de::DeValue;
use words::{Notice, Severity, Text, letters};

/// More findings than this are not listed.
pub const MAX_FINDINGS: usize = 200;

/// The state of reading.
pub(crate) struct Reader<'a> {
    text: &'a str,
    /// Kinematic functions that formulas may use.
    pub functions: Vec<&'static KinematicFunction>,
    pub overrides: Vec<(String, Snippet<'static>)>,
    override_index: HashMap<String, usize>,
    /// Names of formulas and where they were declared.
    pub claimed: HashMap<String, Range<usize>>,
    /// The first name of each look, and where it stands.
    skeletons: HashMap<String, (String, Range<usize>)>,
    /// What the file gives in another unit than the SI one: coordinates, their rates with a prime, parameters; with that unit.
    pub scaled: std::collections::BTreeMap<String, String>,
    /// Parameters that the command line sets, and those whose formulas use them.
    pub by_hand: std::collections::BTreeSet<SymbolId>,
    /// names of outputs
    pub results: std::collections::HashSet<String>,
    diagnostics: Vec<Notice>,
    /// How many of them are errors.
    errors: usize,
    pub builder: Builder,
    pub scope: Scope,
    pub values: Values,
    /// Free lengths that statics decide.
    rests: Vec<ParameterDecl>,
    /// Formulas of the motion that studies observe.
    pub observed: Vec<ObservedDecl>,
    /// Nodes, rods and loads of a structure, as far as they are read.
    pub structure: Draft,
}

/// A formula as it stands in the file.
#[derive(Clone)]
pub(crate) struct Raw<'a> {
    pub snippet: Snippet<'a>,
    /// `None` when it has syntax errors, which are reported already.
    pub formula: Option<Formula>,
}

/// A formula that passed or failed its checks.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Checked {
    pub expr: Expr,
    pub kind: Kind,
    pub depends: Depends,
    /// whether it may be used
    pub good: bool,
}

impl<'a> Reader<'a> {
    pub(crate) fn new(text: &'a str, overrides: &[(String, String)], functions: Vec<&'static KinematicFunction>) -> Reader<'a> {
        let snippet = |(index, (name, value)): (usize, &(String, String))| {
            let site = Site::Override { index, text: format!("{name}={value}"), from: name.len() + 1 };
            (name.clone(), Snippet { text: Cow::Owned(value.clone()), site })
        };
        let overrides: Vec<_> = overrides.iter().enumerate().map(snippet).collect();
        let override_index = overrides.iter().enumerate().map(|(i, (name, _))| (name.trim().to_owned(), i)).collect();
        Reader {
            text,
            functions,
            overrides,
            override_index,
            claimed: HashMap::new(),
            skeletons: HashMap::new(),
            scaled: std::collections::BTreeMap::new(),
            by_hand: std::collections::BTreeSet::new(),
            results: std::collections::HashSet::new(),
            diagnostics: Vec::new(),
            errors: 0,
            builder: Builder::new(),
            scope: Scope::default(),
            values: Values::default(),
            rests: Vec::new(),
            observed: Vec::new(),
            structure: Draft::default(),
        }
    }
    /// A free length that statics decide: a parameter of its own.
    pub(crate) fn rest_from_statics(&mut self, spring: &str, kind: Kind, span: Range<usize>) -> Expr {
        let name = format!("{spring}_rest");
        if self.scope.get(&name).is_some() {
            let fault = Notice::piece(
                "M011",
                span,
                format!("the free length of `{spring}` would be called `{name}`, which is taken"),
                format!("длина без нагрузки `{spring}` получила бы имя `{name}`, но оно занято"),
            );
            self.fault(fault);
            return self.builder.graph.zero();
        }
        let symbol = self.builder.graph.symbol_id(&name, 0);
        let (zero, value) = (self.builder.graph.zero(), self.builder.graph.symbol(symbol));
        self.values.set(&mut self.builder.graph, symbol, 0.0);
        let entry =
            crate::formula::Entry { kind: crate::formula::EntryKind::Parameter(symbol), dimension: kind, depends: Depends::NOTHING };
        self.scope.declare(&name, entry);
        self.rests.push(ParameterDecl {
            name,
            symbol,
            value: crate::model::ParameterValue::Number { si: zero },
            class: crate::model::Class::Constant,
            number: Some(0.0),
            unit: crate::units::si_label(&kind.or_none()),
            written: "equilibrium".to_owned(),
            label: Text::new(format!("free length of {spring}"), format!("длина без нагрузки: {spring}")),
            span: Some(span),
        });
        value
    }
    /// A symbol for a letter that has a meaning of its own in one formula: another one than that of a parameter or coordinate of that name.
    pub(crate) fn letter(&mut self, name: &str) -> SymbolId {
        let numbered = (1..).map(|k| format!("{name}_{k}"));
        let free = std::iter::once(name.to_owned()).chain(numbered).find(|own| self.scope.get(own).is_none());
        self.builder.graph.symbol_id(free.as_deref().unwrap_or(name), 0)
    }
    pub(crate) fn take_rests(&mut self) -> Vec<ParameterDecl> {
        std::mem::take(&mut self.rests)
    }
    pub(crate) fn into_diagnostics(self) -> Vec<Notice> {
        self.diagnostics
    }
    pub(crate) fn take_builder(&mut self) -> Builder {
        std::mem::replace(&mut self.builder, Builder::new())
    }
    pub(crate) fn report(&mut self, diagnostic: Notice) {
        self.errors += usize::from(diagnostic.severity == Severity::Error);
        self.diagnostics.push(diagnostic);
    }
    /// How many errors were reported.
    pub(crate) fn errors(&self) -> usize {
        self.errors
    }
    /// Reports a fault whose range counts from the start of the file.
    pub(crate) fn fault(&mut self, fault: Notice) {
        self.report(Site::Literal(0).diagnose(fault));
    }
    /// Whether a value depends on one that was set by hand, through formulas of parameters too.
    pub(crate) fn is_set_by_hand(&self, value: &Checked) -> bool {
        !self.by_hand.is_empty() && self.builder.graph.contains(value.expr, |s| self.by_hand.contains(&s))
    }

    /// The override of a name.
    pub(crate) fn override_of(&self, name: &str) -> Option<Snippet<'a>> {
        self.override_index.get(name).map(|i| self.overrides[*i].1.clone())
    }

    /// The content of a string value with its place.
    pub(crate) fn snippet(&self, value: &'a Value<'a>) -> Option<Snippet<'a>> {
        let content = value.get_ref().as_str()?;
        let span = super::syntax::boundaries(self.text, value.span());
        let written = &self.text[span.clone()];
        let site = match written.find(content) {
            Some(offset) if !content.is_empty() => Site::Literal(span.start + offset),
            _ => Site::Inside(span),
        };
        Some(Snippet { text: Cow::Borrowed(content), site })
    }

    /// A string or number as a formula; `None` (with a finding) when it is something else.
    pub(crate) fn raw(&mut self, value: &'a Value<'a>) -> Option<Raw<'a>> {
        match value.get_ref() {
            DeValue::String(_) => {
                let snippet = self.snippet(value)?;
                Some(self.raw_text(snippet))
            }
            DeValue::Integer(_) | DeValue::Float(_) => self.raw_number(value),
            other => {
                let kind = other.type_str();
                self.fault(wrong_type(value.span(), "a formula, a quantity or a number", "формула, величина или число", kind));
                None
            }
        }
    }

    fn raw_number(&mut self, value: &'a Value<'a>) -> Option<Raw<'a>> {
        let number = match value.get_ref() {
            DeValue::Integer(n) if n.radix() == 10 => units::bounded_decimal(n.as_str()),
            DeValue::Integer(n) => i64::from_str_radix(n.as_str(), n.radix()).ok().map(Rational::from),
            DeValue::Float(n) => units::bounded_decimal(n.as_str()),
            _ => None,
        };
        let span = value.span();
        let snippet = Snippet { text: Cow::Borrowed(self.text.get(span.clone())?), site: Site::Literal(span.start) };
        let Some(number) = number else {
            self.report(snippet.diagnose(units::out_of_range(snippet.all())));
            return Some(Raw { snippet, formula: None });
        };
        let formula = Formula::quantity(Quantity::pure(number), snippet.all());
        Some(Raw { snippet, formula: Some(formula) })
    }

    /// Whether there are so many errors that more of them are not looked for.
    fn is_full(&self) -> bool {
        self.errors > 10 * MAX_FINDINGS
    }

    /// A piece of text as a quantity or formula.
    pub(crate) fn raw_text(&mut self, snippet: Snippet<'a>) -> Raw<'a> {
        if self.is_full() {
            return Raw { snippet, formula: None };
        }
        let parsed = if snippet.text.trim().is_empty() {
            Err(Notice::piece("M030", snippet.all(), "the formula is empty", "пустая формула"))
        } else if units::is_quantity(&snippet.text) {
            let quantity = units::parse_number_or_quantity(&snippet.text).map(|q| Formula::quantity(q, snippet.all()));
            quantity.map_err(|fault| self.product_meant(&snippet.text, fault))
        } else {
            formula::parse(&snippet.text, &self.functions)
        };
        if let Some(fault) = units::doubtful_comma(&snippet.text) {
            let finding = snippet.diagnose(fault);
            self.report(finding);
        }
        match parsed {
            Ok(formula) => Raw { snippet, formula: Some(formula) },
            Err(fault) => {
                let diagnostic = snippet.diagnose(fault);
                self.report(diagnostic);
                Raw { snippet, formula: None }
            }
        }
    }

    /// `2 phi`, where phi is a name of the model, is a product without its sign rather than an unknown unit.
    fn product_meant(&self, text: &str, fault: Notice) -> Notice {
        let is_name = text.get(fault.range()).is_some_and(|word| self.claimed.contains_key(word));
        match formula::parse(text, &self.functions) {
            Err(product) if is_name => product,
            _ => fault,
        }
    }

    /// Zero of unknown dimension, in place of a faulty value.
    pub(crate) fn nothing(&mut self) -> Checked {
        Checked { expr: self.builder.graph.zero(), kind: Kind::Unknown, depends: Depends::NOTHING, good: false }
    }

    /// Checks a formula, builds it, and makes sure that a constant is finite.
    pub(crate) fn value(&mut self, raw: &Raw<'a>, context: &Context, wanted: Option<&Dimension>) -> Checked {
        let Some(formula) = &raw.formula else { return self.nothing() };
        if self.is_full() {
            return self.nothing();
        }
        let checked = check(formula, &self.scope, context);
        let failed = checked.faults.iter().any(|f| f.severity == Severity::Error);
        for fault in checked.faults {
            let diagnostic = raw.snippet.diagnose(fault);
            self.report(diagnostic);
        }
        if failed {
            return self.nothing();
        }
        if let (Some(wanted), Kind::Known(got)) = (wanted, checked.kind)
            && !got.same(wanted)
        {
            let mismatch = if formula.is_literal() { mismatch_of_number } else { mismatch };
            let fault = mismatch(raw.snippet.all(), &got, wanted);
            self.report(raw.snippet.diagnose(fault));
            return self.nothing();
        }
        if let (Some(wanted), Kind::Known(got)) = (wanted, checked.kind)
            && let Some(fault) = units::in_field(&got, wanted, raw.snippet.all())
        {
            self.report(raw.snippet.diagnose(fault));
        }
        let expr = match lower(formula, &self.scope, &mut self.builder) {
            Ok(expr) => expr,
            Err(fault) => {
                self.report(raw.snippet.diagnose(fault));
                return self.nothing();
            }
        };
        let good = !checked.depends.is_constant() || checked.kind == Kind::Unknown || self.finite(raw, expr);
        Checked { expr, kind: checked.kind, depends: checked.depends, good }
    }

    fn finite(&mut self, raw: &Raw<'a>, expr: Expr) -> bool {
        let value = self.values.relied(&self.builder.graph, expr, Reliance::Finite);
        if value.is_finite() && self.values.underflows(&self.builder.graph, expr) {
            self.report(raw.snippet.diagnose(too_small(raw.snippet.all())));
            return false;
        }
        if value.is_finite() {
            return true;
        }
        let (en, ru) = if value.is_nan() {
            ("it is not a number", "результат не является числом")
        } else {
            ("it is infinite", "результат бесконечен")
        };
        let fault = Notice::piece(
            "M042",
            raw.snippet.all(),
            format!("this constant has no finite value: {en}"),
            format!("у этой постоянной нет конечного значения: {ru}"),
        )
        .why(
            "a division by zero, the root or logarithm of a negative number, or numbers of absurd size",
            "деление на нуль, корень или логарифм отрицательного числа либо числа нелепой величины",
        );
        self.report(raw.snippet.diagnose(fault));
        false
    }

    /// The machine number of a good constant; the model rests on it.
    pub(crate) fn number(&mut self, value: &Checked) -> Option<f64> {
        self.number_for(value, Reliance::Value)
    }

    /// The machine number of a good constant, of which the model takes no more than `reliance` says.
    pub(crate) fn number_for(&mut self, value: &Checked, reliance: Reliance) -> Option<f64> {
        let good = value.good && value.depends.is_constant();
        good.then(|| self.values.relied(&self.builder.graph, value.expr, reliance)).filter(|v| v.is_finite())
    }

    /// Carries something out of which it is noted apart what it reads off numbers.
    pub(crate) fn apart<T>(&mut self, read: impl FnOnce(&mut Self) -> T) -> (T, Vec<Premise>) {
        let mut others = std::collections::BTreeSet::new();
        self.values.exchange(&mut others);
        let found = read(self);
        let own = self.premises();
        self.values.exchange(&mut others);
        (found, own)
    }

    /// What the model takes from numbers.
    pub(crate) fn premises(&self) -> Vec<Premise> {
        self.values.premises(&self.builder.graph)
    }

    /// A unit; `None` with a finding when it is none.
    pub(crate) fn unit(&mut self, value: &'a Value<'a>) -> Option<(Unit, String)> {
        let Some(snippet) = self.snippet(value) else {
            self.fault(wrong_type(value.span(), "a unit in quotes", "единица в кавычках", value.get_ref().type_str()));
            return None;
        };
        match units::parse_unit(&snippet.text) {
            Ok(unit) => Some((unit, snippet.text.trim().to_owned())),
            Err(fault) => {
                self.report(snippet.diagnose(fault));
                None
            }
        }
    }

    /// The machine number of an expression over constants; `None` for anything else.
    pub(crate) fn number_of(&mut self, e: Expr) -> Option<f64> {
        Some(self.values.of(&self.builder.graph, e)).filter(|v| v.is_finite())
    }

    /// The same, of which the model takes no more than `reliance` says.
    pub(crate) fn number_of_for(&mut self, e: Expr, reliance: Reliance) -> Option<f64> {
        Some(self.values.relied(&self.builder.graph, e, reliance)).filter(|v| v.is_finite())
    }

    /// The coordinates, their rates and accelerations that stand in an expression.
    pub(crate) fn coordinates_in(&self, e: Expr) -> Vec<SymbolId> {
        let all = self.scope.coordinates();
        let within = self.builder.graph.symbols_in(&[e]);
        all.into_iter().filter(|s| within.binary_search(s).is_ok()).collect()
    }

    /// Whether a name may be used; reports when not.
    pub(crate) fn name_is_fine(&mut self, name: &str, span: Range<usize>, reserved: &[&str]) -> bool {
        if !formula::is_identifier(name) {
            let (reason_en, reason_ru) = if formula::is_too_long(name) {
                ("a name has at most 200 bytes", "имя не длиннее 200 байт")
            } else {
                (
                    "names are made of letters (Latin, Greek, Cyrillic), digits and _, and begin with a letter",
                    "имя состоит из букв (латинских, греческих, русских), цифр и _ и начинается с буквы",
                )
            };
            let fault = Notice::piece(
                "M010",
                span,
                format!("`{}` cannot be a name", short(name)),
                format!("`{}` не может быть именем", short(name)),
            )
            .why(reason_en, reason_ru);
            let fault = if name.contains('\'') {
                fault.help("derivatives exist by themselves: phi' needs no declaration", "производные есть и так: phi' объявлять не нужно")
            } else {
                fault
            };
            self.fault(fault);
            return false;
        }
        let function = symbolic::Function::from_name(name).is_some() || ["sqrt", "if", "and", "or", "not"].contains(&name);
        if reserved.contains(&name) || function && !reserved.contains(&"ground") {
            self.fault(
                Notice::piece(
                    "M010",
                    span,
                    format!("the name `{name}` is taken by the language"),
                    format!("имя `{name}` занято языком формул"),
                )
                .help(
                    "choose another name; a printed symbol can be set by symbol = \"...\"",
                    "выберите другое имя; обозначение для печати задаётся symbol = \"...\"",
                ),
            );
            return false;
        }
        self.look_alike(name, span);
        true
    }

    /// Warns of two names that differ only in letters of different alphabets that print alike.
    fn look_alike(&mut self, name: &str, span: Range<usize>) {
        let skeleton = letters::skeleton(name);
        let Some((first, place)) = self.skeletons.get(&skeleton).cloned() else {
            self.skeletons.insert(skeleton, (name.to_owned(), span));
            return;
        };
        let Some((a, b)) = letters::difference(&first, name) else { return };
        let ((a_en, a_ru), (b_en, b_ru)) = (letters::alphabet(a), letters::alphabet(b));
        let what = Text::new(
            format!("two names look alike: `{first}` with {a} ({a_en}) and `{name}` with {b} ({b_en})"),
            format!("два имени выглядят одинаково: `{first}` с буквой {a} ({a_ru}) и `{name}` с буквой {b} ({b_ru})"),
        );
        let words = Text::new("they are two different names, and print alike", "это два разных имени, а печатаются они одинаково");
        let help = Text::new("write both in one alphabet, or rename one", "пишите оба в одном алфавите или переименуйте одно");
        let finding = Notice::file("M140", span, what).warning().because(words).cure(help);
        self.report(finding.related(place, Text::new("the other one", "другое имя")));
    }
}

/// The fault of a constant that only the range of machine numbers makes zero.
fn too_small(span: Range<usize>) -> Notice {
    Notice::piece(
        "M022",
        span,
        "this constant is not zero, but smaller than 1e-307: it would count as zero",
        "эта постоянная не равна нулю, но меньше 1e-307 и считалась бы нулём",
    )
    .why("a product of numbers of absurd size", "произведение чисел нелепой величины")
    .help("check the exponents and the units", "проверьте показатели степеней и единицы")
}
