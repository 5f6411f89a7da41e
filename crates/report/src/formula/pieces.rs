//! A formula as lines of pieces.

use super::layout::{Layout, Relation, Sign};

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

impl Piece<'_> {
    /// What joins it, for a typesetting system with names of its own for relations; empty at the start of a side.
    pub fn joint_in_ascii(&self, relation_of: fn(Relation) -> &'static str) -> &'static str {
        match self.joint {
            Joint::Start => "",
            Joint::Sign(sign) => sign.ascii(),
            Joint::Relation(relation) => relation_of(relation),
        }
    }

    /// Writes it with what joins it and its own minus.
    pub fn write_in_ascii(&self, relation_of: fn(Relation) -> &'static str, body: fn(&Layout, &mut String), out: &mut String) {
        let joint = self.joint_in_ascii(relation_of);
        out.push_str(joint);
        if !joint.is_empty() {
            out.push(' ');
        }
        if self.minus {
            out.push('-');
        }
        body(self.body, out);
    }
}

impl Lines<'_> {
    /// Index of the relation in the first line, where the following lines are aligned.
    pub fn relation(&self) -> Option<usize> {
        self.rows[0].iter().position(|p| matches!(p.joint, Joint::Relation(_)))
    }
}
