//! Lobes on slanted walls, and several fetches for each.

use std::f64::consts::PI;

use rayon::prelude::*;
use serde::Serialize;

use crate::study::parallax::findings::{
    PlacedTaps, RuleExpectation, RuleRefit, RuleSpread, SlantFindings, SlantLobe, SlantRow,
};
use crate::study::{Size, StudyError};
use lobefit::bake::Progress;
use lobefit::effects::parallax::taps::best::{Found, best_taps};
use lobefit::effects::parallax::taps::expected::expected;
use lobefit::effects::parallax::taps::fit::{Situation, fit, situations};
use lobefit::effects::parallax::{RuleTap, TapRule};
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::optics::kernel::Kernel;
use lobefit_truth::quantity::footprint::slant::{Case, Nearest, Resolution, Slant, best_width};

/// What this part covers.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Parameters {
    kernel: Kernel,
    alphas: Vec<f64>,
    /// In degrees.
    slants: Vec<f64>,
    counts: Vec<usize>,
    search: Resolution,
    fine: Resolution,
    rules: [TapRule; 2],
    spread: Spread,
    fitted: Fitted,
}

/// Walls at slants to both.
#[derive(Clone, Debug, Serialize)]
struct Spread {
    alphas: Vec<f64>,
    walls: u32,
    seed: u32,
}

/// Walls that the rules' constants are fitted on.
#[derive(Clone, Debug, Serialize)]
struct Fitted {
    alphas: Vec<f64>,
    walls: u32,
    seed: u32,
    iterations: u64,
}

impl Parameters {
    /// Those of a size.
    pub fn of(size: Size) -> Parameters {
        let full = size == Size::Full;
        let pick = |a: &[f64], b: &[f64]| if full { a.to_vec() } else { b.to_vec() };
        Parameters {
            kernel: Kernel::HalfCosine,
            alphas: pick(&[0.03, 0.1, 0.3], &[0.1]),
            slants: pick(&[10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 66.0, 72.0, 76.0, 80.0], &[60.0, 72.0]),
            counts: if full { vec![2, 3, 4, 8] } else { vec![2, 3] },
            search: if full { Resolution { step: 0.12, angles: 80 } } else { Resolution::COARSE },
            fine: if full { Resolution::FINE } else { Resolution::COARSE },
            rules: [TapRule::two(), TapRule::three()],
            spread: Spread {
                alphas: pick(&[0.01, 0.03, 0.08, 0.18, 0.35, 0.6], &[0.1]),
                walls: if full { 300 } else { 4 },
                seed: 2,
            },
            fitted: Fitted {
                alphas: pick(&[0.02, 0.05, 0.1, 0.2, 0.35, 0.55, 0.8], &[0.2]),
                walls: if full { 140 } else { 2 },
                seed: 1,
                iterations: if full { 6 } else { 1 },
            },
        }
    }
}

/// Runs it.
pub(super) fn findings(
    parameters: &Parameters,
    progress: &dyn Progress,
) -> Result<SlantFindings, StudyError> {
    progress.stage("slant");
    let lobes = parameters.alphas.par_iter().map(|alpha| lobe(parameters, *alpha));
    let (refits, expectations) = refits(parameters)?;
    Ok(SlantFindings {
        lobes: lobes.collect::<Result<_, IntegrateError>>()?,
        spread: spread(parameters)?,
        refits,
        expectations,
    })
}

fn in_front(parameters: &Parameters, alpha: f64, psi: f64, at: Resolution) -> Result<Case, IntegrateError> {
    Case::new(parameters.kernel.clone(), alpha, Slant::in_front(psi * PI / 180.0), at)
}

/// One width over the slants, the fetches of each found from those of the slant before.
fn lobe(parameters: &Parameters, alpha: f64) -> Result<SlantLobe, IntegrateError> {
    let mut last: Vec<Option<Found>> = vec![None; parameters.counts.len()];
    let mut rows = Vec::new();
    for psi in &parameters.slants {
        let search = in_front(parameters, alpha, *psi, parameters.search)?;
        let fine = in_front(parameters, alpha, *psi, parameters.fine)?;
        let found = parameters.counts.par_iter().zip(&last);
        let found = found.map(|(count, last)| best_taps(&search, *count, last.as_ref()));
        let found = found.collect::<Result<Vec<Found>, _>>()?;
        let (width, best) = best_width(&fine, Nearest::Variation)?;
        let placed = found.iter().map(|found| {
            let tv = variation(&fine, &found.taps)?;
            Ok(PlacedTaps { tv, settled: found.settled, taps: found.taps.clone() })
        });
        let placed = placed.collect::<Result<_, IntegrateError>>()?;
        let [two, three] = &parameters.rules;
        let ruled = |rule: &TapRule| variation(&fine, &rule.taps(&fine.stretch, alpha));
        let same = fine.normalised(fine.straight(alpha)).map(|footprint| fine.off(&footprint).tv);
        rows.push(SlantRow {
            slant: *psi,
            same: same.ok_or_else(|| nothing(&fine))?,
            best: best.tv,
            factor: width / alpha,
            placed,
            ruled: [ruled(two)?, ruled(three)?],
        });
        last = found.into_iter().map(Some).collect();
    }
    Ok(SlantLobe { alpha, rows })
}

fn variation(case: &Case, taps: &[RuleTap]) -> Result<f64, IntegrateError> {
    Ok(case.off(&case.fetched(taps).ok_or_else(|| nothing(case))?).tv)
}

fn nothing(case: &Case) -> IntegrateError {
    let place = format!("alpha = {}, {:?}", case.alpha, case.slant);
    IntegrateError::NotFinite { quantity: "fetches of a slanted wall", place }
}

fn spread(parameters: &Parameters) -> Result<Vec<RuleSpread>, IntegrateError> {
    let Spread { alphas, walls, seed } = &parameters.spread;
    let all = situations(&parameters.kernel, alphas, *walls, *seed, Resolution::COARSE)?;
    // those in front of the probe stand elsewhere
    let tilted: Vec<&Situation> = all.iter().filter(|s| s.case.slant.probe.slant > 0.0).collect();
    let [two, three] = &parameters.rules;
    let of = |alpha: &f64| {
        let here: Vec<&&Situation> = tilted.iter().filter(|s| s.case.alpha == *alpha).collect();
        let tv: Vec<[f64; 3]> =
            here.par_iter().map(|s| [s.one, s.variation(two), s.variation(three)]).collect();
        let each = |i: usize| tv.iter().map(move |row| row[i]);
        let rules = [TapRule::one(), *two, *three];
        let expected = |i: usize| {
            let off = here.iter().zip(each(i)).map(|(s, tv)| rules[i].expected(&s.case.stretch, *alpha) - tv);
            (off.map(|d| d * d).sum::<f64>() / (tv.len().max(1)) as f64).sqrt()
        };
        let high = |i: usize| {
            let mut sorted: Vec<f64> = each(i).collect();
            sorted.sort_by(f64::total_cmp);
            sorted.get(sorted.len() * 19 / 20).copied().unwrap_or(0.0)
        };
        let mean = |i: usize| each(i).sum::<f64>() / (tv.len().max(1)) as f64;
        let worse = |i: usize| tv.iter().filter(|row| row[i] > row[0] + 1e-3).count();
        RuleSpread {
            alpha: *alpha,
            walls: tv.len(),
            mean: [0, 1, 2].map(mean),
            high: [0, 1, 2].map(high),
            expected: [0, 1, 2].map(expected),
            worse: [worse(1), worse(2)],
        }
    };
    Ok(alphas.iter().map(of).collect())
}

/// Most iterations of a fit of an expected total variation.
const SEARCH: u64 = 30;

fn refits(parameters: &Parameters) -> Result<(Vec<RuleRefit>, Vec<RuleExpectation>), IntegrateError> {
    let Fitted { alphas, walls, seed, iterations } = &parameters.fitted;
    let all = situations(&parameters.kernel, alphas, *walls, *seed, Resolution::COARSE)?;
    let refit = |rule: &TapRule| {
        let found = fit(rule, &all, *iterations)?;
        Ok(RuleRefit {
            count: rule.count(),
            constants: rule.constants().to_vec(),
            refitted: found.rule.constants().to_vec(),
            sums: found.sums,
            settled: found.settled,
            walls: all.len(),
        })
    };
    let [two, three] = &parameters.rules;
    let expectation = |rule: &TapRule| {
        let constants = rule.expectation().constants;
        let found = expected(rule, &constants, &all, SEARCH)?;
        Ok(RuleExpectation {
            count: rule.count(),
            constants,
            refitted: found.constants,
            off: found.off,
            walls: all.len(),
        })
    };
    let expectations = [TapRule::one(), *two, *three];
    let expectations = expectations.iter().map(expectation);
    let refits = parameters.rules.iter().map(refit).collect::<Result<_, IntegrateError>>()?;
    Ok((refits, expectations.collect::<Result<_, IntegrateError>>()?))
}
