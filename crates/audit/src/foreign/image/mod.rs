//! Files with a header: images, textures, arrays.

pub(super) mod dds;
mod dxgi;
pub(super) mod exr;
pub(super) mod hdr;
pub(super) mod ktx2;
pub(super) mod npy;
mod packed;
pub(super) mod png;
mod vulkan;

use self::packed::{Pixels, Source};
use super::shape::{finish, stated, words};
use super::{Channel, ForeignError, ForeignTable, Hints, Step, limits};

/// What a header tells of a table, x fastest.
struct Image {
    /// File as the caller named it.
    file: String,
    /// Name of the layer, or empty.
    name: String,
    /// Format in words: `EXR, half`.
    kind: String,
    /// Texels along each axis.
    size: Vec<usize>,
    channels: Vec<Channel>,
    step: Step,
    /// What the file says of itself, or nothing.
    note: String,
}

impl Image {
    /// The table of texels that lie one after another in a file that names no layers.
    fn packed(
        source: Source,
        kind: String,
        size: &[u64],
        (pixels, texels): (Pixels, &[u8]),
        hints: &Hints,
    ) -> Result<Vec<ForeignTable>, ForeignError> {
        let image = Image {
            file: source.file.into(),
            name: String::new(),
            kind,
            size: size.iter().map(|n| *n as usize).collect(),
            channels: pixels.channels(texels),
            step: pixels.step(),
            note: String::new(),
        };
        Ok(vec![image.table(hints)?])
    }

    /// The table, its slices taken out of their atlas if the caller says that there are any.
    fn table(self, hints: &Hints) -> Result<ForeignTable, ForeignError> {
        let Image { file, name, kind, size, mut channels, step, note } = self;
        let found = size.iter().product();
        let wrong = |message: String| ForeignError::size(&file, &name, found, &message);
        if let Some(asked) = hints.channels.filter(|asked| *asked != channels.len()) {
            let message = format!("have {} channels each, not {asked}: leave the number out", channels.len());
            return Err(wrong(message));
        }
        let mut size = flattened(size);
        if let Some(asked) = &hints.size {
            let texels = stated(&file, asked)?;
            let atlas = match (&size[..], &asked[..]) {
                ([width, height], [x, y, z]) => Some([*width, *height, *x, *y, *z]),
                ([length], [x, y, z]) => Some([*length, 1, *x, *y, *z]),
                _ => None,
            };
            if texels != found {
                let message = format!(
                    "are {} texels, not {}: state another size (x first)",
                    words(&size),
                    words(asked)
                );
                return Err(wrong(message));
            }
            match atlas {
                _ if flattened(asked.clone()) == size => {}
                Some([width, height, x, y, _]) if width.is_multiple_of(x) && height.is_multiple_of(y) => {
                    channels.iter_mut().for_each(|c| c.values = slices(&c.values, width, x, y).into());
                }
                _ if size.len() == 1 => {}
                _ => {
                    let message = format!("are {} texels, no tiles of {}", words(&size), words(asked));
                    return Err(wrong(message));
                }
            }
            size = asked.clone();
        }
        Ok(ForeignTable { note, ..finish(&file, name, &kind, size, channels, step)? })
    }
}

/// The size without axes of one texel at its end.
fn flattened(mut size: Vec<usize>) -> Vec<usize> {
    while size.len() > 1 && size.last() == Some(&1) {
        size.pop();
    }
    size
}

/// The texels of an atlas of tiles of x by y, tile after tile.
fn slices(values: &[f64], width: usize, x: usize, y: usize) -> Vec<f64> {
    let across = width / x;
    let tiles = values.len() / (x * y);
    let mut out = Vec::with_capacity(values.len());
    for tile in 0..tiles {
        let (left, top) = (tile % across * x, tile / across * y);
        for row in top..top + y {
            out.extend_from_slice(&values[row * width + left..][..x]);
        }
    }
    out
}

/// Texels of a size that a header claims, times channels: refused beyond the limit, before anything
/// is allocated.
fn claimed(file: &str, size: &[u64], channels: u64) -> Result<usize, ForeignError> {
    let product = |n: u128, &side: &u64| n.checked_mul(u128::from(side));
    let found = size.iter().chain([&channels]).try_fold(1, product).unwrap_or(u128::MAX);
    if found > limits::VALUES as u128 || channels > limits::CHANNELS as u64 {
        let sides: Vec<String> = size.iter().map(u64::to_string).collect();
        let what = format!("values of {} texels of {channels} channels", sides.join(" x "));
        let error = ForeignError::too_large(file, &what, found, limits::VALUES);
        return Err(if channels > limits::CHANNELS as u64 {
            error
        } else {
            error.beside(&largest(size, channels))
        });
    }
    Ok(found as usize)
}

/// The largest table of as many equal sides and channels that is read.
fn largest(size: &[u64], channels: u64) -> String {
    let long = size.iter().filter(|side| **side > 1).count().max(1) as u32;
    let most = limits::VALUES as u64 / channels.max(1);
    // Of floating-point roots one may lie just above.
    let near = lobefit_math::ops::pow(most as f64, 1.0 / f64::from(long)).round() as u64;
    let side = if near.saturating_pow(long) > most { near - 1 } else { near };
    let sides = vec![side.to_string(); long as usize].join(" x ");
    format!("of so many channels {sides} texels are the most: make it smaller, or leave channels out")
}

/// Runs a reader of another crate: if it fails in a way that it does not foresee, that is an error
/// like any other.
fn guarded<T>(
    file: &str,
    reader: &str,
    read: impl FnOnce() -> Result<T, ForeignError>,
) -> Result<T, ForeignError> {
    std::panic::catch_unwind(std::panic::AssertUnwindSafe(read)).unwrap_or_else(|_| {
        let message = format!("the {reader} reader gave up on this file: it is damaged");
        Err(ForeignError::at(file, super::Spot::Byte(0), message))
    })
}
