//! Integers in a text: bits of numbers, or fractions of a whole.

use half::f16;

use crate::foreign::{ForeignError, RawFormat, Spot, Step};

/// What kind of numbers they are, their values and step.
///
/// With a format stated, that is what they are. Without: integers up to 1 are numbers; hexadecimal
/// ones of 16 bits are halves if all are between -16 and 16, which unorms of a table that uses its
/// range are not; all else is refused as ambiguous.
pub(super) fn read(
    file: &str,
    at: Spot,
    name: &str,
    values: Vec<f64>,
    hex: bool,
    format: Option<RawFormat>,
) -> Result<(String, Vec<f64>, Step), ForeignError> {
    let refuse = |message: String| {
        let name = if name.is_empty() { "the list" } else { name };
        Err(ForeignError::encoding(file, at, name, &message))
    };
    let largest = values.iter().copied().fold(0.0, f64::max);
    let negative = values.iter().any(|v| *v < 0.0);
    if let Some(format) = format {
        let limit = match format {
            RawFormat::Unorm8 => 255.0,
            RawFormat::F16 | RawFormat::Unorm16 => 65535.0,
            RawFormat::F32 => f64::from(u32::MAX),
            RawFormat::F64 => return refuse("64-bit integers are not read as f64 exactly".into()),
        };
        if negative || largest > limit {
            return refuse(format!(
                "integers from {} to {largest} are no {}",
                values.iter().copied().fold(f64::INFINITY, f64::min),
                format.name()
            ));
        }
        let kind = format!("array of integers, read as {}", format.name());
        return Ok((kind, values.into_iter().map(|v| decode(v, format)).collect(), format.step()));
    }
    if largest <= 1.0 {
        return Ok(("array of integers".into(), values, Step::Decimals(0)));
    }
    let halves = || values.iter().all(|v| decode(*v, RawFormat::F16).abs() <= 16.0);
    if hex && !negative && largest <= 65535.0 && halves() {
        let values = values.into_iter().map(|v| decode(v, RawFormat::F16)).collect();
        return Ok(("array of hexadecimal halves".into(), values, Step::Half));
    }
    refuse(format!("integers up to {largest} may be bits of halves or singles, or fractions of a whole"))
}

/// The number that an integer in the format's range stands for.
fn decode(value: f64, format: RawFormat) -> f64 {
    match format {
        RawFormat::F16 => f16::from_bits(value as u16).to_f64(),
        RawFormat::F32 => f64::from(f32::from_bits(value as u32)),
        RawFormat::F64 => f64::from_bits(value as u64),
        RawFormat::Unorm8 => value / 255.0,
        RawFormat::Unorm16 => value / 65535.0,
    }
}
