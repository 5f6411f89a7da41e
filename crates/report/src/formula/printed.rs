//! Expressions and equalities as the printer writes them.

use super::compose::Composer;
use super::layout::{Layout, Placement, Relation, Sign};
use super::order::Side;
use super::printer::Printer;
use super::set::Form;
use symbolic::equations::{Equality, StepFormula};
use symbolic::{Expr, Graph, SymbolId};

impl Printer {
    /// An expression.
    pub fn expression(&self, graph: &Graph, e: Expr, form: Form) -> String {
        self.write(&self.layout(graph, e), form, Placement::Block)
    }

    /// An expression within a sentence.
    pub fn inline(&self, graph: &Graph, e: Expr, form: Form) -> String {
        self.write(&self.layout(graph, e), form, Placement::Inline)
    }

    /// left = right in the order of an equation of motion. `own` is the number of its coordinate, whose acceleration comes first.
    pub fn equality(&self, graph: &Graph, equality: Equality, own: Option<usize>, form: Form) -> String {
        self.write(&self.equality_layout(graph, equality, own), form, Placement::Block)
    }

    /// A bound: `|F| ≤ F₁`.
    pub fn at_most(&self, graph: &Graph, bound: Equality) -> Layout {
        match self.equality_layout(graph, bound, None) {
            Layout::Related(left, _, right) => Layout::Related(left, Relation::LessEqual, right),
            other => other,
        }
    }

    /// symbol = formula.
    pub fn definition(&self, graph: &Graph, symbol: SymbolId, formula: Expr) -> Layout {
        equation(self.symbol_layout(graph, symbol), self.layout(graph, formula))
    }

    /// A formula of the written derivation: `∂T/∂φ' = ...`.
    pub fn step(&self, graph: &Graph, formula: &StepFormula) -> Layout {
        let left = self.step_name(graph, &formula.left);
        let right = Composer::new(graph, self).compose(formula.right, Sign::Plus, self.step_side(graph, &formula.left));
        equation(left, right)
    }

    /// The layout of an expression.
    pub fn layout(&self, graph: &Graph, e: Expr) -> Layout {
        Composer::new(graph, self).compose(e, Sign::Plus, Side::Plain)
    }

    /// The layout of an equality.
    pub fn equality_layout(&self, graph: &Graph, equality: Equality, own: Option<usize>) -> Layout {
        let mut composer = Composer::new(graph, self);
        let (left_side, right_side) = match own {
            Some(i) => (Side::Left(i), Side::Right),
            None => (Side::Plain, Side::Plain),
        };
        let left = composer.compose(equality.left, Sign::Plus, left_side);
        let right = composer.compose(equality.right, Sign::Plus, right_side);
        equation(left, right)
    }
}

pub(super) fn equation(left: Layout, right: Layout) -> Layout {
    Layout::Related(Box::new(left), Relation::Equal, Box::new(right))
}
