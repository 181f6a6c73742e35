//! The hypotheses of this effect and the published formulas that they compete with. The files are what a person writes; they are
//! compiled in, so that nothing depends on the working directory.

/// One WGSL file of the catalogue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// File name.
    pub file: &'static str,
    /// WGSL source.
    pub source: &'static str,
    /// The publication, for a formula with published constants.
    pub publication: Option<&'static str>,
}

macro_rules! own {
    ($($name:literal),* $(,)?) => {
        [$(Entry {
            file: concat!($name, ".wgsl"),
            source: include_str!(concat!("../../../fits/hypotheses/", $name, ".wgsl")),
            publication: None,
        }),*]
    };
}

macro_rules! published {
    ($($name:literal by $publication:literal),* $(,)?) => {
        [$(Entry {
            file: concat!("published/", $name, ".wgsl"),
            source: include_str!(concat!("../../../fits/hypotheses/published/", $name, ".wgsl")),
            publication: Some($publication),
        }),*]
    };
}

/// N(alpha, mu) with free parameters, by rising cost.
pub const NORMALISATIONS: [Entry; 14] = own![
    "ggx_norm_r1",
    "ggx_norm_n2",
    "ggx_norm_r2",
    "ggx_norm_n1",
    "ggx_norm_r3p",
    "ggx_norm_r4",
    "ggx_norm_r4p",
    "ggx_norm_r5",
    "ggx_norm_r6",
    "ggx_norm_q12",
    "ggx_norm_q13",
    "ggx_norm_q15",
    "ggx_norm_q16",
    "ggx_norm_q20",
];

/// E_avg(alpha) with free parameters.
pub const AVERAGES: [Entry; 1] = own!["ggx_eavg_5"];

/// The formulas of the source post, which started this: emitted beside ours.
pub const SEEDS: [Entry; 2] = published![
    "ggx_norm_pesce_n2" by "A. Pesce, Misunderstanding Multiscattering, 2019",
    "ggx_norm_pesce_n1" by "A. Pesce, Misunderstanding Multiscattering, 2019",
];

/// What engines ship, as N = 1/E: measured and reported, not emitted.
pub const RIVALS: [Entry; 10] = published![
    "ggx_norm_narkowicz_l2" by "K. Narkowicz, Analytical DFG Term for IBL, 2014, after Lazarov",
    "ggx_norm_turquin_label" by "WGSL engines, labelled Turquin 2019",
    "ggx_norm_dassault" by "Dassault Systemes, Enterprise PBR Shading Model",
    "ggx_norm_karis" by "B. Karis, Physically Based Shading on Mobile, 2014",
    "ggx_norm_narkowicz_p1" by "K. Narkowicz, Analytical DFG Term for IBL, 2014",
    "ggx_norm_pesce_iwanicki" by "Pesce and Iwanicki, Approximate Models for PBR, 2015",
    "ggx_norm_tauray" by "VGA group, Tauray",
    "ggx_norm_ue5" by "Unreal Engine 5, ShadingEnergyConservation",
    "ggx_norm_ray_tracing_gems" by "Ray Tracing Gems, ch. 32, 2019",
    "ggx_norm_materialx_m1" by "MaterialX, mx_microfacet_specular",
];

/// Names of the functions of the catalogue: those of the files.
pub fn catalogue_names() -> impl Iterator<Item = String> {
    let entries = NORMALISATIONS.iter().chain(&AVERAGES).chain(&SEEDS).chain(&RIVALS);
    entries.map(|entry| entry.file.trim_start_matches("published/").trim_end_matches(".wgsl").to_string())
}

/// Every WGSL source of the catalogue, in a fixed order: part of a bake's recipe.
pub fn catalogue_sources() -> impl Iterator<Item = &'static str> {
    NORMALISATIONS.iter().chain(&AVERAGES).chain(&SEEDS).chain(&RIVALS).map(|entry| entry.source)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::Hypothesis;

    #[test]
    fn functions_are_named_like_their_files() {
        let entries = NORMALISATIONS.iter().chain(&AVERAGES).chain(&SEEDS).chain(&RIVALS);
        for (entry, name) in entries.zip(catalogue_names()) {
            assert_eq!(Hypothesis::parse(entry.file, entry.source).expect("parses").name(), name);
        }
    }
}
