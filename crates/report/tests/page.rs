//! The page and the pictures: self-contained, harmless, well formed.

use analysis::dataset::{Column, Event};
use analysis::{Dataset, Quantity};
use report::document::{Content, Formula, Rich};
use report::figure::{Title, png, svg};
use report::formula::Layout;
use report::table::Verdict;
use report::{Block, Cell, Document, Download, Figure, Table, page, table, terminal};
use words::{Language, Text};

const NASTY: &str = "<script>alert(1)</script>\"'&</style><!--";

fn data() -> Dataset {
    let t: Vec<f64> = (0..20_000).map(|i| i as f64 * 1e-3).collect();
    let label = || Text::same(NASTY);
    let column = |name: &str, unit: &str, f: &dyn Fn(f64) -> f64| Column {
        quantity: Quantity { label: label(), ..Quantity::new(name, unit) },
        values: t.iter().map(|&t| f(t)).collect(),
    };
    let columns = vec![column("t", "s", &|t| t), column(NASTY, "rad", &f64::sin), column("x", "m", &|t| 1e-3 * t.cos())];
    let events = vec![Event { t: 1.0, what: Text::same(NASTY), ..Event::default() }];
    Dataset { axis: Some(0), columns, events, ..Dataset::default() }
}

fn document(language: Language) -> Document {
    let data = data();
    let mut cells = Table::new(vec![table::Column::new(NASTY)]).with_caption(NASTY);
    cells.row(vec![Cell::symbol(NASTY)]);
    cells.row(vec![Cell::Verdict(Verdict::Failed)]);
    let blocks = vec![
        Block::heading(1, NASTY),
        Block::paragraph(NASTY),
        Block::Equation { formula: Formula::inline(Layout::Words("x".into())), numbered: true },
        Block::Equation { formula: Formula::inline(Layout::Words(NASTY.into())), numbered: false },
        Block::Table(cells),
        Block::Figure(Figure::over_axis(&data, &[NASTY, "x"], language).unwrap()),
        Block::Details { summary: NASTY.into(), blocks: vec![Block::Figure(Figure::in_plane(&data, "x", &[NASTY], language).unwrap())] },
        Block::Downloads(vec![
            Download { name: NASTY.into(), label: NASTY.into(), content: Content::Beside },
            Download {
                name: "a.csv".into(),
                label: String::new(),
                content: Content::Inside { media: "text/csv".into(), bytes: b"t [s]\n".to_vec() },
            },
        ]),
    ];
    Document { language, title: NASTY.into(), description: NASTY.into(), blocks, version: NASTY.into(), model_hash: NASTY.into() }
}

#[test]
fn a_page_asks_the_network_for_nothing() {
    for language in [Language::En, Language::Ru] {
        let html = page::write(&document(language), page::Options { math_font: Some(b"font") });
        for (at, _) in html.match_indices("http") {
            let rest = &html[at..html.len().min(at + 22)];
            // namespaces are names; the policy is named by the header that it replaces
            assert!(rest.starts_with("http://www.w3.org/") || rest.starts_with("http-equiv"), "{rest}");
        }
        assert!(!html.contains(" src=") && !html.contains("@import"));
        assert!(html.contains(&format!("<html lang=\"{}\">", language.code())));
    }
}

#[test]
fn user_text_cannot_become_markup() {
    let html = page::write(&document(Language::En), page::Options::default());
    // two programs, one block of data: nothing that the user wrote opens or closes a tag
    assert_eq!(html.matches("<script").count(), 3);
    assert_eq!(html.matches("</script").count(), 3);
    assert_eq!(html.matches("</style").count(), 1);
    assert!(!html.contains("alert(1)</") && !html.contains("<!--"));
    assert!(html.contains("&lt;script&gt;alert(1)&lt;/script&gt;"));
}

#[test]
fn the_same_document_gives_the_same_bytes() {
    let write = || page::write(&document(Language::Ru), page::Options::default());
    assert_eq!(write(), write());
}

#[test]
fn captions_are_numbered_in_order() {
    let html = page::write(&document(Language::Ru), page::Options::default());
    assert!(html.contains("Рисунок\u{a0}1 – ") && html.contains("Рисунок\u{a0}2 – ") && html.contains("Таблица\u{a0}1 – "));
    let text = terminal::write(&document(Language::Ru), 80);
    assert!(text.contains("Рисунок 1 – ") && text.contains("Рисунок 2 – ") && text.contains("(1)"));
}

#[test]
fn pictures_are_well_formed_and_drawn() {
    for language in [Language::En, Language::Ru] {
        let mut figure = Figure::over_axis(&data(), &[NASTY, "x"], language).unwrap();
        for log in [false, true] {
            figure.y.log = log;
            let text = svg::write(&figure, Title::Above, language);
            assert_eq!(text.matches("<text").count(), text.matches("</text>").count());
            // reading it as XML is part of drawing it
            let bytes = png::write(&figure, Title::Above, language).unwrap();
            assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
        }
    }
}

#[test]
fn odd_curves_are_drawn_without_panic() {
    for values in [vec![], vec![f64::NAN; 3], vec![0.0; 3], vec![f64::MAX, -f64::MAX, 0.0], vec![f64::INFINITY, 1.0, 5e-324], vec![-1.0; 3]]
    {
        let columns = ["t", "x"].map(|name| Column { quantity: Quantity::new(name, "m"), values: values.clone() });
        let data = Dataset { axis: Some(0), columns: columns.into(), ..Dataset::default() };
        for figure in [Figure::over_axis(&data, &["x"], Language::Ru), Figure::in_plane(&data, "t", &["x"], Language::Ru)] {
            let mut figure = figure.unwrap();
            for log in [false, true] {
                (figure.x.log, figure.y.log) = (log, log);
                assert!(png::write(&figure, Title::Above, Language::Ru).is_ok(), "{values:?}");
                let blocks = vec![Block::Figure(figure.clone()), Block::paragraph(Rich::from("x"))];
                let document = Document { blocks, ..document(Language::Ru) };
                assert!(page::write(&document, page::Options::default()).contains("</html>"));
            }
        }
    }
}
