//! What to take of a bake: a card for each purpose, and all that was measured in one chart.

use std::collections::BTreeSet;

use super::{SCREEN, figures, index::some, words};
use crate::data::Use;
use crate::emit::call::{Call, How, INVERSE, ROUGH_BASE, SPLIT, SPLIT_OVER, TIMES};
use crate::emit::include::{Called, Include, call};
use crate::emit::manifest::Manifest;
use crate::report::numbers::{grouped, significant};
use crate::report::{
    Answer, Block, Card, Choice, Dot, Figure, Frontiers, Furnace, FurnaceRow, GpuRecord, Measured, Offer,
    Purpose, ReportError, Role, Section, Shade, SphereRow, Spheres, Spread,
};
use crate::store::Files;
use lobefit_shade::code::Language;
use lobefit_shade::comment::comment;

/// The language of the code that is seen at once.
const FIRST: Language = Language::Wgsl;

/// Least and largest side of a sphere's cell in a strip, and what stands beside the cells.
const CELLS: [f64; 2] = [28.0, 40.0];
const BESIDE: f64 = 190.0;

/// Spheres of a strip that has no room for all.
const FEW: usize = 6;

/// Width of a card's content in pixels, and of the space between its columns.
const CARD: f64 = 1126.0;
const GAP: f64 = 16.0;

/// Width of a card's content in a window of 390 pixels.
const PHONE: f64 = 346.0;

/// Plotted size of the chart: the whole width of a page.
const CHART: (f64, f64) = (1080.0, 270.0);

/// What the cards are drawn from.
pub(crate) struct Drawn<'a> {
    /// The bake.
    pub manifest: &'a Manifest,
    /// Its include files among others.
    pub files: &'a Files,
    /// Times of functions, if any are recorded.
    pub record: Option<&'a GpuRecord>,
}

/// The cards of all effects.
pub(super) fn cards(answers: &[Answer], drawn: &Drawn) -> Result<Section, ReportError> {
    let include = Include::with(drawn.files, Some(drawn.manifest));
    let of = |answer: &Answer| -> Result<Vec<Block>, ReportError> {
        let mut blocks = vec![Block::Text { text: answer.conclusion.clone() }];
        let other_sides = answer.purposes.iter().skip(1).take_while(|purpose| purpose.is_other_side);
        let first = answer.purposes.len().min(1 + other_sides.count());
        let (first, others) = answer.purposes.split_at(first);
        let cards = |purposes: &[Purpose]| -> Result<Vec<Card>, ReportError> {
            let paired = purposes.len() > 1 && purposes.iter().all(|purpose| purpose.choices.len() == 1);
            let one = |purpose| card((&answer.effect, paired), purpose, drawn, include.as_ref());
            purposes.iter().map(one).collect()
        };
        let others = cards(others)?;
        blocks.push(Block::Cards(cards(first)?));
        if !others.is_empty() {
            let also = format!("Also {}", answer.also.join(" "));
            blocks.extend((!answer.also.is_empty()).then_some(Block::Text { text: also }));
            let names: Vec<&str> = others.iter().map(|card| card.title.as_str()).collect();
            let summary = format!("Choices and code of {}", names.join(", "));
            blocks.push(Block::Fold { summary, blocks: vec![Block::Cards(others)] });
        }
        Ok(blocks)
    };
    let mut blocks = Vec::new();
    for answer in answers.iter().filter(|answer| !answer.purposes.is_empty()) {
        blocks.push(Block::Heading { text: answer.effect.clone() });
        blocks.extend(of(answer)?);
    }
    let offers = answers.iter().flat_map(|answer| &answer.purposes).flat_map(|purpose| &purpose.choices);
    let timed = |offer: &Offer| time(offer.function.as_deref(), drawn.record, include.as_ref()).is_some();
    let record = drawn.record.filter(|_| offers.into_iter().any(timed));
    let device =
        record.map_or_else(String::new, |record| format!(" Times at 4K: {}.", record.device.adapter));
    let over = match drawn.manifest.made_from["mu"].as_array().map(Vec::as_slice) {
        Some([low, high]) => {
            format!(" Functions hold over n_dot_v {low} to {high}, tables over their own.")
        }
        _ => String::new(),
    };
    Ok(Section::new(
        "answers",
        "What to take",
        format!(
            "Recommended: the cheapest within the scene's error, or the most accurate within its budget.{over}{device}"
        ),
        blocks,
    ))
}

fn card(
    (effect, paired): (&str, bool),
    purpose: &Purpose,
    drawn: &Drawn,
    include: Option<&Include>,
) -> Result<Card, ReportError> {
    let layers = layers(purpose, drawn.manifest);
    let about = [&purpose.about, &layers, &purpose.caution, lacking(purpose)].into_iter();
    Ok(Card {
        id: purpose.name.clone(),
        title: purpose.name.clone(),
        about: about.filter(|text| !text.is_empty()).collect::<Vec<_>>().join(" "),
        link: (format!("All of {effect}"), format!("{effect}.html")),
        choices: purpose.choices.iter().map(|offer| choice(offer, purpose, drawn, include)).collect(),
        svg: match &purpose.furnace {
            Some(furnace) => Some([strip(furnace, room(purpose, paired))?, strip(furnace, PHONE)?]),
            None => None,
        },
    })
}

/// Whose roughness the functions of a card take, where that is a layer's.
fn layers(purpose: &Purpose, manifest: &Manifest) -> String {
    let own = manifest.entries.calls.iter().filter(|call| call.purpose == purpose.name);
    let has_ior = own.clone().any(|call| call.arguments.iter().any(|argument| argument == "ior"));
    let layers: BTreeSet<Option<&str>> = own.map(|call| call.layer.as_deref()).collect();
    let all = layers.iter().map(|layer| format!("the {}'s", layer.unwrap_or("lobe")));
    let named: Vec<String> = all.collect();
    match layers.iter().all(Option::is_none) {
        true => String::new(),
        false => format!(
            "{} {}.",
            if has_ior { "Its roughness and ior are" } else { "Its roughness is" },
            named.join(" or ")
        ),
    }
}

/// What a reader may look for on a card and not find.
fn lacking(purpose: &Purpose) -> &'static str {
    let has = |role: Role| purpose.choices.iter().any(|choice| choice.role == role);
    let Some(best) = purpose.choices.first() else { return "" };
    match (best.cost.fetches, best.cost.bytes) {
        (0, _) if !has(Role::Cheap) && !has(Role::Table) => {
            "No formula of ours takes fewer operations, and this bake has no table of it."
        }
        (0, _) if !has(Role::Cheap) => "No formula of ours takes fewer operations.",
        (0, _) if !has(Role::Table) => "This bake has no table of it.",
        (_, bytes) if bytes > 0 && purpose.choices.len() == 1 => {
            "This bake has one table of it and no formula."
        }
        (_, bytes) if bytes > 0 => "This bake has no formula of it.",
        _ if purpose.choices.len() == 1 => "No lookup takes fewer operations.",
        _ => "",
    }
}

/// Pixels of the width that a card has for its drawing: beside one choice or two, or below more.
fn room(purpose: &Purpose, paired: bool) -> f64 {
    let columns = match (paired, purpose.choices.len()) {
        (false, 1) | (true, _) => 2.0,
        (_, 2) => 3.0,
        _ => 1.0,
    };
    (CARD - GAP * (columns - 1.0)) / columns - if paired { 2.0 * GAP } else { 0.0 }
}

fn choice(offer: &Offer, purpose: &Purpose, drawn: &Drawn, include: Option<&Include>) -> Choice {
    let function = offer.function.as_deref();
    let (calls, code) = match function {
        Some(function) => called(&forms(offer, function, drawn.manifest), drawn),
        None => {
            let mut code = offer.code.clone();
            code.sort_by_key(|(language, _)| language != FIRST.title());
            code.extend((!offer.asked.is_empty()).then(|| ("scene".to_string(), offer.asked.clone())));
            (None, code)
        }
    };
    let emitted = match function {
        Some(_) => String::new(),
        None if !offer.asked.is_empty() => "This scene does not emit it: ask for it.".into(),
        None => {
            let map = drawn.manifest.alpha_map().map(|map| format!("; alpha = {map}")).unwrap_or_default();
            format!("This scene does not emit it: copy it from here. mu = n_dot_v{map}.")
        }
    };
    let shown = calls.or_else(|| function.map(String::from)).unwrap_or_else(|| offer.name.clone());
    Choice {
        role: offer.role.name().into(),
        recommended: offer.role == Role::Recommended,
        call: shown,
        facts: facts(offer, purpose, time(function, drawn.record, include)),
        note: format!("{} {emitted}", offer.note).trim().into(),
        code,
    }
}

/// The functions of an offer that materials call: the form for three channels first.
fn forms<'a>(offer: &Offer, function: &'a str, manifest: &'a Manifest) -> Vec<&'a str> {
    let entries = &manifest.entries;
    let of_offer = entries.fits.iter().find(|fit| offer.coloured.is_some() && fit.function == function);
    let Some(coloured) = of_offer.and_then(|fit| fit.rgb.as_deref()) else { return vec![function] };
    let plain = entries.calls.iter().any(|call| call.function == function);
    std::iter::once(coloured).chain(plain.then_some(function)).collect()
}

/// The call of the first form as WGSL has it, or the first of the languages, and by language the
/// lines of all forms: where they are declared, with which parameters, and of a table what to load.
fn called(forms: &[&str], drawn: &Drawn) -> (Option<String>, Vec<(String, String)>) {
    let mut found: Vec<(Language, Lines)> = Vec::new();
    let all = &drawn.manifest.entries.calls;
    let own = || all.iter().filter(|call| forms.contains(&call.function.as_str()));
    let tables = &drawn.manifest.entries.tables;
    let blends = |function: &&str| {
        tables.iter().any(|table| table.function == **function && table.used_as == Use::F0_BLEND.name)
    };
    let value = if forms.iter().any(blends) { "the first component of this" } else { "this value" };
    for include in &drawn.manifest.includes {
        let Some(language) = Language::parse(&include.language) else { continue };
        let Some(text) = drawn.files.get(&include.file) else { continue };
        let text = String::from_utf8_lossy(text);
        let mut calls: Vec<Lines> = Vec::new();
        for function in forms {
            let Some(Called { call, parameters, .. }) = call(&text, function) else { continue };
            let table = tables.iter().find(|table| table.function == *function);
            let file = if calls.is_empty() { include.file.as_str() } else { "or" };
            let mut lines = vec![format!("{file}: {parameters}")];
            let by = all.iter().filter(|call| call.function == **function).map(|call| call.of.as_str());
            let mut by: Vec<&str> = by.collect();
            by.dedup();
            lines.extend((forms.len() > 1).then(|| format!("for {}", some(&by))));
            lines.extend(table.map(|table| format!("texels: {}", table.file)));
            // Of two calls the second is a comment, so that what is copied compiles.
            let line =
                if calls.is_empty() { call.clone() } else { comment(NOTE, std::slice::from_ref(&call)) };
            calls.push((call.clone(), comment(NOTE, &lines) + &line));
        }
        let Some((call, _)) = calls.first().cloned() else { continue };
        let mut code: Vec<String> = calls.into_iter().map(|(_, code)| code.trim_end().into()).collect();
        let mut uses = uses(&own().collect::<Vec<_>>(), &text, value);
        let within = own().flat_map(|one| &one.around).find(|around| around.how == How::Calls);
        uses.extend(within.map(|around| format!("{} calls it", around.signature())));
        code.extend((!uses.is_empty()).then(|| comment(NOTE, &uses)));
        found.push((language, (call, code.join("\n"))));
    }
    found.sort_by_key(|(language, _)| *language != FIRST);
    let first = found.first().and_then(|(_, (call, _))| call.split_once(" = "));
    let shown = first.map(|(_, call)| call.trim_end_matches(';').to_string());
    (shown, found.into_iter().map(|(language, (_, code))| (language.title().to_string(), code)).collect())
}

/// How comments of a snippet begin, in every language: it stands within a function.
const NOTE: &str = "//";

/// What takes the value of calls, as a language has it: of materials that differ in that with their names.
fn uses(calls: &[&Call], text: &str, value: &str) -> Vec<String> {
    let taken = calls.iter().filter_map(|&one| Some((one.then.as_deref()?, one)));
    let uses = lobefit_math::groups(taken, |(then, _)| *then);
    let of = |calls: &[(&str, &Call)]| {
        let names: Vec<&str> = calls.iter().map(|(_, one)| one.of.as_str()).collect();
        if uses.len() < 2 { String::new() } else { format!("{}: ", some(&names)) }
    };
    uses.iter().map(|(_, calls)| of(calls) + &with_value(calls[0], text, value)).collect()
}

/// What takes the value: an albedo of the view alone, or of the light as well, or a share.
fn with_value((then, of): (&str, &Call), text: &str, value: &str) -> String {
    let Some(taker) = of.around.iter().find(|around| around.function == then) else {
        return match then {
            SPLIT => format!("then {then}: A and B are components of this"),
            SPLIT_OVER => format!("then {then}: E, A and B are the components of this, f the lobe"),
            TIMES => format!("then {then}: N is {value}, f the lobe"),
            INVERSE => format!("then {then}: E is {value}, n that of ggx_mixed_*"),
            ROUGH_BASE => format!("then {then}: c is {value}, f the lobe as it is compensated"),
            _ => format!("then {then}: E is {value}, f the lobe"),
        };
    };
    let found = call(text, then).map_or_else(|| taker.signature(), |found| found.call);
    let call = found.split_once(" = ").map_or(found.as_str(), |(_, call)| call).trim_end_matches(';');
    match taker.value.as_deref() {
        Some("e_v") if taker.arguments.iter().any(|name| name == "e_l") => {
            format!("then {call}: e_v is {value}, e_l the same with n_dot_l")
        }
        Some(argument) => format!("then {call}: {argument} is {value}"),
        None => format!("then {call}"),
    }
}

/// A call, and the call below its comment.
type Lines = (String, String);

/// Microseconds for a screen, if the function is recorded as it is emitted here.
pub(super) fn time(
    function: Option<&str>,
    record: Option<&GpuRecord>,
    include: Option<&Include>,
) -> Option<f64> {
    Some(1e-3 * record?.nanoseconds(function?, include?)? * SCREEN)
}

fn facts(offer: &Offer, purpose: &Purpose, time: Option<f64>) -> Vec<(String, String)> {
    let cost = offer.cost;
    let time = time.map_or_else(String::new, |time| format!(", {} µs at 4K", significant(time, 3)));
    // What stands beside a call in colour for one channel says so.
    let has_colour = purpose.choices.iter().any(|other| other.coloured.is_some());
    let channel = if has_colour && cost.fetches == 0 { " for one channel" } else { "" };
    let own = format!("{}{channel}{time}", words::operations(cost.ops));
    let mut rows = match offer.coloured {
        Some(ops) => vec![
            ("Cost".to_string(), format!("{} for three channels", words::operations(ops))),
            (String::new(), own),
        ],
        None => vec![("Cost".to_string(), own)],
    };
    if offer.function.as_ref().is_some_and(|function| *function != offer.name) {
        rows.insert(0, (if cost.bytes > 0 { "Table" } else { "Formula" }.into(), offer.name.clone()));
    }
    let fetches = words::count(cost.fetches as usize, "fetch", "fetches");
    match (cost.fetches, cost.bytes) {
        (0, _) => {}
        (_, 0) => rows.push(("Memory".into(), fetches)),
        (_, bytes) => rows.push(("Memory".into(), format!("{fetches}, {} bytes", grouped(bytes)))),
    }
    // The error that the scene limits stands first, where it is not the one of the certificate.
    let own = offer.limited.map(|max| (format!("max {}", words::max(max)), purpose.limited.clone()));
    let certified = offer.error.map(|[max, rms]| {
        let metric = if offer.metric.is_empty() { &purpose.metric } else { &offer.metric };
        (format!("max {}, RMS {}", words::max(max), words::mean(rms)), metric.clone())
    });
    // Lookups of one width differ in the rest.
    if purpose.choices.first().is_some_and(|best| best.name != offer.name && best.error == offer.error) {
        rows.push(("Error".into(), "that of the recommended, of the same width".into()));
        return rows;
    }
    for (error, measure) in own.into_iter().chain(certified) {
        rows.extend([("Error".into(), error), ("Measure".into(), measure)]);
    }
    rows
}

/// The spheres of a furnace in a width: all, or as many as find room.
fn strip(furnace: &Furnace, width: f64) -> Result<String, ReportError> {
    let times = crate::report::numbers::brief(furnace.amplification, 3);
    let all = furnace.roughness.len();
    let side = |n: usize| (width - BESIDE) / n as f64;
    let shown = if side(all) < CELLS[0] { all.min(FEW) } else { all };
    let columns: Vec<usize> = (1..=shown).map(|i| (i * all).div_ceil(shown) - 1).collect();
    let hundredths = |x: f64| (100.0 * x).round() / 100.0;
    let roughness: Vec<f64> = columns.iter().map(|&j| hundredths(furnace.roughness[j])).collect();
    let of = |row: &FurnaceRow| -> Vec<Vec<f64>> {
        columns.iter().filter_map(|&j| row.factors.get(j).cloned()).collect()
    };
    let factors: Vec<Vec<Vec<f64>>> = furnace.rows.iter().map(of).collect();
    let rows = furnace.rows.iter().zip(&factors);
    let spheres = Spheres {
        title: format!("furnace error × {times}; grey is exact"),
        column_name: "roughness".into(),
        columns: &roughness,
        mu: &furnace.mu,
        rows: rows.map(|(row, factors)| SphereRow { name: row.name.clone(), factors }).collect(),
        shade: Shade::Departure { limit: 1.0 / furnace.amplification },
        unit: "radiance − 1".into(),
        cell: side(shown.max(1)).clamp(CELLS[0], CELLS[1]) as usize,
    };
    spheres.svg()
}

/// The function of what is offered, else the name.
fn called_as<'a>(purpose: &'a Purpose, measured: &'a Measured) -> &'a str {
    let offer = purpose.choices.iter().find(|offer| offer.name == measured.name);
    offer.and_then(|offer| offer.function.as_deref()).unwrap_or(&measured.name)
}

/// Everything that was measured, by its largest and by its RMS error.
pub(super) fn frontier(answers: &[Answer]) -> Result<Option<Section>, ReportError> {
    let dots = |purpose: &Purpose, of: usize| -> Vec<Dot> {
        let positive = purpose.measured.iter().filter(|m| m.error.iter().all(|&e| e > 0.0));
        let dot = |m: &Measured| Dot {
            name: called_as(purpose, m).into(),
            x: f64::from(m.ops),
            y: m.error[of],
            published: m.published,
            table: m.table,
        };
        positive.map(dot).collect()
    };
    let purposes = || answers.iter().flat_map(|a| a.purposes.iter().map(move |p| (&a.effect, p)));
    let of_purpose = |p: &Purpose| -> Vec<String> {
        let offers = p.choices.iter().filter(|offer| offer.error.is_some());
        offers.map(|offer| offer.function.as_ref().unwrap_or(&offer.name).clone()).collect()
    };
    let offered: Vec<String> = purposes().flat_map(|(_, p)| of_purpose(p)).collect();
    let chart = |of: usize, what: &str| {
        // One colour for an effect: its purposes have frontiers of their own.
        let groups: Vec<(String, Vec<Dot>)> =
            purposes().map(|(effect, p)| (effect.clone(), dots(p, of))).filter(|g| !g.1.is_empty()).collect();
        let chart = Frontiers {
            title: format!("{what} against cost"),
            x: ("operations (square-root scale; fetches not counted)".into(), Spread::Root),
            y: (what.into(), Spread::Log),
            groups,
            named: offered.clone(),
            size: CHART,
        };
        let caption = "Stairs join the formulas of ours, for one purpose each, that no other of them beats in both; ours \
                       that another beats are grey dots, published formulas rings, tables squares. Named are the choices above. The error \
                       is that of the purpose.";
        figures(&[chart], caption)
    };
    // One point has nothing to be compared with.
    if purposes().map(|(_, p)| dots(p, 0).len()).sum::<usize>() < 2 {
        return Ok(None);
    }
    let of = vec![
        ("largest error".to_string(), vec![chart(0, "largest error")?]),
        ("RMS error".to_string(), vec![chart(1, "RMS error")?]),
    ];
    Ok(Some(Section::new(
        "frontier",
        "Error against cost",
        "Lower is more accurate, further left is cheaper; the pointer names what has no name here.",
        vec![Block::Switch { name: "error".into(), of }],
    )))
}
