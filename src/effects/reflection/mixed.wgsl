fn ggx_mixed_normalised(metalness: f32, dielectric_f0: vec3f, metal_f0: vec3f, schlick: f32, n: f32) -> vec3f {
    let dielectric = (dielectric_f0 + (1.0 - dielectric_f0) * schlick) * n;
    let metal = (metal_f0 + (1.0 - metal_f0) * schlick) * (1.0 + metal_f0 * (n - 1.0));
    return dielectric + metalness * (metal - dielectric);
}

fn ggx_mixed_compensated(metalness: f32, dielectric_f0: vec3f, metal_f0: vec3f, schlick: f32, n: f32) -> vec3f {
    let dielectric = (dielectric_f0 + (1.0 - dielectric_f0) * schlick) * (1.0 + dielectric_f0 * (n - 1.0));
    let metal = (metal_f0 + (1.0 - metal_f0) * schlick) * (1.0 + metal_f0 * (n - 1.0));
    return dielectric + metalness * (metal - dielectric);
}

fn ggx_mixed_single(metalness: f32, dielectric_f0: vec3f, metal_f0: vec3f, schlick: f32, n: f32) -> vec3f {
    let dielectric = dielectric_f0 + (1.0 - dielectric_f0) * schlick;
    let metal = (metal_f0 + (1.0 - metal_f0) * schlick) * (1.0 + metal_f0 * (n - 1.0));
    return dielectric + metalness * (metal - dielectric);
}
