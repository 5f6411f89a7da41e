//! The plots that a study asks for.

use analysis::Dataset;
use mechanics::model::Plot;
use report::Figure;
use symbolic::Equations;
use symbolic::equations::Role;
use words::{Language, Text};

/// A plot for each coordinate, over the axis.
pub fn of_coordinates(equations: &Equations) -> Vec<Plot> {
    let coordinates = equations.outputs.iter().filter(|o| o.role == Role::Coordinate);
    coordinates.map(|o| Plot { title: Text::default(), x: None, y: vec![o.name.clone()] }).collect()
}

/// Figures that a study asks for. Their names differ.
///
/// What is asked for twice is drawn once.
pub fn plots(plots: &[Plot], data: &Dataset, language: Language) -> Vec<Figure> {
    let first = |(i, plot): &(usize, &Plot)| !plots[..*i].iter().any(|p| p.x == plot.x && p.y == plot.y);
    let plots: Vec<&Plot> = plots.iter().enumerate().filter(first).map(|(_, plot)| plot).collect();
    distinct(plots.into_iter().filter_map(|plot| figure(plot, data, language)).collect())
}

fn distinct(mut figures: Vec<Figure>) -> Vec<Figure> {
    for i in 1..figures.len() {
        let (before, rest) = figures.split_at_mut(i);
        if before.iter().any(|f| f.name == rest[0].name) {
            rest[0].name = format!("{}-{}", rest[0].name, i + 1);
        }
    }
    figures
}

fn figure(plot: &Plot, data: &Dataset, language: Language) -> Option<Figure> {
    let names: Vec<&str> = plot.y.iter().map(String::as_str).collect();
    let mut figure = match plot.x.as_deref() {
        None | Some("t") => Figure::over_axis(data, &names, language)?,
        Some(x) => {
            let mut figure = Figure::in_plane(data, x, &names, language)?;
            figure.name = format!("{}-{}", report::escape::file_name(&x.replace('\'', "_rate")), figure.name);
            figure
        }
    };
    let title = language.text(&plot.title);
    if !title.is_empty() {
        figure.title = title.into();
    }
    Some(figure)
}
