//! Which samples are tried as neighbours: by the distance of their places, or by that of their configurations.
//!
//! Two configurations are as far apart as the root of the sum of squares of their coordinates' differences. Joints count in
//! radians, with no turn taken off but for those that turn without end, which are taken the shorter way round. Joints that slide
//! count in metres, and the plane in millimetres. All samples are measured in f32, sixteen side by side; those that may be near
//! are measured again in f64, which decides.

use super::{Sample, distance_mm, square_mm2};
use fearless_simd::{Level, dispatch};
use std::f64::consts::TAU;

/// Which samples are tried as neighbours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Near {
    /// Those whose places are at most so many millimetres apart.
    Places(f64),
    /// Those whose configurations are at most so far apart.
    Configurations(f64),
    /// A pair, if one of the two is among this many nearest to the other by configuration; of equally far samples the one drawn
    /// first.
    Nearest(usize),
}

impl Near {
    /// The radius of places; infinite where places do not matter.
    pub(super) fn radius_mm(self) -> f64 {
        match self {
            Self::Places(radius_mm) => radius_mm,
            Self::Configurations(_) | Self::Nearest(_) => f64::INFINITY,
        }
    }
}

/// How many samples are measured side by side.
const GROUP: usize = 16;
/// How far f32 may be off, as a share of a distance and of the coordinates: several of its last digits.
const ROUGH: f64 = 1e-6;

/// Samples as neighbours are looked for among them.
#[derive(Debug)]
pub(super) struct Samples {
    near: Near,
    places_mm: Vec<[f64; 3]>,
    count: usize,
    /// The configurations, one after another.
    configs: Vec<f64>,
    /// By group, then by coordinate, in f32; what fills the last group is infinitely far.
    groups: Vec<[f32; GROUP]>,
    /// The greatest coordinate, either way.
    extent: f64,
    /// Which coordinates are angles that whole turns part from themselves.
    turn_on: Vec<bool>,
}

/// Buffers for the distances from one configuration.
#[derive(Debug, Default)]
struct Gaps {
    own: Vec<f32>,
    squares: Vec<[f32; GROUP]>,
    least: Vec<f32>,
    ranked: Vec<u32>,
    nearest: Vec<(f64, u32)>,
}

impl Samples {
    /// `samples` with their places; `turn_on` says which coordinates are taken the shorter way round.
    pub(super) fn new(near: Near, samples: &[Sample], places_mm: Vec<[f64; 3]>, turn_on: Vec<bool>) -> Self {
        let axes = samples.first().map_or(0, |sample| sample.config.len());
        let mut configs = Vec::new();
        let mut groups = Vec::new();
        if !matches!(near, Near::Places(_)) {
            groups.resize(samples.len().div_ceil(GROUP) * axes, [f32::INFINITY; GROUP]);
            for (i, sample) in samples.iter().enumerate() {
                configs.extend_from_slice(&sample.config);
                for (axis, value) in folded(&sample.config, &turn_on).enumerate() {
                    groups[i / GROUP * axes + axis][i % GROUP] = value;
                }
            }
        }
        let extent = largest(&configs);
        Self { near, places_mm, count: samples.len(), configs, groups, extent, turn_on }
    }

    pub(super) fn radius_mm(&self) -> f64 {
        self.near.radius_mm()
    }

    pub(super) fn places_mm(&self) -> &[[f64; 3]] {
        &self.places_mm
    }

    /// Every pair of neighbours once, the lower number first, with the distance of their places; by the higher number, then by
    /// the lower, a number at a time.
    pub(super) fn each_pair(&self, samples: &[Sample], mut visit: impl FnMut(usize, usize, f64)) {
        let Near::Places(radius_mm) = self.near else {
            for pair in self.pairs(samples) {
                let [to, from] = [pair >> 32, pair & u64::from(u32::MAX)].map(|number| number as usize);
                visit(from, to, distance_mm(&self.places_mm[from], &self.places_mm[to]));
            }
            return;
        };
        let beyond_mm2 = radius_mm * radius_mm * (1.0 + 1e-12);
        for to in 0..self.count {
            for from in 0..to {
                // The square is a bound: most pairs are far beyond it and need no root.
                if square_mm2(&self.places_mm[from], &self.places_mm[to]) > beyond_mm2 {
                    continue;
                }
                let gap_mm = distance_mm(&self.places_mm[from], &self.places_mm[to]);
                if gap_mm <= radius_mm {
                    visit(from, to, gap_mm);
                }
            }
        }
    }

    /// The pairs of neighbours by configuration, the higher number in the upper half, in order.
    fn pairs(&self, samples: &[Sample]) -> Vec<u64> {
        let mut gaps = Gaps::default();
        let mut pairs = Vec::new();
        for (own, sample) in (0..).zip(samples) {
            self.write_neighbours(&sample.config, Some(own), &mut gaps);
            let both = |other: u32| u64::from(own.max(other)) << 32 | u64::from(own.min(other));
            pairs.extend(gaps.nearest.iter().map(|(_, other)| both(*other)));
        }
        pairs.sort_unstable();
        pairs.dedup();
        pairs
    }

    /// The neighbours of a configuration that is no sample, in order, with the distances of their places from its own.
    pub(super) fn neighbours(&self, config: &[f64], place_mm: &[f64; 3]) -> Vec<(u32, f64)> {
        let gap_mm = |sample: u32| (sample, distance_mm(&self.places_mm[sample as usize], place_mm));
        if let Near::Places(radius_mm) = self.near {
            return (0..self.count as u32).map(gap_mm).filter(|(_, gap_mm)| *gap_mm <= radius_mm).collect();
        }
        let mut gaps = Gaps::default();
        self.write_neighbours(config, None, &mut gaps);
        let mut found: Vec<u32> = gaps.nearest.iter().map(|(_, sample)| *sample).collect();
        found.sort_unstable();
        found.into_iter().map(gap_mm).collect()
    }

    /// Whether two configurations that are no samples would be neighbours if they were.
    pub(super) fn are_near(&self, [a, b]: [&[f64]; 2], gap_mm: f64) -> bool {
        let apart = || self.square(a, b);
        match self.near {
            Near::Places(radius_mm) => gap_mm <= radius_mm,
            Near::Configurations(radius) => apart() <= radius * radius,
            Near::Nearest(count) => [a, b].iter().any(|own| {
                let nearer = |other: &[f64]| self.square(own, other) < apart();
                self.configs.chunks_exact(own.len()).filter(|other| nearer(other)).count() < count
            }),
        }
    }

    /// Measures all samples in f32.
    fn measure(&self, config: &[f64], gaps: &mut Gaps) {
        let count = self.count.div_ceil(GROUP);
        let Gaps { own, squares, least, .. } = gaps;
        own.clear();
        own.extend(folded(config, &self.turn_on));
        squares.resize(count, [0.0; GROUP]);
        least.resize(count, 0.0);
        dispatch!(Level::new(), _simd => write_gaps(own, &self.turn_on, &self.groups, squares, least));
    }

    /// The square of the distance between two configurations.
    #[inline]
    fn square(&self, a: &[f64], b: &[f64]) -> f64 {
        let gap = |((a, b), turns_on): ((&f64, &f64), &bool)| {
            let gap = a - b;
            if *turns_on { gap - TAU * (gap / TAU).round() } else { gap }
        };
        a.iter().zip(b).zip(&self.turn_on).map(gap).map(|gap| gap * gap).sum()
    }

    /// Writes the samples near to `config` into `nearest`, `own` left out, in no order.
    fn write_neighbours(&self, config: &[f64], own: Option<u32>, gaps: &mut Gaps) {
        self.measure(config, gaps);
        let Gaps { squares, least, ranked, nearest, .. } = gaps;
        let off = ROUGH * largest(config).max(self.extent) * (config.len() as f64).sqrt();
        // So far may a sample be in f32 that is at most `gap` away.
        let roughly = |gap: f64| (gap + off) * (1.0 + ROUGH);
        let (bound, reach, most) = match self.near {
            Near::Nearest(count) if count < least.len() => {
                ranked.clear();
                ranked.extend(least.iter().map(|gap| gap.to_bits()));
                // So many groups hold a sample within it that the nearest are within it, and the sample itself.
                let within = f64::from(f32::from_bits(*ranked.select_nth_unstable(count).1)).sqrt();
                (f64::MAX, roughly(roughly(within)), count)
            }
            Near::Nearest(count) => (f64::MAX, f64::INFINITY, count),
            Near::Configurations(radius) => (radius * radius, roughly(radius.abs()), usize::MAX),
            Near::Places(_) => return,
        };
        // Rounded up, if at all.
        let rough = ((reach * reach * (1.0 + ROUGH)) as f32).next_up();
        nearest.clear();
        for (group, gaps) in squares.iter().enumerate().filter(|(group, _)| least[*group] <= rough) {
            let first = group * GROUP;
            for sample in (first..self.count).zip(gaps).filter(|(_, gap)| **gap <= rough).map(|near| near.0) {
                let gap = self.square(config, &self.configs[sample * config.len()..][..config.len()]);
                if gap <= bound && Some(sample as u32) != own {
                    nearest.push((gap, sample as u32));
                }
            }
        }
        if most < nearest.len() {
            nearest.select_nth_unstable_by(most, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            nearest.truncate(most);
        }
    }
}

/// The greatest coordinate, either way.
fn largest(config: &[f64]) -> f64 {
    config.iter().fold(0.0, |most, value| value.abs().max(most))
}

/// A configuration in f32, its coordinates that turn on within half a turn of 0.
fn folded(config: &[f64], turn_on: &[bool]) -> impl Iterator<Item = f32> {
    let fold = |(value, turns_on): (&f64, &bool)| {
        if *turns_on { value - TAU * (value / TAU).round() } else { *value }
    };
    config.iter().zip(turn_on).map(fold).map(|value| value as f32)
}

/// Writes the squares of the distances from `own` to the samples of each group, and the least of each group.
#[expect(clippy::inline_always, reason = "it is compiled for the instructions of its caller")]
#[inline(always)]
fn write_gaps(
    own: &[f32],
    turn_on: &[bool],
    groups: &[[f32; GROUP]],
    squares: &mut [[f32; GROUP]],
    least: &mut [f32],
) {
    for ((group, squares), least) in groups.chunks_exact(own.len()).zip(squares).zip(least) {
        let mut sums = [0.0; GROUP];
        for ((values, own), turns_on) in group.iter().zip(own).zip(turn_on) {
            let gaps = values.iter().map(|value| own - value);
            if *turns_on {
                let turned = |gap: f32| gap.abs().min((std::f32::consts::TAU - gap.abs()).abs());
                sums.iter_mut().zip(gaps.map(turned)).for_each(|(sum, gap)| *sum += gap * gap);
            } else {
                sums.iter_mut().zip(gaps).for_each(|(sum, gap)| *sum += gap * gap);
            }
        }
        *squares = sums;
        let mut half = GROUP / 2;
        while half > 0 {
            for lane in 0..half {
                sums[lane] = if sums[lane + half] < sums[lane] { sums[lane + half] } else { sums[lane] };
            }
            half /= 2;
        }
        *least = sums[0];
    }
}
