//! Numbers of a scene: finite, not negative zero, inside a stated interval; one, or two as a range.

use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Unexpected, Visitor};
use serde_json::Value;

/// An interval of the reals with a name for messages.
pub(super) trait Interval {
    const MIN: f64;
    const MAX: f64;
    /// Whether MIN itself is outside.
    const OPEN: bool = false;
    /// As `[0, 1]`.
    const TEXT: &'static str;
}

macro_rules! intervals {
    ($($(#[$doc:meta])* $name:ident = $min:expr, $max:expr, $open:expr, $text:expr;)*) => {
        $($(#[$doc])* pub(super) struct $name;
        impl Interval for $name {
            const MIN: f64 = $min;
            const MAX: f64 = $max;
            const OPEN: bool = $open;
            const TEXT: &'static str = $text;
        })*
    };
}

intervals! {
    /// Roughness, reflectance.
    Unit = 0.0, 1.0, false, "[0, 1]";
    /// Index of refraction in air of any material; at 1 there is no interface.
    Ior = 1.0, 4.0, false, "[1, 4]";
    /// Index of refraction of a dielectric, whose reflectance needs an interface.
    DielectricIor = 1.0, 4.0, true, "(1, 4]";
    /// Index of refraction of glass: at 1 its albedo is a limit.
    GlassIor = 1.0, super::limits::GLASS_IOR, false, "[1, 3]";
    /// A limit on an error: albedos lie in [0, 1], so an error of 1 is none.
    ErrorLimit = 0.0, 1.0, true, "(0, 1]";
    /// Cosine of the view angle.
    Cosine = super::limits::MU_MIN, 1.0, false, "[0.0001, 1]";
    /// Texels of an axis.
    AxisSize = super::limits::AXIS_MIN as f64, super::limits::AXIS_MAX as f64, false, "[2, 1024] ([4, 256] with a third axis)";
    /// Operations of a fit.
    Ops = 1.0, super::limits::FIT_OPS as f64, false, "[1, 1000]";
    /// Ratio of the distances of shading point and probe from what they see.
    Ratio = lobefit_truth::quantity::footprint::RHO[0], lobefit_truth::quantity::footprint::RHO[1], false, "[0.000001, 1000]";
    /// Levels of a prefiltered chain.
    Levels = super::limits::LEVELS_MIN as f64, super::limits::LEVELS_MAX as f64, false, "[2, 16]";
    /// Planes of a proxy: 4 bound a body.
    Planes = super::limits::PLANES_MIN as f64, super::limits::PLANES_MAX as f64, false, "[4, 64]";
    /// Fetches of a lookup.
    TapCount = 1.0, super::limits::TAPS_MAX as f64, false, "[1, 3]";
    /// A GGX width above a mirror's.
    Width = 0.0, 1.0, true, "(0, 1]";
    /// An angle from the axis of a lobe, radians; its end is rounded up to any 7 digits.
    QuarterTurn = 0.0, 1.570797, false, "[0, pi/2], in radians";
    /// Texels of a side of an occlusion buffer.
    BufferSide = 16.0, 1024.0, false, "[16, 1024]";
    /// Frames that depth is old.
    Latency = 1.0, 8.0, false, "[1, 8]";
    /// Voxels of a side of a grid: an octet has two.
    GridSide = 2.0, 512.0, false, "[2, 512]";
    /// Seeds.
    Seed = 0.0, 4294967295.0, false, "[0, 4294967295]";
    /// Weights of a lobe.
    NotNegative = 0.0, 1e30, false, "[0, 1e30]";
    /// Versions of the scene format.
    Version = 1.0, 1.0, false, "the versions that this program reads: 1";
}

/// Whether a number, `written` so in the scene, lies in the interval; if not, the message.
pub(super) fn inside<I: Interval>(x: f64, written: impl fmt::Display) -> Result<(), String> {
    let below = if I::OPEN { x <= I::MIN } else { x < I::MIN };
    if below || x > I::MAX || !x.is_finite() {
        return Err(format!("{written} is outside {}", I::TEXT));
    }
    Ok(())
}

/// A real number in an interval.
pub(super) struct In<I>(pub f64, PhantomData<I>);

impl<I: Interval> In<I> {
    fn new<E: Error>(x: f64, written: impl fmt::Display) -> Result<Self, E> {
        if x == 0.0 && x.is_sign_negative() {
            return Err(E::custom("-0 is negative zero; write 0"));
        }
        inside::<I>(x, written).map_err(E::custom)?;
        Ok(In(x, PhantomData))
    }
}

impl<'de, I: Interval> Deserialize<'de> for In<I> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct InVisitor<I>(PhantomData<I>);
        impl<I: Interval> Visitor<'_> for InVisitor<I> {
            type Value = In<I>;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                write!(f, "a number in {}", I::TEXT)
            }
            fn visit_f64<E: Error>(self, x: f64) -> Result<In<I>, E> {
                In::new(x, x)
            }
            fn visit_u64<E: Error>(self, x: u64) -> Result<In<I>, E> {
                In::new(x as f64, x)
            }
            fn visit_i64<E: Error>(self, x: i64) -> Result<In<I>, E> {
                In::new(x as f64, x)
            }
        }
        deserializer.deserialize_any(InVisitor(PhantomData))
    }
}

impl<I: Interval> JsonSchema for In<I> {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Number".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let minimum = if I::OPEN { "exclusiveMinimum" } else { "minimum" };
        json_schema!({ "type": "number", minimum: I::MIN, "maximum": I::MAX })
    }
}

/// A whole number in an interval, written without point or exponent.
pub(super) struct Whole<I>(pub u32, PhantomData<I>);

impl<'de, I: Interval> Deserialize<'de> for Whole<I> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct WholeVisitor<I>(PhantomData<I>);
        impl<I: Interval> Visitor<'_> for WholeVisitor<I> {
            type Value = Whole<I>;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                write!(f, "a whole number in {}", I::TEXT)
            }
            fn visit_u64<E: Error>(self, x: u64) -> Result<Whole<I>, E> {
                In::<I>::new::<E>(x as f64, x)?;
                let x = u32::try_from(x).map_err(|_| E::custom(format!("{x} is outside {}", I::TEXT)))?;
                Ok(Whole(x, PhantomData))
            }
            fn visit_i64<E: Error>(self, x: i64) -> Result<Whole<I>, E> {
                Err(E::custom(format!("{x} is outside {}", I::TEXT)))
            }
        }
        deserializer.deserialize_any(WholeVisitor(PhantomData))
    }
}

impl<I: Interval> JsonSchema for Whole<I> {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Whole".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "integer", "minimum": I::MIN as i64, "maximum": I::MAX as i64 })
    }
}

/// `N` numbers; where `ONE`, a single number may stand for all of them.
pub(super) struct Numbers<T, const N: usize, const ONE: bool>(pub [T; N]);

/// A number that a single value can be repeated of.
pub(super) trait Repeat: Sized {
    fn again(&self) -> Self;
    fn from_f64<E: Error>(x: f64) -> Result<Self, E>;
    fn interval() -> &'static str;
}

impl<I: Interval> Repeat for In<I> {
    fn again(&self) -> Self {
        In(self.0, PhantomData)
    }
    fn from_f64<E: Error>(x: f64) -> Result<Self, E> {
        In::new(x, x)
    }
    fn interval() -> &'static str {
        I::TEXT
    }
}

impl<I: Interval> Repeat for Whole<I> {
    fn again(&self) -> Self {
        Whole(self.0, PhantomData)
    }
    fn from_f64<E: Error>(x: f64) -> Result<Self, E> {
        Err(E::custom(format!("{x} is not a list of whole numbers in {}", I::TEXT)))
    }
    fn interval() -> &'static str {
        I::TEXT
    }
}

struct NumbersVisitor<T, const N: usize, const ONE: bool>(PhantomData<T>);

impl<'de, T, const N: usize, const ONE: bool> Visitor<'de> for NumbersVisitor<T, N, ONE>
where
    T: Repeat + Deserialize<'de>,
{
    type Value = Numbers<T, N, ONE>;
    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let one = if ONE { "a number or " } else { "" };
        write!(f, "{one}a list of {N} numbers in {}", T::interval())
    }
    fn visit_f64<E: Error>(self, x: f64) -> Result<Self::Value, E> {
        if !ONE {
            return Err(E::invalid_type(Unexpected::Float(x), &self));
        }
        let first = T::from_f64::<E>(x)?;
        Ok(Numbers(std::array::from_fn(|_| first.again())))
    }
    fn visit_u64<E: Error>(self, x: u64) -> Result<Self::Value, E> {
        if ONE { self.visit_f64(x as f64) } else { Err(E::invalid_type(Unexpected::Unsigned(x), &self)) }
    }
    fn visit_i64<E: Error>(self, x: i64) -> Result<Self::Value, E> {
        if ONE { self.visit_f64(x as f64) } else { Err(E::invalid_type(Unexpected::Signed(x), &self)) }
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
        let mut items = Vec::with_capacity(N);
        while let Some(item) = seq.next_element::<T>()? {
            if items.len() == N {
                return Err(A::Error::custom(format!("more than {N} numbers")));
            }
            items.push(item);
        }
        let found = items.len();
        let items: [T; N] = items.try_into().map_err(|_| {
            A::Error::custom(format!(
                "{found} number{} where {N} are called for",
                if found == 1 { "" } else { "s" }
            ))
        })?;
        Ok(Numbers(items))
    }
}

impl<'de, T, const N: usize, const ONE: bool> Deserialize<'de> for Numbers<T, N, ONE>
where
    T: Repeat + Deserialize<'de>,
{
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NumbersVisitor(PhantomData))
    }
}

impl<T: JsonSchema, const N: usize, const ONE: bool> JsonSchema for Numbers<T, N, ONE> {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Numbers".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let one: Value = generator.subschema_for::<T>().into();
        let list = json_schema!({ "type": "array", "items": one.clone(), "minItems": N, "maxItems": N });
        if ONE { json_schema!({ "anyOf": [one, Value::from(list)] }) } else { list }
    }
}

/// A range `[lo, hi]`, or one number for both ends; lo <= hi.
pub(super) struct Span<I, const ONE: bool>(pub [f64; 2], PhantomData<I>);

impl<'de, I: Interval, const ONE: bool> Deserialize<'de> for Span<I, ONE> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let Numbers([lo, hi]) = Numbers::<In<I>, 2, ONE>::deserialize(deserializer)?;
        if lo.0 > hi.0 {
            return Err(D::Error::custom(format!("the range [{}, {}] is upside down", lo.0, hi.0)));
        }
        Ok(Span([lo.0, hi.0], PhantomData))
    }
}

impl<I: Interval, const ONE: bool> JsonSchema for Span<I, ONE> {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Span".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        Numbers::<In<I>, 2, ONE>::json_schema(generator)
    }
}
