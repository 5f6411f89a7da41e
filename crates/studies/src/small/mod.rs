//! Small motions about an equilibrium: what the studies `modes` and `response` share.

pub mod asked;
pub mod bent;
pub mod beside;
pub mod equation;
mod figures;
pub mod formulas;
pub mod load;
pub mod modes;
mod remarks;
pub mod response;
pub mod show;
mod source;
mod strands;
mod touching;

use crate::Finds;
use crate::machine::Machine;
use algebra::arrange::Arrange;
use algebra::elementary;
use analysis::dataset::Column;
use analysis::fault::codes;
use analysis::linear::{LinearMachine, Place};
use analysis::rest::closed_contacts;
use analysis::rest::mean::Resting;
use analysis::rest::places::Place as Rest;
use analysis::studies::equilibrium::Equilibrium;
use analysis::studies::modes::{self as natural, Complex, Mode, Modes, Normalisation};
use analysis::studies::rest::branch::{Beyond, Branch};
use analysis::studies::rest::contacts::Contacts;
use analysis::studies::rest::degenerate::{degenerate, remark, rests_beside};
use analysis::studies::rest::stability::with_closed;
use analysis::studies::rest::{kinks, onesided};
use analysis::{Dataset, Fault, Quantity, System};
use std::sync::Arc;
use symbolic::connections::Law;
use symbolic::linear::{About, Timing};
use symbolic::{Equations, SymbolId};
use words::Text;

/// A contact that only touches.
#[derive(Clone, Debug)]
struct Touch {
    label: Text,
    /// Slopes of its gap by the coordinates.
    slopes: Vec<f64>,
}

/// Share of the terms of a gap's change along a shape below which the shape does not move the gap: far above the rounding of shapes, far below what moves.
const UNMOVED: f64 = 1e-9;

/// A machine linearised about a place.
#[derive(Clone, Debug)]
pub struct Small {
    /// The linear machine.
    pub machine: LinearMachine,
    /// About where.
    pub place: Place,
    /// Where rest is sought: at the guess of the study, else at the start, at the guesses of the file's equilibria, and at zero.
    pub starts: Vec<Vec<f64>>,
    /// One-sided contacts, where there are some.
    pub contacts: Option<Contacts>,
    /// Those that only touch at the place and keep its motions on one side.
    touching: Vec<Touch>,
}

impl Small {
    /// Whether the small motions go to both sides of the place: else they have no linear equations.
    ///
    /// # Errors
    /// S092.
    pub fn two_sided(&self) -> Result<(), Fault> {
        if self.touching.is_empty() { Ok(()) } else { Err(self.one_sided()) }
    }

    fn one_sided(&self) -> Fault {
        let labels: Vec<Text> = self.touching.iter().map(|touch| touch.label.clone()).collect();
        analysis::fault::small::one_sided(&labels)
    }

    /// Leaves the modes that move no gap of a contact that only touches: they go to both sides, and the contact takes no part in them. The others are no motions of
    /// linear equations.
    ///
    /// # Errors
    /// S092 where no mode is left.
    fn keep_two_sided(&self, found: &mut Modes) -> Result<(), Fault> {
        let moved = |touch: &Touch, part: fn(&Complex) -> f64, mode: &Mode| {
            let terms = || touch.slopes.iter().zip(&mode.shape).map(|(slope, x)| slope * part(x));
            let size = touch.slopes.iter().zip(&mode.shape).map(|(slope, x)| (slope * elementary::hypot(x.0, x.1)).abs()).sum::<f64>();
            terms().sum::<f64>().abs() > UNMOVED * size.max(largest_share(touch, mode))
        };
        let before = found.modes.len();
        found.modes.retain(|mode| !self.touching.iter().any(|touch| moved(touch, |x| x.0, mode) || moved(touch, |x| x.1, mode)));
        if self.touching.is_empty() || before == 0 {
            return Ok(());
        }
        if found.modes.is_empty() {
            return Err(self.one_sided());
        }
        let list = |pick: fn(&Text) -> &str| self.touching.iter().map(|touch| pick(&touch.label)).collect::<Vec<_>>().join("; ");
        let (en, ru, left) = (list(|t| &t.en), list(|t| &t.ru), before - found.modes.len());
        found.notes.push(Text::new(
            format!("contacts that only touch, pressed by no force ({en}): the modes are those that do not move their gaps; {left} that would move them are one-sided and left out"),
            format!("связи, которые лишь касаются и не нагружены ({ru}): приведены формы, не меняющие их зазоров; формы, меняющие зазоры ({left}), односторонние и не приведены"),
        ));
        Ok(())
    }

    /// Whether contacts only touch at the place.
    fn touches(&self) -> bool {
        !self.touching.is_empty()
    }

    /// The place of rest along a parameter.
    pub fn branch(&self, parameter: usize) -> Branch {
        Branch::new(&self.machine, parameter, &self.place, self.starts.clone()).with_contacts(self.contacts.clone(), Beyond::Followed)
    }
}

/// The largest slope times the largest entry of a shape: what a change of the gap is compared with where the shape has no part in it.
fn largest_share(touch: &Touch, mode: &Mode) -> f64 {
    let slope = touch.slopes.iter().fold(0.0_f64, |most, slope| most.max(slope.abs()));
    let entry = |i: usize, x: &Complex| if touch.slopes[i] == 0.0 { 0.0 } else { elementary::hypot(x.0, x.1) };
    slope * mode.shape.iter().enumerate().fold(0.0_f64, |most, (i, x)| most.max(entry(i, x)))
}

/// Linearises a machine about the equilibrium that is meant.
///
/// # Errors
/// No equilibrium is found, or formulas have no value there.
pub fn about_rest(machine: &Machine, guess: &[(SymbolId, f64)]) -> Result<Small, Fault> {
    if !analysis::studies::rest::report::is_free(&machine.equations) {
        return connected(machine, guess);
    }
    let mut linear = following(machine, machine.equations.clone())?;
    let start = machine.system.start()?;
    let starts = candidates(machine, &start, guess);
    let place = rest(&mut linear, &starts)?;
    Ok(Small { machine: linear, place, starts, contacts: None, touching: Vec::new() })
}

/// The equations linearised about rest; what nobody gives is found anew for other values of parameters.
fn following(machine: &Machine, equations: symbolic::Equations) -> Result<LinearMachine, Fault> {
    let linear = LinearMachine::new(&Arc::new(equations), About::Rest)?;
    Ok(match crate::machine::sought(machine) {
        Some(how) => linear.seeking(how),
        None => linear,
    })
}

/// The same with connections: at the places of rest that the study `equilibrium` finds, ropes and stops that are closed there as lasting connections.
fn connected(machine: &Machine, guess: &[(SymbolId, f64)]) -> Result<Small, Fault> {
    if machine.equations.conditions.iter().any(|c| c.reaction.is_none()) {
        return Err(analysis::linear::driven());
    }
    let start = machine.system.start()?;
    let resting = Resting::new(&machine.equations)?;
    let equations = resting.equations();
    let values: Vec<f64> = equations.parameters.iter().map(|p| p.value).collect();
    let guesses = candidates(machine, &start, guess);
    let options = Equilibrium { guesses: guesses.clone(), ..Equilibrium::default() };
    let mut found = analysis::rest::places::places(equations, &values, &start, &options)?.list;
    if !guess.is_empty() {
        let far = |q: &[f64]| q.iter().zip(&guesses[0]).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
        found.arrange_by(|a, b| far(&a.q).total_cmp(&far(&b.q)));
    }
    let mut first = None;
    for place in found {
        let (mut linear, at, touching, closed) = standing(machine, (equations, &values), &place)?;
        if !guess.is_empty() || stable(&mut linear, &at) {
            let reaction = |name: &str| {
                let r = equations.reactions.iter().position(|r| r.name == name);
                r.and_then(|r| place.reactions[r]).into_iter().collect()
            };
            if let Some(fault) = crate::strands::pushing(machine, reaction) {
                return Err(fault);
            }
            let contacts = Contacts::new(&machine.equations, &closed)?;
            return Ok(Small { machine: linear, place: at, starts: guesses, contacts, touching });
        }
        first.get_or_insert((linear, at, touching, closed));
    }
    let (mut linear, mut at, mut touching, closed) = first.ok_or_else(analysis::studies::equilibrium::no_equilibrium)?;
    let mut contacts = Contacts::new(&machine.equations, &closed)?;
    if let Some(place) = stable_below(&mut linear, (&at, &guesses), contacts.as_mut()) {
        at = place;
        touching.clear();
    }
    Ok(Small { machine: linear, place: at, starts: guesses, contacts, touching })
}

/// A machine about a place, the contacts that only touch there, and those that hold it.
type Standing = (LinearMachine, Place, Vec<Touch>, Vec<usize>);

/// The machine about a place of rest, with the contacts that press there as connections.
fn standing(machine: &Machine, (equations, values): (&Equations, &[f64]), place: &Rest) -> Result<Standing, Fault> {
    let onesided::Standing { pressing, touching } = onesided::standing(equations, values, place)?;
    let closed = if touching.is_empty() { place.closed.clone() } else { pressing };
    let mut linear = following(machine, with_closed(&machine.equations, &closed))?;
    let at = linear.about(place, equations);
    let bounds = !touching.is_empty() && onesided::bounds(&mut linear, &at, &touching)?;
    let touch = |(r, slopes): (usize, Vec<f64>)| Touch { label: equations.reactions[r].label.clone(), slopes };
    let touches = touching.into_iter().filter(|_| bounds).map(touch).collect();
    Ok((linear, at, touches, closed))
}

/// Linearises a machine about the motion that it has at the start.
///
/// # Errors
/// Formulas have no value there, or the mass matrix is singular.
pub fn about_start(machine: &Machine) -> Result<Small, Fault> {
    if machine.equations.conditions.iter().any(|c| c.reaction.is_none()) {
        return Err(analysis::linear::driven());
    }
    let start = machine.system.start()?;
    let n = machine.system.n_coordinates();
    let values: Vec<f64> = machine.equations.parameters.iter().map(|p| p.value).collect();
    let held = if machine.equations.reactions.is_empty() { Vec::new() } else { closed_contacts(&machine.equations, &start[..n], &values)? };
    let mut linear = LinearMachine::new(&Arc::new(with_closed(&machine.equations, &held)), About::Motion)?;
    let mut place = Place { rates: start[n..2 * n].to_vec(), ..Place::rest(&start[..n]) };
    if linear.linear().conditions.is_empty() {
        let there = linear.at(&place)?;
        natural::check_mass(&there.mass, n, linear.coordinates())?;
        if let Some(accelerations) = linear.steady(&place)? {
            place.accelerations = accelerations;
        }
    } else {
        place = linear.moving(&place)?;
    }
    Ok(Small { machine: linear, place, starts: Vec::new(), contacts: None, touching: Vec::new() })
}

/// From where rest is sought: the first stable equilibrium, or the first.
fn rest(linear: &mut LinearMachine, starts: &[Vec<f64>]) -> Result<Place, Fault> {
    let (mut first, mut fault) = (None, None);
    for candidate in starts {
        match linear.settle(candidate) {
            Ok(place) => {
                if stable(linear, &place) {
                    return Ok(place);
                }
                first.get_or_insert(place);
            }
            Err(error) => {
                fault.get_or_insert(error);
            }
        }
    }
    match (first, fault) {
        (Some(place), _) => Ok(stable_below(linear, (&place, starts), None).unwrap_or(place)),
        (None, Some(fault)) if fault.code == codes::NO_REST => fallen(linear, starts).ok_or(fault),
        (None, Some(fault)) => Err(fault),
        (None, None) => Err(analysis::studies::equilibrium::no_equilibrium()),
    }
}

/// Where Newton's method finds nothing: the stable place to which the machine falls from where it is sought.
fn fallen(linear: &mut LinearMachine, starts: &[Vec<f64>]) -> Option<Place> {
    let place = starts.iter().find_map(|start| analysis::studies::rest::fall::fall(linear, start).and_then(|q| linear.settle(&q).ok()))?;
    stable(linear, &place).then_some(place)
}

/// Where only unstable places are known: the stable one to which the machine falls from where it starts. A start that is the unstable place itself is meant, and a
/// guess is, too.
fn stable_below(linear: &mut LinearMachine, (place, starts): (&Place, &[Vec<f64>]), contacts: Option<&mut Contacts>) -> Option<Place> {
    let near = |q: &[f64]| q.iter().zip(&place.q).all(|(a, b)| (a - b).abs() <= MEANT * (1.0 + b.abs()));
    // the last one is zero, which no file has asked for
    let (_, own) = starts.split_last().filter(|(_, own)| !own.is_empty())?;
    if own.iter().any(|q| near(q)) {
        return None;
    }
    let found = fallen(linear, own)?;
    let admitted = match contacts {
        Some(contacts) => contacts.margins(linear, &found).is_ok_and(|list| !list.iter().any(|m| m.is_violated())),
        None => true,
    };
    admitted.then_some(found)
}

/// Distance of a start from a place, relative or in its unit, that counts as none.
const MEANT: f64 = 1e-6;

/// Where to look for rest: at the guess of the study, else at the start, at the guesses of the file's equilibria, and at zero.
fn candidates(machine: &Machine, start: &[f64], guess: &[(SymbolId, f64)]) -> Vec<Vec<f64>> {
    let n = machine.equations.coordinates.len();
    let from = |guess: &[(SymbolId, f64)]| crate::plan::guessed(&machine.equations, start, guess);
    if !guess.is_empty() {
        return vec![from(guess)];
    }
    let guessed =
        machine.model.studies.iter().filter(|asked| machine.origin.studies.finds(asked.kind) == Finds::Rest && !asked.guess().is_empty());
    let guesses = guessed.map(|asked| from(asked.guess()));
    std::iter::once(start[..n].to_vec()).chain(guesses).chain([vec![0.0; n]]).collect()
}

/// Whether no direction of C is negative.
fn stable(linear: &mut LinearMachine, place: &Place) -> bool {
    let Ok(found) = linear.at(place) else { return false };
    if !found.drift.is_empty() {
        return natural::modes(&found, linear.coordinates(), Normalisation::Largest).is_ok_and(|m| m.modes.iter().all(|m| !m.grows()));
    }
    let found = found.allowed().map_or(found.clone(), |(z, k)| found.reduced(&z, k));
    found.definite() != Some(false)
}

/// Remarks on the unknowns that were found.
pub fn unknown_notes(machine: &Machine) -> Vec<Text> {
    let found = machine.equations.parameters.iter().filter(|p| machine.model.unknowns.contains(&p.symbol));
    let name = |p: &symbolic::equations::Parameter| machine.equations.graph.symbol_info(p.symbol).name.clone();
    found.map(|p| analysis::studies::unknowns::remark(&name(p), p.value, &p.unit)).collect()
}

/// Stability of equilibria by the roots of small motions, beside the verdict of the energy: columns `growth` (largest real part of a root)
/// and `negative_directions` (of the potential energy's Hessian). Nothing is added for machines whose small motions are not defined.
pub fn add_roots(machine: &Machine, data: &mut Dataset) {
    if !machine.equations.conditions.is_empty() || data.column("growth").is_some() || machine.equations.coordinates.is_empty() {
        return;
    }
    let Ok(mut linear) = LinearMachine::new(&Arc::new(machine.equations.clone()), About::Rest) else { return };
    let names: Vec<String> = linear.coordinates().iter().map(|q| q.name.clone()).collect();
    let rows = data.columns.first().map_or(0, |c| c.values.len());
    let (mut growth, mut negative) = (Vec::new(), Vec::new());
    let mut verdicts = Vec::new();
    let (mut higher, mut kink, mut lines) = (Vec::new(), false, [false; 2]);
    for row in 0..rows {
        let q: Option<Vec<f64>> = names.iter().map(|n| data.column(n).map(|c| c.values[row])).collect();
        let Some(q) = q else { return };
        let place = linear.placed(&q);
        let matrices = linear.at(&place);
        let found = matrices.clone().and_then(|m| natural::modes(&m, linear.coordinates(), Normalisation::Largest));
        let grows = found.as_ref().map_or(0.0, |f| f.modes.iter().fold(f64::NEG_INFINITY, |g, m| g.max(m.root.0)));
        let listed = found.as_ref().map_or(&[][..], |f| &f.modes);
        let verdict = matrices.as_ref().map_or(None, |m| analysis::studies::rest::stability::verdict(m, listed));
        let of = |verdict: Option<bool>| verdict.map_or(f64::NAN, |stable| f64::from(u8::from(stable)));
        if kinks::is_kink(&mut linear, &place) {
            kink = true;
            [&mut verdicts, &mut growth, &mut negative].into_iter().for_each(|column| column.push(f64::NAN));
            continue;
        }
        if let Some(found) = degenerate(&mut linear, &place) {
            verdicts.push(of(found.stable));
            higher.push(found);
            growth.push(f64::NAN);
            negative.push(f64::NAN);
            continue;
        }
        if verdict.is_none() && matrices.as_ref().is_ok_and(|m| analysis::studies::rest::stability::free_directions(m) > 0) {
            lines[usize::from(rests_beside(&mut linear, &place))] = true;
        }
        verdicts.push(of(verdict));
        growth.push(found.as_ref().map_or(f64::NAN, |_| grows));
        negative.push(found.as_ref().map_or(f64::NAN, |f| f.undamped.iter().filter(|w| w.is_nan()).count() as f64));
    }
    if let Some(stable) = data.columns.iter_mut().find(|c| c.quantity.name == "stable") {
        stable.values = verdicts;
    }
    // along a range nothing is said of free motions: they are refused
    let told = data.notes.iter().any(|note| *note == analysis::studies::equilibrium::neutral());
    data.notes.retain(|note| lines[1] || *note != analysis::studies::equilibrium::neutral());
    data.notes.extend((told && lines[0]).then(analysis::studies::equilibrium::undecided));
    data.notes.extend(remark(higher.iter()));
    data.notes.extend(kink.then(kinks::remark));
    let column = |name: &str, unit: &str, label: Text, values: Vec<f64>| Column {
        quantity: Quantity { label, ..Quantity::new(name, unit) },
        values,
    };
    let label = Text::new("largest real part of a root", "наибольшая вещественная часть корня");
    data.columns.push(column("growth", "1/s", label, growth));
    let label = Text::new("directions in which the potential energy falls", "направлений убывания потенциальной энергии");
    data.columns.push(column("negative_directions", "1", label, negative));
    data.stated.clear();
    analysis::studies::equilibrium::state(data);
}

/// Which one-sided contacts small motions keep closed and which they leave out, and that they have no dry friction.
pub fn contact_notes(machine: &Machine, small: &Small) -> Vec<Text> {
    let (own, followed) = (&machine.equations.reactions, &small.machine.equations().reactions);
    let stands = |closed: bool| -> Vec<&Text> {
        let both = own.iter().zip(followed).filter(|(own, _)| matches!(own.law, Law::Contact { .. }));
        both.filter(|(_, now)| matches!(now.law, Law::Ideal { .. }) == closed).map(|(own, _)| &own.label).collect()
    };
    let list = |labels: &[&Text], pick: fn(&Text) -> &str| labels.iter().map(|label| pick(label)).collect::<Vec<_>>().join("; ");
    let mut notes = Vec::new();
    let (closed, open) = (stands(true), stands(false));
    if !closed.is_empty() {
        notes.push(Text::new(
            format!("contacts that small motions keep closed: {}", list(&closed, |t| &t.en)),
            format!("односторонние связи, замкнутые и в малых движениях: {}", list(&closed, |t| &t.ru)),
        ));
    }
    if !open.is_empty() {
        notes.push(Text::new(
            format!("contacts that small motions leave out: {}", list(&open, |t| &t.en)),
            format!("односторонние связи, в малых движениях не учтённые: {}", list(&open, |t| &t.ru)),
        ));
    }
    if own.iter().any(|r| matches!(r.law, Law::Friction(_))) {
        notes.push(Text::new("dry friction is left out of small motions", "сухое трение в малых движениях не учтено"));
    }
    notes
}

/// Remarks on how time was treated.
pub fn timing_notes(timing: Timing) -> Vec<Text> {
    let mut notes = Vec::new();
    if timing.averaged && !timing.frozen {
        notes.push(Text::new(
            "loads that repeat decide the place of rest by their mean over a period",
            "положение равновесия определяют средние за период значения повторяющихся нагрузок",
        ));
    }
    if timing.frozen {
        notes.push(Text::new(
            "the loads are no sums of harmonics: everything that depends on time is taken at t = 0",
            "нагрузки не являются суммой гармоник: всё, что зависит от времени, взято при t = 0",
        ));
    }
    if timing.settled {
        notes.push(Text::new(
            "formulas that switch with time are taken as they stand just after t = 0",
            "формулы, переключающиеся по времени, взяты такими, каковы они сразу после t = 0",
        ));
    }
    if timing.driven {
        notes.push(Text::new("conditions that change with time are taken at t = 0", "связи, меняющиеся со временем, взяты при t = 0"));
    }
    if timing.varying {
        notes.push(Text::new(
            "the coefficients oscillate in time (parametric excitation); their means are taken, which says nothing about parametric resonance",
            "коэффициенты колеблются во времени (параметрическое возбуждение); взяты их средние, о параметрическом резонансе это ничего не говорит",
        ));
    }
    notes
}
