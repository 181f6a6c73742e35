//! Lookups of probes as emitted: what they fetch, in every language.

use crate::emit_support::compilers::includes_in_cpp;
use crate::emit_support::languages::{FAMILY, compile};
use crate::emit_support::programs::compile_library;
use crate::lookup_support::{EMITTED, Emitted, Job, RHO, found, text};
use lobefit_math::vector::length;
use lobefit_shade::code::Language;
use rayon::prelude::*;

#[test]
fn lookups_fetch_in_every_language_what_those_of_the_study_do() {
    assert_eq!(EMITTED.len(), 19);
    let rust = text(Language::Rust);
    compile_library(&rust);
    for language in [Language::Hlsl, Language::Glsl] {
        assert!(compile(language, &text(language)).is_none_or(|functions| functions > EMITTED.len()));
    }
    includes_in_cpp(&text(Language::C));
    let jobs: Vec<Job> = EMITTED.par_iter().map(Emitted::job).collect();
    let asked: Vec<_> = jobs.iter().map(|job| (job.emitted, &job.points[..])).collect();
    for language in FAMILY.into_iter().chain([Language::Rust]) {
        let Some(found) = found(language, &asked) else { continue };
        for (job, found) in jobs.iter().zip(&found) {
            job.agrees(language.name(), found);
        }
    }
}

/// From places outside of the proxy and on its walls a rough surface stays rough: no width is below
/// that of the least ratio that is certified.
#[test]
fn outside_of_the_proxy_widths_are_those_of_certified_ratios() {
    let one = |emitted: &&Emitted| emitted.lookup.taps == 1 && !emitted.lookup.is_fitted();
    let outside = |emitted: &'static Emitted| {
        let mut points = emitted.points();
        points.retain(|point| emitted.is_outside(point));
        assert!(points.len() > 500, "{}", points.len());
        (emitted, points)
    };
    let jobs: Vec<_> = EMITTED.iter().filter(one).map(outside).collect();
    let jobs: Vec<_> = jobs.iter().map(|(emitted, points)| (*emitted, &points[..])).collect();
    let found = found(Language::Rust, &jobs).expect("rustc is there");
    for ((emitted, points), found) in jobs.iter().zip(&found) {
        for (point, found) in points.iter().zip(found.chunks_exact(4)) {
            let [x, y, z, width] = [0, 1, 2, 3].map(|k| f64::from(found[k]));
            let width = if emitted.entry["gives"] == "mip" { (width / 6.0) * (width / 6.0) } else { width };
            let least = emitted.width_at(f64::from(point[9]), RHO[0]);
            assert!(
                width >= 0.999 * least && width <= 1.0 + 1e-6,
                "{} at {point:?}: {width}",
                emitted.name()
            );
            assert!((length([x, y, z]) - 1.0).abs() < 1e-5, "{} at {point:?}", emitted.name());
        }
    }
}
