//! A scene with the limits of a command line in place of its own.

use super::goals::Goals;
use super::{Layout, Scene, TableWant};
use crate::data::{Pick, Vendor};
use lobefit_shade::code::Language;

/// Limits on every function of a scene, and the language that they are printed in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Most operations, or where a vendor is given, the most by the model of its GPUs.
    pub budget: Option<f64>,
    /// The vendor.
    pub vendor: Option<Vendor>,
    /// Largest error of each.
    pub max_error: Option<f64>,
    /// Most bytes of a table.
    pub max_bytes: Option<u64>,
    /// Language.
    pub language: Language,
}

impl Scene {
    /// The same materials and probes under these limits: for each job one function, without pages.
    /// Where a limit on errors or on bytes is given, the sizes of tables are open.
    pub fn limited(mut self, limits: &Limits) -> Scene {
        let Limits { budget, vendor, max_error, max_bytes, language } = *limits;
        let output = &mut self.output;
        output.pick = Pick::Best;
        output.reports = false;
        output.languages = vec![language];
        output.cost = vendor;
        output.budget = budget.filter(|_| vendor.is_some());
        output.every_error = max_error;
        let max_ops = budget.filter(|_| vendor.is_none()).map(|most| most as u32);
        let limit = |goals: &mut Goals| (goals.max_ops, goals.max_error) = (max_ops, max_error);
        for material in &mut self.materials {
            material.goals_mut().for_each(limit);
            if max_error.is_some() || max_bytes.is_some() {
                let most = max_bytes.unwrap_or(u64::MAX);
                material.tables_mut().for_each(|(_, table)| table.open(max_error, most));
            }
        }
        for probe in &mut self.probes {
            // A probe's own limit is on the total variation.
            (probe.goals.max_ops, probe.goals.max_error) = (max_ops, None);
        }
        self
    }
}

impl TableWant {
    /// Leaves the size to the bake, within so many bytes. The path tracer's layout has its own; a pair's is
    /// halved.
    fn open(&mut self, max_error: Option<f64>, max_bytes: u64) {
        if self.layout != Layout::PathTracer {
            self.size = self.size.take().filter(|size| size.len() > 2 || self.layout == Layout::AreaLights);
            (self.max_error, self.max_bytes) = (max_error, Some(max_bytes));
        }
    }
}
