//! The energy-preserving Oren-Nayar BRDF (Portsmouth, Kutz and Hill, "EON: A practical energy-preserving rough diffuse BRDF", 2024).

/// The cosine-weighted average of E over all views of the single-scattering lobe, exact:
/// (1 + (2/3 - 28/(15 pi)) roughness)/(1 + (1/2 - 2/(3 pi)) roughness). A constant of the material.
fn eon_average(roughness: f32) -> f32 {
    return (1.0 + 0.072488212 * roughness) / (1.0 + 0.28779341 * roughness);
}

// 1 less the average, which is 0 for Lambert's lobe
fn lost(roughness: f32) -> f32 {
    return 0.2153052 * roughness / (1.0 + 0.28779341 * roughness);
}

/// The single-scattering lobe of a white base, 1/sr (Oren and Nayar 1994, in the form of Fujii and of EON). l_dot_v is the
/// cosine between light and view. Reciprocal; roughness 0 is Lambert's 1/pi.
fn eon_single(roughness: f32, mu: f32, mu_l: f32, l_dot_v: f32) -> f32 {
    let s = l_dot_v - mu * mu_l;
    let t = select(1.0, max(mu, mu_l), s > 0.0);
    return 0.31830989 * (1.0 + roughness * s / t) / (1.0 + 0.28779341 * roughness);
}

// albedo^2 average/(1 - albedo (1 - average)) per channel: what light of several bounces is coloured by
fn bounced(albedo: vec3f, average: f32) -> vec3f {
    return albedo * albedo * average / (1.0 - albedo * (1.0 - average));
}

fn eon_brdf(albedo: vec3f, roughness: f32, mu: f32, mu_l: f32, l_dot_v: f32) -> vec3f {
    let single = eon_single(roughness, mu, mu_l, l_dot_v);
    let several = (1.0 - e(roughness, mu)) * (1.0 - e(roughness, mu_l)) / max(3.14159265 * lost(roughness), 1e-7);
    let colour = bounced(albedo, eon_average(roughness));
    return albedo * single + colour * several;
}
