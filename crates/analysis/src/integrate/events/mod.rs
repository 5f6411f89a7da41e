//! What holds after an event: impacts, and the modes of the next step.

mod contacts;
mod impacts;
mod modes;
mod nearest;
mod rivals;
mod sides;
