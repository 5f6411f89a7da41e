//! What the study is asked for.

use mechanics::asked::Asked;
use mechanics::model::Plot;
use std::f64::consts::TAU;
use symbolic::SymbolId;

/// One position a degree.
const USUAL_POINTS: usize = 361;

/// Energy balance of a cyclic machine; SI.
#[derive(Clone, Debug)]
pub struct Cycle {
    /// The angle that describes the cycle.
    pub angle: SymbolId,
    /// Its name.
    pub name: String,
    /// How many turns of 2π make a cycle (2 for a four-stroke engine); negative when it falls.
    pub turns: f64,
    /// Uniform rate of the angle; `None`: its starting rate.
    pub speed: Option<f64>,
    /// Parameter found from the balance: a drive force or torque. `None`: the balance is only drawn up.
    pub unknown: Option<String>,
    /// Wanted irregularity of running, (max - min)/mean of the rate.
    pub irregularity: Option<f64>,
    /// Parameter, an inertia, changed for the wanted irregularity.
    pub flywheel: Option<String>,
    /// How many positions of the tables, both ends included.
    pub points: usize,
    /// Plots wanted; the horizontal axis `None` is the angle.
    pub plots: Vec<Plot>,
}

impl Cycle {
    /// The balance that is asked for; none without an angle.
    pub fn of(asked: &Asked) -> Option<Cycle> {
        let angle = asked.coordinate("angle")?;
        let turns = asked.number("turns").unwrap_or(1.0);
        Some(Cycle {
            angle: angle.symbol,
            name: angle.name.clone(),
            turns,
            speed: asked.number("speed").or(asked.number("period").map(|p| TAU * turns / p)),
            unknown: asked.word("unknown").map(str::to_owned),
            irregularity: asked.number("irregularity"),
            flywheel: asked.word("flywheel").map(str::to_owned),
            points: asked.count("points").unwrap_or(USUAL_POINTS),
            plots: asked.plots().to_vec(),
        })
    }
}
