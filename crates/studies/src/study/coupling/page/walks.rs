//! The random walk of white facets: how much leaves after which bounce, and where it goes.

use crate::study::coupling::surface::random_walk::BounceRow;
use lobefit::report::numbers::{bound, brief, significant};
use lobefit::report::{Block, Curves, ReportError, Section, Series, Style, TextTable, check, figures, words};

/// Half the length of an error bar in standard errors.
pub(super) const SHOWN: f64 = 2.0;

/// The section of the rows; rows must be there.
pub(super) fn section(rows: &[BounceRow]) -> Result<Section, ReportError> {
    check::filled("walk", "rows", rows.len())?;
    for row in rows {
        let field = format!("roughness {}, mu {}", row.roughness, row.mu);
        check::values("walk", &field, &row.energy)?;
        for lights in [&row.kulla_conty, &row.multiplied, &row.lights_error] {
            check::size("walk", &format!("{field}: lights"), lights.len(), row.lights.len())?;
            check::values("walk", &format!("{field}: lights"), lights)?;
        }
        check::filled("walk", &format!("{field}: densities"), row.densities.len())?;
    }
    let charts: Vec<Curves> = rows.iter().map(chart).collect();
    let caption = "Where light of two bounces or more leaves, as energy per unit of cosine; the area under a curve is what single scattering \
                   loses. Discs: means of the random walk over sixteenths of the cosine, with bars of two standard errors either way. \
                   Multiplied: a lobe of single scattering that is scaled up (normalised, compensated) sends that energy where the single \
                   bounce goes; the added lobe of Kulla and Conty spreads it almost like a diffuse one.";
    Ok(Section::new(
        "walk",
        "Bounces between facets",
        "The random walk with facets that absorb nothing: all light leaves sooner or later. The first bounce is the lobe of single \
               scattering, whose energy E the quadrature gives without a walk.",
        vec![Block::Table(table(rows)), figures(&charts, caption)?],
    ))
}

fn table(rows: &[BounceRow]) -> TextTable {
    let bounces = rows.first().map(|row| row.energy.len()).unwrap_or_default();
    let bounce = |n: usize| if n == bounces { format!("{n} and more") } else { n.to_string() };
    let columns = words::figures_after("roughness>|μ>|E by quadrature>", (1..=bounces).map(bounce))
        + "|Kulla-Conty off>|multiplied off>";
    let row = |row: &BounceRow| {
        let mut cells = vec![brief(row.roughness, 3), brief(row.mu, 3), significant(row.single, 4)];
        cells.extend(row.energy.iter().map(|energy| significant(*energy, 3)));
        cells.extend([row.kulla_conty_off, row.multiplied_off].map(|off| significant(off, 2)));
        cells
    };
    let error =
        rows.iter().flat_map(|row| &row.standard_error).fold(0.0_f64, |worst, error| worst.max(*error));
    let caption = format!(
        "Energy that leaves after 1, 2, ... bounces, standard error at most {}. E by quadrature: the energy of the first bounce without a walk. \
         Off: the part of the light of later bounces that a model sends to other angles than the walk.",
        bound(error, 1)
    );
    words::table(&columns, rows.iter().map(row).collect(), &caption)
}

fn chart(row: &BounceRow) -> Curves {
    let bins = row.lights.len() as f64;
    let model = |name: &str, of: usize, style: Style| {
        Series::line(name, row.densities.iter().map(|at| (at[0], at[of])).collect(), style)
    };
    let middle = |i: usize| (i as f64 + 0.5) / bins;
    let walked = row.lights.iter().enumerate().map(|(i, energy)| (middle(i), energy * bins)).collect();
    let ends = row.lights.iter().zip(&row.lights_error).enumerate().flat_map(|(i, (energy, error))| {
        [energy - SHOWN * error, energy + SHOWN * error].map(|end| (middle(i), end * bins))
    });
    let title = format!("roughness {}, view at μ {}", brief(row.roughness, 3), brief(row.mu, 3));
    let series = vec![
        model("kulla-conty", 1, Style::Line(0)),
        model("multiplied lobe", 2, Style::Line(1)),
        Series::line("", ends.collect(), Style::Bars),
        Series::line("random walk", walked, Style::Measured),
    ];
    Curves::linear(title, ["cosine of the light", "energy per unit of cosine"], series, (400.0, 240.0))
}
