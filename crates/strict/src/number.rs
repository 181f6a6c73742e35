//! Numbers of a scene: finite, not negative zero, inside a stated interval; one, or two as a range.

use std::fmt;
use std::marker::PhantomData;

use serde::de::{Deserialize, Deserializer, Error, IgnoredAny, SeqAccess, Unexpected, Visitor};

/// An interval of the reals with a name for messages.
pub trait Interval {
    /// Its lower end.
    const MIN: f64;
    /// Its upper end.
    const MAX: f64;
    /// Whether MIN itself is outside.
    const OPEN: bool = false;
    /// As `[0, 1]`.
    const TEXT: &'static str;
}

/// Declares intervals: name, least, largest, whether the least is outside, and the words for it.
#[macro_export]
macro_rules! intervals {
    ($($(#[$doc:meta])* $name:ident = $min:expr, $max:expr, $open:expr, $text:expr;)*) => {
        $($(#[$doc])* pub struct $name;
        impl $crate::number::Interval for $name {
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
    /// Index of refraction of a dielectric, whose reflectance needs an interface.
    DielectricIor = 1.0, 4.0, true, "(1, 4]";
    /// Weights of a lobe.
    NotNegative = 0.0, 1e30, false, "[0, 1e30]";
}

/// Whether a number, `written` so in the file, lies in the interval; if not, the message.
///
/// # Errors
/// The message.
pub fn inside<I: Interval>(x: f64, written: impl fmt::Display) -> Result<(), String> {
    let below = if I::OPEN { x <= I::MIN } else { x < I::MIN };
    if below || x > I::MAX || !x.is_finite() {
        return Err(format!("{written} is outside {}", I::TEXT));
    }
    Ok(())
}

/// A real number in an interval.
pub struct In<I>(pub f64, PhantomData<I>);

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

/// A whole number in an interval.
pub struct Whole<I>(pub u32, PhantomData<I>);

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
            // An integer of JSON Schema may have a decimal point.
            fn visit_f64<E: Error>(self, x: f64) -> Result<Whole<I>, E> {
                match x as u64 {
                    whole if whole as f64 == x => self.visit_u64(whole),
                    _ => Err(E::invalid_type(Unexpected::Float(x), &self)),
                }
            }
        }
        deserializer.deserialize_any(WholeVisitor(PhantomData))
    }
}

/// `N` numbers; where `ONE`, a single number may stand for all of them.
pub struct Numbers<T, const N: usize, const ONE: bool>(pub [T; N]);

/// A number that a single value can be repeated of.
pub trait Repeat: Sized {
    /// The same number.
    fn again(&self) -> Self;
    /// A number of a value that stands alone.
    ///
    /// # Errors
    /// One that the interval does not hold.
    fn from_f64<E: Error>(x: f64) -> Result<Self, E>;
    /// The interval in words.
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
        while items.len() < N
            && let Some(item) = seq.next_element::<T>()?
        {
            items.push(item);
        }
        // Whatever it is: one too many is not judged for itself.
        if items.len() == N && seq.next_element::<IgnoredAny>()?.is_some() {
            return Err(A::Error::custom(format!("more than {N} numbers")));
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

/// A range `[lo, hi]`, or one number for both ends; lo <= hi.
pub struct Span<I, const ONE: bool>(pub [f64; 2], PhantomData<I>);

impl<'de, I: Interval, const ONE: bool> Deserialize<'de> for Span<I, ONE> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let Numbers([lo, hi]) = Numbers::<In<I>, 2, ONE>::deserialize(deserializer)?;
        if lo.0 > hi.0 {
            return Err(D::Error::custom(format!("the range [{}, {}] is upside down", lo.0, hi.0)));
        }
        Ok(Span([lo.0, hi.0], PhantomData))
    }
}
