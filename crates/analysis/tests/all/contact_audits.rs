//! The laws of contacts and frictions along a motion: their audits pass where the laws hold, and each fails where its law is broken on purpose.

use crate::linkage;

use analysis::studies::simulate::{Simulate, simulate};
use analysis::{Blow, Dataset, Fault, Guard, GuardKind, Machine, Mode, Powers, Quantity, System, Touch, TouchLaw};
use linkage::{Build, Start, kinetic};
use symbolic::connections::Impacts;

/// Energies and laws of a single impact: rounding of their terms.
const ROUNDING: f64 = 1e-13;
/// What laws that hold leave in their audits along a motion.
const FAIR: f64 = 1e-11;
/// Momenta of bodies at impacts, relative to impulses that nearly cancel.
const MOMENTA: f64 = 1e-10;

/// Which law is broken.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Broken {
    Nothing,
    /// Sliding friction acts along the sliding.
    Sign,
    /// μ of the motion is 1 % more than that of the law.
    Coefficient,
    /// A closed contact holds although it has to pull.
    Pull,
    /// An open contact does not close.
    Through,
    /// A friction at rest creeps.
    Creep,
    /// A friction in an impact gives 1 % more than its limit.
    Impulse,
    /// Rates jump more than the impulses say.
    Momentum,
    /// The impulse of a contact is 1 % more than its restitution asks for.
    Rebound,
    /// Contacts that should strike together strike one after another.
    OneByOne,
}

/// A machine with a broken law.
struct Wrong {
    machine: Machine,
    broken: Broken,
    bound: Vec<f64>,
}

impl Wrong {
    /// The modes in which the wrong machine moves.
    fn moves(&self, modes: &[Mode]) -> Vec<Mode> {
        let turned = |(guard, mode): (&Guard, &Mode)| match (self.broken, &guard.kind, mode) {
            (Broken::Sign, GuardKind::Friction { .. }, Mode::Positive) => Mode::Negative,
            (Broken::Sign, GuardKind::Friction { .. }, Mode::Negative) => Mode::Positive,
            (_, _, mode) => *mode,
        };
        self.machine.guards().iter().zip(modes).map(turned).collect()
    }
    fn of_contact(&self, i: usize) -> bool {
        let guards = self.machine.guards();
        matches!(guards[i].kind, GuardKind::Bound { of, .. } if matches!(guards[of].kind, GuardKind::Contact { .. }))
    }
}

impl System for Wrong {
    fn states(&self) -> &[Quantity] {
        self.machine.states()
    }
    fn n_coordinates(&self) -> usize {
        self.machine.n_coordinates()
    }
    fn guards(&self) -> &[Guard] {
        self.machine.guards()
    }
    fn outputs(&self) -> &[Quantity] {
        self.machine.outputs()
    }
    fn expand(&mut self, t: f64, x: &[f64], modes: &[Mode], order: usize) -> Result<(), Fault> {
        self.bound = vec![0.0; order + 1];
        self.bound[0] = 1.0;
        self.machine.expand(t, x, &self.moves(modes), order)
    }
    fn state(&self, i: usize) -> &[f64] {
        self.machine.state(i)
    }
    fn guard(&self, i: usize) -> &[f64] {
        let hidden = match self.broken {
            Broken::Pull => self.of_contact(i),
            Broken::Through => matches!(self.machine.guards()[i].kind, GuardKind::Contact { .. }),
            _ => false,
        };
        if hidden { &self.bound } else { self.machine.guard(i) }
    }
    fn rates(&mut self, t: f64, x: &[f64], modes: &[Mode], rates: &mut [f64]) -> bool {
        self.machine.rates(t, x, &self.moves(modes), rates)
    }
    fn observe(&mut self, t: f64, x: &[f64], modes: &[Mode], values: &mut [f64]) -> Result<(), Fault> {
        self.machine.observe(t, x, &self.moves(modes), values)
    }
    fn sides(&mut self, t: f64, x: &[f64]) -> Option<Vec<Mode>> {
        self.machine.sides(t, x)
    }
    fn powers(&mut self, t: f64, x: &[f64], accelerations: &[f64], modes: &[Mode]) -> Option<Powers> {
        self.machine.powers(t, x, accelerations, &self.moves(modes))
    }
    fn energies(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> Option<[f64; 2]> {
        self.machine.energies(t, x, modes)
    }
    fn n_frictions(&self) -> usize {
        self.machine.n_frictions()
    }
    fn frictions(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> Option<Vec<Option<f64>>> {
        self.machine.frictions(t, x, &self.moves(modes))
    }
    fn touches(&mut self, t: f64, x: &[f64], accelerations: &[f64], modes: &[Mode]) -> Option<Vec<Touch>> {
        let mut list = self.machine.touches(t, x, accelerations, &self.moves(modes))?;
        let excess = if self.broken == Broken::Coefficient { 1.01 } else { 1.0 };
        for touch in &mut list {
            if let TouchLaw::Friction { limits, .. } = &mut touch.law {
                limits.iter_mut().for_each(|limit| *limit /= excess);
            }
        }
        Some(list)
    }
    fn struck(&mut self, t: f64, x: &[f64], impulses: &[f64], modes: &[Mode]) -> Option<Vec<Touch>> {
        self.machine.struck(t, x, impulses, modes)
    }
    fn momenta(&mut self, t: f64, x: &[f64], jump: [&[f64]; 2], modes: &[Mode]) -> Option<Vec<[f64; 2]>> {
        self.machine.momenta(t, x, jump, modes)
    }
    fn project(&mut self, t: f64, x: &mut [f64], modes: &[Mode]) -> Result<f64, Fault> {
        let drift = self.machine.project(t, x, modes)?;
        let sticks = |(guard, mode): (&Guard, &Mode)| matches!(guard.kind, GuardKind::Friction { .. }) && *mode == Mode::Zero;
        if self.broken == Broken::Creep && self.machine.guards().iter().zip(modes).any(sticks) {
            x[self.machine.n_coordinates()] += 1e-6;
        }
        Ok(drift)
    }
    fn repeats(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> Result<usize, Fault> {
        self.machine.repeats(t, x, modes)
    }
    fn impact(&mut self, t: f64, x: &mut [f64], modes: &[Mode], closing: &[usize]) -> Result<Blow, Fault> {
        let before = x.to_vec();
        let mut blow = self.machine.impact(t, x, modes, closing)?;
        match self.broken {
            // the second reaction is the friction, the first coordinate slides with mass 1
            Broken::Impulse => {
                blow.reactions[1] *= 1.01;
                let n = self.machine.n_coordinates();
                x[n] = before[n] - blow.reactions[1];
            }
            Broken::Momentum => x[self.machine.n_coordinates()] *= 1.001,
            // the first reaction is the contact, the second coordinate is its gap with mass 1
            Broken::Rebound => {
                blow.reactions[0] *= 1.01;
                let n = self.machine.n_coordinates();
                x[n + 1] = before[n + 1] + blow.reactions[0];
            }
            Broken::OneByOne => blow.law = Impacts::Together,
            _ => {}
        }
        Ok(blow)
    }
}

/// A block of 1 kg on a spring over a floor, lifted by a force that grows; coordinates x along the floor, y above it.
struct Scene {
    x: [f64; 2],
    y: [f64; 2],
    spring: f64,
    /// Upward force: constant part, part with sin(3 t).
    lift: [f64; 2],
    restitution: f64,
    friction: f64,
}

const SLIDES: Scene = Scene { x: [0.0, 2.0], y: [0.0, 0.0], spring: 40.0, lift: [0.0, 4.0], restitution: 0.0, friction: 0.3 };
const LANDS: Scene = Scene { x: [0.0, 3.0], y: [0.3, -1.0], spring: 0.0, lift: [0.0, 0.0], restitution: 0.4, friction: 0.25 };
const LIFTED: Scene = Scene { x: [0.1, 0.0], y: [0.0, 0.0], spring: 0.0, lift: [0.0, 14.0], restitution: 0.0, friction: 0.3 };

fn machine(scene: &Scene) -> (Machine, Vec<f64>) {
    let mut b = Build::new();
    let [x, v] = b.coordinate("x", "m", Start::Given(scene.x[0]), Start::Given(scene.x[1]));
    let [y, w] = b.coordinate("y", "m", Start::Given(scene.y[0]), Start::Given(scene.y[1]));
    let t = kinetic(&mut b, 1.0, [x, y]);
    let square = b.square(x);
    let energies = [b.times(0.5 * scene.spring, square), b.times(9.81, y)];
    let potential = b.add(&energies);
    let time = b.e.graph.symbol(b.e.time);
    let phase = b.times(3.0, time);
    let wave = b.sin(phase);
    let parts = [b.number(scene.lift[0]), b.times(scene.lift[1], wave)];
    let lift = b.add(&parts);
    b.lagrange(t, potential, &[(1, lift)]);
    let floor = b.contact("floor", y, scene.restitution);
    let rough = b.friction("rough", v, 1.2 * scene.friction, scene.friction);
    b.press(rough, floor);
    let rub = b.e.graph.symbol(b.e.reactions[rough].symbol);
    b.e.energy.loads = b.mul(&[lift, w]);
    b.e.energy.dissipated = b.mul(&[rub, v]);
    newton(&mut b, [x, lift], scene.spring);
    (b.machine(), [scene.x[0], scene.y[0], scene.x[1], scene.y[1]].to_vec())
}

/// The second derivation: x'' + c x + F = 0, y'' + g - lift - N = 0.
fn newton(b: &mut Build, [x, lift]: [symbolic::Expr; 2], spring: f64) {
    let [ax, ay] = [0, 1].map(|i| b.e.graph.symbol(b.e.coordinates[i].symbols[2]));
    let [floor, rough] = [0, 1].map(|r| b.e.graph.symbol(b.e.reactions[r].symbol));
    let (pull, weight) = (b.times(spring, x), b.number(9.81));
    let along = b.add(&[ax, pull, rough]);
    let down = b.add(&[ay, weight]);
    let up = b.add(&[lift, floor]);
    let across = b.sub(down, up);
    b.e.second = vec![along, across];
}

fn run(scene: &Scene, broken: Broken) -> Dataset {
    let (machine, start) = machine(scene);
    let mut system = Wrong { machine, broken, bound: Vec::new() };
    simulate(&mut system, &start, Simulate::until(2.0)).dataset
}

fn fails(scene: &Scene, broken: Broken, key: &str) {
    let data = run(scene, broken);
    let audit = data.audit(key).unwrap_or_else(|| panic!("{broken:?}: no {key} among {:?}", data.audits));
    assert!(!audit.ok, "{broken:?}: {audit:?}");
}

/// The parts of the tape of energies that audits take by themselves are those of the whole tape.
#[test]
fn supply_and_frictions_are_those_of_the_powers() {
    for scene in [&SLIDES, &LANDS, &LIFTED] {
        let (mut machine, start) = machine(scene);
        let x: Vec<f64> = start.iter().enumerate().map(|(i, x)| x + 0.1 * (i as f64 + 1.0)).collect();
        for floor in [Mode::Zero, Mode::Positive] {
            let contact = |g: &Guard| if matches!(g.kind, GuardKind::Contact { .. }) { floor } else { Mode::Positive };
            let modes: Vec<Mode> = machine.guards().iter().map(contact).collect();
            let powers = machine.powers(0.7, &x, &[0.3, -0.2], &modes).unwrap();
            let supply = machine.supply(0.7, &x, &[0.3, -0.2], &modes).unwrap();
            assert_eq!([supply.loads, supply.drives, supply.dissipated], [powers.loads, powers.drives, powers.dissipated]);
            let taken: f64 = machine.frictions(0.7, &x, &modes).unwrap().into_iter().flatten().sum();
            assert_eq!(taken, powers.dissipated);
            let [kinetic, potential] = machine.energies(0.7, &x, &modes).unwrap();
            let own = [0.5 * (x[2] * x[2] + x[3] * x[3]), 0.5 * scene.spring * x[0] * x[0] + 9.81 * x[1]];
            assert!((kinetic - own[0]).abs() + (potential - own[1]).abs() < ROUNDING);
        }
    }
}

const KEYS: [&str; 4] = ["contact_gap", "contact_force", "friction_limit", "complementarity"];

#[test]
fn laws_that_hold_pass_every_audit() {
    for (i, scene) in [SLIDES, LANDS, LIFTED].iter().enumerate() {
        let data = run(scene, Broken::Nothing);
        for key in KEYS {
            let audit = data.audit(key).unwrap_or_else(|| panic!("scene {i}: no {key}"));
            assert!(audit.ok && audit.value < FAIR, "scene {i}: {audit:?}");
        }
        assert!(data.audits.iter().all(|a| a.ok), "scene {i}: {:?}", data.audits);
        assert!(!data.events.is_empty(), "scene {i}");
    }
    assert!(run(&LANDS, Broken::Nothing).audit("impact_laws").is_some_and(|a| a.value < ROUNDING));
}

#[test]
fn friction_along_the_sliding_fails() {
    fails(&SLIDES, Broken::Sign, "friction_limit");
    fails(&SLIDES, Broken::Sign, "friction_work");
}

#[test]
fn friction_of_a_hundredth_too_much_fails() {
    fails(&SLIDES, Broken::Coefficient, "friction_limit");
}

#[test]
fn a_contact_that_pulls_fails() {
    fails(&LIFTED, Broken::Pull, "contact_force");
}

#[test]
fn a_contact_that_is_passed_through_fails() {
    fails(&LANDS, Broken::Through, "contact_gap");
}

#[test]
fn a_friction_that_creeps_at_rest_fails() {
    fails(&SLIDES, Broken::Creep, "complementarity");
}

#[test]
fn an_impulse_of_friction_beyond_its_limit_fails() {
    fails(&LANDS, Broken::Impulse, "impact_laws");
}

#[test]
fn a_jump_of_rates_without_impulse_fails() {
    assert!(run(&LANDS, Broken::Nothing).audit("impact_momenta").is_some_and(|audit| audit.value < MOMENTA));
    fails(&LANDS, Broken::Momentum, "impact_momenta");
}

#[test]
fn a_rebound_of_a_hundredth_too_much_fails() {
    fails(&LANDS, Broken::Rebound, "impact_rebounds");
}

/// A ball meets two that touch: in sequence the last leaves alone, together the two that touch stay together.
#[test]
fn a_contact_left_out_of_its_set_fails() {
    for (broken, ok) in [(Broken::Nothing, true), (Broken::OneByOne, false)] {
        let mut b = Build::new();
        let x: Vec<_> = (0..3).map(|i| b.coordinate(["a", "b", "c"][i], "m", Start::Given(0.0), Start::Given(0.0))[0]).collect();
        let parts = [kinetic(&mut b, 1.0, [x[0], x[1]]), kinetic(&mut b, 0.5, [x[2], x[2]])];
        let t = b.add(&parts);
        let zero = b.number(0.0);
        b.lagrange(t, zero, &[]);
        for (name, i) in [("ab", 0), ("bc", 1)] {
            let gap = b.sub(x[i + 1], x[i]);
            b.contact(name, gap, 1.0);
        }
        let mut system = Wrong { machine: b.machine(), broken, bound: Vec::new() };
        let data = simulate(&mut system, &[-0.1, 0.0, 0.0, 1.0, 0.0, 0.0], Simulate::until(0.5)).dataset;
        let audit = data.audit("impact_rebounds").unwrap_or_else(|| panic!("no audit of the rebounds among {:?}", data.audits));
        assert_eq!(audit.ok, ok, "{broken:?}: {audit:?}");
    }
}

#[test]
fn a_restitution_above_one_is_refused_where_it_gains_energy() {
    let (machine, start) = machine(&Scene { restitution: 1.2, ..LANDS });
    let mut system = Wrong { machine, broken: Broken::Nothing, bound: Vec::new() };
    let outcome = simulate(&mut system, &start, Simulate::until(2.0));
    assert_eq!(outcome.fault.map(|f| f.code), Some("S126"));
}
