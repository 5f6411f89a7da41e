//! Ordering by dependence.

/// Items in their own order, except that each comes after what it depends on; and the cycles found. Items of a cycle are in the order
/// too. Iterative: a chain of a hundred thousand items does not exhaust the stack.
pub(super) fn topological(dependencies: &[Vec<usize>]) -> (Vec<usize>, Vec<Vec<usize>>) {
    #[derive(Clone, Copy, PartialEq)]
    enum State {
        New,
        Open,
        Done,
    }
    let n = dependencies.len();
    let mut state = vec![State::New; n];
    let (mut order, mut cycles) = (Vec::with_capacity(n), Vec::new());
    let mut path: Vec<(usize, usize)> = Vec::new();
    for root in 0..n {
        if state[root] != State::New {
            continue;
        }
        path.push((root, 0));
        state[root] = State::Open;
        while let Some((item, next)) = path.last_mut() {
            let Some(&child) = dependencies[*item].get(*next) else {
                state[*item] = State::Done;
                order.push(*item);
                path.pop();
                continue;
            };
            *next += 1;
            match state[child] {
                State::Done => {}
                State::New => {
                    state[child] = State::Open;
                    path.push((child, 0));
                }
                State::Open => {
                    let start = path.iter().position(|p| p.0 == child).unwrap_or(0);
                    // the search for the start of a cycle costs its length; many long cycles need not all be shown
                    if cycles.len() < 20 {
                        cycles.push(path[start..].iter().map(|p| p.0).collect());
                    }
                }
            }
        }
    }
    (order, cycles)
}

#[cfg(test)]
mod tests {
    use super::topological;

    #[test]
    fn order_is_kept_where_it_can_be() {
        assert_eq!(topological(&[vec![], vec![3], vec![], vec![]]).0, [0, 3, 1, 2]);
    }

    #[test]
    fn cycles_are_found_and_long_chains_survive() {
        assert_eq!(topological(&[vec![1], vec![2], vec![0]]).1, [[0, 1, 2]]);
        assert_eq!(topological(&[vec![0]]).1, [[0]]);
        let chain: Vec<Vec<usize>> = (0..200_000).map(|i| if i < 199_999 { vec![i + 1] } else { vec![] }).collect();
        assert_eq!(topological(&chain).0[0], 199_999);
    }
}
