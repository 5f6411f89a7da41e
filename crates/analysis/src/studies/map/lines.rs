//! Boundaries of a map: the changes on the edges of its finest cells, joined to lines.
//!
//! A cell two of whose edges have a change is crossed by one piece. With three or four changes three classes meet, or two cross: then the class of its middle decides which corners hang
//! together, and where it is of none of them the pieces meet in the mean of the changes.

use super::plane::{Along, Cell, Class, Edge, Node, Place, Plane};
use std::collections::{BTreeMap, BTreeSet};

/// A boundary.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Class on its left and on its right, the smaller one first.
    pub sides: [Class; 2],
    /// Its points; the first again at the end where it is closed.
    pub points: Vec<Place>,
}

/// The edges of a finest cell: below, right, above, left.
fn edges(cell: Cell) -> [Edge; 4] {
    let [a, b, _, d] = cell.corners();
    [(a, Along::First), (b, Along::Second), (d, Along::First), (a, Along::Second)].map(|(at, along)| Edge { at, along })
}

/// Where a piece of a line ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum End {
    Edge(Edge),
    /// In the cell with this corner.
    Within(Node),
}

/// A piece of a line, the first class on its left.
struct Piece {
    sides: [Class; 2],
    ends: [End; 2],
}

/// Lines through cells with several classes, and the number of edges with a third class between their ends.
pub(super) fn joined<E>(plane: &mut Plane<'_, '_, E>, cells: &[Cell]) -> Result<(Vec<Line>, usize), E> {
    let changes = |plane: &Plane<'_, '_, E>, edge: &Edge| {
        let [a, b] = edge.ends().map(|node| plane.class(node));
        a != b
    };
    let all: BTreeSet<Edge> = cells.iter().flat_map(|cell| edges(*cell)).filter(|edge| changes(plane, edge)).collect();
    let list: Vec<Edge> = all.into_iter().collect();
    let found = plane.closed_in(&list)?;
    let narrow = found.iter().filter(|(_, third)| *third).count();
    let mut points: BTreeMap<End, Place> =
        list.iter().zip(&found).map(|(edge, (share, _))| (End::Edge(*edge), plane.on(*edge, *share))).collect();
    let crossed: Vec<(Cell, Vec<Edge>)> =
        cells.iter().map(|cell| (*cell, edges(*cell).into_iter().filter(|edge| changes(plane, edge)).collect())).collect();
    let saddles: Vec<Cell> = crossed.iter().filter(|(cell, cut)| cut.len() == 4 && meets(plane, *cell)).map(|(cell, _)| *cell).collect();
    let middles: Vec<Place> = saddles.iter().map(|cell| middle(plane, *cell)).collect();
    let middles: BTreeMap<Node, Class> = saddles.iter().map(|cell| cell.at).zip(plane.find(&middles)?).collect();
    let mut pieces = Vec::new();
    for (cell, cut) in &crossed {
        pieces.extend(through(plane, (*cell, cut), middles.get(&cell.at).copied(), &mut points));
    }
    Ok((lines(&pieces, &points), narrow))
}

/// Whether opposite corners are of one class.
fn meets<E>(plane: &Plane<'_, '_, E>, cell: Cell) -> bool {
    let [a, b, c, d] = cell.corners().map(|node| plane.class(node));
    a == c || b == d
}

fn middle<E>(plane: &Plane<'_, '_, E>, cell: Cell) -> Place {
    [cell.at.i, cell.at.j].map(|k| plane.share(f64::from(k) + 0.5))
}

/// The pieces through one cell.
fn through<E>(
    plane: &Plane<'_, '_, E>,
    (cell, cut): (Cell, &[Edge]),
    middle: Option<Class>,
    points: &mut BTreeMap<End, Place>,
) -> Vec<Piece> {
    let corners = cell.corners().map(|node| plane.class(node));
    let [below, right, above, left] = edges(cell);
    let pairs: Vec<[Edge; 2]> = match (cut, middle) {
        ([a, b], _) => vec![[*a, *b]],
        // the middle hangs together with the first corner and the third: the others are cut off
        (_, Some(class)) if Some(class) == corners[0] && corners[0] == corners[2] => vec![[below, right], [above, left]],
        (_, Some(class)) if Some(class) == corners[1] && corners[1] == corners[3] => vec![[left, below], [right, above]],
        _ => {
            let at = End::Within(cell.at);
            let own: Vec<Place> = cut.iter().filter_map(|edge| points.get(&End::Edge(*edge)).copied()).collect();
            let mean = |k: usize| own.iter().map(|p| p[k]).sum::<f64>() / own.len().max(1) as f64;
            points.insert(at, [mean(0), mean(1)]);
            return cut.iter().filter_map(|edge| piece(plane, *edge, at, points)).collect();
        }
    };
    pairs.into_iter().filter_map(|[a, b]| piece(plane, a, End::Edge(b), points)).collect()
}

/// A piece from an edge on, turned so that the smaller class lies on its left.
fn piece<E>(plane: &Plane<'_, '_, E>, from: Edge, to: End, points: &BTreeMap<End, Place>) -> Option<Piece> {
    let ends = from.ends();
    let [a, b] = [plane.class(ends[0])?, plane.class(ends[1])?];
    let (p, q) = (points.get(&End::Edge(from))?, points.get(&to)?);
    // which side the first end of the edge is on, by the sign of (q - p) × (end - p)
    let end = plane.place(ends[0]);
    let turn = (q[0] - p[0]) * (end[1] - p[1]) - (q[1] - p[1]) * (end[0] - p[0]);
    let forward = (turn > 0.0) == (a < b);
    let ends = [End::Edge(from), to];
    Some(Piece { sides: [a.min(b), a.max(b)], ends: if forward { ends } else { [ends[1], ends[0]] } })
}

/// Pieces one behind the other.
fn lines(pieces: &[Piece], points: &BTreeMap<End, Place>) -> Vec<Line> {
    let mut kinds: BTreeMap<[Class; 2], BTreeMap<End, Vec<usize>>> = BTreeMap::new();
    for (k, piece) in pieces.iter().enumerate() {
        kinds.entry(piece.sides).or_default().entry(piece.ends[0]).or_default().push(k);
    }
    let mut out = Vec::new();
    for (sides, mut starts) in kinds {
        let reached: BTreeSet<End> = pieces.iter().filter(|piece| piece.sides == sides).map(|piece| piece.ends[1]).collect();
        let open: Vec<End> = starts.keys().copied().filter(|end| !reached.contains(end)).collect();
        // first from ends that nothing leads to, then round closed lines
        for first in open {
            while let Some(line) = follow(first, pieces, &mut starts) {
                out.push(drawn(sides, &line, points));
            }
        }
        while let Some(first) = starts.iter().find(|(_, list)| !list.is_empty()).map(|(end, _)| *end) {
            out.extend(follow(first, pieces, &mut starts).map(|line| drawn(sides, &line, points)));
        }
    }
    out
}

/// The ends along a line from one on; none where no piece is left there.
fn follow(first: End, pieces: &[Piece], starts: &mut BTreeMap<End, Vec<usize>>) -> Option<Vec<End>> {
    let mut line = vec![first];
    let mut at = first;
    while let Some(k) = starts.get_mut(&at).and_then(Vec::pop) {
        at = pieces[k].ends[1];
        line.push(at);
        if at == first {
            break;
        }
    }
    (line.len() > 1).then_some(line)
}

fn drawn(sides: [Class; 2], line: &[End], points: &BTreeMap<End, Place>) -> Line {
    Line { sides, points: line.iter().filter_map(|end| points.get(end).copied()).collect() }
}
