//! Which conditions, reactions and balances of some equations are lowered, and which of them are solved together.

use crate::{Fault, Real, Spare};
use std::sync::Arc;
use symbolic::Equations;
use symbolic::connections::{Friction, Law};
use words::Text;

/// What takes part of the connections of some equations. A condition that repeats others is dropped together with the reaction that owns it.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Selection {
    /// Conditions that are equations.
    pub conditions: Vec<bool>,
    /// Reactions that are unknowns.
    pub reactions: Vec<bool>,
    /// Balances that are equations.
    pub balances: Vec<bool>,
    /// Conditions that take part, and of which some repeat others wherever the machine is.
    pub repeated: Option<Repeated>,
}

/// Conditions of which `count` repeat the others in every position, but not the same ones in every position: see [`crate::Spare`].
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Repeated {
    /// How many of them.
    pub count: usize,
    /// Conditions with a reaction: index, typical size of its gradient over `reach`.
    pub members: Vec<(usize, f64)>,
    /// Conditions without one, that hold together with the members.
    pub fixed: Vec<usize>,
    /// Typical size of the gradients by coordinate.
    pub reach: Vec<f64>,
}

impl Selection {
    /// Everything takes part.
    pub fn all(equations: &Equations) -> Selection {
        Selection {
            conditions: vec![true; equations.conditions.len()],
            reactions: vec![true; equations.reactions.len()],
            balances: vec![true; equations.balances.len()],
            repeated: None,
        }
    }
}

/// Rows and unknowns of the dynamics and of the supports, by index.
#[derive(Clone, Debug)]
pub(super) struct Arrangement {
    pub(super) conditions: Vec<usize>,
    /// Unknown in the dynamics.
    pub(super) solved: Vec<usize>,
    /// Balances among the rows of the dynamics.
    pub(super) joined: Vec<usize>,
    /// Supports that follow from `balances` afterwards.
    pub(super) supports: Vec<usize>,
    pub(super) balances: Vec<usize>,
    /// Rows of the dynamics of which some repeat others.
    pub(super) spare: Option<Arc<Spare>>,
}

impl Arrangement {
    /// *Errors*: P012 when equations and unknowns differ in number, P014 for a friction that is pressed by a reaction that was dropped.
    pub(super) fn new(equations: &Equations, selection: &Selection) -> Result<Arrangement, Fault> {
        let sizes = |a: usize, b: usize| if a == b { Ok(()) } else { Err(Fault::about("P012", format!("{a} != {b}"))) };
        sizes(selection.conditions.len(), equations.conditions.len())?;
        sizes(selection.reactions.len(), equations.reactions.len())?;
        sizes(selection.balances.len(), equations.balances.len())?;
        let chosen = |flags: &[bool]| -> Vec<usize> { (0..flags.len()).filter(|i| flags[*i]).collect() };
        let (conditions, reactions, balances) = (chosen(&selection.conditions), chosen(&selection.reactions), chosen(&selection.balances));
        for &r in &reactions {
            let owned = equations.reactions[r].law.condition();
            if owned.is_some_and(|c| selection.conditions.get(c) != Some(&true)) {
                return Err(Fault::about("P012", equations.reactions[r].name.clone()));
            }
            if let Some(lost) = pressing(equations, r).find(|k| selection.reactions.get(*k) != Some(&true)) {
                return Err(Fault::about("P014", equations.reactions.get(lost).map_or("?", |r| &r.name)));
            }
        }
        let support = |r: &usize| equations.reactions[*r].law.is_hidden();
        let joins = reactions.iter().any(|r| pressing(equations, *r).any(|k| support(&k)));
        let (supports, solved): (Vec<usize>, Vec<usize>) = reactions.iter().partition(|r| support(r) && !joins);
        let (joined, balances) = if joins { (balances, Vec::new()) } else { (Vec::new(), balances) };
        let mismatch = |rows: usize, unknowns: usize| {
            let en = format!("{rows} conditions for {unknowns} unknown reactions and motors");
            let ru = format!("условий {rows}, неизвестных реакций и моторов {unknowns}");
            if rows == unknowns { Ok(()) } else { Err(Fault::new("P012", &Text::new(en, ru))) }
        };
        mismatch(conditions.len() + joined.len(), solved.len())?;
        mismatch(balances.len(), supports.len())?;
        let spare = selection.repeated.as_ref().map(|repeated| {
            let columns = equations.coordinates.len();
            let row = |c: &usize| conditions.iter().position(|k| k == c).map(|row| row as u32);
            let unknown =
                |c: usize| solved.iter().position(|r| equations.reactions[*r].law.condition() == Some(c)).map(|k| (columns + k) as u32);
            let pair = |(c, size): &(usize, f64)| Some((row(c)?, unknown(*c)?, Real(*size)));
            Arc::new(Spare {
                count: repeated.count as u32,
                fixed: repeated.fixed.iter().filter_map(row).collect(),
                pairs: repeated.members.iter().filter_map(pair).collect(),
                columns: repeated.reach.iter().map(|r| Real(*r)).collect(),
            })
        });
        Ok(Arrangement { conditions, solved, joined, supports, balances, spare })
    }

    /// The balances that take part, wherever they stand.
    pub(super) fn kept(&self) -> &[usize] {
        if self.joined.is_empty() { &self.balances } else { &self.joined }
    }

    /// Their unknowns, in the order of the reactions.
    pub(super) fn hidden(&self, equations: &Equations) -> Vec<usize> {
        let all = if self.joined.is_empty() { &self.supports } else { &self.solved };
        all.iter().copied().filter(|r| equations.reactions[*r].law.is_hidden()).collect()
    }

    /// Whether the equations of motion stand alone.
    pub(super) fn is_free(&self) -> bool {
        self.solved.is_empty()
    }

    /// Names of the rows of the dynamics.
    pub(super) fn rows(&self, equations: &Equations, unknowns: &[String]) -> Vec<Text> {
        let conditions = self.conditions.iter().map(|c| equations.conditions[*c].name.clone());
        let motion = |a: &String| Text::new(format!("equation of motion for {a}"), format!("уравнение движения для {a}"));
        let motions = unknowns[..equations.coordinates.len()].iter().map(motion);
        conditions.chain(motions).chain(self.joined.iter().map(|b| equations.balances[*b].name.clone())).collect()
    }
}

/// Reactions that a friction's normal force consists of.
fn pressing(equations: &Equations, reaction: usize) -> impl Iterator<Item = usize> + '_ {
    let friction = friction_of(equations, reaction);
    friction.into_iter().flat_map(|f| f.components().flat_map(|n| n.terms.iter().map(|t| t.0)))
}

/// The law of a friction; none of other reactions.
pub(super) fn friction_of(equations: &Equations, reaction: usize) -> Option<&Friction> {
    match &equations.reactions.get(reaction)?.law {
        Law::Friction(friction) => Some(friction),
        _ => None,
    }
}
