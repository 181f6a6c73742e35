//! An effect added from outside: a quantity with its truth, formulas, a table and a page, baked,
//! checked and emitted by what every effect has. It is Minnaert's lobe (1941), (mu_l
//! mu_v)^alpha / pi, whose albedo is 2 mu^alpha / (2 + alpha).

use lobefit::approximate::{Entry, Formulas};
use lobefit::data::{Layout, Norm, TexelFormat};
use lobefit::effects::context::Context;
use lobefit::effects::demand::{Demand, Job};
use lobefit::effects::table::ValueTable;
use lobefit::effects::value::{self, ValueFits};
use lobefit::effects::{BakeError, Called, Effect, JobSummary, Made, Profile};
use lobefit::scene::{Goals, Scene, TableWant};
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::integrate::brdf::Brdf;
use lobefit_truth::quantity::{Facts, Input, Quantity, Variant};

pub struct Minnaert;

impl Quantity for Minnaert {
    fn facts(&self) -> &Facts {
        const {
            &Facts {
                name: "minnaert",
                inputs: &[Input::new("alpha", [0.0, 1.0]), Input::new("mu", [1e-6, 1.0])],
                outputs: &["E", "error"],
                tolerance: 1e-5,
                smallest_alpha: 1e-4,
                ..Facts::NONE
            }
        }
    }
    fn brdf(&self, _: &Variant, x: &[f64]) -> Result<Brdf<'_>, IntegrateError> {
        let (alpha, width) = (x[0], 1.0);
        let weighted = Box::new(move |view: [f64; 3], light: [f64; 3]| {
            lobefit_math::ops::pow(view[2] * light[2], alpha) * light[2] / std::f64::consts::PI
        });
        Ok(Brdf { weighted, width })
    }
}

const FITS: ValueFits = ValueFits {
    quantity: &Minnaert,
    side: None,
    column: "E",
    used_as: None,
    own: Formulas::of(&[Entry {
        file: "minnaert_e.wgsl",
        source: "override a: f32 = 1.0;\noverride b: f32 = 0.1;\n\
                 fn minnaert_e(alpha: f32, mu: f32) -> f32 { return (1.0 - alpha * (a - mu)) / (1.0 + b * alpha); }\n",
        publication: None,
    }]),
    published: &[],
    role: "minnaert_albedo",
    of: "minnaert",
    field: "roughness",
    layer: None,
    because: "that is drawn as the moon is",
    caption: "E of Minnaert's lobe.",
    curves: &[0.5],
    shown_at: &[],
    seconds: [1.0, 0.1],
    table: None,
    around: None,
};

fn with_table<T>(of: impl FnOnce(ValueFits) -> T) -> T {
    let wants = &[(TableWant::flat(Layout::Homogeneous, [16, 12], TexelFormat::F16), String::new())];
    let table = ValueTable { wants, ..ValueTable::of(&Minnaert, "E", "minnaert", "minnaert_lookup") };
    of(ValueFits { table: Some(table), ..FITS })
}

pub struct Moon;

impl Effect for Moon {
    fn profile(&self) -> &Profile {
        const { &Profile { name: "moon", ..Profile::NONE } }
    }
    fn demands(&self, scene: &Scene) -> Vec<Demand> {
        let goals = Goals { max_error: Some(0.5), norms: vec![Norm::Max], ..Goals::default() };
        vec![FITS.demand(scene, 0, [0.3, 1.0], goals)]
    }
    fn left_out(&self, _: &Scene) -> String {
        "nothing is drawn as the moon is".into()
    }
    fn expects(&self, _: &Scene, jobs: &[Job]) -> Vec<JobSummary> {
        with_table(|fits| value::expects(&[fits], jobs))
    }
    fn formulas(&self) -> Vec<&'static Entry> {
        FITS.own.entries().collect()
    }
    fn bake(&self, called: &Called, context: &Context) -> Result<Made, BakeError> {
        with_table(|fits| fits.bake(called, context))
    }
}
