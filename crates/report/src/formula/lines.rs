//! Breaking a long formula: at the relation and at top-level signs, the sign repeated at the start of the next line (GOST 7.32).

use super::layout::{Layout, Relation, Sign};
use super::text;

/// What joins a piece to the one before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Joint {
    Start,
    Sign(Sign),
    Relation(Relation),
}

/// A term with what joins it and its own leading minus, if it starts a side.
#[derive(Clone, Debug)]
pub(super) struct Piece<'a> {
    pub joint: Joint,
    pub minus: bool,
    pub body: &'a Layout,
}

/// A formula as lines of pieces.
#[derive(Clone, Debug)]
pub(super) struct Lines<'a> {
    pub rows: Vec<Vec<Piece<'a>>>,
}

impl Lines<'_> {
    /// Index of the relation in the first line, where the following lines are aligned.
    pub fn relation(&self) -> Option<usize> {
        self.rows[0].iter().position(|p| matches!(p.joint, Joint::Relation(_)))
    }
}

/// Fills lines up to `width` characters of the text form; a single term is never broken.
pub(super) fn split(layout: &Layout, width: Option<usize>) -> Lines<'_> {
    let mut pieces = vec![];
    match layout {
        Layout::Related(left, relation, right) => {
            side(left, Joint::Start, &mut pieces);
            side(right, Joint::Relation(*relation), &mut pieces);
        }
        other => side(other, Joint::Start, &mut pieces),
    }
    let Some(width) = width else { return Lines { rows: vec![pieces] } };
    let mut rows: Vec<Vec<Piece>> = vec![vec![]];
    let mut used = 0;
    for piece in pieces {
        let length = text::piece_length(&piece);
        // two more for the sign repeated at the end of the line
        if used + length + 2 > width && used > 0 {
            rows.push(vec![]);
            used = text::INDENT.len();
        }
        used += length;
        if let Some(row) = rows.last_mut() {
            row.push(piece);
        }
    }
    Lines { rows }
}

fn side<'a>(layout: &'a Layout, joint: Joint, pieces: &mut Vec<Piece<'a>>) {
    match layout {
        Layout::Sum(terms) => {
            for (i, (sign, body)) in terms.iter().enumerate() {
                if i == 0 {
                    pieces.push(Piece { joint, minus: *sign == Sign::Minus, body });
                } else {
                    pieces.push(Piece { joint: Joint::Sign(*sign), minus: false, body });
                }
            }
        }
        other => pieces.push(Piece { joint, minus: false, body: other }),
    }
}
