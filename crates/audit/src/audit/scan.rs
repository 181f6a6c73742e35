//! All texels of a table that is too large for its errors to be held at once: looked through in bands,
//! by the values between the knots of the truth, and judged exactly where they are worst.

use super::errors::{Residuals, TexelErrors};
use super::judge::judge;
use super::sample::Sample;
use super::table::{AuditedTable, Source};
use super::truth::Truth;
use super::{Audit, AuditError, HELD_TEXELS, inputs_at};

/// Texels of a band, about.
const BAND: usize = 1 << 18;

/// Puts the figures of all texels into the channels of a table of two axes that was judged on a
/// lattice; the median stays that of the lattice.
pub(super) fn through(
    truth: &Truth,
    table: &AuditedTable,
    live: &[usize],
    done: &mut Audit,
) -> Result<(), AuditError> {
    let texels: usize = table.size.iter().product();
    let convention = done.best().clone();
    let lobe = truth.lobes().iter().position(|own| *own == convention.lobe).unwrap_or(0);
    let large = table.size.len() == 2 && texels > HELD_TEXELS && !truth.is_costly(lobe);
    if !large || table.source != Source::Table {
        return Ok(());
    }
    let (height, step) = (table.size[1], (BAND / table.size[0]).max(1));
    let mut found: Vec<Option<TexelErrors>> = vec![None; live.len()];
    for first in (0..height).step_by(step) {
        let sample = Sample::rows(table, live, first..(first + step).min(height));
        let judgement = judge(truth, &sample, &convention.axes, lobe, Truth::quick)?;
        for (place, found) in found.iter_mut().enumerate() {
            let Some(column) = convention.columns[live[place]] else { continue };
            let residuals = Residuals::new(&sample, &judgement, column, &sample.values[place]);
            if residuals.judged.is_empty() {
                continue;
            }
            let at = |texel: &[usize]| inputs_at(&convention, &table.size, texel);
            let band = residuals.figures(at);
            let worst = Sample::one(table, live, &band.texel);
            let judgement = judge(truth, &worst, &convention.axes, lobe, Truth::exact)?;
            let exact = Residuals::new(&worst, &judgement, column, &worst.values[place]).figures(at);
            let band = TexelErrors { max: exact.max, truth: exact.truth, ..band };
            *found = Some(found.take().map_or(band.clone(), |all| all.with(band)));
        }
    }
    for (place, found) in found.into_iter().enumerate() {
        let channel = &mut done.channels[live[place]];
        if let (Some(own), Some(found)) = (&channel.errors, found) {
            let worst = if own.max > found.max { own.clone() } else { found.clone() };
            let TexelErrors { rms, mean, judged, .. } = found;
            let median = own.median;
            channel.errors = Some(TexelErrors { rms, mean, judged, median, unsampled: 0, ..worst });
        }
    }
    Ok(())
}
