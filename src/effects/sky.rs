//! Spheres under a sky: what the roughness of a lobe in place of another one does to a picture.

use std::f64::consts::PI;

use super::BakeError;
use super::grid::{self, at_text};
use super::page::best;
use crate::approximate::{Fit, FitStageError, Region};
use crate::report::{Image, SkySpheres};
use lobefit_math::{ops, sum, vector};
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::optics::ggx::Vec3;
use lobefit_truth::points::Points;
use lobefit_truth::quantity::{Quantity, Seen, Variant};
use rayon::prelude::*;

/// Roughness of the columns, as far as a region has it; of a region without any of these, its middle.
const ROUGHNESS: [f64; 3] = [0.2, 0.4, 0.7];

/// Pixels along a side, and lights of each.
const SIDE: usize = 64;
const DRAWN: usize = 768;

/// What is around a sphere, and the least cosine of a view.
const AROUND: f64 = 0.18;
const GRAZING: f64 = 0.011;

/// Bright bars all around, cut at 35 degrees above and below the horizon, over a darker ground; narrower
/// behind the sphere, where what it refracts comes from.
fn sky([x, y, z]: Vec3) -> f64 {
    let bar = ops::atan2(x, z) * if z < 0.0 { 15.0 } else { 7.0 } / PI;
    let is_bright = bar - 2.0 * (0.5 * bar).floor() < 1.0 && y.abs() < 0.57;
    if is_bright {
        0.95
    } else if y < 0.0 {
        0.06
    } else {
        0.14
    }
}

/// The normals of a sphere's pixels with their cosine to the view, which comes from z; `None` around it.
fn normals() -> Vec<Option<Vec3>> {
    let at = |i: usize| (2.0 * i as f64 + 1.0) / SIDE as f64 - 1.0;
    let normal = |i: usize| {
        let (x, y) = (at(i % SIDE), -at(i / SIDE));
        let square = 1.0 - x * x - y * y;
        (square > 0.0).then(|| {
            let z = square.sqrt().max(GRAZING);
            let scale = ((1.0 - z * z) / (x * x + y * y).max(1e-12)).sqrt();
            [x * scale, y * scale, z]
        })
    };
    (0..SIDE * SIDE).map(normal).collect()
}

/// The sky as the frame of a normal has it, the view at y = 0.
fn turned([x, y, z]: Vec3) -> impl Fn(Vec3) -> f64 {
    let normal = [x, y, z];
    let length = (x * x + y * y).sqrt().max(1e-12);
    // The view less its part along the normal.
    let towards = [-z * x / length, -z * y / length, length];
    let across = vector::cross(normal, towards);
    move |light: Vec3| {
        sky(std::array::from_fn(|k| light[0] * towards[k] + light[1] * across[k] + light[2] * normal[k]))
    }
}

/// The pictures of the lobe itself, of the most accurate fit and of what is published; `None` of a quantity
/// that is no roughness.
pub(super) fn spheres(
    (quantity, variant): (&dyn Quantity, &Variant),
    (region, shown): (&Region, &[(&'static str, f64)]),
    fits: &[Fit],
    of: &str,
) -> Result<Option<SkySpheres>, BakeError> {
    let [low, high] = region.roughness;
    let inside = ROUGHNESS.into_iter().filter(|r| (low..=high).contains(r));
    let mut roughness: Vec<f64> = inside.collect();
    if roughness.is_empty() {
        roughness.push(0.5 * (low + high));
    }
    let Some(seen) = quantity.seen() else { return Ok(None) };
    let normals = normals();
    let published = fits.iter().filter(|fit| fit.norm() == "published");
    let chosen: Vec<&Fit> = best(fits).into_iter().chain(published).collect();
    let pictures = |r: &f64| drawn((seen, variant), &normals, (*r, shown), None);
    let truth = roughness.iter().map(pictures).collect::<Result<Vec<_>, _>>()?;
    let mut rows = vec![("the lobe itself".to_string(), truth.clone())];
    let mut errors = Vec::new();
    for fit in chosen {
        let of_one = |r: &f64| {
            let widths = widths(fit, &normals, (*r, shown), region)?;
            drawn((seen, variant), &normals, (*r, shown), Some(&widths))
        };
        let pictures: Vec<Vec<f64>> = roughness.iter().map(of_one).collect::<Result<_, BakeError>>()?;
        let off = pictures.iter().flatten().zip(truth.iter().flatten()).map(|(a, b)| (a - b) * (a - b));
        let inside = roughness.len() * normals.iter().flatten().count();
        let rms = (sum::pairwise(&off.collect::<Vec<f64>>()) / inside as f64).sqrt();
        errors.push(format!("{} {rms:.3}", fit.approximation.name));
        // At some indices of refraction a rule is no rule.
        match rows[1..].iter_mut().find(|(_, known)| *known == pictures) {
            Some((name, _)) => *name += &format!(", {}", fit.approximation.name),
            None => rows.push((fit.approximation.name.clone(), pictures)),
        }
    }
    let image = |values: &Vec<f64>| Image::of(SIDE, SIDE, |x, y| [values[y * SIDE + x]; 3]);
    let (names, pictures): (Vec<String>, Vec<Vec<Image>>) =
        rows.into_iter().map(|(name, row)| (name, row.iter().map(image).collect())).unzip();
    Ok(Some(SkySpheres {
        title: format!("{of}{}", at_text(shown)),
        caption: format!(
            "Off from the lobe itself, of a sky from 0.06 to 0.95, RMS over all spheres of a row: {}.",
            errors.join(", ")
        ),
        roughness,
        rows: names,
        pictures,
    }))
}

/// What a formula gives at every pixel of a sphere.
fn widths(
    fit: &Fit,
    normals: &[Option<Vec3>],
    (roughness, shown): (f64, &[(&'static str, f64)]),
    region: &Region,
) -> Result<Vec<f64>, BakeError> {
    let mut points = Points::default();
    let r = f64::from(roughness as f32);
    for [.., mu] in normals.iter().map(|normal| normal.unwrap_or([0.0, 0.0, 1.0])) {
        let mu = mu.clamp(region.mu[0], region.mu[1]);
        points.push([("roughness", r), ("alpha", r * r), ("mu", f64::from(mu as f32))]);
    }
    let values = fit.values_for(&grid::at(points, shown), 1.0).map_err(FitStageError::from)?;
    Ok(values.into_iter().map(|width| f64::from(width).clamp(0.0, 1.0)).collect())
}

/// The pixels of a sphere, by its lobe or by those of a roughness at each.
fn drawn(
    (seen, variant): (&dyn Seen, &Variant),
    normals: &[Option<Vec3>],
    (roughness, shown): (f64, &[(&'static str, f64)]),
    widths: Option<&[f64]>,
) -> Result<Vec<f64>, BakeError> {
    let pixel = |(i, normal): (usize, &Option<Vec3>)| {
        let Some(normal) = normal else { return Ok(AROUND) };
        let (sky, further) = (turned(*normal), shown.iter().map(|(_, value)| *value));
        let x: Vec<f64> = [roughness * roughness, normal[2]].into_iter().chain(further).collect();
        match widths {
            None => seen.shown(variant, &x, DRAWN, &sky),
            Some(widths) => seen.in_place(widths[i].max(1e-2), &x, DRAWN, &sky),
        }
    };
    let pixels: Result<Vec<f64>, IntegrateError> = normals.par_iter().enumerate().map(pixel).collect();
    Ok(pixels?)
}
