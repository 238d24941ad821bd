//! Paths as the judge is asked about them: every configuration at a quarter of our step.

use super::model::Pair;
use super::sample::{Kind, Question, drawn};
use super::subject::Subject;
use base::seed;

/// Into how many parts each step of a stored path is cut.
pub const FINER: u32 = 4;
/// The step of a path that is drawn for want of a stored one: the largest change of a joint.
const DRAWN_STEP_RAD: f64 = 0.02;
/// Draws per wanted path.
const DRAWS: u32 = 200;
/// How deep a pushed path must be in contact.
const PUSH_M: f64 = 2e-3;
/// The step by which it is pushed, the most steps, and how many configurations either side come along.
const PUSH_STEP_RAD: f64 = 0.01;
const PUSHES: u32 = 400;
const PUSH_REACH: usize = 12;

/// A path by name, at our own steps.
#[derive(Debug, Clone, PartialEq)]
pub struct Path {
    /// The trial it is of, or that it was drawn.
    pub name: String,
    /// Its configurations.
    pub stops_rad: Vec<Vec<f64>>,
}

impl Path {
    /// The path with each step cut in [`FINER`] parts.
    ///
    /// # Errors
    /// The number of the step that cannot be followed.
    pub fn finer(&self, subject: &dyn Subject) -> Result<Self, String> {
        let mut stops_rad = vec![self.stops_rad[0].clone()];
        for (step, pair) in self.stops_rad.windows(2).enumerate() {
            if pair[0] == pair[1] {
                continue;
            }
            for part in 1..FINER {
                let share = f64::from(part) / f64::from(FINER);
                let q = subject
                    .between(&pair[0], &pair[1], share)
                    .ok_or_else(|| format!("step {} of path `{}` cannot be followed", step + 1, self.name))?;
                stops_rad.push(q);
            }
            stops_rad.push(pair[1].clone());
        }
        Ok(Self { name: self.name.clone(), stops_rad })
    }

    /// The questions about the path, which has this index.
    pub fn questions(&self, index: usize, kind: Kind) -> Vec<Question> {
        let one = |q: &Vec<f64>| Question {
            kind,
            path: index,
            q_rad: q.clone(),
            frames: false,
            gaps: false,
            limits: false,
        };
        self.stops_rad.iter().map(one).collect()
    }
}

fn least(subject: &dyn Subject, q: &[f64]) -> f64 {
    subject.gaps_m(q).into_iter().fold(f64::INFINITY, f64::min)
}

/// The least gap to something that stands still and the index of its pair; not below `-2 * PUSH_M`, since a depth may be
/// unknown.
fn nearest_still(subject: &dyn Subject, pairs: &[Pair], q: &[f64]) -> (f64, usize) {
    let gaps = subject.gaps_m(q).into_iter().enumerate();
    let outer = gaps.filter(|(pair, _)| pairs[*pair].still().is_some());
    let nearest = outer.min_by(|a, b| a.1.total_cmp(&b.1));
    nearest.map_or((f64::INFINITY, 0), |(pair, gap)| (gap.max(-2.0 * PUSH_M), pair))
}

/// Straight joint lines between drawn configurations that are free by our own code.
pub fn drawn_paths(subject: &dyn Subject, count: u32, seed: u64) -> Vec<Path> {
    let mut stream = seed::stream(seed::derive(seed, &["drawn paths"]));
    let mut paths: Vec<Path> = Vec::new();
    for _ in 0..count * DRAWS {
        if paths.len() >= count as usize {
            break;
        }
        let ends = [0, 1].map(|_| drawn(subject.model(), &mut stream));
        let widest = ends[0].iter().zip(&ends[1]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let steps = (widest / DRAWN_STEP_RAD).ceil().max(1.0) as u32;
        let at = |step: u32| {
            let share = f64::from(step) / f64::from(steps);
            ends[0].iter().zip(&ends[1]).map(|(a, b)| a + (b - a) * share).collect::<Vec<f64>>()
        };
        let stops_rad: Vec<Vec<f64>> = (0..=steps).map(at).collect();
        if stops_rad.iter().all(|q| least(subject, q) > 0.0) {
            paths.push(Path { name: format!("drawn {}", paths.len() + 1), stops_rad });
        }
    }
    paths
}

/// A free path that was pushed into something.
#[derive(Debug, Clone, PartialEq)]
pub struct Pushed {
    /// The path as pushed.
    pub path: Path,
    /// Which of its configurations is in contact now.
    pub stop: usize,
    /// The pair that is in contact there, by index.
    pub pair: usize,
}

/// `path`, which must be free, with the configuration that is nearest to an obstacle, and its neighbours less and less,
/// moved downhill in clearance until it is in contact; `None` if that does not succeed.
pub fn pushed(subject: &dyn Subject, path: &Path) -> Option<Pushed> {
    let pairs = subject.model().pairs();
    let gap_m = |q: &[f64]| nearest_still(subject, &pairs, q).0;
    if path.stops_rad.iter().any(|q| least(subject, q) <= 0.0) {
        return None;
    }
    let gaps: Vec<f64> = path.stops_rad.iter().map(|q| gap_m(q)).collect();
    let worst = (0..gaps.len()).min_by(|a, b| gaps[*a].total_cmp(&gaps[*b]))?;
    let start = &path.stops_rad[worst];
    let q = downhill(start, gap_m);
    let (reached_m, pair) = nearest_still(subject, &pairs, &q);
    if reached_m > -PUSH_M {
        return None;
    }
    let mut stops_rad = path.stops_rad.clone();
    for (index, stop) in stops_rad.iter_mut().enumerate() {
        let share = 1.0 - index.abs_diff(worst) as f64 / PUSH_REACH as f64;
        let weight = share.max(0.0);
        let angles = stop.iter_mut().zip(q.iter().zip(start));
        angles.for_each(|(angle, (to, from))| *angle += weight * (to - from));
    }
    Some(Pushed { path: Path { name: path.name.clone(), stops_rad }, stop: worst, pair })
}

/// Where steps from `start` against the slope of `gap_m` lead, until it is `-PUSH_M`.
fn downhill(start: &[f64], gap_m: impl Fn(&[f64]) -> f64) -> Vec<f64> {
    const PROBE_RAD: f64 = 1e-6;
    let mut q = start.to_vec();
    for _ in 0..PUSHES {
        let here = gap_m(&q);
        if here <= -PUSH_M {
            break;
        }
        let slope = |joint: usize| {
            let mut moved = q.clone();
            moved[joint] += PROBE_RAD;
            (gap_m(&moved) - here) / PROBE_RAD
        };
        let slopes: Vec<f64> = (0..q.len()).map(slope).collect();
        let steepness = slopes.iter().map(|s| s * s).sum::<f64>().sqrt();
        if steepness == 0.0 {
            break;
        }
        q.iter_mut().zip(&slopes).for_each(|(angle, slope)| *angle -= PUSH_STEP_RAD * slope / steepness);
    }
    q
}
