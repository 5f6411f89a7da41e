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
    /// What a load without a frequency of its own gives by its value alone.
    pub constant: f64,
}
