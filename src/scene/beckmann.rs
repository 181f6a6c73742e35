//! What a material of Beckmann's distribution may ask for.

use super::material::Material;
use super::table::Layout;
use super::value::about;

impl Material {
    /// The material, unless it asks for what is known of the GGX lobe alone.
    pub(super) fn of_beckmann(self) -> Result<Material, String> {
        let wants = &self.wants;
        let table = |layout| wants.tables.iter().position(|want| want.layout == layout);
        let of_table = |layout| table(layout).map(|i| format!("wants.tables[{i}].layout"));
        let asked = [
            (self.anisotropy[1] > 0.0).then(|| "anisotropy".into()),
            self.coat.is_some().then(|| "coat".into()),
            self.mixed.is_some().then(|| "mixed".into()),
            self.lit_base().filter(|base| !base.is_rough()).map(|_| "base".into()),
            wants.exact_fresnel.as_ref().map(|_| "wants.exact_fresnel".into()),
            wants.refracted_width.as_ref().map(|_| "wants.refracted_width".into()),
            wants.widened.as_ref().map(|_| "wants.widened".into()),
            wants.fit.as_ref().filter(|fit| fit.multiscatter).map(|_| "wants.fit.multiscatter".into()),
            wants.fit.as_ref().filter(|fit| fit.average).map(|_| "wants.fit.average".into()),
            of_table(Layout::AreaLights),
            of_table(Layout::PathTracer),
        ];
        match asked.into_iter().flatten().next() {
            Some(field) => Err(about(
                field,
                "it is of the distribution `ggx`; with `beckmann` ask for tables and fits of isotropic lobes and of glass",
            )),
            None => Ok(self),
        }
    }
}
