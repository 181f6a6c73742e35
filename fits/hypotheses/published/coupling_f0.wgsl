/// Published: 1 - f0, what a smooth interface lets in at normal incidence.
fn coupling_f0(f0: f32) -> f32 {
    return 1.0 - f0;
}
