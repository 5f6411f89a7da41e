//! Breaking a long formula: at the relation and at top-level signs, the sign repeated at the start of the next line (GOST 7.32).

use super::layout::{Layout, Sign};
use super::pieces::{Joint, Lines, Piece};
use super::text;

/// How a written form counts room, in characters of the text form.
#[derive(Clone, Copy)]
pub(super) struct Room {
    /// Room of a piece with what joins it.
    pub piece: fn(&Piece) -> usize,
    /// Whether following lines start at the relation of the first line, not at its left edge.
    pub aligned: bool,
}

/// The sides of a = b = c, so that a chain is broken at any of its relations.
fn chained<'a>(layout: &'a Layout, pieces: &mut Vec<Piece<'a>>) {
    match layout {
        Layout::Related(left, relation, right) => {
            chained(left, pieces);
            side(right, Joint::Relation(*relation), pieces);
        }
        other => side(other, Joint::Start, pieces),
    }
}

/// Fills lines up to `width`; a single term is never broken. A formula that needs several lines is broken at its relation first,
/// unless the left side is a short name.
pub(super) fn split<'a>(layout: &'a Layout, width: Option<usize>, room: Room) -> Lines<'a> {
    let mut pieces = vec![];
    match layout {
        Layout::Related(left, relation, right) => {
            chained(left, &mut pieces);
            side(right, Joint::Relation(*relation), &mut pieces);
        }
        other => side(other, Joint::Start, &mut pieces),
    }
    let Some(width) = width else { return Lines { rows: vec![pieces] } };
    let lengths: Vec<usize> = pieces.iter().map(room.piece).collect();
    if lengths.iter().sum::<usize>() <= width {
        return Lines { rows: vec![pieces] };
    }
    let relation = pieces.iter().position(|p| matches!(p.joint, Joint::Relation(_)));
    let left: usize = lengths[..relation.unwrap_or(0)].iter().sum();
    let at_relation = relation.filter(|_| left > width / 4);
    let indent = text::INDENT.len() + if room.aligned && at_relation.is_none() { left } else { 0 };
    let mut rows: Vec<Vec<Piece>> = vec![vec![]];
    let mut used = 0;
    for (i, (piece, length)) in pieces.into_iter().zip(lengths).enumerate() {
        // two more for the sign repeated at the end of the line
        if used > 0 && (used + length + 2 > width || at_relation == Some(i)) {
            rows.push(vec![]);
            used = indent;
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
