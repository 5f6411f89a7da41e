//! Boundaries of the tongues of a diagram over the plane of a map: as curves with names, as a table, in JSON and in words.

use crate::results::{Fact, Results};
use crate::stability::plane::Plane;
use analysis::dataset::{Audit, Column, Labels};
use analysis::studies::stability::{Along, Curve, Edge, curves};
use analysis::{Dataset, Quantity};
use serde_json::{Value, json};
use words::Text;

/// Rows from which curves are drawn.
const ROWS: usize = 129;

/// The curves of a plane; empty where neither range changes the coefficient in one sense throughout.
pub(super) fn found(plane: &Plane, ends: [[f64; 2]; 2]) -> (Along, Vec<Curve>) {
    curves(&plane.diagram, ends, ROWS).unwrap_or((Along::X, Vec::new()))
}

/// The frequency of the coefficients at which a tongue opens, Ω the averaged natural frequency.
fn order(n: usize) -> String {
    match n {
        0 => "Ω = 0".into(),
        1 => "ω ≈ 2Ω".into(),
        2 => "ω ≈ Ω".into(),
        n if n.is_multiple_of(2) => format!("ω ≈ Ω/{}", n / 2),
        n => format!("ω ≈ 2Ω/{n}"),
    }
}

/// Says what the diagram was, and what its tongues are.
pub(super) fn tell(quantities: &[Quantity; 2], plane: &Plane, (along, list): &(Along, Vec<Curve>), results: &mut Results) {
    let (values, error) = (plane.diagram.values(), plane.diagram.error());
    let diagram = json!({"places": plane.diagram.equations.places(), "solutions": values, "error": error, "compared": Plane::COMPARED, "difference": plane.difference});
    results.own.insert("diagram".into(), diagram);
    results.words.push(Text::new(
        "The machine has Hill's equation: its verdicts are those of the trace, by polynomials over the plane (diagram of Ince and Strutt), which were laid against the study itself.",
        "У машины есть уравнение Хилла: вердикты даёт его след, представленный многочленами на плоскости (диаграмма Айнса — Стретта) и сверенный с самим расчётом.",
    ));
    let mut tongues: Vec<usize> = list.iter().map(|curve| curve.tongue).collect();
    tongues.sort_unstable();
    tongues.dedup();
    for n in &tongues {
        for curve in list.iter().filter(|curve| curve.tongue == *n && curve.edge == Some(Edge::Lower)) {
            let ends = [curve.points.first(), curve.points.last()];
            for tip in ends.into_iter().zip(curve.tips).filter(|(_, is_tip)| *is_tip).filter_map(|(end, _)| end) {
                let (quantity, value) = if *along == Along::X { (&quantities[1], tip[1]) } else { (&quantities[0], tip[0]) };
                let label = Text::new(format!("tongue {n} opens"), format!("открывается область неустойчивости {n}"));
                results.facts.push(Fact::new(&format!("tip_{n}"), &quantity.symbol, &quantity.unit, value, label));
            }
        }
    }
    if !tongues.is_empty() {
        let names: Vec<String> =
            tongues.iter().map(|n| format!("{n} ({}, {})", order(*n), if n.is_multiple_of(2) { "+1" } else { "−1" })).collect();
        let names = names.join("; ");
        results.words.push(Text::new(
            format!("Tongues of instability, with the frequency ω of the coefficient at which each opens beside the averaged natural frequency Ω, and the multiplier on its boundaries: {names}."),
            format!("Области неустойчивости, в скобках — частота ω коэффициента, при которой область открывается, Ω — средняя собственная частота, и мультипликатор на её границах: {names}."),
        ));
    }
    table(quantities, list, results);
}

/// The check that stands for those of all places.
pub(super) fn audit(plane: &Plane) -> Audit {
    let name = Text::new(
        format!("traces over the plane against the machine's own equation at {} places: largest difference", Plane::COMPARED),
        format!("следы на плоскости против собственного уравнения машины, точек: {}; наибольшее расхождение", Plane::COMPARED),
    );
    Audit::at_most("diagram", name, plane.difference, Plane::LIMIT)
}

/// The curves as a table of points, and in JSON.
fn table(quantities: &[Quantity; 2], list: &[Curve], results: &mut Results) {
    let column = |quantity: Quantity| Column { quantity, values: Vec::new() };
    let own = |name: &str, en: &str, ru: &str| column(Quantity { label: Text::new(en, ru), ..Quantity::new(name, "1") });
    let mut columns = vec![
        own("curve", "number of the curve", "номер линии"),
        own("tongue", "number of the tongue", "номер области неустойчивости"),
        own("multiplier", "multiplier on it", "мультипликатор на ней"),
        column(quantities[0].clone()),
        column(quantities[1].clone()),
    ];
    let mut names = Labels { name: "name".into(), words: list.iter().map(Curve::name).collect(), rows: Vec::new() };
    for (k, curve) in list.iter().enumerate() {
        for [x, y] in &curve.points {
            let row = [(k + 1) as f64, curve.tongue as f64, curve.multiplier(), *x, *y];
            columns.iter_mut().zip(row).for_each(|(column, value)| column.values.push(value));
            names.rows.push(k);
        }
    }
    let json = |curve: &Curve| {
        let edge = curve.edge.map(|edge| if edge == Edge::Lower { "lower" } else { "upper" });
        json!({"name": curve.name(), "tongue": curve.tongue, "edge": edge, "multiplier": curve.multiplier(), "tips": curve.tips, "points": curve.points})
    };
    results.own.insert("tongues".into(), list.iter().map(json).collect::<Vec<Value>>().into());
    results.beside.push(("tongues", Dataset { columns, labels: vec![names], ..Dataset::default() }));
}
