//! What excites a machine in the study `response`, and the parameter that is its frequency.

use crate::machine::Machine;
use crate::small::Small;
use crate::small::asked::Response as Study;
use crate::small::load::{self, Meant};
use analysis::Fault;
use analysis::linear::LoadParts;
use analysis::studies::response::{self as forced, Source};
use symbolic::equations::Applied;
use symbolic::{Expr, SymbolId};
use words::Text;

/// The load and the parameter that is its frequency.
pub(super) fn source(machine: &Machine, study: &Study, small: &mut Small) -> Result<(Source, Option<usize>), Fault> {
    let Some(name) = &study.load else {
        if small.machine.timing().frozen {
            return Err(forced::no_period());
        }
        let linear = small.machine.linear();
        let waves = linear.loads.iter().map(|l| l.rate);
        let rates: Vec<Expr> = waves.chain(linear.shaped.iter().map(|(form, _)| linear.forms[*form].wave.rate)).collect();
        return Ok((Source::OfEquations, choose(study, small, &rates)?));
    };
    let equations = small.machine.equations().clone();
    let applied = match load::named(&machine.model, small, name)? {
        Meant::Coordinate(i) => return Ok((Source::Unit(i), chosen(study, small)?)),
        Meant::Load(k) => &equations.applied[k],
    };
    let Some((mean, waves, shaped)) = small.machine.harmonics_of(&applied.forces)? else { return Err(forced::no_period()) };
    if waves.is_empty() && shaped.is_empty() {
        // a constant force takes any frequency with its value as amplitude
        let sines = small.machine.zeros();
        let values = mean.into_iter().chain(sines).take(small.machine.coordinates().len()).collect();
        return Ok((Source::Constant(values, parts(applied)), chosen(study, small)?));
    }
    let linear = small.machine.linear();
    let rates = waves.iter().map(|l| l.rate).chain(shaped.iter().map(|(form, _)| linear.forms[*form].wave.rate));
    let parameter = choose(study, small, &rates.collect::<Vec<_>>())?;
    Ok((Source::Given { waves, shaped, parts: parts(applied) }, parameter))
}

fn parts(applied: &Applied) -> LoadParts {
    LoadParts { forces: applied.forces.clone(), released: applied.released.clone() }
}

/// The parameter that sets the rates of the loads.
fn choose(study: &Study, small: &Small, rates: &[Expr]) -> Result<Option<usize>, Fault> {
    // what supports alone bear may still show in their reactions, at the frequency that is named
    if rates.is_empty() {
        return chosen(study, small);
    }
    let mut all: Vec<usize> = rates.iter().flat_map(|r| parameters_of(small, *r)).collect();
    all.sort_unstable();
    all.dedup();
    let parameters = small.machine.parameters();
    if let Some(name) = &study.frequency {
        let wanted = small.machine.parameter(name).filter(|p| all.contains(p));
        let names: Vec<String> = all.iter().map(|p| parameters[*p].name.clone()).collect();
        let what = Text::new(format!("no load has the frequency `{name}`"), format!("нет нагрузки с частотой `{name}`"));
        return wanted.map(Some).ok_or_else(|| Fault::unknown(what, &names));
    }
    match all[..] {
        [] => Ok(None),
        [only] => Ok(Some(only)),
        _ => Err(forced::ambiguous(&all.iter().map(|p| parameters[*p].name.clone()).collect::<Vec<_>>())),
    }
}

/// The parameter that a load of any frequency follows, where one is named.
fn chosen(study: &Study, small: &Small) -> Result<Option<usize>, Fault> {
    let Some(name) = &study.frequency else { return Ok(None) };
    let names: Vec<String> = small.machine.parameters().iter().map(|p| p.name.clone()).collect();
    let what = Text::new(format!("there is no parameter `{name}`"), format!("нет параметра `{name}`"));
    small.machine.parameter(name).map(Some).ok_or_else(|| Fault::unknown(what, &names))
}

/// Parameters that a rate depends on, through definitions too.
fn parameters_of(small: &Small, rate: Expr) -> Vec<usize> {
    let linear = small.machine.linear();
    let equations = small.machine.equations();
    let mut open: Vec<SymbolId> = linear.graph.symbols_in(&[rate]);
    let mut found = Vec::new();
    while let Some(symbol) = open.pop() {
        if let Some(i) = equations.parameters.iter().position(|p| p.symbol == symbol) {
            found.push(i);
        } else if let Some((_, formula)) = linear.definitions.iter().find(|(s, _)| *s == symbol) {
            open.extend(linear.graph.symbols_in(&[*formula]));
        }
    }
    found.sort_unstable();
    found.dedup();
    found
}

pub(super) fn load_name(machine: &Machine, study: &Study, small: &Small, (source, parameter): (&Source, Option<usize>)) -> Text {
    let frequency = parameter.map(|p| small.machine.parameters()[p].symbol.as_str());
    match (source, &study.load, frequency) {
        (Source::Unit(_), Some(name), _) => Text::new(format!("unit load on {name}"), format!("единичная нагрузка по {name}")),
        (_, Some(name), _) => {
            // `P`, or `forces.P` where two tables have it
            let meant = |path: &str| path == name || path.split_once('.').is_some_and(|(_, own)| own == name);
            let labelled = machine.model.elements.iter().find(|e| meant(&e.path) && !e.label.en.is_empty());
            labelled.map_or_else(
                || Text::same(name.clone()),
                |e| Text::new(format!("{} ({name})", e.label.en), format!("{} ({name})", e.label.ru)),
            )
        }
        (_, None, Some(p)) => {
            let [en, ru] = [words::Language::En, words::Language::Ru].map(|language| report::symbol::plain(p, language));
            Text::new(format!("the loads whose frequency follows {en}"), format!("нагрузки, частота которых задана величиной {ru}"))
        }
        (_, None, None) => Text::new("the periodic loads", "периодические нагрузки"),
    }
}
