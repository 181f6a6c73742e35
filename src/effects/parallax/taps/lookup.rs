//! The lookup of a shading point by a rule.

use super::horizon::fade;
use super::rule::TapRule;
use crate::effects::room::{Lookup, Meeting, Proxy, Seen, Tap};
use crate::math::vector::{Vec3, dot, minus, normalise, plus, scaled};
use crate::optics::footprint::{RuleTap, Stretch, width};

/// Fetches of a rule along the stretched axis, each traced through the proxy and as wide as its own footprint asks for.
#[derive(Clone, Debug)]
pub struct Taps<P> {
    /// What the room is taken for.
    pub proxy: P,
    /// Where the cubemap was taken.
    pub probe: Vec3,
    /// The fetches.
    pub rule: TapRule,
}

impl<P: Proxy> Lookup for Taps<P> {
    /// Rays that leave below the surface fade out ([`super::horizon`]); those that miss the proxy are dropped and the rest weighted up; where
    /// the mirror ray misses it, the one fetch is along the ray.
    fn taps(&self, seen: &Seen) -> Vec<Tap> {
        let facing = dot(seen.normal, seen.view);
        let ray = normalise(minus(scaled(seen.normal, 2.0 * facing), seen.view));
        let Some((hit, stretch)) = self.stretch(seen, ray) else {
            return vec![Tap { towards: ray, alpha: seen.alpha, weight: 1.0 }];
        };
        let mut rule = self.rule.taps(&stretch, seen.alpha);
        fade(&mut rule, ray, stretch.major, seen.normal);
        let mut taps: Vec<Tap> = rule.iter().filter_map(|tap| self.fetch(seen, ray, &stretch, tap)).collect();
        if taps.is_empty() {
            taps.push(self.tap(hit.place, width(seen.alpha, stretch.area), 1.0));
        }
        let whole: f64 = taps.iter().map(|tap| tap.weight).sum();
        for tap in &mut taps {
            tap.weight /= whole;
        }
        taps
    }
}

impl<P: Proxy> Taps<P> {
    /// What a ray of the shading point hits in front of it, and how that stretches the lobe.
    fn stretch(&self, seen: &Seen, ray: Vec3) -> Option<(Meeting, Stretch)> {
        let hit = self.proxy.meet(seen.place, ray, seen.alpha).filter(|hit| hit.distance > 0.0)?;
        Some((hit, Stretch::of_round(seen.place, &hit, self.probe, seen.alpha)?))
    }

    fn fetch(&self, seen: &Seen, mirror: Vec3, stretch: &Stretch, tap: &RuleTap) -> Option<Tap> {
        let ray = normalise(plus(mirror, scaled(stretch.major, tap.tilt)));
        let (hit, own) = self.stretch(seen, ray)?;
        Some(self.tap(hit.place, width(tap.width * seen.alpha, own.area), tap.weight))
    }

    fn tap(&self, place: Vec3, alpha: f64, weight: f64) -> Tap {
        Tap { towards: normalise(minus(place, self.probe)), alpha, weight }
    }
}
