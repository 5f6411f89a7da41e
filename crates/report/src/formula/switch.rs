//! Switches as cases with readable conditions.

use super::compose::Composer;
use super::language;
use super::layout::{Layout, Relation, Row, Sign};
use super::order::Side;
use symbolic::{Edge, Expr, Node, Rational};

/// Longer chains end with an ellipsis.
const ROWS: usize = 40;

impl Composer<'_> {
    /// The chain `then where guard >= 0, otherwise ...` as rows. Two rows both show their condition; a longer chain ends with
    /// "otherwise".
    pub fn switch(&mut self, e: Expr) -> Layout {
        let graph = self.graph;
        let mut rows = vec![];
        let mut last = e;
        let mut only = None;
        while let Node::Switch { guard, edge, then, otherwise } = graph.node(last) {
            if rows.len() == ROWS {
                rows.push(Row { value: Layout::Words("…".into()), condition: Layout::Words("…".into()) });
                return Layout::Cases(rows);
            }
            let relation = if *edge == Edge::Open { Relation::Greater } else { Relation::GreaterEqual };
            let value = self.compose(*then, Sign::Plus, Side::Plain);
            rows.push(Row { value, condition: self.condition(*guard, relation) });
            only = Some((*guard, relation));
            last = *otherwise;
        }
        let condition = match only {
            Some((guard, relation)) if rows.len() == 1 => self.condition(guard, relation.opposite()),
            _ => Layout::Words(language::otherwise(self.printer.language).into()),
        };
        rows.push(Row { value: self.compose(last, Sign::Plus, Side::Plain), condition });
        Layout::Cases(rows)
    }

    /// guard relation 0, with the negative terms moved to the right and what moves kept on the left: `t < 10`.
    fn condition(&mut self, guard: Expr, relation: Relation) -> Layout {
        let zero = Layout::digits("0");
        let (left, relation, right) = match self.sides(guard) {
            Some((left, right, false)) => (left, relation, right),
            Some((left, right, true)) => (right, relation.mirrored(), left),
            None => match self.compose(guard, Sign::Plus, Side::Plain) {
                Layout::Sum(terms) if terms.iter().all(|t| t.0 == Sign::Minus) => {
                    (self.compose(guard, Sign::Minus, Side::Plain), relation.mirrored(), zero)
                }
                whole => (whole, relation, zero),
            },
        };
        Layout::Related(Box::new(left), relation, Box::new(right))
    }

    /// The positive and the negated negative terms of a sum with both, and whether the negative ones belong on the left.
    fn sides(&mut self, guard: Expr) -> Option<(Layout, Layout, bool)> {
        let graph = self.graph;
        let Node::Sum { constant, terms } = graph.node(guard) else { return None };
        let (mut sides, mut classes) = ([vec![], vec![]], [None, None]);
        let ordered: Vec<(Expr, Rational)> = terms.to_vec();
        let mut keyed: Vec<_> = ordered.iter().map(|(t, f)| (self.survey.term_key(*t, Side::Plain), *t, f.clone())).collect();
        keyed.sort_by(|a, b| a.0.cmp(&b.0));
        if !constant.is_zero() {
            sides[usize::from(constant.is_negative())].push((Sign::Plus, self.number(constant)));
        }
        for (_, term, factor) in keyed {
            let i = usize::from(factor.is_negative());
            classes[i] = classes[i].max(Some(self.survey.traits(term).class));
            let factors = match graph.node(term) {
                Node::Product { factors, .. } => factors.to_vec(),
                _ => vec![(term, Rational::ONE)],
            };
            sides[i].push(self.product(&factor.abs(), &factors));
        }
        let [positive, negative] = sides;
        if positive.is_empty() || negative.is_empty() {
            return None;
        }
        let swap = classes[1] > classes[0];
        Some((total(positive), total(negative), swap))
    }
}

fn total(mut terms: Vec<(Sign, Layout)>) -> Layout {
    match &terms[..] {
        [(Sign::Plus, _)] => terms.remove(0).1,
        _ => Layout::Sum(terms),
    }
}
