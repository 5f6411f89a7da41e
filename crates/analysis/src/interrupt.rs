//! The flag by which a long calculation is asked from outside to end.

use std::sync::atomic::{AtomicBool, Ordering};

/// Whether the calculation is to end. Nothing else is read after the flag, so that its order among other memory does not matter.
pub fn is_set(interrupt: Option<&AtomicBool>) -> bool {
    interrupt.is_some_and(|flag| flag.load(Ordering::Relaxed))
}
