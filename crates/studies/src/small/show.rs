//! Modes and responses as tables, figures and sentences.

use crate::results::{Results, Show, View};
use crate::small::modes::{Found, columns};
use crate::small::response::{Deformed, ResponseFound};
use analysis::Dataset;
use mechanics::model::FrequencyVariable;
use report::document::{Formula, Inline, Rich};
use report::figure::{Axis, Mark, Pen, Series};
use report::formula::{Bracket, Layout, Printer, Relation};
use report::table::Column;
use report::{Block, Cell, Figure, Table, Word};
use words::Language;

/// Significant digits.
const DIGITS: usize = 6;
/// Coordinates of a place that fit into a line.
const SHORT: usize = 8;
/// Orders of a waveform that a table shows.
const ORDERS: usize = 9;

/// A dataset as a table, column for column.
pub fn plain_table(data: &[analysis::dataset::Column], language: Language) -> Table {
    let heads = data.iter().map(|c| Column::with_unit(Rich::symbol(symbol(&c.quantity)), &c.quantity.unit, language));
    let mut table = Table::new(heads.collect());
    let n = data.first().map_or(0, |c| c.values.len());
    let cells: Vec<Vec<Cell>> = data.iter().map(|c| cells(&c.quantity.name, &c.values, language)).collect();
    for i in 0..n {
        table.row(cells.iter().map(|column| column[i].clone()).collect());
    }
    table
}

/// The printed symbol of a column.
fn symbol(quantity: &analysis::Quantity) -> String {
    match quantity.name.as_str() {
        "mode" => "№".into(),
        "omega" => "ω".into(),
        "omega_d" => "ω_d".into(),
        "damping_ratio" => "ζ".into(),
        "decrement" => "δ".into(),
        "growth" => "Re λ".into(),
        _ => quantity.symbol.clone(),
    }
}

fn cells(name: &str, values: &[f64], language: Language) -> Vec<Cell> {
    if name == "mode" {
        return values.iter().map(|v| Cell::words(format!("{v}"))).collect();
    }
    let finite: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    // Re λ and ζ tell growing motions from dying ones
    let decides = name == "growth" || name == "damping_ratio" || name.starts_with("zeta_");
    let apart = matches!(name, "omega" | "omega_d" | "f" | "T");
    let printed = match () {
        () if decides => Cell::column_of_signs(&finite, DIGITS, language),
        () if apart => Cell::column_apart(&finite, DIGITS, language),
        () => Cell::column(&finite, DIGITS, language),
    };
    let mut shown = printed.into_iter();
    values.iter().map(|v| if v.is_finite() { shown.next().unwrap_or(Cell::Empty) } else { Cell::words("–") }).collect()
}

/// The equilibrium about which the motions are small, in one line.
fn place(found: &Found, language: Language) -> String {
    let place = Place { coordinates: found.small.machine.coordinates(), q: &found.small.place.q };
    let name = if found.about_start {
        language.pick("At the start", "В начале движения")
    } else {
        language.word(Word::Equilibrium)
    };
    place.called(name, language)
}

/// Values of coordinates.
struct Place<'p> {
    coordinates: &'p [analysis::Quantity],
    q: &'p [f64],
}

impl Place<'_> {
    /// In one line.
    fn called(&self, name: &str, language: Language) -> String {
        format!("{name}: {}", place_of(self.coordinates, self.q, language))
    }
}

fn place_of(coordinates: &[analysis::Quantity], q: &[f64], language: Language) -> String {
    let value = |(q, v): (&analysis::Quantity, &f64)| {
        let unit = report::unit::print(&q.unit, language);
        let number = report::number::short(*v, 4, language);
        format!("{} = {}", report::symbol::plain(&q.symbol, language), report::number::with_unit(&number, &unit))
    };
    let list: Vec<String> = coordinates.iter().zip(q).map(value).collect();
    list.join(", ")
}

impl Show for Found {
    fn blocks(&self, results: &Results, view: &View) -> Vec<Block> {
        modes(self, &results.data, view)
    }

    fn figures(&self, results: &Results, language: Language) -> Vec<Figure> {
        let orders = self.tracks.as_ref().map_or(&[][..], |t| &t.orders);
        campbell(&results.data, orders, language).into_iter().collect()
    }
}

impl Show for ResponseFound {
    fn blocks(&self, results: &Results, view: &View) -> Vec<Block> {
        response(self, results, view)
    }

    fn figures(&self, results: &Results, language: Language) -> Vec<Figure> {
        response_figures(self, &results.data, language)
    }
}

/// Everything about modes.
fn modes(f: &Found, data: &Dataset, view: &View) -> Vec<Block> {
    let language = view.language;
    let mut blocks = vec![Block::paragraph(place(f, language))];
    if let Some(written) = &f.written {
        let words =
            language.pick("Equations of small motions about it, in deviations:", "Уравнения малых движений около него, в отклонениях:");
        blocks.push(Block::paragraph(words));
        let printer = Printer::of(f.small.machine.equations(), language).with_width(90);
        for (i, equality) in written.equations.iter().enumerate() {
            let formula = printer.block(printer.equality_layout(&written.graph, *equality, Some(i)));
            blocks.push(Block::Equation { formula, numbered: false });
        }
    }
    let shown = columns(f);
    blocks.push(Block::Table(plain_table(&shown, language)));
    blocks.push(Block::paragraph(legend(&shown, language)));
    if let Some(equation) = &f.equation {
        let of = language.pick("Frequency equation", "Частотное уравнение");
        let words = format!("{of}: {}", polynomial(&equation.text, language));
        blocks.push(with_meaning(words, f.variable.as_ref(), view));
    }
    if let Some(tracks) = &f.tracks {
        blocks.push(Block::Table(plain_table(&thinned(&tracks.data), language)));
        for c in &tracks.critical {
            let unit = f.small.machine.parameters().iter().find(|q| q.name == tracks.parameter).map_or("rad/s", |q| q.unit.as_str());
            let number = report::number::short(c.value, DIGITS, language);
            let value = report::number::with_unit(&number, &report::unit::print(unit, language));
            let words = language.pick("Critical speed", "Критическая скорость");
            let mode = language.pick("mode", "форма");
            let order = if c.order == 1.0 {
                String::new()
            } else {
                format!(", {} {}", language.pick("order", "порядок"), report::number::short(c.order, DIGITS, language))
            };
            blocks.push(Block::paragraph(format!("{words}: {value} ({mode} {}{order})", c.mode + 1)));
        }
        if f.modes.gyroscopic && !tracks.critical.is_empty() {
            let words = language.pick(
                "These are the crossings with the lines ω = nΩ. An unbalance of a rotor whose supports are alike in all directions excites the forward whirl only.",
                "Это пересечения с линиями ω = nΩ. Дисбаланс ротора с опорами, одинаковыми по всем направлениям, возбуждает только прямую прецессию.",
            );
            blocks.push(Block::paragraph(words));
        }
        if view.is_page() {
            blocks.extend(campbell(data, &tracks.orders, language).map(Block::Figure));
        }
    }
    blocks.extend(crate::results::events::notes(data, language));
    blocks
}

/// A frequency equation with what its unknown is: z = ω², or the file's multiple of it.
pub fn with_meaning(words: String, variable: Option<&FrequencyVariable>, view: &View) -> Block {
    let Some(variable) = variable else { return Block::paragraph(format!("{words}, z = ω²")) };
    let printer = Printer::of(view.equations, view.language);
    let factor = printer.layout(&view.equations.graph, variable.factor);
    let square =
        Layout::Power(Box::new(Layout::Symbol(printer.named("ω"))), Box::new(Layout::Number { mantissa: "2".into(), exponent: None }));
    let right = Layout::Product(vec![
        if matches!(factor, Layout::Sum(_)) { Layout::Fence(Bracket::Round, Box::new(factor)) } else { factor },
        square,
    ]);
    let left = Layout::Symbol(printer.named(&variable.name));
    let formula = Formula::inline(Layout::Related(Box::new(left), Relation::Equal, Box::new(right)));
    Block::Paragraph(Rich(vec![Inline::Words(format!("{words}, ")), Inline::Formula(formula)]))
}

/// What the symbols of the table of modes mean.
pub fn legend(columns: &[analysis::dataset::Column], language: Language) -> String {
    let words = [
        ("omega", "ω = |λ| natural frequency", "ω = |λ| – собственная частота"),
        ("T", "T = 2π/ω period without regard to damping", "T = 2π/ω – период без учёта затухания"),
        ("omega_d", "ω_d = |Im λ| frequency with damping", "ω_d = |Im λ| – частота с учётом затухания"),
        ("damping_ratio", "ζ damping ratio", "ζ – относительное затухание"),
        ("decrement", "δ logarithmic decrement", "δ – логарифмический декремент"),
        ("growth", "Re λ rate of growth", "Re λ – показатель роста"),
        ("omega_exact", "ω_e exact frequency of the distributed mass", "ω_e – точная частота (распределённая масса)"),
        ("error", "Δ = (ω − ω_e)/ω_e", "Δ = (ω − ω_e)/ω_e"),
    ];
    let shown = words.iter().filter(|(name, ..)| columns.iter().any(|c| c.quantity.name == *name));
    let mut words: Vec<&str> = shown.map(|(_, en, ru)| language.pick(*en, *ru)).collect();
    let of = |name: &str| columns.iter().find(|c| c.quantity.name == name).map(|c| c.values.as_slice());
    if let (Some(omega), Some(growth)) = (of("omega"), of("growth"))
        && omega.iter().zip(growth).any(|(w, g)| *w == 0.0 && *g > 0.0)
    {
        words.push(language.pick(
            "a motion that grows without oscillation has no frequency, ω = 0",
            "у движения, растущего без колебаний, частоты нет, ω = 0",
        ));
    }
    words.join("; ")
}

/// Frequencies over the parameter, with damping where there is any, and the lines ω = k Ω of the orders of a speed.
fn campbell(data: &Dataset, orders: &[f64], language: Language) -> Option<Figure> {
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

/// At most a dozen rows of a long dataset, the ends among them.
fn thinned(data: &Dataset) -> Vec<analysis::dataset::Column> {
    let n = data.columns.first().map_or(0, |c| c.values.len());
    let rows = 11.min(n);
    let pick = |k: usize| if rows > 1 { k * (n - 1) / (rows - 1) } else { k };
    let thin = |c: &analysis::dataset::Column| analysis::dataset::Column {
        quantity: c.quantity.clone(),
        values: (0..rows).map(|k| c.values[pick(k)]).collect(),
    };
    data.columns.iter().map(thin).collect()
}

/// Everything about a response.
fn response(found: &ResponseFound, results: &Results, view: &View) -> Vec<Block> {
    let language = view.language;
    let mut blocks = vec![Block::paragraph(format!("{}: {}", language.pick("Load", "Нагрузка"), language.text(&found.load)))];
    if let Some(own) = &found.own {
        if own.place.len() <= SHORT && own.place.iter().any(|q| *q != 0.0) {
            let place = Place { coordinates: &found.coordinates, q: &own.place };
            blocks.push(Block::paragraph(place.called(language.word(Word::Equilibrium), language)));
        }
        blocks.push(Block::Table(own_table(found, own, language)));
    }
    if !found.orders.is_empty() {
        blocks.push(Block::Table(orders_table(found, language)));
    }
    if let Some(superposed) = &found.superposed {
        blocks.push(Block::Table(superposed_table(found, superposed, language)));
    }
    blocks.extend((!found.shapes.is_empty()).then(|| Block::Table(shapes_table(found, language))));
    if !found.resonances.is_empty() {
        blocks.push(Block::Table(resonances(found, language)));
    } else if results.trouble.is_none() {
        let none = language.pick(
            "No resonance: no amplitude has a largest value in the range.",
            "Резонансов нет: ни одна амплитуда не имеет максимума в диапазоне.",
        );
        blocks.push(Block::paragraph(none));
    }
    if !found.antiresonances.is_empty() {
        blocks.push(Block::Table(antiresonances(found, language)));
    }
    blocks.extend(crate::results::events::notes(&results.data, language));
    if view.is_page() {
        blocks.extend(response_figures(found, &results.data, language).into_iter().map(Block::Figure));
    }
    blocks
}

fn heads(list: &[(&str, &str)], language: Language) -> Vec<Column> {
    list.iter().map(|(words, unit)| if unit.is_empty() { Column::new(*words) } else { Column::with_unit(*words, unit, language) }).collect()
}

fn number(x: f64, language: Language) -> Cell {
    match () {
        () if x.is_nan() => Cell::words("–"),
        () if x.is_infinite() => Cell::words(if x < 0.0 { "−∞" } else { "∞" }),
        () => Cell::number(x, DIGITS, language),
    }
}

/// Symbol and unit of a quantity, the first cells of its row.
fn named(q: &analysis::Quantity, language: Language) -> [Cell; 2] {
    let unit = q.display.as_ref().map_or(&q.unit, |(unit, _)| unit);
    [Cell::symbol(q.symbol.clone()), Cell::words(report::unit::print(unit, language))]
}

/// A number of it, SI, in the unit of its row.
fn in_unit(q: &analysis::Quantity, value: f64) -> f64 {
    q.display.as_ref().map_or(value, |(_, size)| value / size)
}

/// Amplitude, phase, static displacement and dynamic coefficient at the frequency of the file.
fn own_table(found: &ResponseFound, own: &analysis::studies::response::Point, language: Language) -> Table {
    use analysis::studies::response::{magnitude, phase};
    let omega = report::number::short(own.omega, DIGITS, language);
    let title = format!("ω = {}", report::number::with_unit(&omega, &report::unit::print("rad/s", language)));
    let words =
        language.pick(["amplitude", "phase", "static", "amplification"], ["амплитуда", "фаза", "статически", "коэффициент динамичности"]);
    let unit = language.word(Word::Unit);
    let columns = [(title.as_str(), ""), (unit, ""), (words[0], ""), (words[1], "rad"), (words[2], ""), (words[3], "")];
    let mut table = Table::new(heads(&columns, language));
    for (k, q) in found.outputs.iter().enumerate() {
        let (z, still) = (own.outputs[k], magnitude(own.still[k]));
        let mut row = named(q, language).to_vec();
        row.extend([in_unit(q, magnitude(z)), phase(z), in_unit(q, still)].map(|x| number(x, language)));
        row.push(number(if still > 0.0 { magnitude(z) / still } else { f64::NAN }, language));
        table.row(row);
    }
    table
}

/// Amplitude and phase of every order at the frequency of the file.
fn orders_table(found: &ResponseFound, language: Language) -> Table {
    use analysis::studies::response::{magnitude, phase};
    let words = language.pick(["harmonic of", "order", "amplitude", "phase"], ["гармоника", "порядок", "амплитуда", "фаза"]);
    let unit = language.word(Word::Unit);
    let columns = [(words[0], ""), (unit, ""), (words[1], ""), ("ω", "rad/s"), (words[2], ""), (words[3], "rad")];
    let mut table = Table::new(heads(&columns, language));
    for (k, q) in found.outputs.iter().enumerate() {
        for (order, own) in found.orders.iter().take(ORDERS).filter_map(|o| Some((o.order, o.own.as_ref()?))) {
            let z = own.outputs[k];
            let mut row = named(q, language).to_vec();
            row.extend([order, own.omega, in_unit(q, magnitude(z)), phase(z)].map(|x| number(x, language)));
            table.row(row);
        }
    }
    table
}

/// All orders together over a period.
fn superposed_table(found: &ResponseFound, s: &analysis::studies::superposition::Superposed, language: Language) -> Table {
    let words = language.pick(
        ["over a period", "mean", "largest deviation", "at", "greatest", "least"],
        ["за период", "среднее", "наибольшее отклонение", "в момент", "наибольшее", "наименьшее"],
    );
    let unit = language.word(Word::Unit);
    let columns = [(words[0], ""), (unit, ""), (words[1], ""), (words[2], ""), (words[3], "s"), (words[4], ""), (words[5], "")];
    let mut table = Table::new(heads(&columns, language));
    for (q, r) in found.outputs.iter().zip(&s.outputs) {
        let mut row = named(q, language).to_vec();
        let [mean, largest, max, min] = [r.mean, r.largest.0, r.max.0, r.min.0].map(|x| in_unit(q, x));
        row.extend([mean, largest, r.largest.1, max, min].map(|x| number(x, language)));
        table.row(row);
    }
    table
}

/// Motions at the frequencies asked for: the coordinates, and what else is wanted.
fn shapes_table(found: &ResponseFound, language: Language) -> Table {
    use analysis::studies::response::{magnitude, phase};
    let words = language.pick(
        ["given frequencies ω", "quantity", "amplitude", "phase", "static", "amplification"],
        ["заданные частоты ω", "величина", "амплитуда", "фаза", "статически", "коэффициент динамичности"],
    );
    let unit = language.word(Word::Unit);
    let columns = [(words[0], "rad/s"), (words[1], ""), (unit, ""), (words[2], ""), (words[3], "rad"), (words[4], ""), (words[5], "")];
    let mut table = Table::new(heads(&columns, language));
    let output = |q: &analysis::Quantity| found.outputs.iter().position(|o| o.name == q.name);
    let coordinate = |q: &analysis::Quantity| found.coordinates.iter().position(|c| c.name == q.name);
    for shape in &found.shapes {
        let others = found.outputs.iter().filter(|q| coordinate(q).is_none());
        for q in found.coordinates.iter().chain(others) {
            let wanted = output(q);
            let Some(z) = coordinate(q).map(|i| shape.coordinates[i]).or_else(|| Some(shape.outputs[wanted?])) else { continue };
            let still = wanted.map_or(f64::NAN, |k| magnitude(shape.still[k]));
            let mut row = vec![number(shape.omega, language)];
            row.extend(named(q, language));
            row.extend([in_unit(q, magnitude(z)), phase(z), in_unit(q, still)].map(|x| number(x, language)));
            row.push(number(if still > 0.0 { magnitude(z) / still } else { f64::NAN }, language));
            table.row(row);
        }
    }
    table
}

fn resonances(found: &ResponseFound, language: Language) -> Table {
    let words = language.pick(
        ["resonance of", "amplitude", "phase", "amplification", "quality"],
        ["резонанс", "амплитуда", "фаза", "коэффициент динамичности", "добротность"],
    );
    let unit = language.word(Word::Unit);
    let mut columns =
        vec![(words[0], ""), (unit, ""), ("ω", "rad/s"), ("f", "Hz"), (words[1], ""), (words[2], "rad"), (words[3], ""), (words[4], "")];
    if !found.orders.is_empty() {
        columns.insert(2, (language.pick("order", "порядок"), ""));
    }
    let mut table = Table::new(heads(&columns, language));
    let several = !found.orders.is_empty();
    for (r, order) in found.resonances.iter().zip(&found.resonance_orders) {
        let q = &found.outputs[r.output];
        let mut row = named(q, language).to_vec();
        if several {
            row.push(number(*order, language));
        }
        let omega = r.omega / order;
        row.extend(
            [omega, omega / std::f64::consts::TAU, in_unit(q, r.amplitude), r.phase, r.gain, r.quality].map(|x| number(x, language)),
        );
        table.row(row);
    }
    table
}

fn antiresonances(found: &ResponseFound, language: Language) -> Table {
    let words = language.pick(["antiresonance of", "amplitude", "absorbed by"], ["антирезонанс", "амплитуда", "поглощает"]);
    let unit = language.word(Word::Unit);
    let columns = [(words[0], ""), (unit, ""), ("ω", "rad/s"), ("f", "Hz"), (words[1], ""), (words[2], "")];
    let mut table = Table::new(heads(&columns, language));
    for (a, order) in found.antiresonances.iter().zip(&found.antiresonance_orders) {
        let name = |(i, share): &(usize, f64)| {
            let symbol = report::symbol::plain(&found.coordinates[*i].symbol, language);
            format!("{symbol} {} %", report::number::short(100.0 * share, 3, language))
        };
        let absorbs: Vec<String> = a.absorbs.iter().map(name).collect();
        let q = &found.outputs[a.output];
        let mut row = named(q, language).to_vec();
        let omega = a.omega / order;
        row.extend([omega, omega / std::f64::consts::TAU, in_unit(q, a.amplitude)].map(|x| number(x, language)));
        row.push(Cell::words(absorbs.join(", ")));
        table.row(row);
    }
    table
}

/// Amplitudes, phases and Nyquist's curve.
fn response_figures(found: &ResponseFound, data: &Dataset, language: Language) -> Vec<Figure> {
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

/// A polynomial as text for people: raised exponents, true minus, the decimal mark of the language.
pub fn polynomial(text: &str, language: Language) -> String {
    let mut out = String::new();
    let mut raised = false;
    for c in text.chars() {
        raised = c == '^' || raised && c.is_ascii_digit();
        match c {
            '^' => {}
            c if raised => out.push_str(&report::number::superscript(&c.to_string())),
            '-' => out.push('−'),
            '.' => out.push_str(language.pick(".", ",")),
            c => out.push(c),
        }
    }
    out
}
