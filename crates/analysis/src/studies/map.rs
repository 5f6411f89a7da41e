//! A plane of two parameters in which every place belongs to a class (a regime, a verdict, no result), computed only where classes change.
//!
//! A lattice of coarse cells is computed whole. A cell with corners of one class is not looked at any further; one whose corners differ is halved both ways, as often as is asked for, and so
//! is its neighbour where a place on their common edge differs from the neighbour's corners: so that a boundary that leaves a cell is followed into the next one. On the edges of the finest
//! cells the change is closed in by halving. What lies inside of one coarse cell without reaching an edge of it between differing corners is not seen.
//!
//! *Source*: H. Samet, The design and analysis of spatial data structures, Addison-Wesley 1990, restricted quadtrees; W. Lorensen, H. Cline, Marching cubes, SIGGRAPH 1987, in the plane.

mod lines;
mod plane;

pub use lines::Line;
use lines::joined;
use plane::Plane;
pub use plane::{Cell, Class, Find, Grid, Node, Place};
use rustc_hash::FxHashMap;
use std::collections::BTreeSet;

/// A plane with its classes.
#[derive(Clone, Debug)]
pub struct Map {
    /// How it was divided.
    pub grid: Grid,
    /// Which of the computed places a node is, counted from 0, and its class.
    pub nodes: FxHashMap<Node, (usize, Class)>,
    /// Cells that are not divided, in order.
    pub cells: Vec<Cell>,
    /// Boundaries.
    pub lines: Vec<Line>,
    /// Places that were computed.
    pub computed: usize,
    /// Finest edges on which a third class lies between the two ends.
    pub narrow: usize,
}

/// Divides a plane.
///
/// # Errors
/// That of the places.
pub fn map<E>(grid: Grid, find: &mut Find<'_, E>) -> Result<Map, E> {
    let mut plane = Plane { grid, nodes: FxHashMap::default(), computed: 0, find };
    let step = 1 << grid.refine;
    let lattice = (0..=grid.cells).flat_map(|j| (0..=grid.cells).map(move |i| Node { i: i * step, j: j * step }));
    plane.compute(&lattice.collect::<Vec<_>>())?;
    let coarse = (0..grid.cells).flat_map(|j| (0..grid.cells).map(move |i| Cell { at: Node { i: i * step, j: j * step }, size: step }));
    let mut cells: Vec<Cell> = coarse.collect();
    loop {
        let (cut, whole): (Vec<Cell>, Vec<Cell>) = cells.iter().partition(|cell| cell.size > 1 && plane.differs(**cell));
        if cut.is_empty() {
            break;
        }
        let parts: Vec<Cell> = cut.iter().flat_map(|cell| cell.parts()).collect();
        let fresh: BTreeSet<Node> = parts.iter().flat_map(|part| part.corners()).filter(|node| !plane.nodes.contains_key(node)).collect();
        plane.compute(&fresh.into_iter().collect::<Vec<_>>())?;
        cells = whole.into_iter().chain(parts).collect();
    }
    cells.sort_unstable();
    let cut: Vec<Cell> = cells.iter().copied().filter(|cell| cell.size == 1 && plane.differs(*cell)).collect();
    let (lines, narrow) = joined(&mut plane, &cut)?;
    Ok(Map { grid, nodes: plane.nodes, cells, lines, computed: plane.computed, narrow })
}

impl Map {
    /// The computed place that stands for a place: the nearest corner of its cell. The cells are looked up by `index`.
    pub fn nearest(&self, index: &Index, [x, y]: Place) -> Option<(usize, Class)> {
        let n = self.grid.finest();
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let whole = |share: f64| ((share * f64::from(n)).floor().max(0.0) as u32).min(n.saturating_sub(1));
        let cell = index.cell(Node { i: whole(x), j: whole(y) })?;
        let side = |share: f64, from: u32| {
            let within = share * f64::from(n) - f64::from(from);
            from + if 2.0 * within < f64::from(cell.size) { 0 } else { cell.size }
        };
        self.nodes.get(&Node { i: side(x, cell.at.i), j: side(y, cell.at.j) }).copied()
    }

    /// Cells to look up.
    pub fn index(&self) -> Index {
        Index { sizes: self.cells.iter().map(|cell| (cell.at, cell.size)).collect(), largest: 1 << self.grid.refine }
    }

    /// Share of the plane of each class: a corner stands for a quarter of its cell.
    pub fn shares(&self) -> Vec<(Class, f64)> {
        let mut quarters: Vec<(Class, u64)> = Vec::new();
        for cell in &self.cells {
            let area = u64::from(cell.size) * u64::from(cell.size);
            for (_, class) in cell.corners().iter().filter_map(|node| self.nodes.get(node)) {
                match quarters.iter_mut().find(|(known, _)| known == class) {
                    Some((_, sum)) => *sum += area,
                    None => quarters.push((*class, area)),
                }
            }
        }
        quarters.sort_unstable();
        let all: u64 = quarters.iter().map(|(_, area)| area).sum();
        quarters.into_iter().map(|(class, area)| (class, area as f64 / all.max(1) as f64)).collect()
    }
}

/// Cells by their corners.
#[derive(Clone, Debug)]
pub struct Index {
    sizes: FxHashMap<Node, u32>,
    largest: u32,
}

impl Index {
    /// The cell that holds a finest one.
    fn cell(&self, Node { i, j }: Node) -> Option<Cell> {
        let mut size = 1;
        while size <= self.largest {
            let at = Node { i: i / size * size, j: j / size * size };
            if self.sizes.get(&at) == Some(&size) {
                return Some(Cell { at, size });
            }
            size *= 2;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::{Grid, Map, Place, map};
    use std::convert::Infallible;
    use std::f64::consts::PI;

    fn of(grid: Grid, class: impl Fn(Place) -> usize) -> Map {
        let mut find = |places: &[Place]| -> Result<Vec<usize>, Infallible> { Ok(places.iter().map(|p| class(*p)).collect()) };
        let Ok(found) = map(grid, &mut find);
        found
    }

    fn circle([x, y]: Place) -> usize {
        usize::from((x - 0.48) * (x - 0.48) + (y - 0.53) * (y - 0.53) < 0.09)
    }

    #[test]
    fn a_circle_is_one_closed_line_to_the_accuracy_asked_for() {
        let grid = Grid { cells: 10, refine: 3, accuracy: 1e-6 };
        let found = of(grid, circle);
        assert_eq!(found.lines.len(), 1);
        let line = &found.lines[0];
        assert_eq!(line.points.first(), line.points.last());
        for [x, y] in &line.points {
            let radius = ((x - 0.48).powi(2) + (y - 0.53).powi(2)).sqrt();
            // an edge is cut at an angle: the radius is off by no more than the place along it
            assert!((radius - 0.3).abs() < 1e-6, "{x} {y}");
        }
        // the outside, class 0, on the left: clockwise, a negative area of π r² but for the chords
        let area: f64 = line.points.windows(2).map(|p| 0.5 * (p[0][0] * p[1][1] - p[1][0] * p[0][1])).sum();
        assert_eq!(line.sides, [0, 1]);
        // chords of a cell of 1/80 cut off its square over 12 r² of the area
        assert!((area + PI * 0.09).abs() < 1e-3, "{area}");
        let inside = found.shares()[1].1;
        // a finest cell along the circumference
        assert!((inside - PI * 0.09).abs() < 5e-3, "{inside}");
        // of the lattice; the halvings on its edges come to that
        assert!(found.nodes.len() < 81 * 81 / 3, "{}", found.nodes.len());
    }

    #[test]
    fn neighbours_of_a_boundary_are_refined_though_their_corners_agree() {
        // a tongue that holds the corner (0, 1/3) and enters the second coarse cell, from x = 1/3 on, between its corners
        let tongue = |[x, y]: Place| usize::from(x < 0.7 && (y - 0.4).abs() < 0.12 * (0.7 - x));
        let found = of(Grid { cells: 3, refine: 4, accuracy: 1e-5 }, tongue);
        let tip = found.lines.iter().flat_map(|line| &line.points).map(|p| p[0]).fold(0.0, f64::max);
        // narrower than a finest cell of 1/48 within 0.09 of its end, 0.7
        assert!(tip > 0.6, "{tip}");
    }

    #[test]
    fn three_classes_meet_in_a_junction_and_saddles_ask_their_middle() {
        let sectors = |[x, y]: Place| if y < 0.47 { 0 } else { 1 + usize::from(x > 0.51) };
        let found = of(Grid { cells: 5, refine: 2, accuracy: 1e-4 }, sectors);
        let mut sides: Vec<[usize; 2]> = found.lines.iter().map(|line| line.sides).collect();
        sides.sort_unstable();
        assert_eq!(sides, [[0, 1], [0, 2], [1, 2]]);
        // two quadrants of one class meet in the middle of a cell: both lines go on, none is lost
        let saddle = |[x, y]: Place| usize::from((x > 0.51) == (y > 0.52));
        let found = of(Grid { cells: 4, refine: 1, accuracy: 1e-4 }, saddle);
        let ends: usize = found.lines.iter().map(|line| line.points.len()).sum();
        assert!(found.lines.len() >= 2 && ends >= 14, "{:?}", found.lines);
        assert!(found.lines.iter().all(|line| line.sides == [0, 1]));
    }

    #[test]
    fn the_nearest_place_is_of_the_class_of_the_plane() {
        let found = of(Grid { cells: 8, refine: 3, accuracy: 1e-3 }, circle);
        let index = found.index();
        for place in [[0.0, 0.0], [1.0, 1.0], [0.48, 0.53], [0.3, 0.45], [0.9, 0.2]] {
            assert_eq!(found.nearest(&index, place).map(|(_, class)| class), Some(circle(place)));
        }
    }
}
