//! Numbers of 320 bits, without allocation: what cancels in a textbook's form costs them nothing that a
//! test would see. What is below their last bit is cut off; quotients and roots are rounded to 300 bits.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};
use std::sync::LazyLock;

use lobefit_math::ops;

/// The square of 1e-24, which is the least difference that the attacks make, has 140 bits left.
const WORDS: usize = 5;

/// Bits of quotients and roots: those of squares and products are exact.
const ROUNDED: i64 = 300;

/// Terms of a series: the last is below 2^-300 for e^x with x = 2^-16, and for sin x with x = 2^-8.
const TERMS: usize = 16;

/// Terms of artanh z or artan z with z = 2^-50.
const NEAR: usize = 4;

/// Reciprocals of 0!, 1!, 2! and so on, and of the odd numbers.
static FACTORIALS: LazyLock<Vec<Big>> = LazyLock::new(|| {
    let next = |last: &mut Big, n: usize| {
        *last = *last / n.max(1) as f64;
        Some(*last)
    };
    (0..2 * TERMS).scan(Big::from(1.0), next).collect()
});
static ODD: LazyLock<Vec<Big>> =
    LazyLock::new(|| (0..NEAR).map(|n| 1.0 / Big::from((2 * n + 1) as f64)).collect());

/// The polynomial of these coefficients, the constant first.
fn sum<'a>(coefficients: impl DoubleEndedIterator<Item = &'a Big>, x: Big) -> Big {
    coefficients.rev().fold(Big::from(0.0), |sum, c| sum * x + c)
}

/// A part from 1/2 to below 1, of words with the lowest first, times 2^exponent; or 0, whose words are 0.
/// Exponents neither overflow nor underflow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Big {
    is_negative: bool,
    exponent: i64,
    words: [u64; WORDS],
}

impl From<f64> for Big {
    /// Of a finite number; -0 is 0.
    fn from(x: f64) -> Big {
        assert!(x.is_finite(), "{x}");
        let (fraction, biased) = (x.to_bits() & ((1 << 52) - 1), (x.to_bits() >> 52 & 0x7ff) as i64);
        let mut words = [0; WORDS];
        words[WORDS - 1] = if biased == 0 { fraction } else { fraction | 1 << 52 };
        Big::of(x.is_sign_negative(), biased.max(1) - 1075 + 64, words)
    }
}

impl From<&Big> for Big {
    fn from(x: &Big) -> Big {
        *x
    }
}

/// An operator between numbers, references to them and f64.
macro_rules! operator {
    ($($name:ident $call:ident $of:expr),*) => { $(
        impl<T: Into<Big>> $name<T> for Big {
            type Output = Big;
            fn $call(self, other: T) -> Big {
                $of(self, other.into())
            }
        }
        impl<T: Into<Big>> $name<T> for &Big {
            type Output = Big;
            fn $call(self, other: T) -> Big {
                $of(*self, other.into())
            }
        }
        impl $name<Big> for f64 {
            type Output = Big;
            fn $call(self, other: Big) -> Big {
                $of(Big::from(self), other)
            }
        }
        impl $name<&Big> for f64 {
            type Output = Big;
            fn $call(self, other: &Big) -> Big {
                $of(Big::from(self), *other)
            }
        }
    )* };
}
operator!(Add add Big::plus, Sub sub |a: Big, b: Big| a.plus(-b), Mul mul Big::times, Div div Big::over);

impl Neg for Big {
    type Output = Big;
    fn neg(self) -> Big {
        Big { is_negative: !self.is_negative && !self.is_zero(), ..self }
    }
}

impl PartialOrd for Big {
    fn partial_cmp(&self, other: &Big) -> Option<Ordering> {
        let difference = self - other;
        Some(if difference.is_zero() {
            Ordering::Equal
        } else if difference.is_negative {
            Ordering::Less
        } else {
            Ordering::Greater
        })
    }
}

/// The sum of words, or their difference: b's bits inverted, and 1. And what is carried.
fn added(mut a: [u64; WORDS + 1], b: [u64; WORDS + 1], is_less: bool) -> ([u64; WORDS + 1], bool) {
    let (mut carry, mask) = (u128::from(is_less), if is_less { u64::MAX } else { 0 });
    for (a, b) in a.iter_mut().zip(b) {
        let sum = u128::from(*a) + u128::from(b ^ mask) + carry;
        (*a, carry) = (sum as u64, sum >> 64);
    }
    (a, carry != 0)
}

impl Big {
    /// Words, the lowest first, of a part below 1.
    fn of<const N: usize>(is_negative: bool, exponent: i64, words: [u64; N]) -> Big {
        let Some(top) = words.iter().rposition(|word| *word != 0) else {
            return Big { is_negative: false, exponent: 0, words: [0; WORDS] };
        };
        let bits = words[top].leading_zeros();
        let mut below = [0; 3 * WORDS + 1];
        for (i, word) in words.into_iter().enumerate() {
            below[WORDS + 1 + i] = word;
        }
        let kept = &below[top + 1..top + 2 + WORDS];
        let mut words = [0; WORDS];
        for (i, word) in words.iter_mut().enumerate() {
            *word = kept[i + 1] << bits | kept[i] >> 1 >> (63 - bits);
        }
        Big { is_negative, exponent: exponent - 64 * (N - 1 - top) as i64 - i64::from(bits), words }
    }

    /// The words and one below, over a power of two.
    fn shifted(&self, power: i64) -> [u64; WORDS + 1] {
        let mut above = [0; 2 * WORDS + 3];
        for (i, word) in self.words.into_iter().enumerate() {
            above[1 + i] = word;
        }
        let (whole, bits) = ((power / 64).min(WORDS as i64 + 1) as usize, power % 64);
        let above = &above[whole..whole + WORDS + 2];
        let mut words = [0; WORDS + 1];
        for (i, word) in words.iter_mut().enumerate() {
            // Two steps, for 64 - 0 is no step of one word.
            *word = above[i] >> bits | above[i + 1] << 1 << (63 - bits);
        }
        words
    }

    fn plus(self, other: Big) -> Big {
        if self.is_zero() || other.is_zero() {
            return if self.is_zero() { other } else { self };
        }
        let exponent = self.exponent.max(other.exponent) + 1;
        let [a, b] = [self, other].map(|x| x.shifted(exponent - x.exponent));
        let is_less = self.is_negative != other.is_negative;
        let (sum, carry) = added(a, b, is_less);
        // Without a carry a difference is that of a negative number.
        let is_turned = is_less && !carry;
        let sum = if is_turned { added([0; WORDS + 1], sum, true).0 } else { sum };
        Big::of(self.is_negative != is_turned, exponent, sum)
    }

    fn times(self, other: Big) -> Big {
        let mut product = [0; 2 * WORDS];
        for (i, a) in self.words.into_iter().enumerate() {
            let mut carry = 0;
            for (j, b) in other.words.into_iter().enumerate() {
                let sum = u128::from(a) * u128::from(b) + u128::from(product[i + j]) + carry;
                (product[i + j], carry) = (sum as u64, sum >> 64);
            }
            product[i + WORDS] = carry as u64;
        }
        Big::of(self.is_negative != other.is_negative, self.exponent + other.exponent, product)
    }

    /// By Newton's steps to the reciprocal, from that in f64.
    fn over(self, other: Big) -> Big {
        assert!(!other.is_zero(), "{self:?} over 0");
        let part = Big { exponent: 0, ..other };
        let step = |y: Big, _| y + y * (1.0 - part * y);
        let reciprocal = (0..3).fold(Big::from(1.0 / part.to_f64()), step);
        (self * reciprocal).doubled(-other.exponent).rounded()
    }

    /// Of a number that is not negative: by Newton's steps to the reciprocal root, from that in f64.
    pub fn sqrt(&self) -> Big {
        assert!(!self.is_negative, "root of {self:?}");
        if self.is_zero() {
            return *self;
        }
        let odd = self.exponent.rem_euclid(2);
        let part = Big { exponent: -odd, ..*self };
        let step = |y: Big, _| y + (y * (1.0 - part * y.square())).doubled(-1);
        let reciprocal = (0..3).fold(Big::from(1.0 / part.to_f64().sqrt()), step);
        (part * reciprocal).doubled((self.exponent + odd) / 2).rounded()
    }

    /// To the nearest of 300 bits.
    fn rounded(self) -> Big {
        if self.is_zero() {
            return self;
        }
        let half = Big { exponent: self.exponent - ROUNDED, ..Big::from(0.5) };
        let mut sum = self + if self.is_negative { -half } else { half };
        sum.words[0] = sum.words[0] >> 20 << 20;
        sum
    }

    /// Times 2^power.
    fn doubled(self, power: i64) -> Big {
        if self.is_zero() { self } else { Big { exponent: self.exponent + power, ..self } }
    }

    pub fn pi() -> Big {
        static PI: LazyLock<Big> = LazyLock::new(|| 6.0 * Big::from(0.5).asin());
        *PI
    }

    pub fn square(&self) -> Big {
        self * self
    }

    pub fn fifth_power(&self) -> Big {
        self.square().square() * self
    }

    /// The number over a power of two, of a size below 2^-bits, and the power.
    fn halved(&self, bits: i64) -> (Big, i64) {
        let power = if self.is_zero() { 0 } else { (self.exponent + bits).max(0) };
        (self.doubled(-power), power)
    }

    /// By squares of the exponential of a small part.
    pub fn exp(&self) -> Big {
        let (part, power) = self.halved(16);
        (0..power).fold(sum(FACTORIALS.iter().take(TERMS), part), |e, _| e.square())
    }

    /// Of a number above 0: with e^y from y in f64, ln x = y + 2 artanh ((x - e^y)/(x + e^y)).
    pub fn ln(&self) -> Big {
        let y = Big::from(ops::log(self.to_f64()));
        let e = y.exp();
        let z = (self - e) / (self + e);
        y + (z * sum(ODD.iter(), z.square())).doubled(1)
    }

    /// By the sine and cosine of doubled angles.
    pub fn sin_cos(&self) -> [Big; 2] {
        let (part, power) = self.halved(8);
        let square = -part.square();
        let [cosine, sine] = [0, 1].map(|odd| sum(FACTORIALS.iter().skip(odd).step_by(2), square));
        let twice = |[s, c]: [Big; 2], _| [(s * c).doubled(1), 1.0 - s.square().doubled(1)];
        (0..power).fold([sine * part, cosine], twice)
    }

    /// From an angle y in f64: asin x = y + artan (sin (asin x - y)/cos (asin x - y)).
    pub fn asin(&self) -> Big {
        let y = Big::from(ops::asin(self.to_f64()));
        let ([s, c], root) = (y.sin_cos(), (1.0 - self.square()).sqrt());
        let z = (self * c - root * s) / (root * c + self * s);
        y + z * sum(ODD.iter(), -z.square())
    }

    pub fn abs(&self) -> Big {
        Big { is_negative: false, ..*self }
    }

    pub fn max(self, other: impl Into<Big>) -> Big {
        let other = other.into();
        if self < other { other } else { self }
    }

    pub fn is_zero(&self) -> bool {
        self.words[WORDS - 1] == 0
    }

    /// The f64 nearest to the first 64 bits; infinite or 0 beyond its range.
    pub fn to_f64(self) -> f64 {
        // Thirds of the power, of which the last alone may leave the normal numbers.
        let power = (self.exponent - 64).clamp(-2_400, 2_400);
        let third = |power: i64| f64::from_bits(((1_023 + power) as u64) << 52);
        let size =
            self.words[WORDS - 1] as f64 * third(power / 3) * third(power / 3) * third(power - power / 3 * 2);
        if self.is_negative { -size } else { size }
    }
}

/// Values of mpmath: exponents, and 320 bits of parts from 1/2 to 1.
const KNOWN: &str = "
2 c90fdaa22168c234c4c6628b80dc1cd129024e088a67cc74020bbea63b139b22514a08798e3404dd
2 adf85458a2bb4a9aafdc5620273d3cf1d8b9c583ce2d3695a9e13641146433fbcc939dce249b3ef9
-1010 a7fa3ae346500dbb2869239a26fd0fbd11bbc1795068f11bb3dba79978ab48e3e6dd4651c465a685
0 b17217f7d1cf79abc9e3b39803f2f6af40f343267298b62d8a0d175b8baafa2be7b876206debac98
10 acb1a23fc3fda9abccc0710fcd43f89247673618c3f960050652cd7a917ff3caa3396916a0dfed1f
-39 800000000040000000002aaaaaaaaacaaaaaaaaac4444444445999999999abe2be2be2ce2be2be2b
-2 9081c36db6aada78e40ba11a0c541a596bc5bef59678f73900049c576cbb7ca1179cb498b6b327dd
0 fd7025f42f2e9307dff82fdf6a7053eb5ea4a387206aefc366463c87370160fb8b9761578b079206
0 d91a98ae3406e040ac1ed9b06af0fd0c48db6a122bcc79f7984712e4af541ac9e534723439d8d863
1 b504f333f9de6484597d89b3754abe9f1d6f60ba893ba84ced17ac85833399154afc83043ab8a2c3
-1 aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa
";

#[test]
fn functions_are_what_another_program_says() {
    let [third, three_quarters, two, three] =
        [1.0 / Big::from(3.0), Big::from(0.75), Big::from(2.0), Big::from(3.0)];
    let [sine, cosine] = three.sin_cos();
    let near_1 = 1.0 - Big::from(1.0).doubled(-40);
    let e = Big::from(1.0).exp();
    let ours = [Big::pi(), e, Big::from(-700.5).exp(), two.ln(), Big::from(1e300).ln(), -near_1.ln()];
    let ours = ours.into_iter().chain([sine, -cosine, three_quarters.asin(), two.sqrt(), third]);
    let known: Vec<&str> = KNOWN.trim().lines().collect();
    assert_eq!(ours.clone().count(), known.len());
    for (ours, line) in ours.zip(known) {
        let (exponent, digits) = line.split_once(' ').expect("two columns");
        let word = |i: usize| u64::from_str_radix(&digits[16 * i..16 * (i + 1)], 16).expect("hexadecimal");
        let words = std::array::from_fn(|i| word(WORDS - 1 - i));
        let exact = Big { is_negative: false, exponent: exponent.parse().expect("a power"), words };
        let off = ((ours - exact).abs() / exact).to_f64();
        assert!(off < 1e-82, "{line}: {off:e}");
    }
}

#[test]
fn arithmetic_undoes_itself() {
    assert_eq!(0.0 / Big::from(3.0), Big::from(-0.0).sqrt());
    let values = [1e-300, -3e-24, 0.1, 1.0, 1.0 + 1e-15, -7.5, 1e24, f64::MAX, 5e-324];
    for a in values.map(Big::from) {
        assert_eq!(Big::from(a.to_f64()), a);
        assert_eq!(a.square().sqrt(), a.abs());
        assert_eq!(a - a, Big::from(0.0));
        for b in values.map(Big::from) {
            assert_eq!(a * b / b, a);
            assert_eq!(a.to_f64().partial_cmp(&b.to_f64()), a.partial_cmp(&b));
            if (a.exponent - b.exponent).abs() < 200 {
                assert_eq!(a + b - b, a);
            }
        }
    }
}
