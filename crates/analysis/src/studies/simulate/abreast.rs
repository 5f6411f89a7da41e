//! Many motions of one kind, eight at a time ([`crate::ensemble`]): each gets the outcome that it has by itself, or is left to the scalar path.

use super::options::{Grid, Kept, Outcome, Simulate};
use super::run::Run;
use crate::audits::second::two_derivations;
use crate::ensemble::{Flow, Fresh, State};
use crate::integrate::stiff::Method;
use crate::integrate::{Samples, Step, is_smooth, note};
use crate::interrupt::is_set;
use crate::machine::lanes::InLane;
use crate::{Machine, Mode, System};
use program::ensemble::{LANES, Layout};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use words::Text;

/// A motion that is asked for.
pub struct Wanted<'a> {
    /// The machine with its numbers.
    pub machine: Machine,
    /// Its start.
    pub start: Vec<f64>,
    /// The same as for a motion by itself.
    pub options: Simulate<'a>,
}

/// What became of a motion.
#[derive(Clone, Debug)]
pub enum Made {
    /// It was done in a lane.
    Found(Box<Outcome>),
    /// It is to be done by itself: lanes do not have what stands here.
    Left(Text),
    /// Something unusual on its way, which the scalar path knows how to take, or to name.
    Unusual,
    /// It was interrupted.
    Interrupted,
}

/// A motion that is prepared for a lane.
struct Row<'m, 'a> {
    wanted: &'m mut Wanted<'a>,
    run: Run,
    numbers: Vec<f64>,
    modes: Vec<Mode>,
    switches: Vec<(f64, Vec<Mode>)>,
    /// The last states, and the steps after which they are looked at.
    samples: Samples,
    due: u64,
}

/// What motions that go beside each other have in common.
#[derive(PartialEq)]
struct Group {
    layout: Arc<Layout>,
    tolerance: f64,
    units: Vec<String>,
    coordinates: usize,
    /// States that only turn.
    freely: Vec<usize>,
}

impl Group {
    fn of(machine: &Machine, layout: Layout, tolerance: f64) -> Group {
        let units: Vec<String> = machine.states().iter().map(|q| q.unit.clone()).collect();
        Group {
            layout: Arc::new(layout),
            tolerance,
            coordinates: machine.n_coordinates(),
            freely: (0..units.len()).filter(|i| machine.turns_freely(*i)).collect(),
            units,
        }
    }

    fn flow(&self) -> Flow {
        let units: Vec<&str> = self.units.iter().map(String::as_str).collect();
        Flow::new(&self.layout, self.tolerance, (&units, self.coordinates), self.freely.clone())
    }
}

/// Steps after which a motion is first looked at whether it is stiff, and steps between its samples.
const DUE: u64 = 256;
const APART: u64 = 4;
/// Changes of so many tolerances are what the steps leave of a motion that has come to rest.
const STILL: f64 = 10.0;

/// All motions, in their order. What becomes of one does not depend on the others.
pub fn abreast(motions: &mut [Wanted<'_>], interrupt: Option<&AtomicBool>) -> Vec<Made> {
    let mut made = Vec::with_capacity(motions.len());
    let mut groups: Vec<Group> = Vec::new();
    let mut rows: Vec<(usize, usize, Row<'_, '_>)> = Vec::new();
    for (i, wanted) in motions.iter_mut().enumerate() {
        made.push(Made::Interrupted);
        match prepared(wanted) {
            Ok((group, row)) => {
                let known = groups.iter().position(|own| *own == group).unwrap_or_else(|| {
                    groups.push(group);
                    groups.len() - 1
                });
                rows.push((known, i, row));
            }
            Err(why) => made[i] = why.map_or(Made::Unusual, Made::Left),
        }
    }
    for (k, group) in groups.iter().enumerate() {
        let (own, rest): (Vec<_>, Vec<_>) = rows.into_iter().partition(|row| row.0 == k);
        rows = rest;
        run(group, own, &mut made, interrupt);
    }
    made
}

/// Whether a motion can go in a lane.
///
/// *Errors*: what lanes do not have; no words where the motion has a fault of its own.
pub fn fits(wanted: &mut Wanted<'_>) -> Result<(), Text> {
    prepared(wanted).map(|_| ()).map_err(Option::unwrap_or_default)
}

/// A motion as lanes take it.
///
/// *Errors*: what lanes do not have; nothing where the motion has a fault of its own.
fn prepared<'m, 'a>(wanted: &'m mut Wanted<'a>) -> Result<(Group, Row<'m, 'a>), Option<Text>> {
    let options = &wanted.options;
    if let Some(why) = beyond(options) {
        return Err(Some(why));
    }
    let (start, until) = (&wanted.start, options.until);
    let run = Run::prepare(&wanted.machine, options).map_err(|_| None)?;
    let sound = until > 0.0 && start.iter().all(|x| x.is_finite()) && wanted.machine.placed(0.0, start).is_ok();
    if !sound {
        return Err(None);
    }
    let InLane { layout, numbers, modes, switches } = wanted.machine.in_lane(start, until).map_err(Some)?;
    let shown: Vec<usize> = run.chosen.iter().copied().chain(run.windows.outputs()).collect();
    wanted.machine.show(&shown).map_err(|_| None)?;
    let group = Group::of(&wanted.machine, layout, wanted.options.tolerance);
    Ok((group, Row { wanted, run, numbers, modes, switches, samples: Vec::new(), due: DUE }))
}

/// What is asked of a motion beyond numbers of it.
fn beyond(options: &Simulate<'_>) -> Option<Text> {
    let repeated = options.check || options.tolerance_halving || options.order.is_some() || options.method == Method::Stiff;
    let numbers = matches!(&options.grid, Grid::At(times) if times.is_empty()) && options.kept == Kept::Numbers;
    match () {
        () if !options.events.is_empty() => Some(Text::new("named events", "именованные события")),
        () if !options.pushes.is_empty() => Some(Text::new("normal forces that only push", "нормальные силы, которые только прижимают")),
        () if repeated || !numbers || !options.works.is_empty() => {
            Some(Text::new("more than numbers is asked for", "требуются не только числа"))
        }
        () => None,
    }
}

/// The motions of one layout, from the first to the last, each as soon as a lane is free.
fn run(group: &Group, rows: Vec<(usize, usize, Row<'_, '_>)>, made: &mut [Made], interrupt: Option<&AtomicBool>) {
    let mut flow = group.flow();
    let mut queue = rows.into_iter();
    let mut lanes: [Option<(usize, Row<'_, '_>)>; LANES] = Default::default();
    let mut step = Step::default();
    loop {
        for (lane, own) in lanes.iter_mut().enumerate().filter(|(_, own)| own.is_none()) {
            if let Some((_, i, mut row)) = queue.next() {
                let switches = std::mem::take(&mut row.switches);
                let fresh =
                    Fresh { numbers: &row.numbers, start: &row.wanted.start, modes: &row.modes, switches, until: row.wanted.options.until };
                flow.put(lane, fresh);
                *own = Some((i, row));
            }
        }
        let stopped = is_set(interrupt);
        if stopped || lanes.iter().all(Option::is_none) {
            return;
        }
        flow.advance();
        for (lane, own) in lanes.iter_mut().enumerate() {
            // a row is large: it stays where it is until its motion has ended
            let Some((_, row)) = own else { continue };
            let state = flow.state(lane);
            let given_up = state == State::Under && (row.is_stiff(&flow, lane) || row.is_hopeless(&flow, lane));
            if !given_up && matches!(state, State::Under | State::Done) {
                row.look((&flow, lane), &mut step);
            }
            if state == State::Under && !given_up {
                continue;
            }
            if let Some((i, row)) = own.take() {
                made[i] = if state == State::Done { row.finish(&flow, lane) } else { Made::Unusual };
            }
            flow.take(lane);
        }
    }
}

impl Row<'_, '_> {
    /// Looks at the last step, as the scalar path looks at one of its own.
    fn look(&mut self, (flow, lane): (&Flow, usize), step: &mut Step) {
        let run = &mut self.run;
        let (start, length) = flow.span(lane);
        let [power, bodies, released] = [!run.power.passes_over(), !run.bodies.passes_over(), !run.released.passes_over()];
        let windows = run.windows.reach_into(start, length);
        let whole = !run.chosen.is_empty();
        if power || bodies || released || windows || whole {
            flow.step(lane, &self.modes, step);
            let machine = &mut self.wanted.machine;
            if power {
                run.power.look(step, machine);
            }
            if bodies {
                run.bodies.look(step, machine);
            }
            if released {
                run.released.look(step, machine);
            }
            if windows {
                run.windows.look(step, machine, length);
            }
            if whole {
                run.extremes.look(&mut crate::marks::Along::new(step, machine, length));
            }
        }
        if self.modes != flow.modes(lane) {
            self.modes = flow.modes(lane).to_vec();
        }
    }

    /// Whether a smooth motion is followed by short steps, as `integrate::taylor::implicit` finds it: the scalar path has a method for that.
    fn is_stiff(&mut self, flow: &Flow, lane: usize) -> bool {
        let steps = flow.steps(lane);
        if self.wanted.options.method == Method::Taylor || steps + 5 * APART < self.due || !steps.is_multiple_of(APART) {
            return false;
        }
        flow.shown(lane, &mut self.run.x);
        note(&mut self.samples, flow.ends(lane), &self.run.x);
        if steps < self.due {
            return false;
        }
        self.due *= 2;
        let smooth = is_smooth(&self.samples, STILL * self.wanted.options.tolerance);
        self.samples.clear();
        smooth
    }

    /// Whether the motion needs more steps than it may have, which the scalar path tells.
    fn is_hopeless(&mut self, flow: &Flow, lane: usize) -> bool {
        let options = &self.wanted.options;
        self.run.pace.is_hopeless((flow.steps(lane), flow.ends(lane).high), options.until, options.most_steps).is_some()
    }

    /// The outcome; a check that does not hold is the business of the scalar path.
    fn finish(mut self, flow: &Flow, lane: usize) -> Made {
        let (steps, [ledger, defect]) = (flow.steps(lane), flow.found(lane));
        self.run.ledger.settle(ledger, steps);
        self.run.defect.settle(defect, steps);
        self.run.work.steps = steps;
        flow.shown(lane, &mut self.run.x);
        let Wanted { machine, start, options } = self.wanted;
        self.run.close(machine, options.until, &self.modes);
        let mut dataset = self.run.dataset(&*machine, options.tolerance);
        dataset.audits.splice(0..0, two_derivations(machine, start, options.until, options.seed));
        if dataset.audits.iter().all(|audit| audit.ok) { Made::Found(Box::new(Outcome { dataset, fault: None })) } else { Made::Unusual }
    }
}
