//! What is compared.

use serde::Serialize;

use crate::study::StudyError;
use crate::study::parallax::room::proxies::{Body, Eased};
use crate::study::parallax::room::{Lookup, Proxy, Room};
use lobefit::effects::parallax::{Corrected, LobeFit, Ratio, Shading, TapRule, Uncorrected, Width};

/// What a method takes the room for.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(in crate::study::parallax) enum Taken {
    /// Nothing: the cubemap is infinitely far.
    Infinite,
    /// The room's own planes.
    Planes,
    /// The same with edges rounded as those of the emitted lookups.
    Smooth,
}

/// A way to look the cubemap up.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(in crate::study::parallax) struct Method {
    pub name: String,
    pub taken: Taken,
    pub shading: Shading,
    /// Fetches.
    pub fetches: usize,
    pub ratio: Ratio,
    pub width: Width,
    /// Whether charts and pictures show it.
    pub chosen: bool,
}

impl Method {
    /// Its lookup in a room.
    ///
    /// # Errors
    /// A probe that is not inside the room.
    pub fn lookup(&self, room: &Room) -> Result<Box<dyn Lookup>, StudyError> {
        let outside = || StudyError::Outside { room: room.name.clone(), probe: room.probe };
        let body = Body::new(&room.shape(), room.probe).ok_or_else(outside)?;
        Ok(match self.taken {
            Taken::Infinite => Box::new(Uncorrected { shading: self.shading }),
            Taken::Planes => self.corrected(body, room),
            Taken::Smooth => self.corrected(Eased { body }, room),
        })
    }

    fn corrected<P: Proxy + 'static>(&self, proxy: P, room: &Room) -> Box<dyn Lookup> {
        let rule = match self.fetches {
            2 => TapRule::two(),
            3 => TapRule::three(),
            _ => TapRule::one(),
        };
        let (probe, shading, ratio, width) = (room.probe, self.shading, self.ratio, self.width);
        Box::new(Corrected { proxy, probe, shading, rule, ratio, width })
    }
}

/// The place in the list of what others are compared with.
pub(in crate::study::parallax) const FROSTBITE: usize = 2;

/// Those that charts and pictures show.
const CHOSEN: [&str; 7] = [
    "Frostbite",
    "rational, areas",
    "rational, areas, smooth",
    "3 fetches, smooth",
    "3 fetches, dominant direction, smooth",
    "1 fetch, fitted lobe, smooth",
    "3 fetches, fitted lobe, smooth",
];

/// A number of fetches through the smooth proxy, of a round lobe.
pub(in crate::study::parallax) fn smooth(fetches: usize) -> Method {
    let (taken, shading) = (Taken::Smooth, Shading::Mirror);
    let (ratio, width) = (Ratio::Area, Width::EMITTED);
    Method { name: String::new(), taken, shading, fetches, ratio, width, chosen: false }
}

/// All of them.
pub(in crate::study::parallax) fn methods() -> Vec<Method> {
    use Ratio::{Area, Distance};
    use Shading::{Dominant, Mirror, RootCosine};
    use Taken::{Infinite, Planes, Smooth};
    use Width::{Frostbite, Same, Scaled};
    let rational = Width::EMITTED;
    let method = |name: &str, taken, shading, fetches, ratio, width| Method {
        name: name.into(),
        taken,
        shading,
        fetches,
        ratio,
        width,
        chosen: CHOSEN.contains(&name),
    };
    let fitted = [LobeFit::ONE, LobeFit::TWO, LobeFit::THREE].map(Shading::Fitted);
    vec![
        method("no parallax", Infinite, Mirror, 1, Distance, Same),
        method("parallax only", Planes, Mirror, 1, Distance, Same),
        method("Frostbite", Planes, Mirror, 1, Distance, Frostbite),
        method("Frostbite, dominant direction", Planes, Dominant, 1, Distance, Frostbite),
        method("min(1, ρ α)", Planes, Mirror, 1, Distance, Scaled),
        method("rational, distances", Planes, Mirror, 1, Distance, rational),
        method("rational, areas", Planes, Mirror, 1, Area, rational),
        method("rational, areas √(n·v)", Planes, RootCosine, 1, Area, rational),
        method("rational, areas, dominant direction", Planes, Dominant, 1, Area, rational),
        method("rational, areas, smooth", Smooth, Mirror, 1, Area, rational),
        method("2 fetches", Planes, Mirror, 2, Area, rational),
        method("3 fetches", Planes, Mirror, 3, Area, rational),
        method("3 fetches, dominant direction", Planes, Dominant, 3, Area, rational),
        method("2 fetches, smooth", Smooth, Mirror, 2, Area, rational),
        method("3 fetches, smooth", Smooth, Mirror, 3, Area, rational),
        method("3 fetches, dominant direction, smooth", Smooth, Dominant, 3, Area, rational),
        method("1 fetch, fitted lobe, smooth", Smooth, fitted[0], 1, Area, rational),
        method("2 fetches, fitted lobe, smooth", Smooth, fitted[1], 2, Area, rational),
        method("3 fetches, fitted lobe, smooth", Smooth, fitted[2], 3, Area, rational),
    ]
}
