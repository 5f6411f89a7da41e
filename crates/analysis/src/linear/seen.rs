//! What a formula shows of small motions.

/// An output near a state: mean + by_place·δq + by_rate·δq' + by_acceleration·δq'' + Σ c cos ν t + s sin ν t.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Seen {
    /// Value at the state.
    pub mean: f64,
    /// ∂y/∂q.
    pub by_place: Vec<f64>,
    /// ∂y/∂q'.
    pub by_rate: Vec<f64>,
    /// ∂y/∂q''.
    pub by_acceleration: Vec<f64>,
    /// (ν, c, s).
    pub waves: Vec<(f64, f64, f64)>,
    /// (index of the waveform, factor).
    pub forms: Vec<(usize, f64)>,
    /// Amplitudes of what oscillates in the slopes by q, q' and q'', which the slopes leave out; empty where nothing does.
    pub swings: [Vec<f64>; 3],
    /// Amplitude of what such oscillation makes of loads that stand in it by themselves.
    pub loose: f64,
    /// What a load without a frequency of its own gives by its value alone.
    pub constant: f64,
}

impl Seen {
    /// Adds to what oscillates in the slope of a level by a coordinate.
    pub(super) fn swing(&mut self, (level, coordinate): (usize, usize), amplitude: f64) {
        let slopes = &mut self.swings[level];
        if slopes.is_empty() {
            slopes.resize(self.by_place.len(), 0.0);
        }
        slopes[coordinate] += amplitude.abs();
    }
}
