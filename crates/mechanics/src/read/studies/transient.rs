//! The study `transient`: the motion of a linear system in closed form. Its keys are those of `simulate`.

use super::simulate::simulate;
use crate::model::StudyKind;
use crate::read::reader::{Fields, Reader};

pub(super) fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<StudyKind> {
    simulate(reader, fields, "transient").map(StudyKind::Transient)
}
