//! Where frames, points and pathways are, as formulas over coordinates, time and parameters: what drawings ask for.

use super::Scene;
use super::kinematics::Kinematics;
use super::pathways;
use super::requests::Resolver;
use crate::model::{FrameId, Model, Pathway, PointRef};
use symbolic::{Expr, Graph};

/// The kinematics of a model.
#[derive(Debug)]
pub struct Places<'m> {
    scene: Scene<'m>,
    kinematics: Kinematics,
    resolver: Resolver,
}

impl<'m> Places<'m> {
    /// Follows the frames of a model.
    pub fn new(model: &'m Model) -> Places<'m> {
        let mut scene = Scene::new(model);
        let kinematics = Kinematics::new(&mut scene);
        Places { scene, kinematics, resolver: Resolver::default() }
    }

    /// Owner of all formulas that are handed out.
    pub fn graph(&self) -> &Graph {
        &self.scene.graph
    }

    /// Origin and rows of the rotation matrix of a frame, ground from frame.
    pub fn frame(&self, frame: FrameId) -> ([Expr; 3], [[Expr; 3]; 3]) {
        let motion = &self.kinematics.frames[frame.index()];
        (motion.origin, motion.rotation)
    }

    /// Ground coordinates of a point.
    pub fn point(&mut self, point: PointRef) -> [Expr; 3] {
        self.kinematics.position(&mut self.scene, point)
    }

    /// A formula of the file without what it asks of places, angles and rates; none where it asks for energies or forces.
    pub fn formula(&mut self, e: Expr) -> Option<Expr> {
        self.resolver.resolve(&mut self.scene, &mut self.kinematics, e).ok()
    }

    /// The value of a pathway; none where two bodies have no single angle.
    pub fn pathway(&mut self, pathway: Pathway) -> Option<Expr> {
        let path = pathways::resolve(&mut self.scene, &mut self.kinematics, &mut self.resolver, ("", pathway, &(0..0)));
        path.ok().map(|path| path.value)
    }
}
