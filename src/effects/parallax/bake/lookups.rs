//! The lookups of a kind of lobe: what is emitted, with what is said of it.

use super::{Lobe, code};
use crate::approximate::{Fit, FitStageError};
use crate::data::{Cost, MipChain, ProbeLookup, SurfaceLobe};
use crate::effects::BakeError;
use crate::effects::Effect;
use crate::effects::parallax::Parallax;
use crate::effects::parallax::probe::{Level, Wanted, arguments};
use crate::effects::parallax::results::LookupFinding;
use crate::effects::parallax::{Gives, TapRule, named};
use crate::effects::preferred;
use crate::emit::call::{Call, LookupFunction};
use crate::emit::header;
use crate::report::{Offer, Role};
use lobefit_truth::quantity::PARALLAX;

/// A lookup with its cost.
pub(super) struct Lookup {
    pub wanted: Wanted,
    chain: Option<MipChain>,
    inputs: Vec<String>,
    ops: u32,
    price: Option<f64>,
    /// The fit of the width, and its error.
    fit: String,
    max_error: f64,
}

/// Those that the probes want, by the fit of one constant; none where no fit is emitted.
pub(super) fn of(lobe: &Lobe, identifiers: &[(MipChain, String)]) -> Result<Vec<Lookup>, BakeError> {
    let Some((flow, _)) = lobe.flow() else { return Ok(Vec::new()) };
    let one = |(lookup, chain): &(ProbeLookup, Option<MipChain>)| {
        one(lobe, flow, *lookup, chain.as_ref(), identifiers)
    };
    lobe.wants.lookups.iter().map(one).collect()
}

/// Cheaper lookups than the one that is taken before the others, as far as they are not emitted,
/// for the card of that one.
pub(super) fn beside(
    lobe: &Lobe,
    emitted: &[LookupFunction],
    identifiers: &[(MipChain, String)],
) -> Result<Vec<(String, Offer)>, BakeError> {
    let best = preferred(emitted);
    let best = best.and_then(|best| lobe.lookups.iter().find(|own| own.wanted.name == best.function));
    let (Some(best), Some((flow, variation))) = (best, lobe.flow()) else { return Ok(Vec::new()) };
    let sharp =
        ProbeLookup { hit: false, planes: None, smooth: false, taps: 1, lobe: SurfaceLobe::default() };
    let cheaper = [
        (Role::Cheap, sharp, "\"edges\": \"sharp\"", SHARP),
        (Role::Cheapest, ProbeLookup { hit: true, smooth: true, ..sharp }, "\"hit\": true", HIT),
    ];
    let mut found = Vec::new();
    for (role, lookup, asked, note) in cheaper {
        let own = one(lobe, flow, lookup, best.chain.as_ref(), identifiers)?;
        if own.ops >= best.ops || emitted.iter().any(|known| known.function == own.wanted.name) {
            continue;
        }
        let certificate = &flow.approximation.certificate;
        let cost = Cost { ops: own.ops, fetches: 1, bytes: 0 };
        let error = Some([certificate.max_abs, certificate.rms]);
        let offer = Offer {
            limited: variation.max(),
            note: note.into(),
            asked: format!("\"lookups\": [{{ {asked} }}]"),
            ..Offer::new(role, &own.wanted.name, None, (cost, error))
        };
        found.push((best.wanted.name.clone(), offer));
    }
    Ok(found)
}

/// What is lost by what is cheaper.
const SHARP: &str = "The same width, but it jumps where the ray passes from one wall to the next: a seam in rough reflections.";
const HIT: &str = "The same width; the engine finds the wall itself, and passes the distance from the place and the offset \
                   from the probe.";

fn one(
    lobe: &Lobe,
    flow: &Fit,
    lookup: ProbeLookup,
    chain: Option<&MipChain>,
    identifiers: &[(MipChain, String)],
) -> Result<Lookup, BakeError> {
    let level =
        chain.and_then(|chain| lobe.functions.iter().find(|f| f.gives == Gives::Level && f.chain == *chain));
    let identifier =
        chain.and_then(|chain| identifiers.iter().find(|(known, _)| known == chain)).map(|(_, name)| name);
    let suffix = identifier.map_or_else(String::new, |name| format!("_{name}"));
    let fetches = lookup.taps as usize;
    let fetch = format!("parallax_fetch_{}_{}{suffix}", lookup.shape(), lookup.edges());
    let mut wanted = Wanted {
        fetch: named(&lobe.spec.kernel, &fetch),
        name: named(&lobe.spec.kernel, &format!("parallax_lookup_{}{suffix}", lookup.identifier())),
        lookup,
        rule: TapRule::of(&lobe.spec.kernel, fetches)
            .ok_or(BakeError::NoRule { kernel: lobe.spec.kernel.word().into(), fetches })?,
        header: Vec::new(),
        flow: constant(flow)?,
        rho: lobe.spec.rho,
        level: level.map(|f| Level::new(&f.hypothesis, &f.chain)).transpose()?,
        alpha_map: lobe.spec.alpha_map,
    };
    let ops = wanted.operations()?;
    let price = match lobe.scene.output.cost {
        Some(vendor) => Some(vendor.price(&wanted.features()?).map_err(FitStageError::from)?),
        None => None,
    };
    let inputs = wanted.inputs()?;
    wanted.header = wanted.lines(&inputs);
    wanted.header.extend(header(lobe, &wanted, flow, chain, ops));
    let (fit, max_error) = (flow.approximation.name.clone(), flow.approximation.certificate.max_abs);
    Ok(Lookup { inputs, wanted, chain: chain.cloned(), ops, price, fit, max_error })
}

/// The constant of the width of lookups.
fn constant(flow: &Fit) -> Result<f64, BakeError> {
    match flow.coefficients().as_slice() {
        [one] => Ok(f64::from(*one)),
        all => Err(BakeError::Internal(format!(
            "{}: {} constants where lookups have one",
            flow.approximation.name,
            all.len()
        ))),
    }
}

/// What it must be paired with, what it costs, and what it is off by.
fn header(lobe: &Lobe, wanted: &Wanted, flow: &Fit, chain: Option<&MipChain>, ops: u32) -> Vec<String> {
    let fetches = wanted.lookup.taps;
    let mut lines = vec![format!("Pairing: {}", code::paired(lobe))];
    lines.extend(chain.map(|chain| format!("  {}", chain.text())));
    let [roughness, rho] = [lobe.spec.roughness, lobe.spec.rho].map(|[lo, hi]| format!("[{lo}, {hi}]"));
    lines.push(format!(
        "The width is certified over roughness {roughness} and rho {rho}, the distance of the place"
    ));
    lines.push("over that of the probe, from what both see, by the root of solid angles.".into());
    let plural = if fetches == 1 { "fetch" } else { "fetches" };
    let name = &flow.approximation.name;
    lines.push(format!("{} and {fetches} {plural}; width by {name}", header::operations(ops)));
    lines.extend(wanted.expected());
    let measured = lobe.measured().find(|(fit, _)| fit.approximation.name == *name);
    if let Some((_, variation)) = measured {
        let rows = [
            ("rho < 1", variation.nearer, lobe.least.nearer),
            ("rho > 1", variation.farther, lobe.least.farther),
        ];
        let rows = rows.into_iter().filter_map(|(name, spread, least)| Some((name, spread?, least?)));
        lines.push("Of one fetch whose ray meets the wall at a right angle, unsaturated:".into());
        lines.extend(rows.map(|(name, spread, least)| format!("  {}", code::total(name, &spread, &least))));
    }
    lines
}

impl Lookup {
    /// Its entry in the manifest.
    pub fn entry(&self, kernel: &str, alpha_map: &str) -> LookupFunction {
        let Wanted { name, lookup, level, .. } = &self.wanted;
        LookupFunction {
            effect: Parallax.name().into(),
            function: name.clone(),
            inputs: self.inputs.clone(),
            arguments: arguments::sentence(&self.inputs),
            proxy: lookup.shape(),
            edges: lookup.edges().into(),
            lobe: lookup.lobe.name().into(),
            rounding: (lookup.smooth && !lookup.hit).then(|| self.wanted.rounding()),
            gives: if level.is_some() { "mip" } else { "width" }.into(),
            width: self.fit.clone(),
            kernel: kernel.into(),
            alpha_map: alpha_map.into(),
            chain: self.chain.as_ref().map(MipChain::text),
            cost: Cost { ops: self.ops, fetches: lookup.taps, bytes: 0 },
        }
    }

    /// The probes of a lobe that call it. Its error is that of the width that it fetches.
    pub fn calls(&self, lobe: &Lobe) -> Vec<Call> {
        let Wanted { name, lookup, .. } = &self.wanted;
        let probes = lobe.job.demands.iter().filter_map(|demand| lobe.scene.probes.get(demand.of));
        let calling = probes.filter(|probe| probe.lookups.contains(lookup) && probe.mips == self.chain);
        let call = calling.map(|probe| Call {
            effect: Parallax.name().into(),
            of: probe.name.clone(),
            function: name.clone(),
            name: self.fit.clone(),
            max_error: self.max_error,
            metric: PARALLAX.metric.into(),
            cost: Cost { ops: self.ops, fetches: lookup.taps, bytes: 0 },
            price: self.price,
            ..Call::default()
        });
        call.collect()
    }

    /// What its page says of it.
    pub fn finding(&self) -> LookupFinding {
        let Wanted { name, lookup, .. } = &self.wanted;
        LookupFinding {
            function: name.clone(),
            proxy: lookup.shape(),
            edges: lookup.edges().into(),
            lobe: lookup.lobe.name().into(),
            fetches: lookup.taps,
            ops: self.ops,
            width: self.fit.clone(),
            chain: self.chain.as_ref().map(MipChain::text),
        }
    }
}
