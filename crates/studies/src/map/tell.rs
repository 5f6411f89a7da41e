//! The map as a result: its places as a table, its boundaries as another, what is to be said of both.

use super::classes::{Classes, Judge};
use super::command::command;
use super::places::{Places, Stop, ends, interrupted, value};
use super::show::Shown;
use super::tongues;
use crate::machine::Machine;
use crate::provenance;
use crate::repeat::gathered::{Gathered, Row, partly_absent};
use crate::repeat::{self, Asks, Repeated, regimes};
use crate::results::{Body, Fact, Results};
use crate::stability;
use crate::stability::plane::{Over, Plane};
use crate::watch::Watch;
use analysis::dataset::{Column, Labels, Missing};
use analysis::studies::map::{Grid, Map, map};
use analysis::{Dataset, Quantity};
use mechanics::asked::{Asked, Value as Taken};
use mechanics::model::SweepRange;
use serde_json::{Value, json};
use std::sync::Arc;
use words::{Notice, Text};

/// Points along a side for which a diagram has polynomials at least.
const POINTS: usize = 500;

/// Carries the study out and fills in the results.
pub(super) fn mapped(
    machine: &Machine,
    (asked, inner, grid): (&Asked, &Asked, Grid),
    results: &mut Results,
    watch: &mut Watch,
) -> Result<(), Notice> {
    let range = |key| if let Some(Taken::Ranges(list)) = asked.get(key) { list.first().cloned() } else { None };
    let (Some(x), Some(y)) = (range("x"), range("y")) else { return Ok(()) };
    let ranges = [x, y];
    let (judge, numbers) = judged(machine, asked)?;
    let repeated = Repeated::new(machine, Asks { observe: &numbers, of: asked.word("of"), inner })?;
    let diagram = diagram(machine, (&ranges, &repeated), (grid, judge), watch);
    let mut places = Places::new(machine, (&ranges, &repeated), (asked, grid, judge, diagram), watch)?;
    let found = map(grid, &mut |list| places.find(list));
    let anew = places.anew();
    let (classes, rows, diagram) = (places.classes, places.rows, places.diagram);
    results.own.insert("of".into(), json!(repeated.base.kind));
    results.own.insert("read_anew".into(), json!(anew));
    let level = level_words(&repeated, judge);
    let shown: Vec<String> = repeated.noted.iter().map(|(_, wanted)| wanted.to_string()).collect();
    let names: Vec<Text> = (0..classes.sorts.len()).map(|class| classes.name(machine, class, (&shown, &level))).collect();
    let mut data = table(machine, (&ranges, &repeated), (&classes, &names), &rows, results);
    match found {
        Err(Stop::Trouble(trouble)) => return Err(trouble),
        Err(Stop::Interrupted) => {
            data.partial = true;
            data.notes.push(interrupted(rows.len()));
        }
        Ok(found) => {
            let told = Told { machine, ranges: &ranges, classes: &classes, names: &names, map: &found };
            told.facts(results);
            told.words(&repeated, results);
            told.boundaries(results);
            data.notes.extend(told.notes());
            data.notes.extend(crate::repeat::without_impulses(machine, &repeated.noted));
            let tongues = diagram.as_ref().map(|plane| tongues::found(plane, ranges.clone().map(|range| ends(&range))));
            if let (Some(plane), Some(found)) = (&diagram, &tongues) {
                tongues::tell(&[0, 1].map(|k| told.quantity(k)), plane, found, results);
                data.audits.push(tongues::audit(plane));
            }
            let values =
                rows.iter().map(|row| row.numbers.as_ref().map_or_else(|_| Vec::new(), |list| list.iter().map(|(v, _)| *v).collect()));
            let columns: Vec<Column> = data.columns.iter().map(|c| Column { quantity: c.quantity.clone(), values: Vec::new() }).collect();
            let drawn = asked.words("observe").len().min(repeated.noted.len());
            let command = command(machine, &repeated, inner);
            let values = values.collect();
            let ends = ranges.clone().map(|range| ends(&range));
            results.body = Body::After(Arc::new(Shown {
                map: found,
                classes,
                names,
                columns,
                values,
                drawn,
                ends,
                command,
                tongues: tongues.map(|found| found.1).unwrap_or_default(),
            }));
        }
    }
    results.data = provenance::stamp(data, &machine.equations, &machine.model_hash);
    Ok(())
}

/// What tells places apart, and the numbers that are noted for it.
fn judged(machine: &Machine, asked: &Asked) -> Result<(Judge, Vec<String>), Notice> {
    let judge = match asked.number("level") {
        _ if asked.flag("regimes") => Judge::Regimes,
        Some(level) => Judge::Level(level),
        None => Judge::Gaps,
    };
    let mut numbers = asked.words("observe").to_vec();
    if judge == Judge::Regimes {
        numbers.extend(regimes::numbers(machine)?.into_iter().filter(|text| !asked.words("observe").contains(text)));
    }
    Ok((judge, numbers))
}

/// The diagram that has all verdicts, where verdicts alone are mapped and the machine has one.
fn diagram(
    machine: &Machine,
    (ranges, repeated): (&[SweepRange; 2], &Repeated),
    (grid, judge): (Grid, Judge),
    watch: &Watch,
) -> Option<Plane> {
    let verdicts = repeated.base.kind == stability::KIND.name && judge == Judge::Gaps && repeated.noted.is_empty();
    // curves ask for many places besides those of the lattice
    let points = [(grid.finest() as usize + 1).max(POINTS); 2];
    let over =
        Over { names: [0, 1].map(|k| ranges[k].name.as_str()), ends: [0, 1].map(|k| ends(&ranges[k])), points, interrupt: watch.interrupt };
    verdicts.then(|| Plane::of(machine, repeated, &over)).flatten()
}

/// The level with its unit.
fn level_words(repeated: &Repeated, judge: Judge) -> Text {
    let Judge::Level(level) = judge else { return Text::default() };
    let (number, unit) =
        (words::digits::seven_digits(level), Text::unit(repeated.noted.first().map_or("1", |(quantity, _)| &quantity.unit)));
    if unit.en.is_empty() || unit.en == "1" {
        return number;
    }
    Text::new(format!("{} {}", number.en, unit.en), format!("{} {}", number.ru, unit.ru))
}

/// The places in order of the first value, then the second, whichever way they were computed.
fn table(
    machine: &Machine,
    (ranges, repeated): (&[SweepRange; 2], &Repeated),
    (classes, names): (&Classes, &[Text]),
    rows: &[Row],
    results: &mut Results,
) -> Dataset {
    let order = in_order(rows);
    let mut gathered = Gathered::new(machine, ranges, &repeated.noted);
    order.iter().for_each(|k| gathered.take(&repeated.noted, &rows[*k]));
    let mut data = Dataset::default();
    let mut without = gathered.tell(&mut data, results, rows.len());
    without.extend(partly_absent(&gathered.columns[gathered.own..], &without));
    data.columns = gathered.columns;
    without.into_iter().for_each(|(column, words)| data.state(&column, Missing::Absent, words));
    if classes.sorts.len() > 1 || classes.judge != Judge::Gaps || rows.iter().any(|row| row.stable.is_some()) {
        let mut known = classes.clone();
        let list: Vec<usize> = order.iter().map(|k| known.of(&rows[*k])).collect();
        data.labels.push(Labels { name: "regime".into(), words: names.iter().map(|name| name.en.clone()).collect(), rows: list });
    }
    data
}

/// Positions of the rows by their first values, then by their second ones; rows of one place stay as they are.
fn in_order(rows: &[Row]) -> Vec<usize> {
    // a quarter of a million places: whole numbers that ascend as the values do are sorted in a tenth of the time of the values themselves
    let key = |row: &Row, k: usize| ascending(row.values.get(k).map_or(f64::NAN, |(_, value)| *value));
    let mut order: Vec<([u64; 2], usize)> = rows.iter().enumerate().map(|(k, row)| ([key(row, 0), key(row, 1)], k)).collect();
    order.sort_unstable();
    order.into_iter().map(|(_, k)| k).collect()
}

/// A whole number that ascends as numbers do in their total order: the bits of negative ones turned round, those of others behind them.
fn ascending(value: f64) -> u64 {
    let bits = value.to_bits();
    if value.is_sign_negative() { !bits } else { bits | 1 << 63 }
}

/// What is told of a finished map.
struct Told<'a> {
    machine: &'a Machine,
    ranges: &'a [SweepRange; 2],
    classes: &'a Classes,
    names: &'a [Text],
    map: &'a Map,
}

impl Told<'_> {
    fn facts(&self, results: &mut Results) {
        let count = |name: &str, symbol: &str, value: f64, en: &str, ru: &str| Fact::new(name, symbol, "1", value, Text::new(en, ru));
        let [computed, nodes] = [self.map.computed as f64, self.map.nodes.len() as f64];
        results.facts.extend([
            count("computed", "N", computed, "places that were computed", "вычислено точек"),
            count("nodes", "N_0", nodes, "of them places of the lattice", "из них точек сетки"),
            count("curves", "n", self.map.lines.len() as f64, "curves of boundaries", "линий границ"),
            count("lattice", "N_max", self.map.grid.places() as f64, "places of the finest lattice", "точек самой мелкой сетки"),
        ]);
        let shares = self.map.shares();
        for &(class, share) in &shares {
            let name = &self.names[class];
            let label = Text::new(format!("share of the plane: {}", or_all(name).en), format!("доля плоскости: {}", or_all(name).ru));
            results.facts.push(Fact::new(&format!("share_{}", class + 1), &format!("s_{}", class + 1), "1", share, label));
        }
        let shares: serde_json::Map<String, Value> =
            shares.into_iter().map(|(class, share)| (or_all(&self.names[class]).en, json!(share))).collect();
        results.own.insert("shares".into(), Value::Object(shares));
    }

    fn words(&self, repeated: &Repeated, results: &mut Results) {
        let grid = self.map.grid;
        let step = |k: usize| (self.quantity(k), (ends(&self.ranges[k])[1] - ends(&self.ranges[k])[0]) / f64::from(grid.cells));
        let size = |k: usize| {
            let (quantity, step) = step(k);
            let (number, unit) = (words::digits::rounded(step), Text::unit(&quantity.unit));
            let joined =
                |number: &str, unit: &str| if unit == "1" || unit.is_empty() { number.to_owned() } else { format!("{number} {unit}") };
            Text::new(joined(&number.en, &unit.en), joined(&number.ru, &unit.ru))
        };
        let (x, y, kind) = (size(0), size(1), repeated.base.kind);
        results.words.push(Text::new(
            format!(
                "The study `{kind}` was carried out at {} of {} places of the finest lattice, and {} times between them to close in boundaries, to {} of each range. What lies inside of one coarse cell ({} by {}) without \
                 reaching its corners is not seen: more `cells` see smaller islands.",
                self.map.nodes.len(),
                grid.places(),
                self.map.computed - self.map.nodes.len(),
                words::digits::number(grid.accuracy).en,
                x.en,
                y.en
            ),
            format!(
                "Расчёт `{kind}` выполнен в точках самой мелкой сетки: {} из {}; между ними ещё {} раз, для уточнения границ, до {} каждого промежутка. Область, лежащая внутри одной крупной ячейки ({} на {}) и не \
                 доходящая до её вершин, не видна: меньшие острова видны при большем `cells`.",
                self.map.nodes.len(),
                grid.places(),
                self.map.computed - self.map.nodes.len(),
                words::digits::number(grid.accuracy).ru,
                x.ru,
                y.ru
            ),
        ));
    }

    fn notes(&self) -> Vec<Text> {
        let mut notes = Vec::new();
        let grouped = self.classes.groups.iter().any(|groups| groups.count() > 1);
        if grouped {
            notes.push(Text::new(
                "regimes are groups of values here, parted where neighbouring values of the coarse places are further apart than a tenth of their spread and than three cells of a steady slope; [regimes] and --regimes decide it otherwise",
                "режимы здесь — группы значений, разделённые там, где соседние значения в вершинах крупных ячеек отстоят больше чем на десятую часть их разброса и чем на три ячейки равномерного склона; иначе это решают [regimes] и --regimes",
            ));
        } else if self.classes.judge == Judge::Gaps && self.map.lines.is_empty() {
            notes.push(Text::new(
                "the values have no gap and no verdict changes: there is no boundary, and only the coarse places are computed",
                "у значений нет разрыва, и устойчивость не меняется: границ нет, вычислены только вершины крупных ячеек",
            ));
        }
        if self.map.narrow > 0 {
            let n = self.map.narrow;
            notes.push(Text::new(
                format!("on {n} finest edges a third regime lies between the two of their ends: it is narrower than a finest cell there; more `refine` shows it"),
                format!("на мельчайших рёбрах ({n}) между режимами их концов лежит третий: он там уже мельчайшей ячейки; его покажет большее `refine`"),
            ));
        }
        notes
    }

    fn quantity(&self, k: usize) -> Quantity {
        repeat::quantity(self.machine, &self.ranges[k].name)
    }

    /// The boundaries as a table of points, and in JSON.
    fn boundaries(&self, results: &mut Results) {
        let column = |k: usize| Column { quantity: self.quantity(k), values: Vec::new() };
        let number = Quantity { label: Text::new("number of the curve", "номер линии"), ..Quantity::new("curve", "1") };
        let mut columns = vec![Column { quantity: number, values: Vec::new() }, column(0), column(1)];
        let words: Vec<String> = self.names.iter().map(|name| or_all(name).en).collect();
        let labels = |name: &str| Labels { name: name.into(), words: words.clone(), rows: Vec::new() };
        let mut sides = ["left", "right"].map(labels);
        let mut list: Vec<Value> = Vec::new();
        for (k, line) in self.map.lines.iter().enumerate() {
            let points: Vec<[f64; 2]> =
                line.points.iter().map(|place| [value(&self.ranges[0], place[0]), value(&self.ranges[1], place[1])]).collect();
            for [x, y] in &points {
                columns[0].values.push((k + 1) as f64);
                columns[1].values.push(*x);
                columns[2].values.push(*y);
                sides.iter_mut().zip(line.sides).for_each(|(side, class)| side.rows.push(class));
            }
            list.push(json!({"left": words[line.sides[0]], "right": words[line.sides[1]], "points": points}));
        }
        results.own.insert("boundaries".into(), json!(list));
        results.beside.push(("boundaries", Dataset { columns, labels: sides.into(), ..Dataset::default() }));
    }
}

/// The name of a class; of the only one there is.
fn or_all(name: &Text) -> Text {
    if name.en.is_empty() { Text::new("all", "всё") } else { name.clone() }
}
