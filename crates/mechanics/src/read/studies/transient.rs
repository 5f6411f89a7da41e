//! The study `transient`: the motion of a linear system in closed form. Its keys are those of `simulate`, and `linearise`.

use super::simulate::simulate;
use crate::model::{StudyKind, Transient};
use crate::read::reader::{Fields, Reader, wrong_type};

pub(super) fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<StudyKind> {
    let linearise = match fields.get("linearise").map(|v| (v.get_ref().as_bool(), v)) {
        Some((None, value)) => {
            reader.fault(wrong_type(value.span(), "true or false", "true или false", value.get_ref().type_str()));
            false
        }
        found => found.and_then(|f| f.0).unwrap_or(false),
    };
    let motion = simulate(reader, fields, "transient")?;
    Some(StudyKind::Transient(Transient { motion, linearise }))
}
