//! The numbers of a frame in the machine for other values of the parameters that they follow from: whoever gives such a parameter another value gets M, K
//! and the shares of the loads of the frame as it is then, not those of the file's own values.
//!
//! Which coordinates stand for the frame, and where its matrices have zeros, was settled for the values of the file. [`Form::Own`] writes only what is not zero
//! there, as a page shows it; [`Form::Followed`] has a parameter for every number, so that what vanishes or is 1 for one value may be anything for another.

use super::bind::bind;
use super::coordinates::{condensation, coordinates};
use super::figures::figures;
use algebra::arrange::Arrange;
use mechanics::Model;
use mechanics::model::ParameterValue;
use mechanics::structure as file;
use std::sync::Arc;
use structures::substructure::Substructure;
use symbolic::{Expr, Mounted, SymbolId};
use words::{Message, Text};

/// Difference of two values of a number of the frame, relative to them, that is rounding: solutions of the frame carry thirteen digits, and cancel to eleven.
const SAME: f64 = 1e-11;

/// Which numbers of a frame become parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Entries of M and K that are not zero.
    Own,
    /// All numbers.
    Followed,
}

/// A number of the frame: its value for the file's own values, and the parameter that holds it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slot {
    pub(super) value: f64,
    pub(super) symbol: Option<SymbolId>,
}

/// The file that a model was read from, where numbers alone do not give the model with other values.
pub trait Again: std::fmt::Debug + Send + Sync {
    /// Values set from outside.
    fn overrides(&self) -> &[(String, String)];

    /// Its model with other ones.
    ///
    /// *Errors*: the first finding.
    fn read(&self, overrides: &[(String, String)]) -> Result<Model, Box<Message>>;
}

/// The frame of a model whose numbers stand in the machine.
#[derive(Debug)]
pub struct Renewal {
    model: Model,
    again: Arc<dyn Again>,
    reach: Vec<SymbolId>,
    home: Option<Substructure>,
    slots: Vec<Slot>,
    numbers: Vec<SymbolId>,
}

impl Renewal {
    /// Of the model as it was before its frame became part of it; none where nothing of the frame follows from a parameter.
    pub(super) fn of(model: Model, home: Option<Substructure>, slots: Vec<Slot>, again: &Arc<dyn Again>) -> Option<Renewal> {
        let reach = reach(&model, model.structure.as_ref()?);
        let numbers = slots.iter().filter_map(|s| s.symbol).collect();
        (!reach.is_empty()).then(|| Renewal { model, again: Arc::clone(again), reach, home, slots, numbers })
    }

    fn name(&self, symbol: SymbolId) -> &str {
        &self.model.graph.symbol_info(symbol).name
    }

    /// The model with other values of the parameters.
    fn with(&self, values: &[f64]) -> Result<Model, Box<Message>> {
        let pairs: Vec<(&str, f64)> = self.reach.iter().zip(values).map(|(s, v)| (self.name(*s), *v)).collect();
        if let Some(change) = self.model.change(&pairs).filter(|change| self.model.allows(change)) {
            let mut model = self.model.clone();
            model.put(&change, &|_, _| String::new());
            return Ok(model);
        }
        let own = |name: &str| self.model.parameters.iter().find(|p| p.name == name);
        let mut overrides = self.again.overrides().to_vec();
        for (name, value) in &pairs {
            let Some(declared) = own(name).filter(|p| p.number != Some(*value)) else { continue };
            let unit = if self.model.scaled.contains_key(*name) { declared.unit.as_str() } else { "" };
            overrides.retain(|(n, _)| n != name);
            overrides.push(((*name).to_owned(), format!("{value:e} {unit}").trim_end().to_owned()));
        }
        self.again.read(&overrides)
    }

    fn refused(&self, values: &[(&str, f64)], why: &Text) -> Box<Message> {
        let own = |name: &str| self.model.parameters.iter().find(|p| p.name == name).and_then(|p| p.number);
        let changed: Vec<&(&str, f64)> = values.iter().filter(|(name, v)| own(name) != Some(*v)).collect();
        let list = |mark: fn(&Text) -> &str| {
            changed.iter().map(|(name, v)| format!("{name} = {}", mark(&words::digits::number(*v)))).collect::<Vec<_>>().join(", ")
        };
        let [en, ru] = [list(|t| &t.en), list(|t| &t.ru)];
        Box::new(Message {
            code: "S096",
            what: Text::new(format!("the frame cannot be followed to {en}"), format!("раму нельзя проследить до значений {ru}")),
            why: why.clone(),
            help: Text::new(
                "let `sweep` run the study for each value: it makes the frame anew every time",
                "повторите расчёт для каждого значения с помощью `sweep`: рама тогда каждый раз составляется заново",
            ),
        })
    }
}

impl Mounted for Renewal {
    fn reach(&self) -> &[SymbolId] {
        &self.reach
    }

    fn numbers(&self) -> &[SymbolId] {
        &self.numbers
    }

    fn renewed(&self, values: &[f64]) -> Result<Vec<f64>, Box<Message>> {
        let pairs: Vec<(&str, f64)> = self.reach.iter().zip(values).map(|(s, v)| (self.name(*s), *v)).collect();
        let model = self.with(values)?;
        let Some(structure) = model.structure.clone() else { return Err(self.refused(&pairs, &other())) };
        let mut bound = bind(&model, &structure);
        let found = coordinates(&model, &structure, &mut bound).map_err(|fault| words::Notice::from(fault).message)?;
        let (mut found, home) = match (found, &self.home) {
            (Some(found), Some(home)) if found.named == home.named && found.amplitudes == home.amplitudes => (found, home),
            (None, None) => return Ok(Vec::new()),
            _ => return Err(self.refused(&pairs, &other())),
        };
        found.align(home);
        // exact numbers are for pages
        bound.exact = None;
        let list = figures(&model, &structure, (&bound, &found), condensation(&structure)).flat();
        self.compared(list).ok_or_else(|| self.refused(&pairs, &elsewhere()))
    }
}

impl Renewal {
    /// The numbers that have parameters; none where one that has none is another.
    fn compared(&self, list: Vec<f64>) -> Option<Vec<f64>> {
        let mut fixed = self.slots.iter().zip(&list).filter(|(slot, _)| slot.symbol.is_none());
        let stays = fixed.all(|(slot, v)| (v - slot.value).abs() <= SAME * slot.value.abs().max(v.abs()));
        let numbers = self.slots.iter().zip(&list).filter(|(slot, _)| slot.symbol.is_some()).map(|(_, v)| *v);
        (list.len() == self.slots.len() && stays).then(|| numbers.collect())
    }
}

fn other() -> Text {
    Text::new(
        "with these values other coordinates, or another number of them, stand for the frame than with those of the file",
        "при этих значениях раму представляют другие координаты или другое их число, чем при значениях из файла",
    )
}

fn elsewhere() -> Text {
    Text::new(
        "with these values coordinates of the frame are coupled that are free of each other with those of the file, or its loads act on them in another way",
        "при этих значениях связаны координаты рамы, независимые при значениях из файла, или нагрузки действуют на них иначе",
    )
}

/// Parameters with a number of their own that the numbers of a frame follow from. The values of loads are formulas of the machine and follow by themselves.
fn reach(model: &Model, structure: &file::Structure) -> Vec<SymbolId> {
    let mut open = model.graph.symbols_in(&expressions(structure));
    let mut list = Vec::new();
    let mut seen = open.clone();
    while let Some(symbol) = open.pop() {
        match model.parameters.iter().find(|p| p.symbol == symbol).map(|p| p.value) {
            Some(ParameterValue::Number { .. }) => list.push(symbol),
            Some(ParameterValue::Formula(formula)) => {
                let new: Vec<SymbolId> = model.graph.symbols_in(&[formula]).into_iter().filter(|s| !seen.contains(s)).collect();
                seen.extend(&new);
                open.extend(new);
            }
            None => {}
        }
    }
    // in the order of the file
    list.arrange_by_key(|s| model.parameters.iter().position(|p| p.symbol == *s));
    list
}

/// What the numbers of a frame are made of. No field is left unnamed, so that a new one is thought of here.
fn expressions(structure: &file::Structure) -> Vec<Expr> {
    let file::Structure { nodes, rods, supports, displacements, loads, rayleigh: _, options: _, kept: _ } = structure;
    let mut list = Vec::new();
    for file::Node { name: _, at, mass, inertia, springs, span: _ } in nodes {
        list.extend(at.iter().chain([mass, inertia]).chain(springs));
    }
    for rod in rods {
        let file::Rod { name: _, ends: _, length, rigid: _, bending, axial, mass, rotary, .. } = rod;
        list.extend([length, mass, rotary].into_iter().chain(bending).chain(axial));
    }
    list.extend(supports.iter().map(|s| s.angle));
    let site = |site: &file::Site| match site {
        file::Site::Node(_) => None,
        file::Site::Rod(_, distance) => Some(*distance),
    };
    for file::Displacement { name: _, label: _, site: at, direction, loaded: _ } in displacements {
        list.extend(site(at));
        match direction {
            file::Direction::Along(vector) => list.extend(vector),
            file::Direction::Turn => {}
        }
    }
    for load in loads {
        match &load.action {
            file::Action::Point { site: at, value: _ } => list.extend(site(at)),
            file::Action::Distributed { rod: _, value: _ } => {}
        }
    }
    list
}
