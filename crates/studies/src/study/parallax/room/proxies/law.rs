//! How a proxy's parameter follows the width of the lobe.

use lobefit_math::ops;

/// A parameter over alpha, the GGX width in (0, 1].
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[serde(rename_all = "lowercase", tag = "form")]
pub enum Law {
    /// The same for every width.
    Constant {
        /// The parameter.
        value: f64,
    },
    /// `over`/alpha^`power`, within [least, most].
    Inverse {
        /// The value at alpha = 1, where it is not below `least`.
        over: f64,
        /// Power of alpha: 1, 1.5 or 2.
        power: f64,
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
            // most where alpha^power is below over/most, so that nothing is divided by 0
            Law::Inverse { over, power, least, most } => {
                (over / ops::pow(alpha, power).max(over / most)).max(least)
            }
            Law::Power { scale, power, most } => (scale * ops::pow(alpha, power)).min(most),
        }
    }

    /// In a formula of alpha.
    pub fn formula(self) -> String {
        match self {
            Law::Constant { value } => format!("{value}"),
            Law::Inverse { over, power, least, most } => {
                let power = if power == 1.0 { String::new() } else { format!("^{power}") };
                format!("clamp({over} / alpha{power}, {least}, {most})")
            }
            Law::Power { scale, power, most } => format!("min({scale} alpha^{power}, {most})"),
        }
    }

    /// The same in a shader's arithmetic on f32.
    pub fn script(self) -> String {
        let single = |x: f64| format!("{:?}", x as f32);
        match self {
            Law::Constant { value } => single(value),
            Law::Inverse { over, power, least, most } => {
                let powered = match power {
                    1.0 => "alpha".to_string(),
                    1.5 => "alpha * sqrt(alpha)".to_string(),
                    2.0 => "alpha * alpha".to_string(),
                    _ => format!("pow(max(alpha, 0.000001), {})", single(power)),
                };
                format!("max({} / max({powered}, {}), {})", single(over), single(over / most), single(least))
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
