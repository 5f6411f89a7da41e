//! A component: a scalar condition with a scalar reaction, what every connection is made of.

use crate::model::{Connection, FrameId, Part, Pathway, Rest};
use crate::scene::kinematics::{Kinematics, combine};
use crate::scene::pathways::{self, Path};
use crate::scene::requests::Resolver;
use crate::scene::wrench::Act;
use crate::scene::{Columns, Found, Scene, Vector, is_spatial};
use symbolic::connections::Rebound;
use symbolic::{Expr, SymbolId};
use words::{Notice, Text};

/// A scalar condition with a scalar reaction.
pub struct Component {
    /// Name of the reaction; none when it has none.
    pub part: Option<Part>,
    /// Letter of the reaction's symbol.
    pub letter: &'static str,
    /// SI unit of the reaction; empty when it depends on the user's formula.
    pub unit: &'static str,
    /// What it is.
    pub label: Text,
    /// Vanishes.
    pub place: Option<Expr>,
    /// Vanishes; d/dt of `place` when absent.
    pub rate: Option<Expr>,
    /// Whether the reaction's generalized force is minus the derivative of the rate.
    pub negative: bool,
    /// What a unit of the reaction does to the bodies.
    pub acts: Vec<Act>,
    /// When it acts.
    pub nature: Nature,
    /// What must not move for the component to be true, and the fault when something does.
    pub doubts: Vec<Doubt>,
    /// Generalized forces per unit of the reaction besides those of the condition.
    pub beside: Columns<Expr>,
    /// What the connection does by an unknown of its own.
    pub open: Vec<Pull>,
}

/// When a component acts.
pub enum Nature {
    /// Always.
    Ideal,
    /// While the gap is closed.
    Contact { gap: Expr, restitution: [Expr; 2], tie: bool, rebound: Rebound },
    /// While the contact before it is closed, whatever it takes.
    Rough,
    /// Dry friction.
    Friction(Rubbing),
    /// A prescribed motion.
    Motion,
    /// An unknown drive.
    Motor,
}

/// The law of a dry friction.
pub struct Rubbing {
    /// Symbol of the sliding speed in `kinetic`.
    pub speed: SymbolId,
    /// Force, or coefficient of the normal force, while it slides.
    pub kinetic: Expr,
    /// The same at rest; `None`: as at the slowest sliding.
    pub fixed: Option<Expr>,
    /// Components of the normal force; none for a force.
    pub normal: Vec<Expr>,
    /// Share of the friction itself in the normal force.
    pub own: Option<Expr>,
}

impl Component {
    /// An ideal component.
    pub fn ideal((part, letter, unit): (Part, &'static str, &'static str), label: Text, acts: Vec<Act>) -> Component {
        Component {
            part: Some(part),
            letter,
            unit,
            label,
            place: None,
            rate: None,
            negative: false,
            acts,
            nature: Nature::Ideal,
            doubts: Vec::new(),
            beside: Columns::new(),
            open: Vec::new(),
        }
    }
}

/// A rate that must vanish for a connection to be what it says, though the connection does not demand it, and the fault when it does not.
#[derive(Debug)]
pub struct Doubt {
    /// The rate.
    pub rate: Expr,
    /// The fault.
    pub fault: Notice,
}

/// Two opposite forces, on the axles of two wheels.
#[derive(Clone, Debug)]
pub struct Pull {
    /// On the bodies.
    pub acts: Vec<Act>,
    /// Generalized forces, by differentiation of the distance of the axles.
    pub forces: Columns<Expr>,
}

impl Pull {
    /// The same times a factor.
    pub fn times(&self, scene: &mut Scene, factor: Expr) -> Pull {
        let acts = self.acts.iter().map(|act| act.times(scene, factor)).collect();
        let forces = self.forces.iter().map(|(j, e)| (*j, scene.graph.mul(factor, *e))).collect();
        Pull { acts, forces }
    }
}

/// Letter and unit of a force on a pathway: a moment where it is an angle.
pub fn effort(pathway: Pathway, moment: &'static str, force: &'static str) -> (&'static str, &'static str) {
    match pathway {
        Pathway::RelativeAngle(..) => (moment, "N m"),
        Pathway::Distance(..) => (force, "N"),
        Pathway::Along(..) => (force, ""),
    }
}

/// A label with what is named and which part of it.
pub fn labelled(en: &str, ru: &str, name: &str, what: &Text) -> Text {
    Text::new(format!("{en} {name}, {}", what.en), format!("{ru} {name}, {}", what.ru))
}

/// Label, part and letter of a force along an axis.
pub fn in_axis(axis: usize) -> (Text, Part, &'static str) {
    let part = [Part::ForceX, Part::ForceY, Part::ForceZ][axis];
    let letter = ["X", "Y", "Z"][axis];
    let name = ["x", "y", "z"][axis];
    (Text::new(format!("along {name}"), format!("вдоль {name}")), part, letter)
}

/// Label, part and letter of a moment about an axis.
pub fn moment_about(axis: usize) -> (Text, Part, &'static str) {
    let part = [Part::MomentX, Part::MomentY, Part::Moment][axis];
    let letter = ["M_x", "M_y", "M"][axis];
    let name = ["x", "y", "z"][axis];
    (Text::new(format!("moment about {name}"), format!("момент относительно {name}")), part, letter)
}

/// ω_b - ω_a = 0, about z in the plane, about the three given axes (ground components) in space.
pub fn no_turning(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    (name, directions): (&str, [Vector; 3]),
    [a, b]: [FrameId; 2],
) -> Vec<Component> {
    let numbers: &[usize] = if is_spatial(scene.model) { &[0, 1, 2] } else { &[2] };
    let [own, other] = [a, b].map(|f| {
        let columns = kinematics.turning_in_ground_axes(scene, f);
        combine(scene, &columns)
    });
    let turning = scene.minus(&other, &own);
    numbers
        .iter()
        .map(|&i| {
            let (what, part, letter) = moment_about(i);
            let axis = directions[i];
            let opposite = axis.map(|c| scene.graph.neg(c));
            let rate = scene.dot(&axis, &turning);
            let acts = vec![Act::Turn { on: b, moment: axis }, Act::Turn { on: a, moment: opposite }];
            Component {
                rate: Some(rate), ..Component::ideal((part, letter, "N m"), labelled("joint", "соединение", name, &what), acts)
            }
        })
        .collect()
}

/// A pathway for the components.
pub fn path(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    resolver: &mut Resolver,
    connection: &Connection,
    pathway: Pathway,
) -> Found<Path> {
    pathways::resolve(scene, kinematics, resolver, (&connection.name, pathway, &connection.span))
}

/// The length of a tie; none where it is that of the start.
pub fn length_of(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver, length: Rest) -> Found<Option<Expr>> {
    match length {
        Rest::Value(e) => Ok(Some(resolver.resolve(scene, kinematics, e)?)),
        Rest::Start => Ok(None),
    }
}
