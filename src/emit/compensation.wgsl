//! Lobes that are compensated for the light that they lose between facets (Turquin, "Practical multiple scattering compensation for
//! microfacet models", 2019).

/// The factor of ggx_compensate_reflection for one colour channel, 1 + F0 (1 - E)/E: for lobes that are sampled, to
/// multiply the path's weight by.
fn ggx_compensate_reflection_factor(f0: f32, e: f32) -> f32 {
    return 1.0 + f0 * ((1.0 - e) / e);
}

/// A metal's lobe f_ss compensated for the light that it loses between facets: (1 + F0 (1 - E)/E) f_ss, per colour
/// channel. f_ss has its Fresnel factor; e is the sampled albedo of the same lobe without it (F = 1), at the same view.
/// Energy: with f0 = 1 all light comes back, E (1 + (1 - E)/E) = 1; with f0 < 1 the light added is tinted by f0 once,
/// where every further bounce would tint it again. Not reciprocal: E is of the view alone.
/// Domain: 0 < e <= 1; e = 1 returns f_ss. As e goes to 0 the factor grows as f0/e, while f_ss vanishes as e does: at
/// e = 0 itself, which no table holds for a view above the horizon, the result is not finite.
/// Turquin, "Practical multiple scattering compensation for microfacet models", 2019.
fn ggx_compensate_reflection(f_ss: vec3f, f0: vec3f, e: f32) -> vec3f {
    return f_ss * (1.0 + f0 * ((1.0 - e) / e));
}

/// The factor of ggx_compensate_glass, 1/E: for lobes that are sampled, to multiply the path's weight by.
fn ggx_compensate_glass_factor(e: f32) -> f32 {
    return 1.0 / e;
}

/// Rough glass compensated for the light that it loses between facets: f/E, for the reflected and the transmitted lobe
/// alike, per colour channel. e is the sampled R + T of a ray from the same side, at the same view and index of
/// refraction; f may hold the factor 1/eta^2 of radiance, which E, a share of energy, does not.
/// Energy: without absorption all light leaves again, (R + T)/E = 1, in the shares that single scattering has. Not
/// reciprocal: E is of the view alone.
/// Domain: 0 < e <= 1; e = 1 returns f. As e goes to 0 the factor grows as 1/e, while f vanishes as e does: at e = 0
/// itself, which no table holds for a view above the horizon, the result is not finite.
/// Turquin, "Practical multiple scattering compensation for microfacet models", 2019.
fn ggx_compensate_glass(f: vec3f, e: f32) -> vec3f {
    return f / e;
}

// 1 + f0 (N - 1) of a normalisation N, per colour channel.
fn coloured(f0: vec3f, n: f32) -> vec3f {
    return 1.0 + f0 * (n - 1.0);
}
