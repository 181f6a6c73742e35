// What surrounds a coupling factor: the exact one of E and B, and a diffuse base under a lobe. `factor` is the fitted one.

// The factor of a base under a lobe that is multiplied by nothing, by 1/E, or by 1 + f0 (1/E - 1): what f0 A + B leaves after that.

fn diffuse_coupling_exact_single(f0: f32, e: f32, b: f32) -> f32 {
    return 1.0 - (b + f0 * (e - b));
}

fn diffuse_coupling_exact_normalised(f0: f32, e: f32, b: f32) -> f32 {
    return (1.0 - f0) * (1.0 - b / e);
}

fn diffuse_coupling_exact_compensated(f0: f32, e: f32, b: f32) -> f32 {
    let left = (1.0 - f0) * (1.0 - b / e);
    return left + (1.0 - f0) * (1.0 - e) * (1.0 - left);
}

// Lambert's lobe of a factor, 1/pi of it; below 0 only where the factor is not proven to stay above for all f0.

fn base_multiplied(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    return factor(roughness, alpha, mu, f0) * 0.31830987;
}

fn positive(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    return max(factor(roughness, alpha, mu, f0), 0.0);
}

fn base_single(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    return positive(roughness, alpha, mu, f0) * 0.31830987;
}

// A material: its lobe and the share of its albedo, one for all channels or one for each.

fn coloured(lobe: vec3f, albedo: vec3f, red: f32, green: f32, blue: f32) -> vec3f {
    return vec3f(lobe.x + albedo.x * red, lobe.y + albedo.y * green, lobe.z + albedo.z * blue);
}

fn coupled_single(lobe: vec3f, albedo: vec3f, roughness: f32, alpha: f32, mu: f32, f0: f32) -> vec3f {
    let base = base_single(roughness, alpha, mu, f0);
    return lobe + albedo * base;
}

fn coupled_single_rgb(lobe: vec3f, albedo: vec3f, roughness: f32, alpha: f32, mu: f32, f0: vec3f) -> vec3f {
    let red = base_single(roughness, alpha, mu, f0.x);
    let green = base_single(roughness, alpha, mu, f0.y);
    let blue = base_single(roughness, alpha, mu, f0.z);
    return coloured(lobe, albedo, red, green, blue);
}

fn coupled_multiplied(lobe: vec3f, albedo: vec3f, roughness: f32, alpha: f32, mu: f32, f0: f32) -> vec3f {
    let base = base_multiplied(roughness, alpha, mu, f0);
    return lobe + albedo * base;
}

fn coupled_multiplied_rgb(lobe: vec3f, albedo: vec3f, roughness: f32, alpha: f32, mu: f32, f0: vec3f) -> vec3f {
    let red = base_multiplied(roughness, alpha, mu, f0.x);
    let green = base_multiplied(roughness, alpha, mu, f0.y);
    let blue = base_multiplied(roughness, alpha, mu, f0.z);
    return coloured(lobe, albedo, red, green, blue);
}

// A material whose directions can be exchanged: the factor of the light times that of the view, over their average.

// Nodes and weights of the Gauss rule of four nodes for the integral of f(mu) 2 mu over [0, 1].

fn average_nodes() -> vec4f {
    return vec4f(0.13975986, 0.41640957, 0.72315699, 0.9428958);
}

fn average_of(values: vec4f) -> f32 {
    let term_0 = 0.062361942 * max(values.x, 0.0);
    let term_1 = 0.2596951 * max(values.y, 0.0);
    let term_2 = 0.40692914 * max(values.z, 0.0);
    let term_3 = 0.27101383 * max(values.w, 0.0);
    return term_0 + term_1 + term_2 + term_3;
}

// Smallest average that the base is divided by. Where the average is smaller, which is where f0 is next to 1 on a smooth lobe, the
// base sends back less than the factor says, never more, and no more is lost than the factor itself.
fn least_average() -> f32 {
    return 0.001;
}

fn diffuse_coupling_average_single(roughness: f32, alpha: f32, f0: f32) -> f32 {
    let nodes = average_nodes();
    let values = vec4f(
        factor(roughness, alpha, nodes.x, f0),
        factor(roughness, alpha, nodes.y, f0),
        factor(roughness, alpha, nodes.z, f0),
        factor(roughness, alpha, nodes.w, f0)
    );
    return average_of(values);
}

fn diffuse_coupling_average_single_rgb(roughness: f32, alpha: f32, f0: vec3f) -> vec3f {
    return vec3f(
        diffuse_coupling_average_single(roughness, alpha, f0.x),
        diffuse_coupling_average_single(roughness, alpha, f0.y),
        diffuse_coupling_average_single(roughness, alpha, f0.z)
    );
}

fn diffuse_coupling_reciprocal_single(
    average: f32, mu_l: f32, roughness: f32, alpha: f32, mu: f32, f0: f32
) -> f32 {
    let light = positive(roughness, alpha, mu_l, f0);
    let view = positive(roughness, alpha, mu, f0);
    return light * view / max(average, least_average());
}

fn diffuse_coupled_reciprocal_single(
    lobe: vec3f, albedo: vec3f, average: f32, mu_l: f32, roughness: f32, alpha: f32, mu: f32, f0: f32
) -> vec3f {
    let base = diffuse_coupling_reciprocal_single(average, mu_l, roughness, alpha, mu, f0) * 0.31830987;
    return lobe + albedo * base;
}

fn diffuse_coupled_reciprocal_single_rgb(
    lobe: vec3f, albedo: vec3f, average: vec3f, mu_l: f32, roughness: f32, alpha: f32, mu: f32, f0: vec3f
) -> vec3f {
    let red = diffuse_coupling_reciprocal_single(average.x, mu_l, roughness, alpha, mu, f0.x) * 0.31830987;
    let green = diffuse_coupling_reciprocal_single(average.y, mu_l, roughness, alpha, mu, f0.y) * 0.31830987;
    let blue = diffuse_coupling_reciprocal_single(average.z, mu_l, roughness, alpha, mu, f0.z) * 0.31830987;
    return coloured(lobe, albedo, red, green, blue);
}
