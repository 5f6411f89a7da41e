//! `[unknowns]`: parameters that statics decide.

use super::reader::{Fields, Reader, short};
use crate::fault::Fault;
use crate::model::{Class, ParameterDecl, ParameterValue};
use symbolic::SymbolId;

/// The symbols of the unknowns; one that the command line sets is known.
pub(super) fn check<'a>(reader: &mut Reader<'a>, top: &Fields<'a>, parameters: &[ParameterDecl]) -> Vec<SymbolId> {
    let mut found = Vec::new();
    for (name, span, _) in top.rows(reader, "unknowns") {
        let Some(p) = parameters.iter().find(|p| p.name == name) else { continue };
        if reader.override_of(name).is_some() {
            continue;
        }
        if p.class == Class::Constant && matches!(p.value, ParameterValue::Number { .. }) {
            found.push(p.symbol);
            continue;
        }
        reader.fault(
            Fault::new(
                "M094",
                span,
                format!("the guess of `{}` is a formula", short(name)),
                format!("приближение для `{}` — формула", short(name)),
            )
            .why("an unknown is a number, and its guess one too", "неизвестное — число, и приближение к нему тоже")
            .help("write a quantity: M = \"2 N m\"", "запишите величину: M = \"2 Н м\""),
        );
    }
    found
}
