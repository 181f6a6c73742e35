//! `ggx-dfg` as a shader sees it: the bilinear lookup of the quantised texels over a dense off-grid
//! set.

use lobefit::approximate::{Memo, Region, certification};
use lobefit::data::{AlphaMap, Decode, Layout, Serves, Smith, Table, TexelFormat};
use lobefit::effects::Albedo;
use lobefit::effects::reflection::{GGX, build, sampled};
use lobefit::effects::table::{BuildError, Errors, Lookup, LookupPoints, Point, Spec, Truth, measure};
use lobefit_truth::integrate::reflection::{TOLERANCE, reflection};
use lobefit_truth::quantity::TRUTH_ERROR;

fn spec(size: usize, layout: Layout, serves: Serves, format: TexelFormat) -> Spec {
    Spec {
        names: vec!["ggx-dfg-test".into()],
        smith: Smith::Correlated,
        size: vec![size, size],
        format,
        layout,
        serves,
        region: Region { roughness: [0.02, 1.0], mu: [0.001, 1.0], alpha_map: AlphaMap::RoughnessSquared }
            .into(),
    }
}

fn errors(spec: &Spec) -> Errors {
    let memo = Memo::default();
    let table = build(&GGX, spec, &memo).expect("a table").remove(0);
    let points = certification(&spec.region.flat(), 16);
    let truth = Albedo::new(spec.smith, &points, true, &memo).expect("a truth");
    let (decode, truth) = (Decode::of(spec.layout, spec.serves), Truth { e: &truth.e, b: Some(&truth.b) });
    let errors = measure(&table, decode, &LookupPoints::isotropic(&points), truth, TRUTH_ERROR)
        .expect("of its decoding");
    println!("{:?} {:?} {:?} {:?}: {errors:?}", spec.size, spec.layout, spec.serves, spec.format);
    errors
}

#[test]
fn bars_of_the_default_tables() {
    let albedo = errors(&spec(32, Layout::Homogeneous, Serves::Albedo, TexelFormat::F16));
    assert!(albedo.lookup.max <= 1e-3, "E at 32x32 f16: {:?}", albedo.lookup);
    let split = errors(&spec(64, Layout::Homogeneous, Serves::SplitSum, TexelFormat::F16));
    assert!(split.lookup.max <= 3e-3, "f0 A + B at 64x64 f16: {:?}", split.lookup);
    assert!(split.lookup.max <= 1e-3, "and by the factored bias a third of that: {:?}", split.lookup);
}

#[test]
fn plain_layouts_are_what_engines_have() {
    let plain = errors(&spec(64, Layout::Plain, Serves::SplitSum, TexelFormat::F16));
    assert!(plain.lookup.max > 0.03, "the layer mu ~ alpha is below its texels: {:?}", plain.lookup);
    let squared = errors(&spec(64, Layout::PlainSquared, Serves::SplitSum, TexelFormat::F16));
    assert!(squared.lookup.max < plain.lookup.max && squared.lookup.max > 5e-3, "{:?}", squared.lookup);
}

/// E of a fully rough surface seen from above is 0.307, and by sampled texels of a plain 32x32
/// table
/// 0.326, since a lookup clamps to the last row: balanced texels halve the error.
#[test]
fn plain_texels_are_balanced_where_the_lookup_clamps() {
    let spec = spec(32, Layout::Plain, Serves::Albedo, TexelFormat::F16);
    let (optimised, sampled) = (build(&GGX, &spec, &Memo::default()), sampled(&GGX, &spec, &Memo::default()));
    let worst = |tables: Result<Vec<Table>, BuildError>| {
        let table = tables.expect("a table").remove(0).quantised();
        let lookup = Lookup::new(&table, Decode::Albedo).expect("a table");
        let error = |roughness: f32| {
            let alpha = roughness * roughness;
            let point = Point { roughness, alpha, mu: 1.0, ..Point::default() };
            let truth = reflection(Smith::Correlated, f64::from(alpha), 1.0, TOLERANCE).expect("inside");
            (f64::from(lookup.at(&point).e) - truth.a - truth.b).abs()
        };
        [0.9, 0.95, 0.97, 63.0 / 64.0, 0.99, 1.0].map(error).into_iter().fold(0.0, f64::max)
    };
    let (optimised, sampled) = (worst(optimised), worst(sampled));
    assert!(sampled > 0.018 && optimised < 0.55 * sampled, "{optimised} {sampled}");
}

/// Where grazing views are not judged, the texels are the better elsewhere.
#[test]
fn a_range_of_cosines_is_what_texels_are_optimised_for() {
    let wide = spec(32, Layout::Plain, Serves::SplitSum, TexelFormat::F16);
    let mut narrow = wide.clone();
    narrow.region.mu = [0.05, 1.0];
    narrow.region.roughness = [0.3, 1.0];
    let (wide, narrow) = (errors(&wide), errors(&narrow));
    assert!(narrow.lookup.max < 0.011 && wide.lookup.max > 0.05, "{:?} {:?}", narrow.lookup, wide.lookup);
}

#[test]
fn a_narrow_range_is_measured_where_it_is() {
    let mut narrow = spec(16, Layout::Homogeneous, Serves::SplitSum, TexelFormat::F32);
    let wide = errors(&narrow);
    narrow.region.roughness = [0.5, 0.7];
    let narrow = errors(&narrow);
    assert!(narrow.lookup.max < 0.7 * wide.lookup.max, "{} {}", narrow.lookup.max, wide.lookup.max);
    let roughness = narrow.lookup.at["roughness"];
    assert!((0.5..=0.7).contains(&roughness), "{roughness}");
}
