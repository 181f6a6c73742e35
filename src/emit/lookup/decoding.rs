//! The decoding of a texel as the lines of a function, in what the languages have in common.

use crate::data::Decode;

/// Lines of a function's body, and what it returns.
pub(super) struct Body {
    /// Names and values of what it computes first.
    pub lets: Vec<(String, String)>,
    /// The values returned: one, or three of a vector.
    pub values: Vec<String>,
    /// What the values are, in words.
    pub meaning: &'static str,
}

impl Body {
    /// All its values.
    pub fn text(self) -> String {
        self.lets.into_iter().map(|(_, value)| value).chain(self.values).collect::<Vec<_>>().join("\n")
    }
}

/// The body for a texel whose channel `i` is written `part(i)`; the arithmetic in which tables are measured.
pub(super) fn body(decode: Decode, part: impl Fn(usize) -> String) -> Body {
    let of = |lets: &[(&str, &str)], values: &[&str]| Body {
        lets: lets.iter().map(|(name, value)| (name.to_string(), value.to_string())).collect(),
        values: values.iter().map(ToString::to_string).collect(),
        meaning: if values.len() == 1 { "E" } else { "E, A and B" },
    };
    match decode {
        Decode::Albedo => of(&[], &[&part(0)]),
        Decode::Loss => of(&[], &[&format!("1.0 - {}", part(0))]),
        Decode::AzimuthCubic => of(
            &[
                ("q", "1.0 - 0.9 * anisotropy"),
                ("spread", "cos2_phi / q + (1.0 - cos2_phi) * q"),
                ("t", "log2(spread) / max(-log2(q), 1e-6)"),
            ],
            &[&format!("1.0 - ({} + t * ({} + t * ({} + t * {})))", part(0), part(1), part(2), part(3))],
        ),
        Decode::SplitSum => of(&[], &[&format!("{} + {}", part(0), part(1)), &part(0), &part(1)]),
        Decode::LossBias => of(
            &[
                ("e", &format!("1.0 - {}", part(0))),
                ("x", "1.0 - mu"),
                ("x2", "x * x"),
                ("b", &format!("e * ({} + x2 * x2 * x)", part(1))),
            ],
            &["e", "e - b", "b"],
        ),
    }
}
