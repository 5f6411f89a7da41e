//! A scheme that moves: the same items, the tracks that carry them, and the times of a motion. A track is the path of an origin with a turn; an item follows its
//! tracks as the row of its symbol says ([`Fit`]): carried, turned, or drawn anew between its ends.
//!
//! | what | file |
//! |---|---|
//! | places of items at a frame | `pose.rs` |
//! | what a page needs to play it | `data.rs` |
//! | the picture at the first frame, with marks for the script | `picture.rs` |
//! | a file that plays by itself (SMIL) | `smil.rs` |

mod course;
mod data;
mod picture;
mod pose;
mod smil;

pub use course::{Clock, Moving, Stay, Track};
pub use data::{Decoded, RESOLUTION, TURN};

use super::{Fit, Scheme};
use crate::rich::Rich;
use words::Language;

/// Numbers of places that a picture keeps: one frame of one track are three.
const MOST_NUMBERS: usize = 240_000;
/// Frames that a picture keeps.
const MOST_FRAMES: usize = 6000;
/// Seconds that a motion takes at least and at most when it is played.
const PLAYED: [f64; 2] = [3.0, 90.0];
/// Seconds that the slowest swing or turn takes when it is played.
const SWING: f64 = 1.5;

impl Moving {
    /// A moving picture; none where nothing moves. Frames beyond what a page keeps are left out evenly.
    pub fn new(mut scheme: Scheme, (times, tracks): (Vec<f64>, Vec<Track>), clock: Clock) -> Option<Moving> {
        scheme.items.retain(|item| item.symbol.fit != Fit::Sign);
        scheme.labels.retain(|label| label.rides.is_some());
        let moves = tracks.iter().any(|track| track.at.windows(2).any(|w| w[0] != w[1]) || track.turn.windows(2).any(|w| w[0] != w[1]));
        let finite = tracks.iter().all(|t| t.at.iter().flatten().chain(&t.turn).all(|c| c.is_finite()));
        let whole = tracks.iter().all(|t| [0, times.len()].contains(&t.at.len()) && [0, times.len()].contains(&t.turn.len()));
        if !(moves && finite && whole && times.len() > 1 && times.windows(2).all(|w| w[1] > w[0])) {
            return None;
        }
        let busy = 1 + tracks.iter().filter(|t| !t.at.is_empty()).count();
        let most = MOST_FRAMES.min(MOST_NUMBERS / (3 * busy)).max(2);
        let moving = Moving { scheme, rest: false, clock, times, tracks, states: Vec::new() };
        Some(if moving.times.len() > most { moving.thinned(most) } else { moving })
    }

    /// So many of its frames, the first and the last among them.
    #[must_use]
    pub fn thinned(&self, most: usize) -> Moving {
        let last = self.times.len() - 1;
        let kept: Vec<usize> = (0..most).map(|k| (k * last + (most - 1) / 2) / (most - 1)).collect();
        self.taken(&kept)
    }

    /// Frames at equal steps of time, for pictures that know no others; the nearest of the given ones.
    #[must_use]
    pub fn even(&self, count: usize) -> Moving {
        let (first, last) = (self.times[0], self.times[self.times.len() - 1]);
        let near = |k: usize| {
            let t = first + (last - first) * k as f64 / (count - 1) as f64;
            let after = self.times.partition_point(|s| *s < t).min(self.times.len() - 1);
            if after > 0 && t - self.times[after - 1] < self.times[after] - t { after - 1 } else { after }
        };
        let mut kept: Vec<usize> = (0..count.max(2)).map(near).collect();
        if count < 2 {
            kept = vec![0, self.times.len() - 1];
        }
        self.taken(&kept)
    }

    fn taken(&self, kept: &[usize]) -> Moving {
        let pick = |track: &Track| Track {
            at: if track.at.is_empty() { Vec::new() } else { kept.iter().map(|k| track.at[*k]).collect() },
            turn: if track.turn.is_empty() { Vec::new() } else { kept.iter().map(|k| track.turn[*k]).collect() },
        };
        let times = kept.iter().map(|k| self.times[*k]).collect();
        Moving { times, tracks: self.tracks.iter().map(pick).collect(), ..self.clone() }
    }

    /// Duration, SI.
    pub fn span(&self) -> f64 {
        self.times[self.times.len() - 1] - self.times[0]
    }

    /// Time of the motion in a second of playing: the slowest swing or turn takes a second and a half, the whole neither less than some seconds nor endless.
    /// A number 1, 2 or 5 times a power of ten.
    pub fn pace(&self) -> f64 {
        let span = self.span();
        let swings = self.tracks.iter().filter_map(|track| self.slowest(track)).fold(0.0, f64::max);
        let wanted = if swings > 0.0 { swings / SWING } else { span / (4.0 * SWING) };
        let pace = wanted.clamp(span / PLAYED[1], span / PLAYED[0]);
        let power = 10_f64.powf(pace.log10().floor());
        [5.0, 2.0, 1.0].into_iter().map(|m| m * power).find(|p| *p <= pace * 1.0001).unwrap_or(pace)
    }

    /// The period of what a track does most slowly: its turns, its swings to and fro; none for what goes one way only and for what is hardly seen.
    fn slowest(&self, track: &Track) -> Option<f64> {
        let span = self.span();
        let turned = track.turn.first().zip(track.turn.last()).map_or(0.0, |(a, b)| (b - a).abs() / std::f64::consts::TAU);
        let seen = |values: &mut dyn Iterator<Item = f64>, least: f64| {
            let values: Vec<f64> = values.collect();
            let (low, high) = values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
            (high - low > least).then(|| reversals(&values, 0.2 * (high - low))).filter(|n| *n > 1)
        };
        let swings = [
            seen(&mut track.at.iter().map(|p| p[0]), 6.0),
            seen(&mut track.at.iter().map(|p| p[1]), 6.0),
            if turned < 0.9 { seen(&mut track.turn.iter().copied(), 0.1) } else { None },
        ];
        let periods = swings.into_iter().flatten().map(|n| 2.0 * span / n as f64);
        periods.chain((turned >= 0.9).then(|| span / turned)).reduce(f64::max)
    }

    /// The picture at the first frame, for a page that plays it by its script.
    pub fn svg(&self, language: Language) -> String {
        picture::write(self, language)
    }

    /// A file that plays by itself, of so many frames.
    pub fn animated(&self, frames: usize, language: Language) -> String {
        smil::write(self, frames, language)
    }

    /// One frame as a picture.
    pub fn frame(&self, k: usize, language: Language) -> String {
        picture::frame(self, k, language)
    }

    /// What the script of a page needs, JSON.
    pub fn data(&self) -> serde_json::Value {
        data::write(self)
    }

    /// What is below it.
    pub fn title(&self) -> &Rich {
        &self.scheme.title
    }
}

/// How often values turn back by more than a margin.
fn reversals(values: &[f64], margin: f64) -> usize {
    let (mut extreme, mut sense, mut count) = (values.first().copied().unwrap_or(0.0), 0.0_f64, 0);
    for v in values {
        if sense == 0.0 {
            if (v - extreme).abs() > margin {
                (sense, extreme) = ((v - extreme).signum(), *v);
            }
        } else if (v - extreme) * sense > 0.0 {
            extreme = *v;
        } else if (extreme - v) * sense > margin {
            (sense, extreme, count) = (-sense, *v, count + 1);
        }
    }
    count
}
