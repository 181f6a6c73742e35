/// Width of a fetch from a probe: Godot, pull request 106292, seen at a right angle, whose levels of 7 hold the fourth root of alpha. The
/// distance counts in metres there: the probe is taken to be 1 m from the wall.
fn parallax_godot(roughness: f32, rho: f32) -> f32 {
    let root = sqrt(roughness);
    let level = mix(roughness * roughness, root, saturate(rho * 0.14285714 + root));
    let square = level * level;
    return square * square;
}
