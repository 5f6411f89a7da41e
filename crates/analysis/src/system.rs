//! What a study may see of a machine.
//!
//! The state is x = (q, q', s): n coordinates, their n rates, auxiliary states. In a given combination of switch positions (modes) the
//! motion x(t) is analytic, and [`System::expand`] returns its Taylor coefficients, together with those of every guard: the formulas whose
//! sign decides the modes.

mod told;

pub use program::Mode;
pub use told::{
    Bends, Blow, BlowWork, Corner, Corners, Guard, GuardKind, Jacobian, Layout, Motions, Powers, Since, SingleBlow, Supply, Tie, Touch,
    TouchLaw,
};
pub use words::Quantity;

use crate::Fault;
use program::{ABREAST, Behind};
use std::sync::Arc;
use words::Text;

/// A machine as studies see it.
pub trait System {
    /// States in the order (q, q', s).
    fn states(&self) -> &[Quantity];

    /// Number n of coordinates; states n..2n are their rates.
    fn n_coordinates(&self) -> usize;

    /// Whether state `i` is an angle whose full turns change nothing in the motion. The integrator then keeps it small, so that an angle of
    /// thousands of turns has the digits of the first one; outside it the turns are counted.
    fn turns_freely(&self, i: usize) -> bool {
        let _ = i;
        false
    }

    /// Guards.
    fn guards(&self) -> &[Guard];

    /// Outputs.
    fn outputs(&self) -> &[Quantity];

    /// The state that an output is, under whatever name; none where it is another formula.
    fn state_of(&self, output: usize) -> Option<usize> {
        self.states().iter().position(|s| s.name == self.outputs()[output].name)
    }

    /// Taylor coefficients 0..=order of all states and guards about (t, x) in the given modes, kept until the next call.
    ///
    /// *Errors*: the equations are singular or undefined there.
    fn expand(&mut self, t: f64, x: &[f64], modes: &[Mode], order: usize) -> Result<(), Fault>;

    /// Continues the last [`System::expand`], which was made at the same point in the same modes, to a higher order.
    ///
    /// *Errors*: those of [`System::expand`].
    fn extend(&mut self, t: f64, x: &[f64], modes: &[Mode], order: usize) -> Result<(), Fault> {
        self.expand(t, x, modes, order)
    }

    /// Jacobian ∂x'/∂x at (t, x) in the given modes, from [`System::slopes`]: row i holds the derivatives of x'_i. A system that gives none is
    /// integrated by Taylor series only.
    ///
    /// *Shapes*: row-major, length of x squared. *Errors*: the equations have no value or no derivative there.
    fn jacobian(&mut self, t: f64, x: &[f64], modes: &[Mode], jacobian: &mut [f64]) -> Result<Jacobian, Fault> {
        let (n, mut rows) = (x.len(), Vec::new());
        if !self.slopes(t, x, modes, &mut rows)? {
            return Ok(Jacobian::Absent);
        }
        for (i, (row, slopes)) in jacobian.chunks_mut(n.max(1)).zip(rows.chunks(n + 1)).enumerate() {
            row.copy_from_slice(&slopes[..n]);
            if !row.iter().all(|d| d.is_finite()) {
                return Err(Fault::not_finite(&Text::same(&self.states()[i].name), t));
            }
        }
        Ok(Jacobian::Given)
    }

    /// The longest step, at most `h`, over which the coefficients of the last [`System::expand`] say what the equations and the guards do, within the
    /// tolerance: no term that is flat at its start stays hidden. A system that cannot tell returns `h`.
    fn faithful(&mut self, h: f64, tolerance: f64) -> f64 {
        let _ = tolerance;
        h
    }

    /// Whether the last [`System::faithful`] has found a root or power at its zero, which is kept constant over the step.
    fn holds_powers(&self) -> bool {
        false
    }

    /// x' at (t, x) in the given modes, without disturbing the last expansion; false when it has no value there or the system cannot tell.
    fn rates(&mut self, t: f64, x: &[f64], modes: &[Mode], rates: &mut [f64]) -> bool {
        let _ = (t, x, modes, rates);
        false
    }

    /// Coefficients of state `i` from the last [`System::expand`]; length order + 1.
    fn state(&self, i: usize) -> &[f64];

    /// Coefficients of guard `i` from the last [`System::expand`]; length order + 1. Empty when the guard decides nothing in these modes.
    fn guard(&self, i: usize) -> &[f64];

    /// How far the conditions that always hold are from depending on one another at (t, x): the least pivot of their gradients by the metric of the kinetic energy,
    /// rows relative to their largest so far. It passes zero at change points. None without such conditions. Does not disturb the last expansion.
    fn margin(&mut self, t: f64, x: &[f64]) -> Option<f64> {
        let _ = (t, x);
        None
    }

    /// Sizes of what meets in the gaps and in the rates of contacts and frictions at (t, x), by guard: what is small beside them is rounding at a start. Empty where
    /// nothing is known. Does not disturb the last expansion.
    fn reaches(&mut self, t: f64, x: &[f64]) -> Vec<(usize, [f64; 2])> {
        let _ = (t, x);
        Vec::new()
    }

    /// Closes the conditions to the last digits, where [`System::project`] leaves alone what is rounding.
    ///
    /// *Errors*: those of [`System::project`].
    fn polish(&mut self, t: f64, x: &mut [f64], modes: &[Mode]) -> Result<(), Fault> {
        let _ = (t, x, modes);
        Ok(())
    }

    /// Whether connections may tie the states, now or in other modes.
    fn is_tied(&self) -> bool {
        false
    }

    /// Margins worth asking for inside a step.
    fn margins(&self) -> usize {
        0
    }

    /// Derivatives at (t, x) in the given modes, exact up to rounding, put into `rows`: row by row those of the rates x', then of the guards; columns
    /// x, then t. False when the system knows values only. Does not disturb the last expansion.
    ///
    /// *Errors*: the equations are singular or undefined there.
    fn slopes(&mut self, t: f64, x: &[f64], modes: &[Mode], rows: &mut Vec<f64>) -> Result<bool, Fault> {
        let _ = (t, x, modes, rows);
        Ok(false)
    }

    /// Only these outputs, by index, will be asked for from now on; [`System::observe`] may leave the others alone.
    ///
    /// *Errors*: an output is undefined for the parameters.
    fn show(&mut self, wanted: &[usize]) -> Result<(), Fault> {
        let _ = wanted;
        Ok(())
    }

    /// Values of all outputs at (t, x) in the given modes. Does not disturb the last expansion.
    fn observe(&mut self, t: f64, x: &[f64], modes: &[Mode], values: &mut [f64]) -> Result<(), Fault>;

    /// Accelerations that outputs take from now on in place of those of the equations (of small motions, say), until none are given.
    fn impose(&mut self, accelerations: Option<&[f64]>) {
        let _ = accelerations;
    }

    /// The operations behind the outputs that are shown, by index of the output; none when the system knows values only.
    fn behind(&mut self) -> Arc<Behind> {
        Arc::default()
    }

    /// Puts the values of all outputs at (t, x), then the record of what stands behind them, into `row`.
    ///
    /// *Errors*: as [`System::observe`].
    fn sample(&mut self, t: f64, x: &[f64], modes: &[Mode], row: &mut Vec<f64>) -> Result<(), Fault> {
        row.clear();
        row.resize(self.outputs().len(), 0.0);
        self.observe(t, x, modes, row)
    }

    /// Puts the rounding of such a row into `row`, where the states are off by `errors`. Nothing when the system cannot tell.
    fn rounding(&mut self, (t, x): (f64, &[f64]), modes: &[Mode], errors: &[f64], row: &mut Vec<f64>) {
        let _ = (t, x, modes, errors);
        row.clear();
    }

    /// The operations of the equations and of the guards in force in these modes; none when the system knows values only.
    fn acting(&mut self, modes: &[Mode]) -> Option<Arc<Behind>> {
        let _ = modes;
        None
    }

    /// Puts the record of [`System::acting`] at (t, x) into `row`. Does not disturb the last expansion.
    ///
    /// *Errors*: those of the equations there.
    fn act(&mut self, t: f64, x: &[f64], modes: &[Mode], row: &mut Vec<f64>) -> Result<(), Fault> {
        let _ = (t, x, modes);
        row.clear();
        Ok(())
    }

    /// Puts the rounding of the record made last into `row`, where the states are off by `errors`.
    fn act_rounding(&mut self, errors: &[f64], row: &mut Vec<f64>) {
        let _ = errors;
        row.clear();
    }

    /// Why an output has no value, when it has none: it uses a reaction that is not unique.
    fn refusal(&self, output: usize) -> Option<Fault> {
        let _ = output;
        None
    }

    /// Guards of the contacts and frictions that have shared a load at a state that was observed, so that this output had no value there (not a number); none
    /// where it always had one.
    fn is_shared(&self, output: usize) -> Option<&[usize]> {
        let _ = output;
        None
    }

    /// Whether contacts and frictions that share a load at a state leave the motion itself open: a friction that slides is pressed by one of them, and goes by its
    /// share.
    fn moves_otherwise(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> bool {
        let _ = (t, x, modes);
        false
    }

    /// Remarks on the system, to be shown beside every result.
    fn notes(&self) -> &[Text] {
        &[]
    }

    /// Modes that the values of the guards have at a state; none when undefined there. The second derivation is taken in these.
    fn modes_by_value(&mut self, t: f64, x: &[f64]) -> Option<Vec<Mode>> {
        let _ = (t, x);
        Some(vec![Mode::Positive; self.guards().len()])
    }

    /// Sides of the guards at the start, from their values; none when the system leaves them to the search.
    fn sides(&mut self, t: f64, x: &[f64]) -> Option<Vec<Mode>> {
        let _ = (t, x);
        None
    }

    /// Powers at (t, x) with given accelerations q''; none when the system has no energies.
    fn powers(&mut self, t: f64, x: &[f64], accelerations: &[f64], modes: &[Mode]) -> Option<Powers> {
        let _ = (t, x, accelerations, modes);
        None
    }

    /// The same without dE/dt and what is compared with it: what the energy ledger integrates.
    fn supply(&mut self, t: f64, x: &[f64], accelerations: &[f64], modes: &[Mode]) -> Option<Supply> {
        let p = self.powers(t, x, accelerations, modes)?;
        Some(Supply { loads: p.loads, drives: p.drives, dissipated: p.dissipated })
    }

    /// [`System::supply`] at several places of a motion at once, with the rates of its velocities for q'', the same to the last bit; false where it has to be asked for place by
    /// place.
    fn supplies(&mut self, motions: &Motions, modes: &[Mode], into: &mut [Supply; ABREAST]) -> bool {
        let _ = (motions, modes, into);
        false
    }

    /// dE/dt alone.
    fn energy_rate(&mut self, t: f64, x: &[f64], accelerations: &[f64], modes: &[Mode]) -> Option<f64> {
        self.powers(t, x, accelerations, modes).map(|p| p.rate)
    }

    /// Kinetic and potential energy at (t, x); none when the system has no energies, or they have no value there.
    fn energies(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> Option<[f64; 2]> {
        let _ = (t, x, modes);
        None
    }

    /// Number of dry frictions.
    fn n_frictions(&self) -> usize {
        0
    }

    /// Power that each dry friction takes at (t, x), none for one that sticks. None altogether where the equations have no solution.
    fn frictions(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> Option<Vec<Option<f64>>> {
        let _ = (t, x, modes);
        None
    }

    /// All contacts and frictions at (t, x) with given accelerations and the forces of these modes. What is compared goes by values, not by modes.
    /// None where the equations have no solution.
    fn touches(&mut self, t: f64, x: &[f64], accelerations: &[f64], modes: &[Mode]) -> Option<Vec<Touch>> {
        let _ = (t, x, accelerations, modes);
        None
    }

    /// The same in an impact at the rates of x, before or after it: impulses of all reactions in place of forces.
    fn struck(&mut self, t: f64, x: &[f64], impulses: &[f64], modes: &[Mode]) -> Option<Vec<Touch>> {
        let _ = (t, x, impulses, modes);
        None
    }

    /// All outputs with impulses in place of the reactions and without accelerations: an output that is a power of a reaction is then that impulse times its
    /// rate at the state. Only those that are shown have values. None when the system has no reactions.
    fn impulse_powers(&mut self, t: f64, x: &[f64], modes: &[Mode], impulses: &[f64]) -> Option<Vec<f64>> {
        let _ = (t, x, modes, impulses);
        None
    }

    /// Directions in which the impulses of a blow may change and the motion after it, the state `x` in these modes, does not; by reaction.
    ///
    /// *Errors*: a formula has no value there.
    fn open_impulses(&mut self, t: f64, x: &[f64], modes: &[Mode], blow: &Blow) -> Result<Vec<Vec<f64>>, Fault> {
        let _ = (t, x, modes, blow);
        Ok(Vec::new())
    }

    /// Momenta in an impact by the second derivation, M Δq' - Σ forces Λ for each coordinate, with [Δq', Λ]: residual and size of the terms that met in it.
    fn momenta(&mut self, t: f64, x: &[f64], jump: [&[f64]; 2], modes: &[Mode]) -> Option<Vec<[f64; 2]>> {
        let _ = (t, x, jump, modes);
        None
    }

    /// Balances of the second derivation (motions, then released bodies) with given accelerations and the reactions of this state: residual and size of
    /// the terms that met in it. None when there are no reactions or no second derivation.
    fn balances(&mut self, t: f64, x: &[f64], accelerations: &[f64], modes: &[Mode]) -> Option<Vec<[f64; 2]>> {
        let _ = (t, x, accelerations, modes);
        None
    }

    /// Names of the entries of [`Blow::reactions`].
    fn impulses(&self) -> &[Quantity] {
        &[]
    }

    /// Bodies as numbers, with given accelerations and the reactions of this state, see [`Layout`]. None when the system knows no bodies.
    fn released(&mut self, t: f64, x: &[f64], accelerations: &[f64], modes: &[Mode]) -> Option<Vec<f64>> {
        let _ = (t, x, accelerations, modes);
        None
    }

    /// The placements among them, at any place.
    fn placements(&mut self, t: f64, x: &[f64]) -> Option<Vec<f64>> {
        let _ = (t, x);
        None
    }

    /// The same at several instants with their states, each with the bits that it has by itself.
    fn placements_at(&mut self, points: &[(f64, Vec<f64>)]) -> Option<Vec<Vec<f64>>> {
        points.iter().map(|(t, x)| self.placements(*t, x)).collect()
    }

    /// What [`System::released`] lists.
    fn layout(&self) -> Layout {
        Layout::default()
    }

    /// Whether the machine can be at (t, x): everything that places it has a value there.
    ///
    /// *Errors*: what has no value.
    fn placed(&mut self, t: f64, x: &[f64]) -> Result<(), Fault> {
        let _ = (t, x);
        Ok(())
    }

    /// Residuals of the second derivation at (t, x) with given accelerations, linear in these; false when there is no second derivation.
    fn second(&mut self, (t, x): (f64, &[f64]), accelerations: &[f64], modes: &[Mode], residuals: &mut [f64]) -> bool {
        let _ = (t, x, accelerations, modes, residuals);
        false
    }

    /// Moves x to the nearest state that keeps all conditions of connections, and the stuck and closed contacts of these modes: positions
    /// first, then rates. Returns the largest relative violation it found (the drift); zero when nothing had to be changed.
    ///
    /// *Errors*: the conditions cannot be met from here.
    fn project(&mut self, t: f64, x: &mut [f64], modes: &[Mode]) -> Result<f64, Fault> {
        let _ = (t, x, modes);
        Ok(0.0)
    }

    /// The same, where conditions on rates keep what they have kept since the state `from` of the same machine, if they are the derivative of something:
    /// wheels in mesh stay in the mesh in which they were mounted.
    ///
    /// *Errors*: as [`System::project`].
    fn rejoin(&mut self, t: f64, x: &mut [f64], modes: &[Mode], from: Since<'_>) -> Result<f64, Fault> {
        let _ = from;
        self.project(t, x, modes)
    }

    /// What conditions on rates have gained since the state `from`, SI: zero along a motion. Zero also for a condition that has a place, or is the derivative of nothing.
    ///
    /// *Errors*: a formula has no value on the way.
    fn kept(&mut self, t: f64, x: &[f64], modes: &[Mode], from: Since<'_>) -> Result<Vec<f64>, Fault> {
        let _ = (t, x, modes, from);
        Ok(Vec::new())
    }

    /// What the last [`System::project`] found, condition by condition: violation and size of the terms that meet in it, of places and of rates.
    fn drifts(&self) -> &[[f64; 2]] {
        &[]
    }

    /// How many of the contacts and frictions that hold in these modes repeat others or what holds anyway; those that others carry do not count.
    ///
    /// *Errors*: undefined there.
    fn repeats(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> Result<usize, Fault> {
        let _ = (t, x, modes);
        Ok(0)
    }

    /// How the contacts and frictions that hold in these modes can carry their load within their limits; first where most is left of the limits of `relieved`, by
    /// guard. Empty where they cannot; none where nothing is shared.
    fn shares(&mut self, t: f64, x: &[f64], modes: &[Mode], relieved: &[usize]) -> Option<Corners> {
        let _ = (t, x, modes, relieved);
        None
    }

    /// Modes that contacts and frictions which hold in these modes take where they cannot hold, by guard: a suggestion.
    fn likely(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> Option<Vec<(usize, Mode)>> {
        let _ = (t, x, modes);
        None
    }

    /// Closed contacts whose gap has a step or a kink where the modes change from the first to the second, positions and rates of the coordinates running on.
    ///
    /// *Errors*: a place or a velocity that jumps otherwise with a formula of places.
    fn bend(&mut self, t: f64, x: &[f64], modes: [&[Mode]; 2]) -> Result<Bends, Fault> {
        let _ = (t, x, modes);
        Ok(Bends::default())
    }

    /// Moves the rates over a jump of prescribed velocities where the modes change from the first to the second: momenta jump by impulses of connections,
    /// contacts and frictions alone. `closing` are the contacts on their surfaces. None where nothing jumps.
    ///
    /// *Errors*: as [`System::impact`].
    fn jolt(&mut self, t: f64, x: &mut [f64], modes: [&[Mode]; 2], closing: &[usize]) -> Result<Option<Blow>, Fault> {
        let _ = (t, x, modes, closing);
        Ok(None)
    }

    /// Puts into x the rates after the impact of this instant, all conditions kept. `closing`: contacts (guards of kind `Contact`) on their
    /// surfaces; those that are closed in `modes` take part as well. Which of them strike, and in which order, is the system's law of impact.
    ///
    /// *Errors*: the impact has no solution or no end.
    fn impact(&mut self, t: f64, x: &mut [f64], modes: &[Mode], closing: &[usize]) -> Result<Blow, Fault> {
        let _ = (t, x, modes, closing);
        Ok(Blow::default())
    }

    /// What rounding can make of the contacts and frictions at (t, x), by guard: that of the terms that meet in their rates and in the balances behind
    /// their forces. Empty where nothing is known.
    fn ties(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> Vec<(usize, Tie)> {
        let _ = (t, x, modes);
        Vec::new()
    }

    /// Rounding of the gaps of contacts at a state, m or rad, by guard: what meets in them may be much longer than any way that the machine has gone.
    fn rounding_of_gaps(&mut self, t: f64, x: &[f64]) -> Vec<(usize, f64)> {
        let _ = (t, x);
        Vec::new()
    }

    /// What rounding can make of the accelerations q'' at (t, x), m/s² or rad/s²: that of the terms that meet in the balances. Empty where nothing is known.
    fn rounding_of_accelerations(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> Vec<f64> {
        let _ = (t, x, modes);
        Vec::new()
    }

    /// Generalized forces h(q, 0, s, 0) of rest at t = 0, length n, and their derivatives by the coordinates, row i = force i.
    ///
    /// *Errors*: undefined there, or the system has no statics.
    fn statics(&mut self, x: &[f64], forces: &mut [f64], derivatives: &mut [f64]) -> Result<(), Fault> {
        let _ = (x, forces, derivatives);
        Err(Fault::no_statics())
    }
}
