//! An offline toolchain for people who write renderers: it integrates BRDF quantities to a stated
//! accuracy, compresses them into tables and fits, measures every approximation against the truth,
//! and emits what an engine needs together with its certificate and its cost.
//!
//! Below this package: `lobefit-math` (quadrature rules, sums, lanes), `lobefit-truth` (optics, and
//! quantities integrated to a value with an error), `lobefit-shade` (the shader language: parse,
//! evaluate, bound, count, print), `lobefit-fit` (solver, search, texels), `lobefit-ltc` (linearly
//! transformed cosines), `lobefit-surface` (whole materials in a furnace), `lobefit-figures` (values
//! that draw themselves), `lobefit-strict` (a user's files, read strictly) and `lobefit-import` (glTF
//! and MaterialX to scenes). `math` is a package of
//! its own so that neither `shade` nor `fit` can reach optics through it.
//!
//! Above it, each with a binary that [`cli`] runs for its verb: `lobefit-audit` (other people's
//! tables and shader functions against the truth), `lobefit-formula` (a formula of the user's, fitted
//! or searched for), `lobefit-gpu` (machine code and times of the emitted functions on GPUs) and
//! `lobefit-studies` (rendered rooms and spheres, random walks: the long experiments, outside
//! `bake`).
//!
//! A module imports only from the floors below it (`tests/house/floors.rs` reads the imports and
//! fails on an edge that runs upward).
//!
//! | floor | module | purpose |
//! |---|---|---|
//! | 1 | [`data`] | the nouns: axis, table, certificate, cost, approximation |
//! | 1 | [`store`] | the only module that touches the file system |
//! | 2 | [`approximate`] | one formula for one quantity, from target to certificate; knows no effect |
//! | 2 | [`scene`] | bytes to a validated scene; owns all limits on input |
//! | 3 | [`emit`] | tables, fits, lookups and the manifest to bytes, one file per format; knows no effect |
//! | 4 | [`report`] | results to plots, renders and pages; knows no effect |
//! | 5 | [`effects`] | the catalogue: each effect declares its callers, fits, tables, code and page |
//! | 6 | [`plan`] | scene and catalogue to jobs, and to effects left out with the reason |
//! | 7 | [`bake`] | the main job: plan to a bundle of files in memory; `check` compares such bundles |
//! | 8 | [`timing`] | what accuracy costs in seconds; records of times and of machine code |
//! | 9 | [`cli`] | one file per verb |

pub mod approximate;
pub mod bake;
pub mod cli;
pub mod data;
pub mod effects;
pub mod emit;
pub mod plan;
pub mod report;
pub mod scene;
pub mod store;
pub mod timing;
