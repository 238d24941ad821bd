//! The configurations that are asked about: drawn at random, and sought where two codes are likely to differ.

use super::model::{Model, Pair};
use super::subject::Subject;
use base::seed::{self, Stream};
use rand::RngExt as _;
use schemars::JsonSchema;
use serde::Deserialize;

/// Why a configuration is asked about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// Drawn evenly within the joints' limits.
    Random,
    /// Within [`NEAR_M`] of contact with one thing, on either side.
    NearContact,
    /// At a singular pose.
    Singular,
    /// A capsule's axis goes through an obstacle.
    Piercing,
    /// A joint at its limit, just inside or outside, or beyond it.
    Limit,
    /// On a path.
    Path,
    /// On a path that was pushed into something: a negative control.
    Pushed,
}

impl Kind {
    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Random => "random",
            Self::NearContact => "within 1 mm of contact",
            Self::Singular => "singular",
            Self::Piercing => "axis pierces an obstacle",
            Self::Limit => "joint limits",
            Self::Path => "paths",
            Self::Pushed => "pushed path",
        }
    }
}

/// One configuration and what is asked about it besides contact.
#[derive(Debug, Clone, PartialEq)]
pub struct Question {
    /// Why it is asked about.
    pub kind: Kind,
    /// The path it is on, by index; 0 for those on none.
    pub path: usize,
    /// The joint angles.
    pub q_rad: Vec<f64>,
    /// Whether frames are asked for.
    pub frames: bool,
    /// Whether distances are.
    pub gaps: bool,
    /// Whether the joints that are beyond their limits are.
    pub limits: bool,
}

/// How many configurations of each kind are asked about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sizes {
    /// Drawn evenly.
    #[schemars(range(max = 1_000_000))]
    pub random: u32,
    /// Of these, how many are also asked for their frames.
    #[schemars(range(max = 1_000_000))]
    pub random_frames: u32,
    /// Of these, how many are also asked for their distances.
    #[schemars(range(max = 1_000_000))]
    pub random_distances: u32,
    /// Within [`NEAR_M`] of contact.
    #[schemars(range(max = 1_000_000))]
    pub near_contact: u32,
    /// Singular.
    #[schemars(range(max = 1_000_000))]
    pub singular: u32,
    /// In which solids go through each other.
    #[schemars(range(max = 1_000_000))]
    pub piercing: u32,
    /// Straight joint paths drawn where no paths are stored.
    #[schemars(range(max = 1_000_000))]
    pub drawn_paths: u32,
}

/// How near to contact the adversarial configurations are.
pub const NEAR_M: f64 = 1e-3;
/// The nearest of them; nearer ones would be within the tolerance.
const NEAREST_M: f64 = 2e-6;
/// Draws per wanted configuration after which a search ends.
const DRAWS: u32 = 40;
/// Halvings of a bisection.
const HALVINGS: u32 = 60;
/// How far beyond a limit the limit questions go, and how near to it.
const BEYOND_RAD: [f64; 2] = [1e-9, 0.1];

/// Draws configurations of one robot.
pub struct Sampler<'a> {
    subject: &'a dyn Subject,
    seed: u64,
}

fn question(kind: Kind, q_rad: Vec<f64>) -> Question {
    Question { kind, path: 0, q_rad, frames: false, gaps: false, limits: false }
}

/// A configuration within the limits.
pub fn drawn(model: &Model, stream: &mut Stream) -> Vec<f64> {
    let angle = |row: &super::model::Row, stream: &mut Stream| {
        let [low, high] = row.limits_rad;
        low + (high - low) * stream.random::<f64>()
    };
    model.rows.iter().map(|row| angle(row, stream)).collect()
}

fn mixed(a: &[f64], b: &[f64], share: f64) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a + (b - a) * share).collect()
}

impl<'a> Sampler<'a> {
    /// A sampler whose streams derive from `seed`.
    pub fn new(subject: &'a dyn Subject, seed: u64) -> Self {
        Self { subject, seed }
    }

    fn stream(&self, kind: Kind) -> Stream {
        seed::stream(seed::derive(self.seed, &[kind.name()]))
    }

    /// Every configuration that is not on a path.
    pub fn questions(&self, sizes: &Sizes) -> Vec<Question> {
        let mut questions = self.random(sizes);
        questions.extend(self.near_contact(sizes.near_contact));
        questions.extend(self.singular(sizes.singular));
        questions.extend(self.piercing(sizes.piercing));
        if sizes.random > 0 {
            questions.extend(self.limits());
        }
        questions
    }

    fn random(&self, sizes: &Sizes) -> Vec<Question> {
        let mut stream = self.stream(Kind::Random);
        let one = |index: u32| Question {
            frames: index < sizes.random_frames,
            gaps: index < sizes.random_distances,
            ..question(Kind::Random, drawn(self.subject.model(), &mut stream))
        };
        (0..sizes.random).map(one).collect()
    }

    /// For each still thing and for the robot itself in turn, a configuration whose gap to it is a drawn one, half of
    /// them in contact; those for which none is found are left out.
    fn near_contact(&self, count: u32) -> Vec<Question> {
        let mut stream = self.stream(Kind::NearContact);
        let model = self.subject.model();
        let pairs = self.subject.pairs();
        let mut groups: Vec<Option<usize>> = (0..model.stills.len()).map(Some).collect();
        groups.extend((!model.self_pairs.is_empty()).then_some(None));
        let draws: Vec<Vec<f64>> = (0..count.max(1) * 4).map(|_| drawn(model, &mut stream)).collect();
        let gaps: Vec<Vec<f64>> = draws.iter().map(|q| self.subject.gaps_m(q)).collect();
        let least_in = |group| gaps.iter().map(|row| least_of(row, pairs, group)).collect::<Vec<f64>>();
        let leasts: Vec<Vec<f64>> = groups.iter().map(|group| least_in(*group)).collect();
        let own_pairs = |group: &Option<usize>| {
            pairs.iter().copied().filter(|pair| pair.still() == *group).collect::<Vec<Pair>>()
        };
        let own_pairs: Vec<Vec<Pair>> = groups.iter().map(own_pairs).collect();
        let mut found = Vec::new();
        for index in 0..count as usize {
            let own = &own_pairs[index % groups.len()];
            let known = &leasts[index % groups.len()];
            let size_m = NEAREST_M * libm::pow(NEAR_M / NEAREST_M, stream.random::<f64>());
            let target_m = if stream.random::<bool>() { size_m } else { -size_m };
            let side = |is_inside: bool| {
                let fits = |i: &usize| (known[*i] < target_m) == is_inside;
                (0..draws.len()).filter(fits).collect::<Vec<_>>()
            };
            let (inside, outside) = (side(true), side(false));
            if inside.is_empty() || outside.is_empty() {
                continue;
            }
            let ends =
                [&outside, &inside].map(|all| draws[all[stream.random_range(0..all.len())]].as_slice());
            let gap_m = |q: &[f64]| self.subject.gaps_of_m(q, own).into_iter().fold(f64::INFINITY, f64::min);
            let q = crossing(ends, |q| gap_m(q) - target_m);
            if (gap_m(&q) - target_m).abs() < NEAREST_M / 4.0 {
                found.push(Question { gaps: true, frames: true, ..question(Kind::NearContact, q) });
            }
        }
        found
    }

    /// Where the Jacobian's determinant changes sign on a straight joint line.
    fn singular(&self, count: u32) -> Vec<Question> {
        let mut stream = self.stream(Kind::Singular);
        let mut found = Vec::new();
        for _ in 0..count * DRAWS {
            if found.len() >= count as usize {
                break;
            }
            let ends = [0, 1].map(|_| drawn(self.subject.model(), &mut stream));
            let [a, b] = [&ends[0], &ends[1]].map(|q| self.subject.determinant(q));
            if a * b >= 0.0 {
                continue;
            }
            let sign = a.signum();
            let value = |q: &[f64]| self.subject.determinant(q) * sign;
            let q = crossing([&ends[0], &ends[1]], value);
            found.push(Question { gaps: true, frames: true, ..question(Kind::Singular, q) });
        }
        found
    }

    fn piercing(&self, count: u32) -> Vec<Question> {
        let mut stream = self.stream(Kind::Piercing);
        let draws = (0..count * DRAWS).map(|_| drawn(self.subject.model(), &mut stream));
        let piercing = draws.filter(|q| self.subject.pierces(q)).take(count as usize);
        piercing.map(|q| question(Kind::Piercing, q)).collect()
    }

    /// Each joint just inside, just outside and well outside each of its limits, the others drawn.
    fn limits(&self) -> Vec<Question> {
        let mut stream = self.stream(Kind::Limit);
        let model = self.subject.model();
        let mut questions = Vec::new();
        if self.subject.is_beyond(0, 0.0).is_none() {
            return questions;
        }
        for joint in 0..model.rows.len() {
            let [low, high] = model.rows[joint].limits_rad;
            let [near, far] = BEYOND_RAD;
            for angle in [low + near, low - near, low - far, high - near, high + near, high + far] {
                let mut q = drawn(model, &mut stream);
                q[joint] = angle;
                questions.push(Question { limits: true, ..question(Kind::Limit, q) });
            }
        }
        questions
    }
}

/// The least of `gaps_m` among the pairs of one still thing, or of the robot with itself.
pub fn least_of(gaps_m: &[f64], pairs: &[Pair], group: Option<usize>) -> f64 {
    let own = gaps_m.iter().zip(pairs).filter(|(_, pair)| pair.still() == group);
    own.map(|(gap, _)| *gap).fold(f64::INFINITY, f64::min)
}

/// Where `value`, not negative at the first end and negative at the second, changes sign on the line between them.
fn crossing(ends: [&[f64]; 2], value: impl Fn(&[f64]) -> f64) -> Vec<f64> {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if value(&mixed(ends[0], ends[1], middle)) >= 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    mixed(ends[0], ends[1], low)
}
