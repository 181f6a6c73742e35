/// Published: no coupling at all, the base as bright as it were without a lobe above it.
fn coupling_none(mu: f32) -> f32 {
    return 1.0;
}
