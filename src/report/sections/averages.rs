//! The average albedo: a curve over roughness instead of maps.

use super::{figures, words};
use crate::report::{ApproximationFinding, AverageFinding, Block, Curves, ReportError, Series, Style, check};

/// Truth and fits over roughness, and what they miss by.
pub(super) fn blocks(
    averages: Option<&AverageFinding>,
    approximations: &[ApproximationFinding],
) -> Result<Vec<Block>, ReportError> {
    let Some(average) = averages else { return Ok(Vec::new()) };
    checked(average, approximations)?;
    let values =
        average.fits.iter().enumerate().map(|(i, f)| line(average, i, &f.name, f.values.iter().copied()));
    let truth = Series { style: Style::Truth, ..line(average, 0, "truth", average.truth.iter().copied()) };
    let above = chart(average, &average.name, std::iter::once(truth).chain(values).collect());
    let errors = average.fits.iter().enumerate().map(|(i, f)| {
        let off = f.values.iter().zip(&average.truth).map(|(v, t)| v - t);
        line(average, i, &f.name, off)
    });
    let below = chart(average, &format!("{} fit − truth", average.name), errors.collect());
    let caption = format!(
        "Left: {} over roughness, truth (heavy) under the fits (colour). Right: what the fits miss by, signed, on its own \
         scale. Constants, costs and certificates are those of the include files and of the table under “What accuracy \
         costs at run time”.",
        average.name,
    );
    Ok(vec![Block::Heading { text: average.name.clone() }, figures(&[above, below], &caption)?])
}

fn checked(average: &AverageFinding, approximations: &[ApproximationFinding]) -> Result<(), ReportError> {
    let section = format!("average {}", average.name);
    let n = average.roughness.values.len();
    check::increasing(&section, "roughness", &average.roughness.values)?;
    check::size(&section, "truth", average.truth.len(), n)?;
    check::values(&section, "truth", &average.truth)?;
    check::filled(&section, "fits", average.fits.len())?;
    for fit in &average.fits {
        if !approximations.iter().any(|a| a.name == fit.name) {
            return Err(check::domain(
                &section,
                &format!("fit {}", fit.name),
                "is not among the approximations",
            ));
        }
        check::size(&section, &format!("fit {}", fit.name), fit.values.len(), n)?;
        check::values(&section, &format!("fit {}", fit.name), &fit.values)?;
    }
    Ok(())
}

fn line(average: &AverageFinding, i: usize, name: &str, values: impl Iterator<Item = f64>) -> Series {
    let points = average.roughness.values.iter().copied().zip(values).collect();
    Series::line(name, points, Style::Line(i))
}

fn chart(average: &AverageFinding, title: &str, series: Vec<Series>) -> Curves {
    Curves::linear(title, [&words::axis(&average.roughness.name), title], series, (400.0, 220.0))
}
