//! Which samples are tried as neighbours: by the distance of their places, or by that of their configurations.
//!
//! Two configurations are as far apart as the root of the sum of squares of their coordinates' differences: radians for
//! joints, with no turn taken off, and millimetres in the plane. All samples are measured, sixteen side by side.

use super::{Sample, distance_mm, square_mm2};
use fearless_simd::{Level, dispatch};

/// Which samples are tried as neighbours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Near {
    /// Those whose places are at most so many millimetres apart.
    Places(f64),
    /// Those whose configurations are at most so far apart.
    Configurations(f64),
    /// Two of which one is among the so many whose configurations are nearest to the other's; of equally far ones the one
    /// drawn first.
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

/// Samples as neighbours are looked for among them.
#[derive(Debug)]
pub(super) struct Samples {
    near: Near,
    places_mm: Vec<[f64; 3]>,
    count: usize,
    /// By group, then by coordinate; what fills the last group is infinitely far.
    groups: Vec<[f64; GROUP]>,
}

/// Buffers for the distances from one configuration.
#[derive(Debug, Default)]
struct Gaps {
    squares: Vec<[f64; GROUP]>,
    least: Vec<f64>,
    ranked: Vec<u64>,
    nearest: Vec<(f64, u32)>,
}

impl Samples {
    /// `samples` with their places.
    pub(super) fn new(near: Near, samples: &[Sample], places_mm: Vec<[f64; 3]>) -> Self {
        let axes = samples.first().map_or(0, |sample| sample.config.len());
        let mut groups = Vec::new();
        if !matches!(near, Near::Places(_)) {
            groups.resize(samples.len().div_ceil(GROUP) * axes, [f64::INFINITY; GROUP]);
            for (i, sample) in samples.iter().enumerate() {
                for (axis, value) in sample.config.iter().enumerate() {
                    groups[i / GROUP * axes + axis][i % GROUP] = *value;
                }
            }
        }
        Self { near, places_mm, count: samples.len(), groups }
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
            for [to, from] in self.pairs(samples) {
                let [to, from] = [to, from].map(|number| number as usize);
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

    /// The pairs of neighbours by configuration, the higher number first, in order.
    fn pairs(&self, samples: &[Sample]) -> Vec<[u32; 2]> {
        let (mut gaps, mut pairs) = (Gaps::default(), Vec::new());
        for (own, sample) in (0..).zip(samples) {
            self.write_neighbours(&sample.config, Some(own), &mut gaps);
            pairs.extend(gaps.nearest.iter().map(|(_, other)| [own.max(*other), own.min(*other)]));
        }
        pairs.sort_unstable();
        pairs.dedup();
        pairs
    }

    /// The neighbours of a configuration that is no sample, in order, with the distances of their places from its own.
    pub(super) fn of(&self, config: &[f64], place_mm: &[f64; 3]) -> Vec<(u32, f64)> {
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
        let apart = || a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
        match self.near {
            Near::Places(radius_mm) => gap_mm <= radius_mm,
            Near::Configurations(radius) => apart() <= radius * radius,
            Near::Nearest(count) => [a, b].iter().any(|own| {
                let mut gaps = Gaps::default();
                self.measure(own, &mut gaps);
                gaps.squares.iter().flatten().filter(|gap| **gap < apart()).count() < count
            }),
        }
    }

    fn measure(&self, config: &[f64], gaps: &mut Gaps) {
        let groups = self.count.div_ceil(GROUP);
        gaps.squares.resize(groups, [0.0; GROUP]);
        gaps.least.resize(groups, 0.0);
        dispatch!(Level::new(), _simd => write_gaps(config, &self.groups, &mut gaps.squares, &mut gaps.least));
    }

    /// Writes the samples near to `config` into `nearest`, `own` left out.
    fn write_neighbours(&self, config: &[f64], own: Option<u32>, gaps: &mut Gaps) {
        self.measure(config, gaps);
        let Gaps { squares, least, ranked, nearest } = gaps;
        let (bound, most) = match self.near {
            Near::Nearest(count) if count < least.len() => {
                ranked.clear();
                ranked.extend(least.iter().map(|gap| gap.to_bits()));
                // So many groups hold a sample within the bound that the nearest are within it, and the sample itself.
                (f64::from_bits(*ranked.select_nth_unstable(count).1), count)
            }
            Near::Nearest(count) => (f64::MAX, count),
            Near::Configurations(radius) => (radius * radius, usize::MAX),
            Near::Places(_) => return,
        };
        nearest.clear();
        for (group, gaps) in squares.iter().enumerate().filter(|(group, _)| least[*group] <= bound) {
            let within = (0..).zip(gaps).filter(|(_, gap)| **gap <= bound);
            nearest.extend(within.map(|(lane, gap)| (*gap, (group * GROUP) as u32 + lane)));
        }
        nearest.retain(|(_, sample)| Some(*sample) != own);
        if most < nearest.len() {
            nearest.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            nearest.truncate(most);
        }
    }
}

/// Writes the squares of the distances from `own` to the samples of each group, and the least of each group.
#[expect(clippy::inline_always, reason = "it is compiled for the instructions of its caller")]
#[inline(always)]
fn write_gaps(own: &[f64], groups: &[[f64; GROUP]], squares: &mut [[f64; GROUP]], least: &mut [f64]) {
    for ((group, squares), least) in groups.chunks_exact(own.len()).zip(squares).zip(least) {
        let mut sums = [0.0; GROUP];
        for (values, own) in group.iter().zip(own) {
            for (sum, value) in sums.iter_mut().zip(values) {
                *sum += (own - value) * (own - value);
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
