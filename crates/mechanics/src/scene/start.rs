//! Values at the start of the motion, as expressions.

use super::Scene;
use crate::model::Class;
use symbolic::{Expr, Substitution, SymbolId};

/// The value of an expression of the element `user` at the start of the motion.
pub fn at_start(scene: &mut Scene, user: &str, e: Expr) -> Expr {
    let used = scene.graph.symbols_in(&[e]);
    let coordinates = &scene.model.coordinates;
    let used: Vec<usize> = (0..coordinates.len()).filter(|j| used.contains(&coordinates[*j].symbols[0])).collect();
    let places = used.into_iter().map(|j| (coordinates[j].symbols[0], scene.place_at_start(j, user))).collect();
    put_start(scene, places, e)
}

/// The same at the values of the file, guesses as they are: for choices that are the same around it.
pub fn near_start(scene: &mut Scene, e: Expr) -> Expr {
    let places = scene.model.coordinates.iter().map(|c| (c.symbols[0], c.start)).collect();
    put_start(scene, places, e)
}

fn put_start(scene: &mut Scene, places: Vec<(SymbolId, Expr)>, e: Expr) -> Expr {
    let model = scene.model;
    let zero = scene.graph.zero();
    // formulas of time at t = 0, each over constants and earlier ones
    let mut map: Vec<(SymbolId, Expr)> = vec![(model.time, zero)];
    for parameter in model.parameters.iter().filter(|p| p.class == Class::Time) {
        let value = Substitution::new(map.iter().copied()).apply(&mut scene.graph, parameter.value.expr());
        map.push((parameter.symbol, value));
    }
    map.extend(scene.turns.iter().map(|t| (t.symbol, zero)));
    map.extend(places);
    Substitution::new(map).apply(&mut scene.graph, e)
}
