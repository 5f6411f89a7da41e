//! The speeds over a parameter as a figure: stable parts solid, unstable ones dashed, folds marked by their numbers, motions of the machine itself as points over them.

use super::curves::{Knot, Part, drawn};
use super::motions::{Ran, Way};
use crate::results::{Results, Show, View};
use analysis::Quantity;
use analysis::dataset::Column;
use report::figure::{Axis, Kind, Mark, Pen, Series};
use report::{Block, Figure};
use words::{Language, Text};

/// What is drawn.
#[derive(Debug)]
pub(super) struct Shown {
    pub(super) parameter: Quantity,
    /// Printed symbol of the speed.
    pub(super) speed: String,
    pub(super) curves: Vec<Vec<Knot>>,
    /// Value and speed of each fold.
    pub(super) folds: Vec<[f64; 2]>,
    pub(super) runs: Vec<Ran>,
}

impl Show for Shown {
    fn blocks(&self, _: &Results, _: &View) -> Vec<Block> {
        Vec::new()
    }

    fn figures(&self, _: &Results, language: Language) -> Vec<Figure> {
        let axis = |q: Quantity, values: Vec<f64>| Axis::of_columns(&[&Column { quantity: q, values }]);
        let knots = || self.curves.iter().flatten();
        let line = |part: Part, label: Text| {
            let [x, y] = drawn(&self.curves, part);
            Series { name: self.speed.clone(), label: language.text(&label).into(), x, y, pen: Pen::Line }
        };
        let mut series =
            vec![line(Part::Stable, Text::new("stable", "устойчиво")), line(Part::Unstable, Text::new("unstable", "неустойчиво"))];
        for way in Way::ALL {
            let own = || self.runs.iter().filter(move |ran| ran.way == way);
            series.extend(own().next().map(|_| Series {
                name: self.speed.clone(),
                label: language.text(&way.label()).into(),
                x: own().map(|ran| ran.value).collect(),
                y: own().map(|ran| ran.speed).collect(),
                pen: Pen::Dots,
            }));
        }
        let mark = |(k, fold): (usize, &[f64; 2])| Mark::Point { x: fold[0], y: fold[1], label: (k + 1).to_string() };
        let symbol = &self.parameter.symbol;
        let title = language.pick(
            format!("Speeds of steady turning over {symbol}"),
            format!("Скорости установившегося вращения в зависимости от {symbol}"),
        );
        let speed = Quantity { symbol: self.speed.clone(), ..Quantity::new("speed", "rad/s") };
        vec![Figure {
            name: "branches".into(),
            title: title.into(),
            kind: Kind::Plane { equal: false },
            x: axis(self.parameter.clone(), knots().map(|knot| knot.value).collect()),
            y: axis(speed, knots().map(|knot| knot.speed).chain(self.runs.iter().map(|ran| ran.speed)).collect()),
            series,
            marks: self.folds.iter().enumerate().map(mark).collect(),
            along: None,
            strip: Vec::new(),
            field: None,
        }]
    }
}
