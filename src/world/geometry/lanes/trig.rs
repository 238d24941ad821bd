//! Sines, cosines and arc tangents in lanes, to about one unit in the last place.
//!
//! # Source
//! In f64 the polynomials are those of Sun's fdlibm (`k_sin.c`, `k_cos.c`, `s_atan.c`), the reduction is its first step;
//! in f32 both are those of Moshier's Cephes (`sinf.c`).
#![expect(
    clippy::inline_always,
    reason = "lanes are compiled for the instructions of the function they end up in"
)]

use super::{ExtractToken, Lane, Number, Rough, Select, Simd, SimdBase, SimdFloat};
use fearless_simd::{Bytes, u32x8};
use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, FRAC_PI_4, PI};

/// The first 33 bits of π / 2, and the rest.
const QUARTER: [f64; 2] = [1.570_796_326_734_125_6, 6.077_100_506_506_192e-11];
const SIN: [f64; 6] = [
    1.589_690_995_211_55e-10,
    -2.505_076_025_340_686_3e-8,
    2.755_731_370_707_006_8e-6,
    -1.984_126_982_985_795e-4,
    8.333_333_333_322_49e-3,
    -1.666_666_666_666_663_2e-1,
];
const COS: [f64; 6] = [
    -1.135_964_755_778_819_5e-11,
    2.087_572_321_298_175e-9,
    -2.755_731_435_139_066_3e-7,
    2.480_158_728_947_673e-5,
    -1.388_888_888_887_411e-3,
    4.166_666_666_666_66e-2,
];
const ATAN: [f64; 11] = [
    1.628_582_011_536_578_2e-2,
    -3.653_157_274_421_691_6e-2,
    4.976_877_994_615_932e-2,
    -5.833_570_133_790_573e-2,
    6.661_073_137_387_531e-2,
    -7.691_876_205_044_83e-2,
    9.090_887_133_436_507e-2,
    -1.111_111_040_546_235_6e-1,
    1.428_571_427_250_346_6e-1,
    -1.999_999_999_987_648_3e-1,
    3.333_333_333_333_293e-1,
];
/// The tangent of π / 8: above it the arc is taken from π / 4.
const EIGHTH: f64 = 0.414_213_562_373_095_05;

/// The polynomial with these coefficients, the highest first.
#[inline(always)]
fn polynomial<L: Number, const N: usize>(at: L, coefficients: &[L::One; N]) -> L {
    let mut sum = at.all(coefficients[0]);
    for coefficient in &coefficients[1..] {
        sum = sum.times_plus(at, at.all(*coefficient));
    }
    sum
}

/// Sine and cosine of angles up to a million radians.
#[inline(always)]
pub fn sincos<S: Simd>(angle_rad: Lane<S>) -> (Lane<S>, Lane<S>) {
    let turns = (angle_rad * FRAC_2_PI).round_ties_even();
    let rest = (angle_rad - turns * QUARTER[0]) - turns * QUARTER[1];
    let z = rest * rest;
    let sine = (rest * z).mul_add(polynomial(z, &SIN), rest);
    let cosine = (z * z).mul_add(polynomial(z, &COS), z.mul_add(-0.5, 1.0));
    let quadrant = turns - (turns * 0.25).floor() * 4.0;
    let swapped = (quadrant - (quadrant * 0.5).floor() * 2.0).simd_gt(0.5);
    let (s, c) = (swapped.select(cosine, sine), swapped.select(sine, cosine));
    let below = quadrant.simd_gt(1.5);
    let behind = (quadrant - 1.5).abs().simd_lt(1.0);
    (below.select(-s, s), behind.select(-c, c))
}

/// π / 2 in three parts; the first two have so few digits that their multiples are exact.
const ROUGH_QUARTER: [f32; 3] = [1.570_312_5, 4.837_513e-4, 7.549_79e-8];
const ROUGH_SIN: [f32; 3] = [-1.951_529_6e-4, 8.332_161e-3, -1.666_665_5e-1];
const ROUGH_COS: [f32; 3] = [2.443_315_7e-5, -1.388_731_6e-3, 4.166_664_6e-2];
/// Added to a small number, it leaves the nearest integer in the last digits.
const TO_INTEGER: f32 = 12_582_912.0;

/// Sine and cosine, to seven digits, of angles up to a thousand radians.
#[inline(always)]
pub fn sincos_rough<S: Simd>(angle_rad: Rough<S>) -> (Rough<S>, Rough<S>) {
    let shifted = angle_rad.mul_add(std::f32::consts::FRAC_2_PI, TO_INTEGER);
    let turns = shifted - TO_INTEGER;
    let [first, second, third] = ROUGH_QUARTER;
    let rest = turns.mul_add(-third, turns.mul_add(-second, turns.mul_add(-first, angle_rad)));
    let z = rest * rest;
    let sine = (rest * z).mul_add(polynomial(z, &ROUGH_SIN), rest);
    let cosine = (z * z).mul_add(polynomial(z, &ROUGH_COS), z.mul_add(-0.5, 1.0));
    let quadrant: u32x8<S> = shifted.bitcast();
    let swapped = (quadrant << 31).simd_ge(1 << 31);
    let (s, c) = (swapped.select(cosine, sine), swapped.select(sine, cosine));
    (flipped(s, quadrant), flipped(c, quadrant + 1))
}

/// A sine or cosine with the sign that it has in a quadrant.
#[inline(always)]
fn flipped<S: Simd>(value: Rough<S>, quadrant: u32x8<S>) -> Rough<S> {
    let bits: u32x8<S> = value.bitcast();
    let sign = (quadrant << 30) & u32x8::splat(value.token(), 1 << 31);
    (bits ^ sign).bitcast()
}

/// The angle of the point `(x, y)`; NaN at the origin.
#[inline(always)]
pub fn atan2<S: Simd>(y: Lane<S>, x: Lane<S>) -> Lane<S> {
    let simd = y.token();
    let (across, along) = (y.abs(), x.abs());
    let small = across.min(along);
    let big = across.max(along);
    let steep = small.simd_gt(big * EIGHTH);
    let t = steep.select(small - big, small) / steep.select(small + big, big);
    let z = t * t;
    let arc = (t * z).mul_add(-polynomial(z, &ATAN), t);
    let zero = Lane::splat(simd, 0.0);
    let arc = arc + steep.select(Lane::splat(simd, FRAC_PI_4), zero);
    let arc = across.simd_gt(along).select(-arc + FRAC_PI_2, arc);
    x.simd_lt(0.0).select(-arc + PI, arc).copysign(y)
}
