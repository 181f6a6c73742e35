//! Lookups in rooms, against lobes traced from the shading point.

mod costs;
mod images;
mod lobes;
pub(super) mod methods;
pub(super) mod points;
mod random;
mod view;

use serde::Serialize;

use crate::study::parallax::findings::RoomsFindings;
use crate::study::parallax::room::proxies::Eased;
use crate::study::parallax::room::{Room, octagon, room_a, room_b};
use crate::study::{Size, StudyError};
use lobefit::bake::Progress;
use lobefit::effects::parallax::TapRule;

/// What this part covers.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Parameters {
    /// With their light.
    pub rooms: Vec<Room>,
    methods: Vec<methods::Method>,
    /// The rules of several fetches.
    rules: [TapRule; 2],
    /// Widths of the lobe that smooth edges are rounded over.
    reach: f64,
    random: random::Parameters,
    lobes: lobes::Parameters,
    images: images::Parameters,
}

impl Parameters {
    /// Those of a size.
    pub fn of(size: Size) -> Parameters {
        Parameters {
            rooms: vec![room_a(), room_b(), octagon()],
            methods: methods::methods(),
            rules: [TapRule::two(), TapRule::three()],
            reach: Eased::REACH,
            random: random::Parameters::of(size),
            lobes: lobes::Parameters::of(size),
            images: images::Parameters::of(size),
        }
    }
}

/// Planes of the octagon.
const OCTAGON: u32 = 11;

/// Runs it.
pub(super) fn findings(
    parameters: &Parameters,
    progress: &dyn Progress,
) -> Result<RoomsFindings, StudyError> {
    progress.stage("rooms");
    let Parameters { rooms, methods, random, lobes, images, .. } = parameters;
    let lobes = lobes::fitted(lobes)?;
    let rays = random::halves(random.directions);
    let random = rooms.iter().map(|room| random::measured(room, methods, random, &rays));
    let random = random.collect::<Result<_, StudyError>>()?;
    progress.stage("pictures in rooms");
    let pictures = images::pictures(rooms, methods, images)?;
    let costs = costs::costs(OCTAGON)?;
    let rival = methods[methods::FROSTBITE].name.clone();
    let chosen = methods.iter().filter(|method| method.chosen).map(|method| method.name.clone()).collect();
    Ok(RoomsFindings { costs, lobes, random, pictures, rival, chosen })
}
