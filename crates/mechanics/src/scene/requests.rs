//! Kinematic functions in formulas: `x(A)`, `omega(B)`, `force(S)`, time derivatives of named formulas.
//!
//! The reader leaves a placeholder symbol for each; here it is replaced by the expression over coordinates, rates and accelerations.

use super::kinematics::Kinematics;
use super::{Found, Scene};
use crate::model::{Axis, FrameId, Part, Request, RequestKind};
use rustc_hash::FxHashMap;
use symbolic::{Expr, Node, Substitution, SymbolId};
use words::{Notice, Text};

/// How deep placeholders may refer to each other.
const DEEPEST: usize = 200;

/// Energies that formulas may ask for; known after the derivation, asked for in outputs.
#[derive(Clone, Copy, Debug)]
pub struct EnergyTerms {
    /// Kinetic energy.
    pub kinetic: Expr,
    /// Potential energy.
    pub potential: Expr,
    /// Rayleigh's function.
    pub dissipation: Expr,
}

/// Replaces placeholders; remembers what it has found.
#[derive(Debug, Default)]
pub struct Resolver {
    known: FxHashMap<SymbolId, Expr>,
    open: Vec<SymbolId>,
    /// Available once loads and energies are derived.
    pub energies: Option<EnergyTerms>,
    /// Kinetic energy of each frame; available with `energies`.
    pub kinetic: Vec<Option<Expr>>,
    /// Symbols of reactions; available once connections are derived.
    pub reactions: FxHashMap<(usize, Part), Expr>,
    /// What elements tell, by their handles; available once loads are derived.
    pub told: Vec<Vec<Expr>>,
}

impl Resolver {
    /// `e` without placeholders and without parameters that depend on the motion.
    pub fn resolve(&mut self, scene: &mut Scene, kinematics: &mut Kinematics, e: Expr) -> Found<Expr> {
        let mut e = e;
        // opening a parameter may bring placeholders in, and a placeholder may stand for a formula over parameters
        for _ in 0..DEEPEST {
            let opened = scene.open(e);
            let model = scene.model;
            let wanted: Vec<&Request> = {
                let symbols = scene.graph.symbols_in(&[opened]);
                model.requests.iter().filter(|r| symbols.binary_search(&r.symbol).is_ok()).collect()
            };
            let mut map = Vec::new();
            for request in wanted {
                let value = self.request(scene, kinematics, request)?;
                let itself = scene.graph.symbol(request.symbol);
                if value != itself {
                    map.push((request.symbol, value));
                }
            }
            if map.is_empty() {
                return Ok(opened);
            }
            e = Substitution::new(map).apply(&mut scene.graph, opened);
        }
        Ok(e)
    }

    fn request(&mut self, scene: &mut Scene, kinematics: &mut Kinematics, request: &Request) -> Found<Expr> {
        if let Some(&known) = self.known.get(&request.symbol) {
            return Ok(known);
        }
        if self.open.contains(&request.symbol) || self.open.len() >= DEEPEST {
            return Err(not_available(scene, request));
        }
        self.open.push(request.symbol);
        let value = self.find(scene, kinematics, request);
        self.open.pop();
        let value = value?;
        self.known.insert(request.symbol, value);
        Ok(value)
    }

    fn find(&mut self, scene: &mut Scene, kinematics: &mut Kinematics, request: &Request) -> Found<Expr> {
        let missing = |scene: &Scene| not_available(scene, request);
        match request.kind {
            RequestKind::Position(p, axis) => Ok(kinematics.position(scene, p)[axis.index()]),
            RequestKind::Velocity(p, axis) => Ok(velocity(scene, kinematics, p, axis)),
            RequestKind::Acceleration(p, axis) => {
                let v = velocity(scene, kinematics, p, axis);
                Ok(scene.total(v))
            }
            RequestKind::Speed(p) => {
                let v = [Axis::X, Axis::Y, Axis::Z].map(|axis| velocity(scene, kinematics, p, axis));
                let square = scene.dot(&v, &v);
                let tidy = scene.tidy(square);
                // what contracts to a sum cancels where the point stands, and the root keeps half of the digits: squares of components do not
                let cancels = matches!(scene.graph.node(tidy), Node::Sum { .. });
                Ok(scene.graph.sqrt(if cancels { square } else { tidy }))
            }
            RequestKind::Angle(f) => kinematics.frames[f.index()].plane_angle.ok_or_else(|| missing(scene)),
            RequestKind::AngularVelocity(f) => Ok(turning_about_z(scene, kinematics, f)),
            RequestKind::KineticEnergy(None) => self.energies.map(|e| e.kinetic).ok_or_else(|| missing(scene)),
            RequestKind::KineticEnergy(Some(f)) => match self.kinetic.get(f.index()) {
                Some(Some(e)) => Ok(*e),
                Some(None) => Ok(scene.graph.zero()),
                None => Err(missing(scene)),
            },
            RequestKind::PotentialEnergy => self.energies.map(|e| e.potential).ok_or_else(|| missing(scene)),
            RequestKind::Dissipation => self.energies.map(|e| e.dissipation).ok_or_else(|| missing(scene)),
            RequestKind::Element(element, value) => {
                self.told.get(element.0).and_then(|told| told.get(value)).copied().ok_or_else(|| missing(scene))
            }
            RequestKind::Reaction(connection, part) => {
                self.reaction(scene, (connection, part)).ok_or_else(|| self.no_component(scene, request, connection))
            }
            RequestKind::TimeDerivative { of, order } => {
                let mut e = self.resolve(scene, kinematics, of)?;
                for _ in 0..order {
                    e = scene.total(e);
                }
                Ok(e)
            }
        }
    }

    /// A component, or the magnitude of the force where it has several.
    fn reaction(&self, scene: &mut Scene, (connection, part): (usize, Part)) -> Option<Expr> {
        if let Some(known) = self.reactions.get(&(connection, part)) {
            return Some(*known);
        }
        let of = |part| self.reactions.get(&(connection, part)).copied();
        match part {
            // a moment on an angle is the drive's or friction's only component
            Part::Moment => of(Part::Force),
            // a rack has no normal force: its only one is tangential
            Part::Tangential => of(Part::Force),
            Part::Force => {
                let all = [Part::ForceX, Part::ForceY, Part::ForceZ, Part::Normal, Part::Tangential];
                let parts: Vec<Expr> = all.into_iter().filter_map(of).collect();
                match parts[..] {
                    [] => of(Part::Moment),
                    [only] => Some(only),
                    _ => {
                        let squares: Vec<Expr> = parts.iter().map(|e| scene.graph.square(*e)).collect();
                        let sum = scene.graph.sum(&squares);
                        Some(scene.graph.sqrt(sum))
                    }
                }
            }
            _ => None,
        }
    }

    /// A component that the connection does not have; before the reactions are known, any.
    fn no_component(&self, scene: &Scene, request: &Request, connection: usize) -> Box<Notice> {
        let of = &scene.model.connections[connection].name;
        let own = self.reactions.keys().filter(|(c, _)| *c == connection).map(|(_, part)| part);
        let mut names: Vec<String> = own.map(|part| format!("{}({of})", part.name())).collect();
        names.sort();
        if names.is_empty() {
            return not_available(scene, request);
        }
        let (name, list) = (&scene.graph.symbol_info(request.symbol).name, names.join(", "));
        let what = Text::new(format!("`{name}` is not available here"), format!("величина `{name}` здесь недоступна"));
        let why = Text::new(
            format!("`{of}` has no such component in this machine"),
            format!("у связи `{of}` в этой машине нет такой компоненты"),
        );
        let help = Text::new(format!("it has: {list}"), format!("у неё есть: {list}"));
        Box::new(Notice::file("M103", 0..0, what).because(why).cure(help))
    }
}

fn velocity(scene: &mut Scene, kinematics: &Kinematics, p: crate::model::PointRef, axis: Axis) -> Expr {
    let position = kinematics.position(scene, p)[axis.index()];
    scene.total(position)
}

fn turning_about_z(scene: &mut Scene, kinematics: &Kinematics, f: FrameId) -> Expr {
    let w = kinematics.angular_velocity(scene, f);
    let z = kinematics.in_ground_axes(scene, f, &w)[2];
    scene.tidy(z)
}

fn not_available(scene: &Scene, request: &Request) -> Box<Notice> {
    let name = &scene.graph.symbol_info(request.symbol).name;
    let found =
        Notice::file("M103", 0..0, Text::new(format!("`{name}` is not available here"), format!("величина `{name}` здесь недоступна")))
            .why(
                "energies and element forces are known only after the equations are derived; `angle` exists only for plane rotation",
                "энергии и силы в элементах известны только после вывода уравнений; `angle` определён только для плоского вращения",
            )
            .help("use it in [outputs], or write the formula out", "используйте её в [outputs] или запишите формулу полностью");
    Box::new(found)
}
