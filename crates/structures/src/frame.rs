//! A frame or truss in numbers: nodes, rods, supports, named displacements, loads.

use crate::Scalar;
use algebra::double::Double;
use words::Text;

/// A frame or truss, SI.
#[derive(Clone, Debug, Default)]
pub struct Frame<S> {
    /// Nodes, in the user's order.
    pub nodes: Vec<Node<S>>,
    /// Rods, in the user's order.
    pub rods: Vec<Rod<S>>,
    /// Supports.
    pub supports: Vec<Support<S>>,
    /// Named displacements.
    pub displacements: Vec<Displacement<S>>,
    /// Loads.
    pub loads: Vec<Load<S>>,
}

/// A node.
#[derive(Clone, Debug)]
pub struct Node<S> {
    /// Name.
    pub name: String,
    /// Place.
    pub at: [S; 2],
    /// Lumped mass.
    pub mass: S,
    /// Lumped moment of inertia.
    pub inertia: S,
    /// Stiffness of springs to the ground along x, y and against the turn.
    pub springs: [S; 3],
}

/// A straight rod between two nodes.
#[derive(Clone, Debug)]
pub struct Rod<S> {
    /// Name.
    pub name: String,
    /// Start and end.
    pub ends: [usize; 2],
    /// Length.
    pub length: S,
    /// Cosine and sine of the direction from start to end.
    pub direction: [S; 2],
    /// How it deforms.
    pub kind: RodKind<S>,
    /// Mass of a unit of length.
    pub mass: S,
    /// Moment of inertia of a unit of length (density times second moment) when the turning of the sections counts; otherwise 0.
    pub rotary: S,
    /// Hinges at start and end.
    pub hinged: [bool; 2],
    /// Parts of equal length; named displacements divide the rod besides ([`crate::freedoms`]).
    pub divisions: usize,
}

/// How a rod deforms.
#[derive(Clone, Debug)]
pub enum RodKind<S> {
    /// Not at all.
    Rigid,
    /// It bends with the stiffness EI, and stretches with EA when that is given.
    Beam {
        /// EI.
        bending: S,
        /// EA; none for an inextensible rod.
        axial: Option<S>,
    },
    /// A rod of a truss: hinged at both ends, without bending; EA, or none for an inextensible one.
    Bar(Option<S>),
}

/// A support holds some displacements of a node.
#[derive(Clone, Debug)]
pub struct Support<S> {
    /// Name.
    pub name: String,
    /// Node.
    pub node: usize,
    /// Whether the displacements along its first and second axis and the turn are held.
    pub holds: [bool; 3],
    /// Cosine and sine of its first axis.
    pub axis: [S; 2],
}

/// A linear functional of displacements with a name: a generalised coordinate, or only something to show.
#[derive(Clone, Debug)]
pub struct Displacement<S> {
    /// Name.
    pub name: String,
    /// Symbol in print.
    pub symbol: String,
    /// What it is.
    pub label: Text,
    /// Where.
    pub place: Place<S>,
    /// Which one.
    pub component: Component<S>,
    /// Whether something outside the frame may act along it: what gives way there is then no freedom to be condensed.
    pub loaded: bool,
}

/// A place on a structure.
#[derive(Clone, Debug)]
pub enum Place<S> {
    /// A node.
    Node(usize),
    /// A rod, at a distance from its start.
    Rod(usize, S),
}

/// A component of a displacement.
#[derive(Clone, Debug)]
pub enum Component<S> {
    /// Along the direction with this cosine and sine.
    Along([S; 2]),
    /// The turn.
    Turn,
}

/// A load.
#[derive(Clone, Debug)]
pub struct Load<S> {
    /// Name.
    pub name: String,
    /// Where and what.
    pub action: Action<S>,
}

/// What a load does.
#[derive(Clone, Debug)]
pub enum Action<S> {
    /// Force and couple at a place; a couple on a rod's interior turns its section.
    Point {
        /// Where.
        at: Place<S>,
        /// Components along x and y, couple counter-clockwise.
        value: [S; 3],
    },
    /// A force per unit of length along a rod, linear between its values at start and end.
    Distributed {
        /// The rod.
        rod: usize,
        /// Components along x and y at the start and at the end.
        value: [[S; 2]; 2],
    },
}

impl<S: Scalar> Frame<S> {
    /// The same frame in other numbers; none when a number has no counterpart there.
    pub fn map<R: Scalar>(&self, f: &dyn Fn(&S) -> Option<R>) -> Option<Frame<R>> {
        let pair = |p: &[S; 2]| Some([f(&p[0])?, f(&p[1])?]);
        let triple = |p: &[S; 3]| Some([f(&p[0])?, f(&p[1])?, f(&p[2])?]);
        let place = |p: &Place<S>| {
            Some(match p {
                Place::Node(i) => Place::Node(*i),
                Place::Rod(i, s) => Place::Rod(*i, f(s)?),
            })
        };
        let option = |s: &Option<S>| match s {
            Some(s) => Some(Some(f(s)?)),
            None => Some(None),
        };
        let node = |n: &Node<S>| {
            let (at, springs) = (pair(&n.at)?, triple(&n.springs)?);
            Some(Node { name: n.name.clone(), at, mass: f(&n.mass)?, inertia: f(&n.inertia)?, springs })
        };
        let rod = |r: &Rod<S>| {
            let kind = match &r.kind {
                RodKind::Rigid => RodKind::Rigid,
                RodKind::Beam { bending, axial } => RodKind::Beam { bending: f(bending)?, axial: option(axial)? },
                RodKind::Bar(axial) => RodKind::Bar(option(axial)?),
            };
            let (length, direction) = (f(&r.length)?, pair(&r.direction)?);
            let (mass, rotary) = (f(&r.mass)?, f(&r.rotary)?);
            Some(Rod {
                name: r.name.clone(),
                ends: r.ends,
                length,
                direction,
                kind,
                mass,
                rotary,
                hinged: r.hinged,
                divisions: r.divisions,
            })
        };
        let support = |s: &Support<S>| Some(Support { name: s.name.clone(), node: s.node, holds: s.holds, axis: pair(&s.axis)? });
        let displacement = |d: &Displacement<S>| {
            let component = match &d.component {
                Component::Along(direction) => Component::Along(pair(direction)?),
                Component::Turn => Component::Turn,
            };
            let (name, symbol, label) = (d.name.clone(), d.symbol.clone(), d.label.clone());
            Some(Displacement { name, symbol, label, place: place(&d.place)?, component, loaded: d.loaded })
        };
        let load = |l: &Load<S>| {
            let action = match &l.action {
                Action::Point { at, value } => Action::Point { at: place(at)?, value: triple(value)? },
                Action::Distributed { rod, value } => Action::Distributed { rod: *rod, value: [pair(&value[0])?, pair(&value[1])?] },
            };
            Some(Load { name: l.name.clone(), action })
        };
        Some(Frame {
            nodes: self.nodes.iter().map(node).collect::<Option<_>>()?,
            rods: self.rods.iter().map(rod).collect::<Option<_>>()?,
            supports: self.supports.iter().map(support).collect::<Option<_>>()?,
            displacements: self.displacements.iter().map(displacement).collect::<Option<_>>()?,
            loads: self.loads.iter().map(load).collect::<Option<_>>()?,
        })
    }

    /// The same frame in twice the digits of machine numbers.
    pub fn doubled(&self) -> Frame<Double> {
        self.map(&|v| Some(Double::from(v.value()))).unwrap_or_default()
    }

    /// The same frame with every elastic rod in so many parts.
    pub fn divided(&self, divisions: usize) -> Frame<S> {
        let mut frame = self.clone();
        frame.rods.iter_mut().for_each(|r| r.divisions = if matches!(r.kind, RodKind::Beam { .. }) { divisions } else { 1 });
        frame
    }

    /// Total mass.
    pub fn mass(&self) -> S {
        let rods = self.rods.iter().map(|r| r.mass.mul(&r.length));
        self.nodes.iter().map(|n| n.mass.clone()).chain(rods).fold(S::zero(), |sum, m| sum.add(&m))
    }
}

impl<S> Rod<S> {
    /// Whether it is a bar without bending.
    pub fn is_bar(&self) -> bool {
        matches!(self.kind, RodKind::Bar(_))
    }
    /// Stiffness against stretching; none for rods that do not stretch.
    pub fn axial(&self) -> Option<&S> {
        match &self.kind {
            RodKind::Rigid => None,
            RodKind::Beam { axial, .. } | RodKind::Bar(axial) => axial.as_ref(),
        }
    }
}
