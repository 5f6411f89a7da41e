//! What figures and sentences ask of connections: what one takes hold of, how it is drawn and cut, what it demands in words. One kind of data, one file, one row
//! of [`of`]; names, letters and symbols of its tables stand in [`crate::shown`]. Nobody else looks at the data of a connection.
//!
//! [`part`] has the data that several rooms need, [`paper`] what a drawing and a sentence do for a connection, [`tie`] what a connection answers.

mod constraints;
mod frictions;
mod motions;
mod motors;
mod paper;
mod part;
mod pins;
mod rods;
mod rolling;
mod ropes;
mod sliders;
mod stops;
mod supports;
mod tie;
mod welds;
mod wheels;

pub(crate) use paper::{Knife, Layer, Paper, Teller};
pub(crate) use part::{Grip, Guide, Held, Letter, Limit, Own, Pair, Place, Rolls, Rope, Support};
pub(crate) use tie::Tie;

use mechanics::Model;
use mechanics::model::{Connection, ConnectionKind};

/// The row of a connection.
pub(crate) fn of(connection: &Connection) -> Box<dyn Tie + '_> {
    match &connection.kind {
        ConnectionKind::Pin { between, axes } => Box::new(pins::Pin { between: *between, axes: *axes }),
        ConnectionKind::Weld { between, axes } => Box::new(welds::Weld { between: *between, axes: *axes }),
        ConnectionKind::Slider { point, on, through, direction, turns } => {
            Box::new(Guide { point: *point, on: *on, through: *through, direction: *direction, turns: *turns })
        }
        ConnectionKind::Rod { between, .. } => Box::new(rods::Rod { between: *between }),
        ConnectionKind::Rope { path, wound, slack, .. } => Box::new(Rope { path, wound, slack: *slack }),
        ConnectionKind::Wheels { between, radii, opposite, .. } => Box::new(Pair { between: *between, radii: *radii, opposite: *opposite }),
        ConnectionKind::Rolling { wheel, center, radius, on, track, .. } => {
            Box::new(Rolls { wheel: *wheel, center: *center, radius: *radius, on: *on, track: *track })
        }
        ConnectionKind::Constraint { zero, on_rates } => Box::new(constraints::Constraint { zero: *zero, on_rates: *on_rates }),
        ConnectionKind::Support { at, directions, axes, on } => Box::new(Support { at: *at, directions, axes: *axes, on: *on }),
        ConnectionKind::Motion { pathway, value, .. } => Box::new(motions::Motion { pathway: *pathway, value: *value }),
        ConnectionKind::Motor { pathway } => Box::new(motors::Motor { pathway: *pathway }),
        ConnectionKind::Stop { gap, clearance, above, restitution, rebound, .. } => Box::new(stops::Stop {
            gap: *gap,
            limit: Limit { clearance: *clearance, above: *above },
            restitution: *restitution,
            rebound: *rebound,
        }),
        ConnectionKind::Friction { slides, kinetic, fixed, .. } => {
            Box::new(frictions::Friction { slides, kinetic: *kinetic, fixed: *fixed })
        }
    }
}

/// Everything that connections of a model take hold of.
pub(crate) fn grips(model: &Model) -> impl Iterator<Item = Grip> {
    model.connections.iter().flat_map(|c| of(c).grips())
}

/// Pairs of wheels, each with its table of the file.
pub(crate) fn pairs(model: &Model) -> impl Iterator<Item = (&'static str, Pair)> {
    model.connections.iter().filter_map(|c| of(c).pair().map(|pair| (c.table, pair)))
}
