//! What the study is asked for.

use mechanics::asked::{Asked, Value};
use mechanics::model::Plot;
use symbolic::{Expr, SymbolId};

/// One position a degree: a drawing of a turn needs as many to look smooth.
const USUAL_POINTS: usize = 361;

/// Positions, velocities and accelerations over a range of one coordinate; SI.
#[derive(Clone, Debug)]
pub struct Kinematics {
    /// The driven coordinate.
    pub over: SymbolId,
    /// Its name.
    pub name: String,
    /// First value; `None`: the coordinate's start.
    pub from: Option<f64>,
    /// Last value.
    pub to: KinematicsEnd,
    /// How many positions, both ends included.
    pub points: usize,
    /// Rate of the driven coordinate, constant, from which velocities and accelerations follow; `None`: its starting rate, or 1 when
    /// that is zero.
    pub rate: Option<f64>,
    /// Further driven coordinates as formulas of the driven one, for linkages of two and more degrees of freedom.
    pub with: Vec<(SymbolId, Expr)>,
    /// Outputs wanted, by name (also coordinates and rates); empty means all.
    pub outputs: Vec<String>,
    /// Plots wanted; the horizontal axis `None` is the driven coordinate.
    pub plots: Vec<Plot>,
}

/// Where a kinematic range ends.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum KinematicsEnd {
    /// At this value.
    At(f64),
    /// After so many turns of 2π from the first value.
    Turns(f64),
}

impl Kinematics {
    /// What is asked for; none without a driven coordinate.
    pub fn of(asked: &Asked) -> Option<Kinematics> {
        let over = asked.coordinate("over")?;
        let to = match asked.number("to") {
            Some(to) => KinematicsEnd::At(to),
            None => KinematicsEnd::Turns(asked.number("turns").unwrap_or(1.0)),
        };
        let with = if let Some(Value::Driven(with)) = asked.get("with") { with.clone() } else { Vec::new() };
        Some(Kinematics {
            over: over.symbol,
            name: over.name.clone(),
            from: asked.number("from"),
            to,
            points: asked.count("points").unwrap_or(USUAL_POINTS),
            rate: asked.number("rate"),
            with,
            outputs: asked.words("outputs").to_vec(),
            plots: asked.plots().to_vec(),
        })
    }
}
