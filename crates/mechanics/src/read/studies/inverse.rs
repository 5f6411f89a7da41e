//! The study `inverse`: the keys of `simulate`; the motion is prescribed by `[motions]`, the motors' forces are what is found.

use super::simulate::simulate;
use crate::model::StudyKind;
use crate::read::reader::{Fields, Reader};

pub(super) fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<StudyKind> {
    simulate(reader, fields, "inverse").map(StudyKind::Inverse)
}
