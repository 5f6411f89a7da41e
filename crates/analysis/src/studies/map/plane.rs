//! The lattice of a map, and what has been found on it.

use rustc_hash::FxHashMap;

/// What a place belongs to; the caller knows what it means.
pub type Class = usize;
/// Shares of both ranges, 0 ... 1.
pub type Place = [f64; 2];
/// The classes of places, in their order.
pub type Find<'a, E> = dyn FnMut(&[Place]) -> Result<Vec<Class>, E> + 'a;

/// How a plane is divided.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    /// Coarse cells along each side.
    pub cells: u32,
    /// How often a cell with a boundary is halved.
    pub refine: u32,
    /// Share of a range to which a boundary is closed in.
    pub accuracy: f64,
}

impl Grid {
    /// Finest cells along each side.
    pub fn finest(self) -> u32 {
        self.cells << self.refine
    }

    /// Places when every one of the finest lattice is computed.
    pub fn places(self) -> u64 {
        let side = u64::from(self.finest()) + 1;
        side * side
    }
}

/// A place of the finest lattice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Node {
    /// Along the first range.
    pub i: u32,
    /// Along the second one.
    pub j: u32,
}

/// A cell that is not divided any further.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Cell {
    /// Its lower left corner.
    pub at: Node,
    /// Its side in finest cells.
    pub size: u32,
}

impl Cell {
    /// Its corners, counter-clockwise from the lower left.
    pub fn corners(self) -> [Node; 4] {
        let (Node { i, j }, s) = (self.at, self.size);
        [(i, j), (i + s, j), (i + s, j + s), (i, j + s)].map(|(i, j)| Node { i, j })
    }

    /// Its four parts.
    pub(super) fn parts(self) -> [Cell; 4] {
        let size = self.size / 2;
        let (Node { i, j }, s) = (self.at, size);
        [(i, j), (i + s, j), (i + s, j + s), (i, j + s)].map(|(i, j)| Cell { at: Node { i, j }, size })
    }

    /// Places of the lattice on its edges.
    fn rim(self) -> impl Iterator<Item = Node> {
        let (Node { i, j }, s) = (self.at, self.size);
        (0..s).flat_map(move |k| [(i + k, j), (i + s, j + k), (i + s - k, j + s), (i, j + s - k)]).map(|(i, j)| Node { i, j })
    }
}

/// Along which range an edge runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Along {
    First,
    Second,
}

/// An edge of a finest cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Edge {
    pub(super) at: Node,
    pub(super) along: Along,
}

impl Edge {
    /// Both ends.
    pub(super) fn ends(self) -> [Node; 2] {
        let Node { i, j } = self.at;
        match self.along {
            Along::First => [self.at, Node { i: i + 1, j }],
            Along::Second => [self.at, Node { i, j: j + 1 }],
        }
    }
}

/// A plane while it is divided.
pub(super) struct Plane<'a, 'f, E> {
    pub(super) grid: Grid,
    pub(super) nodes: FxHashMap<Node, (usize, Class)>,
    pub(super) computed: usize,
    pub(super) find: &'a mut Find<'f, E>,
}

impl<E> Plane<'_, '_, E> {
    pub(super) fn share(&self, k: f64) -> f64 {
        k / f64::from(self.grid.finest())
    }

    pub(super) fn place(&self, node: Node) -> Place {
        [node.i, node.j].map(|k| self.share(f64::from(k)))
    }

    /// Classes of places that are no nodes of the lattice.
    pub(super) fn find(&mut self, places: &[Place]) -> Result<Vec<Class>, E> {
        if places.is_empty() {
            return Ok(Vec::new());
        }
        self.computed += places.len();
        (self.find)(places)
    }

    pub(super) fn compute(&mut self, nodes: &[Node]) -> Result<(), E> {
        let first = self.computed;
        let places: Vec<Place> = nodes.iter().map(|node| self.place(*node)).collect();
        let classes = self.find(&places)?;
        self.nodes.extend(nodes.iter().zip(classes).enumerate().map(|(k, (node, class))| (*node, (first + k, class))));
        Ok(())
    }

    pub(super) fn class(&self, node: Node) -> Option<Class> {
        self.nodes.get(&node).map(|(_, class)| *class)
    }

    /// Whether places on its edges are of several classes.
    pub(super) fn differs(&self, cell: Cell) -> bool {
        let first = self.class(cell.at);
        cell.rim().filter_map(|node| self.class(node)).any(|class| Some(class) != first)
    }

    /// Where an edge with two classes passes from one to the other, as a share of the edge, and whether a third one lies between.
    pub(super) fn closed_in(&mut self, edges: &[Edge]) -> Result<Vec<(f64, bool)>, E> {
        let mut found: Vec<([f64; 2], bool)> = vec![([0.0, 1.0], false); edges.len()];
        let wanted = self.grid.accuracy * f64::from(self.grid.finest());
        let mut width = 1.0;
        while width > wanted {
            let middle = |([a, b], _): &([f64; 2], bool)| 0.5 * (a + b);
            let places: Vec<Place> = edges.iter().zip(&found).map(|(edge, ends)| self.on(*edge, middle(ends))).collect();
            let classes = self.find(&places)?;
            for ((edge, ends), class) in edges.iter().zip(&mut found).zip(classes) {
                let c = middle(ends);
                let [first, second] = edge.ends().map(|node| self.class(node));
                ends.1 |= Some(class) != first && Some(class) != second;
                ends.0[usize::from(Some(class) != first)] = c;
            }
            width *= 0.5;
        }
        Ok(found.into_iter().map(|([a, b], third)| (0.5 * (a + b), third)).collect())
    }

    /// The place at a share of an edge.
    pub(super) fn on(&self, edge: Edge, share: f64) -> Place {
        let [a, b] = edge.ends();
        let along = |a: u32, b: u32| self.share(f64::from(a) + share * f64::from(b - a));
        [along(a.i, b.i), along(a.j, b.j)]
    }
}
