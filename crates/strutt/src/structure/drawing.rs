//! Drawings of structures: the frame with its deflection or a mode shape, and diagrams of section forces along the rods.

use super::modes::Found as ModesFound;
use super::statics::Found as StaticsFound;
use analysis::structure::statics::Station;
use analysis::structure::{Assembly, Frame, elements};
use report::figure::{Axis, Kind, Series};
use report::unit::Scale;
use report::{Figure, Language};

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
        let shape = deformed(&r.frame, &r.assembly, &mode.freedoms);
        figure(&format!("mode-{}", i + 1), title, vec![straight(&r.frame, language), curve("w", language.pick("shape", "форма"), shape)])
    };
    r.modes.iter().take(6).enumerate().map(draw).collect()
}

/// Deflection and diagrams.
pub fn statics(found: &StaticsFound, language: Language) -> Vec<Figure> {
    let r = &found.result;
    let mut out = Vec::new();
    if r.statics.freedoms.iter().any(|v| *v != 0.0) {
        let title = language.pick("Deflection, magnified", "Перемещения, увеличено").to_owned();
        let shape = deformed(&r.frame, &r.assembly, &r.statics.freedoms);
        out.push(figure(
            "deflection",
            title,
            vec![straight(&r.frame, language), curve("w", language.pick("deflected", "после нагружения"), shape)],
        ));
    }
    type Pick = fn(&Station<f64>) -> f64;
    let kinds: [(&str, &str, &str, Pick); 3] = [
        ("M", "Bending moments, drawn on the side in tension", "Изгибающие моменты, на растянутом волокне", |s| -s.moment),
        ("V", "Shear forces", "Поперечные силы", |s| s.shear),
        ("N", "Normal forces", "Продольные силы", |s| s.normal),
    ];
    for (symbol, en, ru, pick) in kinds {
        if let Some(line) = ordinates(&r.frame, &r.diagrams, pick) {
            let title = language.pick(en, ru).to_owned();
            out.push(figure(&format!("diagram-{symbol}"), title, vec![straight(&r.frame, language), curve(symbol, "", line)]));
        }
    }
    out
}

type Line = (Vec<f64>, Vec<f64>);

/// Points of the plane with breaks between rods.
fn push(line: &mut Line, p: [f64; 2]) {
    line.0.push(p[0]);
    line.1.push(p[1]);
}

/// The rods as they are.
fn straight(frame: &Frame<f64>, language: Language) -> Series {
    let mut line = Line::default();
    for rod in &frame.rods {
        rod.ends.iter().for_each(|i| push(&mut line, frame.nodes[*i].at));
        push(&mut line, [f64::NAN, f64::NAN]);
    }
    curve("", language.pick("unloaded", "без нагрузки"), line)
}

fn curve(name: &str, label: &str, line: Line) -> Series {
    Series { name: name.into(), label: label.into(), x: line.0, y: line.1 }
}

/// Largest extent of the nodes.
fn size(frame: &Frame<f64>) -> f64 {
    let span = |k: usize| {
        let range = frame.nodes.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |r, n| (r.0.min(n.at[k]), r.1.max(n.at[k])));
        range.1 - range.0
    };
    span(0).max(span(1))
}

/// The deformed rods, magnified to be seen.
fn deformed(frame: &Frame<f64>, assembly: &Assembly<f64>, freedoms: &[f64]) -> Line {
    let mut places: Vec<[[f64; 2]; 2]> = Vec::new();
    for (i, rod) in frame.rods.iter().enumerate() {
        let [c, s] = rod.direction;
        let start = frame.nodes[rod.ends[0]].at;
        for part in assembly.freedoms.parts.iter().filter(|p| p.rod == i) {
            let local = assembly.local(frame, part, freedoms);
            let parts = assembly.freedoms.parts.len();
            let points = if parts > 40 { 2 } else { POINTS };
            for k in 0..=points {
                let x = part.length * k as f64 / points as f64;
                let shape = elements::shape(rod, &part.length, &x);
                let value = |row: &[f64; 6]| row.iter().zip(&local).map(|(a, b)| a * b).sum::<f64>();
                let (u, v) = (value(&shape[0]), value(&shape[1]));
                let at = part.from + x;
                places.push([[start[0] + c * at, start[1] + s * at], [c * u - s * v, s * u + c * v]]);
            }
        }
        places.push([[f64::NAN; 2]; 2]);
    }
    let largest = places.iter().map(|p| p[1][0].hypot(p[1][1])).filter(|v| v.is_finite()).fold(0.0, f64::max);
    let factor = if largest > 0.0 { SHARE * size(frame) / largest } else { 0.0 };
    let mut line = Line::default();
    places.iter().for_each(|[at, w]| push(&mut line, [at[0] + factor * w[0], at[1] + factor * w[1]]));
    line
}

/// A diagram drawn across the rods; none when it vanishes.
fn ordinates(frame: &Frame<f64>, diagrams: &[Vec<Station<f64>>], pick: fn(&Station<f64>) -> f64) -> Option<Line> {
    let largest = diagrams.iter().flatten().map(|s| pick(s).abs()).fold(0.0, f64::max);
    if largest == 0.0 {
        return None;
    }
    let factor = SHARE * size(frame) / largest;
    let mut line = Line::default();
    for (rod, diagram) in frame.rods.iter().zip(diagrams) {
        let start = frame.nodes[rod.ends[0]].at;
        let [c, s] = rod.direction;
        let place = |at: f64, v: f64| [start[0] + c * at - s * v, start[1] + s * at + c * v];
        push(&mut line, place(0.0, 0.0));
        diagram.iter().for_each(|station| push(&mut line, place(station.s, factor * pick(station))));
        push(&mut line, place(rod.length, 0.0));
        push(&mut line, [f64::NAN, f64::NAN]);
    }
    Some(line)
}

fn figure(name: &str, title: String, series: Vec<Series>) -> Figure {
    let largest = series.iter().flat_map(|s| s.x.iter().chain(&s.y)).filter(|v| v.is_finite()).fold(0.0_f64, |m, v| m.max(v.abs()));
    let axis = |symbol: &str| Axis { symbols: vec![symbol.into()], units: Vec::new(), scale: Scale::of_column("m", largest), log: false };
    Figure {
        name: name.into(),
        title: title.as_str().into(),
        kind: Kind::Plane { equal: true },
        x: axis("x"),
        y: axis("y"),
        series,
        marks: Vec::new(),
        along: None,
        strip: Vec::new(),
    }
}
