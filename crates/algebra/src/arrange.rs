//! Stable order of lists that are sorted seldom.
//!
//! `sort_by` is compiled for each type of entry and each comparison again, some six thousand bytes a place. Here positions are sorted, by one code for all, and the entries follow: the order is the
//! same. Lists of an inner loop, and numbers alone, are better off with `sort_by`.

use std::cmp::Ordering;

/// Sorting by positions.
pub trait Arrange<T> {
    /// As `sort_by`.
    fn arrange_by(&mut self, compare: impl FnMut(&T, &T) -> Ordering);
    /// As `sort_by_key`.
    fn arrange_by_key<K: Ord>(&mut self, key: impl FnMut(&T) -> K);
}

impl<T> Arrange<T> for [T] {
    fn arrange_by(&mut self, mut compare: impl FnMut(&T, &T) -> Ordering) {
        if self.len() < 2 {
            return;
        }
        let order = positions(self.len(), &mut |i, j| compare(&self[i], &self[j]));
        follow(order, &mut |i, j| self.swap(i, j));
    }
    fn arrange_by_key<K: Ord>(&mut self, mut key: impl FnMut(&T) -> K) {
        self.arrange_by(|a, b| key(a).cmp(&key(b)));
    }
}

/// Which entry comes first, second, ...
#[inline(never)]
fn positions(n: usize, compare: &mut dyn FnMut(usize, usize) -> Ordering) -> Vec<usize> {
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|i, j| compare(*i, *j));
    order
}

/// Puts entry `order[i]` at place i, each cycle of the permutation from its first place on.
#[inline(never)]
fn follow(mut order: Vec<usize>, swap: &mut dyn FnMut(usize, usize)) {
    for first in 0..order.len() {
        let mut place = first;
        loop {
            let from = std::mem::replace(&mut order[place], place);
            if from == first {
                break;
            }
            swap(place, from);
            place = from;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn the_order_is_that_of_the_standard_library() {
        let mut random = Random::new(7);
        for n in (0..40).chain([1000]) {
            // few keys: equal ones keep their order
            let list: Vec<(u64, usize)> = (0..n).map(|i| (random.bits() % 9, i)).collect();
            let [mut by, mut by_key, mut expected] = [list.clone(), list.clone(), list];
            by.arrange_by(|a, b| b.0.cmp(&a.0));
            expected.sort_by_key(|entry| std::cmp::Reverse(entry.0));
            assert_eq!(by, expected);
            by_key.arrange_by_key(|entry| entry.0);
            expected.sort_by_key(|entry| (entry.0, entry.1));
            assert_eq!(by_key, expected);
        }
    }
}
