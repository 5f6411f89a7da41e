//! Outputs whose slopes oscillate in time: y = s(t) δq with s = s₀ + s₁ cos νt answers a motion at ω at ω ± ν as well.
//!
//! An output follows the small motion by the means of its slopes. What is left out is measured on the amplitudes: Σ |s₁| |X| over the amplitude that was found.

use super::limits::unsteady;
use super::response::{Forced, magnitude};
use crate::Fault;
use crate::linear::Seen;

/// Share that is rounding of the slopes.
const NOTHING: f64 = 1e-12;
/// Orders that are looked at.
const ORDERS: usize = 16;

impl Forced<'_> {
    /// Whether slopes of the outputs may oscillate in time.
    pub fn swings(&self) -> bool {
        self.machine.swings(&self.observer)
    }

    /// What the oscillation of its slopes adds to each output at the base frequency ω, relative to its largest amplitude; infinite where that is zero.
    ///
    /// *Errors*: formulas without a value at this frequency.
    pub fn swung(&mut self, omega: f64) -> Result<Vec<f64>, Fault> {
        self.matrices(omega)?;
        let seen = self.machine.observe(&self.observer, &self.place)?;
        let mut lost: Vec<f64> = seen.iter().map(|s| s.loose).collect();
        let (mut reach, mut found) = (vec![0.0_f64; seen.len()], vec![0.0_f64; seen.len()]);
        let (current, orders) = (self.current, self.components.iter().map(|c| c.order).take(ORDERS).collect::<Vec<_>>());
        for (k, order) in orders.into_iter().enumerate() {
            self.choose(k);
            let point = self.at(order * omega)?;
            let sizes: Vec<f64> = point.coordinates.iter().map(|z| magnitude(*z)).collect();
            for (i, s) in seen.iter().enumerate() {
                let mut power = 1.0;
                for (swings, slopes) in s.swings.iter().zip([&s.by_place, &s.by_rate, &s.by_acceleration]) {
                    lost[i] += power * swings.iter().zip(&sizes).map(|(a, x)| a * x).sum::<f64>();
                    reach[i] += power * slopes.iter().zip(&sizes).map(|(a, x)| (a * x).abs()).sum::<f64>();
                    power *= point.omega;
                }
                found[i] = found[i].max(magnitude(point.outputs[i]));
            }
        }
        self.choose(current);
        let share = |i: usize| if lost[i] <= NOTHING * reach[i].max(found[i]) { 0.0 } else { lost[i] / found[i] };
        Ok((0..seen.len()).map(share).map(|s| if s.is_nan() { 0.0 } else { s }).collect())
    }
}

impl Forced<'_> {
    /// Outputs that change with time by themselves and do not repeat.
    pub fn frozen(&self) -> &[usize] {
        &self.observer.frozen
    }

    /// Outputs with a part that oscillates by itself, at a rate that none of the loads has at the base frequency ω; that rate.
    ///
    /// *Errors*: formulas without a value at this frequency.
    pub fn foreign(&mut self, omega: f64) -> Result<Vec<(usize, f64)>, Fault> {
        self.matrices(omega)?;
        let seen = self.machine.observe(&self.observer, &self.place)?;
        let rates = self.form_rates()?;
        let own = |rate: f64| self.components.iter().any(|c| (rate - c.order * omega).abs() <= SAME * rate);
        let one = |s: &Seen| {
            let waves = s.waves.iter().filter(|w| w.1 != 0.0 || w.2 != 0.0).map(|w| w.0.abs());
            let forms = s.forms.iter().filter(|f| f.1 != 0.0).filter_map(|f| rates.get(f.0).map(|r| r.abs()));
            waves.chain(forms).find(|rate| *rate > 0.0 && !own(*rate))
        };
        Ok(seen.iter().enumerate().filter_map(|(k, s)| Some((k, one(s)?))).collect())
    }

    /// The frequency of the load per unit of the parameter that sets it.
    pub fn multiple(&self) -> Option<f64> {
        self.follows.map(|(_, per)| per.abs().recip())
    }
}

/// Rates that differ by this share are one.
const SAME: f64 = 1e-9;

/// Share beyond which amplitudes by the means are refused. What a load does to slopes (a tension that turns with a swing) is small of second order in it, and is told.
const REFUSED: f64 = 0.2;
/// Share that is worth a word.
const TOLD: f64 = 1e-6;

/// What is to be said of an output of this name; nothing below a millionth.
///
/// *Errors*: S108 where its amplitude by the means may be wrong by more than a fifth.
pub fn judged(name: &str, share: f64) -> Result<Option<words::Text>, Fault> {
    match share {
        _ if share > REFUSED => Err(unsteady(name, share)),
        _ if share > TOLD => Ok(Some(told(name, share))),
        _ => Ok(None),
    }
}

fn told(name: &str, share: f64) -> words::Text {
    let share = words::digits::rounded(share);
    words::Text::new(
        format!(
            "`{name}` follows the motion by a factor that oscillates in time: its amplitudes, by the mean of the factor, are uncertain by {} of the largest; `periodic` gives them exactly",
            share.en
        ),
        format!(
            "величина `{name}` зависит от движения через множитель, колеблющийся во времени: её амплитуды, найденные по среднему множителя, неточны на {} от наибольшей; точные даёт \
             `periodic`",
            share.ru
        ),
    )
}
