//! Modes and responses as tables and sentences.

use crate::results::{Results, Show, View};
use crate::small::figures::{campbell, response_figures};
use crate::small::modes::{Found, columns};
use crate::small::response::ResponseFound;
use analysis::Dataset;
use mechanics::model::FrequencyVariable;
use report::document::{Formula, Inline, Rich};
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

/// Coefficients with more digits are read by nobody: the equation is divided by its first coefficient and rounded.
const LONG: usize = 9;
/// Significant digits of what is rounded then.
const ROUNDED: usize = 7;

/// A polynomial whose first coefficient is 1, where coefficients are long numbers; none where they are short, or letters.
fn scaled(text: &str, language: Language) -> Option<String> {
    let (left, right) = text.split_once(" = ")?;
    let (mut terms, mut sign, mut factor): (Vec<(f64, &str)>, f64, Option<f64>) = (Vec::new(), 1.0, None);
    let mut open = true;
    for token in left.split(' ').chain(["+"]) {
        match token {
            "+" | "-" => {
                terms.extend(factor.take().map(|c| (sign * c, "")));
                (sign, open) = (if token == "-" { -1.0 } else { 1.0 }, true);
            }
            // letters among the coefficients are no long numbers
            power if power.starts_with(|c: char| c.is_alphabetic()) && open => {
                terms.push((sign * factor.take().unwrap_or(1.0), power));
                open = false;
            }
            number => factor = Some(number.parse().ok()?),
        }
    }
    let digits = |token: &str| token.chars().filter(char::is_ascii_digit).count();
    let long = left.split(' ').any(|token| token.parse::<f64>().is_ok() && digits(token) > LONG);
    let first = terms.first().map(|t| t.0).filter(|first| long && *first != 0.0)?;
    let term = |(i, (c, power)): (usize, &(f64, &str))| {
        let c = c / first;
        let size = report::number::short(c.abs(), ROUNDED, language);
        let sign = match (i, c < 0.0) {
            (0, false) => "",
            (0, true) => "−",
            (_, false) => " + ",
            (_, true) => " − ",
        };
        let space = if power.is_empty() { "" } else { " " };
        if c.abs() == 1.0 && !power.is_empty() { format!("{sign}{power}") } else { format!("{sign}{size}{space}{power}") }
    };
    Some(format!("{} = {right}", terms.iter().enumerate().map(term).collect::<String>()))
}

/// A polynomial as text for people: raised exponents, true minus, the decimal mark of the language; long coefficients are scaled.
pub fn polynomial(text: &str, language: Language) -> String {
    let scaled = scaled(text, language);
    let is_scaled = scaled.is_some();
    let text = scaled.as_deref().unwrap_or(text);
    let mut out = String::new();
    let mut raised = false;
    for c in text.chars() {
        raised = c == '^' || raised && c.is_ascii_digit();
        match c {
            '^' => {}
            c if raised => out.push_str(&report::number::superscript(&c.to_string())),
            '-' => out.push('−'),
            '.' if !is_scaled => out.push_str(language.pick(".", ",")),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whole multiples of one equation are one equation: 1.5·10⁹ (z² − 3 z + 2).
    #[test]
    fn long_coefficients_are_divided_by_the_first() {
        let told = |text: &str| polynomial(text, Language::Ru);
        assert_eq!(told("1500000000 z^2 - 4500000000 z + 3000000000 = 0"), "z² − 3 z + 2 = 0");
        assert_eq!(told("504 z^3 - 729 z^2 + 94 z - 1 = 0"), "504 z³ − 729 z² + 94 z − 1 = 0");
        assert_eq!(told("4000000000 z - 1000000000 = 0"), "z − 0,25 = 0");
        assert_eq!(told("m z^2 - 2.5 = 0"), "m z² − 2,5 = 0");
    }
}
