//! Closed forms whose constants cancel.
//!
//! Near resonance the textbook formula is a difference of two large oscillations of almost one frequency, near critical damping one of two large exponentials:
//!
//! ```text
//! x = h/(k² − p²) (sin pτ − (p/k) sin kτ) → beats of frequency (k − p)/2,  |x| ≤ h τ/(2k) while |k − p| τ is small
//! ```
//!
//! The motion itself is computed by divided differences (see [`super::oscillator`]), where nothing cancels; who puts rounded constants into the formula loses
//! as many digits as the constants exceed the motion.

use super::motion::{Mode, Motion};
use super::oscillator::Oscillator;
use super::phase::Phase;
use algebra::elementary;
use words::Text;
use words::digits::rounded;

/// Constants this many times the motion are spoken of: of six printed digits half are left.
const SPOKEN: f64 = 1e3;
/// Instants of a phase at which the motion is looked at: several to an oscillation are not needed, a beat's largest value is met within a few percent.
const LOOKS: usize = 257;

/// A note where constants cancel up to the instant `last`, on the phase that loses most.
pub(super) fn check(phases: &[Phase], last: f64) -> Option<Text> {
    let mut worst: Option<(f64, f64, f64)> = None;
    for phase in phases.iter().filter(|p| p.start < last) {
        let Motion::Modes(modes) = &phase.motion else { continue };
        let tau = last.min(phase.end) - phase.start;
        for (size, times) in modes.iter().filter_map(|mode| excess(mode, tau)) {
            if worst.is_none_or(|w| times > w.1) {
                worst = Some((size, times, phase.start));
            }
        }
    }
    worst.filter(|w| w.1 >= SPOKEN).map(|(size, times, start)| note(size, times, start))
}

/// The largest constant of a mode, and how many times the motion up to τ it is.
fn excess(mode: &Mode, tau: f64) -> Option<(f64, f64)> {
    let o = &mode.oscillator;
    let size = largest_constant(o);
    let at = |i: usize| o.at(tau * i as f64 / (LOOKS - 1) as f64)[0].abs();
    let motion = (0..LOOKS).map(at).fold(0.0, f64::max);
    (motion > 0.0 && size.is_finite()).then(|| (size, size / motion))
}

fn largest_constant(o: &Oscillator) -> f64 {
    let c = o.constants();
    let waves = c.harmonics.iter().filter_map(|h| h.amplitude);
    c.free.iter().copied().chain(waves).chain([c.rest]).fold(0.0_f64, |m, v| m.max(v.abs()))
}

fn note(size: f64, times: f64, start: f64) -> Text {
    let (size, shown, start) = (rounded(size), rounded(times), rounded(start));
    let lost = elementary::log10(times).ceil() as usize;
    Text::new(
        format!(
            "constants of the closed form from t = {} s on reach {}, {} times the motion, and cancel (a load near resonance, roots that are almost equal, or a phase far shorter than its oscillations): whoever puts in rounded constants loses {lost} digits. The values shown are computed without this difference; sin pτ − sin kτ = 2 sin((p − k)τ/2) cos((p + k)τ/2) shows the beats",
            start.en, size.en, shown.en
        ),
        format!(
            "постоянные замкнутого решения с t = {} с достигают {}, что в {} раз больше самого движения, и взаимно сокращаются (нагрузка близка к резонансу, корни почти равны или этап много короче периода колебаний): при подстановке округлённых постоянных теряется цифр: {lost}. Приведённые значения вычислены без этой разности; биения показывает запись sin pτ − sin kτ = 2 sin((p − k)τ/2) cos((p + k)τ/2)",
            start.ru, size.ru, shown.ru
        ),
    )
}
