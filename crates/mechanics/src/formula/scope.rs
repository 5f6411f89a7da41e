//! What the names in formulas mean.

use super::kind::{Depends, Kind};
use super::kinematic::{KinematicFunction, Takes};
use crate::requests::{Axis, ElementId, FrameId, Part, PointId, PointRef, RequestKind};
use crate::units::Dimension;
use std::cell::Cell;
use std::collections::HashMap;
use std::ops::Range;
use symbolic::{Expr, SymbolId};
use words::Notice;

/// Names that may stand for the circular frequency of small motions; the first that the model does not use otherwise is meant.
pub(crate) const FREQUENCIES: [&str; 3] = ["k", "omega", "ω"];

/// A name of formulas.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    pub kind: EntryKind,
    pub dimension: Kind,
    pub depends: Depends,
}

/// What a name stands for.
#[derive(Clone, Copy, Debug)]
pub(crate) enum EntryKind {
    /// q, q', q''.
    Coordinate([SymbolId; 3]),
    Parameter(SymbolId),
    /// The formula; `None` when it is faulty.
    Output(Option<Expr>),
}

/// Something with a position.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Place {
    Frame(FrameId),
    Point(PointId),
}

/// A function of formulas that an element answers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Told {
    /// `force`.
    pub function: &'static str,
    /// Dimension of its value.
    pub kind: Kind,
    /// Which of the values that the law of the element gives.
    pub value: usize,
}

/// All names.
#[derive(Default)]
pub(crate) struct Scope {
    names: HashMap<String, Entry>,
    /// in order of declaration, for suggestions
    listed: Vec<String>,
    places: HashMap<String, Place>,
    listed_places: Vec<String>,
    acting: HashMap<String, Vec<Acting>>,
    listed_elements: Vec<String>,
    /// How many suggestions were looked for.
    searches: Cell<usize>,
}

/// More suggestions than this are not looked for: a file of a hundred thousand slips must not cost as many searches.
const SEARCHES: usize = 300;

/// A name in a formula: its table, if it is given, the name, the place.
type Named<'n> = (Option<&'n str>, &'n str, &'n Range<usize>);

/// Something that acts with a force: an element, a connection.
struct Acting {
    table: &'static str,
    what: What,
}

impl Acting {
    /// How an element answers a function.
    fn told(&self, function: &str) -> Option<Told> {
        let What::Element(_, told) = &self.what else { return None };
        told.iter().find(|t| t.function == function).copied()
    }
}

enum What {
    /// With the functions that it answers.
    Element(ElementId, Vec<Told>),
    /// Index of the connection, and the components that it has.
    Connection(usize, Vec<(Part, Kind)>),
    /// A connection that is not read yet, or has a fault, which is reported.
    Announced,
}

impl Scope {
    /// The nearest of the candidates to a misspelt word, when it is near enough to be meant.
    pub(crate) fn nearest<'n>(&self, word: &str, candidates: impl IntoIterator<Item = &'n str>) -> Option<&'n str> {
        self.searches.set(self.searches.get() + 1);
        (self.searches.get() <= SEARCHES).then(|| words::nearest(word, candidates)).flatten()
    }
    pub(crate) fn declare(&mut self, name: &str, entry: Entry) {
        if self.names.insert(name.to_owned(), entry).is_none() {
            self.listed.push(name.to_owned());
        }
    }
    pub(crate) fn get(&self, name: &str) -> Option<&Entry> {
        self.names.get(name)
    }
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.listed.iter().map(String::as_str)
    }
    /// Symbols of all coordinates, rates and accelerations, in order of declaration.
    pub(crate) fn coordinates(&self) -> Vec<SymbolId> {
        let kinds = self.listed.iter().filter_map(|name| self.names.get(name)).map(|e| e.kind);
        kinds.filter_map(|kind| if let EntryKind::Coordinate(symbols) = kind { Some(symbols) } else { None }).flatten().collect()
    }
    /// Symbols of all rates, in order of declaration.
    pub(crate) fn rates(&self) -> Vec<SymbolId> {
        self.coordinates().chunks(3).filter_map(|q| q.get(1).copied()).collect()
    }
    /// Gives a name another meaning for a while; returns the one it had.
    pub(crate) fn cover(&mut self, name: &str, entry: Entry) -> Option<Entry> {
        self.names.insert(name.to_owned(), entry)
    }
    /// Gives a name the meaning back that it had before [`Scope::cover`].
    pub(crate) fn uncover(&mut self, name: &str, entry: Option<Entry>) {
        match entry {
            Some(entry) => self.names.insert(name.to_owned(), entry),
            None => self.names.remove(name),
        };
    }
    pub(crate) fn place(&self, name: &str) -> Option<Place> {
        self.places.get(name).copied()
    }
    pub(crate) fn place_names(&self) -> impl Iterator<Item = &str> {
        self.listed_places.iter().map(String::as_str)
    }
    pub(crate) fn declare_place(&mut self, name: &str, place: Place) {
        if self.places.insert(name.to_owned(), place).is_none() {
            self.listed_places.push(name.to_owned());
        }
    }
    /// Declares an element with the functions that it answers.
    pub(crate) fn declare_element(&mut self, (table, name): (&'static str, &str), index: usize, told: Vec<Told>) {
        self.declare_acting(name, Acting { table, what: What::Element(ElementId(index), told) });
    }
    /// Makes the name of a connection known before the connection is.
    pub(crate) fn announce_connection(&mut self, table: &'static str, name: &str) {
        self.declare_acting(name, Acting { table, what: What::Announced });
    }
    /// Takes the announcement of a row back that turned out to be no connection (a rod of a frame).
    pub(crate) fn withdraw(&mut self, table: &str, name: &str) {
        if let Some(all) = self.acting.get_mut(name) {
            all.retain(|a| a.table != table || !matches!(a.what, What::Announced));
        }
    }
    /// Declares an announced connection with the components of its reaction.
    pub(crate) fn declare_connection(&mut self, table: &'static str, name: &str, index: usize, parts: Vec<(Part, Kind)>) {
        let announced = self.acting.get_mut(name).and_then(|all| all.iter_mut().find(|a| a.table == table));
        if let Some(acting) = announced {
            acting.what = What::Connection(index, parts);
        }
    }
    /// The connections of that name (`K`, or `stops.K`) in these tables; the index of one with a fault of its own is missing.
    pub(crate) fn connections(&self, tables: &[&str], name: &str) -> Vec<(&'static str, Option<usize>)> {
        let (wanted, bare) = name.split_once('.').map_or((None, name), |(table, bare)| (Some(table), bare));
        let fits = |a: &&Acting| tables.contains(&a.table) && wanted.is_none_or(|table| table == a.table);
        let index = |a: &Acting| if let What::Connection(index, _) = a.what { Some(index) } else { None };
        self.acting.get(bare).into_iter().flatten().filter(fits).map(|a| (a.table, index(a))).collect()
    }
    /// The names in these tables.
    pub(crate) fn connections_of(&self, tables: &[&str]) -> impl Iterator<Item = &str> {
        let of = move |name: &&String| self.acting.get(*name).into_iter().flatten().any(|a| tables.contains(&a.table));
        self.listed_elements.iter().filter(of).map(String::as_str)
    }
    /// Whether `force` of a connection is the magnitude of several components.
    pub(crate) fn is_magnitude(&self, index: usize) -> bool {
        // whether a slider has one component or two only the derivation knows
        let known = |a: &Acting| !["sliders", "slots"].contains(&a.table);
        let of = |a: &Acting| matches!(&a.what, What::Connection(i, parts) if *i == index && known(a) && parts.iter().filter(|p| p.0 != Part::Moment).count() > 2);
        self.acting.values().flatten().any(of)
    }
    fn declare_acting(&mut self, name: &str, acting: Acting) {
        self.acting.entry(name.to_owned()).or_default().push(acting);
        self.listed_elements.push(name.to_owned());
    }
    /// A name in a placeholder: with its table when something else that acts has the same name.
    pub(crate) fn shown(&self, name: &str, kind: RequestKind) -> String {
        let all = self.acting.get(name).map_or(&[][..], Vec::as_slice);
        let is_own = |a: &&Acting| match (&a.what, kind) {
            (What::Connection(i, _), RequestKind::Reaction(index, _)) => *i == index,
            (What::Element(id, _), RequestKind::Element(own, _)) => *id == own,
            _ => false,
        };
        match all.iter().find(is_own) {
            Some(own) if all.len() > 1 => format!("{}.{name}", own.table),
            _ => name.to_owned(),
        }
    }

    /// What a kinematic function of these names asks for, and its dimension.
    pub(crate) fn request(
        &self,
        function: &KinematicFunction,
        arguments: &[(Option<String>, String, Range<usize>)],
        whole: &Range<usize>,
    ) -> Result<(RequestKind, Kind), Notice> {
        let dimension = function.dimension.map_or(Kind::Unknown, Kind::Known);
        let kind = match (function.takes, arguments.first()) {
            (Takes::Point, Some((table, name, span))) => {
                let at = match self.located(table.as_deref(), name, span)? {
                    Place::Point(p) => PointRef::Point(p),
                    Place::Frame(f) => PointRef::Origin(f),
                };
                of_point(function.name, at)
            }
            (Takes::Frame, Some((table, name, span))) => {
                let frame = self.frame(table.as_deref(), name, span)?;
                if function.name == "angle" { RequestKind::Angle(frame) } else { RequestKind::AngularVelocity(frame) }
            }
            (Takes::BodyOrNothing, Some((table, name, span))) => {
                RequestKind::KineticEnergy(Some(self.frame(table.as_deref(), name, span)?))
            }
            (Takes::Element | Takes::Acting, Some((table, name, span))) => {
                return self.element(function, (table.as_deref(), name, span));
            }
            (Takes::BodyOrNothing, None) => RequestKind::KineticEnergy(None),
            (Takes::Nothing, _) if function.name == "dissipation" => RequestKind::Dissipation,
            (Takes::Nothing, _) => RequestKind::PotentialEnergy,
            (_, None) => return Err(Notice::piece("M034", whole.clone(), "a name is missing", "не указано имя")),
        };
        Ok((kind, dimension))
    }

    fn located(&self, table: Option<&str>, name: &str, span: &Range<usize>) -> Result<Place, Notice> {
        let fits = |place: &Place| match table {
            None => true,
            Some("points") => matches!(place, Place::Point(_)),
            Some("bodies" | "frames") => matches!(place, Place::Frame(_)),
            Some(_) => false,
        };
        self.place(name).filter(fits).ok_or_else(|| self.unknown_place(name, span.clone()))
    }

    fn frame(&self, table: Option<&str>, name: &str, span: &Range<usize>) -> Result<FrameId, Notice> {
        match self.located(table, name, span)? {
            Place::Frame(f) => Ok(f),
            Place::Point(_) => Err(Notice::piece(
                "M014",
                span.clone(),
                format!("`{name}` is a point; a frame or body is needed here"),
                format!("`{name}` — точка, а здесь нужно тело или система отсчёта"),
            )
            .why("a point does not turn", "точка не поворачивается")),
        }
    }

    /// The fault of a name that is no frame, body or point.
    pub(crate) fn unknown_place(&self, name: &str, span: Range<usize>) -> Notice {
        let fault = Notice::piece(
            "M014",
            span,
            format!("there is no frame, body or point `{name}`"),
            format!("нет системы отсчёта, тела или точки `{name}`"),
        );
        match self.nearest(name, self.place_names()) {
            Some(near) => fault.meant(name, near),
            None => fault.help(
                format!("add [bodies.{name}], [frames.{name}] or an entry to [points]"),
                format!("добавьте [bodies.{name}], [frames.{name}] или строку в [points]"),
            ),
        }
    }

    fn element(&self, function: &KinematicFunction, (table, name, span): Named) -> Result<(RequestKind, Kind), Notice> {
        let all = self.acting.get(name).map_or(&[][..], Vec::as_slice);
        let of_elements = function.takes == Takes::Element;
        let fits = |a: &&Acting| table.is_none_or(|t| t == a.table) && (!of_elements || matches!(a.what, What::Element(..)));
        let found: Vec<&Acting> = all.iter().filter(fits).collect();
        let able: Vec<&Acting> = found.iter().copied().filter(|a| !of_elements || a.told(function.name).is_some()).collect();
        match (able.as_slice(), found.first()) {
            ([], None) => Err(self.unknown_element(name, span.clone())),
            ([], Some(one)) | ([one], _) => component(function.name, one, name, span),
            (several, _) => Err(ambiguous(function.name, several, name, span)),
        }
    }

    fn unknown_element(&self, name: &str, span: Range<usize>) -> Notice {
        let fault = Notice::piece(
            "M014",
            span,
            format!("there is no spring, damper or connection `{name}`"),
            format!("нет пружины, демпфера или связи `{name}`"),
        );
        match self.nearest(name, self.listed_elements.iter().map(String::as_str)) {
            Some(near) => fault.meant(name, near),
            None => fault,
        }
    }
}

/// The force of an element, or a component of a connection's reaction.
fn component(function: &str, acting: &Acting, name: &str, span: &Range<usize>) -> Result<(RequestKind, Kind), Notice> {
    let moment = |kind: Kind| !matches!(kind, Kind::Known(d) if !d.same(&Dimension::ENERGY));
    match &acting.what {
        What::Element(id, told) => match acting.told(function) {
            Some(told) => Ok((RequestKind::Element(*id, told.value), told.kind)),
            None => {
                let names: Vec<&str> = told.iter().map(|t| t.function).collect();
                Err(no_such_part(function, acting, name, span, &names))
            }
        },
        What::Announced => Ok((RequestKind::Reaction(usize::MAX, Part::Force), Kind::Unknown)),
        What::Connection(index, parts) => {
            let find = |wanted: Part| parts.iter().find(|(part, _)| *part == wanted).copied();
            let found = match function {
                "force_x" => find(Part::ForceX),
                "force_y" => find(Part::ForceY),
                "force_z" => find(Part::ForceZ),
                "moment" => find(Part::Moment),
                "moment_x" => find(Part::MomentX),
                "moment_y" => find(Part::MomentY),
                "normal" => find(Part::Normal).or_else(|| find(Part::Force).filter(|_| matches!(acting.table, "sliders" | "slots"))),
                "tangential" => find(Part::Tangential),
                "tight_side" => find(Part::Tight),
                "slack_side" => find(Part::Slack),
                "torque" => find(Part::Moment).or_else(|| find(Part::Force).filter(|(_, kind)| moment(*kind))),
                _ => find(Part::Force),
            };
            let Some((part, kind)) = found else {
                let names: Vec<&str> = parts.iter().map(|(part, _)| part.name()).collect();
                return Err(no_such_part(function, acting, name, span, &names));
            };
            Ok((RequestKind::Reaction(*index, part), kind))
        }
    }
}

fn no_such_part(function: &str, acting: &Acting, name: &str, span: &Range<usize>, parts: &[&str]) -> Notice {
    let table = acting.table;
    let fault = Notice::piece(
        "M077",
        span.clone(),
        format!("`{name}` of [{table}] has no {function}"),
        format!("у `{name}` из [{table}] нет величины {function}"),
    );
    if parts.is_empty() {
        return fault
            .why(
                "a prescribed motion has no force of its own; motors realise it",
                "у заданного движения нет собственной силы; его создают двигатели",
            )
            .help("place a motor: [motors.NAME]", "поставьте двигатель: [motors.ИМЯ]");
    }
    let list: Vec<String> = parts.iter().map(|part| format!("{part}({name})")).collect();
    let list = list.join(", ");
    fault.help(format!("there is {list}"), format!("есть {list}"))
}

fn ambiguous(function: &str, several: &[&Acting], name: &str, span: &Range<usize>) -> Notice {
    let tables: Vec<&str> = several.iter().map(|a| a.table).collect();
    shared(&tables, name, span, |table| format!("{function}({table}.{name})"))
}

/// A name that several tables have; how it is written with one of them.
pub(crate) fn shared(tables: &[&str], name: &str, span: &Range<usize>, written: impl Fn(&str) -> String) -> Notice {
    let list: Vec<String> = tables.iter().map(|table| written(table)).collect();
    let (first, last) = (list[..list.len() - 1].join(", "), list.last().cloned().unwrap_or_default());
    let tables = tables.join(", ");
    Notice::piece(
        "M014",
        span.clone(),
        format!("several tables have a `{name}`: {tables}"),
        format!("имя `{name}` есть в нескольких таблицах: {tables}"),
    )
    .help(format!("write {first} or {last}"), format!("напишите {first} или {last}"))
}

fn of_point(function: &str, at: PointRef) -> RequestKind {
    match function {
        "x" => RequestKind::Position(at, Axis::X),
        "y" => RequestKind::Position(at, Axis::Y),
        "z" => RequestKind::Position(at, Axis::Z),
        "vx" => RequestKind::Velocity(at, Axis::X),
        "vy" => RequestKind::Velocity(at, Axis::Y),
        "vz" => RequestKind::Velocity(at, Axis::Z),
        "ax" => RequestKind::Acceleration(at, Axis::X),
        "ay" => RequestKind::Acceleration(at, Axis::Y),
        "az" => RequestKind::Acceleration(at, Axis::Z),
        _ => RequestKind::Speed(at),
    }
}
