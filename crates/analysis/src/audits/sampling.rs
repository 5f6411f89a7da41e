//! Which steps of a motion an audit looks at: all of the first so many, then every second, fourth, ... A long motion costs the logarithm of its steps, and its beginning is seen whole.

/// Counts the steps of a motion and what was looked at.
#[derive(Clone, Debug)]
pub struct Sampling {
    /// Looks before every second step is left out.
    looks: u64,
    steps: u64,
    stride: u64,
    taken: u64,
    known: bool,
}

impl Sampling {
    /// So many looks before every second step is left out.
    pub fn new(looks: u64) -> Sampling {
        Sampling { looks, steps: 0, stride: 1, taken: 0, known: true }
    }

    /// Nothing will be seen of this machine.
    pub fn give_up(&mut self) {
        self.known = false;
    }

    /// Whether this machine shows what is looked for.
    pub fn is_known(&self) -> bool {
        self.known
    }

    /// Whether anything was seen.
    pub fn has_seen(&self) -> bool {
        self.known && self.taken > 0
    }

    /// Counts a step that would not be looked at; false where it is to be looked at.
    pub fn passes_over(&mut self) -> bool {
        let over = !self.known || !self.steps.is_multiple_of(self.stride);
        self.steps += u64::from(over);
        over
    }

    /// Counts a step; whether it is to be looked at.
    pub fn takes(&mut self) -> bool {
        self.steps += 1;
        self.known && (self.steps - 1).is_multiple_of(self.stride)
    }

    /// Counts a look.
    pub fn note(&mut self) {
        self.taken += 1;
        if self.taken.is_multiple_of(self.looks) {
            self.stride *= 2;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Four looks at every step, four at every second, four at every fourth: 4 + 8 + 16 steps; asked beforehand or not, the same steps are taken.
    #[test]
    fn looks_grow_rarer_by_octaves() {
        let (mut at_once, mut asked) = (Sampling::new(4), Sampling::new(4));
        let seen: Vec<u64> = (0..28)
            .filter(|_| {
                let taken = at_once.takes();
                assert_eq!(taken, !asked.passes_over() && asked.takes());
                if taken {
                    at_once.note();
                    asked.note();
                }
                taken
            })
            .collect();
        assert_eq!(seen, [0, 1, 2, 3, 4, 6, 8, 10, 12, 16, 20, 24]);
        at_once.give_up();
        assert!(!at_once.takes() && !at_once.has_seen() && asked.has_seen());
    }
}
