//! Floor 4: tables and fits to bytes, one file per format.

pub mod code;
