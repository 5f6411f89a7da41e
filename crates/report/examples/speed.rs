//! How long tables and pictures take, to be read by people: `cargo run --release --example speed`.

use analysis::dataset::Column;
use analysis::{Dataset, Quantity};
use report::{Figure, csv, figure, json};
use std::time::Instant;
use words::Language;

fn main() {
    for n_rows in [1000, 1_000_000] {
        let values = |k: usize| (0..n_rows).map(|i| (i as f64 * 0.37 + k as f64).sin()).collect();
        let columns = (0..10).map(|k| Column { quantity: Quantity::new(&format!("x{k}"), "m"), values: values(k) }).collect();
        let mut data = Dataset { axis: Some(0), columns, ..Dataset::default() };
        let start = Instant::now();
        let bytes = csv::write(&data, csv::Dialect::Plain).len();
        println!("{n_rows} rows: csv {bytes} bytes in {:?}", start.elapsed());
        let start = Instant::now();
        let bytes = json::write(&data, &serde_json::Map::new(), Language::En).len();
        println!("{n_rows} rows: json {bytes} bytes in {:?}", start.elapsed());
        data.columns[0].values = (0..n_rows).map(|i| i as f64).collect();
        let start = Instant::now();
        let Some(picture) = Figure::over_axis(&data, &["x1", "x2"], Language::Ru) else { return };
        let bytes = figure::svg::write(&picture, figure::Title::Above, Language::Ru).len();
        println!("{n_rows} rows: svg {bytes} bytes in {:?}", start.elapsed());
        let start = Instant::now();
        let bytes = figure::png::write(&picture, figure::Title::Above, Language::Ru).map_or(0, |png| png.len());
        println!("{n_rows} rows: png {bytes} bytes in {:?}", start.elapsed());
    }
}
