//! The effect `sheen`: the rim of cloth. Quantity `sheen-charlie`.

mod catalogue;

pub use catalogue::RIVALS;
