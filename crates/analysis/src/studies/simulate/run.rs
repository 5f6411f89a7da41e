//! A run: what is looked at, recorded and told of a motion on its way.

use crate::interrupt::is_set;
use algebra::arrange::Arrange;
use words::Text;

use super::options::{EVENTS, Grid, Kept, Simulate, check, choose, requested, untraced};
use super::{rivals, trail};
use crate::audits::blows::BlowLaws;
use crate::audits::bodies::BodyBalance;
use crate::audits::defect::InteriorDefect;
use crate::audits::friction::FrictionWork;
use crate::audits::impacts::{ImpactEnergy, drift};
use crate::audits::ledger::Ledger;
use crate::audits::power::PowerBalance;
use crate::audits::released::ReleasedBalance;
use crate::audits::shared::{Shared, not_unique};
use crate::audits::touches::TouchLaws;
use crate::dataset::{Audit, Column, Counter, Dataset, Event, Missing, Standing};
use crate::fault::connections::Since;
use crate::integrate::Step;
use crate::integrate::crossings::words::{change, describe, standing};
use crate::integrate::crossings::{Change, Switch};
use crate::integrate::taylor::{Flow, Options, Work};
use crate::marks::endless::endless;
use crate::marks::extremes::Extremes;
use crate::marks::named::Watcher;
use crate::marks::pushes::Pushes;
use crate::marks::windows::Windows;
use crate::studies::pace::{Doubled, may_strike};
use crate::{Fault, GuardKind, Mode, Quantity, System};
use words::digits::{number, rounded};

/// Steps between looks at the pace.
const PACE: u64 = 1024;

/// Looks in a row at which the run needs too many steps before it is given up.
const PATIENCE: u32 = 16;

/// A run under way.
pub(super) struct Run {
    pub(super) times: Vec<(f64, usize)>,
    /// Index of the first time not yet reached.
    pub(super) next: usize,
    pub(super) outputs: Vec<Quantity>,
    /// Which of the system's outputs they are.
    pub(super) chosen: Vec<usize>,
    /// Values, row by row in the order of the request.
    pub(super) table: Vec<f64>,
    pub(super) x: Vec<f64>,
    pub(super) all: Vec<f64>,
    pub(super) events: Vec<Event>,
    pub(super) power: PowerBalance,
    pub(super) bodies: BodyBalance,
    pub(super) released: ReleasedBalance,
    pub(super) defect: InteriorDefect,
    pub(super) impacts: ImpactEnergy,
    pub(super) ledger: Ledger,
    /// Outputs whose integrals are works to be confirmed.
    pub(super) works: Vec<usize>,
    /// Works of the impulses at the outputs in `works`.
    pub(super) struck: Vec<f64>,
    /// Largest share of the energy of a blow that the works of its impulses leave.
    pub(super) unclosed: Option<f64>,
    pub(super) friction: FrictionWork,
    pub(super) touches: TouchLaws,
    pub(super) blows: BlowLaws,
    /// Contacts and frictions at the start.
    pub(super) contacts: Vec<Standing>,
    pub(super) shared: Shared,
    pub(super) rivals: rivals::Rivals,
    pub(super) extremes: Extremes,
    pub(super) windows: Windows,
    pub(super) named: Watcher,
    pub(super) pushes: Pushes,
    /// Event that ended the motion.
    pub(super) ended: Option<(f64, usize)>,
    /// Largest rounding of the outputs shown at ends of steps: the repetition measures it.
    pub(super) rounding: Option<Vec<f64>>,
    /// Largest drift of conditions that was removed.
    pub(super) drift: f64,
    pub(super) work: Work,
    pub(super) interrupted: bool,
    pub(super) pace: Pace,
    /// Steps whose rows wait until it is known how many there are to be.
    pub(super) waiting: Option<Vec<Waiting>>,
    /// None where nobody looks at the way.
    pub(super) trail: Option<trail::Recorder>,
}

/// How far a motion has come.
#[derive(Clone, Copy, PartialEq)]
enum Passed {
    /// To where it was to go.
    Whole,
    /// It has ended before.
    Ended,
}

/// A step whose rows are still to be made, and where the motion ends inside it.
pub(super) struct Waiting {
    pub(super) step: Step,
    pub(super) stop: Option<f64>,
}

/// Share of the last step before its end at which the sides of switches are looked at.
const JUST_BEFORE: f64 = 1e-3;

/// The switches at the end of the last step, without those that had their side before: a condition behind another one (`and`, an `if` in an `if`) is not watched
/// while that one does not hold, and takes its side when it begins to count.
fn crossed<S: System + ?Sized>(flow: &mut Flow<'_, S>, x: &mut [f64]) -> Vec<Switch> {
    let mut switches = flow.switches().to_vec();
    let (step, system) = flow.step_and_system();
    if step.length == 0.0 || switches.len() < 2 {
        return switches;
    }
    let t = step.instant((1.0 - JUST_BEFORE) * step.length).high;
    step.state_at(t, x);
    let Some(sides) = system.modes_by_value(t, x) else { return switches };
    let guards = system.guards();
    let plain = |s: &Switch| s.change == Change::Mode && guards[s.guard].kind == GuardKind::Switch && guards[s.guard].scheduled.is_none();
    switches.retain(|s| !plain(s) || sides[s.guard] != s.after);
    switches
}

/// Watches how far the run comes with its steps.
#[derive(Clone, Debug, Default)]
pub(super) struct Pace {
    /// Time at the last look.
    before: f64,
    /// Looks in a row at which too many steps were in sight.
    hopeless: u32,
    /// Steps still to do at the last pace.
    remaining: f64,
    doubled: Doubled,
}

/// What speaks against going on.
pub(super) enum Hopeless {
    /// Mean length of the last steps: at this pace there are too many.
    Short(f64),
    /// Their number doubles every so many seconds.
    Growing(f64),
}

impl Pace {
    fn look<S: System + ?Sized>(&mut self, flow: &mut Flow<'_, S>, end: f64, most: f64) -> Result<(), Fault> {
        match self.is_hopeless((flow.work().steps, flow.time()), end, most) {
            Some(Hopeless::Short(step)) => Err(Fault::too_many_steps(&flow.fastest(), flow.time(), step, self.remaining)),
            Some(Hopeless::Growing(_)) if may_strike(flow.system()) => Ok(()),
            Some(Hopeless::Growing(took)) => Err(Fault::ever_more_steps(&flow.fastest(), flow.time(), took, self.remaining)),
            None => Ok(()),
        }
    }

    /// Every [`PACE`] steps: the steps that remain at the pace of the last ones, and as their number grows.
    pub(super) fn is_hopeless(&mut self, (steps, time): (u64, f64), end: f64, most: f64) -> Option<Hopeless> {
        if !steps.is_multiple_of(PACE) {
            return None;
        }
        let step = (time - self.before) / PACE as f64;
        self.before = time;
        self.remaining = (end - time) / step;
        self.hopeless = if steps as f64 + self.remaining > most { self.hopeless + 1 } else { 0 };
        if self.hopeless >= PATIENCE {
            return Some(Hopeless::Short(step));
        }
        let (took, needed) = self.doubled.look((steps, time), (end, most))?;
        self.remaining = needed;
        Some(Hopeless::Growing(took))
    }
}

impl Run {
    pub(super) fn prepare<S: System + ?Sized>(system: &S, options: &Simulate<'_>) -> Result<Run, Fault> {
        check(options)?;
        let chosen = choose(system.outputs(), options.outputs.as_deref())?;
        let windows = Windows::new(system, &options.windows, (options.until, options.tolerance))?;
        let watched = options.events.iter().map(|e| e.output).chain(windows.outputs());
        if let Some(fault) = chosen.iter().copied().chain(watched).find_map(|i| system.refusal(i)) {
            return Err(fault);
        }
        let outputs: Vec<Quantity> = chosen.iter().map(|&i| system.outputs()[i].clone()).collect();
        let times = requested(options, outputs.len() + 1)?;
        let n_x = system.states().len();
        let works = choose(system.outputs(), Some(&options.works))?;
        Ok(Run {
            table: vec![f64::NAN; times.len() * outputs.len()],
            times,
            next: 0,
            outputs,
            x: vec![0.0; n_x],
            all: vec![0.0; system.outputs().len()],
            events: Vec::new(),
            power: PowerBalance::new(n_x),
            bodies: BodyBalance::new(n_x),
            released: ReleasedBalance::new(system),
            defect: InteriorDefect::new(n_x, options.tolerance),
            impacts: ImpactEnergy::default(),
            ledger: Ledger::new(system, options.tolerance, &works),
            struck: vec![0.0; works.len()],
            unclosed: None,
            works,
            friction: FrictionWork::default(),
            touches: TouchLaws::new(options.tolerance),
            blows: BlowLaws::default(),
            contacts: Vec::new(),
            shared: Shared::default(),
            rivals: rivals::Rivals::default(),
            extremes: Extremes::new(system, &chosen, options.tolerance),
            windows,
            named: Watcher::new(&options.events),
            pushes: Pushes::new(&options.pushes.iter().filter(|p| system.refusal(p.output).is_none()).cloned().collect::<Vec<_>>()),
            ended: None,
            rounding: None,
            drift: 0.0,
            work: Work::default(),
            interrupted: false,
            pace: Pace::default(),
            waiting: (options.grid == Grid::Fitted).then(Vec::new),
            trail: (options.kept == Kept::Way).then(|| trail::Recorder::new(system.states().iter().map(|q| q.name.clone()).collect())),
            chosen,
        })
    }

    pub(super) fn integrate<S: System + ?Sized>(&mut self, system: &mut S, start: &[f64], options: &mut Simulate<'_>) -> Result<(), Fault> {
        let end = options.until;
        let mut shown = self.chosen.clone();
        let watched =
            options.events.iter().map(|e| e.output).chain(self.pushes.list().iter().map(|p| p.output)).chain(self.windows.outputs());
        shown.extend(watched.filter(|i| !self.chosen.contains(i)));
        system.show(&shown)?;
        system.placed(0.0, start)?;
        let flow_options =
            Options { tolerance: options.tolerance, span: end, order: options.order, method: options.method, ..Options::default() };
        let mut flow = Flow::start(system, 0.0, start, &flow_options)?;
        let modes = flow.modes().to_vec();
        self.contacts = standing(flow.system().guards(), &modes);
        let mut passed = self.record(&mut flow).map(|()| Passed::Whole);
        for (t, x) in std::mem::take(&mut options.joints) {
            if matches!(passed, Ok(Passed::Whole)) {
                passed = self.pass(&mut flow, t, options);
                let work = flow.work().clone();
                flow = Flow::start(flow.release(), t, &x, &flow_options)?;
                flow.count_from(work);
            }
        }
        let result = match passed {
            Ok(Passed::Whole) => self.follow(&mut flow, end, options),
            other => other.map(drop),
        };
        // what ends early has the rows of what was done
        let result = self.settle_rows(&mut flow, options).and(result);
        self.work = flow.work().clone();
        self.drift = flow.drift();
        result
    }

    /// To an instant, or to what ends the motion before it.
    fn pass<S: System + ?Sized>(&mut self, flow: &mut Flow<'_, S>, end: f64, options: &mut Simulate<'_>) -> Result<Passed, Fault> {
        while !flow.reached(end) {
            if is_set(options.interrupt) {
                self.interrupted = true;
                return Ok(Passed::Ended);
            }
            let outcome = flow.advance(end);
            if outcome.is_err() && flow.step().length == 0.0 {
                return outcome.map(|()| Passed::Whole);
            }
            let stop = self.look(flow);
            if let Some((push, t)) = self.pushes.broken() {
                return Err(Fault::strand_pushes(&push.label, Since::Time(t)));
            }
            self.sample(flow, options, stop)?;
            if let Some(stop) = stop {
                self.settle_rows(flow, options)?;
                return self.end_inside(flow, stop).map(|()| Passed::Ended);
            }
            self.record(flow)?;
            if let Some((push, t)) = self.pushes.broken() {
                return Err(Fault::strand_pushes(&push.label, Since::Time(t)));
            }
            let (step, system) = flow.step_and_system();
            step.state_at(step.instant(step.length).high, &mut self.x);
            system.placed(step.instant(step.length).high, &self.x)?;
            outcome?;
            self.pace.look(flow, end, options.most_steps)?;
            if let Some(progress) = &mut options.progress
                && flow.work().steps.is_multiple_of(64)
            {
                progress(flow.time() / options.until);
            }
        }
        Ok(Passed::Whole)
    }

    pub(super) fn follow<S: System + ?Sized>(&mut self, flow: &mut Flow<'_, S>, end: f64, options: &mut Simulate<'_>) -> Result<(), Fault> {
        if self.pass(flow, end, options)? == Passed::Ended {
            return Ok(());
        }
        self.settle_rows(flow, options)?;
        self.x.copy_from_slice(flow.state());
        let modes = flow.modes().to_vec();
        self.close(flow.system(), end, &modes);
        while let Some(&(t, row)) = self.times.get(self.next) {
            self.fill(flow.system(), t, row, &modes)?;
            self.next += 1;
        }
        Ok(())
    }

    /// Values where the motion ends.
    pub(super) fn close<S: System + ?Sized>(&mut self, system: &mut S, t: f64, modes: &[Mode]) {
        // what has no value there is no row either
        if system.observe(t, &self.x, modes, &mut self.all).is_ok() {
            let values: Vec<f64> = self.chosen.iter().map(|&i| self.all[i]).collect();
            self.extremes.offer_row(t, &values);
            self.extremes.end(&values);
        }
    }

    pub(super) fn record<S: System + ?Sized>(&mut self, flow: &mut Flow<'_, S>) -> Result<(), Fault> {
        let mut rival = self.rivals.look(flow);
        if flow.switches().iter().any(jumps) {
            self.ledger.impact();
            self.judge_blow(flow);
        }
        if flow.switches().is_empty() || self.events.len() >= EVENTS {
            if !flow.switches().is_empty() {
                self.struck.fill(f64::NAN);
            }
            return Ok(());
        }
        let switches = crossed(flow, &mut self.x);
        let states = [flow.state_before(), flow.state().to_vec()];
        let (before, after) = (flow.modes_before().to_vec(), flow.modes().to_vec());
        let t = flow.time();
        let mut side = |run: &mut Run, state: &[f64], modes: &[Mode]| -> Result<Vec<f64>, Fault> {
            flow.system().observe(t, state, modes, &mut run.all).map_err(|fault| timed(fault, t))?;
            Ok(run.chosen.iter().map(|&i| run.all[i]).collect())
        };
        let outputs = [side(self, &states[0], &before)?, side(self, &states[1], &after)?];
        let mut lost = self.loss(flow, &switches, &states, [&before, &after]);
        if switches.iter().any(jumps) {
            self.book_works(flow, &switches, &states, [&before, &after]);
        }
        let mut impulses = self.impulses(flow, &switches);
        let pulled = self.pushes.strike(t, &impulses);
        self.list_pulled((t, pulled), &states, &outputs);
        let sides = std::iter::repeat_n((states, outputs), switches.len());
        for (switch, (states, outputs)) in switches.iter().zip(sides) {
            let mut what = describe(switch, &flow.system().guards()[switch.guard]);
            if matches!(switch.change, Change::Impact { .. })
                && let Some(lost) = lost.take()
            {
                let n = rounded(lost);
                what = Text::new([&what.en[..], ", ", &n.en, " J lost"].concat(), [&what.ru[..], ", потеряно ", &n.ru, " Дж"].concat());
            }
            let sides = [switch.before.sign(), switch.after.sign()];
            let contact = change(switch, &flow.system().guards()[switch.guard]);
            let impulses = if jumps(switch) { std::mem::take(&mut impulses) } else { Vec::new() };
            if switch.change == Change::Jolt && !impulses.is_empty() {
                what = rivals::with_impulses(&what, &impulses);
            }
            if let Some(other) = rival.take() {
                what = rivals::beside(&what, &other);
            }
            self.events.push(Event {
                t: switch.t,
                name: String::new(),
                what,
                guard: switch.guard,
                sides,
                states,
                outputs,
                contact,
                impulses,
            });
        }
        Ok(())
    }

    /// The check of works.
    pub(super) fn confirmed(&self) -> Option<Audit> {
        let overall = self.extremes.overall();
        let of = |i: &usize| self.chosen.iter().position(|c| c == i).map_or(f64::NAN, |j| overall[j].integral);
        (!self.works.is_empty() && !self.ledger.is_unknown()).then(|| self.ledger.confirmed(self.works.iter().map(of).sum()))
    }

    /// What is to be said of quantities that could not be followed between the rows.
    pub(super) fn lost<S: System + ?Sized>(&self, system: &S) -> Option<Text> {
        let mut lost: Vec<usize> = self.extremes.lost().into_iter().map(|j| self.chosen[j]).collect();
        for i in self.windows.lost() {
            if !lost.contains(&i) {
                lost.push(i);
            }
        }
        let lost = lost.into_iter().filter(|i| system.is_shared(*i).is_none());
        let outputs = lost.map(|i| system.outputs()[i].name.clone());
        let events = self.named.lost().into_iter().map(|i| self.named.events()[i].name.clone());
        untraced(&outputs.chain(events).collect::<Vec<_>>())
    }

    /// That named events, contacts and frictions go along with infinitely many impacts, where their own events do not say so.
    fn without_end(&self) -> Vec<Text> {
        let told = |name: &str| self.events.iter().filter_map(|e| e.contact.as_ref()).any(|c| c.contact == name && c.endless);
        let contacts = self.contacts.iter().map(|standing| standing.contact.as_str()).filter(|name| !told(name));
        let names = self.named.events().iter().map(|event| event.name.as_str()).chain(contacts);
        let one = |name: &str| {
            let is = |event: &Event| event.name == name || event.contact.as_ref().is_some_and(|change| change.contact == name);
            let n = number(endless(&self.events, &is)?);
            Some(Text::new(
                format!("{name}: infinitely many events before t = {} s; only those above rounding are listed", n.en),
                format!("{name}: до t = {} с бесконечно много событий; перечислены лишь те, что больше погрешности округления", n.ru),
            ))
        };
        names.filter_map(one).collect()
    }

    /// What is to be said of the motion.
    pub(super) fn notes<S: System + ?Sized>(&self, system: &S) -> Vec<Text> {
        let mut notes = system.notes().to_vec();
        if self.interrupted {
            notes.push(Text::new("interrupted: the result ends early", "прервано: результат неполон"));
            if self.pace.remaining > 0.0 {
                let n = rounded(self.pace.remaining);
                notes.push(Text::new(
                    format!("at the last pace about {} more steps were to do", n.en),
                    format!("при последнем темпе оставалось около {} шагов", n.ru),
                ));
            }
        }
        if self.events.len() >= EVENTS {
            notes.push(Text::new(
                format!("only the first {EVENTS} events are listed"),
                format!("перечислены только первые {EVENTS} событий"),
            ));
        }
        if self.ledger.is_unknown() {
            notes.push(Text::new(
                "the energy has no value somewhere along the motion: there is no energy ledger",
                "энергия где-то на пути движения не имеет значения: баланс энергии не составлен",
            ));
        }
        notes.extend(self.lost(system));
        if let Some((t, event)) = self.ended {
            notes.push(self.named.ending(event, t));
        }
        notes.extend(self.without_end());
        notes.extend(self.shared.note(system));
        notes.extend(self.rivals.note());
        notes.extend(self.pushes.notes(Since::Time));
        notes
    }

    pub(super) fn dataset<S: System + ?Sized>(self, system: &S, tolerance: f64) -> Dataset {
        let mut done: Vec<(usize, f64)> = self.times[..self.next].iter().map(|&(t, row)| (row, t)).collect();
        done.arrange_by_key(|&(row, _)| row);
        let (notes, confirmed, open, closed) = (self.notes(system), self.confirmed(), self.open(system), self.closed());
        let n = self.outputs.len();
        let time = Quantity { label: Text::new("time", "время"), ..Quantity::new("t", "s") };
        let mut columns = vec![Column { quantity: time, values: done.iter().map(|&(_, t)| t).collect() }];
        for (j, quantity) in self.outputs.into_iter().enumerate() {
            columns.push(Column { quantity, values: done.iter().map(|&(row, _)| self.table[row * n + j]).collect() });
        }
        let mut counters = counters(&self.work, &self.impacts);
        let samples = self.extremes.samples() + self.named.samples();
        if samples > 0 {
            let name = Text::new("samples for extremes and events", "замеров для экстремумов и событий");
            counters.push(Counter { key: "samples", name, value: samples as f64 });
        }
        let audits = [
            self.power.audit(tolerance),
            self.ledger.audit(),
            self.bodies.audit(tolerance),
            self.defect.audit(tolerance),
            self.impacts.audit(),
            self.impacts.audit_of_work(),
            self.friction.audit(),
            drift(self.drift, self.work.projections, tolerance),
            confirmed,
            closed,
        ];
        let laws = self.touches.audits(tolerance).into_iter().chain(self.blows.audits());
        let audits = audits.into_iter().flatten().chain(self.released.audits(tolerance)).chain(laws).collect();
        let states = system.states().iter().map(|q| q.name.clone()).collect();
        let mut dataset = Dataset {
            trail: self.trail.map(trail::Recorder::close).unwrap_or_default(),
            axis: Some(0),
            columns,
            audits,
            states,
            events: self.events,
            contacts: self.contacts,
            extremes: self.extremes.found(),
            overall: self.extremes.overall(),
            windows: self.windows.found(),
            struck: self.struck,
            rounding: self.rounding.map(|r| std::iter::once(0.0).chain(r).collect()).unwrap_or_default(),
            counters,
            notes,
            partial: self.interrupted,
            ..Dataset::default()
        };
        open.into_iter().for_each(|(name, words)| dataset.state(&name, Missing::Absent, words));
        dataset
    }

    /// Outputs that had no value at times, as others share the load, and what to say of them.
    pub(super) fn open<S: System + ?Sized>(&self, system: &S) -> Vec<(String, Text)> {
        let one = |&i: &usize| Some((system.outputs()[i].name.clone(), not_unique(system, system.is_shared(i)?)));
        self.chosen.iter().filter_map(one).collect()
    }
}

/// Whether rates jump at a switch.
pub(super) fn jumps(switch: &Switch) -> bool {
    matches!(switch.change, Change::Impact { .. } | Change::Jolt)
}

/// A fault of a formula, with the instant at which it happened; other faults say it themselves.
pub(super) fn timed(fault: Fault, t: f64) -> Fault {
    if fault.code.starts_with('P') { fault.during(t) } else { fault }
}

fn counters(work: &Work, impacts: &ImpactEnergy) -> Vec<Counter> {
    let row = |key, en: &str, ru: &str, value: f64| Counter { key, name: Text::new(en, ru), value };
    let mut rows = vec![
        row("steps", "steps", "шагов", work.steps as f64),
        row("rejected", "steps taken back", "шагов отвергнуто", work.rejected as f64),
        row("mean_order", "mean order", "средний порядок", work.mean_order()),
        row("highest_order", "highest order", "наибольший порядок", work.highest_order as f64),
        row("evaluations", "Taylor expansions", "тейлоровских разложений", work.expansions as f64),
        row("events", "switches", "переключений", work.switches as f64),
    ];
    if work.implicit_steps > 0 {
        rows.extend([
            row("implicit_steps", "implicit steps among them", "из них неявных", work.implicit_steps as f64),
            row("stages", "stages of an implicit step", "стадий неявного шага", work.stages as f64),
        ]);
    }
    if work.newton > 0 {
        rows.extend([
            row("jacobians", "Jacobians", "матриц Якоби", work.jacobians as f64),
            row("factorisations", "factorisations", "разложений матриц", work.factorisations as f64),
            row("newton_iterations", "Newton iterations", "итераций Ньютона", work.newton as f64),
        ]);
    }
    if work.projections > 0 {
        rows.push(row("projections", "steps moved back onto the connections", "шагов, возвращённых на связи", work.projections as f64));
    }
    if impacts.lost() != 0.0 {
        rows.push(row("impact_loss", "energy lost in impacts, J", "энергия, потерянная при ударах, Дж", impacts.lost()));
    }
    rows
}
