//! Branches as rows, fields of JSON and sentences.

use super::asked::{Branched, coordinates, symbol, unit};
use super::beside::Spine;
use super::creases;
use super::phrases::{end_in_words, ends_in_words, name, state};
use super::show::Shown;
use crate::equilibrium;
use crate::machine::Machine;
use crate::periodic::{self, json_of};
use crate::provenance;
use crate::results::{Body, Fact, Results};
use analysis::audits::worst;
use analysis::dataset::{Audit, Column};
use analysis::studies::continuation::{Crease, Curve, Diagram, Facts, ON_BRANCH, Of, Place, Special};
use analysis::{Dataset, Quantity};
use serde_json::{Value, json};
use std::sync::Arc;
use words::{Language, Text};

/// Puts a diagram into results.
pub(super) fn tell(machine: &Machine, study: &Branched, (diagram, spine): (&Diagram, Option<Spine>), results: &mut Results) {
    results.data = provenance::stamp(dataset(machine, study, diagram), &machine.equations, &machine.model_hash);
    results
        .own
        .insert("parameter".into(), json!({"name": study.name, "unit": unit(machine, &study.name), "from": study.from, "to": study.to}));
    results.own.insert("branches".into(), diagram.curves.iter().enumerate().flat_map(|(k, curve)| pieces(machine, k, curve)).collect());
    results.own.insert("special".into(), diagram.special.iter().map(|special| special_to_json(machine, diagram, special)).collect());
    results.own.insert("curves".into(), diagram.curves.iter().map(|curve| curve_to_json(machine, curve)).collect());
    results.own.insert("work".into(), json!({"turns": diagram.work.turns, "variations": diagram.work.variations}));
    for (k, (_, _, special)) in diagram.special.iter().enumerate() {
        let label = Text::new(format!("point {}: {}", k + 1, name(special.what).en), format!("точка {}: {}", k + 1, name(special.what).ru));
        let fact = Fact::new(
            &format!("special_{}", k + 1),
            &symbol(machine, &study.name),
            &unit(machine, &study.name),
            special.place.parameter(),
            label,
        );
        results.facts.push(fact.with_words(extent(machine, study, special)));
    }
    for (k, curve) in diagram.curves.iter().enumerate() {
        results.words.push(about(machine, study, (k, diagram.curves.len()), curve));
        results.words.extend(by_collocation(machine, study, curve));
        results.words.extend(curve.is_neutral().then(|| alike_all_round(k + 1)));
    }
    results.words.extend(unnamed(machine, study, diagram));
    if diagram.special.is_empty() && diagram.unnamed.is_empty() {
        results.words.push(Text::new("Nothing happens on it: no fold, no branch point.", "Особых точек нет: ни поворотов, ни ветвлений."));
    }
    if diagram.left_out > 0 {
        results.words.push(Text::new(
            format!("Branches that part and are not followed: {}; take more `branches`.", diagram.left_out),
            format!("Не прослежено отходящих ветвей: {}; увеличьте `branches`.", diagram.left_out),
        ));
    }
    if diagram.deeper > 0 {
        results.words.push(Text::new(
            format!("Motions of more than four periods are not followed; period doublings that lead to them: {}.", diagram.deeper),
            format!("Движения более чем с четырьмя периодами не прослеживаются; ведущих к ним удвоений периода: {}.", diagram.deeper),
        ));
    }
    if diagram.unmet > 0 {
        results.words.push(Text::new(
            format!("Directions in which a branch parts and no point of it was found: {}.", diagram.unmet),
            format!("Направлений, в которых ветвь отходит, но её точка не найдена: {}.", diagram.unmet),
        ));
    }
    if diagram.families > 0 {
        results.words.push(Text::new(
            "Without damping the motions that part where oscillations set in form families at each value of the parameter; they are not followed.",
            "Без сопротивления движения, отходящие в точке возникновения колебаний, образуют семейства при каждом значении параметра и не прослеживаются.",
        ));
    }
    results.words.push(Text::new(
        "What hangs together with the first motion is followed; closed branches apart from it are not looked for.",
        "Прослежено то, что связано с исходным движением; отдельно лежащие замкнутые ветви не разыскиваются.",
    ));
    creases::tell(machine, study, diagram, results);
    spine.iter().for_each(|spine| spine.tell((&parameter(machine, study), &coordinates(machine)), results));
    results.body = Body::After(Arc::new(Shown::new(machine, study, (diagram, spine))));
}

fn alike_all_round(branch: usize) -> Text {
    Text::new(
        format!(
            "Branch {branch}: all along it a place, or a motion, can be moved in some direction without any change, as in a machine that is alike all round. One of each family is followed, and branches that part from it are not looked for."
        ),
        format!(
            "Ветвь {branch}: на всём её протяжении положение или движение можно сместить в некотором направлении без всякого изменения, как в машине, одинаковой во все стороны. Прослежено одно движение из каждого семейства; отходящие от него ветви не разыскиваются."
        ),
    )
}

/// Where stability changes and nothing is named.
fn unnamed(machine: &Machine, study: &Branched, diagram: &Diagram) -> Option<Text> {
    let (symbol, unit) = (symbol(machine, &study.name), unit(machine, &study.name));
    let list = |language: Language| {
        let one = |(which, place): &(usize, usize)| {
            let [a, b] = [place - 1, *place].map(|k| {
                let number = report::number::short(diagram.curves[*which].places[k].parameter(), 8, Language::En);
                if language == Language::Ru { number.replace('.', ",") } else { number }
            });
            format!("{} ({symbol} = {a} ... {b} {})", which + 1, report::unit::print(&unit, language))
        };
        diagram.unnamed.iter().map(one).collect::<Vec<_>>().join("; ")
    };
    (!diagram.unnamed.is_empty()).then(|| {
        Text::new(
            format!(
                "Stability changes between neighbouring points, and what happens there was not found, on branch {}.",
                list(Language::En)
            ),
            format!("Между соседними точками меняется устойчивость, а что там происходит, не установлено: ветвь {}.", list(Language::Ru)),
        )
    })
}

/// The parameter as a column has it.
fn parameter(machine: &Machine, study: &Branched) -> Quantity {
    let label = machine.model.parameters.iter().find(|p| p.name == study.name).map(|p| p.label.clone()).unwrap_or_default();
    Quantity { symbol: symbol(machine, &study.name), label, ..Quantity::new(&study.name, &unit(machine, &study.name)) }
}

/// Share of a parameter below which what is not known of it is no digit of the table.
const SHOWN: f64 = 5e-9;

/// Greatest values of the coordinates at a point, and what is not known of its place where a table would print it.
fn extent(machine: &Machine, study: &Branched, special: &Special) -> Text {
    let unsure = special.within > SHOWN * special.place.parameter().abs().max(SHOWN * (study.to - study.from).abs());
    let bound = |language: Language| {
        let number = report::number::short(special.within, 2, Language::En);
        let number = if language == Language::Ru { number.replace('.', ",") } else { number };
        let printed = format!("; ± {number} {}", report::unit::print(&unit(machine, &study.name), language));
        if unsure { printed.trim_end().to_owned() } else { String::new() }
    };
    let list = |language: Language| {
        let one = |(q, ends): (&Quantity, &[f64; 2])| {
            let number = report::number::short(ends[1], 6, Language::En);
            let number = if language == Language::Ru { number.replace('.', ",") } else { number };
            format!("{} {number} {}", q.name, report::unit::print(&q.unit, language)).trim_end().to_owned()
        };
        let quantities = coordinates(machine);
        quantities.iter().zip(&special.place.facts().extremes).map(one).collect::<Vec<_>>().join("; ")
    };
    let words = |what: &str, language: Language| format!("{what} {}{}", list(language), bound(language));
    Text::new(words("greatest", Language::En), words("наибольшее", Language::Ru))
}

/// A row of the table.
struct Row<'a> {
    /// Number of the branch, or 0.
    branch: usize,
    /// Number of the curve of special points, or 0.
    crease: usize,
    /// Both parameters.
    plane: [f64; 2],
    place: &'a Place,
}

fn dataset(machine: &Machine, study: &Branched, diagram: &Diagram) -> Dataset {
    let here = study.second.as_ref().map_or(0.0, |second| second.here);
    let on_branches = diagram.curves.iter().enumerate().flat_map(|(k, curve)| {
        curve.places.iter().map(move |place| Row { branch: k + 1, crease: 0, plane: [place.parameter(), here], place })
    });
    let on_creases = diagram.creases.iter().enumerate().flat_map(|(k, crease)| {
        crease.curve.places.iter().map(move |place| Row { branch: 0, crease: k + 1, plane: Crease::plane(place), place })
    });
    let rows: Vec<Row<'_>> = on_branches.chain(on_creases).collect();
    let column = |name: &str, (symbol, unit): (&str, &str), label: Text, value: &dyn Fn(&Row<'_>) -> f64| Column {
        quantity: Quantity { symbol: symbol.into(), label, ..Quantity::new(name, unit) },
        values: rows.iter().map(value).collect(),
    };
    let parameter = |name: &str, value: &dyn Fn(&Row<'_>) -> f64| {
        let label = machine.model.parameters.iter().find(|p| p.name == name).map(|p| p.label.clone()).unwrap_or_default();
        column(name, (&symbol(machine, name), &unit(machine, name)), label, value)
    };
    let mut columns =
        vec![column("branch", ("branch", "1"), Text::new("number of the branch", "номер ветви"), &|row| row.branch as f64)];
    if study.second.is_some() {
        let label = Text::new("number of the curve of special points", "номер кривой особых точек");
        columns.push(column("curve", ("curve", "1"), label, &|row| row.crease as f64));
    }
    columns.push(parameter(&study.name, &|row| row.plane[0]));
    columns.extend(study.second.as_ref().map(|second| parameter(&second.name, &|row| row.plane[1])));
    columns.push(column(
        "stable",
        ("stable", "1"),
        Text::new("1 stable, −1 unstable, 0 not decided", "1 — устойчиво, −1 — неустойчиво, 0 — не решено"),
        &|row| row.place.facts().stable.map_or(0.0, |s| if s { 1.0 } else { -1.0 }),
    ));
    if diagram.curves.iter().any(|c| c.of != Of::Rest) {
        columns.push(column("period", ("T", "s"), Text::new("period", "период"), &|row| row.place.facts().period));
    }
    if diagram.curves.iter().flat_map(|curve| &curve.places).any(|place| place.facts().energy.is_some()) {
        let label = Text::new("energy above that at rest", "энергия сверх энергии покоя");
        columns.push(column("energy", ("E", "J"), label, &|row| row.place.facts().energy.unwrap_or(f64::NAN)));
    }
    for (i, q) in coordinates(machine).iter().enumerate() {
        for (end, word, en, ru) in [(1, "max", "greatest value", "наибольшее значение"), (0, "min", "least value", "наименьшее значение")]
        {
            let names = (format!("{word}({})", q.name), format!("{}_{word}", q.symbol));
            let value = |row: &Row<'_>| row.place.facts().extremes[i][end];
            columns.push(column(&names.0, (&names.1, &q.unit), Text::new(en, ru), &value));
        }
    }
    Dataset { columns, audits: audits(diagram), ..Dataset::default() }
}

/// Determinant and divergence are integrated apart from one another to nine digits.
const LIOUVILLE: f64 = 1e-8;

fn audits(diagram: &Diagram) -> Vec<Audit> {
    let creases = || diagram.creases.iter().map(|crease| &crease.curve);
    let facts = || diagram.curves.iter().chain(creases()).flat_map(|curve| &curve.places).map(Place::facts);
    let most = |of: fn(&Facts) -> f64| worst(facts().map(of));
    let name = Text::new("points lie on their branch: largest relative miss", "точки лежат на ветви: наибольшее относительное отклонение");
    let mut list = vec![Audit::at_most("on_branch", name, most(|f| f.miss), ON_BRANCH)];
    if diagram.curves.iter().any(|curve| curve.of != Of::Rest) {
        let name = Text::new(
            "Liouville's formula: determinant of the variations against the divergence",
            "формула Лиувилля: определитель решений в вариациях против дивергенции",
        );
        list.push(Audit::at_most("liouville", name, most(|f| f.liouville), LIOUVILLE));
    }
    if facts().any(|f| f.intervals.is_some()) {
        let name = Text::new(
            "the motion from each end of the mesh comes to the next one: largest relative miss",
            "движение из каждого узла сетки приходит в следующий: наибольшее относительное отклонение",
        );
        list.push(Audit::at_most("collocation", name, most(|f| f.defect), ON_BRANCH));
    }
    list
}

/// That points of a branch were found by collocation, and why.
fn by_collocation(machine: &Machine, study: &Branched, curve: &Curve) -> Option<Text> {
    let found = || curve.places.iter().filter_map(|place| Some((place, place.facts().intervals?)));
    let (first, _) = found().next()?;
    let count = found().count();
    let (low, high) = found().fold((usize::MAX, 0), |(low, high), (_, n)| (low.min(n), high.max(n)));
    let value = report::number::short(first.parameter(), 6, Language::En);
    let (symbol, unit) = (symbol(machine, &study.name), unit(machine, &study.name));
    let printed = |language| if unit == "1" { String::new() } else { format!(" {}", report::unit::print(&unit, language)) };
    Some(Text::new(
        format!(
            "From {symbol} = {value}{} on whole periods are too sensitive to be followed at once (shooting); points by orthogonal collocation: {count}, meshes of {low} to {high} intervals with five Gauss points.",
            printed(Language::En)
        ),
        format!(
            "Начиная с {symbol} = {}{} движение за целый период слишком чувствительно к начальным условиям (стрельба невозможна); точек, найденных ортогональной коллокацией: {count}, отрезков сетки с пятью узлами Гаусса — от {low} до {high}.",
            value.replace('.', ","),
            printed(Language::Ru)
        ),
    ))
}

/// Parts of a branch that are stable or unstable throughout.
fn pieces(machine: &Machine, which: usize, curve: &Curve) -> Vec<Value> {
    let kind = if curve.of == Of::Rest { equilibrium::KIND.name } else { periodic::KIND.name };
    let parts = curve.places.chunk_by(|a, b| a.facts().stable == b.facts().stable);
    parts
        .map(|part| {
            let points: Vec<Value> = part.iter().map(|place| point(machine, place)).collect();
            json!({"curve": which, "kind": kind, "stable": part[0].facts().stable, "points": points})
        })
        .collect()
}

fn point(machine: &Machine, place: &Place) -> Value {
    let mut fields = state(machine, place);
    fields.insert("parameter".into(), json!(place.parameter()));
    let facts = place.facts();
    fields.insert("stable".into(), json!(facts.stable));
    if let Some(intervals) = facts.intervals {
        fields.insert("collocation".into(), json!({"intervals": intervals, "defect": facts.defect}));
    }
    let numbers: Vec<Value> = facts.multipliers.iter().flatten().map(json_of).collect();
    fields.insert(if facts.period > 0.0 { "multipliers" } else { "roots" }.into(), json!(numbers));
    Value::Object(fields)
}

fn special_to_json(machine: &Machine, diagram: &Diagram, (branch, behind, special): &(usize, usize, Special)) -> Value {
    let mut value = point(machine, &special.place);
    let places = diagram.curves.get(*branch).map(|curve| &curve.places[..]).unwrap_or_default();
    let side = |k: Option<usize>| k.and_then(|k| places.get(k)).and_then(|place| place.facts().stable);
    let sides = [side(behind.checked_sub(1)), side(Some(*behind))];
    if let Some(fields) = value.as_object_mut() {
        // at the point itself a multiplier decides nothing: unstable is what is so on both sides
        let unstable = sides == [Some(false); 2];
        fields.insert("stable".into(), if unstable { json!(false) } else { Value::Null });
        fields.insert("sides".into(), json!(sides));
        fields.insert("kind".into(), json!(special.what.key()));
        fields.insert("curve".into(), json!(branch));
        fields.insert("within".into(), json!(special.within));
    }
    value
}

fn curve_to_json(machine: &Machine, curve: &Curve) -> Value {
    let ends: Vec<Value> =
        curve.ends.iter().map(|end| end.as_ref().map_or(Value::Null, |end| json!(end_in_words(machine, end).en))).collect();
    let periods = if let Of::Orbits(k) = curve.of { json!(k) } else { Value::Null };
    let place = |place: Option<&Place>| place.map_or(Value::Null, |place| point(machine, place));
    let (first, last) = (place(curve.places.first()), place(curve.places.last()));
    json!({
        "points": curve.places.len(),
        "ends": ends,
        "parts_from": curve.parent,
        "periods_of_loads": periods,
        "first": first,
        "last": last,
    })
}

/// A branch in a sentence.
fn about(machine: &Machine, study: &Branched, (which, of): (usize, usize), curve: &Curve) -> Text {
    let short = |x: f64| report::number::short(x, 6, Language::En);
    let values = || curve.places.iter().map(Place::parameter);
    let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
    let (low, high, points) = (short(low), short(high), curve.places.len());
    let unit = unit(machine, &study.name);
    let ends = ends_in_words(machine, &curve.ends);
    let list = |pick: fn(&Text) -> &str| ends.iter().map(pick).collect::<Vec<_>>().join("; ");
    let (en_ends, ru_ends) = (list(|t| &t.en), list(|t| &t.ru));
    let printed = |language| if unit == "1" { String::new() } else { format!(" {}", report::unit::print(&unit, language)) };
    let (printed_en, printed_ru) = (printed(Language::En), printed(Language::Ru));
    let symbol = symbol(machine, &study.name);
    let which = which + 1;
    let (en, ru) =
        if of > 1 { (format!("Branch {which}"), format!("Ветвь {which}")) } else { ("The branch".into(), "Ветвь".into()) };
    Text::new(
        format!("{en}: {symbol} from {low} to {high}{printed_en}, {points} points. Where it ends: {en_ends}."),
        format!(
            "{ru}: {symbol} от {} до {}{printed_ru}, точек: {points}. Где кончается: {ru_ends}.",
            low.replace('.', ","),
            high.replace('.', ",")
        ),
    )
}
