//! FLIP against the figures of its authors' program, and what follows from its definition.

use crate::flip_support;

use flip_support::{NAMES, SIZE, pair};
use lobefit::report::Image;
use lobefit_formula::perceptual::sensitivity;
use lobefit_math::ops;
use lobefit_studies::flip::{ErrorMap, Exposures, FlipError, PIXELS_PER_DEGREE, Reference, ldr};
use serde_json::Value;

const ORACLE: &str = include_str!("../oracle/flip-evaluator-1.7.json");

fn images(name: &str) -> [Image; 2] {
    pair(name).map(|pixels| Image { width: SIZE.0, height: SIZE.1, pixels })
}

fn grey(level: f64) -> Image {
    Image::of(SIZE.0, SIZE.1, |_, _| [level; 3])
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

/// The program computes in f32. Where both pictures rise alike, the features' difference is its
/// rounding error, whose root we see: 1.4e-4 in `ramps`, below 3e-5 elsewhere.
#[test]
fn maps_are_those_of_the_authors_program() {
    let oracle: Value = serde_json::from_str(ORACLE).expect("JSON");
    let comparisons = oracle["comparisons"].as_array().expect("a list");
    assert_eq!(comparisons.len(), 7);
    for expected in comparisons {
        let name = expected["pair"].as_str().expect("a name");
        let [reference, test] = images(name);
        let map = if expected["range"] == "hdr" {
            let (map, exposures) = hdr(&reference, &test, PIXELS_PER_DEGREE).expect("a map");
            for (ours, key) in [(exposures.start, "start"), (exposures.stop, "stop")] {
                assert!((ours - number(&expected[key])).abs() < 2e-6, "{name}: {key} {ours}");
            }
            assert_eq!(exposures.count as u64, expected["count"], "{name}");
            map
        } else {
            ldr(&reference, &test, PIXELS_PER_DEGREE).expect("a map")
        };
        let theirs: Vec<f64> = expected["map"].as_array().expect("a map").iter().map(number).collect();
        assert_eq!(map.values.len(), theirs.len());
        let apart = map.values.iter().zip(&theirs).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart < 2e-4, "{name}: a pixel differs by {apart}");
        let mean = mean_of(&map);
        assert!((mean - number(&expected["mean"])).abs() < 1e-4, "{name}: mean {mean}");
    }
}

#[test]
fn equal_pictures_have_no_difference_and_green_and_blue_the_largest() {
    for name in NAMES {
        let [picture, _] = images(name);
        let (map, _) = hdr(&picture, &picture, PIXELS_PER_DEGREE).expect("a map");
        assert!(map.values.iter().all(|&v| v == 0.0), "{name}");
    }
    let flat = |colour: [f64; 3]| Image::of(16, 16, |_, _| colour);
    let map = ldr(&flat([0.0, 1.0, 0.0]), &flat([0.0, 0.0, 1.0]), PIXELS_PER_DEGREE).expect("a map");
    assert!(map.values.iter().all(|v| (v - 1.0).abs() < 1e-12), "{:?}", map.values[0]);
}

/// Of flat grey pictures FLIP is the compressed difference in lightness alone: to first order that
/// of `sensitivity`.
#[test]
fn a_small_step_of_grey_costs_what_the_sensitivity_says() {
    for level in [1e-3, 0.02, 0.18, 0.5, 0.98] {
        let step = 1e-5 * level;
        let flip = mean_of(&ldr(&grey(level), &grey(level + step), PIXELS_PER_DEGREE).expect("a map"));
        let whole = mean_of(&ldr(&grey(level), &grey(level + 4.0 * step), PIXELS_PER_DEGREE).expect("a map"));
        // Four times the step: 4^0.7 of the difference.
        assert!((whole / flip / ops::pow(4.0, 0.7) - 1.0).abs() < 1e-3, "{level}: {flip}, {whole}");
        let unit = flip / ops::pow(sensitivity(level) * step, 0.7);
        let other = mean_of(&ldr(&grey(0.25), &grey(0.25 + 1e-6), PIXELS_PER_DEGREE).expect("a map"));
        let expected = other / ops::pow(sensitivity(0.25) * 1e-6, 0.7);
        assert!((unit / expected - 1.0).abs() < 1e-3, "{level}: {unit}, {expected}");
    }
    assert!((sensitivity(0.0) - 903.3).abs() < 0.1 && (sensitivity(1.0) - 38.67).abs() < 0.01);
}

/// HDR-FLIP of two pictures, with its exposures.
fn hdr(reference: &Image, test: &Image, resolution: f64) -> Result<(ErrorMap, Exposures), FlipError> {
    let reference = Reference::new(reference, resolution)?;
    Ok((reference.against(test)?, reference.exposures))
}

fn mean_of(map: &ErrorMap) -> f64 {
    lobefit_math::sum::mean(&map.values)
}

/// Light at the ends of f64: exposures are finite, a picture differs from itself by nothing and
/// from another by something, and as much as the same pictures do where no number is subnormal.
#[test]
fn the_faintest_and_the_brightest_light_can_be_compared() {
    let scaled = |picture: &Image, by: f64| Image {
        pixels: picture.pixels.iter().map(|p| p.map(|x| x * by)).collect(),
        ..picture.clone()
    };
    let [a, b] = images("lamp");
    // Powers of two, so that no digit is lost; the median is below its least in the first two.
    let faint = ops::exp2(-1000.0);
    for by in [faint * ops::exp2(-40.0), faint, ops::exp2(980.0)] {
        let [reference, test] = [&a, &b].map(|picture| scaled(picture, by));
        let (map, exposures) = hdr(&reference, &test, PIXELS_PER_DEGREE).expect("a map");
        assert!(exposures.start.is_finite() && exposures.stop.is_finite(), "{exposures:?}");
        assert!(map.values.iter().all(|v| (0.0..=1.0).contains(v)), "{by:e}");
        assert!(mean_of(&map) > 0.01, "{by:e}: {}", mean_of(&map));
        let (same, _) = hdr(&reference, &reference, PIXELS_PER_DEGREE).expect("a map");
        assert!(same.values.iter().all(|&v| v == 0.0), "{by:e}");
    }
    let mean = |by: f64| {
        let [reference, test] = [&a, &b].map(|picture| scaled(picture, by));
        mean_of(&hdr(&reference, &test, PIXELS_PER_DEGREE).expect("a map").0)
    };
    assert!((mean(ops::exp2(980.0)) - mean(1.0)).abs() < 1e-9, "exposure takes the scale away");
    assert!((mean(faint * ops::exp2(-40.0)) - mean(faint)).abs() < 1e-9, "subnormal or not");
    let said = hdr(&scaled(&a, 1e300), &b, PIXELS_PER_DEGREE).expect_err("refused").to_string();
    assert!(said.contains("a number from 0 to 1e300 is called for"), "{said}");
}

/// A reference that is prepared once gives the maps that it gives each time.
#[test]
fn a_prepared_reference_gives_the_same_map() {
    let [reference, test] = images("dark-half");
    let prepared = Reference::new(&reference, PIXELS_PER_DEGREE).expect("a reference");
    let (map, exposures) = hdr(&reference, &test, PIXELS_PER_DEGREE).expect("a map");
    assert_eq!((prepared.against(&test).expect("a map"), prepared.exposures), (map, exposures));
    let other = Image::of(4, 2, |_, _| [0.5; 3]);
    assert!(prepared.against(&other).expect_err("refused").to_string().contains("of one size"));
}

#[test]
fn pictures_that_cannot_be_compared_are_refused_by_name() {
    let refused = |a: &Image, b: &Image, resolution| hdr(a, b, resolution).expect_err("refused").to_string();
    let picture = grey(0.5);
    assert_eq!(
        refused(&picture, &Image::of(4, 2, |_, _| [0.5; 3]), 67.0),
        "FLIP: the reference is (32, 24) pixels, the test (4, 2); give pictures of one size"
    );
    let mut broken = picture.clone();
    broken.pixels[SIZE.0 + 3] = [0.5, f64::NAN, 0.5];
    let said = refused(&picture, &broken, 67.0);
    assert!(said.contains("the test picture at column 3, row 1 is NaN"), "{said}");
    broken.pixels[0] = [1.5, 0.0, 0.0];
    let said = ldr(&broken, &picture, 67.0).expect_err("refused").to_string();
    assert!(said.contains("the reference picture at column 0, row 0 is 1.5; a number from 0 to 1"), "{said}");
    assert!(refused(&picture, &picture, 0.0).contains("0 pixels per degree"));
    assert!(refused(&grey(0.0), &picture, 67.0).contains("black everywhere"));
    let short = Image { width: 4, height: 4, pixels: vec![[0.0; 3]; 3] };
    let said = refused(&short, &short, 67.0);
    assert!(said.contains("the reference picture has 3 pixels, 4 x 4 are called for"), "{said}");
}
