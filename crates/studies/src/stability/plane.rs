//! The verdict over a plane of two parameters by the diagram of Ince and Strutt of the machine itself, where it has one degree of freedom and its Hill equation depends on both smoothly.
//!
//! The equation is taken from the machine at few places; the traces over the plane are those of that equation. Before anything is believed they are laid against the equations of other places of the
//! plane, and at some of these the whole study is carried out, by steps in time.

use super::asked::{About, Stability};
use super::point::{self, Care};
use super::reduction::{Reduction, reduced};
use crate::machine::Machine;
use crate::repeat::Repeated;
use crate::watch::Watch;
use analysis::studies::stability::{Diagram, Scalar, Sheeted, TRACE, Verdict};
use std::sync::atomic::AtomicBool;

/// Places at which traces are laid against the equation of the machine.
const COMPARED: usize = 24;
/// Of them those at which the whole study is carried out: every so many.
const WHOLE: usize = 8;
/// Shares of the sides from one of these places to the next: the plastic number's, so that no two are near.
const NEXT: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_2];

/// The diagram of a machine.
#[derive(Clone, Debug)]
pub(crate) struct Plane {
    pub(crate) diagram: Diagram<Sheeted>,
    /// Largest difference of a trace from that of the machine's own equation, beside the larger of it and 1.
    pub(crate) difference: f64,
}

impl Plane {
    /// Places at which traces were compared.
    pub(crate) const COMPARED: usize = COMPARED;
    /// Difference up to which they are believed.
    pub(crate) const LIMIT: f64 = TRACE;

    /// Over both ranges, for so many points of a grid; none where there is no such equation, it is no smooth function of the values, or a comparison fails: then every place is asked by itself.
    pub(crate) fn of(machine: &Machine, repeated: &Repeated, over: &Over<'_>) -> Option<Plane> {
        let mut own = Own { machine: machine.clone(), reduction: None, repeated, names: over.names };
        let sheeted = Sheeted::of(over.ends, |x, y| own.scalar([x, y]))?;
        let mut plane = Plane { diagram: Diagram::of(sheeted, over.ends, over.points), difference: 0.0 };
        for k in 1..=COMPARED {
            let share = NEXT.map(|step| (0.5 + k as f64 * step).fract());
            let place: [f64; 2] = std::array::from_fn(|i| over.ends[i][0] + share[i] * (over.ends[i][1] - over.ends[i][0]));
            let exact = plane.diagram.equations.exact(&own.scalar(place)?).trace();
            let found = plane.diagram.trace(place[0], place[1]);
            let off = (0..2).map(|i| (found[i] - exact[i]).abs() / exact[i].abs().max(1.0)).fold(0.0, f64::max);
            // what is no number is refused too
            if off.is_nan() || off > Plane::LIMIT || k.is_multiple_of(WHOLE) && !own.agrees(Verdict::of_trace(found), over.interrupt)? {
                return None;
            }
            plane.difference = plane.difference.max(off);
        }
        Some(plane)
    }
}

/// What a plane is asked for.
pub(crate) struct Over<'a> {
    /// What changes along x and y.
    pub(crate) names: [&'a str; 2],
    /// Ends of both ranges, SI.
    pub(crate) ends: [[f64; 2]; 2],
    /// Points of the grid along both.
    pub(crate) points: [usize; 2],
    /// Set from outside to stop early.
    pub(crate) interrupt: Option<&'a AtomicBool>,
}

/// The machine itself.
struct Own<'a> {
    machine: Machine,
    reduction: Option<Reduction>,
    repeated: &'a Repeated,
    names: [&'a str; 2],
}

impl Own<'_> {
    /// Hill's equation of the machine with these values.
    fn scalar(&mut self, [x, y]: [f64; 2]) -> Option<Scalar> {
        let binding = self.machine.bind(&[(self.names[0], x), (self.names[1], y)]).ok()?;
        let study = self.study()?;
        reduced(&mut self.reduction, &self.machine, (&study, binding)).ok()?;
        match (&study.about, &self.reduction) {
            (About::Motion(motion), _) => point::of_rest(&mut self.machine, motion, Care::Verdict)?.scalar,
            (About::Running { .. }, Some(reduction)) => {
                let running = point::running(&mut self.machine, &study).ok()?;
                point::of_running(reduction, running, Care::Verdict).ok()?.scalar
            }
            (About::Running { .. }, None) => None,
        }
    }

    /// The study as the file reads with the values.
    fn study(&self) -> Option<Stability> {
        let asked = self.repeated.at(&self.machine).ok()?;
        (!asked.has("lyapunov")).then(|| Stability::of(&asked))
    }

    /// Whether the whole study has a verdict with the values of the last place, its checks hold, and it says no other thing.
    fn agrees(&mut self, verdict: Verdict, interrupt: Option<&AtomicBool>) -> Option<bool> {
        let study = self.study()?;
        let mut watch = Watch { interrupt, ..Watch::default() };
        let point = point::at(&mut self.machine, &study, self.reduction.as_ref(), Care::Full, &mut watch).ok()?;
        let told = [verdict, point.verdict].iter().all(|v| *v != Verdict::Limit);
        Some(point.audits.iter().all(|audit| audit.ok) && (!told || point.verdict == verdict))
    }
}
