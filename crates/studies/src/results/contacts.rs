//! What contacts and frictions did over time, as strips under the plots and as a table of events: arranged from the events of a motion.

use analysis::Dataset;
use analysis::dataset::{ContactChange, Event, Standing};
use report::figure::bands::{Band, Bands, State, Stretch};
use report::table::Column;
use report::{Cell, Table, Word};
use words::Language;

/// Contacts that a picture shows.
const MOST: usize = 40;
/// Digits of an impulse in the table.
const DIGITS: usize = 5;

/// The picture of a motion; none without contacts and frictions.
pub fn bands(data: &Dataset, language: Language) -> Option<Bands> {
    let times = &data.columns.get(data.axis?)?.values;
    let (first, last) = times.iter().fold((0.0_f64, 0.0_f64), |(a, b), t| (a.min(*t), b.max(*t)));
    if data.contacts.is_empty() || last <= first {
        return None;
    }
    let shown = data.contacts.iter().take(MOST);
    let bands = shown.map(|own| Track::new(own, data).band((first, last), language)).collect();
    Some(Bands { name: "contacts".into(), title: language.word(Word::Contacts).into(), range: (first, last), bands })
}

/// What each contact and friction did over time, by the user's name of it.
pub fn courses(data: &Dataset) -> Vec<(String, Vec<Stretch>)> {
    let Some(times) = data.axis.and_then(|i| data.columns.get(i)).map(|c| &c.values) else { return Vec::new() };
    let (first, last) = times.iter().fold((0.0_f64, 0.0_f64), |(a, b), t| (a.min(*t), b.max(*t)));
    let shown = data.contacts.iter().take(MOST);
    shown.map(|own| (own.contact.clone(), Track::new(own, data).band((first, last), Language::En).stretches)).collect()
}

/// A contact or friction followed along the events.
struct Track<'a> {
    own: &'a Standing,
    data: &'a Dataset,
    now: &'static str,
    /// Whether each contact that alone presses it is closed, by guard.
    pressed: Vec<(usize, bool)>,
}

impl<'a> Track<'a> {
    fn new(own: &'a Standing, data: &'a Dataset) -> Track<'a> {
        let closed = |guard: usize| data.contacts.iter().any(|c| c.guard == guard && presses(c.at_start));
        Track { own, data, now: own.at_start, pressed: own.pressed.iter().map(|guard| (*guard, closed(*guard))).collect() }
    }

    /// Nothing while no contact presses a friction.
    fn state(&self) -> Option<State> {
        let idle = !self.pressed.is_empty() && self.pressed.iter().all(|(_, closed)| !closed);
        (!idle).then_some(match self.now {
            "closed" | "taut" => State::Closed,
            "open" | "slack" => State::Open,
            "forward" => State::Forward,
            "backward" => State::Backward,
            _ => State::Sticks,
        })
    }

    fn band(mut self, (first, last): (f64, f64), language: Language) -> Band {
        let mut band = Band { name: language.text(&self.own.label).into(), stretches: Vec::new(), impacts: Vec::new() };
        let (mut from, mut before) = (first, self.state());
        for event in &self.data.events {
            let Some(change) = &event.contact else { continue };
            if event.guard == self.own.guard && change.impulse.is_some() {
                band.impacts.push(event.t);
            }
            self.follow(event, change);
            let after = self.state();
            if after != before {
                push(&mut band, (from, event.t), before);
                (from, before) = (event.t, after);
            }
        }
        push(&mut band, (from, last), before);
        band
    }

    fn follow(&mut self, event: &Event, change: &ContactChange) {
        if event.guard == self.own.guard {
            self.now = change.to;
        }
        if let Some((_, closed)) = self.pressed.iter_mut().find(|(guard, _)| *guard == event.guard) {
            *closed = presses(change.to);
        }
    }
}

fn presses(state: &str) -> bool {
    matches!(state, "closed" | "taut")
}

fn push(band: &mut Band, (from, to): (f64, f64), state: Option<State>) {
    if let Some(state) = state.filter(|_| to > from) {
        band.stretches.push(Stretch { from, to, state });
    }
}

/// Whether any contact struck: otherwise a table has no column of impulses.
fn strikes(events: &[&Event]) -> bool {
    events.iter().any(|event| event.contact.as_ref().is_some_and(|change| change.impulse.is_some()))
}

/// A table of these events with columns for contacts between the instant and the words.
pub fn table(time: Column, event: Column, events: &[&Event], language: Language) -> Table {
    let own = [Word::Contact, Word::Before, Word::After].map(|word| Column::new(language.word(word)));
    let impulse = strikes(events).then(|| Column::new(language.word(Word::Impulse)));
    Table::new(std::iter::once(time).chain(own).chain(impulse).chain(std::iter::once(event)).collect())
}

/// Their cells, event by event.
pub fn cells(events: &[&Event], language: Language) -> Vec<Vec<Cell>> {
    let width = if strikes(events) { 4 } else { 3 };
    let cell = |event: &&Event| {
        let mut cells = match &event.contact {
            None => vec![Cell::Empty; 4],
            Some(change) => vec![
                Cell::words(&change.contact),
                Cell::words(word(change.from, language)),
                Cell::words(word(change.to, language)),
                change.impulse.map_or(Cell::Empty, |p| Cell::number(p, DIGITS, language)),
            ],
        };
        cells.truncate(width);
        cells
    };
    events.iter().map(cell).collect()
}

/// A state in words.
fn word(state: &str, language: Language) -> &'static str {
    let (en, ru) = match state {
        "open" => ("open", "разомкнут"),
        "closed" => ("closed", "замкнут"),
        "slack" => ("slack", "провисает"),
        "taut" => ("taut", "натянут"),
        "forward" => ("slides forward", "скольжение вперёд"),
        "backward" => ("slides back", "скольжение назад"),
        "pushes" => ("pushes", "давит"),
        "pulls" => ("pulls", "тянет"),
        _ => ("sticks", "залипание"),
    };
    language.pick(en, ru)
}

#[cfg(test)]
mod tests {
    use super::*;
    use words::Text;

    fn standing(guard: usize, at_start: &'static str, pressed: Vec<usize>) -> Standing {
        let friction = !pressed.is_empty();
        Standing { contact: format!("c{guard}"), label: Text::same("contact"), at_start, guard, pressed, friction }
    }

    fn event(t: f64, guard: usize, (from, to): (&'static str, &'static str), impulse: Option<f64>) -> Event {
        let contact = Some(ContactChange { contact: format!("c{guard}"), from, to, impulse, endless: false });
        Event { t, guard, contact, ..Event::default() }
    }

    #[test]
    fn a_friction_has_no_state_while_nothing_presses_it() {
        let time = analysis::dataset::Column { values: vec![0.0, 4.0], ..Default::default() };
        let data = Dataset {
            axis: Some(0),
            columns: vec![time],
            contacts: vec![standing(0, "open", vec![]), standing(2, "forward", vec![0])],
            events: vec![
                event(1.0, 0, ("open", "open"), Some(2.0)),
                event(2.0, 0, ("open", "closed"), Some(1.0)),
                event(3.0, 2, ("forward", "sticking"), None),
            ],
            ..Dataset::default()
        };
        let bands = bands(&data, Language::En).unwrap();
        let stretch = |from, to, state| Stretch { from, to, state };
        assert_eq!(bands.bands[0].stretches, vec![stretch(0.0, 2.0, State::Open), stretch(2.0, 4.0, State::Closed)]);
        assert_eq!(bands.bands[0].impacts, vec![1.0, 2.0]);
        assert_eq!(bands.bands[1].stretches, vec![stretch(2.0, 3.0, State::Forward), stretch(3.0, 4.0, State::Sticks)]);
    }
}
