//! `ggx-dfg` as a shader sees it: the bilinear lookup of the quantised texels over a dense off-grid
//! set.

use lobefit::approximate::{Counter, Region, certification};
use lobefit::data::{AlphaMap, Decode, Layout, Serves, Smith, TexelFormat};
use lobefit::effects::Albedo;
use lobefit::effects::reflection::build;
use lobefit::effects::table::{Errors, Lookup, LookupPoints, Point, Spec, Truth, measure};
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
    let counter = Counter::default();
    let table = build(spec, &counter).expect("a table").remove(0);
    let points = certification(&spec.region.flat(), 16);
    let truth = Albedo::new(spec.smith, &points, true, &counter).expect("a truth");
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

/// E of a fully rough surface, by the lookup of a plain table of 32 texels, at the grazing end,
/// where a lookup clamps to the first texel. The truth rises from 0.307 to 0.326 before it.
#[test]
fn plain_texels_are_balanced_where_the_lookup_clamps() {
    let spec = spec(32, Layout::Plain, Serves::Albedo, TexelFormat::F16);
    let table = build(&spec, &Counter::default()).expect("a table").remove(0).quantised();
    let lookup = Lookup::new(&table, Decode::Albedo).expect("a table");
    for mu in [0.001, 0.004, 0.01, 1.0 / 64.0, 0.02, 0.1, 0.5, 1.0] {
        let point = Point { roughness: 1.0, alpha: 1.0, mu, ..Point::default() };
        let truth = reflection(Smith::Correlated, 1.0, f64::from(mu), TOLERANCE).expect("in the domain");
        let (e, truth) = (f64::from(lookup.at(&point).e), truth.a + truth.b);
        assert!((e - truth).abs() < 0.0105, "{mu}: {e} {truth}");
    }
}

/// Where grazing views are not judged, the texels are the better elsewhere.
#[test]
fn a_range_of_cosines_is_what_texels_are_optimised_for() {
    let wide = spec(32, Layout::Plain, Serves::SplitSum, TexelFormat::F16);
    let mut narrow = wide.clone();
    narrow.region.mu = [0.05, 1.0];
    narrow.region.roughness = [0.3, 1.0];
    let (wide, narrow) = (errors(&wide), errors(&narrow));
    assert!(narrow.lookup.max < 0.006 && wide.lookup.max > 0.05, "{:?} {:?}", narrow.lookup, wide.lookup);
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
