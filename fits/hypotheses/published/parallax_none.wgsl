/// Width of a fetch from a probe: no correction.
fn parallax_none(alpha: f32) -> f32 {
    return alpha;
}
