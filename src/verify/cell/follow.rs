//! One leg of a path, followed at a quarter of the planner's step.
//!
//! The time law of every leg is rest to rest with `LAW`: it lets paths be compared, the paper prints none.

use super::chain::{Frames, tip};
use super::{Angles, Case, FINER, LegEnd};
use nalgebra::{Matrix3, Quaternion, Vector3};
use std::f64::consts::TAU;

/// The tool's greatest speed and acceleration, m/s and m/s², under which joint accelerations are compared.
pub const LAW: [f64; 2] = [0.5, 1.0];

/// The time between two stops of a trajectory.
pub const STOP_S: f64 = 0.04;

/// How often a step of ours is halved where Newton's method fails: down to a 64th, 0.08 mm of a planner's step of 20 mm.
const HALVINGS: u32 = 6;

/// How far joints may be from where they should arrive.
const SAME_RAD: f64 = 1e-5;

/// What a leg amounts to.
#[derive(Debug, Clone, PartialEq)]
pub struct Leg {
    /// The way of the tool's tip.
    pub length_m: f64,
    /// The sum of all joints' changes.
    pub travel_rad: f64,
    /// The greatest acceleration of a joint under `LAW`.
    pub peak_rad_s2: f64,
    /// How long it takes under `LAW`.
    pub duration_s: f64,
    /// The configuration in which the arm arrives.
    pub end: Angles,
    /// Where the arm is every `STOP_S`, both ends included.
    pub stops: Vec<Stop>,
}

/// Where the arm is at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// The time since the start.
    pub time_s: f64,
    /// The joints.
    pub q: Angles,
    /// The tool's tip.
    pub tool_m: [f64; 3],
}

/// Poses along a leg, and what the leg is measured by.
struct Ends {
    from: (Quaternion<f64>, Vector3<f64>),
    to: (Quaternion<f64>, Vector3<f64>),
    /// Half the angle of the turn.
    half_rad: f64,
}

impl Ends {
    fn new(from: &(Matrix3<f64>, Vector3<f64>), to: &(Matrix3<f64>, Vector3<f64>)) -> Self {
        let (a, mut b) = (quaternion(&from.0), quaternion(&to.0));
        if a.dot(&b) < 0.0 {
            b = -b;
        }
        // Half the chord between unit quaternions is the sine of half the arc between them.
        let half_rad = 2.0 * libm::asin(((a - b).norm() / 2.0).min(1.0));
        Self { from: (a, from.1), to: (b, to.1), half_rad }
    }

    fn at(&self, share: f64) -> (Matrix3<f64>, Vector3<f64>) {
        let sine = libm::sin(self.half_rad);
        let weight = |t: f64| if sine < 1e-9 { t } else { libm::sin(t * self.half_rad) / sine };
        let mixed = self.from.0 * weight(1.0 - share) + self.to.0 * weight(share);
        (matrix(&(mixed / mixed.norm())), self.from.1 * (1.0 - share) + self.to.1 * share)
    }
}

/// The leg from the configuration that the arm is in to the next one of the path.
pub(super) fn leg(case: &Case, from: &Angles, to: &Angles) -> Result<Leg, String> {
    let chain = &case.chain;
    let rules = &case.rules;
    let ends = Ends::new(&chain.tool(from), &chain.tool(to));
    let length_m = (ends.to.1 - ends.from.1).norm();
    let turn_rad = 2.0 * ends.half_rad;
    // Where the joints go straight, one that turns without end takes the shorter way round.
    let goal: Angles = std::array::from_fn(|i| {
        if chain.rows()[i].is_endless() { to[i] - TAU * ((to[i] - from[i]) / TAU).round() } else { to[i] }
    });
    let widest = from.iter().zip(&goal).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let steps = if rules.straight_joints {
        widest / rules.step_rad
    } else {
        (length_m / rules.step_m).max(turn_rad / rules.step_rad)
    };
    // What differs by rounding only must not fall on two sides of a whole number.
    let steps = (steps - 1e-9).ceil().max(1.0) as u32 * FINER;
    let mut states = vec![*from];
    let mut places = vec![ends.from.1];
    let mut frames = chain.frames(from);
    for step in 1..=steps {
        let share = f64::from(step) / f64::from(steps);
        let last = &states[states.len() - 1];
        let q = if rules.straight_joints {
            let q = std::array::from_fn(|i| from[i] + (goal[i] - from[i]) * share);
            chain.write_frames(&q, &mut frames);
            q
        } else {
            let found = chain.near(&guess(&states), &ends.at(share), &mut frames);
            let before = f64::from(step - 1) / f64::from(steps);
            found
                .filter(|q| widest_change(q, last) < rules.jump_rad)
                .or_else(|| creep(case, &ends, last, [before, share], HALVINGS, &mut frames))
                .ok_or_else(|| format!("the joints cannot follow the line at {:.1} %", share * 100.0))?
        };
        if let Some(refusal) = case.obstacles.refusal(chain, &q, &frames) {
            return Err(format!("{refusal} at {:.1} % of the way", share * 100.0));
        }
        states.push(q);
        places.push(tip(&frames));
    }
    refuse_motion(case, &states, length_m.max(turn_rad / rules.step_rad * rules.step_m))?;
    refuse_end(case, states.last().expect("a leg has two ends"), to)?;
    Ok(measure(case, &states, &places, [length_m, turn_rad]))
}

/// The joints at the second share of the way, from `last` at the first: in one step or, where Newton's method does not find them
/// or finds some too far away, in two halves. So it is beside a singularity, where a joint turns quickly on a short way.
fn creep(
    case: &Case,
    ends: &Ends,
    last: &Angles,
    [before, share]: [f64; 2],
    halvings: u32,
    frames: &mut Frames,
) -> Option<Angles> {
    let found = case.chain.near(last, &ends.at(share), frames);
    let found = found.filter(|q| widest_change(q, last) < case.rules.jump_rad);
    if found.is_some() || halvings == 0 {
        return found;
    }
    let middle = 0.5 * (before + share);
    let halfway = creep(case, ends, last, [before, middle], halvings - 1, frames)?;
    creep(case, ends, &halfway, [middle, share], halvings - 1, frames)
}

/// Where the joints go if they go on as before.
fn guess(states: &[Angles]) -> Angles {
    match states {
        [.., a, b] => std::array::from_fn(|i| 2.0 * b[i] - a[i]),
        _ => states[0],
    }
}

fn widest_change(a: &Angles, b: &Angles) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Refuses a jump between the planner's stops, and a joint that is too fast while the tool goes straight. Where joints go
/// straight, they set the pace themselves, and neither limit says anything of the path.
fn refuse_motion(case: &Case, states: &[Angles], law_m: f64) -> Result<(), String> {
    let rules = &case.rules;
    if rules.straight_joints {
        return Ok(());
    }
    let stops: Vec<&Angles> = states.iter().step_by(FINER as usize).collect();
    let count = (stops.len() - 1) as f64;
    for (index, pair) in stops.windows(2).enumerate() {
        let change = widest_change(pair[0], pair[1]);
        if change > rules.jump_rad + 1e-6 {
            return Err(format!("a joint jumps by {:.1}° in one step", change.to_degrees()));
        }
        let Some(law) = rules.speed else { continue };
        let time = |step: usize| time_s(step as f64 / count * law_m, law_m, law);
        let duration_s = time(index + 1) - time(index);
        let too_fast = (0..6).find(|&i| {
            (pair[1][i] - pair[0][i]).abs() > case.chain.rows()[i].speed_rad_s * duration_s * (1.0 + 1e-6)
        });
        if let Some(joint) = too_fast {
            return Err(format!("joint {} is faster than it can be", joint + 1));
        }
    }
    Ok(())
}

fn refuse_end(case: &Case, arrived: &Angles, wanted: &Angles) -> Result<(), String> {
    for i in 0..6 {
        let gap = arrived[i] - wanted[i];
        let turns = (gap / TAU).round() * TAU;
        let left = match case.rules.end {
            LegEnd::Own | LegEnd::WholeTurns if case.chain.rows()[i].is_endless() => gap - turns,
            LegEnd::WholeTurns if i != 3 && i != 5 => gap,
            LegEnd::Own => gap,
            LegEnd::WholeTurns => gap - turns,
            LegEnd::PoseOnly => 0.0,
        };
        if left.abs() > SAME_RAD {
            return Err(format!(
                "joint {} arrives {:.3}° from where the path says",
                i + 1,
                left.to_degrees()
            ));
        }
    }
    Ok(())
}

fn measure(case: &Case, states: &[Angles], places: &[Vector3<f64>], [length_m, turn_rad]: [f64; 2]) -> Leg {
    // A turn without a way takes as long as the way that counts as much as it in the planner's step.
    let law_m = length_m.max(turn_rad / case.rules.step_rad * case.rules.step_m).max(1e-9);
    let count = (states.len() - 1) as f64;
    let travel_rad =
        states.windows(2).map(|w| w[0].iter().zip(&w[1]).map(|(a, b)| (a - b).abs()).sum::<f64>());
    let step_m = law_m / count;
    let mut peak_rad_s2 = 0.0_f64;
    for (index, w) in states.windows(3).enumerate() {
        let (speed2, push) = speed2_and_push((index + 1) as f64 * step_m, law_m);
        for ((before, at), after) in w[0].iter().zip(&w[1]).zip(&w[2]) {
            let slope = (after - before) / (2.0 * step_m);
            let bend = (after - 2.0 * at + before) / (step_m * step_m);
            peak_rad_s2 = peak_rad_s2.max((bend * speed2 + slope * push).abs());
        }
    }
    Leg {
        length_m: places.windows(2).map(|w| (w[0] - w[1]).norm()).sum(),
        travel_rad: travel_rad.sum(),
        peak_rad_s2,
        duration_s: time_s(law_m, law_m, LAW),
        end: states[states.len() - 1],
        stops: stops(case, states, law_m),
    }
}

/// Where the arm is at even times from the leg's start on, and at its end; joints go straight between two states.
fn stops(case: &Case, states: &[Angles], law_m: f64) -> Vec<Stop> {
    let duration_s = time_s(law_m, law_m, LAW);
    let last = states.len() - 1;
    let count = (duration_s / STOP_S - 1e-9).ceil().max(1.0) as u32;
    let stop = |index: u32| {
        let time_s = (f64::from(index) * STOP_S).min(duration_s);
        let at = (way_m(time_s, law_m, LAW) / law_m * last as f64).clamp(0.0, last as f64);
        let before = at.floor() as usize;
        let share = at.fract();
        let (a, b) = (&states[before], &states[(before + 1).min(last)]);
        let q = std::array::from_fn(|i| a[i] + (b[i] - a[i]) * share);
        Stop { time_s, q, tool_m: case.chain.tool(&q).1.into() }
    };
    (0..=count).map(stop).collect()
}

/// How far a tool that starts and ends at rest has gone of `length_m` at a time: [`time_s`] the other way round.
fn way_m(time_s: f64, length_m: f64, [speed, acceleration]: [f64; 2]) -> f64 {
    let whole_s = self::time_s(length_m, length_m, [speed, acceleration]);
    let ramp_s = (speed / acceleration).min((length_m / acceleration).sqrt());
    let from_rest = |time_s: f64| acceleration * time_s * time_s / 2.0;
    if time_s < ramp_s {
        from_rest(time_s)
    } else if time_s <= whole_s - ramp_s {
        from_rest(ramp_s) + acceleration * ramp_s * (time_s - ramp_s)
    } else {
        length_m - from_rest(whole_s - time_s)
    }
}

/// When a tool that starts and ends at rest has gone `way_m` of `length_m`.
fn time_s(way_m: f64, length_m: f64, [speed, acceleration]: [f64; 2]) -> f64 {
    let ramp_m = (speed * speed / (2.0 * acceleration)).min(length_m / 2.0);
    let ramp_s = (2.0 * ramp_m / acceleration).sqrt();
    let top = acceleration * ramp_s;
    let whole_s = 2.0 * ramp_s + (length_m - 2.0 * ramp_m) / top;
    if way_m < ramp_m {
        (2.0 * way_m / acceleration).sqrt()
    } else if way_m <= length_m - ramp_m {
        ramp_s + (way_m - ramp_m) / top
    } else {
        whole_s - (2.0 * (length_m - way_m).max(0.0) / acceleration).sqrt()
    }
}

/// The square of the tool's speed and its acceleration at `way_m` under `LAW`.
fn speed2_and_push(way_m: f64, length_m: f64) -> (f64, f64) {
    let [speed, acceleration] = LAW;
    let from_rest = 2.0 * acceleration * way_m.min(length_m - way_m);
    if from_rest >= speed * speed {
        (speed * speed, 0.0)
    } else if way_m < length_m / 2.0 {
        (from_rest, acceleration)
    } else {
        (from_rest, -acceleration)
    }
}

/// The unit quaternion of a rotation, by the largest of its four squares.
fn quaternion(r: &Matrix3<f64>) -> Quaternion<f64> {
    let trace = r.trace();
    let squares = [
        1.0 + trace,
        1.0 + 2.0 * r[(0, 0)] - trace,
        1.0 + 2.0 * r[(1, 1)] - trace,
        1.0 + 2.0 * r[(2, 2)] - trace,
    ];
    let largest = (0..4).max_by(|a, b| squares[*a].total_cmp(&squares[*b])).unwrap_or(0);
    let twice = squares[largest].sqrt();
    let scale = 0.5 / twice;
    let half = twice / 2.0;
    let skew = |i: usize, j: usize| (r[(j, i)] - r[(i, j)]) * scale;
    let even = |i: usize, j: usize| (r[(j, i)] + r[(i, j)]) * scale;
    match largest {
        0 => Quaternion::new(half, skew(1, 2), skew(2, 0), skew(0, 1)),
        1 => Quaternion::new(skew(1, 2), half, even(0, 1), even(0, 2)),
        2 => Quaternion::new(skew(2, 0), even(0, 1), half, even(1, 2)),
        _ => Quaternion::new(skew(0, 1), even(0, 2), even(1, 2), half),
    }
}

fn matrix(q: &Quaternion<f64>) -> Matrix3<f64> {
    let (w, x, y, z) = (q.w, q.i, q.j, q.k);
    Matrix3::new(
        1.0 - 2.0 * (y * y + z * z),
        2.0 * (x * y - w * z),
        2.0 * (x * z + w * y),
        2.0 * (x * y + w * z),
        1.0 - 2.0 * (x * x + z * z),
        2.0 * (y * z - w * x),
        2.0 * (x * z - w * y),
        2.0 * (y * z + w * x),
        1.0 - 2.0 * (x * x + y * y),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn way_and_time_are_each_others_inverse_on_legs_of_any_length() {
        for length_m in [0.02, 0.25, 1.3] {
            for step in 0..=50 {
                let way = length_m * f64::from(step) / 50.0;
                let back = way_m(time_s(way, length_m, LAW), length_m, LAW);
                assert!((back - way).abs() < 1e-12, "{length_m} m: {way} becomes {back}");
            }
        }
    }
}
