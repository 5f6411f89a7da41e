//! What is asked of stability.

use crate::machine::Machine;
use crate::periodic::Periodic;
use mechanics::asked::Asked;
use symbolic::SymbolId;

/// What is disturbed; SI.
#[derive(Clone, Debug)]
pub(super) struct Stability {
    /// Which motion.
    pub(super) about: About,
    /// Along which parameter.
    pub(super) over: Option<Range>,
    /// Number of values or places.
    pub(super) points: Option<usize>,
    /// Place among the studies of the file: its formulas are read anew with other values.
    pub(super) place: std::ops::Range<usize>,
}

/// Which motion is disturbed.
#[derive(Clone, Debug)]
pub(super) enum About {
    /// A motion, or a place of rest, after a period.
    Motion(Box<Periodic>),
    /// The positions of a machine whose coordinate runs uniformly.
    Running {
        /// The coordinate.
        angle: SymbolId,
        /// Its rate; none: that of the start.
        speed: Option<f64>,
    },
}

/// Values of a parameter.
#[derive(Clone, Debug)]
pub(super) struct Range {
    /// Its name.
    pub(super) name: String,
    /// First value.
    pub(super) from: f64,
    /// Last value.
    pub(super) to: f64,
}

/// Instants of a period at which the coefficients are looked at.
const INSTANTS: usize = 256;

impl Stability {
    pub(super) fn of(asked: &Asked) -> Stability {
        let about = match asked.coordinate("angle") {
            Some(angle) => About::Running { angle: angle.symbol, speed: asked.number("speed") },
            None => About::Motion(Box::new(Periodic { coefficients: INSTANTS, ..Periodic::of(asked) })),
        };
        let ends = asked.number("from").zip(asked.number("to"));
        let over = asked.word("parameter").zip(ends).map(|(name, (from, to))| Range { name: name.to_owned(), from, to });
        Stability { about, over, points: asked.count("points"), place: asked.span.clone() }
    }

    /// The same study as a machine has it in its file.
    pub(super) fn in_file(&self, machine: &Machine) -> Option<Stability> {
        machine.model.studies.iter().find(|asked| asked.kind == "stability" && asked.span == self.place).map(Stability::of)
    }

    /// The study as it reads with other values of parameters (a period 2*pi/w, a speed); what the command line says instead of the file holds.
    pub(super) fn reread(&self, [before, after]: [Option<Stability>; 2]) -> Stability {
        let (Some(before), Some(after)) = (before, after) else { return self.clone() };
        let about = match (&self.about, before.about, after.about) {
            (About::Motion(own), About::Motion(old), About::Motion(new)) if own.period == old.period => {
                About::Motion(Box::new(Periodic { section: new.section, period: new.period, ..(**own).clone() }))
            }
            (About::Running { angle, speed }, About::Running { speed: old, .. }, About::Running { speed: new, .. }) if *speed == old => {
                About::Running { angle: *angle, speed: new }
            }
            (own, ..) => own.clone(),
        };
        Stability { about, ..self.clone() }
    }
}
