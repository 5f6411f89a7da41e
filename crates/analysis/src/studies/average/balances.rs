//! Speeds of steady turning: zeros of L = N - V on the branches of the rest's answers, and where two of them meet over a parameter.
//!
//! On a branch L is a function of one length. Followed over a parameter, an extreme of it passes zero where two balances meet (a fold).

use super::follow::{self, Branch, Followed, Point, Ruler, Walker};
use super::settled::settles;
use super::turn::{MET, ROUNDING, Turn, Turning, turn};
use crate::marks::bracketed;
use algebra::arrange::Arrange;

/// Speeds that are one balance, relative: both are closed in to rounding.
const ONE: f64 = 1e-9;
/// Longest reach from an extreme, in scales: a branch is straight over less.
const REACH: f64 = 0.1;
/// Moves towards an extreme, and halvings of a reach in which there is no answer.
const MOVES: usize = 60;
const HALVINGS: usize = 20;
/// Share of the reach to which an extreme is closed in by parabolas: L is flat there, and the next digit of it would be rounding.
const CLOSED_IN: f64 = 1e-3;
/// How much narrower each parabola is.
const NARROWER: f64 = 0.2;
/// Share of the slopes beside an extreme to which that of L is closed in: the height then errs by the square of it.
const FLAT: f64 = 1e-6;
/// Share of the moments below which a slope of L is rounding: that of L over the step of the slope.
const LEVEL: f64 = 1e-7;
/// Share of the smaller slope of L beside an interval by which its mean slope may differ from theirs: what is between them then has no two extremes more.
const STEADY: f64 = 0.05;
/// Share of the larger one below which it may always: a pair of extremes as flat as that lies within it.
const BENT: f64 = 1e-3;
/// Share of the moments below which a difference of L is rounding: some times what two numbers of instants differ by.
const SEEN: f64 = 1e-9;
/// Halvings of an interval in which L is not resolved.
const DEPTH: usize = 16;
/// Newton's steps to an extreme of a machine whose numbers have changed a little.
const NEWTON: usize = 12;

/// A speed at which the moments balance.
#[derive(Clone, Debug, PartialEq)]
pub struct Steady {
    /// The turn.
    pub turn: Turn,
    /// Whether L falls there, and disturbances of the rest die away.
    pub stable: bool,
    /// The branch on which it lies.
    pub branch: usize,
}

/// Branches of answers with the balances on them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Course {
    /// Answers of the rest over the speed.
    pub branches: Vec<Branch>,
    /// Balances by ascending speed.
    pub steady: Vec<Steady>,
    /// From how many starts other answers were sought; none where the rest is linear and has one at each speed.
    pub starts: Option<usize>,
    /// Speeds on and beside resonances at which there is no answer.
    pub unseen: usize,
    /// Extremes of L along the branches.
    pub summits: Vec<Summit>,
    ruler: Ruler,
}

/// Balances on all branches that the turns at ascending speeds, and starts of other sizes, lead to.
pub fn steady<T: Turning + ?Sized>(machine: &T, speeds: &[f64], found: &[Option<Turn>]) -> Course {
    let Followed { branches, starts, unseen, ruler } = follow::all(machine, speeds, found);
    balances(machine, Course { branches, starts, unseen, ruler, ..Course::default() })
}

/// Balances on the branches of another machine whose rest has the same equations; none where a branch is not one of this machine.
pub fn steady_again<T: Turning + ?Sized>(machine: &T, known: &Course) -> Option<Course> {
    let walker = Walker::new(machine, &known.ruler);
    let branches = known.branches.iter().map(|branch| walker.told_again(branch)).collect::<Option<Vec<Branch>>>()?;
    Some(balances(
        machine,
        Course { branches, starts: known.starts, unseen: known.unseen, ruler: known.ruler.clone(), ..Course::default() },
    ))
}

/// Adds balances and extremes to the branches.
fn balances<T: Turning + ?Sized>(machine: &T, mut course: Course) -> Course {
    let walker = Walker::new(machine, &course.ruler);
    let way = Way { machine, walker: &walker, linear: course.starts.is_none() };
    let mut list: Vec<Steady> = Vec::new();
    for branch in &mut course.branches {
        branch.points = way.refined(std::mem::take(&mut branch.points));
    }
    for (which, branch) in course.branches.iter().enumerate() {
        for pair in branch.points.windows(2) {
            let summit = way.summit(&pair[0], &pair[1]);
            let points: Vec<&Point> = [&pair[0]].into_iter().chain(summit.as_ref().map(|summit| &summit.point)).chain([&pair[1]]).collect();
            for part in points.windows(2) {
                let Some(point) = way.balance(part[0], part[1]).filter(|point| course.ruler.covers(point.turn.speed)) else { continue };
                let known =
                    |s: &Steady| (s.turn.speed - point.turn.speed).abs() <= ONE * s.turn.speed.abs() && !s.turn.differs(&point.turn);
                if !list.iter().any(known) {
                    let falls = (point.slope < 0.0) == (point.forwards() > 0.0);
                    let stable = falls && settles(machine, &point.turn) != Some(false);
                    list.push(Steady { turn: point.turn, stable, branch: which });
                }
            }
            course.summits.extend(summit);
        }
    }
    list.arrange_by(|a, b| a.turn.speed.total_cmp(&b.turn.speed));
    course.steady = list;
    course
}

/// The way between neighbours of a branch.
struct Way<'a, T: ?Sized> {
    machine: &'a T,
    walker: &'a Walker<'a, T>,
    /// A linear rest has one answer at each speed.
    linear: bool,
}

impl<T: Turning + ?Sized> Way<'_, T> {
    /// The answer at a share of the way.
    fn at(&self, [a, b]: [&Point; 2], share: f64) -> Option<Point> {
        if !self.linear {
            return self.walker.between(a, b, share);
        }
        let speed = a.turn.speed + share * (b.turn.speed - a.turn.speed);
        self.walker.at(turn(self.machine, speed, Some(&a.turn))?, if b.turn.speed < a.turn.speed { -1.0 } else { 1.0 })
    }

    /// L at a share of the way.
    fn left(&self, [a, b]: [&Point; 2], share: f64) -> Option<f64> {
        if !self.linear {
            return self.walker.balance_between(a, b, share);
        }
        let speed = a.turn.speed + share * (b.turn.speed - a.turn.speed);
        turn(self.machine, speed, Some(&a.turn)).map(|turn| turn.balance())
    }

    /// The points of a branch with others between neighbours, until L and its slopes agree: two extremes of L between two neighbours show in neither of their slopes.
    fn refined(&self, points: Vec<Point>) -> Vec<Point> {
        let mut list: Vec<Point> = Vec::with_capacity(points.len());
        for point in points {
            if let Some(last) = list.last().cloned() {
                self.fill(&mut list, [&last, &point], DEPTH);
            }
            list.push(point);
        }
        list
    }

    fn fill(&self, list: &mut Vec<Point>, [a, b]: [&Point; 2], depth: usize) {
        if depth == 0 || self.resolves(a, b) {
            return;
        }
        let Some(middle) = self.at([a, b], 0.5) else { return };
        self.fill(list, [a, &middle], depth - 1);
        list.push(middle.clone());
        self.fill(list, [&middle, b], depth - 1);
    }

    /// Whether the change of L over an interval is that of the slopes at its ends.
    fn resolves(&self, a: &Point, b: &Point) -> bool {
        let slopes = [a, b].map(|point| {
            let along = if self.linear {
                (b.turn.speed - a.turn.speed) / self.walker.range() / point.forwards()
            } else {
                self.walker.distance(a, b)
            };
            point.slope * along
        });
        let [small, large] = [slopes[0].abs().min(slopes[1].abs()), slopes[0].abs().max(slopes[1].abs())];
        let off = (b.turn.balance() - a.turn.balance() - 0.5 * (slopes[0] + slopes[1])).abs();
        let size = [a, b].iter().map(|point| point.turn.own.abs().max(point.turn.vibration.abs())).fold(0.0, f64::max);
        off.is_nan() || off <= (STEADY * small).max(BENT * large).max((SEEN + a.turn.doubt.max(b.turn.doubt)) * size)
    }

    /// The balance between two neighbours of which the moments have unlike signs.
    fn balance(&self, a: &Point, b: &Point) -> Option<Point> {
        let balance = |point: &Point| point.turn.balance();
        if (balance(a) > 0.0) == (balance(b) > 0.0) {
            return None;
        }
        let size = |turn: &Turn| turn.own.abs().max(turn.vibration.abs());
        let met = |turn: &Turn| turn.balance().abs() <= MET * size(&a.turn).max(size(&b.turn)) + ROUNDING * turn.greatest;
        let left = |share: f64| self.left([a, b], share).unwrap_or(f64::NAN);
        let share = bracketed(&mut |share| left(share), (0.0, balance(a)), (1.0, balance(b)));
        // where the moments are unlike on both sides they balance nowhere
        self.at([a, b], share).filter(|point| met(&point.turn))
    }

    /// The extreme of L between two neighbours of which its slopes have unlike signs.
    fn summit(&self, a: &Point, b: &Point) -> Option<Summit> {
        let largest = a.slope.abs().max(b.slope.abs());
        let rounding = LEVEL * [a, b].iter().map(|point| point.turn.greatest.max(point.turn.own.abs())).fold(0.0, f64::max);
        if (a.slope > 0.0) == (b.slope > 0.0) || largest <= rounding {
            return None;
        }
        let sign = if a.slope > 0.0 { 1.0 } else { -1.0 };
        let reach = (0.5 * self.walker.distance(a, b)).min(REACH * self.walker.size(a));
        let height = |point: &Point| sign * point.turn.balance();
        let above = |point: &Point| height(point) >= height(a).max(height(b));
        let flat = |point: Point| if point.slope.abs() <= FLAT * largest { 0.0 } else { point.slope };
        let slope = |share: f64| self.at([a, b], share).map_or(f64::NAN, flat);
        let share = bracketed(&mut |share| slope(share), (0.0, a.slope), (1.0, b.slope));
        let point = self.at([a, b], share).filter(above);
        let by_parabolas = || {
            let higher = if height(a) > height(b) { a } else { b };
            climbed(self.walker, Summit { point: higher.clone(), sign, reach, bend: f64::NAN })
        };
        match point {
            Some(point) => {
                // the slope changes its sign over the way
                let bend = (b.slope - a.slope) / (2.0 * reach);
                Some(Summit { point, sign, reach, bend })
            }
            None => by_parabolas(),
        }
    }
}

/// An extreme of L on a branch.
#[derive(Clone, Debug, PartialEq)]
pub struct Summit {
    point: Point,
    /// 1 of a greatest value, -1 of a least one.
    sign: f64,
    reach: f64,
    /// How fast the slope of L changes along the branch.
    bend: f64,
}

impl Summit {
    /// How far L is from zero on its side: positive between two balances, negative where both are gone.
    pub fn height(&self) -> f64 {
        self.sign * self.point.turn.balance()
    }

    /// The turn there.
    pub fn turn(&self) -> &Turn {
        &self.point.turn
    }
}

/// An extreme of a machine whose numbers have changed a little; none where there is no answer beside it.
pub fn carried<T: Turning + ?Sized>(machine: &T, course: &Course, from: &Summit) -> Option<Summit> {
    let walker = Walker::new(machine, &course.ruler);
    let point = walker.beside(&from.point, 0.0)?;
    let summit = Summit { point, ..from.clone() };
    flattened(&walker, summit.clone()).or_else(|| climbed(&walker, summit))
}

/// Newton's method for the slope of L, of which the derivative is that of the steps; none where it leads away.
fn flattened<T: Turning + ?Sized>(walker: &Walker<'_, T>, mut summit: Summit) -> Option<Summit> {
    for _ in 0..NEWTON {
        let by = -summit.point.slope / summit.bend;
        if !(by.abs() <= summit.reach && summit.sign * summit.bend < 0.0) {
            return None;
        }
        if by.abs() <= FLAT * summit.reach {
            return Some(summit);
        }
        let next = walker.beside(&summit.point, by)?;
        let bend = (next.slope - summit.point.slope) / by;
        summit = Summit { point: next, bend, ..summit };
    }
    None
}

fn climbed<T: Turning + ?Sized>(walker: &Walker<'_, T>, from: Summit) -> Option<Summit> {
    let height = |point: &Point| from.sign * point.turn.balance();
    let (mut point, mut reach, mut halved) = (from.point.clone(), from.reach, 0);
    for _ in 0..MOVES {
        let [Some(before), Some(behind)] = [-reach, reach].map(|s| walker.beside(&point, s)) else {
            halved += 1;
            if halved > HALVINGS {
                return None;
            }
            reach *= 0.5;
            continue;
        };
        let [a, here, b] = [&before, &point, &behind].map(height);
        if a > here.max(b) {
            point = before;
        } else if b > here {
            point = behind;
        } else {
            // the top of the parabola through three values
            let top = 0.5 * reach * (a - b) / (a - 2.0 * here + b);
            if let Some(next) =
                Some(top).filter(|s| s.is_finite()).and_then(|s| walker.beside(&point, s)).filter(|next| height(next) >= here)
            {
                point = next;
            }
            if reach <= CLOSED_IN * from.reach {
                return Some(Summit { point, ..from });
            }
            reach *= NARROWER;
        }
    }
    None
}
