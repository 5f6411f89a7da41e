//! Instantaneous centres of velocity of the bodies of a planar machine with one degree of freedom, and its velocity plan.
//!
//! ```text
//! v = ω k × (r − P)      P = r + k × v/ω      |v| = |ω| CP for every point C of the body
//! ```
//! Velocities and ω are the derivatives of the places by the coordinates times the rates that the connections ask for; the products ω CP are laid against
//! them at every other point of the body.

use super::facts::Moves;
use super::pen::{Pen, inline, words};
use super::work::Work;
use crate::scheme::{Instant, STILL, known};
use mechanics::Places;
use mechanics::model::{Class, FrameId, PointId, PointRef};
use report::document::{Inline, Rich};
use report::figure::{Axis, Figure, Kind, Mark, Series};
use report::formula::{Layout, Relation};
use report::table::Column;
use report::unit::Scale;
use report::{Block, Cell, Table};
use symbolic::Expr;

/// Bodies beyond which nobody draws a plan.
const MOST: usize = 8;
/// Significant digits.
const DIGITS: usize = 6;
/// Share of the largest velocity that is hardly seen in a plan: its letters would stand on each other.
const BESIDE: f64 = 0.03;

type V2 = [f64; 2];

/// A point of a body with its velocity.
struct Spot {
    name: String,
    at: V2,
    v: V2,
}

/// A body with its angular velocity.
struct Body {
    frame: FrameId,
    omega: f64,
    /// Where nothing of it moves; none of a body that translates.
    pole: Option<V2>,
    spots: Vec<Spot>,
}

pub(super) fn write(work: &Work, pen: &mut Pen) {
    let Some(start) = place(work) else { return };
    let in_plane = |body: &&Body| work.moves(&work.model.frames[body.frame.index()]) == Moves::InPlane;
    let mut found = (bodies(work, &start), start);
    // a dead centre, or a body that translates for an instant, shows little: the place of the figure then
    let largest = fastest(&found.0);
    let special = |body: &Body| body.pole.is_none() || body.spots.iter().any(|s| length(s.v) <= BESIDE * largest);
    if found.0.iter().filter(in_plane).any(special)
        && let Some(bent) = crate::scheme::bent(&work.calculation.machine)
    {
        found = (bodies(work, &bent), bent);
    }
    let (bodies, at) = found;
    if bodies.len() > MOST || !bodies.iter().filter(in_plane).any(|body| body.pole.is_some()) {
        return;
    }
    let title = work.language.pick("Instantaneous centres of velocity", "Мгновенные центры скоростей");
    pen.section(title, |pen| told(work, (&at, &bodies), pen));
}

fn fastest(bodies: &[Body]) -> f64 {
    bodies.iter().flat_map(|b| &b.spots).map(|s| length(s.v)).fold(0.0, f64::max)
}

/// The start of a planar machine with one degree of freedom that moves by its coordinates alone.
fn place(work: &Work) -> Option<Instant> {
    let (model, equations) = (work.model, work.equations);
    if mechanics::is_spatial(model)
        || equations.degrees_of_freedom() != 1
        || !equations.auxiliaries.is_empty()
        || model.frames.iter().any(|f| f.spin.is_some())
    {
        return None;
    }
    let at = Instant::start(&work.calculation.machine);
    let largest = at.rates.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    (largest > 0.0).then_some(at)
}

/// Bodies that move, with their points; none where a place changes with time by itself.
fn bodies(work: &Work, at: &Instant) -> Vec<Body> {
    let model = work.model;
    let values = known(&work.calculation.machine, at);
    let value = |s| values.get(&s).copied().unwrap_or(0.0);
    let mut places = Places::new(model);
    let frames: Vec<FrameId> = work.by_number().into_iter().map(|(i, _)| FrameId(i)).collect();
    let turned: Vec<[Expr; 2]> = frames.iter().map(|f| places.frame(*f).1).map(|r| [r[0][0], r[1][0]]).collect();
    let named: Vec<Vec<(Option<String>, [Expr; 3])>> = frames.iter().map(|f| points(work, *f, &mut places)).collect();
    let mut graph = places.graph().clone();
    let driven = |s| s == model.time || model.parameters.iter().any(|p| p.symbol == s && p.class != Class::Constant);
    let all = turned.iter().flatten().chain(named.iter().flatten().flat_map(|(_, p)| &p[..2]));
    if all.clone().any(|e| graph.contains(*e, driven)) {
        return Vec::new();
    }
    // value and rate of a formula of the place
    let mut moved = |e: Expr| -> [f64; 2] {
        let slopes: Vec<Expr> = model.coordinates.iter().map(|c| graph.derivative(e, c.symbols[0])).collect();
        let rate = graph.evaluate(&slopes, &value).iter().zip(&at.rates).map(|(slope, rate)| slope * rate).sum();
        [graph.evaluate(&[e], &value)[0], rate]
    };
    let mut out: Vec<Body> = Vec::new();
    for ((frame, turned), named) in frames.into_iter().zip(turned).zip(named) {
        let [c, s] = turned.map(&mut moved);
        let omega = c[0] * s[1] - s[0] * c[1];
        let mut spots: Vec<Spot> = Vec::new();
        for (name, place) in named {
            let [x, y] = [place[0], place[1]].map(&mut moved);
            let spot = Spot { name: name.unwrap_or_default(), at: [x[0], y[0]], v: [x[1], y[1]] };
            if !spots.iter().any(|old| distance(old.at, spot.at) <= STILL) {
                spots.push(spot);
            }
        }
        let rests = spots.iter().all(|spot| length(spot.v) <= STILL) && omega.abs() <= STILL;
        if rests || spots.is_empty() {
            continue;
        }
        let Spot { at: r, v, .. } = &spots[0];
        let pole = (omega.abs() > STILL).then(|| [r[0] - v[1] / omega, r[1] + v[0] / omega]);
        out.push(Body { frame, omega, pole, spots });
    }
    call(work, &mut out);
    out
}

/// Points of a body: those with a name, the centre of mass, the origin.
fn points(work: &Work, frame: FrameId, places: &mut Places) -> Vec<(Option<String>, [Expr; 3])> {
    let model = work.model;
    let own = (0..model.points.len()).filter(|i| model.points[*i].on == frame);
    let mut list: Vec<(Option<String>, [Expr; 3])> =
        own.map(|i| (Some(model.points[i].name.clone()), places.point(PointRef::Point(PointId(i))))).collect();
    list.push((None, places.point(PointRef::Origin(frame))));
    let massive = model.frames[frame.index()].mass.as_ref().is_some_and(|m| !model.graph.is_zero(m.mass));
    if massive {
        let name = work.number(frame).map(|n| format!("C_{n}"));
        list.push((name, places.point(PointRef::Center(frame))));
    }
    list
}

/// Names for what has none: that of a named point of another body at the same place, else O with the number of the body.
fn call(work: &Work, bodies: &mut [Body]) {
    let named: Vec<(String, V2, V2)> =
        bodies.iter().flat_map(|b| &b.spots).filter(|s| !s.name.is_empty()).map(|s| (s.name.clone(), s.at, s.v)).collect();
    for body in bodies {
        let number = work.number(body.frame).unwrap_or_default();
        for spot in body.spots.iter_mut().filter(|s| s.name.is_empty()) {
            let there =
                named.iter().find(|(_, at, v)| distance(*at, spot.at) <= STILL && distance(*v, spot.v) <= STILL * length(*v).max(1.0));
            spot.name = there.map_or_else(|| format!("O_{number}"), |(name, ..)| name.clone());
        }
    }
}

/// A column under a letter with an index.
fn lettered(name: &str, unit: &str, language: ::words::Language) -> Column {
    Column::with_unit(Rich(vec![Inline::Symbol(name.into())]), unit, language)
}

fn length(v: V2) -> f64 {
    algebra::elementary::hypot(v[0], v[1])
}

fn distance(a: V2, b: V2) -> f64 {
    length([a[0] - b[0], a[1] - b[1]])
}

fn told(work: &Work, (at, bodies): (&Instant, &[Body]), pen: &mut Pen) {
    let pick = |en: &'static str, ru: &'static str| work.language.pick(en, ru);
    let leading = super::machine::leading(work).unwrap_or(0);
    let coordinate = &work.equations.coordinates[leading];
    let given = |k: usize, x: f64, unit: &str| {
        let symbol = work.printer.symbol_layout(&work.equations.graph, coordinate.symbols[k]);
        inline(Layout::Related(Box::new(symbol), Relation::Equal, Box::new(super::quantity::with_unit(x, unit, work.language))))
    };
    let rate = if coordinate.unit == "1" { "1/s".to_owned() } else { format!("{}/s", coordinate.unit) };
    pen.tell(vec![
        words(pick("In the place ", "В положении ")),
        given(0, at.q[leading], &coordinate.unit),
        words(pick(", at ", ", при ")),
        given(1, at.rates[leading], &rate),
        words(pick(
            ", the instantaneous centre P of velocity of a body lies on the perpendicular to the velocity of any of its points C, at the distance CP = v/ω.",
            ", мгновенный центр скоростей P тела лежит на перпендикуляре к скорости любой его точки C на расстоянии CP = v/ω.",
        )),
    ]);
    pen.table(centres(work, bodies), pick("Instantaneous centres of velocity", "Мгновенные центры скоростей"));
    let (table, worst) = distances(work, bodies);
    pen.table(table, pick("Velocities of points by their distances from the centres", "Скорости точек по расстояниям до центров"));
    // nothing is closer than the last digit
    let worst = report::number::short(worst.max(f64::EPSILON), 2, work.language);
    pen.say(work.language.pick(
        format!(
            "The velocities ω·CP differ from the derivatives of the coordinates of the points by at most {worst} of the largest velocity."
        ),
        format!("Скорости ω·CP отличаются от производных координат точек не более чем на {worst} наибольшей скорости."),
    ));
    pen.pictures(vec![Block::Figure(plan(work, bodies))]);
}

/// ω and P of each body.
fn centres(work: &Work, bodies: &[Body]) -> Table {
    let language = work.language;
    let mut columns = vec![
        Column::new(language.pick("Body", "Тело")),
        Column::with_unit("ω", "rad/s", language),
        lettered("x_P", "m", language),
        lettered("y_P", "m", language),
    ];
    let translating = bodies.iter().any(|b| b.pole.is_none());
    columns.extend(translating.then(|| Column::new(language.word(report::Word::Description))));
    let mut table = Table::new(columns);
    let largest = bodies.iter().flat_map(|b| &b.spots).flat_map(|s| s.at).fold(0.0_f64, |m, x| m.max(x.abs()));
    for body in bodies {
        let name = ::words::capital(&work.body(body.frame));
        let number = |x: f64| Cell::number(if x.abs() <= STILL * largest { 0.0 } else { x }, DIGITS, language);
        let (place, what) = match body.pole {
            Some(p) => (p.map(number), ""),
            None => (
                [Cell::words("–"), Cell::words("–")],
                language.pick("translates: P is infinitely far", "движется поступательно: P бесконечно удалён"),
            ),
        };
        let [x, y] = place;
        let mut row = vec![Cell::words(name), Cell::number(body.omega, DIGITS, language), x, y];
        row.extend(translating.then(|| Cell::words(what)));
        table.row(row);
    }
    table
}

/// Distances and velocities of the points, and the largest difference of ω·CP from a velocity as a share of the largest.
fn distances(work: &Work, bodies: &[Body]) -> (Table, f64) {
    let language = work.language;
    let mut table = Table::new(vec![
        Column::new(language.pick("Body", "Тело")),
        Column::new(language.pick("Point C", "Точка C")),
        Column::with_unit("CP", "m", language),
        Column::with_unit("ω·CP", "m/s", language),
        lettered("v_x", "m/s", language),
        lettered("v_y", "m/s", language),
    ]);
    let largest = fastest(bodies);
    let mut worst = 0.0_f64;
    for body in bodies {
        let name = ::words::capital(&work.body(body.frame));
        for spot in &body.spots {
            let number = |x: f64| Cell::number(if x.abs() <= STILL * largest { 0.0 } else { x }, DIGITS, language);
            let [away, speed] = match body.pole {
                Some(p) => {
                    let away = distance(spot.at, p);
                    let speed = body.omega.abs() * away;
                    worst = worst.max((speed - length(spot.v)).abs() / largest);
                    [number(away), number(speed)]
                }
                None => [Cell::words("–"), number(length(spot.v))],
            };
            table.row(vec![Cell::words(name.clone()), Cell::symbol(&*spot.name), away, speed, number(spot.v[0]), number(spot.v[1])]);
        }
    }
    (table, worst)
}

/// Velocities of all points from one pole; the figure of the points of a body is similar to the body, turned by a right angle.
fn plan(work: &Work, bodies: &[Body]) -> Figure {
    let mut drawn: Vec<(&str, V2)> = Vec::new();
    for spot in bodies.iter().flat_map(|b| &b.spots).filter(|s| length(s.v) > STILL) {
        if !drawn.iter().any(|(_, v)| distance(*v, spot.v) <= STILL * length(spot.v)) {
            drawn.push((&spot.name, spot.v));
        }
    }
    let largest = drawn.iter().map(|(_, v)| length(*v)).fold(0.0_f64, f64::max);
    let mut series: Vec<Series> =
        drawn.iter().map(|(name, v)| line(&format!("v_{}", name.replace('_', "")), "", &[[0.0; 2], *v])).collect();
    for body in bodies.iter().filter(|b| b.pole.is_some() && b.spots.len() > 1) {
        let tips: Vec<V2> = body.spots.iter().map(|s| s.v).collect();
        let through_pole = |v: &V2| length(*v) <= STILL * largest;
        if !tips.iter().any(through_pole) {
            series.push(line("", &work.body(body.frame), &tips));
        }
    }
    let axis = |name: &str| Axis { symbols: vec![name.into()], units: Vec::new(), scale: Scale::of_column("m/s", largest), log: false };
    let mut tips: Vec<(V2, String)> = vec![([0.0; 2], "p".into())];
    for (name, v) in &drawn {
        let name = name.to_lowercase().replace('_', "");
        match tips.iter_mut().find(|(at, _)| distance(*at, *v) <= BESIDE * largest) {
            Some((_, names)) => *names += &format!(", {name}"),
            None => tips.push((*v, name)),
        }
    }
    let marks = tips.into_iter().map(|(v, label)| Mark::Point { x: v[0], y: v[1], label }).collect();
    Figure {
        name: "velocity-plan".into(),
        title: work.language.pick("Velocity plan", "План скоростей").into(),
        kind: Kind::Plane { equal: true },
        x: axis("v_x"),
        y: axis("v_y"),
        series,
        marks,
        along: None,
        strip: Vec::new(),
        field: None,
    }
}

fn line(name: &str, label: &str, points: &[V2]) -> Series {
    Series {
        name: name.into(),
        label: label.into(),
        x: points.iter().map(|p| p[0]).collect(),
        y: points.iter().map(|p| p[1]).collect(),
        pen: report::figure::Pen::Line,
    }
}
