//! Bands: what each contact and friction did over time, one strip each, as a static picture. Colours say the state, a black tick an impact.

use super::Title;
use super::layout::{LEGEND_ROW, TEXT};
use super::ticks;
use super::width::text_width;
use crate::escape::markup;
use crate::palette::{FONTS, GRID, INK};
use crate::rich::Rich;
use crate::unit::Scale;
use crate::wording::Word;
use std::fmt::Write;
use words::Language;

/// A picture of bands over a common axis.
#[derive(Clone, Debug)]
pub struct Bands {
    /// Stem of file names.
    pub name: String,
    /// The caption.
    pub title: Rich,
    /// Ends of the axis of time, s.
    pub range: (f64, f64),
    /// One strip each, from the top.
    pub bands: Vec<Band>,
}

/// A strip.
#[derive(Clone, Debug)]
pub struct Band {
    /// What it belongs to.
    pub name: String,
    /// Stretches in order of time; gaps stay empty.
    pub stretches: Vec<Stretch>,
    /// Instants of impacts.
    pub impacts: Vec<f64>,
}

/// A state that lasts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// Start, s.
    pub from: f64,
    /// End, s.
    pub to: f64,
    /// Which.
    pub state: State,
}

/// States of contacts and frictions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum State {
    /// A contact that presses, a rope that pulls.
    Closed,
    /// A contact that is open, a rope that is slack.
    Open,
    /// A friction at rest.
    Sticks,
    /// A friction that slides in its positive direction.
    Forward,
    /// A friction that slides back.
    Backward,
}

const STATES: [State; 5] = [State::Closed, State::Open, State::Sticks, State::Forward, State::Backward];
const WIDTH: f64 = 720.0;
/// Height of a strip and distance to the next.
const STRIP: (f64, f64) = (13.0, 21.0);
/// Widest name.
const NAMES: f64 = 190.0;
/// Left edge of the legend.
const MARGIN: f64 = 16.0;
/// Width of a box of the legend.
const BOX: f64 = 22.0;

impl State {
    /// Fill: colours of Okabe and Ito, in lightness apart; open is a mere line.
    fn colour(self) -> &'static str {
        match self {
            State::Closed => "#0072b2",
            State::Open => "#ffffff",
            State::Sticks => "#009e73",
            State::Forward => "#e69f00",
            State::Backward => "#cc79a7",
        }
    }
    fn word(self) -> Word {
        match self {
            State::Closed => Word::StateClosed,
            State::Open => Word::StateOpen,
            State::Sticks => Word::StateSticks,
            State::Forward => Word::StateForward,
            State::Backward => Word::StateBackward,
        }
    }
}

impl Bands {
    /// The states that occur, in the order of the legend.
    fn states(&self) -> Vec<State> {
        let occurs = |state: &State| self.bands.iter().any(|b| b.stretches.iter().any(|s| s.state == *state));
        STATES.into_iter().filter(occurs).collect()
    }

    fn has_impacts(&self) -> bool {
        self.bands.iter().any(|b| !b.impacts.is_empty())
    }

    /// The picture in words, a line for each strip: impacts and shares of time.
    pub fn summary(&self, language: Language) -> String {
        let span = self.range.1 - self.range.0;
        let mut out = String::new();
        for band in &self.bands {
            let mut parts = Vec::new();
            for state in STATES {
                let time: f64 = band.stretches.iter().filter(|s| s.state == state).map(|s| s.to - s.from).sum();
                if time > 0.0 {
                    let share = crate::number::short(100.0 * time / span, 3, language);
                    parts.push(format!("{} {share}\u{a0}%", language.word(state.word())));
                }
            }
            if !band.impacts.is_empty() {
                parts.push(format!("{}: {}", language.word(Word::Impacts), band.impacts.len()));
            }
            let _ = writeln!(out, "  {}: {}", band.name, parts.join(", "));
        }
        out
    }
}

/// The picture as an SVG document.
pub fn write(bands: &Bands, place: Title, language: Language) -> String {
    let names = bands.bands.iter().map(|b| text_width(&b.name, TEXT)).fold(30.0, f64::max).min(NAMES);
    let (left, right) = (names + 16.0, WIDTH - 22.0);
    let key = place.room();
    let rows = legend(bands, language).last().map_or(0, |entry| entry.0 + 1);
    let top = key + rows as f64 * LEGEND_ROW + 8.0;
    let bottom = top + bands.bands.len() as f64 * STRIP.1;
    let height = bottom + 42.0;
    let mut draw = Draw { out: String::new(), bands, left, right, language };
    let title = markup(&bands.title.plain(language));
    let _ = write!(
        draw.out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{height:.0}\" viewBox=\"0 0 {WIDTH} {height:.0}\" role=\"img\" \
         aria-label=\"{title}\" font-family=\"{FONTS}\" font-size=\"{TEXT}\" fill=\"{INK}\">\n<rect width=\"{WIDTH}\" height=\"{height:.0}\" fill=\"#ffffff\"/>\n"
    );
    if place == Title::Above {
        let _ = writeln!(draw.out, "<text x=\"{left:.1}\" y=\"18\" font-size=\"14\">{title}</text>");
    }
    draw.legend(key);
    draw.axis(top, bottom);
    for (i, band) in bands.bands.iter().enumerate() {
        draw.band(band, top + i as f64 * STRIP.1 + 0.5 * (STRIP.1 - STRIP.0));
    }
    draw.out.push_str("</svg>\n");
    draw.out
}

struct Draw<'a> {
    out: String,
    bands: &'a Bands,
    left: f64,
    right: f64,
    language: Language,
}

impl Draw<'_> {
    fn pixel(&self, t: f64) -> f64 {
        let (low, high) = self.bands.range;
        let part = if high > low { (t - low) / (high - low) } else { 0.0 };
        self.left + part.clamp(0.0, 1.0) * (self.right - self.left)
    }

    fn legend(&mut self, top: f64) {
        for (row, x, style, words) in legend(self.bands, self.language) {
            let y = top + (row as f64 + 0.5) * LEGEND_ROW;
            let _ = if style.is_empty() {
                write!(self.out, "<path d=\"M{:.1} {:.1}v13\" stroke=\"{INK}\" stroke-width=\"1.5\"/>", x + 0.5 * BOX, y - 6.5)
            } else {
                write!(self.out, "<rect x=\"{x:.1}\" y=\"{:.1}\" width=\"{BOX}\" height=\"11\" {style}/>", y - 5.5)
            };
            let _ = writeln!(self.out, "<text x=\"{:.1}\" y=\"{:.1}\">{}</text>", x + BOX + 6.0, y + 4.0, markup(words));
        }
    }

    fn axis(&mut self, top: f64, bottom: f64) {
        let scale = Scale::of_column("s", self.bands.range.1.abs().max(self.bands.range.0.abs()));
        let (low, high) = (self.bands.range.0 / scale.size, self.bands.range.1 / scale.size);
        for tick in ticks::linear(low, high, 8, self.language) {
            let x = self.pixel(tick.at * scale.size);
            let _ = writeln!(
                self.out,
                "<path d=\"M{x:.1} {top:.1}V{bottom:.1}\" stroke=\"{GRID}\"/><text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
                bottom + 17.0,
                markup(&tick.label)
            );
        }
        let _ = writeln!(self.out, "<path d=\"M{:.1} {bottom:.1}H{:.1}\" stroke=\"{INK}\"/>", self.left, self.right);
        let unit = scale.print(self.language);
        let _ = writeln!(
            self.out,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\"><tspan font-style=\"italic\">t</tspan>, {}</text>",
            self.right,
            bottom + 34.0,
            markup(&unit)
        );
    }

    fn band(&mut self, band: &Band, y: f64) {
        let name = cut(&band.name, NAMES);
        let _ = writeln!(self.out, "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>", self.left - 8.0, y + 10.5, markup(&name));
        // what is narrower than half a pixel is drawn once in it
        let mut drawn: (f64, Vec<State>) = (f64::NEG_INFINITY, Vec::new());
        for stretch in &band.stretches {
            let (mut from, mut to) = (self.pixel(stretch.from), self.pixel(stretch.to));
            if to - from < 0.5 {
                from = (2.0 * from).floor() / 2.0;
                to = from + 0.5;
                if drawn.0 != from {
                    drawn = (from, Vec::new());
                }
                if drawn.1.contains(&stretch.state) {
                    continue;
                }
                drawn.1.push(stretch.state);
            }
            let _ = writeln!(
                self.out,
                "<rect x=\"{from:.2}\" y=\"{y:.1}\" width=\"{:.2}\" height=\"{:.1}\" {}/>",
                to - from,
                STRIP.0,
                fill(stretch.state)
            );
        }
        let mut path = String::new();
        let mut before = f64::NEG_INFINITY;
        for t in &band.impacts {
            let x = self.pixel(*t);
            if x - before >= 0.5 {
                let _ = write!(path, "M{x:.1} {:.1}v{:.1}", y - 2.0, STRIP.0 + 4.0);
                before = x;
            }
        }
        if !path.is_empty() {
            let _ = writeln!(self.out, "<path d=\"{path}\" stroke=\"{INK}\" stroke-width=\"1.2\"/>");
        }
    }
}

/// Row, left edge, attributes of the box (none for a tick) and word of each entry of the legend.
fn legend(bands: &Bands, language: Language) -> Vec<(usize, f64, String, &'static str)> {
    let mut entries: Vec<(String, Word)> = bands.states().into_iter().map(|s| (fill(s), s.word())).collect();
    if bands.has_impacts() {
        entries.push((String::new(), Word::StateImpact));
    }
    let (mut row, mut x) = (0, MARGIN);
    let mut placed = Vec::new();
    for (style, word) in entries {
        let words = language.word(word);
        let wide = BOX + 6.0 + text_width(words, TEXT) + 14.0;
        if x > MARGIN && x + wide > WIDTH {
            (row, x) = (row + 1, MARGIN);
        }
        placed.push((row, x, style, words));
        x += wide;
    }
    placed
}

/// Attributes of a box in the colour of a state.
fn fill(state: State) -> String {
    let edge = if state == State::Open { " stroke=\"#b0b0b0\" stroke-width=\"0.8\"" } else { "" };
    format!("fill=\"{}\"{edge}", state.colour())
}

/// A name that fits.
fn cut(name: &str, width: f64) -> String {
    if text_width(name, TEXT) <= width {
        return name.into();
    }
    let mut out = String::new();
    for c in name.chars() {
        if text_width(&format!("{out}{c}…"), TEXT) > width {
            break;
        }
        out.push(c);
    }
    out + "…"
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bands() -> Bands {
        let stretch = |from, to, state| Stretch { from, to, state };
        Bands {
            name: "contacts".into(),
            title: "Contacts".into(),
            range: (0.0, 2.0),
            bands: vec![
                Band {
                    name: "floor".into(),
                    stretches: vec![stretch(0.0, 0.5, State::Open), stretch(0.5, 2.0, State::Closed)],
                    impacts: vec![0.2, 0.5],
                },
                Band {
                    name: "rough".into(),
                    stretches: vec![stretch(0.5, 1.0, State::Forward), stretch(1.0, 2.0, State::Sticks)],
                    impacts: vec![],
                },
            ],
        }
    }

    #[test]
    fn every_state_that_occurs_is_in_the_legend_and_no_other() {
        let svg = write(&bands(), Title::Above, Language::En);
        for word in ["closed, taut", "open, slack", "sticks", "slides forward", "impact", "floor", "rough"] {
            assert!(svg.contains(&format!(">{word}<")), "{word}");
        }
        assert!(!svg.contains("slides back"));
        assert!(write(&bands(), Title::Caption, Language::Ru).contains("скольжение вперёд"));
    }

    #[test]
    fn strips_in_words_give_shares_and_impacts() {
        let words = bands().summary(Language::En);
        assert!(words.contains("floor: closed, taut 75\u{a0}%, open, slack 25\u{a0}%, impacts: 2"), "{words}");
    }

    #[test]
    fn thousands_of_stretches_are_not_more_than_the_picture_can_show() {
        let mut many = bands();
        let state = |k: usize| if k.is_multiple_of(2) { State::Sticks } else { State::Forward };
        many.bands[1].stretches =
            (0..100_000).map(|k| Stretch { from: k as f64 * 2e-5, to: (k + 1) as f64 * 2e-5, state: state(k) }).collect();
        many.bands[0].impacts = (0..100_000).map(|k| k as f64 * 2e-5).collect();
        let svg = write(&many, Title::Above, Language::En);
        assert!(svg.len() < 2_000_000, "{}", svg.len());
    }
}
