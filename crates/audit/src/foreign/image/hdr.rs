//! Radiance images: Ward, "Real Pixels" (Graphics Gems II, 1991), and the run lengths of his
//! `color.c`. Values are mantissa * 2^(exponent - 136), times no half step, as engines load them.

use lobefit_math::ops;

use super::packed::Source;
use super::{Image, claimed};
use crate::foreign::{Channel, ForeignError, ForeignTable, Hints, Step};

/// Bytes of a header at most.
const HEADER: usize = 1 << 14;

/// Widths of scan lines whose components may lie apart, in runs.
const APART: std::ops::Range<usize> = 8..1 << 15;

/// The table of an image.
pub fn read(bytes: &[u8], file: &str, hints: &Hints) -> Result<Vec<ForeignTable>, ForeignError> {
    let source = Source { bytes, file };
    let (size, exposure, mut at) = header(source)?;
    claimed(file, &size, 3)?;
    let [width, height] = size.map(|n| n as usize);
    let mut values = [(); 3].map(|()| Vec::new());
    for _ in 0..height {
        let line = scan_line(source, &mut at, width)?;
        for texel in &line {
            let scale = if texel[3] == 0 { 0.0 } else { ops::exp2(f64::from(texel[3]) - 136.0) / exposure };
            values.iter_mut().zip(texel).for_each(|(values, m)| values.push(f64::from(*m) * scale));
        }
    }
    let name = |(name, values): (&str, Vec<f64>)| Channel { name: name.into(), values: values.into() };
    let image = Image {
        file: file.into(),
        name: String::new(),
        kind: "Radiance, RGBE".into(),
        size: vec![width, height],
        channels: ["R", "G", "B"].into_iter().zip(values).map(name).collect(),
        step: Step::Rgbe,
        note: String::new(),
    };
    Ok(vec![image.table(hints)?])
}

/// Width and height, the product of the exposures, and the byte of the first scan line.
fn header(source: Source) -> Result<([u64; 2], f64, u64), ForeignError> {
    let (mut at, mut exposure) = (0, 1.0);
    loop {
        let rest = &source.bytes[at..source.bytes.len().min(HEADER)];
        let Some(end) = rest.iter().position(|b| *b == b'\n') else {
            return Err(
                source.malformed(at as u64, "the header has no end: the file is cut short or damaged")
            );
        };
        let line = String::from_utf8_lossy(&rest[..end]);
        let (here, words) = (at as u64, line.split_whitespace().collect::<Vec<_>>());
        at += end + 1;
        if let [first, height, second, width] = words[..]
            && first.ends_with(['X', 'Y'])
        {
            if [first, second] != ["-Y", "+X"] {
                let what = format!("a Radiance file of the order {first} {second}");
                return Err(source.unsupported(here, what, "save it as -Y +X, from the top left on"));
            }
            return match (width.parse(), height.parse()) {
                (Ok(width), Ok(height)) if width > 0 && height > 0 => {
                    Ok(([width, height], exposure, at as u64))
                }
                _ => Err(source.malformed(here, format!("`{}` is no size", line.escape_debug()))),
            };
        }
        if let Some(format) = line.strip_prefix("FORMAT=").filter(|f| f.trim() != "32-bit_rle_rgbe") {
            let what = format!("a Radiance file of {}", format.escape_debug());
            return Err(source.unsupported(here, what, "save it as 32-bit_rle_rgbe"));
        }
        if let Some(given) = line.strip_prefix("EXPOSURE=") {
            let given = given.trim().parse().ok().filter(|x: &f64| x.is_finite() && *x > 0.0);
            exposure *= given.ok_or_else(|| source.malformed(here, "its exposure is no positive number"))?;
            if !(exposure.is_finite() && exposure > 0.0) {
                return Err(source.malformed(here, "the product of its exposures is no positive number"));
            }
        }
    }
}

/// The texels of the scan line at a byte, which is moved behind it.
fn scan_line(source: Source, at: &mut u64, width: usize) -> Result<Vec<[u8; 4]>, ForeignError> {
    let what = || format!("a scan line of {width} texels");
    let start = source.part(*at, 4, &what())?;
    let apart = start[..2] == [2, 2] && start[2] < 128;
    if !apart || !APART.contains(&width) {
        let texels = source.part(*at, 4 * width as u64, &what())?.as_chunks::<4>().0;
        if texels.iter().any(|t| t[..3] == [1; 3]) {
            let advice = "save it with the run lengths that all programs write today, or as EXR";
            return Err(source.unsupported(*at, "a Radiance file of repeated texels", advice));
        }
        *at += 4 * width as u64;
        return Ok(texels.to_vec());
    }
    if usize::from(start[2]) << 8 | usize::from(start[3]) != width {
        return Err(source.malformed(*at, format!("it does not begin a scan line of {width} texels")));
    }
    *at += 4;
    let mut line = vec![[0; 4]; width];
    for component in 0..4 {
        let mut filled = 0;
        while filled < width {
            let count = usize::from(source.part(*at, 1, &what())?[0]);
            let (run, length) = if count > 128 { (count - 128, 1) } else { (count, count) };
            if run == 0 || filled + run > width {
                return Err(
                    source.malformed(*at, format!("a run of {run} of the {} texels left", width - filled))
                );
            }
            let list = source.part(*at + 1, length as u64, &what())?;
            for k in 0..run {
                line[filled + k][component] = list[k % length];
            }
            *at += 1 + length as u64;
            filled += run;
        }
    }
    Ok(line)
}
