//! How a proxy's parameter follows the width of the lobe.

/// A parameter over alpha, the GGX width in (0, 1].
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[serde(rename_all = "lowercase", tag = "form")]
pub enum Law {
    /// The same for every width.
    Constant {
        /// The parameter.
        value: f64,
    },
    /// `over`/alpha, within [least, most].
    Inverse {
        /// The product of parameter and width.
        over: f64,
        /// Smallest value, for wide lobes.
        least: f64,
        /// Largest value, for narrow lobes.
        most: f64,
    },
    /// `scale` alpha^`power`, at most `most`.
    Power {
        /// Value at alpha = 1, where it is not above `most`.
        scale: f64,
        /// Power of alpha.
        power: f64,
        /// Largest value.
        most: f64,
    },
}

impl Law {
    /// The parameter of a width; finite, also at alpha = 0.
    pub fn at(self, alpha: f64) -> f64 {
        match self {
            Law::Constant { value } => value,
            // most where alpha is below over/most, so that nothing is divided by 0
            Law::Inverse { over, least, most } => (over / alpha.max(over / most)).max(least),
            Law::Power { scale, power, most } => (scale * crate::math::ops::pow(alpha, power)).min(most),
        }
    }

    /// In a formula of alpha.
    pub fn formula(self) -> String {
        match self {
            Law::Constant { value } => format!("{value}"),
            Law::Inverse { over, least, most } => format!("clamp({over} / alpha, {least}, {most})"),
            Law::Power { scale, power, most } => format!("min({scale} alpha^{power}, {most})"),
        }
    }

    /// The same in a shader's arithmetic on f32.
    pub fn script(self) -> String {
        let single = |x: f64| format!("{:?}", x as f32);
        match self {
            Law::Constant { value } => single(value),
            Law::Inverse { over, least, most } => {
                format!("max({} / max(alpha, {}), {})", single(over), single(over / most), single(least))
            }
            Law::Power { scale, power, most } => {
                format!(
                    "min({} * pow(max(alpha, 0.000001), {}), {})",
                    single(scale),
                    single(power),
                    single(most)
                )
            }
        }
    }
}
