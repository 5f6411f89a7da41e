//! Writes a page, pictures and tables with everything the report can show, to look at: `cargo run --example sample -- DIR`.

use analysis::Dataset;
use analysis::Quantity;
use analysis::dataset::{Column, Event};
use report::document::{Content, Formula, Inline, Rich};
use report::figure::{Happening, Mark, Title, png, svg};
use report::formula::{Bare, Bracket, Layout, Printer, Relation, Sign};
use report::table::Verdict;
use report::{Block, Cell, Document, Download, Figure, Table, Word, csv, json, page, table, terminal};
use words::{Language, Text};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let dir = std::path::PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "out/sample".into()));
    std::fs::create_dir_all(&dir)?;
    let data = data();
    std::fs::write(dir.join("motion.csv"), csv::write(&data, csv::Dialect::Plain))?;
    std::fs::write(dir.join("motion-ru.csv"), csv::write(&data, csv::Dialect::Ru))?;
    std::fs::write(dir.join("motion.json"), json::write(&data, &serde_json::Map::new(), Language::En))?;
    for language in [Language::En, Language::Ru] {
        let code = language.code();
        let document = document(&data, language);
        std::fs::write(dir.join(format!("{code}.html")), page::write(&document, page::Options::default()))?;
        for (i, figure) in figures(&data, language).iter().enumerate() {
            std::fs::write(dir.join(format!("{code}-{i}.svg")), svg::write(figure, Title::Above, language))?;
            std::fs::write(dir.join(format!("{code}-{i}.png")), png::write(figure, Title::Above, language)?)?;
        }
        println!("{}", terminal::write(&document, 100));
    }
    Ok(())
}

/// A damped oscillation written by formula: there is no machine behind it.
fn data() -> Dataset {
    let t: Vec<f64> = (0..=30_000).map(|i| i as f64 * 1e-3).collect();
    let column = |name: &str, unit: &str, en: &str, ru: &str, f: &dyn Fn(f64) -> f64| Column {
        quantity: Quantity { label: Text::new(en, ru), ..Quantity::new(name, unit) },
        values: t.iter().map(|&t| f(t)).collect(),
    };
    let columns = vec![
        column("t", "s", "time", "время", &|t| t),
        column("phi", "rad", "pendulum angle", "угол маятника", &|t| 1.5 * (-0.1 * t).exp() * (4.0 * t).cos()),
        column("phi'", "rad/s", "angular velocity", "угловая скорость", &|t| -6.0 * (-0.1 * t).exp() * (4.0 * t).sin()),
        column("omega_p", "rad/s", "shaft speed", "скорость вала", &|t| 300.0 * (t / 10.0).min(1.0)),
        column("x_h", "m", "housing, horizontal", "корпус, по горизонтали", &|t| {
            0.002 * (3.0 * t).sin() * (1.0 - (-t).exp())
        }),
        column("y_h", "m", "housing, vertical", "корпус, по вертикали", &|t| {
            0.004 * (3.0 * t + 0.5).cos() * (1.0 - (-t).exp())
        }),
    ];
    let event = |t: f64, en: &str, ru: &str| Event { t, what: Text::new(en, ru), ..Event::default() };
    let mut data = Dataset { axis: Some(0), columns, ..Dataset::default() };
    data.events = vec![event(10.0, "run-up ends", "конец разгона"), event(17.25, "sign(v) changes", "смена знака v")];
    data.provenance.version = "0.1.0".into();
    data.provenance.model_hash = "9f86d081884c7d65".into();
    data
}

fn figures(data: &Dataset, language: Language) -> Vec<Figure> {
    let mut both = Figure::over_axis(data, &["phi", "omega_p"], language);
    let mut speed = Figure::over_axis(data, &["phi'"], language);
    if let Some(figure) = &mut speed {
        figure.strip.push(Happening { from: 21.0, to: 24.0, what: language.pick("stick", "залипание").into() });
        figure.marks.push(Mark::Horizontal { y: 5.0, label: language.pick("limit", "предел").into() });
    }
    let mut log = Figure::over_axis(data, &["omega_p"], language);
    if let Some(figure) = &mut log {
        figure.y.log = true;
    }
    if let Some(figure) = &mut both {
        figure.strip.clear();
    }
    let shift = Figure::over_axis(data, &["x_h", "y_h"], language);
    let path = Figure::in_plane(data, "x_h", &["y_h"], language);
    let phase = Figure::in_plane(data, "phi", &["phi'"], language);
    [speed, both, shift, path, phase, log].into_iter().flatten().collect()
}

fn parameters(language: Language) -> Table {
    let word = |w| language.word(w);
    let text = |en: &str, ru: &str| language.pick(en, ru).to_string();
    let mut parameters = Table::new(vec![
        table::Column::new(word(Word::Symbol)),
        table::Column::new(word(Word::Written)),
        table::Column::new(word(Word::ValueSi)),
        table::Column::new(word(Word::Unit)),
        table::Column::new(word(Word::Description)),
    ])
    .with_caption(word(Word::Parameters));
    for (name, written, value, unit, label) in [
        ("m", "20 g", 0.02, "kg", text("mass of the pendulum", "масса маятника")),
        ("l", "50 mm", 0.05, "m", text("length", "длина")),
        ("c_x", "400 kN/m", 4e5, "N/m", text("horizontal stiffness", "жёсткость по горизонтали")),
        ("k", "1e-4 N m s", 1e-4, "N m s", text("damping", "коэффициент демпфирования")),
        ("J_1", "12,5 кг·м²", 12.5, "kg m^2", text("inertia", "момент инерции")),
    ] {
        parameters.row(vec![
            Cell::symbol(name),
            Cell::words(written),
            Cell::number(value, 4, language),
            Cell::words(report::unit::print(unit, language)),
            Cell::words(label),
        ]);
    }
    parameters
}

fn audits(language: Language) -> Table {
    let word = |w| language.word(w);
    let text = |en: &str, ru: &str| language.pick(en, ru).to_string();
    let mut audits = Table::new(vec![
        table::Column::new(word(Word::Check)),
        table::Column::new(word(Word::Value)),
        table::Column::new(word(Word::Limit)),
        table::Column::new(word(Word::Verdict)),
    ])
    .with_caption(word(Word::Checks));
    for (name, value, verdict) in [
        (
            text("two derivations, largest relative difference", "два вывода, наибольшее относительное расхождение"),
            3.2e-13,
            Verdict::Passed,
        ),
        (text("power balance along the motion", "баланс мощностей вдоль движения"), 2.4e-8, Verdict::Failed),
    ] {
        audits.row(vec![Cell::words(name), Cell::number(value, 2, language), Cell::number(1e-10, 1, language), Cell::Verdict(verdict)]);
    }
    audits
}

fn events(data: &Dataset, language: Language) -> Table {
    let word = |w| language.word(w);
    let mut events = Table::new(vec![table::Column::with_unit(word(Word::Time), "s", language), table::Column::new(word(Word::Event))])
        .with_caption(word(Word::Events));
    let times = Cell::column(&data.events.iter().map(|e| e.t).collect::<Vec<_>>(), 4, language);
    for (time, event) in times.into_iter().zip(&data.events) {
        events.row(vec![time, Cell::words(language.text(&event.what))]);
    }
    events
}

/// An equation of motion and an energy.
fn formulas(language: Language) -> (Formula, Formula) {
    let printer = Printer::new(language);
    let letter = |name: &str| Layout::Symbol(printer.named(name));
    let sine = Layout::Call { name: "sin", power: None, argument: Box::new(letter("phi")), bare: Bare::Always };
    let square = |name: &str| Layout::Power(Box::new(letter(name)), Box::new(Layout::Words("2".into())));
    let left = Layout::Sum(vec![
        (Sign::Plus, Layout::Product(vec![letter("m"), square("l"), letter("phi''")])),
        (Sign::Plus, Layout::Product(vec![letter("m"), letter("g"), letter("l"), sine])),
    ]);
    let slip = Layout::Sum(vec![(Sign::Plus, letter("phi'")), (Sign::Minus, letter("omega"))]);
    let slip = Layout::Fence(Bracket::Round, Box::new(slip));
    let right = Layout::Sum(vec![(Sign::Minus, Layout::Product(vec![letter("k"), slip]))]);
    let equal = |left, right| Layout::Related(Box::new(left), Relation::Equal, Box::new(right));
    let formula = printer.block(equal(left, right));
    let half = Layout::Fraction(Box::new(Layout::Words("1".into())), Box::new(Layout::Words("2".into())));
    let small = printer.block(equal(letter("T"), Layout::Product(vec![half, letter("m"), square("v")])));
    (formula, small)
}

fn document(data: &Dataset, language: Language) -> Document {
    let word = |w| language.word(w);
    let text = |en: &str, ru: &str| language.pick(en, ru).to_string();
    let (formula, small) = formulas(language);
    let mut blocks = vec![
        Block::heading(1, word(Word::Coordinates)),
        Block::Paragraph(Rich(vec![
            Inline::Words(format!("{}: 3. {}: ", word(Word::DegreesOfFreedom), word(Word::Coordinates))),
            Inline::Symbol("x".into()),
            Inline::Words(", ".into()),
            Inline::Symbol("y".into()),
            Inline::Words(", ".into()),
            Inline::Symbol("phi".into()),
            Inline::Words(".".into()),
        ])),
        Block::heading(1, word(Word::Equations)),
        Block::Equation { formula: formula.clone(), numbered: true },
        Block::Equation { formula: formula.clone(), numbered: true },
        Block::Details {
            summary: word(Word::Derivation).into(),
            blocks: vec![
                Block::paragraph(text("Kinetic energy of the body:", "Кинетическая энергия тела:")),
                Block::Equation { formula: small, numbered: false },
            ],
        },
        Block::heading(1, word(Word::Parameters)),
        Block::Table(parameters(language)),
        Block::heading(1, word(Word::Checks)),
        Block::Table(audits(language)),
        Block::heading(1, word(Word::Simulation)),
        Block::Table(events(data, language)),
    ];
    blocks.extend(figures(data, language).into_iter().map(Block::Figure));
    blocks.push(Block::heading(1, word(Word::Downloads)));
    let beside = |name: &str, label: String| Download { name: name.into(), label, content: Content::Beside };
    blocks.push(Block::Downloads(vec![
        beside("motion.csv", text("table, 17 digits", "таблица, 17 знаков")),
        beside("motion-ru.csv", text("table for Russian spreadsheets", "таблица для Excel")),
        beside("motion.json", text("all data", "все данные")),
    ]));
    Document {
        language,
        title: text("Pendulum on a rotating shaft", "Маятник на вращающемся валу"),
        description: text(
            "A pendulum hangs on the shaft of an elastically mounted rotor. A picture of what a report can show; not a calculation.",
            "Маятник подвешен к валу ротора на упругих опорах. Пример оформления; не расчёт.",
        ),
        blocks,
        version: "0.1.0".into(),
        model_hash: data.provenance.model_hash.clone(),
    }
}
