//! Which load a name means: names are free in each table of the file, so that a force, a torque and a coordinate may share one.

use super::Small;
use analysis::Fault;
use mechanics::Model;
use words::Text;

/// What a name means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meant {
    /// A unit load on the coordinate of this index.
    Coordinate(usize),
    /// The load of this index of the equations.
    Load(usize),
}

/// The load of a bare name (`f`) or of one with its table (`forces.f`, `coordinates.f`).
///
/// # Errors
/// S030 nothing has that name; S095 several have it.
pub fn named(model: &Model, small: &Small, name: &str) -> Result<Meant, Fault> {
    let all = offered(model, small);
    let bare = |path: &str| path.rsplit_once('.').map_or(path, |(_, bare)| bare) == name;
    let found: Vec<&(String, Meant)> = match all.iter().find(|(path, _)| path == name) {
        Some(whole) => vec![whole],
        None => all.iter().filter(|(path, _)| bare(path)).collect(),
    };
    match found[..] {
        [(_, meant)] => Ok(*meant),
        [] => Err(unknown(name, &all)),
        _ => Err(analysis::fault::loads::shared(name, &found.iter().map(|(path, _)| path.clone()).collect::<Vec<_>>())),
    }
}

/// Loads, then coordinates, each with its table.
fn offered(model: &Model, small: &Small) -> Vec<(String, Meant)> {
    let is_displacement = |name: &str| model.structure.as_ref().is_some_and(|s| s.displacements.iter().any(|d| d.name == name));
    let coordinate = |name: &str| format!("{}.{name}", if is_displacement(name) { "displacements" } else { "coordinates" });
    let loads = small.machine.equations().applied.iter().enumerate().map(|(k, a)| (a.path.clone(), Meant::Load(k)));
    let coordinates = small.machine.coordinates().iter().enumerate().map(|(i, q)| (coordinate(&q.name), Meant::Coordinate(i)));
    loads.chain(coordinates).collect()
}

/// The bare names where they say enough.
fn unknown(name: &str, all: &[(String, Meant)]) -> Fault {
    let bare = |path: &str| path.rsplit_once('.').map_or(path, |(_, bare)| bare).to_owned();
    let shared = |path: &str| all.iter().filter(|(other, _)| bare(other) == bare(path)).count() > 1;
    let names: Vec<String> = all.iter().map(|(path, _)| if shared(path) { path.clone() } else { bare(path) }).collect();
    let what = Text::new(format!("there is no load `{name}`"), format!("нет нагрузки `{name}`"));
    Fault::unknown(what, &names)
}
