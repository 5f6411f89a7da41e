//! Modes and responses as figures.

use crate::small::response::{Deformed, ResponseFound};
use analysis::Dataset;
use report::Figure;
use report::document::{Inline, Rich};
use report::figure::{Axis, Mark, Pen, Series};
use words::Language;

/// Frequencies over the parameter, with damping where there is any, and the lines ω = k Ω of the orders of a speed.
pub(super) fn campbell(data: &Dataset, orders: &[f64], language: Language) -> Option<Figure> {
    let of = |stem: &str| -> Vec<&str> {
        let numbered = |n: &&str| n.strip_prefix(stem).is_some_and(|rest| rest.parse::<usize>().is_ok());
        data.columns.iter().skip(1).map(|c| c.quantity.name.as_str()).filter(numbered).collect()
    };
    let damped = of("omega_d_");
    let names = if damped.is_empty() { of("omega_") } else { damped };
    let mut figure = Figure::over_axis(data, &names, language)?;
    figure.name = "campbell".into();
    figure.y.log = false;
    let lines: Vec<Series> = orders.iter().filter_map(|order| line_of_speed(data, &figure, *order)).collect();
    figure.series.extend(lines);
    Some(figure)
}

/// The line ω = k Ω over a speed, as far as the frequencies reach.
fn line_of_speed(data: &Dataset, figure: &Figure, order: f64) -> Option<Series> {
    let axis = data.columns.first().filter(|c| matches!(c.quantity.unit.as_str(), "rad/s" | "1/s"))?;
    let highest = figure.series.iter().flat_map(|s| &s.y).filter(|v| v.is_finite()).fold(0.0_f64, |m, v| m.max(*v));
    let within = |v: f64| if v <= 1.05 * highest { v } else { f64::NAN };
    let y = axis.values.iter().map(|v| within(order * v.abs())).collect();
    let name = axis.quantity.symbol.clone();
    Some(Series { label: format!("{order}×{name}"), name, x: axis.values.clone(), y, pen: Pen::Line })
}

/// Amplitudes, phases and Nyquist's curve.
pub(super) fn response_figures(found: &ResponseFound, data: &Dataset, language: Language) -> Vec<Figure> {
    let mut figures = Vec::new();
    for (i, group) in by_unit(&found.outputs).iter().enumerate() {
        let Some(mut figure) = over_frequency((found, data), group, "amplitude", language) else { continue };
        figure.name = if i == 0 { "response-amplitude".into() } else { format!("response-amplitude-{}", i + 1) };
        figure.y.log = found.study.log;
        figure.y.symbols = vec![language.pick("amplitude", "амплитуда").into()];
        figure.marks = resonance_marks(found, group, language);
        if let [only] = group[..] {
            figure.title =
                Rich(vec![Inline::Words(language.pick("Amplitude of ", "Амплитуда ").into()), Inline::Symbol(only.symbol.clone())]);
        }
        if !figure.y.log && found.resonances.iter().any(|r| r.amplitude.is_infinite()) {
            cut_off(&mut figure);
        }
        figures.push(figure);
    }
    let all: Vec<&analysis::Quantity> = found.outputs.iter().collect();
    if let Some(mut figure) = over_frequency((found, data), &all, "phase", language) {
        figure.name = "response-phase".into();
        figure.y.log = false;
        figure.y.symbols = vec![language.pick("phase", "фаза").into()];
        figures.push(figure);
    }
    figures.extend(nyquist(found, data, language));
    figures.extend(found.deformed.iter().map(|d| deformed(d, language)));
    figures
}

/// The deformed rods at a frequency of the load.
fn deformed(found: &Deformed, language: Language) -> Figure {
    let omega = report::number::short(found.omega, 5, language);
    let times = report::number::short(found.factor, 2, language);
    let title = language.pick(
        format!("Deformed rods under the largest load, ω = {omega} rad/s, magnified ×{times}"),
        format!("Форма вынужденных колебаний при наибольшей нагрузке, ω = {omega} рад/с, увеличение ×{times}"),
    );
    let curve = |label: (&str, &str), line: &(Vec<f64>, Vec<f64>), name: &str| Series {
        name: name.into(),
        label: language.pick(label.0, label.1).into(),
        x: line.0.clone(),
        y: line.1.clone(),
        pen: Pen::Line,
    };
    let series = vec![
        curve(("undeformed", "недеформированная схема"), &found.straight, ""),
        curve(("deformed", "деформированная схема"), &found.line, "w"),
    ];
    let name = format!("deformed-{omega}").replace([',', '.'], "-");
    Figure::to_scale(name, title.as_str().into(), ("m", ["x", "y"]), series)
}

/// An amplitude without bound is drawn up to so many times what it is over most of the range: with more the rest would lie on the axis.
const CUT_OFF: f64 = 10.0;

/// Leaves out what lies beyond [`CUT_OFF`].
fn cut_off(figure: &mut Figure) {
    let mut all: Vec<f64> = figure.series.iter().flat_map(|s| &s.y).copied().filter(|y| y.is_finite()).collect();
    all.sort_by(f64::total_cmp);
    let Some(usual) = all.get(all.len() / 2) else { return };
    let starts = figure.series.iter().filter_map(|s| s.y.first()).filter(|y| y.is_finite());
    let top = CUT_OFF * starts.fold(*usual, |most, y| most.max(*y));
    figure.series.iter_mut().flat_map(|s| &mut s.y).filter(|y| **y > top).for_each(|y| *y = f64::NAN);
}

/// Outputs of one unit together, in the order of the first: metres and newtons on one axis would hide each other.
fn by_unit(outputs: &[analysis::Quantity]) -> Vec<Vec<&analysis::Quantity>> {
    let mut groups: Vec<Vec<&analysis::Quantity>> = Vec::new();
    for q in outputs {
        match groups.iter_mut().find(|g| g[0].unit == q.unit) {
            Some(group) => group.push(q),
            None => groups.push(vec![q]),
        }
    }
    groups
}

/// Columns of outputs over the frequency, called by the outputs; the axis says what is drawn of them.
fn over_frequency(
    (found, data): (&ResponseFound, &Dataset),
    outputs: &[&analysis::Quantity],
    tail: &str,
    language: Language,
) -> Option<Figure> {
    let names: Vec<String> = outputs.iter().map(|q| format!("{}_{tail}", q.name)).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let mut figure = Figure::over_axis(data, &names, language)?;
    figure.title = match tail {
        "phase" => language.pick("Phases", "Фазы"),
        _ => language.pick("Amplitudes", "Амплитуды"),
    }
    .into();
    figure.x.log = found.study.log;
    for (series, q) in figure.series.iter_mut().zip(outputs) {
        (series.name, series.label) = (q.symbol.clone(), language.text(&q.label).into());
    }
    Some(figure)
}

/// Lines at the resonances of these outputs.
fn resonance_marks(found: &ResponseFound, outputs: &[&analysis::Quantity], language: Language) -> Vec<Mark> {
    let mut marks = Vec::new();
    for (r, order) in found.resonances.iter().zip(&found.resonance_orders) {
        if !outputs.iter().any(|q| q.name == found.outputs[r.output].name) {
            continue;
        }
        let omega = r.omega / order;
        let mark = Mark::Vertical { x: omega, label: report::number::short(omega, 4, language) };
        if !marks.contains(&mark) {
            marks.push(mark);
        }
    }
    marks
}

fn nyquist(found: &ResponseFound, data: &Dataset, language: Language) -> Option<Figure> {
    let column = |q: &analysis::Quantity, tail: &str| data.column(&format!("{}_{tail}", q.name)).map(|c| c.values.clone());
    let series: Vec<Series> = found
        .outputs
        .iter()
        .filter_map(|q| {
            let (x, y) = (column(q, "re")?, column(q, "im")?);
            // a curve on the real axis says nothing
            y.iter().any(|v| v.abs() > 0.0).then(|| Series {
                name: q.symbol.clone(),
                label: language.text(&q.label).into(),
                x,
                y,
                pen: Pen::Line,
            })
        })
        .collect();
    let units: Vec<&str> = found.outputs.iter().map(|q| q.unit.as_str()).collect();
    if series.is_empty() || units.iter().any(|u| *u != units[0]) {
        return None;
    }
    let title = language.pick("Nyquist plot", "Годограф (амплитудно-фазовая характеристика)").into();
    let along = data.columns.first().map(|c| (Axis::of_columns(&[c]), c.values.clone()));
    Some(Figure { along, ..Figure::to_scale("nyquist".into(), title, (units[0], ["Re", "Im"]), series) })
}
