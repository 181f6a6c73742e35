//! All texels of a table that is too large for its errors to be held at once: looked through in bands.

use super::best::Case;
use super::defects::{Defect, Grain};
use super::errors::{Residuals, TexelErrors};
use super::extent::Extent;
use super::judge::judge;
use super::sample::Sample;
use super::spikes::{GAP, spikes};
use super::table::Source;
use super::truth::Truth;
use super::{Audit, AuditError, ChannelAudit, Fit, HELD_TEXELS, inputs_at};

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
    /// Texels that are off by more than format and samples leave.
    over: usize,
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
        self.over += r.judged.iter().filter(|i| r.errors[**i].abs() > grain.leaves(r, **i)).count();
        self.errors = Some(self.errors.take().map_or(band.clone(), |all| all.with(band)));
    }

    /// The texels that stand out of the whole table.
    fn part(&self, size: &[usize]) -> Option<Defect> {
        let errors = self.errors.as_ref()?;
        let mut alone = self.alone.clone();
        alone.retain(|(_, error)| error.abs() >= GAP * self.rest);
        let (texel, most) = alone.iter().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?.clone();
        let (n, all) = (alone.len() as f64, errors.judged as f64);
        let square = all * errors.rms * errors.rms - alone.iter().map(|(_, e)| e * e).sum::<f64>();
        Some(Defect::Part {
            texels: [alone.len(), errors.judged],
            over: self.rest,
            most: most.abs(),
            texel,
            mean: alone.iter().map(|(_, error)| error).sum::<f64>() / n,
            rest: (square.max(0.0) / (all - n)).sqrt(),
            extent: Extent::singles(size.to_vec(), alone.into_iter().map(|(texel, _)| texel)),
        })
    }

    /// Puts the figures of all texels in the place of those of a lattice, but for the median, and single
    /// texels that stand out in the place of those that the lattice has.
    fn put(self, channel: &mut ChannelAudit, size: &[usize]) {
        let part = self.part(size);
        let (Some(own), Some(found)) = (&channel.errors, self.errors) else { return };
        let worst = if own.max > found.max { own } else { &found };
        let median = own.median;
        let TexelErrors { rms, mean, judged, .. } = found;
        channel.errors = Some(TexelErrors { rms, mean, judged, median, unsampled: 0, ..worst.clone() });
        let is_single = |d: &Defect| {
            matches!(d, Defect::Part { texels: [1, _], .. })
                || matches!(d, Defect::Part { extent, .. } if !extent.alone.is_empty())
        };
        let explains = |d: &Defect| {
            matches!(d, Defect::Part { .. } | Defect::Clamped { .. } | Defect::MissingLoss { .. })
        };
        let is_explained = channel.defects.iter().any(|d| explains(d) && !is_single(d));
        let part = part.filter(|_| !is_explained);
        let stands_out = part.is_some();
        if let Some(part) = part {
            let is_of_all =
                |d: &Defect| matches!(d, Defect::Steps { .. } | Defect::Bias { .. } | Defect::Factor { .. });
            channel.defects.retain(|d| !is_single(d) && !is_of_all(d));
            channel.defects.push(part);
        }
        for defect in &mut channel.defects {
            match defect {
                Defect::Noise { apart, .. } => *apart |= stands_out,
                Defect::Sampled { texels, .. } => *texels = [self.over, judged],
                _ => {}
            }
        }
    }
}

/// Puts the figures of all texels into the channels of a table of two axes that was judged on a lattice.
pub(super) fn through(truth: &Truth, case: &Case, done: &mut Audit) -> Result<(), AuditError> {
    let Case { table, live, fixed, .. } = *case;
    let texels: usize = table.size.iter().product();
    let convention = done.best().clone();
    let lobe = truth.lobes.iter().position(|own| *own == convention.lobe).unwrap_or(0);
    let large = table.size.len() == 2 && texels > HELD_TEXELS && !truth.specs[lobe].costly;
    if !large || table.source != Source::Table {
        return Ok(());
    }
    let (height, step) = (table.size[1], (BAND / table.size[0]).max(1));
    let mut found = vec![Found::default(); live.len()];
    let grains: Vec<Grain> = live.iter().map(|k| Grain::of(table, *k, fixed)).collect();
    // Of what follows nothing the worst texel alone is judged exactly.
    let values = if done.fit == Fit::None { Truth::quick } else { Truth::exact };
    for first in (0..height).step_by(step) {
        let sample = Sample::rows(table, live, first..(first + step).min(height));
        let judgement = judge(truth, &sample, &convention.axes, lobe, values)?;
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
            found.add(&residuals, band, grains[place]);
        }
    }
    for (place, found) in found.into_iter().enumerate() {
        found.put(&mut done.channels[live[place]], &table.size);
    }
    Ok(())
}
