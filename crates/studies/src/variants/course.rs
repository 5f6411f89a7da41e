//! A class: one machine that gets the values of one variant after the other. Where only numbers change nothing is read or derived again.

use crate::STUDIES;
use crate::failure::Failure;
use crate::machine::Machine;
use crate::machine::bind::Origin;
use crate::source::Source;
use crate::watch::Watch;
use mechanics::derive::Detail;
use mechanics::model::Variants;
use mechanics::variants::{Given, after_formulas, si};
use words::Notice;

/// One variant: what it is called and what it replaces.
#[derive(Clone, Debug, Default)]
pub struct Member {
    /// Name: `7`.
    pub name: String,
    /// Values in place of those of the file, as `--set` takes them.
    pub overrides: Vec<(String, String)>,
    /// Group, number and columns of the table; the values are those of the cells.
    pub given: Given,
}

/// Columns that only formulas use, with their values, SI.
type Helpers = Vec<(symbolic::SymbolId, f64)>;

impl Member {
    /// A variant from the cells of its row, or from none, with the formulas of the file. `place` says where the row stands.
    ///
    /// # Errors
    /// A formula has no value, or needs a cell that is no number (C022), or the number of the group (C068).
    pub fn new(
        model: &mechanics::Model,
        variants: &Variants,
        name: &str,
        (cells, helpers, number): (Vec<(String, String)>, Helpers, f64),
        group: Option<u32>,
    ) -> Result<Member, Notice> {
        let group = group.or(variants.group);
        if group.is_none() && variants.needs_group(&|e, s| model.graph.contains(e, |own| own == s)) {
            return Err(no_group());
        }
        let mut given = Given { values: Vec::new(), helpers, group: group.map(f64::from), number };
        for (column, text) in &cells {
            match si(model, column, text) {
                Some(value) => given.values.push((column.clone(), value)),
                None if variants.formulas.is_empty() => {}
                None => return Err(no_number(name, column, text)),
            }
        }
        let mut overrides = numbered(variants, &cells, &given);
        overrides.extend(cells);
        let made = after_formulas(model, variants, &given).map_err(|misfit| Notice::new("C022", misfit.what.en, misfit.what.ru))?;
        for ((name, value), formula) in made.into_iter().zip(&variants.formulas) {
            let unit = if formula.unit == "1" { "" } else { formula.unit.as_str() };
            overrides.retain(|(n, _)| *n != name);
            overrides.push((name, format!("{} {unit}", plain(value)).trim_end().to_owned()));
        }
        Ok(Member { name: name.to_owned(), overrides, given })
    }
}

/// The parameters that get the numbers of group and variant.
fn numbered(variants: &Variants, cells: &[(String, String)], given: &Given) -> Vec<(String, String)> {
    let free = |name: &&String| !cells.iter().any(|(column, _)| column == *name);
    let number = variants.number.as_ref().filter(free).map(|name| (name.clone(), plain(given.number)));
    let group = variants.group_parameter.as_ref().filter(free).zip(given.group).map(|(name, n)| (name.clone(), plain(n)));
    number.into_iter().chain(group).collect()
}

/// Digits to which sums of decimals are what a person would write: 0.08 + 0.029 is 0.109.
const CLEAN: usize = 14;

/// A number as people write it; the last digit of a sum of short decimals is that of the sum, not of its rounding.
pub(super) fn plain(value: f64) -> String {
    let clean: f64 = format!("{value:.*e}", CLEAN - 1).parse().unwrap_or(value);
    let short = |x: f64| {
        let (plain, scientific) = (format!("{x}"), format!("{x:e}"));
        if plain.len() <= scientific.len() + 4 { plain } else { scientific }
    };
    let (own, clean) = (short(value), short(clean));
    if clean.len() + 4 <= own.len() { clean } else { own }
}

/// The machine of a class.
#[derive(Debug)]
pub struct Class {
    source: Source,
    detail: Detail,
    machine: Option<Machine>,
    /// How often the file was read.
    pub readings: usize,
}

impl Class {
    /// A class of a file.
    pub fn new(source: Source, detail: Detail) -> Class {
        Class { source, detail, machine: None, readings: 0 }
    }

    /// The machine with the values of a variant.
    ///
    /// # Errors
    /// Findings about the model with these values.
    pub fn machine(&mut self, member: &Member) -> Result<&mut Machine, Failure> {
        if self.bound(member)?.is_none() {
            let origin = Origin { source: self.source.clone(), overrides: member.overrides.clone(), studies: &STUDIES };
            self.readings += 1;
            self.machine = Some(crate::machine::build(origin, self.detail, &mut Watch::default())?);
        }
        let machine = self.machine.as_mut().ok_or_else(|| Notice::new("C022", "no machine", "нет машины"))?;
        // every machine has its values in the same writing, however it came by them
        machine.origin.overrides.clone_from(&member.overrides);
        machine.model_hash = self.source.hash(&member.overrides);
        for p in &mut machine.equations.parameters {
            let name = &machine.equations.graph.symbol_info(p.symbol).name;
            if let Some((_, text)) = member.overrides.iter().find(|(n, _)| n == name) {
                p.written.clone_from(text);
            }
        }
        Ok(machine)
    }

    /// None where the file has to be read.
    fn bound(&mut self, member: &Member) -> Result<Option<()>, Failure> {
        let Some(machine) = &mut self.machine else { return Ok(None) };
        let names = |list: &[(String, String)]| list.iter().map(|(n, _)| n.clone()).collect::<std::collections::BTreeSet<_>>();
        if names(&machine.origin.overrides) != names(&member.overrides) {
            return Ok(None);
        }
        let number = |(name, text): &(String, String)| Some((name.clone(), si(&machine.model, name, text)?));
        let Some(values) = member.overrides.iter().map(number).collect::<Option<Vec<_>>>() else { return Ok(None) };
        let values: Vec<(&str, f64)> = values.iter().map(|(name, value)| (name.as_str(), *value)).collect();
        machine.bound(&values).transpose()
    }
}

fn no_group() -> Notice {
    Notice::new("C068", "which group?", "какая группа?")
        .why("the data depend on the number n of the group", "данные зависят от номера группы n")
        .help("add --group 3, or n = 3 under [variants]", "добавьте --group 3 или n = 3 в [variants]")
}

fn no_number(variant: &str, column: &str, text: &str) -> Notice {
    Notice::new(
        "C022",
        format!("variant {variant}, column `{column}`: `{text}` is no number of this quantity"),
        format!("вариант {variant}, столбец `{column}`: `{text}` — не число для этой величины"),
    )
    .help("formulas of variants need numbers in the cells", "формулам вариантов нужны числа в клетках")
}
