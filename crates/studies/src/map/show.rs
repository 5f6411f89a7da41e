//! The map as pictures: regimes in tints, numbers in a scale of colours, what is unstable or has no result hatched, the boundaries over it.

use super::classes::{Classes, Judge, Tinted};
use crate::results::{Results, Show, View};
use analysis::dataset::Column;
use analysis::studies::map::{Class, Map};
use analysis::studies::stability::{Curve, Edge};
use report::document::{Inline, Rich};
use report::figure::field::{Field, Hatch, Key, Pick, Tile};
use report::figure::{Axis, Kind, Mark, Pen, Series};
use report::{Block, Figure};
use words::{Language, Text};

/// Tiles along a side at most; twice the finest cells show each place with what it stands for.
const TILES: usize = 240;

/// A finished map.
#[derive(Debug)]
pub(super) struct Shown {
    pub(super) map: Map,
    pub(super) classes: Classes,
    pub(super) names: Vec<Text>,
    /// Quantities of x, y and the numbers.
    pub(super) columns: Vec<Column>,
    /// The numbers of each place, in the order of the places; empty without a result.
    pub(super) values: Vec<Vec<f64>>,
    /// How many of the numbers are drawn: those that were asked for.
    pub(super) drawn: usize,
    /// Ends of both ranges.
    pub(super) ends: [[f64; 2]; 2],
    /// The command line for a place.
    pub(super) command: String,
    /// Boundaries of the tongues of a diagram: they are drawn in place of those between the cells.
    pub(super) tongues: Vec<Curve>,
}

impl Show for Shown {
    fn blocks(&self, _: &Results, _: &View) -> Vec<Block> {
        Vec::new()
    }

    fn figures(&self, _: &Results, language: Language) -> Vec<Figure> {
        let places = self.places();
        let mut figures: Vec<Figure> = (0..self.drawn).filter_map(|k| self.of_number(k, &places, language)).collect();
        if self.drawn == 0 || self.classes.judge == Judge::Regimes {
            figures.insert(0, self.of_classes(&places, language));
        }
        figures
    }
}

impl Shown {
    /// Tiles along a side, and for each tile the place that stands for it.
    fn places(&self) -> (usize, Vec<Option<(usize, Class)>>) {
        let side = (2 * self.map.grid.finest() as usize).clamp(1, TILES);
        let index = self.map.index();
        let middle = |k: usize| (k as f64 + 0.5) / side as f64;
        (side, (0..side * side).map(|k| self.map.nearest(&index, [middle(k % side), middle(k / side)])).collect())
    }

    fn hatch(&self, class: Class) -> Hatch {
        match self.classes.stable(class) {
            _ if self.classes.is_failed(class) => Hatch::Failed,
            Some(false) => Hatch::Unstable,
            _ => Hatch::Plain,
        }
    }

    /// Regimes; places that differ by their verdict alone have one tint.
    fn of_classes(&self, (side, places): &(usize, Vec<Option<(usize, Class)>>), language: Language) -> Figure {
        let mut kinds: Vec<(Tinted<'_>, String)> = Vec::new();
        for class in 0..self.names.len() {
            let Some(regime) = self.classes.regime(class) else { continue };
            if !kinds.iter().any(|(known, _)| *known == regime) {
                let name = language.text(&self.names[class]);
                let verdict = self.classes.stable(class).and(name.rsplit_once(", ")).map_or(name, |(regime, _)| regime);
                // where nothing but the verdict tells places apart, it is the tint of what is stable
                let verdict = match (regime.0.is_empty(), regime.1) {
                    (true, None) => language.pick("stable", "устойчиво").to_owned(),
                    (true, Some(resonance)) => resonance.to_owned(),
                    (false, None) => verdict.to_owned(),
                    (false, Some(resonance)) => format!("{verdict}, {resonance}"),
                };
                kinds.push((regime, verdict));
            }
        }
        let tint = |class: Class| self.classes.regime(class).and_then(|regime| kinds.iter().position(|(known, _)| *known == regime));
        let tiles =
            places.iter().map(|place| place.map_or(Tile::default(), |(_, class)| Tile { tint: tint(class), hatch: self.hatch(class) }));
        let key = Key::Classes(kinds.iter().map(|(_, name)| name.clone()).collect());
        let title = language.pick("Regimes over ", "Режимы на плоскости ");
        self.figure(("map", Rich(self.over(vec![Inline::Words(title.into())]))), (*side, tiles.collect(), key))
    }

    /// One of the numbers.
    fn of_number(&self, k: usize, (side, places): &(usize, Vec<Option<(usize, Class)>>), language: Language) -> Option<Figure> {
        let column = self.columns.get(2 + k)?;
        let value = |place: usize| self.values.get(place).and_then(|numbers| numbers.get(k)).copied().unwrap_or(f64::NAN);
        let shown: Vec<f64> = places.iter().flatten().map(|(place, _)| value(*place)).filter(|v| v.is_finite()).collect();
        let (low, high) = shown.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
        if low > high {
            return None;
        }
        let tile = |(place, class): (usize, Class)| Tile { tint: Field::step([low, high], value(place)), hatch: self.hatch(class) };
        let tiles = places.iter().map(|place| place.map_or(Tile::default(), tile)).collect();
        let axis = Axis::of_columns(&[&Column { quantity: column.quantity.clone(), values: vec![low, high] }]);
        let name = format!("map-{}", report::escape::file_name(&column.quantity.name.replace('\'', "_rate")));
        let title = vec![Inline::Symbol(column.quantity.symbol.clone()), Inline::Words(language.pick(" over ", " на плоскости ").into())];
        let mut figure = self.figure((&name, Rich(self.over(title))), (*side, tiles, Key::Scale(axis, [low, high])));
        let label = language.text(&column.quantity.label);
        if !label.is_empty() {
            let mut title = vec![Inline::Words(format!("{}, ", words::capital(label)))];
            title.append(&mut figure.title.0);
            figure.title = Rich(title);
        }
        Some(figure)
    }

    /// Words, then the symbols of both ranges.
    fn over(&self, mut words: Vec<Inline>) -> Vec<Inline> {
        let symbol = |k: usize| Inline::Symbol(self.columns.get(k).map_or_else(String::new, |c| c.quantity.symbol.clone()));
        words.extend([symbol(0), Inline::Words(", ".into()), symbol(1)]);
        words
    }

    fn figure(&self, (name, title): (&str, Rich), (across, tiles, key): (usize, Vec<Tile>, Key)) -> Figure {
        let quantity = |k: usize| self.columns.get(k).map(|c| c.quantity.clone()).unwrap_or_default();
        let axis = |k: usize| Axis::of_columns(&[&Column { quantity: quantity(k), values: self.ends[k].to_vec() }]);
        let at = |k: usize, share: f64| self.ends[k][0] + (self.ends[k][1] - self.ends[k][0]) * share;
        let series = |line: &analysis::studies::map::Line| Series {
            name: String::new(),
            label: String::new(),
            x: line.points.iter().map(|place| at(0, place[0])).collect(),
            y: line.points.iter().map(|place| at(1, place[1])).collect(),
            pen: Pen::Line,
        };
        let unit = |k: usize| Some(quantity(k).unit).filter(|unit| unit != "1").unwrap_or_default();
        let pick = Pick { names: [0, 1].map(|k| quantity(k).name), units: [0, 1].map(unit), command: self.command.clone() };
        Figure {
            name: name.to_owned(),
            title,
            kind: Kind::Plane { equal: false },
            x: axis(0),
            y: axis(1),
            series: if self.tongues.is_empty() {
                self.map.lines.iter().map(series).collect()
            } else {
                self.tongues.iter().map(of_tongue).collect()
            },
            marks: self.tongues.iter().filter_map(mark).collect(),
            along: None,
            strip: Vec::new(),
            field: Some(Field { across, ends: self.ends, tiles, key, pick }),
        }
    }
}

/// A boundary of a tongue.
fn of_tongue(curve: &Curve) -> Series {
    let part = |k: usize| curve.points.iter().map(|place| place[k]).collect();
    Series { name: String::new(), label: String::new(), x: part(0), y: part(1), pen: Pen::Line }
}

/// The name of a curve in its middle; of the two ends of a tongue without letters one stands for both.
fn mark(curve: &Curve) -> Option<Mark> {
    let place = curve.points.get(curve.points.len() / 2)?;
    let label = match curve.letter {
        Some(_) => curve.name().replace('_', ""),
        None if curve.edge == Some(Edge::Upper) => curve.tongue.to_string(),
        None => return None,
    };
    Some(Mark::Point { x: place[0], y: place[1], label })
}
