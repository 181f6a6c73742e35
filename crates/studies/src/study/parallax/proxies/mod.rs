//! Proxies with soft edges: each family's parameter fitted over roughness, what the law gains on
//! other points, and what is left of the jumps at edges.

mod crossings;
mod errors;
mod families;
mod law;

use serde::Serialize;

use super::rooms::points;
use crate::study::parallax::findings::{ProxiesFindings, ProxyCrossing, ProxyFamily, ProxyGain};
use crate::study::parallax::room::proxies::{Body, Eased, Law, Smooth, Tied};
use crate::study::parallax::room::{Patches, Proxy, Room, octagon, practice, room_a, room_b};
use crate::study::{Size, StudyError};
use errors::{Off, Sample};
use families::Family;
use law::Landscape;
use lobefit::bake::Progress;
use lobefit_math::ops;
use lobefit_math::vector::Vec3;

/// What this part covers.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Parameters {
    /// Where laws are fitted.
    practice: Room,
    /// Where they are judged.
    rooms: Vec<Room>,
    families: Vec<Family>,
    /// Roots of alpha.
    roughness: Vec<f64>,
    /// Points that laws are fitted at.
    fitted: points::Parameters,
    /// Points of each room that they are judged at.
    judged: points::Parameters,
    /// Of the place in room A whose rays pass over edges.
    place: Vec3,
}

impl Parameters {
    /// Those of a size.
    pub fn of(size: Size) -> Parameters {
        let full = size == Size::Full;
        let points = |count, seed| points::Parameters { count, margin: 0.1, seed };
        let [fitted, judged] = if full { [900, 600] } else { [24, 24] };
        Parameters {
            practice: practice(),
            rooms: vec![room_a(), room_b(), octagon()],
            families: Family::ALL.to_vec(),
            roughness: if full { (1..=10).map(|i| f64::from(i) / 10.0).collect() } else { vec![0.3, 0.7] },
            fitted: points(fitted, 11),
            judged: points(judged, 12),
            place: [0.7, -0.5, 0.2],
        }
    }
}

/// The errors of the practice room at a width: of the planes, and of every value of every family.
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
    let cells = cells(parameters);
    let mut families = Vec::new();
    let mut laws: Vec<Judged> = Vec::new();
    for (k, family) in parameters.families.iter().enumerate() {
        let landscape = landscape(parameters, *family, &cells, k);
        let law = landscape.law();
        laws.push(Judged { name: family.name().into(), form: Form::Law(*family, law) });
        families.push(of_family(&landscape, law));
    }
    let tied = Law::Inverse { over: Tied::FITTED.over, power: Tied::FITTED.power, least: 0.0, most: 512.0 };
    let others = [
        ("eased, as emitted", Form::Eased),
        ("tied, by creases", Form::Law(Family::Tied, tied)),
        ("smooth by α", Form::Law(Family::Smooth, Smooth::FITTED)),
        ("smooth by eye", Form::Law(Family::Smooth, Smooth::BY_EYE)),
    ];
    laws.extend(others.map(|(name, form)| Judged { name: name.into(), form }));
    Ok(ProxiesFindings {
        roughness: parameters.roughness.clone(),
        points: [parameters.fitted.count, parameters.judged.count],
        families,
        gains: gains(parameters, &laws),
        crossings: crossed(parameters, &laws),
    })
}

fn cells(parameters: &Parameters) -> Vec<Cell> {
    let room = &parameters.practice;
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

/// The error of a family over that of the planes, as logarithms.
fn landscape(parameters: &Parameters, family: Family, cells: &[Cell], index: usize) -> Landscape {
    let log = |cell: &Cell, value: usize| ops::log(cell.families[index][value].all / cell.planes.all);
    let row = |cell: &Cell| (0..family.values().len()).map(|value| log(cell, value)).collect();
    Landscape {
        family,
        alphas: parameters.roughness.iter().map(|r| r * r).collect(),
        logs: cells.iter().map(row).collect(),
    }
}

fn of_family(landscape: &Landscape, law: Law) -> ProxyFamily {
    let family = landscape.family;
    ProxyFamily {
        name: family.name().into(),
        parameter: family.parameter().into(),
        law: law.formula(),
        values: family.values(),
        landscape: landscape.logs.iter().map(|row| row.iter().map(|x| ops::exp(*x)).collect()).collect(),
        best: (0..landscape.logs.len()).map(|row| landscape.best(row)).collect(),
        by_law: landscape.alphas.iter().map(|alpha| law.at(*alpha)).collect(),
    }
}

/// A proxy with soft edges.
struct Judged {
    name: String,
    form: Form,
}

/// What it is.
#[derive(Clone, Copy)]
enum Form {
    /// That of emitted lookups.
    Eased,
    /// A family with a law.
    Law(Family, Law),
}

impl Judged {
    /// The proxy of a room; none where the probe is not inside.
    fn proxy(&self, room: &Room) -> Option<Box<dyn Proxy>> {
        match self.form {
            Form::Eased => Some(Box::new(Eased { body: Body::new(&room.shape(), room.probe)? })),
            Form::Law(family, law) => family.proxy(room, law),
        }
    }
}

/// What laws gain in rooms that they were not fitted in.
fn gains(parameters: &Parameters, laws: &[Judged]) -> Vec<ProxyGain> {
    let mut gains = Vec::new();
    for room in &parameters.rooms {
        let exact = Patches::new(room);
        for &roughness in &parameters.roughness {
            let Some(sample) = Sample::new(room, &exact, &parameters.judged, roughness * roughness) else {
                continue;
            };
            let Some(body) = Body::new(&room.shape(), room.probe) else { continue };
            let planes = sample.off(&body);
            let of = |judged: &Judged| {
                let off = sample.off(&*judged.proxy(room)?);
                Some((judged.name.clone(), [off.all, off.edges]))
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
fn crossed(parameters: &Parameters, laws: &[Judged]) -> Vec<ProxyCrossing> {
    let Some(room) = parameters.rooms.first() else { return Vec::new() };
    let mut rows = Vec::new();
    for roughness in &parameters.roughness {
        let alpha = roughness * roughness;
        let planes = Body::new(&room.shape(), room.probe).map(|body| Box::new(body) as Box<dyn Proxy>);
        let soft = laws.iter().map(|one| (one.name.clone(), one.proxy(room)));
        for (name, proxy) in std::iter::once(("planes".to_string(), planes)).chain(soft) {
            let found = proxy.and_then(|proxy| crossings::crossings(room, parameters.place, &*proxy, alpha));
            rows.extend(found.map(|row| ProxyCrossing { proxy: name, ..row }));
        }
    }
    rows
}
