//! Springs: Π = c (δ − rest)²/2 + preload (δ − rest); the force c (δ − rest) + preload pulls the pathway δ shorter.

use super::common::{pathway_of, per, told, useful};
use super::row::{Made, Row, Stands};
use crate::formula::{Context, Kind};
use crate::keys::{ALONG, BETWEEN, LABEL, TableSpec, Type, may, must};
use crate::model::{Found, Law, Measure, Pathway, Push, Reliance, Rest, Site, Sketch, Stage, Straight};
use crate::reader::{Fields, Reader};
use crate::units::Dimension;
use std::sync::Arc;
use symbolic::{Edge, Expr, Graph, Rational};
use words::Notice;
use words::digits::quantity;

/// `[springs]`.
pub(super) const ROW: Row = Row {
    keys: &KEYS,
    listed: ("springs", "пружины"),
    chapter: "elements",
    stands: Stands::Between,
    functions: &[],
    explanations: &[],
    read,
};

/// `[springs.NAME]`.
const KEYS: TableSpec = TableSpec {
    name: "springs",
    about: (
        "Springs: force = preload + stiffness*(pathway - rest), pulling the pathway shorter. Torsion when the pathway is an angle.",
        "Пружины: усилие = preload + stiffness*(координата - rest), укорачивает координату. Если координата — угол, пружина крутильная.",
    ),
    short: None,
    fields: &[
        ALONG,
        BETWEEN,
        must(
            "stiffness",
            Type::Formula,
            "N/m",
            ("stiffness; N m per radian for an angle", "жёсткость; Н м на радиан для угла"),
            "\"400 kN/m\"",
        ),
        may(
            "rest",
            Type::Formula,
            "m",
            "0",
            (
                "pathway at rest; required between two points; \"start\" for its value at the start",
                "координата в свободном состоянии; обязательна между двумя точками; \"start\" — значение в начале движения",
            ),
            "\"l0\"",
        ),
        may(
            "preload",
            Type::Formula,
            "N",
            "0",
            ("force at rest, tension positive", "усилие при rest, растяжение положительно"),
            "\"10 N\"",
        ),
        may(
            "backlash",
            Type::Formula,
            "m",
            "0",
            (
                "whole play about `rest`, half on each side, in which there is no force",
                "полный зазор около `rest`, по половине с каждой стороны; в нём усилия нет",
            ),
            "\"2 mm\"",
        ),
        LABEL,
    ],
    example: "[springs.horizontal]\nalong = \"x\"\nstiffness = \"c_x\"\n",
};

/// Spring: force = preload + stiffness (pathway - rest), pulling the pathway shorter.
#[derive(Clone, Debug)]
pub struct Spring {
    /// Pathway.
    pub pathway: Pathway,
    /// Stiffness.
    pub stiffness: Expr,
    /// Rest value of the pathway.
    pub rest: Rest,
    /// Force at rest; tension positive.
    pub preload: Expr,
    /// Whole play about `rest`, half on each side: the spring acts where |pathway - rest| > backlash/2, by what goes beyond.
    pub backlash: Option<Expr>,
}

fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Made> {
    let path = pathway_of(reader, fields);
    let length = path.map_or(Kind::Unknown, |p| p.1);
    let (stiffness_unit, force_unit) = (per(length, 2, 0), per(length, 1, 0));
    let stiffness = fields.formula_or_zero(reader, "stiffness", &Context::TIME, stiffness_unit.as_ref());
    useful(reader, fields, "stiffness", &stiffness, ("spring", "пружина"));
    let rest = rest(reader, fields, path.map(|p| p.0), length);
    let preload = fields.formula_or_zero(reader, "preload", &Context::TIME, force_unit.as_ref()).expr;
    let backlash = backlash(reader, fields, length);
    let pathway = path.map_or(Pathway::Along(stiffness.expr, Measure::Other), |p| p.0);
    let law = Spring { pathway, stiffness: stiffness.expr, rest, preload, backlash };
    let told = told(length);
    Some(Made { law: Arc::new(law), told })
}

fn rest<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, path: Option<Pathway>, length: Kind) -> Rest {
    let wanted = match length {
        Kind::Known(d) => Some(d),
        _ => None,
    };
    match fields.get("rest") {
        Some(value) if value.get_ref().as_str() == Some("start") => Rest::Start,
        Some(value) if value.get_ref().as_str() == Some("equilibrium") => {
            let name = fields.path.rsplit('.').next().unwrap_or_default().to_owned();
            Rest::Value(reader.rest_from_statics(&name, length, value.span()))
        }
        Some(_) => Rest::Value(fields.formula_or_zero(reader, "rest", &Context::TIME, wanted.as_ref()).expr),
        None => {
            if let Some(Pathway::Distance(..)) = path {
                reader.fault(
                    Notice::piece(
                        "M059",
                        fields.span.clone(),
                        format!("{} lacks `rest`, its length without force", fields.path),
                        format!("в {} нет `rest` — длины без нагрузки", fields.path),
                    )
                    .why(
                        "between two points a free length of zero is hardly ever meant",
                        "нулевая длина свободной пружины между точками почти никогда не имеется в виду",
                    )
                    .help(
                        "add rest = \"0.1 m\", or rest = \"start\" for the distance at the start",
                        "добавьте rest = \"0,1 м\" или rest = \"start\" — расстояние в начале движения",
                    ),
                );
            }
            Rest::Value(reader.builder.graph.zero())
        }
    }
}

fn backlash<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, length: Kind) -> Option<Expr> {
    let wanted = if let Kind::Known(d) = length { Some(d) } else { None };
    let value = fields.formula(reader, "backlash", &Context::TIME, wanted.as_ref())?;
    if let Some(number) = reader.number_for(&value, Reliance::Sign).filter(|v| *v < 0.0) {
        let unit = if matches!(length, Kind::Known(d) if d == Dimension::ANGLE) { "rad" } else { "m" };
        let n = quantity(number, unit);
        let (en, ru) =
            (format!("the backlash is {}; it must not be negative", n.en), format!("зазор равен {}; отрицательным быть не может", n.ru));
        reader.fault(Notice::piece("M088", fields.span_of("backlash"), en, ru));
    } else if fields.has("preload") && !reader.builder.graph.is_zero(value.expr) {
        reader.fault(
            Notice::piece(
                "M088",
                fields.span_of("backlash"),
                "a spring with backlash has no preload",
                "у пружины с зазором нет предварительного усилия",
            )
            .why("within the play the force is zero", "внутри зазора усилие равно нулю")
            .help("drop one of them, or add a second spring", "уберите одно из них или добавьте вторую пружину"),
        );
    }
    (!reader.builder.graph.is_zero(value.expr)).then_some(value.expr)
}

impl Law for Spring {
    fn act(&self, stage: &mut dyn Stage) -> Found<Vec<Expr>> {
        let way = stage.way(self.pathway)?;
        let [stiffness, preload] = [self.stiffness, self.preload].map(|e| stage.open(e));
        let (stiffness, preload) = (stiffness?, preload?);
        let rest = match self.rest {
            Rest::Value(e) => stage.open(e)?,
            Rest::Start => stage.at_start(way.value),
        };
        let extension = stage.graph().sub(way.value, rest);
        let acting = match self.backlash {
            Some(play) => {
                let play = stage.open(play)?;
                beyond_play(stage.graph(), extension, play)
            }
            None => extension,
        };
        let graph = stage.graph();
        let square = graph.square(acting);
        let elastic = graph.monomial(Rational::HALF, &[(stiffness, Rational::ONE), (square, Rational::ONE)]);
        let constant = graph.mul(preload, extension);
        let energy = graph.add(elastic, constant);
        let force = graph.mul(stiffness, acting);
        let force = graph.add(force, preload);
        let against = graph.neg(force);
        stage.store(energy, Push { way, force: against });
        Ok(vec![force, extension])
    }

    fn sketch(&self) -> Sketch {
        Sketch { play: self.backlash, ..Sketch::new(Site::On(self.pathway), self.stiffness) }
    }

    fn straight(&self) -> Straight {
        Straight { switches: self.backlash.is_some(), formulas: vec![self.stiffness, self.preload], degree: 0 }
    }
}

/// What an extension e has beyond a play of width δ: e - δ/2 above it, e + δ/2 below it, 0 within.
fn beyond_play(graph: &mut Graph, extension: Expr, play: Expr) -> Expr {
    let half = graph.scale(play, &Rational::HALF);
    let (above, below, zero) = (graph.sub(extension, half), graph.add(extension, half), graph.zero());
    let under = graph.neg(below);
    let otherwise = graph.switch(under, Edge::Open, below, zero);
    graph.switch(above, Edge::Open, above, otherwise)
}
