//! Slices of tables of three axes: what they span over all materials that may share a table.

use super::file::Scene;
use super::limits;
use super::material::{EXACT_FRESNEL, Lobe, Material};
use super::table::{Layout, TableWant, enough_slices};

/// The fields that list tables with slices, and the lobes of the materials that have them.
const SLICED: [(&str, Lobe); 3] =
    [("wants", Lobe::Anisotropic), ("wants", Lobe::Glass), (EXACT_FRESNEL, Lobe::Isotropic)];

impl Scene {
    /// Chooses the slices that are left open.
    pub(super) fn settle_slices(&mut self) {
        for of @ (field, lobe) in SLICED {
            let Some(range) = self.sliced_over(of) else { continue };
            // A dielectric's are few as they are.
            let enough = if field == EXACT_FRESNEL { usize::MAX } else { enough_slices(lobe, range) };
            let own = self.materials.iter_mut().filter(|material| material.lobe() == lobe);
            let tables = own.flat_map(Material::tables_mut).filter(|(of, _)| *of == field);
            tables.for_each(|(_, want)| want.settle_slices(enough, range[0] == range[1]));
        }
    }

    /// What the slices of the tables of a field span, of all materials of a lobe that call for them: they may
    /// share a table, and of the exact Fresnel term with every coat.
    fn sliced_over(&self, (field, lobe): (&str, Lobe)) -> Option<[f64; 2]> {
        let is_rough = |[_, high]: [f64; 2]| self.alpha.alpha(high) >= limits::SLICED_ALPHA;
        let spans = self.materials.iter().flat_map(|material| {
            let Material { wants, ior, anisotropy, coat, .. } = material;
            if field == EXACT_FRESNEL {
                let own = wants.exact_fresnel.as_ref().and(*ior).filter(|_| is_rough(material.roughness));
                return [own, coat.as_ref().map(|coat| coat.ior)];
            }
            let is_sliced = |want: &TableWant| want.layout.axes() == 3 && want.layout != Layout::PathTracer;
            let own = if lobe == Lobe::Glass { *ior } else { Some(*anisotropy) };
            let calls = material.lobe() == lobe && wants.tables.iter().any(is_sliced);
            [own.filter(|_| calls && material.rough_range(self.alpha).is_some()), None]
        });
        spans.flatten().reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
    }

    /// Holds tables of an axis less to one value of what it would span.
    pub(super) fn check_slices(&self) -> Result<(), (String, String)> {
        for of in SLICED {
            let Some([low, high]) = self.sliced_over(of).filter(|[low, high]| low < high) else { continue };
            let own = self.materials.iter().enumerate().filter(|(_, material)| material.lobe() == of.1);
            let tables = own.flat_map(|(i, material)| material.tables().map(move |table| (i, table)));
            let of_field = tables.filter(|(_, (field, ..))| *field == of.0);
            if let Some((i, (field, j, want))) =
                of_field.into_iter().find(|(_, (.., want))| want.has_one_slice())
            {
                let name = if of.1 == Lobe::Anisotropic { "anisotropy" } else { "ior" };
                let message = format!(
                    "2 numbers where the {} layout has 3 axes: an axis less is for one value of `{name}`, which is {low} to {high} of the materials and coats that call for it",
                    want.layout.name()
                );
                return Err((format!("materials[{i}].{field}.tables[{j}].size"), message));
            }
        }
        Ok(())
    }
}
