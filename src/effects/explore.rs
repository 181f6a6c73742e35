//! What an effect adds to the live page: its fits and tables as GLSL, beside a truth as texels.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::BakeError;
use super::context::Context;
use super::grid::{self, Grid};
use super::table::BakedTable;
use crate::approximate::{Fit, Region, lerp};
use crate::data::{Source, Table, TexelFormat};
use crate::emit::lookup::Readable;
use crate::report::explore::{
    Drawn, Explored, ExploredApproximation, ROWS, SIDE, Standing, TableTexels, TruthTexels, between, view,
};
use crate::report::numbers::rounded;
use crate::report::{Furnace, FurnaceRow};
use lobefit_shade::code::{self, Language, helpers};
use lobefit_shade::{Hypothesis, round_up};
use lobefit_truth::points::Points;
use lobefit_truth::quantity::{Parts, Quantity, Variant};

/// Roughness of the spheres of the still picture, as far as they lie in the region.
const SPHERES: [f64; 5] = [0.2, 0.4, 0.6, 0.8, 1.0];

/// Every so many of the places between texels is measured along each axis.
const MEASURED: usize = 2;

/// A quantity that the live page is to draw.
pub struct Exploring<'a> {
    /// Its name in the address of the page.
    pub name: String,
    /// Title.
    pub title: String,
    /// What the spheres show.
    pub lead: String,
    /// How a sphere shows it.
    pub drawn: Drawn,
    /// The quantity of the truth.
    pub quantity: &'static dyn Quantity,
    /// Its outputs: E and B, or the column that is drawn.
    pub outputs: &'a [&'a str],
    /// Its variant.
    pub variant: Variant,
    /// Where the fits hold.
    pub region: Region,
    /// Inputs beside roughness and mu, and what they are on the page.
    pub at: Vec<(&'static str, f64)>,
    /// f0 of the first picture.
    pub f0: f64,
    /// Fits for the use.
    pub fits: Vec<&'a Fit>,
    /// Tables of two axes with all that the use needs.
    pub tables: Vec<&'a BakedTable>,
}

impl Exploring<'_> {
    /// The quantity as the page draws it.
    ///
    /// # Errors
    /// A truth that cannot be integrated.
    pub fn explored(&self, context: &Context) -> Result<Explored, BakeError> {
        let shown = self.shown();
        let mut approximations: Vec<ExploredApproximation> = self.without().into_iter().collect();
        approximations.extend(shown.iter().filter_map(|(fit, standing)| self.fit(fit, *standing)));
        let tables = self.tables.iter().filter_map(|baked| self.table(baked, context).transpose());
        approximations.extend(tables.collect::<Result<Vec<_>, BakeError>>()?);
        approximations.sort_by_key(|a| (a.standing, a.cost.ops));
        Ok(Explored {
            name: self.name.clone(),
            title: self.title.clone(),
            lead: self.lead.clone(),
            drawn: self.drawn,
            smith: context.scene.smith,
            alpha: self.region.alpha_map.alpha_source("roughness"),
            f0: self.f0,
            truth: self.truth(context)?,
            approximations,
            spheres: self.spheres(context)?,
        })
    }

    /// Emitted fits, those of the frontier, and published formulas.
    fn shown(&self) -> Vec<(&Fit, Standing)> {
        let (ops, error) =
            (|f: &Fit| f.approximation.cost.ops, |f: &Fit| f.approximation.certificate.max_abs);
        let ours = |fit: &&&Fit| fit.approximation.source == Source::Fitted;
        let is_beaten = |fit: &Fit| {
            let beats = |o: &&&Fit| {
                ops(o) <= ops(fit) && error(o) <= error(fit) && (ops(o), error(o)) != (ops(fit), error(fit))
            };
            self.fits.iter().filter(ours).any(|other| beats(&other))
        };
        let standing = |fit: &&'_ Fit| match &fit.approximation.source {
            _ if fit.emitted => Some(Standing::Emitted),
            Source::Published(_) => Some(Standing::Published),
            Source::Fitted => (!is_beaten(fit)).then_some(Standing::Frontier),
        };
        self.fits.iter().filter_map(|fit| Some((*fit, standing(fit)?))).collect()
    }

    fn without(&self) -> Option<ExploredApproximation> {
        let (name, call) = self.drawn.without()?;
        Some(ExploredApproximation {
            name: name.into(),
            standing: Standing::Without,
            source: String::new(),
            text: String::new(),
            call: call.into(),
            cost: Default::default(),
            certificate: None,
            texels: None,
        })
    }

    /// None for a formula with a name that GLSL has taken: scenes may ask for other languages
    /// alone.
    fn fit(&self, fit: &Fit, standing: Standing) -> Option<ExploredApproximation> {
        let (a, formula) = (&fit.approximation, &fit.hypothesis);
        let text = code::print(Language::Glsl, formula, &fit.coefficients(), &[]).ok()?.text;
        let name = if fit.emitted { formula.name().to_string() } else { a.name.clone() };
        Some(ExploredApproximation {
            name,
            standing,
            source: a.source.text().into(),
            text,
            call: format!("{}({})", formula.name(), self.arguments(formula).join(", ")),
            cost: a.cost,
            certificate: Some(a.certificate.clone()),
            texels: None,
        })
    }

    /// The arguments of a formula, with a number for an input that has one value here.
    fn arguments(&self, formula: &Hypothesis) -> Vec<String> {
        let of = |input: &String| match self.at.iter().find(|(known, _)| known == input) {
            Some((_, value)) => format!("{value:?}"),
            None => input.clone(),
        };
        formula.inputs().iter().map(of).collect()
    }

    fn table(
        &self,
        baked: &BakedTable,
        context: &Context,
    ) -> Result<Option<ExploredApproximation>, BakeError> {
        let (a, Some(table)) = (&baked.approximation, baked.table()) else { return Ok(None) };
        let &[width, height] = &table.axes.iter().map(|axis| axis.size).collect::<Vec<_>>()[..] else {
            return Ok(None);
        };
        let arguments = context.scene.output.arguments;
        let readable = Readable { table, decode: baked.decode, names: &baked.names, arguments, header: &[] };
        let functions = readable.print(Language::Glsl)?;
        let inputs = readable.inputs()?.join(", ");
        let value = format!("{}(live_texels, {inputs})", baked.names.lookup);
        let call = match (self.drawn, baked.decode.has_bias()) {
            (Drawn::Compensation, false) => format!("1.0 / {value}"),
            (Drawn::Compensation, true) => format!("1.0 / {value}.x"),
            (Drawn::Albedo, true) => format!("dot(vec2(f0, 1.0), {value}.yz)"),
            (Drawn::Value, false) => value,
            (Drawn::Albedo, false) | (Drawn::Base(_), _) | (Drawn::Value, true) => return Ok(None),
        };
        Ok(Some(ExploredApproximation {
            name: baked.names.lookup.clone(),
            standing: Standing::Table,
            source: format!("table {}", a.name),
            text: helpers(Language::Glsl, &functions) + &functions,
            call,
            cost: a.cost,
            certificate: Some(a.certificate.clone()),
            texels: Some(texels(table, [width, height])),
        }))
    }

    /// Values of the outputs at points.
    fn values(&self, points: &Points, context: &Context) -> Result<Vec<Vec<f64>>, BakeError> {
        let tolerance = self.quantity.tolerance_of_many(&self.variant);
        let truth = self.quantity.truth(&self.variant, points, self.outputs, tolerance)?;
        context.memo.add(truth.evaluations as usize);
        Ok(truth.columns)
    }

    fn truth(&self, context: &Context) -> Result<TruthTexels, BakeError> {
        let Region { roughness, mu, .. } = self.region;
        let size = [SIDE, if roughness[0] < roughness[1] { SIDE } else { ROWS }];
        let channels = self.values(&self.at(size, &product(size, 1, 0.0)), context)?;
        let stored = TruthTexels::values(&channels);
        let places = product(size.map(|n| n - 1), MEASURED, 0.5);
        let truths = self.values(&self.at(size, &places), context)?;
        let mut error: f64 = 0.0;
        for (stored, truths) in stored.iter().zip(&truths) {
            let off = |(place, truth): (&[f64; 2], &f64)| (between(stored, size, *place) - truth).abs();
            error = places.iter().zip(truths).map(off).fold(error, f64::max);
        }
        Ok(TruthTexels { error: round_up(error, 2), ..TruthTexels::new([roughness, mu], size, &channels) })
    }

    /// The points at places counted in texels.
    fn at(&self, size: [usize; 2], places: &[[f64; 2]]) -> Points {
        let mut points = Points::default();
        for [column, row] in places {
            let part = row / (size[1] - 1) as f64;
            let roughness = lerp(self.region.roughness, part * part);
            let alpha = self.region.alpha_map.alpha(roughness);
            let mu = view(column / (size[0] - 1) as f64, self.region.mu, alpha);
            self.region.push(&mut points, roughness, mu);
        }
        grid::at(points, &self.at)
    }

    /// Without an approximation, and with each that is emitted; a table where there is none.
    fn spheres(&self, context: &Context) -> Result<Furnace, BakeError> {
        let grid = Grid::curves(&self.region, &SPHERES).at(&self.at);
        let truth = self.values(&grid.points, context)?;
        let of = |i: usize| match &truth[..] {
            [e, b, ..] => Parts::new(e[i], b[i]),
            columns => Parts::new(columns[0][i], 0.0),
        };
        let row = |name: &str, values: &[f64]| {
            // as the page keeps them: four digits are more than a picture shows
            let light = |(i, value)| rounded(self.drawn.light(value, of(i), self.f0), 4);
            let light: Vec<f64> = values.iter().copied().enumerate().map(light).collect();
            FurnaceRow { name: name.into(), of: String::new(), factors: grid.by_roughness(&light) }
        };
        let mut rows = Vec::new();
        if let Drawn::Compensation | Drawn::Base(_) = self.drawn {
            let name = self.drawn.without().map_or("", |(name, _)| name);
            rows.push(row(name, &vec![1.0; grid.points.len()]));
        }
        for fit in self.fits.iter().filter(|fit| fit.emitted) {
            rows.push(row(fit.hypothesis.name(), &grid.values(fit, self.f0)?));
        }
        let ideal: Vec<f64> = (0..grid.points.len()).map(|i| self.drawn.truth(of(i), self.f0)).collect();
        rows.push(row("truth", &ideal));
        Ok(Furnace { roughness: grid.roughness.values, mu: grid.mu.values, rows, amplification: 1.0 })
    }
}

/// Every so many places along two axes, the first fastest, from an offset on.
fn product(size: [usize; 2], step: usize, offset: f64) -> Vec<[f64; 2]> {
    let along = |n: usize| (0..n).step_by(step).map(move |i| i as f64 + offset);
    along(size[1]).flat_map(|row| along(size[0]).map(move |column| [column, row])).collect()
}

fn texels(table: &Table, size: [usize; 2]) -> TableTexels {
    // Browsers have no integers of 16 bits that a sampler filters.
    let format = if table.format == TexelFormat::F16 { TexelFormat::F16 } else { TexelFormat::F32 };
    let mut bytes = Vec::new();
    for i in 0..size[0] * size[1] {
        table.channels.iter().for_each(|channel| format.write(channel.texels[i], &mut bytes));
    }
    TableTexels { size, channels: table.channels.len(), format, data: STANDARD.encode(bytes) }
}
