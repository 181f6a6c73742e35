//! BRDF quantities with their errors, for renderers and their tests: [`optics`] has the pure
//! models, each with its limits and its source; [`integrate`] integrates them by quadrature to a
//! value with an error, and by Monte Carlo as the second opinion; [`points`] are columns of inputs;
//! [`quantity`] lists what can be asked for by name; [`accuracy`] says what each way to compute it costs.

pub mod accuracy;
pub mod integrate;
pub mod optics;
pub mod points;
pub mod quantity;
