//! What all tables need: fields by name, formulas with their checks, findings.

use super::evaluate::Values;
use super::syntax::{Table, Value};
use crate::fields::{self, TableSpec};
use crate::formula::{self, Builder, Context, Depends, Formula, Kind, Scope, check, lower, mismatch};
use crate::model::{ParameterDecl, Premise, Reliance};
use crate::snippet::{Site, Snippet, nearest};
use crate::units::{self, Dimension, Quantity, Unit};
use std::borrow::Cow;
use std::collections::HashMap;
use std::ops::Range;
use symbolic::{Expr, Rational, SymbolId};
use toml::de::DeValue;
use words::{Notice, Severity, Text, letters};

/// The state of reading.
pub(super) struct Reader<'a> {
    text: &'a str,
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
    pub builder: Builder,
    pub scope: Scope,
    pub values: Values,
    /// Free lengths that statics decide.
    rests: Vec<ParameterDecl>,
    /// Nodes, rods and loads of a structure, as far as they are read.
    pub structure: super::structures::Draft,
}

/// A formula as it stands in the file.
#[derive(Clone)]
pub(super) struct Raw<'a> {
    pub snippet: Snippet<'a>,
    /// `None` when it has syntax errors, which are reported already.
    pub formula: Option<Formula>,
}

/// A formula that passed or failed its checks.
#[derive(Clone, Copy, Debug)]
pub(super) struct Checked {
    pub expr: Expr,
    pub kind: Kind,
    pub depends: Depends,
    /// whether it may be used
    pub good: bool,
}

impl<'a> Reader<'a> {
    pub(super) fn new(text: &'a str, overrides: &[(String, String)]) -> Reader<'a> {
        let snippet = |(index, (name, value)): (usize, &(String, String))| {
            let site = Site::Override { index, text: format!("{name}={value}"), from: name.len() + 1 };
            (name.clone(), Snippet { text: Cow::Owned(value.clone()), site })
        };
        let overrides: Vec<_> = overrides.iter().enumerate().map(snippet).collect();
        let override_index = overrides.iter().enumerate().map(|(i, (name, _))| (name.trim().to_owned(), i)).collect();
        Reader {
            text,
            overrides,
            override_index,
            claimed: HashMap::new(),
            skeletons: HashMap::new(),
            scaled: std::collections::BTreeMap::new(),
            by_hand: std::collections::BTreeSet::new(),
            results: std::collections::HashSet::new(),
            diagnostics: Vec::new(),
            builder: Builder::new(),
            scope: Scope::default(),
            values: Values::default(),
            rests: Vec::new(),
            structure: super::structures::Draft::default(),
        }
    }
    /// A free length that statics decide: a parameter of its own.
    pub(super) fn rest_from_statics(&mut self, spring: &str, kind: Kind, span: Range<usize>) -> Expr {
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
    pub(super) fn take_rests(&mut self) -> Vec<ParameterDecl> {
        std::mem::take(&mut self.rests)
    }
    pub(super) fn into_diagnostics(self) -> Vec<Notice> {
        self.diagnostics
    }
    pub(super) fn take_builder(&mut self) -> Builder {
        std::mem::replace(&mut self.builder, Builder::new())
    }
    pub(super) fn report(&mut self, diagnostic: Notice) {
        self.diagnostics.push(diagnostic);
    }
    /// How many errors were reported.
    pub(super) fn errors(&self) -> usize {
        self.diagnostics.iter().filter(|d| d.severity == Severity::Error).count()
    }
    /// Reports a fault whose range counts from the start of the file.
    pub(super) fn fault(&mut self, fault: Notice) {
        self.diagnostics.push(Site::Literal(0).diagnose(fault));
    }
    /// Whether a value depends on one that was set by hand, through formulas of parameters too.
    pub(super) fn is_set_by_hand(&self, value: &Checked) -> bool {
        !self.by_hand.is_empty() && self.builder.graph.contains(value.expr, |s| self.by_hand.contains(&s))
    }

    /// The override of a name.
    pub(super) fn override_of(&self, name: &str) -> Option<Snippet<'a>> {
        self.override_index.get(name).map(|i| self.overrides[*i].1.clone())
    }

    /// The content of a string value with its place.
    pub(super) fn snippet(&self, value: &'a Value<'a>) -> Option<Snippet<'a>> {
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
    pub(super) fn raw(&mut self, value: &'a Value<'a>) -> Option<Raw<'a>> {
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

    /// A piece of text as a quantity or formula.
    pub(super) fn raw_text(&mut self, snippet: Snippet<'a>) -> Raw<'a> {
        let parsed = if snippet.text.trim().is_empty() {
            Err(Notice::piece("M030", snippet.all(), "the formula is empty", "пустая формула"))
        } else if units::is_quantity(&snippet.text) {
            let quantity = units::parse_number_or_quantity(&snippet.text).map(|q| Formula::quantity(q, snippet.all()));
            quantity.map_err(|fault| self.product_meant(&snippet.text, fault))
        } else {
            formula::parse(&snippet.text)
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
        match formula::parse(text) {
            Err(product) if is_name => product,
            _ => fault,
        }
    }

    /// Zero of unknown dimension, in place of a faulty value.
    pub(super) fn nothing(&mut self) -> Checked {
        Checked { expr: self.builder.graph.zero(), kind: Kind::Unknown, depends: Depends::NOTHING, good: false }
    }

    /// Checks a formula, builds it, and makes sure that a constant is finite.
    pub(super) fn value(&mut self, raw: &Raw<'a>, context: &Context, wanted: Option<&Dimension>) -> Checked {
        let Some(formula) = &raw.formula else { return self.nothing() };
        if self.diagnostics.len() > 10 * super::MAX_FINDINGS {
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
            let fault = mismatch(raw.snippet.all(), &got, wanted, formula.is_literal());
            self.report(raw.snippet.diagnose(fault));
            return self.nothing();
        }
        if let (Some(wanted), Kind::Known(got)) = (wanted, checked.kind)
            && let Some(fault) = formula::in_field(&got, wanted, raw.snippet.all())
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
    pub(super) fn number(&mut self, value: &Checked) -> Option<f64> {
        self.number_for(value, Reliance::Value)
    }

    /// The machine number of a good constant, of which the model takes no more than `reliance` says.
    pub(super) fn number_for(&mut self, value: &Checked, reliance: Reliance) -> Option<f64> {
        let good = value.good && value.depends.is_constant();
        good.then(|| self.values.relied(&self.builder.graph, value.expr, reliance)).filter(|v| v.is_finite())
    }

    /// What the model takes from numbers.
    pub(super) fn premises(&self) -> Vec<Premise> {
        self.values.premises(&self.builder.graph)
    }

    /// A unit; `None` with a finding when it is none.
    pub(super) fn unit(&mut self, value: &'a Value<'a>) -> Option<(Unit, String)> {
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
    pub(super) fn number_of(&mut self, e: Expr) -> Option<f64> {
        Some(self.values.of(&self.builder.graph, e)).filter(|v| v.is_finite())
    }

    /// The same, of which the model takes no more than `reliance` says.
    pub(super) fn number_of_for(&mut self, e: Expr, reliance: Reliance) -> Option<f64> {
        Some(self.values.relied(&self.builder.graph, e, reliance)).filter(|v| v.is_finite())
    }

    /// The coordinates, their rates and accelerations that stand in an expression.
    pub(super) fn coordinates_in(&self, e: Expr) -> Vec<SymbolId> {
        let all = self.scope.coordinates();
        let within = self.builder.graph.symbols_in(&[e]);
        all.into_iter().filter(|s| within.binary_search(s).is_ok()).collect()
    }

    /// Whether a name may be used; reports when not.
    pub(super) fn name_is_fine(&mut self, name: &str, span: Range<usize>, reserved: &[&str]) -> bool {
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

/// A long word cut for a message.
pub(super) fn short(text: &str) -> String {
    match text.char_indices().nth(40) {
        Some((i, _)) => format!("{}...", text[..i].escape_debug()),
        None => text.escape_debug().to_string(),
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

pub(super) fn wrong_type(span: Range<usize>, en: &str, ru: &str, got: &str) -> Notice {
    let got_ru = match got {
        "string" => "строка",
        "integer" => "целое число",
        "float" => "число",
        "boolean" => "логическое значение",
        "datetime" => "дата",
        "array" => "массив",
        "table" => "таблица",
        other => other,
    };
    Notice::piece("M007", span, format!("expected {en}, found {got}"), format!("ожидается {ru}, а стоит {got_ru}"))
}

/// A table of the file with its description.
pub(super) struct Fields<'a> {
    spec: &'static TableSpec,
    table: &'a Table<'a>,
    /// What to call it in messages: `bodies.rotor`.
    pub path: String,
    /// Where it begins (its name).
    pub span: Range<usize>,
}

impl<'a> Fields<'a> {
    /// Takes a table, reporting unknown and missing keys.
    pub(super) fn open(
        reader: &mut Reader<'a>,
        spec: &'static TableSpec,
        table: &'a Table<'a>,
        span: Range<usize>,
        path: String,
    ) -> Fields<'a> {
        for (key, _) in table {
            if spec.field(key.get_ref()).is_none() {
                let fault = unknown_key(spec, key.get_ref(), key.span(), &path);
                reader.fault(fault);
            }
        }
        let missing: Vec<&str> = spec.fields.iter().filter(|f| f.required && !table.contains_key(f.key)).map(|f| f.key).collect();
        if !missing.is_empty() && spec.name != fields::TOP.name {
            let fault = missing_keys(spec, &missing, span.clone(), &path);
            reader.fault(fault);
        }
        Fields { spec, table, path, span }
    }

    /// The value of a key.
    pub(super) fn get(&self, key: &'static str) -> Option<&'a Value<'a>> {
        debug_assert!(self.spec.field(key).is_some(), "{key} is not described in fields.rs for {}", self.spec.name);
        #[cfg(test)]
        tests::note(self.spec.name, key);
        self.table.get(key)
    }
    /// Whether a key is there.
    pub(super) fn has(&self, key: &'static str) -> bool {
        self.get(key).is_some()
    }
    /// The place of a value, or of the table without it.
    pub(super) fn span_of(&self, key: &'static str) -> Range<usize> {
        self.get(key).map_or(self.span.clone(), |v| v.span())
    }

    /// A formula under a key.
    pub(super) fn raw(&self, reader: &mut Reader<'a>, key: &'static str) -> Option<Raw<'a>> {
        let value = self.get(key)?;
        Some(reader.raw(value).unwrap_or(Raw { snippet: placeholder(value.span()), formula: None }))
    }

    /// A formula under a key, checked.
    pub(super) fn formula(
        &self,
        reader: &mut Reader<'a>,
        key: &'static str,
        context: &Context,
        wanted: Option<&Dimension>,
    ) -> Option<Checked> {
        let raw = self.raw(reader, key)?;
        Some(reader.value(&raw, context, wanted))
    }

    /// A formula under a key; zero without it.
    pub(super) fn formula_or_zero(
        &self,
        reader: &mut Reader<'a>,
        key: &'static str,
        context: &Context,
        wanted: Option<&Dimension>,
    ) -> Checked {
        match self.formula(reader, key, context, wanted) {
            Some(value) => value,
            None => Checked { kind: Kind::Any, good: true, ..reader.nothing() },
        }
    }

    /// Two or three formulas under a key; zeros without it.
    pub(super) fn vector(&self, reader: &mut Reader<'a>, key: &'static str, context: &Context, wanted: &Dimension) -> [Expr; 3] {
        match self.get(key) {
            Some(value) => components(reader, value, context, wanted),
            None => [reader.builder.graph.zero(); 3],
        }
    }

    /// A name under a key, with its place.
    pub(super) fn name(&self, reader: &mut Reader<'a>, key: &'static str) -> Option<(String, Range<usize>)> {
        string(reader, self.get(key)?, "a name in quotes", "имя в кавычках")
    }

    /// Text in one or two languages.
    pub(super) fn text(&self, reader: &mut Reader<'a>, key: &'static str) -> Option<Text> {
        let value = self.get(key)?;
        match value.get_ref() {
            DeValue::String(words) => printable(reader, words, value.span()).then(|| Text::same(words.as_ref())),
            DeValue::Table(table) => {
                let both = Fields::open(reader, &fields::TEXT, table, value.span(), self.path_of(key));
                let en = both.get("en").and_then(|v| string(reader, v, "a string", "строка"));
                let ru = both.get("ru").and_then(|v| string(reader, v, "a string", "строка"));
                let (en, ru) = (en.map(|t| t.0), ru.map(|t| t.0));
                let en_text = en.clone().or_else(|| ru.clone()).unwrap_or_default();
                Some(Text::new(en_text, ru.or(en).unwrap_or_default()))
            }
            other => {
                reader.fault(wrong_type(
                    value.span(),
                    "a string or { en = \"...\", ru = \"...\" }",
                    "строка или { en = \"...\", ru = \"...\" }",
                    other.type_str(),
                ));
                None
            }
        }
    }

    /// Notes the printed symbol.
    pub(super) fn symbol(&self, reader: &mut Reader<'a>, name: &str, notation: &mut Vec<(String, String)>) {
        if let Some((symbol, _)) = self.get("symbol").and_then(|v| string(reader, v, "a string", "строка")) {
            notation.push((name.to_owned(), symbol));
        }
    }

    /// The entries of a table of tables: name, its place, its fields.
    pub(super) fn entries(&self, reader: &mut Reader<'a>, key: &'static str, spec: &'static TableSpec) -> Vec<(String, Fields<'a>)> {
        self.entries_if(reader, key, spec, &|_, _| true)
    }

    /// The entries for which `wanted` holds.
    pub(super) fn entries_if(
        &self,
        reader: &mut Reader<'a>,
        key: &'static str,
        spec: &'static TableSpec,
        wanted: &dyn Fn(&Reader<'a>, &Table<'a>) -> bool,
    ) -> Vec<(String, Fields<'a>)> {
        let mut entries = Vec::new();
        for (name, span, value) in self.rows(reader, key) {
            match value.get_ref() {
                DeValue::Table(table) if !wanted(reader, table) => {}
                DeValue::Table(table) => {
                    let path = format!("{key}.{}", short(name));
                    let fields = Fields::open(reader, spec, table, span, path);
                    entries.push((name.to_owned(), fields));
                }
                other => {
                    let fault = wrong_type(value.span(), "a table", "таблица", other.type_str()).help(
                        format!("write [{key}.{}] and its keys below", short(name)),
                        format!("напишите [{key}.{}] и ключи под ним", short(name)),
                    );
                    reader.fault(fault);
                }
            }
        }
        entries
    }

    /// The raw rows of a table by name.
    pub(super) fn rows(&self, reader: &mut Reader<'a>, key: &'static str) -> Vec<(&'a str, Range<usize>, &'a Value<'a>)> {
        match self.get(key).map(|v| (v, v.get_ref())) {
            None => Vec::new(),
            Some((_, DeValue::Table(table))) => table.iter().map(|(k, v)| (k.get_ref().as_ref(), k.span(), v)).collect(),
            Some((value, other)) => {
                let fault = wrong_type(value.span(), "a table", "таблица", other.type_str()).help(
                    format!("write [{key}] and entries below, or [{key}.NAME]"),
                    format!("напишите [{key}] и строки под ним или [{key}.ИМЯ]"),
                );
                reader.fault(fault);
                Vec::new()
            }
        }
    }

    pub(super) fn path_of(&self, key: &str) -> String {
        if self.path.is_empty() { key.to_owned() } else { format!("{}.{key}", self.path) }
    }
}

fn placeholder<'a>(span: Range<usize>) -> Snippet<'a> {
    Snippet { text: Cow::Borrowed(""), site: Site::Inside(span) }
}

/// A string with its place; a finding when it is something else.
pub(super) fn string<'a>(reader: &mut Reader<'a>, value: &'a Value<'a>, en: &str, ru: &str) -> Option<(String, Range<usize>)> {
    match value.get_ref() {
        DeValue::String(words) => printable(reader, words, value.span()).then(|| (words.as_ref().to_owned(), value.span())),
        other => {
            reader.fault(wrong_type(value.span(), en, ru, other.type_str()));
            None
        }
    }
}

/// Whether a text shows what it is: no character that steers a terminal or turns the direction of writing.
fn printable(reader: &mut Reader, words: &str, span: Range<usize>) -> bool {
    let Some(bad) = words.chars().find(|c| steers(*c)) else { return true };
    let code = u32::from(bad);
    let fault = Notice::piece(
        "M150",
        span,
        format!("the text holds the control character U+{code:04X}"),
        format!("в тексте управляющий символ U+{code:04X}"),
    );
    reader.fault(fault.help("delete it, or retype the text", "удалите его или наберите текст заново"));
    false
}

/// Control characters but tabs and ends of lines; embedding, overriding and isolating of directions (Unicode Standard Annex 9).
fn steers(c: char) -> bool {
    (c.is_control() && !matches!(c, '\t' | '\n' | '\r')) || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// Two or three formulas.
pub(super) fn components<'a>(reader: &mut Reader<'a>, value: &'a Value<'a>, context: &Context, wanted: &Dimension) -> [Expr; 3] {
    let mut result = [reader.builder.graph.zero(); 3];
    let Some(items) = value.get_ref().as_array() else {
        reader.fault(
            wrong_type(value.span(), "an array of 2 or 3 formulas", "массив из 2 или 3 формул", value.get_ref().type_str())
                .help("write for example [\"x\", \"y\"]", "напишите, например, [\"x\", \"y\"]"),
        );
        return result;
    };
    if !(2..=3).contains(&items.len()) {
        reader.fault(Notice::piece(
            "M008",
            value.span(),
            format!("a vector has 2 components in the plane or 3 in space, {} given", items.len()),
            format!("у вектора 2 компоненты на плоскости или 3 в пространстве, дано: {}", items.len()),
        ));
        return result;
    }
    for (slot, item) in result.iter_mut().zip(items.iter()) {
        if let Some(raw) = reader.raw(item) {
            *slot = reader.value(&raw, context, Some(wanted)).expr;
        }
    }
    result
}

fn unknown_key(spec: &'static TableSpec, key: &str, span: Range<usize>, path: &str) -> Notice {
    let place = if path.is_empty() {
        ("at top level".to_owned(), "на верхнем уровне".to_owned())
    } else {
        (format!("in {path}"), format!("в {path}"))
    };
    let fault = Notice::piece(
        "M005",
        span,
        format!("unknown key `{}` {}", short(key), place.0),
        format!("неизвестный ключ `{}` {}", short(key), place.1),
    );
    match nearest(key, spec.fields.iter().map(|f| f.key)) {
        Some(near) => fault.meant(key, near),
        None => {
            let keys: Vec<&str> = spec.fields.iter().map(|f| f.key).collect();
            fault.help(format!("known keys: {}", keys.join(", ")), format!("известные ключи: {}", keys.join(", ")))
        }
    }
}

fn missing_keys(spec: &'static TableSpec, missing: &[&str], span: Range<usize>, path: &str) -> Notice {
    let examples: Vec<String> = missing.iter().filter_map(|k| spec.field(k)).map(|f| format!("{} = {}", f.key, f.example)).collect();
    Notice::piece("M006", span, format!("{path} lacks {}", missing.join(", ")), format!("в {path} не хватает: {}", missing.join(", ")))
        .help(format!("add for example {}", examples.join(", ")), format!("добавьте, например: {}", examples.join(", ")))
}

#[cfg(test)]
pub(super) mod tests {
    use std::cell::RefCell;
    use std::collections::BTreeSet;
    thread_local! {
        static ASKED: RefCell<BTreeSet<(&'static str, &'static str)>> = const { RefCell::new(BTreeSet::new()) };
    }
    pub(super) fn note(table: &'static str, key: &'static str) {
        ASKED.with(|a| a.borrow_mut().insert((table, key)));
    }
    /// The keys the reader asked for on this thread.
    pub(in crate::read) fn asked() -> BTreeSet<(&'static str, &'static str)> {
        ASKED.with(|a| a.borrow().clone())
    }
}
