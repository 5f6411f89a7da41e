//! What a study found, in a form that the terminal, the page, CSV and JSON all understand: [`Results`] is the only result type.

mod conclusion;
pub mod contacts;
pub mod events;
mod facts;
pub mod figures;
pub mod finite;
pub mod tables;
mod view;

pub use facts::Fact;
pub use view::{Extent, View};

use analysis::Dataset;
pub use conclusion::{Conclusion, found, greatest, shown};
use mechanics::model::Plot;
use report::figure::Pen;
use report::{Block, Figure, Table, Word};
use serde_json::{Map, Value, json};
use std::fmt::Debug;
use std::sync::Arc;
use words::{Language, Notice, Text};

/// How the columns are shown on terminal and page.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rows {
    /// Least and largest of each column.
    #[default]
    Summary,
    /// Row by row.
    All,
    /// A column for each row: places beside one another.
    Beside,
    /// Not at all: the facts say everything.
    Hidden,
}

/// Whether strips show what contacts and frictions did over time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Strips {
    /// No strips.
    #[default]
    None,
    /// Strips under the plots.
    Drawn,
}

/// How a result is shown when nothing else is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Alone {
    /// The title of the machine, the heading, tables.
    #[default]
    Titled,
    /// The title of the machine and what was found, without a heading; then the command that a user is likely to want.
    Written {
        /// That command.
        next: Next,
    },
    /// The table of places.
    Places,
    /// CSV in pipes, a summary on terminals.
    Table,
    /// The written solution on terminals, CSV in pipes.
    WrittenOrTable,
}

/// What a user is likely to want after a study.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Next {
    /// `strutt run`.
    Run,
    /// The study itself, its numbers.
    Numbers,
}

/// Something that a study shows in a way of its own.
pub trait Show: Debug + Send + Sync {
    /// Everything below the heading.
    fn blocks(&self, results: &Results, view: &View) -> Vec<Block>;

    /// Drawings.
    fn figures(&self, results: &Results, language: Language) -> Vec<Figure> {
        results.plotted(language)
    }
}

/// What stands below the heading.
#[derive(Clone, Debug, Default)]
pub enum Body {
    /// Words, facts, columns, remarks, events, plots.
    #[default]
    Usual,
    /// The same behind something of its own.
    After(Arc<dyn Show>),
    /// Something of its own alone.
    Own(Arc<dyn Show>),
}

/// What a study found.
#[derive(Clone, Debug, Default)]
pub struct Results {
    /// Name of the study: `periodic`.
    pub kind: &'static str,
    /// Stem of its files; empty: the name of the study.
    pub stem: &'static str,
    /// How it is shown when nothing else is.
    pub alone: Alone,
    /// Heading of its section.
    pub heading: Text,
    /// Single numbers.
    pub facts: Vec<Fact>,
    /// Paragraphs, before the tables.
    pub words: Vec<Text>,
    /// Columns, audits, events.
    pub data: Dataset,
    /// How the columns are shown.
    pub rows: Rows,
    /// What stands below the heading.
    pub body: Body,
    /// Further tables, written beside the one of the columns, by name.
    pub beside: Vec<(&'static str, Dataset)>,
    /// Fields of JSON besides the facts.
    pub own: Map<String, Value>,
    /// Plots.
    pub plots: Vec<Plot>,
    /// How their points are joined.
    pub pen: Pen,
    /// What contacts did over time.
    pub strips: Strips,
    /// What ended the study early.
    pub trouble: Option<Notice>,
}

impl Results {
    /// Nothing but what ended the study.
    pub fn failed(kind: &'static str, heading: Text, trouble: Notice) -> Results {
        Results { kind, heading, trouble: Some(trouble), ..Results::default() }
    }

    /// Ends the study with a trouble.
    pub fn fail(&mut self, why: Notice) {
        self.data.partial = true;
        self.trouble = Some(why);
    }

    /// Stem of its files.
    pub fn stem(&self) -> &'static str {
        if self.stem.is_empty() { self.kind } else { self.stem }
    }

    /// The fields of JSON that are not common to all studies.
    pub fn fields(&self) -> Map<String, Value> {
        let mut fields = Map::new();
        // a study that names itself chooses the place
        if !self.own.contains_key("study") {
            fields.insert("study".into(), json!(self.kind));
        }
        for fact in &self.facts {
            fields.insert(fact.quantity.name.clone(), json!(fact.value));
        }
        fields.extend(self.own.clone());
        if let Some(trouble) = &self.trouble {
            fields.insert("fault".into(), trouble_to_json(trouble, Language::En));
        }
        fields
    }

    /// The columns as a table.
    pub fn columns_table(&self, language: Language) -> Option<Table> {
        match self.rows {
            _ if self.data.columns.is_empty() => None,
            Rows::Hidden => None,
            Rows::Summary => Some(tables::results(&self.data, language)),
            Rows::Beside => Some(tables::equilibria(&self.data, language)),
            Rows::All => Some(tables::row_by_row(&self.data, language)),
        }
    }

    /// Heading and everything below it.
    pub fn told(&self, view: &View) -> Vec<Block> {
        let mut blocks = vec![Block::heading(1, view.language.text(&self.heading))];
        blocks.extend(self.below(view));
        blocks
    }

    /// Everything below the heading.
    pub fn below(&self, view: &View) -> Vec<Block> {
        match &self.body {
            Body::Usual => self.usual(view),
            Body::After(show) => show.blocks(self, view).into_iter().chain(self.usual(view)).collect(),
            Body::Own(show) => show.blocks(self, view),
        }
    }

    fn usual(&self, view: &View) -> Vec<Block> {
        let language = view.language;
        let title = language.text(&self.heading);
        let captioned = |table: Table, caption: &str| Block::Table(if view.is_page() { table.with_caption(caption) } else { table });
        let mut blocks: Vec<Block> = self.words.iter().map(|words| Block::paragraph(language.text(words))).collect();
        blocks.extend(facts::table(&self.facts, view).map(|table| captioned(table, title)));
        let caption = if self.rows == Rows::Beside { title } else { language.word(Word::Results) };
        blocks.extend(self.columns_table(language).map(|table| captioned(table, caption)));
        blocks.extend(events::notes(&self.data, language));
        blocks.extend(events::events(&self.data, view.extent, language));
        if view.is_page() {
            blocks.extend(self.figures(language).into_iter().map(Block::Figure));
            blocks.extend(self.bands(language).map(Block::Bands));
        }
        blocks
    }

    /// Its drawings.
    pub fn figures(&self, language: Language) -> Vec<Figure> {
        match &self.body {
            Body::Own(show) | Body::After(show) => show.figures(self, language),
            Body::Usual => self.plotted(language),
        }
    }

    /// The plots that are asked for.
    pub fn plotted(&self, language: Language) -> Vec<Figure> {
        let mut figures = figures::plots(&self.plots, &self.data, language);
        figures.iter_mut().flat_map(|figure| &mut figure.series).for_each(|series| series.pen = self.pen);
        figures
    }

    /// What contacts and frictions did, where that is shown.
    pub fn bands(&self, language: Language) -> Option<report::figure::bands::Bands> {
        if self.strips == Strips::Drawn { contacts::bands(&self.data, language) } else { None }
    }

    /// Whether the document says how much work it was.
    pub fn tells_work(&self) -> bool {
        !matches!(self.body, Body::Own(_)) && self.rows != Rows::Beside
    }
}

/// A trouble as JSON.
pub fn trouble_to_json(trouble: &Notice, language: Language) -> Value {
    json!({"code": trouble.code, "severity": "error", "what": language.text(&trouble.what), "why": language.text(&trouble.why),
        "help": language.text(&trouble.help)})
}

/// The entries of an object of JSON.
pub fn fields(object: Value) -> Map<String, Value> {
    if let Value::Object(map) = object { map } else { Map::new() }
}
