//! The decoding of a texel as the lines of a function, in what WGSL and Rust have in common.

use crate::data::Decode;

/// Lines of a function's body, and what it returns.
pub(super) struct Body {
    /// Lines before the last.
    pub lets: Vec<String>,
    /// The values returned: one, or three of a vector.
    pub values: Vec<String>,
    /// What the values are, in words.
    pub meaning: &'static str,
}

impl Body {
    /// All its lines.
    pub fn lines(self) -> impl Iterator<Item = String> {
        self.lets.into_iter().chain(self.values)
    }

    /// Type returned.
    pub fn result(&self, vector: impl Fn(usize) -> String) -> String {
        if self.values.len() == 1 { "f32".into() } else { vector(self.values.len()) }
    }
}

/// The body for a texel whose channel `i` is written `part(i)`; the arithmetic in which tables are measured.
pub(super) fn body(decode: Decode, part: impl Fn(usize) -> String) -> Body {
    let of = |lets: &[String], values: &[&str]| Body {
        lets: lets.to_vec(),
        values: values.iter().map(ToString::to_string).collect(),
        meaning: if values.len() == 1 { "E" } else { "E, A and B" },
    };
    match decode {
        Decode::Albedo => of(&[], &[&part(0)]),
        Decode::Loss => of(&[], &[&format!("1.0 - {}", part(0))]),
        Decode::AzimuthCubic => of(
            &[
                "let q = 1.0 - 0.9 * anisotropy;".into(),
                "let spread = cos2_phi / q + (1.0 - cos2_phi) * q;".into(),
                "let t = log2(spread) / max(-log2(q), 1e-6);".into(),
            ],
            &[&format!("1.0 - ({} + t * ({} + t * ({} + t * {})))", part(0), part(1), part(2), part(3))],
        ),
        Decode::SplitSum => of(&[], &[&format!("{} + {}", part(0), part(1)), &part(0), &part(1)]),
        Decode::LossBias => of(
            &[
                format!("let e = 1.0 - {};", part(0)),
                "let x = 1.0 - mu;".into(),
                "let x2 = x * x;".into(),
                format!("let b = e * ({} + x2 * x2 * x);", part(1)),
            ],
            &["e", "e - b", "b"],
        ),
    }
}
