//! What the names in formulas mean.

use super::check::{Depends, Kind};
use super::kinematic::{FUNCTIONS, Takes};
use crate::fault::{Fault, nearest};
use crate::model::{Axis, Element, FrameId, PointId, PointRef, RequestKind};
use crate::units::Dimension;
use std::collections::HashMap;
use std::ops::Range;
use symbolic::{Expr, SymbolId};

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

/// All names.
#[derive(Default)]
pub(crate) struct Scope {
    names: HashMap<String, Entry>,
    /// in order of declaration, for suggestions
    listed: Vec<String>,
    places: HashMap<String, Place>,
    listed_places: Vec<String>,
    springs: HashMap<String, (usize, Kind)>,
    dampers: HashMap<String, (usize, Kind)>,
    listed_elements: Vec<String>,
}

impl Scope {
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
    /// Declares a spring or damper with the dimension of its pathway.
    pub(crate) fn declare_element(&mut self, name: &str, element: Element, pathway: Kind) {
        match element {
            Element::Spring(i) => self.springs.insert(name.to_owned(), (i, pathway)),
            Element::Damper(i) => self.dampers.insert(name.to_owned(), (i, pathway)),
        };
        self.listed_elements.push(name.to_owned());
    }

    /// What a kinematic function of these names asks for, and its dimension.
    pub(crate) fn request(
        &self,
        row: usize,
        arguments: &[(Option<String>, String, Range<usize>)],
        whole: &Range<usize>,
    ) -> Result<(RequestKind, Kind), Fault> {
        let function = &FUNCTIONS[row];
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
            (Takes::Element, Some((table, name, span))) => return self.element(function.name, table.as_deref(), name, span),
            (Takes::BodyOrNothing, None) => RequestKind::KineticEnergy(None),
            (Takes::Nothing, _) if function.name == "dissipation" => RequestKind::Dissipation,
            (Takes::Nothing, _) => RequestKind::PotentialEnergy,
            (_, None) => return Err(Fault::new("M034", whole.clone(), "a name is missing", "не указано имя")),
        };
        Ok((kind, dimension))
    }

    fn located(&self, table: Option<&str>, name: &str, span: &Range<usize>) -> Result<Place, Fault> {
        let fits = |place: &Place| match table {
            None => true,
            Some("points") => matches!(place, Place::Point(_)),
            Some("bodies" | "frames") => matches!(place, Place::Frame(_)),
            Some(_) => false,
        };
        self.place(name).filter(fits).ok_or_else(|| self.unknown_place(name, span.clone()))
    }

    fn frame(&self, table: Option<&str>, name: &str, span: &Range<usize>) -> Result<FrameId, Fault> {
        match self.located(table, name, span)? {
            Place::Frame(f) => Ok(f),
            Place::Point(_) => Err(Fault::new(
                "M014",
                span.clone(),
                format!("`{name}` is a point; a frame or body is needed here"),
                format!("`{name}` — точка, а здесь нужно тело или система отсчёта"),
            )
            .why("a point does not turn", "точка не поворачивается")),
        }
    }

    /// The fault of a name that is no frame, body or point.
    pub(crate) fn unknown_place(&self, name: &str, span: Range<usize>) -> Fault {
        let fault = Fault::new(
            "M014",
            span,
            format!("there is no frame, body or point `{name}`"),
            format!("нет системы отсчёта, тела или точки `{name}`"),
        );
        match nearest(name, self.place_names()) {
            Some(near) => fault.help(format!("did you mean `{near}`?"), format!("может быть, `{near}`?")),
            None => fault.help(
                format!("add [bodies.{name}], [frames.{name}] or an entry to [points]"),
                format!("добавьте [bodies.{name}], [frames.{name}] или строку в [points]"),
            ),
        }
    }

    fn element(&self, function: &str, table: Option<&str>, name: &str, span: &Range<usize>) -> Result<(RequestKind, Kind), Fault> {
        let spring = self.springs.get(name).filter(|_| matches!(table, None | Some("springs")));
        let damper = self.dampers.get(name).filter(|_| matches!(table, None | Some("dampers")));
        let (element, pathway) = match (spring, damper) {
            (Some(_), Some(_)) if function == "force" => {
                return Err(Fault::new(
                    "M014",
                    span.clone(),
                    format!("both a spring and a damper are called `{name}`"),
                    format!("имя `{name}` носят и пружина, и демпфер"),
                )
                .help(
                    format!("write force(springs.{name}) or force(dampers.{name})"),
                    format!("напишите force(springs.{name}) или force(dampers.{name})"),
                ));
            }
            (Some((i, pathway)), _) => (Element::Spring(*i), pathway),
            (None, Some((i, pathway))) => (Element::Damper(*i), pathway),
            (None, None) => return Err(self.unknown_element(name, span.clone())),
        };
        if function == "extension" {
            return Ok((RequestKind::Extension(element), *pathway));
        }
        Ok((RequestKind::ElementForce(element), pathway.conjugate()))
    }

    fn unknown_element(&self, name: &str, span: Range<usize>) -> Fault {
        let fault =
            Fault::new("M014", span, format!("there is no spring or damper `{name}`"), format!("нет пружины или демпфера `{name}`"));
        match nearest(name, self.listed_elements.iter().map(String::as_str)) {
            Some(near) => fault.help(format!("did you mean `{near}`?"), format!("может быть, `{near}`?")),
            None => fault,
        }
    }
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

impl Kind {
    /// The dimension of the force that works on a pathway of this dimension: energy / pathway.
    pub(crate) fn conjugate(self) -> Kind {
        match self {
            Kind::Known(d) => Dimension::ENERGY.div(&d.without_angle()).map_or(Kind::Unknown, Kind::Known),
            other => other,
        }
    }
}
