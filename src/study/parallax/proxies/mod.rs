//! Proxies with soft edges: each family's parameter fitted over roughness, what the law gains on other points, and what is left of the
//! jumps at edges.

mod crossings;
mod errors;
mod families;
mod law;

use serde::Serialize;

use super::rooms::points;
use crate::bake::Progress;
use crate::effects::room::proxies::{Body, Law, Smooth};
use crate::effects::room::{Patches, Proxy, Room, octagon, room_a, room_b};
use crate::math::ops;
use crate::math::vector::Vec3;
use crate::report::{ProxiesFindings, ProxyCrossing, ProxyFamily, ProxyGain};
use crate::study::{Size, StudyError};
use errors::{Off, Sample};
use families::Family;
use law::Landscape;

/// What this part covers.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Parameters {
    rooms: Vec<Room>,
    families: Vec<Family>,
    /// Roots of alpha.
    roughness: Vec<f64>,
    /// Points that laws are fitted on.
    fitted: points::Parameters,
    /// Others that they are judged on.
    judged: points::Parameters,
    /// Of the place in room A whose rays pass over edges.
    place: Vec3,
}

impl Parameters {
    /// Those of a size.
    pub fn of(size: Size) -> Parameters {
        let full = size == Size::Full;
        let points = |count, seed| points::Parameters { count, margin: 0.1, seed };
        let [fitted, judged] = if full { [300, 600] } else { [24, 24] };
        Parameters {
            rooms: vec![room_a(), room_b(), octagon()],
            families: Family::ALL.to_vec(),
            roughness: if full { (1..=10).map(|i| f64::from(i) / 10.0).collect() } else { vec![0.3, 0.7] },
            fitted: points(fitted, 11),
            judged: points(judged, 12),
            place: [0.7, -0.5, 0.2],
        }
    }
}

/// The errors of a room at a width: of the planes, and of every value of every family.
struct Cell {
    planes: Off,
    families: Vec<Vec<Off>>,
}

/// Runs it.
pub(super) fn findings(
    parameters: &Parameters,
    progress: &dyn Progress,
) -> Result<ProxiesFindings, StudyError> {
    progress.stage("proxies");
    let cells: Vec<Vec<Cell>> = parameters.rooms.iter().map(|room| cells(parameters, room)).collect();
    let mut families = Vec::new();
    let mut laws = Vec::new();
    for (k, family) in parameters.families.iter().enumerate() {
        let pooled = landscape(parameters, *family, &cells, k, None);
        let law = pooled.law();
        laws.push((family.name().to_string(), *family, law));
        families.push(of_family(parameters, *family, &cells, k, law));
    }
    laws.push(("smooth, as emitted".into(), Family::Smooth, Smooth::FITTED));
    laws.push(("smooth, by eye".into(), Family::Smooth, Smooth::BY_EYE));
    Ok(ProxiesFindings {
        roughness: parameters.roughness.clone(),
        points: [parameters.fitted.count, parameters.judged.count],
        families,
        gains: gains(parameters, &laws),
        crossings: crossed(parameters, &laws),
    })
}

fn cells(parameters: &Parameters, room: &Room) -> Vec<Cell> {
    let exact = Patches::new(room);
    let cell = |&roughness: &f64| {
        let sample = Sample::new(room, &exact, &parameters.fitted, roughness * roughness)?;
        let off =
            |family: &Family, value: f64| Some(sample.off(&*family.proxy(room, Law::Constant { value })?));
        let of = |family: &Family| family.values().into_iter().map(|value| off(family, value)).collect();
        Some(Cell {
            planes: sample.off(&Body::new(&room.shape(), room.probe)?),
            families: parameters.families.iter().map(of).collect::<Option<_>>()?,
        })
    };
    parameters.roughness.iter().filter_map(cell).collect()
}

/// The error of a family over that of the planes, as logarithms: of one room, or their mean.
fn landscape(
    parameters: &Parameters,
    family: Family,
    cells: &[Vec<Cell>],
    index: usize,
    room: Option<usize>,
) -> Landscape {
    let rooms: Vec<&Vec<Cell>> = match room {
        Some(room) => cells.iter().skip(room).take(1).collect(),
        None => cells.iter().collect(),
    };
    let log = |row: usize, value: usize| {
        let of = |cells: &&Vec<Cell>| ops::log(cells[row].families[index][value].all / cells[row].planes.all);
        rooms.iter().map(of).sum::<f64>() / rooms.len() as f64
    };
    let row = |row: usize| (0..family.values().len()).map(|value| log(row, value)).collect();
    Landscape {
        family,
        alphas: parameters.roughness.iter().map(|r| r * r).collect(),
        logs: (0..parameters.roughness.len()).map(row).collect(),
    }
}

fn of_family(
    parameters: &Parameters,
    family: Family,
    cells: &[Vec<Cell>],
    index: usize,
    law: Law,
) -> ProxyFamily {
    let rows = 0..parameters.roughness.len();
    let best = |room: Option<usize>| {
        let landscape = landscape(parameters, family, cells, index, room);
        rows.clone().map(|row| landscape.best(row)).collect::<Vec<f64>>()
    };
    let pooled = landscape(parameters, family, cells, index, None);
    ProxyFamily {
        name: family.name().into(),
        parameter: family.parameter().into(),
        law: law.formula(),
        values: family.values(),
        landscape: pooled.logs.iter().map(|row| row.iter().map(|x| ops::exp(*x)).collect()).collect(),
        rooms: parameters
            .rooms
            .iter()
            .enumerate()
            .map(|(i, room)| (room.name.clone(), best(Some(i))))
            .collect(),
        best: best(None),
        by_law: pooled.alphas.iter().map(|alpha| law.at(*alpha)).collect(),
    }
}

/// What laws gain on points that they were not fitted on.
fn gains(parameters: &Parameters, laws: &[(String, Family, Law)]) -> Vec<ProxyGain> {
    let mut gains = Vec::new();
    for room in &parameters.rooms {
        let exact = Patches::new(room);
        for &roughness in &parameters.roughness {
            let Some(sample) = Sample::new(room, &exact, &parameters.judged, roughness * roughness) else {
                continue;
            };
            let Some(body) = Body::new(&room.shape(), room.probe) else { continue };
            let planes = sample.off(&body);
            let of = |(name, family, law): &(String, Family, Law)| {
                let off = sample.off(&*family.proxy(room, *law)?);
                Some((name.clone(), [off.all, off.edges]))
            };
            gains.push(ProxyGain {
                room: room.name.clone(),
                roughness,
                points: sample.edges(),
                planes: [planes.all, planes.edges],
                proxies: laws.iter().filter_map(of).collect(),
            });
        }
    }
    gains
}

/// Jumps at the edges of the first room, over roughness.
fn crossed(parameters: &Parameters, laws: &[(String, Family, Law)]) -> Vec<ProxyCrossing> {
    let Some(room) = parameters.rooms.first() else { return Vec::new() };
    let mut rows = Vec::new();
    for roughness in &parameters.roughness {
        let alpha = roughness * roughness;
        let planes = Body::new(&room.shape(), room.probe).map(|body| Box::new(body) as Box<dyn Proxy>);
        let soft = laws.iter().map(|(name, family, law)| (name.clone(), family.proxy(room, *law)));
        for (name, proxy) in std::iter::once(("planes".to_string(), planes)).chain(soft) {
            let found = proxy.and_then(|proxy| crossings::crossings(room, parameters.place, &*proxy, alpha));
            rows.extend(found.map(|row| ProxyCrossing { proxy: name, ..row }));
        }
    }
    rows
}
