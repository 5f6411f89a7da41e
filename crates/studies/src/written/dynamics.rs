//! Chapter 3: energies, generalized forces by virtual power, Lagrange's equations, the check by a second derivation, equilibrium.

use super::facts::Moves;
use super::kinematics::{definitions, other_definitions};
use super::pen::{Pen, inline, words};
use super::quantity::fitted;
use super::wording::Word;
use super::work::Work;
use crate::connections;
use crate::shown::{Role, role};
use algebra::arrange::Arrange;
use mechanics::model::{Depth, Frame, Inertia};
use report::document::{Inline, Rich};
use report::formula::{Layout, Relation, Sign};
use symbolic::connections::{Law, Reaction, Rebound};
use symbolic::equations::{Equality, Part, Step, StepFormula, StepName};
use symbolic::{Expr, Node};
use words::capital;

/// Derivatives that vanish and are still named one by one.
const FEW: usize = 6;

pub(super) fn write(work: &Work, pen: &mut Pen) {
    if work.is_machine() {
        pen.section(pen.word(Word::Kinetic), |pen| kinetic(work, pen));
        pen.section(pen.word(Word::Potential), |pen| energy(work, Part::Potential, pen));
        pen.section(pen.word(Word::Dissipation), |pen| energy(work, Part::Dissipation, pen));
        pen.section(pen.word(Word::Forces), |pen| forces(work, pen));
        pen.section(pen.word(Word::Lagrange), |pen| lagrange(work, pen));
        super::machine::write(work, pen);
        pen.section(pen.word(Word::Second), |pen| second(work, pen));
    }
    for results in work.results_of(Word::Dynamics) {
        let heading = work.text(&results.heading);
        pen.section(heading, |pen| pen.take(super::sentences::below(work, results), heading));
    }
}

fn step<'a>(work: &Work<'a>, part: Part) -> Option<&'a Step> {
    work.equations.steps.iter().find(|step| step.part == part)
}

impl Work<'_> {
    /// The formula of a step; bodies go by their numbers, springs by a letter.
    pub(super) fn step_formula(&self, formula: &StepFormula) -> Layout {
        let StepName::Quantity { letter, index } = &formula.left else { return self.own.step(&self.equations.graph, formula) };
        let left = StepName::Quantity { letter: letter.clone(), index: self.index_of(letter, index) };
        self.own.step(&self.equations.graph, &StepFormula { left, right: formula.right })
    }

    fn index_of(&self, letter: &str, name: &str) -> String {
        if letter == "Q" || name.is_empty() {
            return name.to_owned();
        }
        let body = self.model.frames.iter().position(|f| f.is_body && f.name == name);
        if let Some(n) = body.and_then(|i| self.number(mechanics::model::FrameId(i))) {
            return n.to_string();
        }
        // springs and dampers may have one name
        let own = if letter == "Φ" { Part::Dissipation } else { Part::Potential };
        let named = || self.model.elements.iter().filter(|e| e.name == name);
        let Some(element) = named().find(|e| super::facts::part_of(role(e.table)) == Some(own)).or_else(|| named().next()) else {
            return name.to_owned();
        };
        let alike: Vec<_> = self.model.elements.iter().filter(|e| e.table == element.table).collect();
        let place = alike.iter().position(|e| e.name == name).map_or(0, |i| i + 1);
        let number = if alike.len() > 1 { place.to_string() } else { String::new() };
        match role(element.table) {
            Role::Spring => format!("{}{number}", self.language.pick("s", "п")),
            Role::Damper | Role::Dissipation => format!("{}{number}", self.language.pick("d", "д")),
            _ => format!("{}{place}", self.language.pick("e", "э")),
        }
    }
}

/// T of each body with the theorem that gives it, then the sum.
fn kinetic(work: &Work, pen: &mut Pen) {
    let Some(step) = step(work, Part::Kinetic) else {
        return total(work, "T", work.equations.energy.kinetic, pen);
    };
    let massless = work.model.frames.iter().any(|f| f.is_body && f.mass.is_none());
    for formula in by_number(work, &step.formulas) {
        let StepName::Quantity { index, .. } = &formula.left else { continue };
        let single = step.formulas.len() == 1;
        let heavy: Vec<&Frame> = work.model.frames.iter().filter(|f| f.is_body && f.mass.is_some()).collect();
        let frame = work.model.frames.iter().find(|f| f.is_body && f.name == *index).or_else(|| match heavy[..] {
            [only] if single => Some(only),
            _ => None,
        });
        match frame {
            Some(frame) => pen.tell(theorem(work, frame)),
            None => pen.say(work.language.pick("The kinetic energy of the system is", "Кинетическая энергия системы")),
        }
        pen.numbered(fitted(&work.printer, work.step_formula(formula)));
    }
    if massless && !step.formulas.is_empty() {
        pen.say(
            work.language
                .pick("Massless bodies have no kinetic energy.", "Тела, массой которых пренебрегаем, кинетической энергии не имеют."),
        );
    }
    let rights: Vec<Expr> = step.formulas.iter().map(|f| f.right).collect();
    definitions(work, &rights, pen);
}

/// Formulas of bodies in the order of their numbers, that of the system behind them.
fn by_number<'f>(work: &Work, formulas: &'f [StepFormula]) -> Vec<&'f StepFormula> {
    let frame = |f: &StepFormula| match &f.left {
        StepName::Quantity { index, .. } => work.model.frames.iter().position(|f| f.is_body && f.name == *index),
        _ => None,
    };
    let place = |f: &StepFormula| frame(f).and_then(|i| work.number(mechanics::model::FrameId(i))).unwrap_or(usize::MAX);
    let mut list: Vec<&StepFormula> = formulas.iter().collect();
    list.arrange_by_key(|f| place(f));
    list
}

/// The sentence before the kinetic energy of a body.
fn theorem(work: &Work, frame: &Frame) -> Vec<Inline> {
    let at = work.model.frames.iter().position(|f| f.name == frame.name).unwrap_or(0);
    let body = capital(&work.body(mechanics::model::FrameId(at)));
    let turned = frame.mass.as_ref().is_some_and(|m| !matches!(m.inertia, Inertia::None));
    let (how, law) = match (work.moves(frame), turned) {
        (Moves::Turns, _) => (work.language.pick("turns about a fixed axis", "вращается вокруг неподвижной оси"), "T = J ω²/2"),
        (Moves::Translates | Moves::Rests, _) => (work.language.pick("translates", "движется поступательно"), "T = m v²/2"),
        (Moves::InPlane, true) => (work.language.pick("moves in the plane", "совершает плоское движение"), "T = m v_C²/2 + J_C ω²/2"),
        (Moves::InPlane, false) => (work.language.pick("is a point mass", "считается материальной точкой"), "T = m v²/2"),
        (Moves::InSpace, true) => {
            (work.language.pick("moves in space", "движется в пространстве"), "T = m v_C²/2 + (J_x ω_x² + J_y ω_y² + J_z ω_z²)/2")
        }
        (Moves::InSpace, false) => (work.language.pick("is a point mass", "считается материальной точкой"), "T = m v²/2"),
    };
    vec![words(format!("{body} {how}, ")), inline(letters(work, law)), words(work.language.pick("; here", "; здесь"))]
}

/// A formula of the textbook in its own letters, made of symbols that the model does not know.
fn letters(work: &Work, law: &str) -> Layout {
    let letter = |name: &str| Layout::Symbol(work.printer.named(name));
    let square = |name: &str| Layout::Power(Box::new(letter(name)), Box::new(Layout::Number { mantissa: "2".into(), exponent: None }));
    // a fraction within a sentence would be small: it stands on the line
    let half = |above: Layout| Layout::Row(vec![above, Layout::Words("/2".into())]);
    let product = |a: &str, b: &str| half(Layout::Product(vec![letter(a), square(b)]));
    let plus = report::formula::Sign::Plus;
    let right = match law {
        "T = J ω²/2" => product("J", "ω"),
        "T = m v²/2" => product("m", "v"),
        "T = m v_C²/2 + J_C ω²/2" => Layout::Sum(vec![(plus, product("m", "v_C")), (plus, product("J_C", "ω"))]),
        _ => {
            let axes = [("J_x", "ω_x"), ("J_y", "ω_y"), ("J_z", "ω_z")].map(|(j, w)| (plus, Layout::Product(vec![letter(j), square(w)])));
            Layout::Sum(vec![
                (plus, product("m", "v_C")),
                (plus, half(Layout::Fence(report::formula::Bracket::Round, Box::new(Layout::Sum(axes.to_vec()))))),
            ])
        }
    };
    Layout::Related(Box::new(letter("T")), Relation::Equal, Box::new(right))
}

/// The terms of Π or Φ, then their sum.
fn energy(work: &Work, part: Part, pen: &mut Pen) {
    let Some(step) = step(work, part) else { return };
    match part {
        Part::Potential => pen.tell(potential(work)),
        _ => pen.tell(set(
            work,
            work.language.pick(
                "The dissipation function of a viscous damper is {b u²/2} with the rate {u} of its elongation or turn:",
                "Диссипативная функция вязкого демпфера равна {b u²/2}, где {u} – скорость его удлинения или закручивания:",
            ),
        )),
    }
    for formula in step.formulas.iter().filter(|f| step.formulas.len() == 1 || !work.equations.graph.is_zero(f.right)) {
        pen.numbered(fitted(&work.printer, work.step_formula(formula)));
    }
    let rights: Vec<Expr> = step.formulas.iter().map(|f| f.right).collect();
    definitions(work, &rights, pen);
}

/// What the potential energy of this machine is made of.
fn potential(work: &Work) -> Vec<Inline> {
    let model = work.model;
    let springs = model.elements.iter().any(|e| role(e.table) == Role::Spring);
    let weight = model.gravity.is_some() && model.frames.iter().any(|f| f.is_body && f.mass.is_some());
    let framed = model.structure.is_some();
    let told = match (weight, springs, framed) {
        (true, true, _) => work.language.pick(
            "The potential energy of gravity is {m g h} with the height {h} of the mass centre, that of a spring {c δ²/2} with its elongation or turn {δ}:",
            "Потенциальная энергия силы тяжести равна {m g h}, где {h} – высота центра масс, пружины – {c δ²/2}, где {δ} – её удлинение или угол закручивания:",
        ),
        (true, false, _) => {
            work.language.pick(
                "The potential energy of gravity is {m g h} with the height {h} of the mass centre:",
                "Потенциальная энергия силы тяжести равна {m g h}, где {h} – высота центра масс:",
            )
        }
        (false, true, _) => work.language.pick(
            "The potential energy of a spring is {c δ²/2} with its elongation or turn {δ}:",
            "Потенциальная энергия пружины равна {c δ²/2}, где {δ} – её удлинение или угол закручивания:",
        ),
        (false, false, true) => work.language.pick(
            "The potential energy is that of the deformation of the rods, a quadratic form of the displacements:",
            "Потенциальная энергия – энергия деформации стержней, квадратичная форма перемещений:",
        ),
        (false, false, false) => work.language.pick("The potential energy is", "Потенциальная энергия"),
    };
    set(work, told)
}

/// Words with the textbook's formulas among them: products of letters, a square, a half; each in braces.
fn set(work: &Work, told: &str) -> Vec<Inline> {
    let letter = |name: &str| match name.strip_suffix('²') {
        Some(base) => {
            let two = Layout::Number { mantissa: "2".into(), exponent: None };
            Layout::Power(Box::new(Layout::Symbol(work.printer.named(base))), Box::new(two))
        }
        None => Layout::Symbol(work.printer.named(name)),
    };
    let formula = |text: &str| {
        let (above, half) = text.strip_suffix("/2").map_or((text, false), |above| (above, true));
        let mut factors: Vec<Layout> = above.split(' ').map(letter).collect();
        let product = if factors.len() == 1 { factors.remove(0) } else { Layout::Product(factors) };
        // a fraction within a sentence would be small: it stands on the line
        inline(if half { Layout::Row(vec![product, Layout::Words("/2".into())]) } else { product })
    };
    let pieces = told.split(['{', '}']).enumerate();
    pieces.filter(|(_, text)| !text.is_empty()).map(|(i, text)| if i % 2 == 1 { formula(text) } else { words(text) }).collect()
}

fn total(work: &Work, letter: &str, energy: Expr, pen: &mut Pen) {
    if work.equations.textbook.is_err() {
        return;
    }
    let left = StepName::Quantity { letter: letter.into(), index: String::new() };
    pen.numbered(work.printer.block(work.printer.step(&work.equations.graph, &StepFormula { left, right: energy })));
}

/// Q of loads without a potential, from the virtual power of each.
fn forces(work: &Work, pen: &mut Pen) {
    let Some(step) = step(work, Part::Forces) else { return };
    let mut graph = work.equations.graph.clone();
    pen.say(work.language.pick(
        "Every load does its power on a possible motion; the factor of each rate in it is the generalized force.",
        "Мощность каждой нагрузки на возможном движении линейна относительно обобщённых скоростей; коэффициент при скорости есть обобщённая сила.",
    ));
    for load in work.equations.applied.iter().filter(|load| !load.forces.is_empty()) {
        let terms: Vec<Expr> = load
            .forces
            .iter()
            .map(|(i, q)| {
                let rate = graph.symbol(work.equations.coordinates[*i].symbols[1]);
                graph.mul(*q, rate)
            })
            .collect();
        let power = graph.sum(&terms);
        if !matches!(graph.node(power), Node::Number(_)) {
            let what = work.language.pick("Power of the load", "Мощность нагрузки");
            let name = work.load_name(&load.path);
            pen.say(work.language.pick(format!("{what} “{name}”:"), format!("{what} «{name}»:")));
            let left = Layout::Symbol(work.printer.named(&work.power_of(&load.path)));
            let right = work.readable(&graph, power);
            pen.formula(work.printer.block(Layout::Related(Box::new(left), Relation::Equal, Box::new(right))));
        }
    }
    pen.say(work.language.pick("Hence", "Отсюда"));
    for formula in &step.formulas {
        let layout = work.settled(|printer| printer.step(&graph, formula));
        pen.numbered(fitted(&work.printer, layout));
    }
    let rights: Vec<Expr> = step.formulas.iter().map(|f| f.right).collect();
    definitions(work, &rights, pen);
}

/// The derivatives, the reactions, the equations.
fn lagrange(work: &Work, pen: &mut Pen) {
    let Ok(textbook) = &work.equations.textbook else {
        if let Err(reason) = &work.equations.textbook {
            pen.say(work.text(reason));
        }
        return;
    };
    if let Some(step) = step(work, Part::Derivatives) {
        law(work, step, pen);
        if work.model.report.depth == Depth::Full {
            derivatives(work, step, pen);
        }
    }
    reacting(work, pen);
    if textbook.is_empty() {
        return;
    }
    pen.say(work.language.pick("Equations of motion:", "Уравнения движения:"));
    for (i, equality) in textbook.iter().enumerate() {
        let layout = work.settled(|printer| printer.equality_layout(&work.equations.graph, *equality, Some(i)));
        pen.numbered(fitted(&work.printer, layout));
    }
    reactions(work, textbook, pen);
    let laws = crate::frictions::laws(work.equations, &work.printer);
    if !laws.is_empty() {
        pen.say(crate::wording::say(work.language, crate::wording::Word::FrictionLaws));
        laws.into_iter().for_each(|layout| pen.formula(work.printer.block(layout)));
    }
    impacts(work, pen);
    other_definitions(work, pen);
}

/// d/dt ∂T/∂q' − ∂T/∂q = −∂Π/∂q − ∂Φ/∂q' + Q + R with the terms that the machine has, for its coordinate or for the i-th of several.
fn law(work: &Work, step: &Step, pen: &mut Pen) {
    let mut graph = work.equations.graph.clone();
    let one = if let [only] = &work.equations.coordinates[..] { Some(only.symbols) } else { None };
    let [q, rate] = [0, 1].map(|k: u8| {
        let symbol = one.map_or_else(|| graph.symbol_id("q_i", k), |symbols| symbols[usize::from(k)]);
        graph.symbol(symbol)
    });
    let index = if one.is_some() { "" } else { "i" };
    let partial = |of: &str, by| work.printer.step_name(&graph, &StepName::Partial { of: of.into(), by });
    let force = |letter: &str| {
        let name = if index.is_empty() { letter.to_owned() } else { format!("{letter}_{index}") };
        Layout::Symbol(work.printer.named(&name))
    };
    let momentum = work.printer.step_name(&graph, &StepName::TimeDerivativeOfPartial { of: "T".into(), by: rate });
    let has = |term: &str| step.words.en.contains(term);
    let terms = [
        (has("∂Π"), Sign::Minus, partial("Π", q)),
        (has("∂Φ"), Sign::Minus, partial("Φ", rate)),
        (has("+ Q") || has("= Q"), Sign::Plus, force("Q")),
        (has("+ R") || has("= R"), Sign::Plus, force("R")),
    ];
    let right: Vec<(Sign, Layout)> = terms.into_iter().filter(|t| t.0).map(|(_, sign, term)| (sign, term)).collect();
    let right = if right.is_empty() { Layout::Number { mantissa: "0".into(), exponent: None } } else { Layout::Sum(right) };
    let left = Layout::Sum(vec![(Sign::Plus, momentum), (Sign::Minus, partial("T", q))]);
    pen.say(work.language.pick("Lagrange's equations of the second kind are", "Уравнения Лагранжа второго рода имеют вид"));
    pen.formula(work.printer.block(Layout::Related(Box::new(left), Relation::Equal, Box::new(right))));
    let forces = match index {
        "" => work.language.pick("the generalized force", "обобщённая сила"),
        _ => work.language.pick("the generalized forces", "обобщённые силы"),
    };
    let loaded = (has("+ Q") || has("= Q")).then(|| ("Q", work.language.pick("of the loads", "нагрузок")));
    let reacting =
        (has("+ R") || has("= R")).then(|| ("R", work.language.pick("of the reactions and drives", "реакций связей и приводов")));
    let named: Vec<(&str, &str)> = loaded.into_iter().chain(reacting).collect();
    for (i, (letter, meaning)) in named.iter().enumerate() {
        let lead = if i == 0 { format!("{} ", pen.word(Word::Where)) } else { String::new() };
        let end = if i + 1 == named.len() { "." } else { ";" };
        pen.tell(vec![words(lead), inline(force(letter)), words(format!(" – {forces} {meaning}{end}"))]);
    }
    if work.model.report.depth == Depth::Full {
        pen.say(work.language.pick("The derivatives in them are:", "Входящие в них производные:"));
    }
}

/// Derivatives that do not vanish, each on a line; the others in one.
fn derivatives(work: &Work, step: &Step, pen: &mut Pen) {
    let graph = &work.equations.graph;
    let (zero, other): (Vec<_>, Vec<_>) = step.formulas.iter().partition(|f| graph.is_zero(f.right));
    for formula in other {
        pen.formula(fitted(&work.printer, work.own.step(graph, formula)));
    }
    if zero.is_empty() {
        return;
    }
    if zero.len() > FEW {
        pen.say(work.language.pick("All other derivatives are zero.", "Все остальные производные равны нулю."));
        return;
    }
    let mut pieces = vec![words(work.language.pick("The other derivatives vanish: ", "Остальные производные равны нулю: "))];
    for (i, formula) in zero.iter().enumerate() {
        pieces.push(words(if i == 0 { "" } else { ", " }));
        pieces.push(inline(work.printer.step_name(graph, &formula.left)));
    }
    pieces.push(words("."));
    pen.tell(pieces);
}

/// R of every coordinate: Σ λ ∂(condition)/∂q.
fn reacting(work: &Work, pen: &mut Pen) {
    let mut graph = work.equations.graph.clone();
    let n = work.equations.coordinates.len();
    let mut sums: Vec<Vec<Expr>> = vec![Vec::new(); n];
    for reaction in &work.equations.reactions {
        let symbol = graph.symbol(reaction.symbol);
        for (i, factor) in &reaction.forces {
            let term = graph.mul(symbol, *factor);
            sums[*i].push(term);
        }
    }
    if sums.iter().all(Vec::is_empty) {
        return;
    }
    pen.say(work.language.pick("Generalized forces of the reactions and drives:", "Обобщённые силы реакций и приводов:"));
    for (terms, coordinate) in sums.iter().zip(&work.equations.coordinates).filter(|(terms, _)| !terms.is_empty()) {
        let right = graph.sum(terms);
        let index = graph.symbol_info(coordinate.symbols[0]).name.clone();
        let left = StepName::Quantity { letter: "R".into(), index };
        pen.formula(work.printer.block(work.own.step(&graph, &StepFormula { left, right })));
    }
}

/// The law of every impact.
fn impacts(work: &Work, pen: &mut Pen) {
    for (at, connection) in work.model.connections.iter().enumerate() {
        let Some((rebound, restitution)) = connections::of(connection).impact() else { continue };
        let name = work.connection_name(at);
        let law = match rebound {
            Rebound::Newton => work.language.pick(
                format!("Impact ({name}): the speed of approach u changes to u⁺ = −k u⁻ with the coefficient of restitution k = "),
                format!("Удар ({name}): скорость сближения u меняется по закону u⁺ = −k u⁻ с коэффициентом восстановления k = "),
            ),
            Rebound::Poisson => work.language.pick(
                format!("Impact ({name}): the impulse of the second phase is k times that of the first, k = "),
                format!("Удар ({name}): импульс второй фазы удара в k раз больше импульса первой, k = "),
            ),
        };
        pen.tell(vec![words(law), inline(work.printer.layout(&work.model.graph, restitution)), words(".")]);
    }
}

/// What the letters of reactions mean, each on a line.
fn reactions(work: &Work, textbook: &[Equality], pen: &mut Pen) {
    let graph = &work.equations.graph;
    let sides: Vec<Expr> = textbook.iter().flat_map(|e| [e.left, e.right]).collect();
    let occurring = graph.symbols_in(&sides);
    // the laws of friction name normal forces too
    let pressing: Vec<usize> = (work.equations.reactions.iter())
        .filter_map(|r| if let Law::Friction(friction) = &r.law { Some(friction) } else { None })
        .flat_map(|friction| friction.components().flat_map(|normal| normal.terms.iter().map(|(k, _)| *k)).collect::<Vec<_>>())
        .collect();
    let listed = work.equations.reactions.iter().enumerate();
    let named: Vec<_> =
        listed.filter(|(k, r)| occurring.binary_search(&r.symbol).is_ok() || pressing.contains(k)).map(|(_, r)| r).collect();
    for (i, reaction) in named.iter().enumerate() {
        let lead = if i == 0 { format!("{} ", pen.word(Word::Where)) } else { String::new() };
        let end = if i + 1 == named.len() { "." } else { ";" };
        pen.tell(vec![
            words(lead),
            inline(work.printer.symbol_layout(graph, reaction.symbol)),
            words(format!(" – {}{end}", in_words(work, reaction))),
        ]);
    }
}

/// "component of the reaction (pin B, along x)"; a label that says what it is stays.
fn in_words(work: &Work, reaction: &Reaction) -> String {
    const TOLD: [&str; 14] = [
        "tension",
        "force",
        "friction",
        "moment",
        "difference",
        "constraint",
        "reaction",
        "натяжение",
        "усилие",
        "сила",
        "трение",
        "момент",
        "разность",
        "реакция",
    ];
    let label = work.text(&reaction.label);
    if matches!(reaction.law, Law::Motor | Law::Friction(_)) || TOLD.iter().any(|word| label.contains(word)) {
        return label.to_owned();
    }
    work.language.pick(format!("component of the reaction ({label})"), format!("составляющая реакции ({label})"))
}

/// The two derivations against one another.
fn second(work: &Work, pen: &mut Pen) {
    let audits = work.calculation.audits();
    let Some(audit) = audits.iter().find(|a| a.key == "two_derivations") else { return };
    let number = |x| report::number::short(x, 2, work.language);
    let (value, limit) = (number(audit.value), number(audit.limit));
    let exact = audit.value == 0.0;
    let sentence = match (audit.ok, work.language) {
        (true, words::Language::En) if exact => "The equations were derived once more from the laws of Newton and Euler for every body, projected on the possible motions. At random states the two derivations agree to the last digit.".to_owned(),
        (true, words::Language::Ru) if exact => "Уравнения выведены повторно, из теорем о движении центра масс и об изменении кинетического момента каждого тела (уравнения Ньютона – Эйлера), спроецированных на возможные движения. В случайно выбранных состояниях два вывода совпадают до последней цифры.".to_owned(),
        (true, words::Language::En) => format!(
            "The equations were derived once more from the laws of Newton and Euler for every body, projected on the possible motions. At random states the two derivations differ by at most {value} of the largest term (limit {limit}): they agree."
        ),
        (false, words::Language::En) => format!(
            "The equations were derived once more from the laws of Newton and Euler for every body. At random states the two derivations differ by {value} of the largest term (limit {limit}): they do not agree."
        ),
        (true, words::Language::Ru) => format!(
            "Уравнения выведены повторно, из теорем о движении центра масс и об изменении кинетического момента каждого тела (уравнения Ньютона – Эйлера), спроецированных на возможные движения. В случайно выбранных состояниях два вывода расходятся не более чем на {value} наибольшего слагаемого (допуск {limit}): уравнения совпадают."
        ),
        (false, words::Language::Ru) => format!(
            "Уравнения выведены повторно, из уравнений Ньютона – Эйлера каждого тела. В случайно выбранных состояниях два вывода расходятся на {value} наибольшего слагаемого (допуск {limit}): уравнения не совпадают."
        ),
    };
    pen.say(Rich(vec![words(sentence)]));
}
