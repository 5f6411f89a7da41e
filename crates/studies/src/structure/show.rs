//! Studies of structures as tables and sentences.

use super::modes::Found as ModesFound;
use super::statics::Found as StaticsFound;
use super::terms::{equation, number};
use crate::results::View;
use crate::small::show::plain_table;
use analysis::studies::structure_statics::Flexibility;
use report::document::Rich;
use report::table::Column;
use report::{Block, Cell, Table};
use structures::reduced::Reduced;
use structures::{Frame, Scalar};
use words::Language;

/// Longest fraction that a reader takes in; longer ones are shown as decimals.
const READABLE: usize = 13;

/// Everything about natural oscillations.
pub fn modes(found: &ModesFound, view: &View) -> Vec<Block> {
    let language = view.language;
    let r = &found.result;
    let mut blocks = Vec::new();
    if let Some(reduced) = &r.reduced {
        blocks.extend(matrices(reduced, found.result.exact.as_ref(), language));
    }
    blocks.push(Block::Table(plain_table(&r.dataset.columns, language)));
    blocks.push(Block::paragraph(crate::small::show::legend(&r.dataset.columns, language)));
    if let Some(equation) = &found.equation {
        let of = language.pick("Frequency equation", "Частотное уравнение");
        let words = format!("{of}: {}", crate::small::show::polynomial(equation, language));
        blocks.push(crate::small::show::with_meaning(words, found.meaning.as_ref(), view));
    }
    blocks.extend(reductions(found, language));
    blocks.extend(levels(found, language));
    if view.is_page() {
        blocks.extend(super::drawing::modes(found, language).into_iter().map(Block::Figure));
    }
    blocks
}

/// Rods as one degree of freedom.
fn reductions(found: &ModesFound, language: Language) -> Vec<Block> {
    if found.rayleigh.is_empty() {
        return Vec::new();
    }
    let mut table = Table::new(vec![
        Column::new(language.pick("Assumed shape (Rayleigh)", "Принятая форма (Рэлей)")),
        Column::with_unit(Rich::symbol("m_r"), "kg", language),
        Column::new(language.pick("share of the rod", "доля массы стержня")),
        Column::with_unit(Rich::symbol("c_r"), "N/m", language),
        Column::with_unit(Rich::symbol("ω"), "rad/s", language),
    ]);
    for r in &found.rayleigh {
        let label = language.text(&r.label);
        let foreign = language == Language::Ru && crate::naming::is_word(&r.name);
        let name = match label.is_empty() {
            true => r.name.clone(),
            false if foreign => label.to_owned(),
            false => format!("{}: {label}", r.name),
        };
        let mut row = vec![Cell::words(name)];
        row.extend([r.mass, r.share, r.stiffness, r.omega].map(|v| Cell::Number(number(v, language))));
        table.row(row);
    }
    vec![Block::Table(table)]
}

/// The frame at all levels of simplification, with differences from the last.
fn levels(found: &ModesFound, language: Language) -> Vec<Block> {
    let Some(last) = found.levels.last() else { return Vec::new() };
    let mut heads = vec![Column::new(language.pick("Assumed", "Принято"))];
    for i in 0..last.omega.len() {
        heads.push(Column::with_unit(Rich::symbol(format!("ω_{}", i + 1)), "rad/s", language));
        heads.push(Column::with_unit(Rich::symbol(format!("Δ_{}", i + 1)), "%", language));
    }
    let mut table = Table::new(heads);
    for level in &found.levels {
        let mut row = vec![Cell::words(language.text(&level.words))];
        for (omega, exact) in level.omega.iter().zip(&last.omega) {
            let percent = report::number::short(100.0 * (omega / exact - 1.0), 3, language);
            row.extend([Cell::Number(report::number::short(*omega, 9, language)), Cell::Number(percent)]);
        }
        table.row(row);
    }
    vec![Block::Table(table)]
}

/// M, K, D over the coordinates: exact fractions where there are any.
fn matrices(reduced: &Reduced<f64>, exact: Option<&Reduced<symbolic::Rational>>, language: Language) -> Vec<Block> {
    let n = reduced.n();
    if n > 6 {
        return Vec::new();
    }
    let rows = |name: &str, words: (&str, &str), machine: &[f64], exact: Option<&[symbolic::Rational]>| {
        let mut heads = vec![Column::new(Rich::from(format!("{name}: {}", language.pick(words.0, words.1))))];
        heads.extend(reduced.coordinates.iter().map(|q| Column::new(Rich::symbol(q.symbol.clone()))));
        let mut table = Table::new(heads);
        for i in 0..n {
            let mut row = vec![Cell::symbol(reduced.coordinates[i].symbol.clone())];
            row.extend((0..n).map(|j| match exact {
                Some(list) if fraction(&list[i * n + j]).chars().count() <= READABLE => Cell::words(fraction(&list[i * n + j])),
                _ => Cell::Number(number(machine[i * n + j], language)),
            }));
            table.row(row);
        }
        Block::Table(table)
    };
    vec![
        rows("M", ("masses", "матрица масс"), &reduced.mass, exact.map(|e| &e.mass[..])),
        rows("K", ("stiffnesses", "матрица жёсткости"), &reduced.stiffness, exact.map(|e| &e.stiffness[..])),
        rows("D", ("flexibilities", "матрица податливости"), &reduced.flexibility, exact.map(|e| &e.flexibility[..])),
    ]
}

/// An exact number with a true minus.
fn fraction(v: &symbolic::Rational) -> String {
    v.to_string().replace('-', "−")
}

/// Everything about statics.
pub fn statics(found: &StaticsFound, view: &View) -> Vec<Block> {
    let language = view.language;
    let r = &found.result;
    let standing = &r.standing;
    let words = language.pick(
        format!(
            "{} unknown forces, {} equations of equilibrium: statically {}",
            standing.unknowns,
            standing.equations,
            if standing.degree() == 0 { "determinate".to_owned() } else { format!("indeterminate, degree {}", standing.degree()) }
        ),
        format!(
            "Неизвестных усилий {}, уравнений равновесия {}: конструкция {}",
            standing.unknowns,
            standing.equations,
            if standing.degree() == 0 {
                "статически определима".to_owned()
            } else {
                format!("статически неопределима, степень {}", standing.degree())
            }
        ),
    );
    let mut blocks = vec![Block::paragraph(words + "."), Block::Table(reactions(found, language)), Block::Table(rods(found, language))];
    if !r.displacements.is_empty() {
        blocks.push(Block::Table(displacements(found, language)));
    }
    blocks.extend(nodes(found, language).map(Block::Table));
    blocks.extend(joints(found, language));
    blocks.extend(sections(found, language));
    let names: Vec<String> = r.frame.displacements.iter().map(|d| d.symbol.clone()).collect();
    let rods: Vec<String> = r.frame.rods.iter().map(|rod| rod.name.clone()).collect();
    if let Some(f) = &r.exact_flexibility {
        blocks.extend(flexibility(f, &names, [&rods, &springs(&r.frame, &f.springs, language)], &fraction, language));
    } else if let Some(f) = &r.flexibility {
        blocks.extend(flexibility(f, &names, [&rods, &springs(&r.frame, &f.springs, language)], &|v| number(*v, language), language));
    }
    if view.is_page() {
        blocks.extend(super::drawing::statics(found, language).into_iter().map(Block::Figure));
    }
    blocks
}

/// Reactions of supports and springs, the sum of the loads, and the sum of all, which is zero; its moments about the origin.
fn reactions(found: &StaticsFound, language: Language) -> Table {
    let r = &found.result;
    let mut table = Table::new(vec![
        Column::new(language.pick("Support", "Опора")),
        Column::with_unit(Rich::symbol("R_x"), "N", language),
        Column::with_unit(Rich::symbol("R_y"), "N", language),
        Column::with_unit(Rich::symbol("M"), "N m", language),
    ]);
    let sizes = r.balance.sizes;
    let show = |k: usize, v: f64| Cell::Number(number(settled(v, sizes[k]), language));
    for (support, f) in r.frame.supports.iter().zip(&r.statics.reactions) {
        let [c, s] = support.axis;
        let value = |held: bool, k: usize, v: f64| if held { show(k, v) } else { Cell::words("–") };
        let straight = s == 0.0;
        table.row(vec![
            Cell::words(format!("{} ({})", support.name, r.frame.nodes[support.node].name)),
            value(support.holds[0] || !straight && support.holds[1], 0, c * f[0] - s * f[1]),
            value(support.holds[1] || !straight && support.holds[0], 1, s * f[0] + c * f[1]),
            value(support.holds[2], 2, f[2]),
        ]);
    }
    let sprung = r.frame.nodes.iter().zip(&r.statics.springs).filter(|(n, _)| n.springs.iter().any(|s| *s != 0.0));
    for (node, force) in sprung {
        let cell = |k: usize| if node.springs[k] != 0.0 { show(k, force[k]) } else { Cell::words("–") };
        let name = language.pick(format!("spring ({})", node.name), format!("пружина ({})", node.name));
        table.row(vec![Cell::words(name), cell(0), cell(1), cell(2)]);
    }
    let row = |name: &str, sums: [f64; 3]| {
        let mut cells = vec![Cell::words(name)];
        cells.extend((0..3).map(|k| show(k, sums[k])));
        cells
    };
    table.row(row(
        language.pick("all supports and springs; M about (0, 0)", "все опоры и пружины; M относительно (0, 0)"),
        r.balance.reactions,
    ));
    table.row(row(language.pick("all loads; M about (0, 0)", "все нагрузки; M относительно (0, 0)"), r.balance.loads));
    let total = [0, 1, 2].map(|k| r.balance.reactions[k] + r.balance.loads[k]);
    table.row(row(language.pick("sum", "сумма"), total));
    table
}

/// Zero where only rounding of the terms is left.
fn settled(v: f64, size: f64) -> f64 {
    // a frame of some hundred rods is solved to thirteen digits
    if v.abs() <= 1e-12 * size { 0.0 } else { v }
}

/// Frames with more nodes show no table of displacements.
const NODES: usize = 60;

/// Displacements of all nodes.
fn nodes(found: &StaticsFound, language: Language) -> Option<Table> {
    let r = &found.result;
    let x = &r.statics.freedoms;
    if r.frame.nodes.len() > NODES || x.iter().all(|v| *v == 0.0) {
        return None;
    }
    let largest = |k: usize| (0..r.frame.nodes.len()).map(|i| x[3 * i + k].abs()).fold(0.0, f64::max);
    let sizes = [largest(0).max(largest(1)), largest(0).max(largest(1)), largest(2)];
    let mut table = Table::new(vec![
        Column::new(language.pick("Node", "Узел")),
        Column::with_unit(Rich::symbol("u_x"), "m", language),
        Column::with_unit(Rich::symbol("u_y"), "m", language),
        Column::with_unit(Rich::symbol("phi"), "rad", language),
    ]);
    for (i, node) in r.frame.nodes.iter().enumerate() {
        let mut row = vec![Cell::words(node.name.clone())];
        let cell = |k: usize| match r.assembly.freedoms.used[3 * i + k] {
            true => Cell::Number(number(settled(x[3 * i + k], sizes[k]), language)),
            false => Cell::words("–"),
        };
        row.extend((0..3).map(cell));
        table.row(row);
    }
    Some(table)
}

fn rods(found: &StaticsFound, language: Language) -> Table {
    let r = &found.result;
    // bars bend under their own weight only
    let straight = |d: &Vec<structures::statics::Station<f64>>| d.iter().all(|s| s.moment == 0.0);
    let bars = r.frame.rods.iter().all(|rod| rod.is_bar()) && r.diagrams.iter().all(straight);
    let mut heads = vec![Column::new(language.pick("Rod", "Стержень")), Column::with_unit(Rich::symbol("N"), "N", language)];
    if !bars {
        heads.extend(
            language
                .pick(["V_max", "M_start", "M_end", "M_max"], ["Q_max", "M_нач", "M_кон", "M_max"])
                .iter()
                .zip(["N", "N m", "N m", "N m"])
                .map(|(s, u)| Column::with_unit(Rich::symbol(*s), u, language)),
        );
    }
    let mut table = Table::new(heads);
    let size =
        |value: fn(&structures::statics::Station<f64>) -> f64| r.diagrams.iter().flatten().map(|s| value(s).abs()).fold(0.0, f64::max);
    let sizes = [size(|s| s.normal), size(|s| s.shear), size(|s| s.moment)];
    for (rod, d) in r.frame.rods.iter().zip(&r.diagrams) {
        let (Some(first), Some(last)) = (d.first(), d.last()) else { continue };
        let largest = |v: Vec<f64>| v.into_iter().fold(0.0_f64, |m, x| if x.abs() > m.abs() { x } else { m });
        let show = |v: f64, size: f64| Cell::Number(number(settled(v, size), language));
        let [normal, shear, moment] = sizes;
        let mut row = vec![Cell::words(rod.name.clone()), show(largest(d.iter().map(|s| s.normal).collect()), normal.max(shear))];
        if !bars {
            row.push(show(largest(d.iter().map(|s| s.shear).collect()), shear.max(normal)));
            row.extend([first.moment, last.moment].map(|m| show(m, moment)));
            row.push(show(largest(d.iter().map(|s| s.moment).collect()), moment));
        }
        table.row(row);
    }
    table
}

fn displacements(found: &StaticsFound, language: Language) -> Table {
    let r = &found.result;
    let mut table = Table::new(vec![
        Column::new(language.pick("Displacement", "Перемещение")),
        Column::new(language.pick("Value, SI", "Значение, СИ")),
        Column::new(""),
    ]);
    for (d, v) in r.frame.displacements.iter().zip(&r.displacements) {
        table.row(vec![Cell::symbol(d.symbol.clone()), Cell::Number(number(*v, language)), Cell::words(language.text(&d.label))]);
    }
    table
}

fn joints(found: &StaticsFound, language: Language) -> Vec<Block> {
    let r = &found.result;
    if r.joints.is_empty() {
        return Vec::new();
    }
    let mut blocks = vec![Block::heading(3, language.pick("Method of joints", "Метод вырезания узлов"))];
    for joint in &r.joints {
        let name = &r.frame.nodes[joint.node].name;
        let found: Vec<String> =
            joint.found.iter().map(|(i, v)| format!("S_{} = {}", r.frame.rods[*i].name, number(*v, language))).collect();
        let found = if found.is_empty() { language.pick("check", "проверка").to_owned() } else { found.join(", ") };
        let [x, y] = [0, 1].map(|k| equation(&joint.equations[k], language));
        blocks.push(Block::paragraph(format!("{} {name}: Σx: {x}; Σy: {y}  ⇒  {found}", language.pick("Joint", "Узел"))));
    }
    blocks
}

fn sections(found: &StaticsFound, language: Language) -> Vec<Block> {
    let r = &found.result;
    if r.sections.is_empty() {
        return Vec::new();
    }
    let mut blocks = vec![Block::heading(3, language.pick("Method of sections", "Метод сечений"))];
    for section in &r.sections {
        let names: Vec<&str> = section.cut.iter().map(|i| r.frame.rods[*i].name.as_str()).collect();
        let about = match section.about {
            Some([x, y]) => {
                let node = r
                    .frame
                    .nodes
                    .iter()
                    // places computed along rods are rounded
                    .find(|n| algebra::elementary::hypot(n.at[0] - x, n.at[1] - y) < 1e-9 * (1.0 + algebra::elementary::hypot(x, y)));
                let place = node.map_or_else(|| format!("({}, {})", number(x, language), number(y, language)), |n| n.name.clone());
                language.pick(format!("moments about {place}"), format!("моменты относительно {place}"))
            }
            None => language.pick(format!("projection across {}", names[1]), format!("проекции на нормаль к {}", names[1])),
        };
        let cut = language.pick("Cut", "Сечение");
        let written = equation(&section.equation, language);
        blocks.push(Block::paragraph(format!(
            "{cut} {}: {about}: {written}  ⇒  S_{} = {}",
            names.join(", "),
            names[0],
            number(section.value, language)
        )));
    }
    blocks
}

/// Names of springs at nodes.
fn springs(frame: &Frame<f64>, springs: &[(usize, usize)], language: Language) -> Vec<String> {
    let word = language.pick("spring", "пружина");
    let along = ["x", "y", language.pick("turn", "поворот")];
    springs.iter().map(|(i, k)| format!("{word} {}, {}", frame.nodes[*i].name, along[*k])).collect()
}

/// Diagrams of unit forces and their products.
fn flexibility<S: Scalar>(
    f: &Flexibility<S>,
    names: &[String],
    [rods, springs]: [&[String]; 2],
    show: &dyn Fn(&S) -> String,
    language: Language,
) -> Vec<Block> {
    let mut blocks = vec![Block::heading(3, language.pick("Flexibility by unit forces", "Податливость по единичным силам"))];
    let mut heads = vec![Column::new(language.pick("Moments of the unit force along", "Моменты от единичной силы вдоль"))];
    heads.extend(rods.iter().map(|r| Column::new(r.as_str())));
    let mut table = Table::new(heads);
    for (name, diagrams) in names.iter().zip(&f.diagrams) {
        let mut row = vec![Cell::symbol(name.clone())];
        for d in diagrams {
            let ends = d.iter().map(|s| show(&s.moment)).collect::<Vec<_>>();
            let mut ends = ends.into_iter().fold(Vec::<String>::new(), |mut list, e| {
                if list.last() != Some(&e) || list.len() == 1 {
                    list.push(e);
                }
                list
            });
            ends.dedup_by(|a, b| a == b && a == "0");
            row.push(Cell::words(if ends.is_empty() { "0".into() } else { ends.join(" … ") }));
        }
        table.row(row);
    }
    blocks.push(Block::Table(table));
    let mut heads = vec![Column::new("D")];
    heads.extend(rods.iter().chain(springs).map(|r| Column::new(r.as_str())));
    heads.push(Column::new("Σ"));
    let mut table = Table::new(heads);
    let n = names.len();
    for i in 0..n {
        for j in i..n {
            let mut row = vec![Cell::words(format!("{} · {}", names[i], names[j]))];
            row.extend(f.products[i][j].iter().map(|p| Cell::words(show(p))));
            row.push(Cell::words(show(&f.matrix[i * n + j])));
            table.row(row);
        }
    }
    blocks.push(Block::Table(table));
    blocks
}
