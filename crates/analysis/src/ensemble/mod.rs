//! Motions beside each other: the Taylor integrator for eight machines with one layout at once ([`program::ensemble`]).
//!
//! A lane has its own machine, step, modes, instants of switches and checks; the order is one for all, that of the tolerance. A step goes as in [`crate::integrate::taylor`]: its length from
//! the last coefficients of the states, never across an instant at which a formula of time switches, never across what an operation does beyond its polynomial; the rates at its end are held against
//! the slopes of the polynomials, and a step that is off is halved on the series that it has. What a lane cannot do is handed back: the motion is then done from its start by the scalar path.
//!
//! Nothing in a lane depends on the others: a motion has the same bits whatever runs beside it, and whenever it is put into a lane.

mod checks;
mod flow;
mod length;

pub(crate) use flow::{Flow, Fresh, State};
