//! Drawings of structures: the frame with its deflection or a mode shape, and diagrams of section forces along the rods.

use super::modes::Found as ModesFound;
use super::statics::Found as StaticsFound;
use crate::frame::bind::bind;
use crate::frame::coordinates::{coordinates, is_bare};
use crate::machine::Machine;
use crate::small::response::Deformed;
use analysis::studies::response::{Point, magnitude, phase};
use report::Figure;
use report::figure::{Mark, Pen, Series};
use report::unit::Scale;
use structures::loads::Carried;
use structures::statics::Station;
use structures::{Assembly, Frame, deflection, elements};
use words::Language;

/// Points on a part of a rod.
const POINTS: usize = 16;
/// Size of the largest displacement or ordinate, as a share of the size of the frame.
const SHARE: f64 = 0.18;

/// One drawing per mode.
pub fn modes(found: &ModesFound, language: Language) -> Vec<Figure> {
    let r = &found.result;
    let draw = |(i, mode): (usize, &analysis::studies::structure_modes::Mode)| {
        let omega = report::number::short(mode.omega, 5, language);
        let title =
            language.pick(format!("Mode shape {}, ω = {omega} rad/s", i + 1), format!("Форма колебаний {}, ω = {omega} рад/с", i + 1));
        let shape = magnified(&r.frame, &displaced(&r.frame, &r.assembly, &mode.freedoms, &[])).0;
        figure(&format!("mode-{}", i + 1), title, vec![straight(&r.frame, language), curve("w", language.pick("shape", "форма"), shape)])
    };
    r.modes.iter().take(6).enumerate().map(draw).collect()
}

/// The rods of a bare frame at points of a response, while the load is largest: amplitude times the cosine of the phase against it.
pub fn forced(machine: &Machine, points: &[Point]) -> Vec<Deformed> {
    let model = &machine.model;
    let Some(structure) = model.structure.as_ref().filter(|_| !points.is_empty() && is_bare(model)) else { return Vec::new() };
    let mut bound = bind(model, structure);
    let Ok(Some(found)) = coordinates(model, structure, &mut bound) else { return Vec::new() };
    let assembly = Assembly::of(&bound.frame);
    let n = found.named.len() + found.amplitudes;
    let mut straight = Line::default();
    rods(&bound.frame, &mut straight);
    let draw = |point: &Point| {
        let q: Vec<f64> = point.coordinates.iter().map(|z| magnitude(*z) * algebra::elementary::cos(phase(*z))).collect();
        if q.len() != n || q.iter().any(|v| !v.is_finite()) {
            return None;
        }
        let free = structures::dense::product(&found.basis, &q, found.n_q, n, 1);
        let places = displaced(&bound.frame, &assembly, &assembly.elimination.expand(&free), &[]);
        let (line, factor) = magnified(&bound.frame, &places);
        (factor > 0.0).then(|| Deformed { omega: point.omega, straight: straight.clone(), line, factor })
    };
    points.iter().filter_map(draw).collect()
}

/// Deflection and diagrams.
pub fn statics(found: &StaticsFound, language: Language) -> Vec<Figure> {
    let r = &found.result;
    let mut out = Vec::new();
    let places = displaced(&r.frame, &r.assembly, &r.statics.freedoms, &r.statics.carried);
    if farthest(&places) > 0.0 {
        let (shape, factor) = magnified(&r.frame, &places);
        let times = report::number::short(factor, 2, language);
        let title = language.pick(format!("Deflection, magnified ×{times}"), format!("Перемещения, увеличение ×{times}"));
        let series = vec![straight(&r.frame, language), curve("w", language.pick("deflected", "после нагружения"), shape)];
        let mut drawn = figure("deflection", title, series);
        drawn.marks = names(&r.frame);
        out.push(drawn);
    }
    if r.frame.rods.iter().all(|rod| rod.is_bar()) && r.diagrams.iter().all(|d| uniform(d)) {
        out.extend(tensions(found, language));
        return out;
    }
    for diagram in &DIAGRAMS {
        if let Some(line) = ordinates(&r.frame, &r.diagrams, diagram) {
            let title = language.pick(diagram.en, diagram.ru).to_owned();
            let scale = Scale::of_column(diagram.unit, largest(&r.diagrams, diagram.value));
            let label = language.pick(diagram.words.0, diagram.words.1);
            let series = curve(letter(diagram.symbol, language), &format!("{label}, {}", scale.print(language)), line);
            let mut drawn = figure(&format!("diagram-{}", diagram.symbol), title, vec![straight(&r.frame, language), series]);
            drawn.marks = names(&r.frame);
            drawn.marks.extend(values(&r.frame, &r.diagrams, diagram, &scale, language));
            out.push(drawn);
        }
    }
    out
}

/// A diagram of section forces.
struct Diagram {
    symbol: &'static str,
    unit: &'static str,
    words: (&'static str, &'static str),
    en: &'static str,
    ru: &'static str,
    value: fn(&Station<f64>) -> f64,
    /// Sign of the ordinate to the left of the rod.
    side: f64,
}

const DIAGRAMS: [Diagram; 3] = [
    Diagram {
        symbol: "M",
        unit: "N m",
        words: ("bending moment", "изгибающий момент"),
        en: "Bending moments, drawn on the side in tension",
        ru: "Изгибающие моменты, на растянутом волокне",
        value: |s| s.moment,
        side: -1.0,
    },
    Diagram {
        symbol: "V",
        unit: "N",
        words: ("shear force", "поперечная сила"),
        en: "Shear forces",
        ru: "Поперечные силы",
        value: |s| s.shear,
        side: 1.0,
    },
    Diagram {
        symbol: "N",
        unit: "N",
        words: ("normal force", "продольная сила"),
        en: "Normal forces",
        ru: "Продольные силы",
        value: |s| s.normal,
        side: 1.0,
    },
];

/// The shear force is V in English and Q in Russian textbooks.
fn letter(symbol: &'static str, language: Language) -> &'static str {
    if symbol == "V" { language.pick("V", "Q") } else { symbol }
}

/// Share of the largest value below which a value is zero in a drawing.
const ZERO: f64 = 1e-9;
/// Frames with more nodes or rods are drawn without words.
const WORDS: usize = 40;

fn largest(diagrams: &[Vec<Station<f64>>], value: fn(&Station<f64>) -> f64) -> f64 {
    diagrams.iter().flatten().map(|s| value(s).abs()).fold(0.0, f64::max)
}

/// Whether a bar carries its force alone, without any load between its ends.
fn uniform(diagram: &[Station<f64>]) -> bool {
    diagram.len() <= 2 && diagram.iter().all(|s| s.shear == 0.0 && s.moment == 0.0)
}

/// A truss with its rods in tension and in compression, each with its force: diagrams across the rods would cover each other.
fn tensions(found: &StaticsFound, language: Language) -> Option<Figure> {
    let r = &found.result;
    let top = largest(&r.diagrams, |s| s.normal);
    if top == 0.0 {
        return None;
    }
    let scale = Scale::of_column("N", top);
    let force = |i: usize| r.diagrams[i].first().map_or(0.0, |s| s.normal);
    let of = |wanted: &dyn Fn(f64) -> bool| {
        let mut line = Line::default();
        for (_, rod) in r.frame.rods.iter().enumerate().filter(|(i, _)| wanted(force(*i))) {
            rod.ends.iter().for_each(|i| push(&mut line, r.frame.nodes[*i].at));
            push(&mut line, [f64::NAN, f64::NAN]);
        }
        line
    };
    let unit = scale.print(language);
    let pick = |en: &str, ru: &str| language.pick(format!("{en}, {unit}"), format!("{ru}, {unit}"));
    let series = vec![
        curve("N", &pick("tension (+)", "растяжение (+)"), of(&|v| v > ZERO * top)),
        curve("N", &pick("compression (−)", "сжатие (−)"), of(&|v| v < -ZERO * top)),
        curve("N", language.pick("no force", "усилия нет"), of(&|v| v.abs() <= ZERO * top)),
    ];
    let series = series.into_iter().filter(|s| !s.x.is_empty()).collect();
    let mut drawn = figure("diagram-N", language.pick("Forces in the rods", "Усилия в стержнях").to_owned(), series);
    drawn.marks = names(&r.frame);
    if r.frame.rods.len() <= WORDS {
        for (i, rod) in r.frame.rods.iter().enumerate() {
            let [a, b] = rod.ends.map(|k| r.frame.nodes[k].at);
            let label = signed(if force(i).abs() <= ZERO * top { 0.0 } else { force(i) }, &scale, language);
            // diagonals that meet carry their values below the middle and to one side of it, apart from each other
            let share = if a[1] == b[1] { 0.5 } else { 0.5 + 0.12 * (a[1] - b[1]).signum() };
            let at = [0, 1].map(|k| a[k] + share * (b[k] - a[k]));
            drawn.marks.push(Mark::Point { x: at[0], y: at[1], label });
        }
    }
    Some(drawn)
}

/// A value with its sign, in the unit of the legend.
fn signed(v: f64, scale: &Scale, language: Language) -> String {
    let text = report::number::short(v / scale.size, 4, language);
    if v > 0.0 { format!("+{text}") } else { text }
}

/// The nodes by name.
fn names(frame: &Frame<f64>) -> Vec<Mark> {
    let mark = |n: &structures::Node<f64>| Mark::Point { x: n.at[0], y: n.at[1], label: n.name.clone() };
    if frame.nodes.len() > WORDS { Vec::new() } else { frame.nodes.iter().map(mark).collect() }
}

/// Values of a diagram at its corners and its largest value inside a rod; one where all are equal.
fn values(frame: &Frame<f64>, diagrams: &[Vec<Station<f64>>], diagram: &Diagram, scale: &Scale, language: Language) -> Vec<Mark> {
    let top = largest(diagrams, diagram.value);
    let mut marks = Vec::new();
    if frame.rods.len() > WORDS {
        return marks;
    }
    for (rod, d) in frame.rods.iter().zip(diagrams).filter(|(_, d)| !d.is_empty()) {
        let v = |i: usize| (diagram.value)(&d[i]);
        // six digits: no figure tells more apart
        let same = |a: f64, b: f64| (a - b).abs() <= 1e-6 * top;
        let largest = (0..d.len()).max_by(|i, j| v(*i).abs().total_cmp(&v(*j).abs()).then(j.cmp(i))).unwrap_or(0);
        let mut shown = match d.iter().all(|s| same((diagram.value)(s), v(0))) {
            true => vec![(0.5 * rod.length, v(0))],
            false => [0, largest, d.len() - 1].map(|i| (d[i].s, v(i))).to_vec(),
        };
        shown.dedup_by(|a, b| a == b || a.0 != b.0 && same(a.1, b.1) && (a.0 - b.0).abs() < 0.1 * rod.length);
        for (s, value) in shown.into_iter().filter(|(_, v)| v.abs() > ZERO * top) {
            let [x, y] = ordinate(frame, rod, s, SHARE * size(frame) / top * diagram.side * value);
            marks.push(Mark::Point { x, y, label: signed(value, scale, language) });
        }
    }
    marks
}

/// The place across a rod.
fn ordinate(frame: &Frame<f64>, rod: &structures::Rod<f64>, at: f64, v: f64) -> [f64; 2] {
    let start = frame.nodes[rod.ends[0]].at;
    let [c, s] = rod.direction;
    [start[0] + c * at - s * v, start[1] + s * at + c * v]
}

type Line = (Vec<f64>, Vec<f64>);

/// Points of the plane with breaks between rods.
fn push(line: &mut Line, p: [f64; 2]) {
    line.0.push(p[0]);
    line.1.push(p[1]);
}

/// The rods from end to end.
fn rods(frame: &Frame<f64>, line: &mut Line) {
    for rod in &frame.rods {
        rod.ends.iter().for_each(|i| push(line, frame.nodes[*i].at));
        push(line, [f64::NAN, f64::NAN]);
    }
}

/// The rods as they are.
fn straight(frame: &Frame<f64>, language: Language) -> Series {
    let mut line = Line::default();
    rods(frame, &mut line);
    curve("", language.pick("undeformed", "недеформированная схема"), line)
}

fn curve(name: &str, label: &str, line: Line) -> Series {
    Series { name: name.into(), label: label.into(), x: line.0, y: line.1, pen: Pen::Line }
}

/// Largest extent of the nodes.
fn size(frame: &Frame<f64>) -> f64 {
    let span = |k: usize| {
        let range = frame.nodes.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |r, n| (r.0.min(n.at[k]), r.1.max(n.at[k])));
        range.1 - range.0
    };
    span(0).max(span(1))
}

/// A place on a rod and its displacement; NaN breaks between rods.
type Displaced = [[f64; 2]; 2];

/// The deformed rods: between their ends what the displacements of the ends bend them to, and what their own loads add.
fn displaced(frame: &Frame<f64>, assembly: &Assembly<f64>, freedoms: &[f64], carried: &[Carried<f64>]) -> Vec<Displaced> {
    let mut places = Vec::new();
    let crowded = assembly.freedoms.parts.len() > WORDS;
    for (i, rod) in frame.rods.iter().enumerate() {
        let [c, s] = rod.direction;
        let start = frame.nodes[rod.ends[0]].at;
        for (i_part, part) in assembly.freedoms.parts.iter().enumerate().filter(|(_, p)| p.rod == i) {
            let local = assembly.local(frame, part, freedoms);
            let loads = carried.get(i_part).filter(|c| !c.is_empty());
            let points = if crowded && loads.is_none() { 2 } else { POINTS };
            for k in 0..=points {
                let x = part.length * k as f64 / points as f64;
                let shape = elements::shape(rod, &part.length, &x);
                let value = |row: &[f64; 6]| row.iter().zip(&local).map(|(a, b)| a * b).sum::<f64>();
                let own = loads.map_or([0.0; 2], |c| deflection::own(rod, part.length, c, x));
                let (u, v) = (value(&shape[0]) + own[0], value(&shape[1]) + own[1]);
                let at = part.from + x;
                places.push([[start[0] + c * at, start[1] + s * at], [c * u - s * v, s * u + c * v]]);
            }
        }
        places.push([[f64::NAN; 2]; 2]);
    }
    places
}

/// The largest displacement.
fn farthest(places: &[Displaced]) -> f64 {
    places.iter().map(|p| algebra::elementary::hypot(p[1][0], p[1][1])).filter(|v| v.is_finite()).fold(0.0, f64::max)
}

/// The displaced rods, magnified to be seen, and how many times.
fn magnified(frame: &Frame<f64>, places: &[Displaced]) -> (Line, f64) {
    let largest = farthest(places);
    let factor = if largest > 0.0 { round_factor(SHARE * size(frame) / largest) } else { 0.0 };
    let mut line = Line::default();
    places.iter().for_each(|[at, w]| push(&mut line, [at[0] + factor * w[0], at[1] + factor * w[1]]));
    (line, factor)
}

/// The factor with two digits, so that a length measured in the drawing can be divided by the number in its title.
fn round_factor(x: f64) -> f64 {
    let unit = algebra::elementary::powi(10.0, algebra::elementary::log10(x).floor() as i32 - 1);
    (x / unit).floor() * unit
}

/// A diagram drawn across the rods; none when it vanishes.
fn ordinates(frame: &Frame<f64>, diagrams: &[Vec<Station<f64>>], diagram: &Diagram) -> Option<Line> {
    let largest = largest(diagrams, diagram.value);
    if largest == 0.0 {
        return None;
    }
    let factor = SHARE * size(frame) / largest * diagram.side;
    let mut line = Line::default();
    for (rod, stations) in frame.rods.iter().zip(diagrams) {
        push(&mut line, ordinate(frame, rod, 0.0, 0.0));
        stations.iter().for_each(|s| push(&mut line, ordinate(frame, rod, s.s, factor * (diagram.value)(s))));
        push(&mut line, ordinate(frame, rod, rod.length, 0.0));
        push(&mut line, [f64::NAN, f64::NAN]);
    }
    Some(line)
}

fn figure(name: &str, title: String, series: Vec<Series>) -> Figure {
    Figure::to_scale(name.into(), title.as_str().into(), ("m", ["x", "y"]), series)
}
