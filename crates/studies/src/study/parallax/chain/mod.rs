//! What a real chain of levels adds to the error of lookups, and what its texels gain where they
//! see the room from elsewhere than the probe.

mod gains;
mod measure;
mod seams;
mod texels;
mod viewpoints;

use serde::Serialize;

use super::rooms::points;
use crate::study::parallax::findings::ChainFindings;
use crate::study::parallax::room::{Room, octagon, practice, room_a, room_b};
use crate::study::{Size, StudyError};
use lobefit::bake::Progress;
use lobefit::data::{MipChain, MipMap};
use measure::Case;

/// A chain as some engine has it.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Engine {
    /// Whose.
    pub like: String,
    /// Levels.
    pub map: MipChain,
    /// Texels along a side of the first.
    pub size: usize,
}

/// What this part covers.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Parameters {
    /// Where the law of sliding viewpoints is fitted.
    practice: Room,
    rooms: Vec<Room>,
    points: points::Parameters,
    roughness: Vec<f64>,
    /// The first is the one whose error is taken apart.
    engines: Vec<Engine>,
    /// Samples along a side of a captured texel.
    samples: usize,
    /// Rays of a texel of a prefiltered level.
    texel_rays: u32,
    /// Rays of one prefiltered from its capture.
    engine_rays: u32,
    seed: u32,
    /// Radii of sliding viewpoints that are tried.
    widths: Vec<f64>,
    /// Radii over which ratios fade.
    fades: Vec<f64>,
    view: seams::View,
    /// Roughness of floors.
    floors: Vec<f64>,
}

impl Parameters {
    /// Those of a size.
    pub fn of(size: Size) -> Parameters {
        let full = size == Size::Full;
        let of = |many: u32, few: u32| if full { many } else { few };
        let engine = |like: &str, map: MipMap, count: u32, size: usize| Engine {
            like: like.into(),
            map: MipChain::Mapped { map, count },
            size,
        };
        let engines = if full {
            vec![
                engine("Unity", MipMap::Steeper, 7, 128),
                engine("the same, half the size", MipMap::Steeper, 7, 64),
                engine("the same, twice the size", MipMap::Steeper, 7, 256),
                engine("linear", MipMap::Linear, 6, 128),
                engine("Filament", MipMap::Steep, 5, 256),
                engine("Unreal", MipMap::Log, 8, 128),
            ]
        } else {
            vec![engine("Unity", MipMap::Steeper, 5, 16)]
        };
        Parameters {
            practice: practice(),
            rooms: if full { vec![room_a(), room_b(), octagon()] } else { vec![room_a()] },
            points: points::Parameters::of(size),
            roughness: if full { vec![0.15, 0.25, 0.35, 0.5, 0.7, 0.9] } else { vec![0.35, 0.7] },
            engines,
            samples: if full { 8 } else { 2 },
            texel_rays: of(256, 32),
            engine_rays: of(64, 16),
            seed: 11,
            widths: if full { vec![0.5, 1.0, 2.0, 4.0] } else { vec![1.0, 2.0] },
            fades: vec![1.0, 4.0],
            view: seams::View {
                side: if full { 72 } else { 16 },
                camera: [-0.5, -0.6, 0.5],
                target: [0.35, 0.3, -1.0],
                half: 0.55,
                stops: -1.0,
            },
            floors: if full { vec![0.25, 0.5] } else { vec![0.5] },
        }
    }

    /// The chain whose error is taken apart.
    fn first(&self) -> &Engine {
        &self.engines[0]
    }
}

/// Runs it.
pub(super) fn findings(
    parameters: &Parameters,
    progress: &dyn Progress,
) -> Result<ChainFindings, StudyError> {
    progress.stage("chains: lobes traced from points");
    let of = |room| Case::new(room, &parameters.points, &parameters.roughness);
    let cases: Vec<Case> = parameters.rooms.iter().map(of).collect();
    let (mut parts, mut sizes, mut gains) = (Vec::new(), Vec::new(), Vec::new());
    for case in &cases {
        progress.stage(&format!("chains: room {}", case.room.name));
        let (part, chain) = texels::parts(case, parameters)?;
        sizes.push(texels::size(case, parameters.first(), &chain, part.total.clone()));
        parts.push(part);
        gains.extend(gains::gains(case, &case.exact, &chain)?);
    }
    if let Some(case) = cases.first() {
        progress.stage("chains: maps and sizes");
        sizes.extend(texels::sizes(case, parameters)?);
    }
    progress.stage("chains: sliding viewpoints");
    let slide = viewpoints::slide(&of(&parameters.practice), &parameters.widths);
    let laws = viewpoints::policies(slide.best, &parameters.fades);
    let (mut policies, mut seams) = (Vec::new(), Vec::new());
    for case in &cases {
        progress.stage(&format!("chains: viewpoints in room {}", case.room.name));
        policies.extend(viewpoints::compared(case, &laws, parameters)?);
        for roughness in &parameters.floors {
            seams.push(seams::seams(case, &laws, &parameters.view, *roughness)?);
        }
    }
    let of = |case: &Case| (case.room.name.clone(), case.rows.iter().map(|row| row.noise).collect());
    let noise = cases.iter().map(of).collect();
    let roughness = parameters.roughness.clone();
    Ok(ChainFindings { roughness, near: measure::NEAR, noise, parts, sizes, gains, slide, policies, seams })
}
