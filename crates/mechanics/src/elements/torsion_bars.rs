//! Torsion bars: Π = k θ²/2 with the twist θ = φ₂ − φ₁ − rest, Φ = b θ'²/2; the torque M = k θ + b θ' turns the first body forwards and the second backwards.
//!
//! Saint-Venant's torsion of a round bar: k = G J/L, J = π (D⁴ − d⁴)/32; the largest shear stress, on the surface, is M/W with W = 2 J/D. The bar has no inertia.

use super::common::useful;
use super::row::{Made, Row, Stands};
use crate::formula::{Context, Depends, Kind, KinematicFunction, Takes, Told, Where};
use crate::keys::{LABEL, TableSpec, Type, may, must};
use crate::model::{Found, FrameId, Law, Pathway, Push, Reliance, Rest, Site, Sketch, Stage, Straight};
use crate::reader::names::{frame_by_name, two_names};
use crate::reader::{Fields, Reader};
use crate::units::Dimension;
use std::sync::Arc;
use symbolic::{Expr, Rational};
use words::Notice;
use words::explain::{Explanation, row};

/// Force per area.
const STRESS: Dimension = Dimension::of(-1, 1, -2);

/// `[torsion_bars]`.
pub(super) const ROW: Row = Row {
    keys: &KEYS,
    listed: ("torsion bars", "торсионы"),
    chapter: "torsion-bars",
    stands: Stands::Between,
    functions: &[
        KinematicFunction {
            name: "twist",
            takes: Takes::Element,
            dimension: None,
            depends: Depends::POSITION,
            allowed: Where::Outputs,
            en: "twist of a torsion bar: its angle less that without torque",
            ru: "угол закручивания торсиона, отсчитанный от ненагруженного состояния",
        },
        KinematicFunction {
            name: "stress",
            takes: Takes::Element,
            dimension: None,
            depends: Depends::MOTION,
            allowed: Where::Outputs,
            en: "largest shear stress of a torsion bar of given diameter, with the sign of its torque",
            ru: "наибольшее касательное напряжение в торсионе заданного диаметра, со знаком момента",
        },
    ],
    explanations: EXPLANATIONS,
    read,
};

/// `[torsion_bars.NAME]`.
const KEYS: TableSpec = TableSpec {
    name: "torsion_bars",
    about: (
        "Torsion bars: torque = stiffness*twist + damping*rate of the twist, against the growing angle of the second body from the first. Stiffness as it is, or of a round bar: shear_modulus*pi*(diameter^4 - inner_diameter^4)/(32*length). `torque`, `twist` and, with a diameter, `stress` tell of it in outputs.",
        "Торсионы: момент = stiffness*угол закручивания + damping*его скорость, препятствует росту угла второго тела относительно первого. Жёсткость задаётся сама или размерами круглого стержня: shear_modulus*pi*(diameter^4 - inner_diameter^4)/(32*length). В результатах доступны `torque`, `twist`, а при заданном диаметре и `stress`.",
    ),
    short: None,
    fields: &[
        must(
            "between",
            Type::TwoNames,
            "",
            ("two bodies that turn about one axis, or one and `ground`", "два тела с общей осью вращения либо тело и `ground`"),
            "[\"motor\", \"fan\"]",
        ),
        may(
            "stiffness",
            Type::Formula,
            "N m",
            "",
            ("torque per radian of twist, instead of modulus and length", "момент на радиан закручивания, вместо модуля и длины"),
            "\"12 kN m/rad\"",
        ),
        may("shear_modulus", Type::Formula, "Pa", "", ("shear modulus G", "модуль сдвига G"), "\"80 GPa\""),
        may("length", Type::Formula, "m", "", ("length of the bar", "длина стержня"), "\"1.2 m\""),
        may(
            "diameter",
            Type::Formula,
            "m",
            "",
            ("outer diameter; beside `stiffness`, for the stress only", "наружный диаметр; при `stiffness` нужен лишь для напряжения"),
            "\"40 mm\"",
        ),
        may("inner_diameter", Type::Formula, "m", "0", ("diameter of the bore", "диаметр отверстия"), "\"24 mm\""),
        may(
            "rest",
            Type::Formula,
            "rad",
            "0",
            (
                "angle without torque; \"start\" for the angle at the start",
                "угол, при котором момента нет; \"start\" — угол в начале движения",
            ),
            "\"5 deg\"",
        ),
        may(
            "damping",
            Type::Formula,
            "N m s",
            "0",
            ("torque per rate of the twist", "момент на единицу скорости закручивания"),
            "\"3 N m s\"",
        ),
        LABEL,
    ],
    example: "[torsion_bars.shaft]\nbetween = [\"motor\", \"fan\"]\nshear_modulus = \"80 GPa\"\ndiameter = \"40 mm\"\nlength = \"1.2 m\"\n",
};

/// Codes of torsion bars.
const EXPLANATIONS: &[Explanation] = &[
    row(
        "M350",
        ("two ways to a stiffness", "жёсткость задана двумя способами"),
        (
            "A torsion bar has either its `stiffness`, or `shear_modulus`, `diameter` and `length`, from which it follows. Beside `stiffness` a diameter serves the stress alone.",
            "У торсиона задают либо жёсткость `stiffness`, либо `shear_modulus`, `diameter` и `length`, из которых она следует. При `stiffness` диаметр нужен только для напряжения.",
        ),
        "stiffness = \"12 kN m/rad\"\nlength = \"1 m\"",
        "stiffness = \"12 kN m/rad\"",
    ),
    row(
        "M351",
        ("no such bar", "такого стержня не бывает"),
        (
            "Shear modulus, length and diameters of a bar are positive, and the bore is thinner than the bar.",
            "Модуль сдвига, длина и диаметры стержня положительны, а отверстие уже стержня.",
        ),
        "diameter = \"24 mm\"\ninner_diameter = \"40 mm\"",
        "diameter = \"40 mm\"\ninner_diameter = \"24 mm\"",
    ),
];

/// A torsion bar.
#[derive(Clone, Debug)]
struct TorsionBar {
    between: [FrameId; 2],
    /// k, N m per radian.
    stiffness: Expr,
    /// Angle without torque.
    rest: Rest,
    /// b, N m s; none without damping.
    damping: Option<Expr>,
    /// W = 2 J/D, m³, where the diameter is known.
    section: Option<Expr>,
}

fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Made> {
    let between = between(reader, fields);
    let polar = polar(reader, fields);
    let stiffness = stiffness(reader, fields, polar.map(|p| p.0));
    let rest = match fields.get("rest") {
        Some(value) if value.get_ref().as_str() == Some("start") => Rest::Start,
        _ => Rest::Value(fields.formula_or_zero(reader, "rest", &Context::TIME, Some(&Dimension::ANGLE)).expr),
    };
    let damping = fields.formula(reader, "damping", &Context::TIME, Some(&DAMPING));
    if let Some(b) = &damping {
        useful(reader, fields, "damping", b, ("torsion bar", "торсион"));
    }
    let section = polar.map(|p| p.1);
    let law = TorsionBar { between: between.unwrap_or([FrameId::GROUND; 2]), stiffness, rest, damping: damping.map(|b| b.expr), section };
    Some(Made { law: Arc::new(law), told: told(section) })
}

/// Torque per angular rate.
const DAMPING: Dimension = Dimension::of(2, 1, -1);

/// What formulas may ask: torque, twist and, for a bar of known diameter, stress.
fn told(section: Option<Expr>) -> Vec<Told> {
    let [moment, angle, stress] = [Dimension::ENERGY, Dimension::ANGLE, STRESS].map(Kind::Known);
    let answer = |function, kind, value| Told { function, kind, value };
    let stress = section.map(|_| answer("stress", stress, 2));
    [answer("torque", moment, 0), answer("force", moment, 0), answer("twist", angle, 1), answer("extension", angle, 1)]
        .into_iter()
        .chain(stress)
        .collect()
}

fn between<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<[FrameId; 2]> {
    let [first, second] = two_names(reader, fields, "between")?;
    let name = first.0.clone();
    let [a, b] = [first, second].map(|(name, span)| frame_by_name(reader, &name, span));
    let (a, b) = (a?, b?);
    if a == b {
        let (en, ru) = (format!("both ends are `{name}`"), format!("оба конца — `{name}`"));
        reader.fault(
            Notice::piece("M063", fields.span_of("between"), en, ru)
                .why("a bar between a body and itself is not twisted", "стержень между телом и им самим не закручивается"),
        );
        return None;
    }
    Some([a, b])
}

/// J = π (D⁴ − d⁴)/32 and W = 2 J/D of a bar whose diameter is given.
fn polar<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<(Expr, Expr)> {
    let outer = size(reader, fields, ("diameter", &Dimension::LENGTH), |v| v > 0.0);
    let inner = size(reader, fields, ("inner_diameter", &Dimension::LENGTH), |v| v >= 0.0);
    let Some(outer) = outer else {
        if inner.is_some() {
            reader.fault(lacks(fields, "diameter"));
        }
        return None;
    };
    let zero = reader.builder.graph.zero();
    let wall = reader.builder.graph.sub(outer, inner.unwrap_or(zero));
    if inner.is_some() && reader.number_of_for(wall, Reliance::Sign).is_some_and(|w| w <= 0.0) {
        let (en, ru) = ("the bore is not thinner than the bar", "отверстие не уже стержня");
        reader.fault(Notice::piece("M351", fields.span_of("inner_diameter"), en, ru));
    }
    let graph = &mut reader.builder.graph;
    let [whole, bore] = [outer, inner.unwrap_or(zero)].map(|d| graph.monomial(Rational::ONE, &[(d, Rational::from(4))]));
    let ring = graph.sub(whole, bore);
    let pi = graph.pi();
    let thirty_second = &Rational::ONE / &Rational::from(32);
    let j = graph.monomial(thirty_second, &[(pi, Rational::ONE), (ring, Rational::ONE)]);
    let w = graph.monomial(Rational::from(2), &[(j, Rational::ONE), (outer, Rational::MINUS_ONE)]);
    Some((j, w))
}

/// Given, or G J/L.
fn stiffness<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, polar: Option<Expr>) -> Expr {
    if fields.has("stiffness") {
        if let Some(key) = ["shear_modulus", "length"].into_iter().find(|key| fields.has(key)) {
            let (en, ru) = (format!("`stiffness` and `{key}` are given together"), format!("заданы и `stiffness`, и `{key}`"));
            let fault = Notice::piece("M350", fields.span_of(key), en, ru);
            reader.fault(fault.help(
                "keep `stiffness`, or shear_modulus, diameter and length",
                "оставьте `stiffness` или shear_modulus, diameter и length",
            ));
        }
        let given = fields.formula_or_zero(reader, "stiffness", &Context::TIME, Some(&Dimension::ENERGY));
        useful(reader, fields, "stiffness", &given, ("torsion bar", "торсион"));
        return given.expr;
    }
    let modulus = size(reader, fields, ("shear_modulus", &STRESS), |v| v > 0.0);
    let length = size(reader, fields, ("length", &Dimension::LENGTH), |v| v > 0.0);
    let missing = ["shear_modulus", "diameter", "length"].into_iter().filter(|key| !fields.has(key)).collect::<Vec<_>>().join(", ");
    if !missing.is_empty() {
        reader.fault(lacks(fields, &missing));
    }
    let graph = &mut reader.builder.graph;
    match (modulus, polar, length) {
        (Some(g), Some(j), Some(l)) => graph.monomial(Rational::ONE, &[(g, Rational::ONE), (j, Rational::ONE), (l, Rational::MINUS_ONE)]),
        _ => graph.zero(),
    }
}

/// A constant under a key whose number must be one that a bar may have.
fn size<'a>(
    reader: &mut Reader<'a>,
    fields: &Fields<'a>,
    (key, wanted): (&'static str, &Dimension),
    fits: impl Fn(f64) -> bool,
) -> Option<Expr> {
    let value = fields.formula(reader, key, &Context::CONSTANT, Some(wanted))?;
    if let Some(number) = reader.number_for(&value, Reliance::Sign).filter(|v| !fits(*v)) {
        let shown = words::digits::typed(number);
        let (en, ru) = (format!("{key} of {} is {}", fields.path, shown.en), format!("{key} в {} равно {}", fields.path, shown.ru));
        let fault = Notice::piece("M351", fields.span_of(key), en, ru);
        reader.fault(fault.why("no bar has such a size", "таких размеров у стержня не бывает"));
    }
    Some(value.expr)
}

fn lacks(fields: &Fields, keys: &str) -> Notice {
    let (en, ru) = (format!("{} lacks {keys}", fields.path), format!("в {} не хватает: {keys}", fields.path));
    Notice::piece("M006", fields.span.clone(), en, ru).help(
        "give stiffness = \"12 kN m/rad\", or shear_modulus, diameter and length",
        "задайте stiffness = \"12 кН м/рад\" или shear_modulus, diameter и length",
    )
}

impl Law for TorsionBar {
    fn act(&self, stage: &mut dyn Stage) -> Found<Vec<Expr>> {
        let [first, second] = self.between;
        let way = stage.way(Pathway::RelativeAngle(first, second))?;
        let stiffness = stage.open(self.stiffness)?;
        let rest = match self.rest {
            Rest::Value(e) => stage.open(e)?,
            Rest::Start => stage.at_start(way.value),
        };
        let graph = stage.graph();
        let twist = graph.sub(way.value, rest);
        let square = graph.square(twist);
        let energy = graph.monomial(Rational::HALF, &[(stiffness, Rational::ONE), (square, Rational::ONE)]);
        let mut torque = graph.mul(stiffness, twist);
        let force = graph.neg(torque);
        stage.store(energy, Push { way, force });
        if let Some(damping) = self.damping {
            let damping = stage.open(damping)?;
            // of the twist: an angle without torque that moves takes part
            let free = stage.rate_of(rest);
            let [rate, measured] = stage.rates(way).map(|rate| stage.graph().sub(rate, free));
            let graph = stage.graph();
            let square = graph.square(rate);
            let function = graph.monomial(Rational::HALF, &[(damping, Rational::ONE), (square, Rational::ONE)]);
            let viscous = graph.mul(damping, measured);
            torque = graph.add(torque, viscous);
            let force = graph.neg(viscous);
            stage.dissipate(function, Push { way, force });
        }
        let stress = self.section.map(|w| stage.open(w)).transpose()?.map(|w| stage.graph().div(torque, w));
        Ok([torque, twist].into_iter().chain(stress).collect())
    }

    fn sketch(&self) -> Sketch {
        Sketch::new(Site::On(Pathway::RelativeAngle(self.between[0], self.between[1])), self.stiffness)
    }

    fn straight(&self) -> Straight {
        Straight { switches: false, formulas: [self.stiffness].into_iter().chain(self.damping).collect(), degree: 0 }
    }
}
