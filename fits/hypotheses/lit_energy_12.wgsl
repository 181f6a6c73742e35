override c0: f32 = 0.26;
override c1: f32 = 0.67;
override c2: f32 = 1.02;

/// Factor on a lobe at the nearest point of a disk light of this angular radius, so that it keeps its energy:
/// the share of the lobe's solid angle in that of lobe and disk.
fn lit_energy_12(roughness: f32, mu: f32, light_radius: f32) -> f32 {
    let alpha = roughness * roughness;
    let more = light_radius * (c0 * light_radius + c1 * alpha);
    let across = alpha * (mu + c2 * alpha);
    return alpha * across / (alpha * across + more);
}
