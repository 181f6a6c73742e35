//! All texels of a table that is too large for its errors to be held at once: looked through in bands,
//! by the values between the knots of the truth, and judged exactly where they are worst.

use super::best::Case;
use super::defects::{Defect, Grain, stored};
use super::errors::{Residuals, TexelErrors};
use super::extent::Extent;
use super::judge::judge;
use super::sample::Sample;
use super::spikes::{GAP, spikes};
use super::table::Source;
use super::truth::Truth;
use super::{Audit, AuditError, HELD_TEXELS, inputs_at};
use crate::foreign::Step;

/// Texels of a band, about.
const BAND: usize = 1 << 18;

/// What is found in a channel, band by band.
#[derive(Clone, Default)]
struct Found {
    errors: Option<TexelErrors>,
    /// Texels that stand out of their band, with their errors.
    alone: Vec<(Vec<usize>, f64)>,
    /// The largest error of the others.
    rest: f64,
}

impl Found {
    fn add(&mut self, r: &Residuals, band: TexelErrors, grain: Grain) {
        match spikes(r, grain) {
            Some(spikes) => {
                self.alone.extend(spikes.off.iter().map(|i| (r.texel(*i), r.errors[*i])));
                self.rest = self.rest.max(spikes.rest);
            }
            None => self.rest = self.rest.max(band.max),
        }
        self.errors = Some(self.errors.take().map_or(band.clone(), |all| all.with(band)));
    }

    /// The texels that stand out of the whole table.
    fn part(self, size: &[usize]) -> Option<Defect> {
        let (mut alone, errors) = (self.alone, self.errors?);
        alone.retain(|(_, error)| error.abs() >= GAP * self.rest);
        alone.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
        let (texel, most) = alone.first().map(|(texel, error)| (texel.clone(), error.abs()))?;
        let (n, all) = (alone.len() as f64, errors.judged as f64);
        let square = all * errors.rms * errors.rms - alone.iter().map(|(_, e)| e * e).sum::<f64>();
        Some(Defect::Part {
            texels: [alone.len(), errors.judged],
            over: self.rest,
            most,
            texel,
            mean: alone.iter().map(|(_, error)| error).sum::<f64>() / n,
            rest: (square.max(0.0) / (all - n)).sqrt(),
            extent: Extent::alone(size.to_vec(), alone.into_iter().map(|(texel, _)| texel)),
        })
    }
}

/// Puts the figures of all texels into the channels of a table of two axes that was judged on a
/// lattice, and single texels that stand out; the median stays that of the lattice.
pub(super) fn through(truth: &Truth, case: &Case, done: &mut Audit) -> Result<(), AuditError> {
    let Case { table, live, fixed, .. } = *case;
    let texels: usize = table.size.iter().product();
    let convention = done.best().clone();
    let lobe = truth.lobes().iter().position(|own| *own == convention.lobe).unwrap_or(0);
    let large = table.size.len() == 2 && texels > HELD_TEXELS && !truth.is_costly(lobe);
    if !large || table.source != Source::Table {
        return Ok(());
    }
    let (height, step) = (table.size[1], (BAND / table.size[0]).max(1));
    let mut found = vec![Found::default(); live.len()];
    let step_of = |k: &usize| stored(table.step, &table.channels[*k].values);
    let steps: Vec<Step> = live.iter().map(step_of).collect();
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
            let grain = Grain { step: steps[place], samples: fixed.samples };
            found.add(&residuals, band, grain);
        }
    }
    for (place, found) in found.into_iter().enumerate() {
        let channel = &mut done.channels[live[place]];
        // What was found on the lattice explains more than single texels.
        let explains = |d: &Defect| {
            matches!(d, Defect::Part { .. } | Defect::Clamped { .. } | Defect::MissingLoss { .. })
        };
        let is_damaged = channel.defects.iter().any(explains);
        channel.defects.extend(found.clone().part(&table.size).filter(|_| !is_damaged));
        if let (Some(own), Some(found)) = (&channel.errors, found.errors) {
            let worst = if own.max > found.max { own.clone() } else { found.clone() };
            let TexelErrors { rms, mean, judged, .. } = found;
            let median = own.median;
            channel.errors = Some(TexelErrors { rms, mean, judged, median, unsampled: 0, ..worst });
        }
    }
    Ok(())
}
