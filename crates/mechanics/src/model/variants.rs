//! Variants of the data of a model, the conditions that they keep, and what students answer.

use crate::units::Dimension;
use std::ops::Range;
use symbolic::{Expr, SymbolId};
use words::Text;

/// Variants of the data. Each replaces values as `--set` does.
#[derive(Clone, Debug)]
pub struct Variants {
    /// The table; none where formulas alone make the variants.
    pub table: Option<VariantTable>,
    /// Names of the variants where there is no table: first and last number.
    pub range: Option<[u32; 2]>,
    /// Column that names the variant; the first without it.
    pub key: Option<String>,
    /// Columns that are used, by the names of parameters, starts (`phi`) and starting rates (`phi'`); without it all must be such names.
    pub columns: Option<Vec<String>>,
    /// Units of the numbers in columns whose header has none.
    pub units: Vec<(String, String)>,
    /// Columns that only formulas use.
    pub helpers: Vec<Helper>,
    /// Parameter that gets the number of the variant, unless the table has such a column.
    pub number: Option<String>,
    /// Parameter that gets the number of the group.
    pub group_parameter: Option<String>,
    /// Number of the group where the command line gives none.
    pub group: Option<u32>,
    /// What an empty cell means.
    pub empty: EmptyCell,
    /// Values made by formulas, each after those that it uses.
    pub formulas: Vec<VariantFormula>,
    /// Conditions that refuse degenerate variants.
    pub require: Vec<Requirement>,
    /// The symbols n (group) and N (number of the variant) of these formulas.
    pub symbols: [SymbolId; 2],
    /// Place in the file.
    pub span: Range<usize>,
}

impl Variants {
    /// Whether a variant needs the number of the group.
    pub fn needs_group(&self, contains: &dyn Fn(Expr, SymbolId) -> bool) -> bool {
        let formulas = self.formulas.iter().map(|f| f.value).chain(self.require.iter().map(|r| r.holds));
        self.group_parameter.is_some() || formulas.into_iter().any(|e| contains(e, self.symbols[0]))
    }
}

/// Where a table of variants is.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum VariantTable {
    /// In a file, relative to the model file.
    File(String),
    /// In the model file itself.
    Text(String),
}

/// What an empty cell of a table means.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum EmptyCell {
    /// The value of the file stays.
    #[default]
    Keeps,
    /// There is no such part: zero.
    Absent,
}

/// A column that is no quantity of the model.
#[derive(Clone, Debug)]
pub struct Helper {
    /// Name of the column and in formulas.
    pub name: String,
    /// Its symbol.
    pub symbol: SymbolId,
    /// SI value of one unit of the numbers in the column.
    pub factor: f64,
    /// Dimension.
    pub dimension: Dimension,
}

/// A value of a variant that is a formula.
#[derive(Clone, Debug)]
pub struct VariantFormula {
    /// Parameter, start (`phi`) or starting rate (`phi'`).
    pub name: String,
    /// Over constant parameters, n, N and helpers; the own name stands for the value of the table or file.
    pub value: Expr,
    /// SI unit label.
    pub unit: String,
    /// Place in the file.
    pub span: Range<usize>,
}

/// A condition on a variant.
#[derive(Clone, Debug)]
pub struct Requirement {
    /// Name.
    pub name: String,
    /// As written.
    pub text: String,
    /// 1 where it holds, 0 where not; over constant parameters, n, N, helpers and answers.
    pub holds: Expr,
    /// Place in the file.
    pub span: Range<usize>,
}

/// An item that a student answers.
#[derive(Clone, Debug)]
pub struct AnswerDecl {
    /// Short name, in tables and files.
    pub id: String,
    /// Its symbol in formulas of later items and in conditions.
    pub symbol: SymbolId,
    /// The question.
    pub ask: Text,
    /// Where the right number comes from.
    pub value: AnswerValue,
    /// Unit of the answer.
    pub unit: AnswerUnit,
    /// How far a right answer may be off.
    pub tolerance: Tolerance,
    /// Parameter that later items are computed with: a student's own value carries on.
    pub gives: Option<String>,
    /// Place in the file.
    pub span: Range<usize>,
    /// Place of the value in the file.
    pub value_span: Range<usize>,
}

/// Where the right number comes from.
#[derive(Clone, Debug)]
pub enum AnswerValue {
    /// A number of a study: `modes.1.f`, `max(x)`.
    Study {
        /// As written.
        text: String,
        /// Kind of the study.
        of: Option<String>,
        /// The instant, where the value is that of an output at one.
        at: Option<String>,
    },
    /// A formula over constant parameters, n, N, helpers and earlier answers.
    Formula {
        /// SI.
        value: Expr,
        /// What the number is divided by to be in the unit of the answer.
        factor: f64,
    },
}

/// Unit of an answer.
#[derive(Clone, Debug, PartialEq)]
pub struct AnswerUnit {
    /// As the user wrote it; empty for pure numbers.
    pub label: String,
    /// SI value of one such unit.
    pub factor: f64,
    /// Dimension.
    pub dimension: Dimension,
}

/// How far a right answer may be off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tolerance {
    /// A share of the right value.
    Relative(f64),
    /// SI.
    Absolute(f64),
}
