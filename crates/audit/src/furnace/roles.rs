//! What the arguments of a BRDF are given, by their names and by what the user says.

use crate::audit::AuditError;
use crate::foreign::ShaderFunction;

/// A direction of the frame whose normal is (0, 0, 1), by its place.
const DIRECTIONS: [(&str, &[&str]); 6] = [
    ("n", &["n", "normal", "normaldir", "geometrynormal", "shadingnormal", "nrm"]),
    (
        "v",
        &["v", "view", "viewdir", "viewdirection", "geometryviewdir", "wo", "eye", "eyedir", "toeye", "vdir"],
    ),
    ("l", &["l", "light", "lightdir", "lightdirection", "wi", "tolight", "ldir"]),
    ("h", &["h", "half", "halfdir", "halfvector", "halfway"]),
    ("t", &["t", "x", "tangent"]),
    ("b", &["b", "y", "bitangent", "binormal"]),
];

/// Places in [`DIRECTIONS`].
pub(super) const NORMAL: usize = 0;
pub(super) const VIEW: usize = 1;
pub(super) const LIGHT: usize = 2;
pub(super) const HALF: usize = 3;
pub(super) const TANGENT: usize = 4;

/// What a scalar of an argument is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Role {
    /// A component of a direction.
    Component(usize, usize),
    /// The cosine between two directions.
    Cosine(usize, usize),
    /// The roughness that the furnace runs over.
    Roughness,
    /// Its square: alpha beside a roughness.
    Square,
    /// 1: a colour or a reflectance of a white furnace.
    White,
    /// The same everywhere.
    Value(f32),
}

/// What every scalar is given.
#[derive(Clone, Debug, PartialEq)]
pub struct Roles {
    /// By scalar.
    pub of: Vec<Role>,
    /// The arguments with what they are given, in words.
    pub named: Vec<(String, String)>,
}

/// A role by its word: a direction (`n`, `v`, `l`, `h`, `t`, `b`), the cosine between two (`n.l`),
/// `roughness` or `white`.
///
/// # Errors
/// Any other word, with those that there are.
pub fn role(word: &str) -> Result<Role, String> {
    let direction = |w: &str| DIRECTIONS.iter().position(|(name, _)| *name == w);
    let pair = word.split_once('.').and_then(|(a, b)| Some((direction(a)?, direction(b)?)));
    let known = match word {
        "roughness" => Some(Role::Roughness),
        "white" => Some(Role::White),
        _ => pair.map(|(a, b)| Role::Cosine(a, b)).or(direction(word).map(|d| Role::Component(d, 0))),
    };
    known.ok_or_else(|| "a role is n, v, l, h, t, b, a cosine as n.l, roughness or white".into())
}

impl Role {
    /// Its word.
    pub fn words(self) -> String {
        let name = |d: usize| DIRECTIONS[d].0;
        match self {
            Role::Component(d, _) => name(d).into(),
            Role::Cosine(a, b) => format!("{}.{}", name(a), name(b)),
            Role::Roughness => "roughness".into(),
            Role::Square => "roughness^2".into(),
            Role::White => "1 (white)".into(),
            Role::Value(x) => format!("{x}"),
        }
    }
}

/// Words of colours and reflectances.
const WHITE: [&str; 10] =
    ["f0", "f90", "specular", "color", "colour", "reflectance", "albedo", "diffuse", "tint", "rho"];

/// In the names of reflectances at normal incidence; of `specular` and `reflectance` shaders compute one.
const F0: [&str; 2] = ["f0", "specularcolor"];

/// Whether an argument is a reflectance at normal incidence, by its name.
pub(super) fn is_f0(name: &str) -> bool {
    F0.iter().any(|word| name.to_ascii_lowercase().replace('_', "").contains(word))
}

/// What the scalars of a function are given. `stated` names arguments, or scalars, with their roles,
/// `set` with values, and `rough` are values of a roughness.
///
/// # Errors
/// A name that is no argument; an argument whose role is not known; no argument that is a light, or
/// none that is a view.
pub(super) fn roles(
    function: &ShaderFunction,
    stated: &[(String, Role)],
    set: &[(String, f64)],
    rough: &[f64],
) -> Result<Roles, AuditError> {
    let arguments = &function.inputs;
    let of = |name: &str, given: &str| {
        name == given || name.strip_prefix(given).is_some_and(|rest| rest.starts_with('.'))
    };
    let given = stated.iter().map(|s| ("--role", &s.0)).chain(set.iter().map(|s| ("--set", &s.0)));
    for (option, name) in given {
        if !arguments.iter().any(|a| of(a, name)) {
            let reason = format!("{} has the arguments {}", function.signature, arguments.join(", "));
            return Err(AuditError::Option { option, value: name.clone(), reason });
        }
    }
    let mut found: Vec<Option<Role>> = Vec::new();
    let value = |name: &String| set.iter().rfind(|(n, _)| of(name, n)).map(|(_, x)| *x as f32);
    let values: Vec<Option<f32>> = arguments.iter().map(value).collect();
    for (i, name) in arguments.iter().enumerate() {
        let said = stated.iter().rfind(|(n, _)| of(name, n)).map(|(_, role)| component(*role, name));
        let by_name = if function.whole[i] { None } else { guess(name, vector(arguments, i)) };
        let known = by_name.filter(|role| matches!(role, Role::Component(..) | Role::Cosine(..)));
        // Of a structure a function may read a few members alone.
        let tried: Vec<f32> = match by_name {
            // An alpha beside it is its square.
            Some(Role::Roughness) => rough.iter().flat_map(|r| [*r, r * r]).map(|r| r as f32).collect(),
            _ => Vec::new(),
        };
        let idle = || function.is_idle(i, &values, &tried).then_some(Role::Value(0.5));
        found.push(values[i].map(Role::Value).or(said).or(known).or_else(idle).or(by_name));
    }
    let unknown: Vec<&str> =
        arguments.iter().zip(&found).filter(|(_, r)| r.is_none()).map(|(a, _)| a.as_str()).collect();
    if !unknown.is_empty() {
        let reason = format!(
            "what {} is given is not known: state it by --set NAME=VALUE, or by --role NAME=l, n.v, roughness, ...",
            unknown.join(", ")
        );
        return Err(AuditError::refused(&function.signature, reason));
    }
    let mut of: Vec<Role> = found.into_iter().flatten().collect();
    squared(arguments, &mut of);
    for (direction, words) in [(LIGHT, "light"), (VIEW, "view")] {
        let uses = |role: &Role| match role {
            Role::Component(d, _) => *d == direction || *d == HALF,
            Role::Cosine(a, b) => [*a, *b].contains(&direction) || [*a, *b].contains(&HALF),
            _ => false,
        };
        if !of.iter().any(uses) {
            let letter = DIRECTIONS[direction].0;
            let reason = format!("no argument is known as the {words}: state it by --role NAME={letter}");
            return Err(AuditError::refused(&function.signature, reason));
        }
    }
    let mut named: Vec<(String, String)> = Vec::new();
    for (i, (name, role)) in arguments.iter().zip(&of).enumerate() {
        let base = if vector(arguments, i).is_some() { base(name) } else { name };
        let idle = *role == Role::Value(0.5) && !set.iter().any(|(n, _)| name == n);
        if !idle && !named.iter().any(|(n, _)| n == base) {
            named.push((base.into(), role.words()));
        }
    }
    Ok(Roles { of, named })
}

/// A name without its component.
fn base(name: &str) -> &str {
    [".x", ".y", ".z"].iter().find_map(|end| name.strip_suffix(end)).unwrap_or(name)
}

/// The component of a vector of which a scalar is.
fn vector(arguments: &[String], i: usize) -> Option<usize> {
    let own = base(&arguments[i]);
    let k = [".x", ".y", ".z"].iter().position(|end| arguments[i] == format!("{own}{end}"))?;
    arguments.contains(&format!("{own}.z")).then_some(k)
}

/// A direction's role for a component of it.
fn component(role: Role, name: &str) -> Role {
    match role {
        Role::Component(d, _) => {
            Role::Component(d, [".x", ".y", ".z"].iter().position(|e| name.ends_with(e)).unwrap_or(0))
        }
        other => other,
    }
}

/// What a name says: a direction, a cosine between two, a roughness, a colour.
fn guess(name: &str, vector: Option<usize>) -> Option<Role> {
    let own = if vector.is_some() { base(name) } else { name };
    let last = own.rsplit('.').next().unwrap_or(own).to_ascii_lowercase().replace('_', "");
    let white = || WHITE.iter().any(|w| own.to_ascii_lowercase().contains(w)).then_some(Role::White);
    let rough = || ["rough", "alpha", "gloss", "smooth"].iter().any(|w| own.to_ascii_lowercase().contains(w));
    if let Some(k) = vector {
        let direction = DIRECTIONS.iter().position(|(_, names)| names.contains(&last.as_str()));
        return direction.map(|d| Role::Component(d, k)).or_else(white);
    }
    cosine(&last).or_else(|| if rough() { Some(Role::Roughness) } else { white() })
}

/// The cosine that a name says: `NdotL`, `n_dot_l`, `dotNL`, `NoL`, `NL`, `cosNL`.
fn cosine(name: &str) -> Option<Role> {
    let bare = ["clamped", "saturated", "abs"].iter().fold(name, |n, w| n.strip_prefix(w).unwrap_or(n));
    let bare = bare.strip_prefix("dot").or_else(|| bare.strip_prefix("cos")).unwrap_or(bare);
    let joined = bare.replacen("dot", "", 1);
    let letters =
        if joined.len() == 3 && joined.as_bytes()[1] == b'o' { joined.replacen('o', "", 1) } else { joined };
    let mut pair = letters.chars().map(|c| DIRECTIONS.iter().position(|(d, _)| d.chars().eq([c])));
    match (pair.next()?, pair.next()?, pair.next()) {
        (Some(a), Some(b), None) => Some(Role::Cosine(a, b)),
        _ => None,
    }
}

/// Of a roughness and an alpha the alpha is its square.
fn squared(arguments: &[String], roles: &mut [Role]) {
    let own = |i: usize, word: &str| arguments[i].to_ascii_lowercase().contains(word);
    let rough: Vec<usize> = (0..roles.len()).filter(|i| roles[*i] == Role::Roughness).collect();
    if rough.iter().any(|i| own(*i, "rough") && !own(*i, "alpha")) {
        for i in rough.into_iter().filter(|i| own(*i, "alpha")) {
            roles[i] = Role::Square;
        }
    }
}
