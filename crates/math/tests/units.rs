//! Arithmetic: tests that stand beside it and see what is private of it. Their files are compiled here
//! once more, and the library is not.
#![allow(dead_code, reason = "what of these files no test calls")]

use lobefit_math::ops;

#[path = "../src/chebyshev.rs"]
mod chebyshev;
#[path = "../src/gauss.rs"]
mod gauss;
#[path = "../src/lanes.rs"]
mod lanes;
#[path = "../src/panels.rs"]
mod panels;
#[path = "../src/piecewise.rs"]
mod piecewise;
#[path = "../src/recurrence.rs"]
mod recurrence;
#[path = "../src/sobol.rs"]
mod sobol;
#[path = "../src/sum.rs"]
mod sum;
