//! The walk along the way, place by place.

use crate::audits::worse;
use crate::fault::codes;
use std::sync::Arc;
use words::{Message, Text};

use super::linkage::{Linkage, Spot, spot};
use super::stand::Stand;
use super::way::Doubts;
use crate::Fault;
use crate::dataset::{Audit, Extreme};
use program::Behind;
use words::digits::ten_digits;

/// The linkage over its way.
#[derive(Clone, Debug, Default)]
pub struct Followed {
    /// Places, as far as the linkage goes.
    pub places: Vec<Place>,
    /// Least and greatest values of the quantities observed, with the value of the leading coordinate; column k + 1 is quantity k. Those that could not be
    /// followed everywhere are left out.
    pub extremes: Vec<Extreme>,
    /// Checks.
    pub audits: Vec<Audit>,
    /// Remarks.
    pub notes: Vec<Text>,
    /// What ended it early.
    pub fault: Option<Fault>,
}

/// Violations of conditions, relative to the terms that meet in them.
const HELD: f64 = 1e-11;

/// Places by integral against places by closing, rad or arms; rates alike, relative to the fastest.
const AGREES: f64 = 1e-9;

/// Relative residual of the rates above which further drives contradict the linkage.
const CONTRADICTS: f64 = 1e-8;

/// Strides beside a singular first place at which the way begins.
const BESIDE: f64 = 3.5;

/// A gap may fall below zero by this share of an arm: rounding of a contact that just touches.
const PENETRATED: f64 = 1e-9;

/// A place with the derivatives along the way.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Place {
    /// Coordinates.
    pub q: Vec<f64>,
    /// Auxiliary states.
    pub auxiliaries: Vec<f64>,
    /// Time at the uniform rate, 0 at the first place.
    pub time: f64,
    /// dq/ds, s the parameter of the way.
    pub first: Vec<f64>,
    /// d²q/ds².
    pub second: Vec<f64>,
}

/// Quantities over the places of a linkage.
pub trait Observer {
    /// How many there are.
    fn count(&self) -> usize;
    /// Their values at a place, then the record of the operations behind them; not numbers where they have no value.
    fn values(&mut self, place: &Place) -> Vec<f64>;
    /// The operations behind them.
    fn behind(&self) -> Arc<Behind>;
}

pub(super) struct Walk<'w, 'e> {
    pub(super) linkage: &'w mut Linkage<'e>,
    pub(super) doubts: Doubts,
    /// Violations of places, rates, accelerations.
    pub(super) worst: [f64; 3],
    /// Rates by integral against rates by the linear system.
    pub(super) rates: f64,
    /// Largest |dq/ds|.
    pub(super) largest: f64,
}

impl Walk<'_, '_> {
    /// All places; `stands` are those that can be stood on.
    pub(super) fn all(&mut self, start: &[f64], at: &[f64], found: &mut Followed, stands: &mut Vec<Stand>) -> Result<(), Fault> {
        let mut here = self.first(start, at)?;
        for &s in at {
            let place = match self.next(&here, s) {
                Ok((stand, place)) => {
                    here = stand;
                    stands.push(here.clone());
                    place
                }
                // a position that can be passed and not stood on: the way goes on from the place before
                Err(fault) if fault.code == codes::BRANCHING => {
                    found.notes.push(change_point(s));
                    self.between(&here, s)?
                }
                Err(fault) => return Err(fault),
            };
            self.clear(&place, s)?;
            found.places.push(place);
        }
        Ok(())
    }

    pub(super) fn next(&mut self, here: &Stand, s: f64) -> Result<(Stand, Place), Fault> {
        let mut stand = self.linkage.advance(here, s, &mut self.doubts)?;
        let place = self.place(&mut stand)?;
        Ok((stand, place))
    }

    /// The first place; where the linkage cannot stand in it, one beside it.
    pub(super) fn first(&mut self, start: &[f64], at: &[f64]) -> Result<Stand, Fault> {
        let from = at.first().copied().unwrap_or(0.0);
        let lead = start[self.linkage.over];
        let away = if lead == from { at.last().copied().unwrap_or(from) - from } else { lead - from };
        match self.begin(start, from) {
            Err(fault) if fault.code == codes::BRANCHING => {
                let beside = from + BESIDE * self.linkage.stride() * away.signum();
                self.begin(start, beside).map_err(|_| fault)
            }
            begun => begun,
        }
    }

    /// The place at `from`, from the start of the machine along an even way.
    pub(super) fn begin(&mut self, start: &[f64], from: f64) -> Result<Stand, Fault> {
        let at = spot(start, self.linkage.n);
        let still = vec![0.0; self.linkage.n];
        self.linkage.approach(&at, from)?;
        let begun = self.determined(&at, from).and_then(|()| {
            let begun = Stand { s: 0.0, at, integrated: still };
            self.linkage.advance(&begun, 1.0, &mut self.doubts)
        });
        self.linkage.arrived();
        let at = begun?.at;
        let integrated = match self.linkage.first(from, &at)? {
            Some((b, residual)) if residual <= CONTRADICTS => b,
            Some(_) => return Err(self.contradiction()),
            None => return Err(self.linkage.singular(&at, from)),
        };
        Ok(Stand { s: from, at, integrated })
    }

    /// Whether the drives determine the motion at the start.
    pub(super) fn determined(&mut self, at: &Spot, from: f64) -> Result<(), Fault> {
        let free = self.linkage.freedoms(0.0, at)?;
        if free.is_empty() {
            let contradicted = self.linkage.first(0.0, at)?.is_some_and(|(_, residual)| residual > CONTRADICTS);
            return if contradicted { Err(self.contradiction()) } else { Ok(()) };
        }
        let n = self.linkage.n;
        if !self.really_free(at, &free)? {
            return Err(self.linkage.stuck(at, from)?);
        }
        // rounding of a null vector moves nothing
        let moves = |i: &usize| free.iter().any(|v| v[*i].abs() > 1e-8);
        let names: Vec<&str> = (0..n).filter(moves).map(|i| self.linkage.name(i)).collect();
        Err(undetermined(&self.linkage.driven_names(), &names, free.len()))
    }

    /// Whether the linkage has these freedoms beside the place, too: in a singular position they end at once.
    pub(super) fn really_free(&mut self, at: &Spot, free: &[Vec<f64>]) -> Result<bool, Fault> {
        let mut near = at.clone();
        for (k, v) in free.iter().enumerate() {
            let largest = v.iter().fold(f64::MIN_POSITIVE, |m, v| m.max(v.abs()));
            // a thousandth of a radian or metre, another one for each freedom: beside the singular position, within reach of Newton
            near.iter_mut().zip(v).for_each(|(q, v)| *q += 1e-3 * (1.0 + 0.3 * k as f64) * v / largest);
        }
        Ok(self.linkage.freedoms(0.0, &near)?.len() >= free.len())
    }

    /// Derivatives and checks at a place.
    pub(super) fn place(&mut self, here: &mut Stand) -> Result<Place, Fault> {
        let (b, c) = self.derivatives(here)?;
        self.check(here, &b, &c)?;
        here.integrated.clone_from(&b);
        Ok(self.made(here.s, &here.at, b, c))
    }

    /// The place at s, from one near it, without checks.
    pub(super) fn at(&mut self, near: &Stand, s: f64) -> Result<(Stand, Place), Fault> {
        let mut stand = self.linkage.advance(near, s, &mut self.doubts)?;
        let (b, c) = self.derivatives(&stand)?;
        stand.integrated.clone_from(&b);
        let place = self.made(s, &stand.at, b, c);
        Ok((stand, place))
    }

    pub(super) fn derivatives(&mut self, here: &Stand) -> Result<(Vec<f64>, Vec<f64>), Fault> {
        let Some((b, residual)) = self.linkage.first(here.s, &here.at)? else { return Err(self.linkage.singular(&here.at, here.s)) };
        if residual > CONTRADICTS {
            return Err(self.contradiction());
        }
        match self.linkage.second(here.s, &here.at, &b)? {
            Some((c, _)) => Ok((b, c)),
            None => Err(self.linkage.singular(&here.at, here.s)),
        }
    }

    pub(super) fn made(&self, s: f64, at: &Spot, first: Vec<f64>, second: Vec<f64>) -> Place {
        let n = self.linkage.n;
        Place { q: at[..n].to_vec(), auxiliaries: at[n..].to_vec(), time: self.linkage.time(s), first, second }
    }

    pub(super) fn check(&mut self, here: &Stand, b: &[f64], c: &[f64]) -> Result<(), Fault> {
        let violations = self.linkage.violations(here.s, &here.at, b, c)?;
        self.worst.iter_mut().zip(violations).for_each(|(w, v)| *w = worse(*w, v));
        let unit = |i: usize| if self.linkage.angles[i] { 1.0 } else { self.linkage.arm };
        for (i, (b, other)) in b.iter().zip(&here.integrated).enumerate() {
            self.largest = self.largest.max(b.abs() / unit(i));
            self.rates = worse(self.rates, (b - other).abs() / unit(i));
        }
        Ok(())
    }

    /// A singular position that the linkage passes: everything between places on both sides, by a polynomial of degree 5.
    pub(super) fn between(&mut self, here: &Stand, centre: f64) -> Result<Place, Fault> {
        let n = self.linkage.n;
        let unit = self.linkage.stride();
        let mut sum = vec![0.0; here.at.len() + 2 * n];
        let mut stand = here.clone();
        for (k, weight) in [(-3.0, 0.05), (-2.0, -0.3), (-1.0, 0.75), (1.0, 0.75), (2.0, -0.3), (3.0, 0.05)] {
            stand = self.linkage.advance(&stand, centre + k * unit, &mut self.doubts)?;
            let (b, c) = self.derivatives(&stand)?;
            sum.iter_mut().zip(stand.at.iter().chain(&b).chain(&c)).for_each(|(sum, v)| *sum += weight * v);
        }
        let (at, derivatives) = sum.split_at(here.at.len());
        Ok(self.made(centre, &at.to_vec(), derivatives[..n].to_vec(), derivatives[n..].to_vec()))
    }

    /// No contact is entered.
    pub(super) fn clear(&mut self, place: &Place, s: f64) -> Result<(), Fault> {
        let at = [&place.q[..], &place.auxiliaries[..]].concat();
        let arm = self.linkage.arm;
        match self.linkage.gaps(s, &at)?.iter().find(|g| **g < -PENETRATED * arm) {
            None => Ok(()),
            Some(gap) => Err(entered(&self.linkage.driven_names(), s, *gap)),
        }
    }

    pub(super) fn contradiction(&self) -> Fault {
        let driven = self.linkage.driven_names();
        Fault::new(Message {
            code: "S027",
            what: Text::new(
                format!("the driven coordinates {driven} contradict the connections"),
                format!("ведущие координаты {driven} противоречат связям"),
            ),
            why: Text::new(
                "more coordinates are driven than the linkage has degrees of freedom, and their formulas do not fit together",
                "ведомых координат больше, чем степеней свободы, и их формулы не согласуются",
            ),
            help: Text::new("leave coordinates out of `with`", "уберите лишние координаты из `with`"),
        })
    }

    pub(super) fn audits(&self) -> Vec<Audit> {
        let of = |key: &str, en: &str, ru: &str, value: f64, limit: f64| Audit::at_most(key, Text::new(en, ru), value, limit);
        let largest = self.largest.max(f64::MIN_POSITIVE);
        let [places, rates, accelerations] = self.worst;
        vec![
            of("connections_places", "connections: places", "связи: положения", places, HELD),
            of("connections_rates", "connections: rates", "связи: скорости", rates, HELD),
            of("connections_accelerations", "connections: accelerations", "связи: ускорения", accelerations, HELD),
            of(
                "places_by_rates",
                "places: integral of the rates against closing",
                "положения: интеграл скоростей и замыкание",
                self.doubts.places,
                AGREES,
            ),
            of(
                "rates_by_accelerations",
                "rates: integral of the accelerations against the connections",
                "скорости: интеграл ускорений и связи",
                self.rates / largest,
                AGREES,
            ),
        ]
    }
}

fn change_point(s: f64) -> Text {
    let s = ten_digits(s);
    Text::new(
        format!(
            "at {} the position is singular (a change point): values there are interpolated between its sides, along the smooth way",
            s.en
        ),
        format!("при {} положение особое: значения в нём интерполированы по соседним положениям на гладком продолжении пути", s.ru),
    )
}

fn undetermined(driven: &str, free: &[&str], count: usize) -> Fault {
    let names = free.join(", ");
    Fault::new(Message {
        code: "S026",
        what: Text::new(
            format!("`{driven}` does not determine the motion: free are {names}"),
            format!("движение не определяется через `{driven}`: свободны {names}"),
        ),
        why: Text::new(
            format!("the linkage has {count} more degrees of freedom than driven coordinates"),
            format!("степеней свободы больше, чем ведущих координат, на {count}"),
        ),
        help: Text::new(
            format!("name as many further driven coordinates in `with`: with = {{ {} = \"0\" }}", free.first().unwrap_or(&"q")),
            format!("задайте столько же ведущих координат в `with`: with = {{ {} = \"0\" }}", free.first().unwrap_or(&"q")),
        ),
    })
}

fn entered(driven: &str, s: f64, gap: f64) -> Fault {
    let (s, gap) = (ten_digits(s), ten_digits(gap));
    Fault::new(Message {
        code: "S025",
        what: Text::new(
            format!("a contact is entered at `{driven}` = {}: its gap is {}", s.en, gap.en),
            format!("при `{driven}` = {} контакт нарушен: зазор равен {}", s.ru, gap.ru),
        ),
        why: Text::new(
            "kinematics follows the connections; what a stop would do to the motion depends on the forces",
            "кинематика следует связям; действие упора на движение зависит от сил",
        ),
        help: Text::new("end the range before it, or use `simulate`", "закончите промежуток раньше или используйте `simulate`"),
    })
}
