//! The embedded font: registered once for plotters, measured for the placing of labels, embedded in
//! the page.

use std::sync::OnceLock;

use ab_glyph::{Font, FontRef};
use plotters::style::{FontStyle, register_font};

use crate::ReportError;

/// DejaVu Sans, reduced to the characters that the report uses; licence in `assets/FONT-LICENSE`.
pub(crate) const BYTES: &[u8] = include_bytes!("../assets/DejaVuSans-subset.ttf");

/// The same in the container of the web, its tables packed: what a page embeds.
pub const WOFF: &[u8] = include_bytes!("../assets/DejaVuSans-subset.woff");

/// Family name, in plotters, in the SVG and in the page's style sheet.
pub(crate) const FAMILY: &str = "lobefit";

/// The parsed font, registered with plotters on first use.
pub(crate) fn font() -> Result<&'static FontRef<'static>, ReportError> {
    static FONT: OnceLock<Option<FontRef<'static>>> = OnceLock::new();
    let font = FONT.get_or_init(|| {
        register_font(FAMILY, FontStyle::Normal, BYTES).ok()?;
        FontRef::try_from_slice(BYTES).ok()
    });
    font.as_ref().ok_or_else(|| ReportError::Drawing {
        section: "font".into(),
        reason: "the embedded font cannot be parsed".into(),
    })
}

/// Advance width of `text` in pixels at `size` pixels per em, without kerning.
pub(crate) fn width(text: &str, size: f64) -> Result<f64, ReportError> {
    let font = font()?;
    let em = f64::from(font.units_per_em().unwrap_or(2048.0));
    let advance: f64 = text.chars().map(|c| f64::from(font.h_advance_unscaled(font.glyph_id(c)))).sum();
    Ok(advance / em * size)
}

/// `text`, or its beginning and an ellipsis, no wider than `limit` pixels.
pub(crate) fn shorten(text: &str, size: f64, limit: f64) -> Result<String, ReportError> {
    if width(text, size)? <= limit {
        return Ok(text.into());
    }
    let mut kept: String = text.into();
    while kept.pop().is_some() {
        let shortened = format!("{}…", kept.trim_end());
        if width(&shortened, size)? <= limit {
            return Ok(shortened);
        }
    }
    Ok(String::new())
}

/// `text` in lines no wider than `limit` pixels, broken after hyphens, underscores and spaces; what
/// is left after `lines` lines is shortened.
pub(crate) fn wrap(text: &str, size: f64, limit: f64, lines: usize) -> Result<Vec<String>, ReportError> {
    let mut out: Vec<String> = Vec::new();
    let mut current = String::new();
    for part in text.split_inclusive(['-', '_', ' ']) {
        let longer = format!("{current}{part}");
        if current.is_empty() || out.len() + 1 >= lines || width(longer.trim_end(), size)? <= limit {
            current = longer;
        } else {
            out.push(std::mem::replace(&mut current, part.to_string()));
        }
    }
    out.push(current);
    out.iter().map(|line| shorten(line.trim_end(), size, limit)).collect()
}
