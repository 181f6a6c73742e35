//! Tables of kernels, as the files that users write.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};

/// cos^n(theta), n = 1/(2 A) - 1/2, of some widths.
pub fn phong(widths: &[f64]) -> Value {
    let lobe = |&alpha: &f64| {
        let power = 0.5 / (alpha * alpha) - 0.5;
        let theta: Vec<f64> =
            (0..48).map(|i| f64::from(i * i) / 2209.0 * std::f64::consts::FRAC_PI_2).collect();
        let cosine = |theta: &f64| lobefit_math::ops::cos(*theta).max(0.0);
        let density: Vec<f64> = theta.iter().map(|t| lobefit_math::ops::pow(cosine(t), power)).collect();
        json!({"alpha": alpha, "theta": theta, "density": density})
    };
    json!({"schema_version": 1, "name": "phong", "lobes": widths.iter().map(lobe).collect::<Vec<_>>()})
}

/// Widths that cover what scenes ask for.
pub const WIDTHS: [f64; 6] = [0.04, 0.1, 0.2, 0.4, 0.65, 1.0];

/// Writes a file into a folder.
pub fn write(folder: &Path, name: &str, text: &Value) {
    fs::write(folder.join(name), text.to_string()).expect("a file");
}
