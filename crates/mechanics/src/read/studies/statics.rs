//! The study `statics`: no keys of its own.

use crate::model::StudyKind;
use crate::read::reader::{Fields, Reader};

pub(super) fn read<'a>(_: &mut Reader<'a>, _: &Fields<'a>) -> Option<StudyKind> {
    Some(StudyKind::Statics)
}
