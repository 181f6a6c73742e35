//! A frame: its depth, the buffers that are made of it, and their errors.

use super::path;
use crate::depth::{Depth, EMPTY};
use crate::measure::error;
use crate::study::Results;
use lobefit::report::{Pixels, ReportError, Section, figures};

/// Depths of the lightest and of the darkest grey, metres.
const GREYS: [f32; 2] = [1.0, 120.0];
/// Relative errors up to which a texel is black, and of the full colours.
const RIGHT: f32 = 0.01;
const FULL: f32 = 0.2;
/// Fewest pixels of a picture's width: its title needs them, and so do eyes.
const WIDE: usize = 320;

/// A picture of at least [`WIDE`] columns, each texel a square of pixels.
fn readable(title: &str, [width, height]: [usize; 2], levels: &[u8], palette: Vec<u8>) -> Pixels {
    let times = WIDE.div_ceil(width);
    let size = (width * times, height * times);
    let pixel = |i: usize| levels[i / size.0 / times * width + i % size.0 / times];
    Pixels { title: title.into(), size, levels: (0..size.0 * size.1).map(pixel).collect(), palette }
}

/// A grey for each depth, a colour for what is infinitely far, another where nothing was written.
fn depth(title: &str, depth: &Depth) -> Pixels {
    let level = |z: f32| match z {
        EMPTY => 0,
        f32::INFINITY => 1,
        _ => {
            let [near, far] = GREYS.map(lobefit_math::ops::logf);
            let t = ((lobefit_math::ops::logf(z) - near) / (far - near)).clamp(0.0, 1.0);
            2 + (t * 61.0).round() as u8
        }
    };
    let greys = (0..62_u32).flat_map(|i| [(235 - 3 * i) as u8; 3]);
    let palette = [0x8e, 0x24, 0xaa, 0xcf, 0xe6, 0xff].into_iter().chain(greys).collect();
    readable(title, depth.size, &depth.texels.iter().map(|z| level(*z)).collect::<Vec<u8>>(), palette)
}

/// Yellow where a buffer is too near, cyan where it is too far, faint dots where nothing was
/// written.
fn errors(title: &str, found: &Depth, truth: &Depth) -> Pixels {
    let width = found.size[0];
    let level = |(i, (found, truth)): (usize, (&f32, &f32))| match error(*found, *truth) {
        None => u8::from((i % width + i / width).is_multiple_of(4) && (i / width).is_multiple_of(2)),
        Some(e) => {
            let t = (((e.abs() - RIGHT) / (FULL - RIGHT)).clamp(0.0, 1.0).sqrt() * 30.0).round() as u8;
            if e < 0.0 { 2 + t } else { 33 + t }
        }
    };
    let ramp = |colour: [u32; 3]| (0..31_u32).flat_map(move |i| colour.map(|c| (c * i / 30) as u8));
    let palette =
        [0, 0, 0, 96, 88, 20].into_iter().chain(ramp([255, 214, 0])).chain(ramp([0, 225, 255])).collect();
    let levels: Vec<u8> = found.texels.iter().zip(&truth.texels).enumerate().map(level).collect();
    readable(title, found.size, &levels, palette)
}

pub(super) fn pictures(results: &Results) -> Result<Section, ReportError> {
    let shown = &results.pictures;
    let first =
        [depth("the depth of the frame", &shown.truth), depth("the depth that has arrived", &shown.old)];
    let made: Vec<Pixels> = shown.buffers.iter().map(|(name, buffer)| depth(name, buffer)).collect();
    let [near, far] = GREYS;
    let off: Vec<Pixels> =
        shown.buffers.iter().map(|(name, buffer)| errors(name, buffer, &shown.truth)).collect();
    Ok(Section::new(
        "pictures",
        "One frame",
        format!(
            "A frame of the path `{}`, {} frames after the depth that has arrived.",
            path(results.culling.path),
            results.culling.latency
        ),
        vec![
            figures(
                &first,
                &format!(
                    "What is wanted, and what there is. Depth: light is {near} m or nearer, dark {far} m or farther, each step of grey the same factor; \
                     blue is infinitely far."
                ),
            )?,
            figures(
                &made,
                "The buffer by each way; the last three are all passes, the conservative mode and the chosen parameters, whose margin is in the tests of boxes and in no picture. Purple: nothing was written.",
            )?,
            figures(
                &off,
                "The errors of these. Yellow is too near, false occlusion: what is behind it vanishes. Cyan is too far, false disocclusion: \
                           drawn in vain. Black is right within 1 %, full colours are off by 20 % or more. Faint dots: nothing was written, which hides nothing.",
            )?,
        ],
    ))
}
