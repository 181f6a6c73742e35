//! The page: errors over roughness and mu, and lobes beside what stands for them.

use serde::Serialize;

use super::bake::Baked;
use crate::effects::BakeError;
use crate::report::{
    Block, Curves, EffectFinding, Field, HeatMap, Origin, Page, Ruler, Section, Series, Spread, Style,
    figures as drawn, words,
};
use lobefit_ltc::{Deviation, Lookup, Matrix, View};

/// Roughness and mu of the views that are drawn.
const VIEWS: [[f64; 2]; 4] = [[0.3, 0.8], [0.6, 0.5], [0.6, 0.1], [1.0, 0.1]];

/// Half of the directions of a drawn lobe, from one horizon to the other.
const STEPS: i32 = 90;

/// The figures of the page.
#[derive(Serialize)]
pub(super) struct Figures {
    effect: EffectFinding,
    pairs: Vec<PairFigures>,
}

#[derive(Serialize)]
struct PairFigures {
    table: String,
    squares: usize,
    errors: Vec<(&'static str, [f64; 2])>,
    map: Field,
}

/// What was measured of a pair, with what each error is of.
fn errors(one: &Baked) -> [(&'static str, Deviation); 6] {
    let m = &one.measured;
    [
        ("a square light, share of the lobe's light", m.shape),
        ("a light of any shape, at most", m.misplaced),
        ("E", m.amplitude),
        ("B", m.bias),
        ("ltc_quad in f32, from the closed form", m.code),
        ("the horizon by (l² + z)/(l + 1) in place of clipping", m.horizon),
    ]
}

fn map(one: &Baked) -> Field {
    let [roughness, mu] = &one.measured.axes;
    let ruler = |name: &str, values: Vec<f64>| Ruler { name: name.into(), values };
    let rows = one.measured.map.chunks(roughness.len()).rev();
    Field {
        name: "largest error of a square light".into(),
        unit: String::new(),
        signed: false,
        x: ruler("roughness", roughness.clone()),
        y: ruler("mu", mu.iter().rev().copied().collect()),
        values: rows.flatten().map(|error| *error as f32).collect(),
    }
}

/// The lobe and its cosine in the plane of incidence.
fn chart(one: &Baked, [roughness, mu]: [f64; 2], alpha: f64) -> Result<Curves, BakeError> {
    let view = View::new(one.lobe, one.lobe.within(alpha), mu)?;
    let matrix = Matrix::of_texel(one.pair.at(roughness, mu, Lookup::Exact)[0]);
    let line = |name: &str, style: Style, density: &dyn Fn([f64; 3]) -> f64| {
        let at = |k: i32| {
            let degrees = f64::from(k) * 90.0 / f64::from(STEPS);
            let (s, c) = lobefit_math::ops::sincos(degrees.to_radians());
            (degrees, density([-s, 0.0, c]))
        };
        Series::line(name, (-STEPS..=STEPS).map(at).collect(), style)
    };
    let series = vec![
        line("lobe", Style::Truth, &|light| view.density(light)),
        line("transformed cosine", Style::Line(0), &|light| matrix.density(light)),
    ];
    let axes = [
        ("angle from the normal, away from the view", Spread::Linear),
        ("share per steradian", Spread::Root),
    ];
    Ok(Curves::new(format!("roughness {roughness}, μ {mu}"), axes, series, (300.0, 190.0)))
}

/// The figures.
pub(super) fn figures(effect: &EffectFinding, baked: &[Baked]) -> Figures {
    let pair = |one: &Baked| PairFigures {
        table: one.approximations()[0].name.clone(),
        squares: one.measured.shape.count,
        errors: errors(one).map(|(what, error)| (what, [error.max, error.rms])).into(),
        map: map(one),
    };
    Figures { effect: effect.clone(), pairs: baked.iter().map(pair).collect() }
}

/// The page.
pub(super) fn page(origin: Origin, baked: &[Baked], alpha: impl Fn(f64) -> f64) -> Result<Page, BakeError> {
    let section = |one: &Baked| -> Result<Section, BakeError> {
        let table = &one.approximations()[0].name;
        let row = |(what, d): (&str, Deviation)| {
            let at = format!("roughness {:.3}, μ {:.3}", d.at[0], d.at[1]);
            vec![what.to_string(), words::max(d.max), words::mean(d.rms), at]
        };
        let columns = "error of|max>|RMS>|worst at";
        let caption = format!(
            "{} squares that face the shaded point: six sizes, from half the lobe's width to 69 degrees from middle to side, each \
             about the mirror direction, with an edge or a corner on it, above and below. The share of a sphere is off by {} at most.",
            one.measured.shape.count,
            words::max(one.measured.sphere.max)
        );
        let rows = errors(one).into_iter().map(row).collect();
        let field = words::labelled(&map(one));
        let maps =
            [HeatMap { size: (330.0, 250.0), ..HeatMap::of("largest error of a square light", &field) }];
        let charts: Vec<Curves> =
            VIEWS.into_iter().map(|view| chart(one, view, alpha(view[0]))).collect::<Result<_, _>>()?;
        let blocks = vec![
            Block::Table(words::table(columns, rows, &caption)),
            drawn(&maps, "Where a single matrix is far from the lobe.")?,
            drawn(
                &charts,
                "The lobe times the cosine in the plane of incidence, and the cosine that the matrix makes.",
            )?,
        ];
        let lead = "The first four errors are of lookups of the stored texels: of squares at places by turns at a texel and between two, of E and B at every texel and at thirds between them.";
        Ok(Section::new(table.clone(), table.clone(), lead, blocks))
    };
    let lead = "A matrix stretches and tilts a cosine until it resembles the lobe; what a polygon sends by it has a closed form. Whatever the \
                matrix, it is not the lobe: the errors are what is left.";
    Ok(Page {
        title: "lobefit: area lights".into(),
        origin,
        lead: lead.into(),
        sections: baked.iter().map(section).collect::<Result<_, _>>()?,
    })
}
