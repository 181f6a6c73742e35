override c0: f32 = 0.277;
override c1: f32 = 0.0124;
override c2: f32 = 0.7546;
override c3: f32 = 1.2222;

/// Factor on a lobe at the nearest point of a disk light of this angular radius, so that it keeps its energy:
/// the share of the lobe's solid angle in that of lobe and disk, whose border is the wider the more the
/// view is face on.
fn lit_energy_13(roughness: f32, mu: f32, light_radius: f32) -> f32 {
    let alpha = roughness * roughness;
    let more = light_radius * (c0 * light_radius + alpha * (c1 + c3 * mu));
    let across = alpha * (mu + c2 * alpha);
    return alpha * across / (alpha * across + more);
}
