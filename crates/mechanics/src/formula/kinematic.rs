//! The kinematic functions of formulas: what they take, mean and where they may stand.

use super::kind::Depends;
use crate::keys::Words;
use crate::units::Dimension;
use std::ops::RangeInclusive;

/// What a kinematic function takes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Takes {
    /// A point, or a frame or body for its origin.
    Point,
    /// A frame or body.
    Frame,
    /// A body, or nothing for the whole machine.
    BodyOrNothing,
    /// Nothing.
    Nothing,
    /// A spring or damper.
    Element,
    /// A spring, damper or connection.
    Acting,
}

/// Where it may stand, from everywhere to outputs only; each level includes the ones after it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Where {
    /// Pathways, potentials, forces, outputs.
    Pathways,
    /// Forces, torques, dissipation functions, outputs.
    Forces,
    /// Normal forces of dry friction, outputs.
    Reactions,
    /// Outputs.
    Outputs,
}

/// A kinematic function.
#[derive(Clone, Copy, Debug)]
pub struct KinematicFunction {
    /// Name.
    pub name: &'static str,
    /// What it takes.
    pub takes: Takes,
    /// Dimension of its value; `None` for that of an element's force or pathway.
    pub dimension: Option<Dimension>,
    /// What its value depends on.
    pub(crate) depends: Depends,
    /// Where it may stand.
    pub allowed: Where,
    /// Meaning in English.
    pub en: &'static str,
    /// Meaning in Russian.
    pub ru: &'static str,
}

impl KinematicFunction {
    /// Number of arguments.
    pub fn arity(&self) -> RangeInclusive<usize> {
        match self.takes {
            Takes::Nothing => 0..=0,
            Takes::BodyOrNothing => 0..=1,
            _ => 1..=1,
        }
    }
}

const fn row(
    name: &'static str,
    takes: Takes,
    dimension: Option<Dimension>,
    (depends, allowed): (Depends, Where),
    (en, ru): Words,
) -> KinematicFunction {
    KinematicFunction { name, takes, dimension, depends, allowed, en, ru }
}

const LENGTH: Option<Dimension> = Some(Dimension::LENGTH);
const VELOCITY: Option<Dimension> = Some(Dimension::VELOCITY);
const ACCELERATION: Option<Dimension> = Some(Dimension::ACCELERATION);
const ENERGY: Option<Dimension> = Some(Dimension::ENERGY);

/// Every kinematic function but those that only one kind of element has.
pub const FUNCTIONS: &[KinematicFunction] = {
    use Depends as D;
    use Takes::{Acting, BodyOrNothing, Element, Frame, Nothing, Point};
    use Where::{Forces, Outputs, Pathways, Reactions};
    const FORCE: Option<Dimension> = Some(Dimension::FORCE);
    &[
        row("x", Point, LENGTH, (D::POSITION, Pathways), ("ground coordinate x of a point", "координата x точки в неподвижных осях")),
        row("y", Point, LENGTH, (D::POSITION, Pathways), ("ground coordinate y of a point", "координата y точки в неподвижных осях")),
        row("z", Point, LENGTH, (D::POSITION, Pathways), ("ground coordinate z of a point", "координата z точки в неподвижных осях")),
        row("vx", Point, VELOCITY, (D::MOTION, Forces), ("velocity of a point along x", "проекция скорости точки на x")),
        row("vy", Point, VELOCITY, (D::MOTION, Forces), ("velocity of a point along y", "проекция скорости точки на y")),
        row("vz", Point, VELOCITY, (D::MOTION, Forces), ("velocity of a point along z", "проекция скорости точки на z")),
        row("ax", Point, ACCELERATION, (D::ALL, Outputs), ("acceleration of a point along x", "проекция ускорения точки на x")),
        row("ay", Point, ACCELERATION, (D::ALL, Outputs), ("acceleration of a point along y", "проекция ускорения точки на y")),
        row("az", Point, ACCELERATION, (D::ALL, Outputs), ("acceleration of a point along z", "проекция ускорения точки на z")),
        row("speed", Point, VELOCITY, (D::MOTION, Forces), ("magnitude of the velocity of a point", "модуль скорости точки")),
        row(
            "angle",
            Frame,
            Some(Dimension::ANGLE),
            (D::POSITION, Pathways),
            ("plane angle of a body from the ground", "угол поворота тела в плоскости"),
        ),
        row(
            "omega",
            Frame,
            Some(Dimension::ANGULAR_RATE),
            (D::MOTION, Forces),
            ("angular velocity of a body about z of the ground", "угловая скорость тела относительно оси z неподвижных осей"),
        ),
        row(
            "kinetic_energy",
            BodyOrNothing,
            ENERGY,
            (D::MOTION, Outputs),
            ("kinetic energy of the machine or of one body", "кинетическая энергия машины или одного тела"),
        ),
        row("potential_energy", Nothing, ENERGY, (D::POSITION, Outputs), ("potential energy", "потенциальная энергия")),
        row(
            "dissipation",
            Nothing,
            Some(Dimension::POWER),
            (D::MOTION, Outputs),
            ("Rayleigh's dissipation function", "диссипативная функция Рэлея"),
        ),
        row(
            "force",
            Acting,
            None,
            (D::MOTION, Forces),
            (
                "force (or torque) of a spring or damper, tension positive; reaction of a connection: its only component, or the magnitude",
                "усилие (или момент) пружины или демпфера, растяжение положительно; реакция связи: единственная компонента или модуль",
            ),
        ),
        row(
            "extension",
            Element,
            None,
            (D::POSITION, Forces),
            (
                "pathway of a spring minus its rest value; pathway of a damper",
                "удлинение пружины (без начальной длины); координата демпфера",
            ),
        ),
        row("force_x", Acting, FORCE, (D::REACTION, Reactions), ("component of a reaction along x", "компонента реакции вдоль x")),
        row("force_y", Acting, FORCE, (D::REACTION, Reactions), ("component of a reaction along y", "компонента реакции вдоль y")),
        row("force_z", Acting, FORCE, (D::REACTION, Reactions), ("component of a reaction along z", "компонента реакции вдоль z")),
        row("moment", Acting, ENERGY, (D::REACTION, Reactions), ("moment of a reaction about z", "момент реакции относительно оси z")),
        row("moment_x", Acting, ENERGY, (D::REACTION, Reactions), ("moment of a reaction about x", "момент реакции относительно оси x")),
        row("moment_y", Acting, ENERGY, (D::REACTION, Reactions), ("moment of a reaction about y", "момент реакции относительно оси y")),
        row(
            "normal",
            Acting,
            FORCE,
            (D::REACTION, Reactions),
            ("normal reaction of a rolling contact or a slider", "нормальная реакция при качении или в ползуне"),
        ),
        row(
            "tangential",
            Acting,
            FORCE,
            (D::REACTION, Reactions),
            ("tangential reaction of a rolling contact or a rack", "касательная реакция при качении или в рейке"),
        ),
        row(
            "tight_side",
            Acting,
            FORCE,
            (D::REACTION, Reactions),
            (
                "tension of the tight strand of a belt with pretension, of a chain that says which way it pulls",
                "натяжение ведущей ветви ремня с предварительным натяжением или цепи с заданной стороной тяги",
            ),
        ),
        row("slack_side", Acting, FORCE, (D::REACTION, Reactions), ("the same of the slack strand", "то же для ведомой ветви")),
        row(
            "torque",
            Acting,
            ENERGY,
            (D::MOTION, Forces),
            (
                "torque of a torsion spring, motor or friction; moment of a reaction about z",
                "момент крутильной пружины, двигателя или трения; момент реакции относительно оси z",
            ),
        ),
    ]
};
