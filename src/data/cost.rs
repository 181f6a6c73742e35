//! What an approximation takes at run time.

use serde::{Deserialize, Serialize};

/// Run-time cost by the project's operation model.
///
/// add, mul, fma, min, max, compare, select 1; rcp, sqrt, exp2 4; a division is rcp + mul; exp 5, pow 9; saturate,
/// negate 0; common subexpressions once; a mul fuses into a following add; roughness and alpha are both given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Cost {
    /// Weighted arithmetic operations.
    pub ops: u32,
    /// Texture fetches.
    pub fetches: u32,
    /// Bytes of texels to keep resident.
    pub bytes: u64,
}
