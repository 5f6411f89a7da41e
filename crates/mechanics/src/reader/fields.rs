//! A table of the file with its description: its values by key, its rows.

use super::state::{Checked, Raw, Reader};
use super::syntax::{Table, Value};
use super::values::{components, printable, string};
use super::wording::{short, wrong_type};
use crate::formula::{Context, Kind, Scope};
use crate::keys::{TEXT, TableSpec};
use crate::snippet::{Site, Snippet};
use crate::units::Dimension;
use std::borrow::Cow;
use std::ops::Range;
use symbolic::Expr;
use toml::de::DeValue;
use words::{Notice, Text};

/// A table of the file with its description.
pub(crate) struct Fields<'a> {
    spec: &'static TableSpec,
    table: &'a Table<'a>,
    /// What to call it in messages: `bodies.rotor`.
    pub path: String,
    /// Where it begins (its name).
    pub span: Range<usize>,
}

impl<'a> Fields<'a> {
    /// Takes a table, reporting unknown and missing keys.
    pub(crate) fn open(
        reader: &mut Reader<'a>,
        spec: &'static TableSpec,
        table: &'a Table<'a>,
        span: Range<usize>,
        path: String,
    ) -> Fields<'a> {
        Fields::open_with(reader, (spec, &|_| false), table, span, path)
    }

    /// The same for a table whose other keys are names: those that `free` knows.
    pub(crate) fn open_with(
        reader: &mut Reader<'a>,
        (spec, free): (&'static TableSpec, &dyn Fn(&str) -> bool),
        table: &'a Table<'a>,
        span: Range<usize>,
        path: String,
    ) -> Fields<'a> {
        for (key, _) in table {
            if spec.field(key.get_ref()).is_none() && !free(key.get_ref()) {
                let fault = unknown_key(&reader.scope, spec, (key.get_ref(), key.span()), &path);
                reader.fault(fault);
            }
        }
        let missing: Vec<&str> = spec.fields.iter().filter(|f| f.required && !table.contains_key(f.key)).map(|f| f.key).collect();
        if !missing.is_empty() && !spec.name.is_empty() {
            let fault = missing_keys(spec, &missing, span.clone(), &path);
            reader.fault(fault);
        }
        Fields { spec, table, path, span }
    }

    /// The value of a key.
    pub(crate) fn get(&self, key: &'static str) -> Option<&'a Value<'a>> {
        debug_assert!(self.spec.field(key).is_some(), "{key} is not described in fields.rs for {}", self.spec.name);
        #[cfg(test)]
        noted::note(self.spec.name, key);
        self.table.get(key)
    }
    /// Whether the table may have a key.
    pub(crate) fn knows(&self, key: &str) -> bool {
        self.spec.field(key).is_some()
    }
    /// Whether a key is there.
    pub(crate) fn has(&self, key: &'static str) -> bool {
        self.get(key).is_some()
    }
    /// The place of a value, or of the table without it.
    pub(crate) fn span_of(&self, key: &'static str) -> Range<usize> {
        self.get(key).map_or(self.span.clone(), |v| v.span())
    }

    /// A formula under a key.
    pub(crate) fn raw(&self, reader: &mut Reader<'a>, key: &'static str) -> Option<Raw<'a>> {
        let value = self.get(key)?;
        Some(reader.raw(value).unwrap_or(Raw { snippet: placeholder(value.span()), formula: None }))
    }

    /// A formula under a key, checked.
    pub(crate) fn formula(
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
    pub(crate) fn formula_or_zero(
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
    pub(crate) fn vector(&self, reader: &mut Reader<'a>, key: &'static str, context: &Context, wanted: &Dimension) -> [Expr; 3] {
        match self.get(key) {
            Some(value) => components(reader, value, context, wanted),
            None => [reader.builder.graph.zero(); 3],
        }
    }

    /// true or false under a key.
    pub(crate) fn flag(&self, reader: &mut Reader<'a>, key: &'static str) -> Option<bool> {
        let value = self.get(key)?;
        let on = value.get_ref().as_bool();
        if on.is_none() {
            reader.fault(wrong_type(value.span(), "true or false", "true или false", value.get_ref().type_str()));
        }
        on
    }

    /// A name under a key, with its place.
    pub(crate) fn name(&self, reader: &mut Reader<'a>, key: &'static str) -> Option<(String, Range<usize>)> {
        string(reader, self.get(key)?, "a name in quotes", "имя в кавычках")
    }

    /// Text in one or two languages.
    pub(crate) fn text(&self, reader: &mut Reader<'a>, key: &'static str) -> Option<Text> {
        let value = self.get(key)?;
        match value.get_ref() {
            DeValue::String(words) => printable(reader, words, value.span()).then(|| Text::same(words.as_ref())),
            DeValue::Table(table) => {
                let both = Fields::open(reader, &TEXT, table, value.span(), self.path_of(key));
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
    pub(crate) fn symbol(&self, reader: &mut Reader<'a>, name: &str, notation: &mut Vec<(String, String)>) {
        if let Some((symbol, _)) = self.get("symbol").and_then(|v| string(reader, v, "a string", "строка")) {
            notation.push((name.to_owned(), symbol));
        }
    }

    /// The entries of a table of tables: name, its place, its fields.
    pub(crate) fn entries(&self, reader: &mut Reader<'a>, key: &'static str, spec: &'static TableSpec) -> Vec<(String, Fields<'a>)> {
        self.entries_if(reader, key, spec, &|_, _| true)
    }

    /// The entries for which `wanted` holds.
    pub(crate) fn entries_if(
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

    /// The rows of this table that are no keys.
    pub(crate) fn others(&self) -> Vec<(&'a str, Range<usize>, &'a Value<'a>)> {
        let known = |key: &str| self.spec.field(key).is_some();
        self.table.iter().filter(|(k, _)| !known(k.get_ref())).map(|(k, v)| (k.get_ref().as_ref(), k.span(), v)).collect()
    }

    /// The raw rows of a table by name.
    pub(crate) fn rows(&self, reader: &mut Reader<'a>, key: &'static str) -> Vec<(&'a str, Range<usize>, &'a Value<'a>)> {
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

    pub(crate) fn path_of(&self, key: &str) -> String {
        if self.path.is_empty() { key.to_owned() } else { format!("{}.{key}", self.path) }
    }
}

fn placeholder<'a>(span: Range<usize>) -> Snippet<'a> {
    Snippet { text: Cow::Borrowed(""), site: Site::Inside(span) }
}

fn unknown_key(scope: &Scope, spec: &'static TableSpec, (key, span): (&str, Range<usize>), path: &str) -> Notice {
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
    match scope.nearest(key, spec.fields.iter().map(|f| f.key)) {
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
pub(crate) use noted::asked;

#[cfg(test)]
pub(crate) mod noted {
    use std::cell::RefCell;
    use std::collections::BTreeSet;
    thread_local! {
        static ASKED: RefCell<BTreeSet<(&'static str, &'static str)>> = const { RefCell::new(BTreeSet::new()) };
    }
    pub(super) fn note(table: &'static str, key: &'static str) {
        ASKED.with(|a| a.borrow_mut().insert((table, key)));
    }
    /// The keys the reader asked for on this thread.
    pub(crate) fn asked() -> BTreeSet<(&'static str, &'static str)> {
        ASKED.with(|a| a.borrow().clone())
    }
}
