//! The diagram: stable parts of branches solid, unstable ones dashed, special points marked by their numbers.

use super::asked::{Branched, coordinates, symbol, unit};
use super::beside::Spine;
use super::creases::Chart;
use crate::machine::Machine;
use crate::results::{Results, Show, View};
use analysis::studies::continuation::{Diagram, Place};
use analysis::{Quantity, dataset::Column};
use report::Block;
use report::Figure;
use report::figure::{Axis, Kind, Mark, Pen, Series};
use words::{Language, Text};

/// What is drawn.
#[derive(Debug)]
pub(super) struct Shown {
    parameter: Quantity,
    coordinates: Vec<Quantity>,
    /// For each branch its points: parameter, greatest values of the coordinates, whether stable.
    curves: Vec<Vec<Point>>,
    special: Vec<Point>,
    /// Free oscillations over the same parameter.
    spine: Option<Spine>,
    /// The plane of both parameters.
    chart: Option<Chart>,
}

#[derive(Clone, Debug)]
struct Point {
    parameter: f64,
    greatest: Vec<f64>,
    stable: Option<bool>,
}

impl Point {
    fn of(place: &Place) -> Point {
        let facts = place.facts();
        Point { parameter: place.parameter(), greatest: facts.extremes.iter().map(|e| e[1]).collect(), stable: facts.stable }
    }
}

impl Shown {
    pub(super) fn new(machine: &Machine, study: &Branched, (diagram, spine): (&Diagram, Option<Spine>)) -> Shown {
        Shown {
            parameter: Quantity { symbol: symbol(machine, &study.name), ..Quantity::new(&study.name, &unit(machine, &study.name)) },
            coordinates: coordinates(machine),
            curves: diagram.curves.iter().map(|curve| curve.places.iter().map(Point::of).collect()).collect(),
            special: diagram.special.iter().map(|(_, _, special)| Point::of(&special.place)).collect(),
            spine,
            chart: Chart::new(machine, study, diagram),
        }
    }

    /// A curve over all branches where they are of that stability; the segments to points of another one belong to the first.
    fn part(&self, i: usize, stable: Option<bool>) -> ([Vec<f64>; 2], bool) {
        let (mut x, mut y, mut any) = (Vec::new(), Vec::new(), false);
        let mut put = |a: f64, b: f64| {
            x.push(a);
            y.push(b);
        };
        for curve in &self.curves {
            for (k, point) in curve.iter().enumerate() {
                let own = point.stable == stable;
                let behind = k > 0 && curve[k - 1].stable == stable;
                any |= own;
                if own || behind {
                    put(point.parameter, point.greatest[i]);
                }
                if !own {
                    put(f64::NAN, f64::NAN);
                }
            }
            put(f64::NAN, f64::NAN);
        }
        ([x, y], any)
    }
}

impl Show for Shown {
    fn blocks(&self, _: &Results, _: &View) -> Vec<Block> {
        Vec::new()
    }

    fn figures(&self, _: &Results, language: Language) -> Vec<Figure> {
        let axis = |q: &Quantity, values: Vec<f64>| Axis::of_columns(&[&Column { quantity: q.clone(), values }]);
        let all = || self.curves.iter().flatten();
        let mut figures = Vec::new();
        for (i, q) in self.coordinates.iter().enumerate() {
            let kinds = [
                (Some(true), Text::new("stable", "устойчиво")),
                (Some(false), Text::new("unstable", "неустойчиво")),
                (None, Text::new("not decided", "не решено")),
            ];
            let series = kinds.into_iter().filter_map(|(stable, label)| {
                let ([x, y], any) = self.part(i, stable);
                // the first is drawn solid, the second dashed, whether they are there or not
                (any || stable.is_some()).then(|| Series {
                    name: q.symbol.clone(),
                    label: language.text(&label).into(),
                    x,
                    y,
                    pen: Pen::Line,
                })
            });
            let spine = self.spine.as_ref().map(|spine| Series {
                name: q.symbol.clone(),
                label: language.pick("backbone curve", "скелетная кривая").into(),
                x: spine.points.iter().map(|p| p.parameter).collect(),
                y: spine.points.iter().map(|p| p.extremes[i][1]).collect(),
                pen: Pen::Line,
            });
            let mark = |(k, point): (usize, &Point)| Mark::Point { x: point.parameter, y: point.greatest[i], label: (k + 1).to_string() };
            let title = language.pick(
                format!("Branches: greatest {} over {}", q.symbol, self.parameter.symbol),
                format!("Ветви: наибольшее {} в зависимости от {}", q.symbol, self.parameter.symbol),
            );
            figures.push(Figure {
                name: format!("branches-{}", report::escape::file_name(&q.name)),
                title: title.into(),
                kind: Kind::Plane { equal: false },
                x: axis(&self.parameter, all().map(|p| p.parameter).collect()),
                y: axis(q, all().map(|p| p.greatest[i]).collect()),
                series: series.chain(spine).collect(),
                marks: self.special.iter().enumerate().map(mark).collect(),
                along: None,
                strip: Vec::new(),
                field: None,
            });
        }
        figures.extend(self.chart.as_ref().map(|chart| chart.figure(language)));
        figures
    }
}
