//! Bounds on any file of text. They bound time and memory before either is spent.

/// Largest file, bytes.
pub const FILE_BYTES: u64 = 16 << 20;
/// Deepest nesting of objects and arrays, or of elements.
pub const DEPTH: usize = 64;
/// Longest string or key of a scene, in bytes as written between its quotes.
pub const STRING_BYTES: usize = 4096;
