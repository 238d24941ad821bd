//! The timed passes of a run.

use super::{BuiltStudy, Progress, SESSION};
use crate::StudyError;
use crate::clock;
use crate::preprocessing::Preprocessing;
use crate::record::Timing;
use crate::spec::TimingSpec;
use crate::unit::{Entrant, Unit};
use engine::planner::Request;
use std::sync::atomic::{AtomicBool, Ordering};

/// How many times the clock's sample is gone through; each time takes its share of the repeats.
const PASSES: u32 = 4;

impl BuiltStudy<'_> {
    /// The timed passes: one thread, warmed up, with only the pipeline's call between two times.
    ///
    /// They time the first instances of every group under the first point, every contender and sweep. A machine that gets
    /// slower or faster meanwhile must not favour anyone: contenders take turns within each repeat, forwards and backwards,
    /// and the repeats are spread over several passes through the whole sample.
    ///
    /// # Errors
    /// [`StudyError::Interrupted`] if `stop` was set: half a sample would favour the first groups.
    pub fn time(
        &self,
        session: u32,
        stop: &AtomicBool,
        progress: &dyn Progress,
    ) -> Result<Vec<Timing>, StudyError> {
        let Some(timing) = self.study.timing else { return Ok(Vec::new()) };
        let total = self.units().len();
        let is_timed = |unit: &Unit<'_>| *unit.point == self.points[0] && unit.key.instance < timing.problems;
        let sample: Vec<(Unit<'_>, Preprocessing)> = self
            .units()
            .filter(is_timed)
            .filter_map(|unit| Some((unit.family.prepare(unit.seed).ok()?, unit)))
            .map(|(preprocessing, unit)| (unit, preprocessing))
            .collect();
        let passes = PASSES.min(timing.repeats);
        progress.begin(&format!("{}: clock", self.study.name), sample.len() * passes as usize);
        let mut timings = Vec::new();
        for pass in 0..passes {
            for (unit, preprocessing) in &sample {
                if stop.load(Ordering::Relaxed) {
                    progress.end();
                    let study = self.study.name.clone();
                    return Err(StudyError::Interrupted { study, kept: total, total });
                }
                let repeats: Vec<u32> = (pass..timing.repeats).step_by(passes as usize).collect();
                let of_unit = self.time_unit(unit, preprocessing, timing, &repeats);
                timings.extend(of_unit.into_iter().map(|own| Timing { session, ..own }));
                progress.step();
            }
        }
        progress.end();
        Ok(timings)
    }

    /// The timings of one unit's trials at these repeats.
    fn time_unit(
        &self,
        unit: &Unit<'_>,
        preprocessing: &Preprocessing,
        timing: TimingSpec,
        repeats: &[u32],
    ) -> Vec<Timing> {
        let mut timings = Vec::new();
        for query in &unit.queries() {
            let seeds = |entrant: &Entrant<'_>| entrant.contender.repeats.min(timing.seeds.unwrap_or(1));
            // What is recorded has clocks of its own.
            let repeated = unit.entrants.iter().copied().filter(|entrant| !entrant.contender.is_recorded());
            let of_entrant = |entrant| (0..seeds(entrant)).map(move |seed| (entrant, seed));
            let runs = repeated.flat_map(of_entrant);
            let request = |(entrant, seed): &(&Entrant<'_>, u32)| Request {
                world: &preprocessing.world,
                start: &query.start,
                goal: &query.goal,
                expansions: self.study.budget.expansions,
                seed: entrant.seed(&self.terms, &unit.problem(query), *seed),
                trace: false,
            };
            let warmed: Vec<_> = runs.filter(|run| run.0.pipeline.plan(&request(run)).is_ok()).collect();
            let mut read = |run: &(&Entrant<'_>, u32), repeat: u32| {
                let request = request(run);
                timings.push(Timing {
                    trial: unit.trial(query, run.0, run.1),
                    session: SESSION,
                    clock_repeat: repeat,
                    plan_wall_ns: clock::timed(|| run.0.pipeline.plan(&request)).0,
                });
            };
            for (turn, repeat) in repeats.iter().enumerate() {
                for place in in_turn(turn, warmed.len()) {
                    read(&warmed[place], *repeat);
                }
            }
        }
        timings
    }
}

/// The places of `count` contenders in the order of one repeat: forwards in one turn, backwards in the next.
fn in_turn(turn: usize, count: usize) -> impl Iterator<Item = usize> {
    (0..count).map(move |place| if turn.is_multiple_of(2) { place } else { count - 1 - place })
}
