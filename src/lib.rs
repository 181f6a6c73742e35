//! An offline toolchain for people who write renderers: it integrates BRDF quantities to a stated accuracy,
//! compresses them into tables and fits, measures every approximation against the truth, and emits what an
//! engine needs together with its certificate and its cost.
//!
//! A module imports only from the floors below it (`tests/house/floors.rs` reads the imports and fails on an edge that
//! runs upward).
//!
//! | floor | module | purpose |
//! |---|---|---|
//! | 0 | [`math`] | scalar operations, quadrature rules, sums, low-discrepancy points |
//! | 1 | [`data`] | the nouns: axis, table, certificate, cost, approximation |
//! | 2 | [`optics`] | pure models, each with its limits and its source |
//! | 3 | [`integrate`] | a quantity at a point: value with error bound; whole tables, with the SIMD that the processor has |
//! | 3 | [`fit`] | hypotheses and data to fits; knows nothing of optics |
//! | 4 | [`effects`] | the catalogue: quantities, tables, hypotheses and published rivals of each effect |
//! | 4 | [`scene`] | bytes to a validated scene; owns all limits on input |
//! | 5 | [`plan`] | scene to jobs, and to effects left out with the reason |
//! | 5 | [`emit`] | tables, fits, lookups and compensations to bytes, one file per format |
//! | 5 | [`foreign`] | bytes of other people's tables and shader functions to plain values and tapes |
//! | 5 | [`report`] | results to plots, renders and pages |
//! | 5 | [`store`] | the only module that touches the file system |
//! | 6 | [`audit`] | somebody else's table or shader function against the truth |
//! | 6 | [`bake`] | the main job: plan to a bundle of files in memory; `check` compares such bundles |
//! | 6 | [`fitting`] | a formula of the user's: samples, fit, certificates, code and page in memory |
//! | 7 | [`study`] | the long studies: rendered spheres and random walks, outside `bake` |
//! | 7 | [`timing`] | what accuracy costs in seconds |
//! | 8 | [`cli`] | one file per verb |

pub mod audit;
pub mod bake;
pub mod cli;
pub mod data;
pub mod effects;
pub mod emit;
pub mod fit;
pub mod fitting;
pub mod foreign;
pub mod integrate;
pub mod math;
pub mod optics;
pub mod plan;
pub mod report;
pub mod scene;
pub mod store;
pub mod study;
pub mod timing;
