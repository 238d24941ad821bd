//! Whether one contender's mean share of solved queries is above another's all along a sweep.

use super::{Check, Entry};
use crate::analysis::draws::solved_percents;
use crate::analysis::evidence::Evidence;
use crate::analysis::verdict::{Estimate, Finding, Verdict};
use crate::study::Study;
use crate::study::name::sweep;
use base::seed;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use stats::bands::sup_t;
use stats::bootstrap::Resampling;
use stats::interval::Interval;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "mean_curve_above",
    about: "is one contender's mean share of solved queries above another's at every point of the sweep, draws paired?",
    settings: Accepted::of::<Settings>(),
    example: r#"
study = "success"
problems = "cell"
contender = "Improved A*"
against = "Original A*"
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let contenders = [settings.contender.as_str(), settings.against.as_str()];
        let study = context.study(&settings.study, std::slice::from_ref(&settings.problems), &contenders)?;
        let seed = seed::derive(0, &[&context.paper.id, &context.claim.id]);
        Ok(Box::new(MeanCurveAbove { settings, study, seed }))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The study whose records are looked at.
    study: String,
    /// The problem group, by its label.
    problems: String,
    /// The contender, by its label.
    contender: String,
    /// The contender that it is held against, by its label.
    against: String,
}

struct MeanCurveAbove<'a> {
    settings: Settings,
    study: &'a Study,
    seed: u64,
}

fn verdict(band: &[Interval]) -> Verdict {
    if band.iter().all(|b| b.low > 0.0) {
        Verdict::Reproduced
    } else if band.iter().any(|b| b.high < 0.0) {
        Verdict::NotReproduced
    } else if band.iter().any(|b| b.low > 0.0) {
        Verdict::DirectionOnly
    } else {
        Verdict::Undecided
    }
}

impl Check for MeanCurveAbove<'_> {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let Settings { study, problems, contender, against } = &self.settings;
        let mut finding = Finding::of(ENTRY.name);
        let Some(run) = evidence.run(study) else { return finding };
        let points = self.study.sweep_points();
        let shares = |who: &str| -> Vec<Vec<f64>> {
            points.iter().map(|point| solved_percents(run, problems, who, &point.key)).collect()
        };
        let (own, other) = (shares(contender), shares(against));
        let draws = own.iter().chain(&other).map(Vec::len).min().unwrap_or(0);
        let curve = |draw: usize| own.iter().zip(&other).map(|(a, b)| a[draw] - b[draw]).collect();
        let curves: Vec<Vec<f64>> = (0..draws).map(curve).collect();
        let Some(found) = sup_t(&curves, Resampling { resamples: 2000, level: 0.95, seed: self.seed }) else {
            return finding.undecided(format!("{draws} draws; at least 2 are needed"));
        };
        finding.verdict = Some(verdict(&found.band));
        let mut order: Vec<usize> = (0..points.len()).collect();
        order.sort_by(|a, b| found.mean[*a].total_cmp(&found.mean[*b]));
        let [least, most] = [order[0], order[order.len() - 1]];
        let what = format!(
            "least mean difference in points, at {}, simultaneous 95 % band",
            sweep(&points[least].key)
        );
        finding.ours = Some(Estimate::new(found.mean[least], found.band[least], what, draws));
        finding.because.push(format!(
            "{contender} less {against} on {problems}: the mean share of solved queries differs by {:.1} points (band {:.1} to {:.1}) \
             at {} and by {:.1} at {}; the simultaneous band over {draws} draws is above 0 at {} of {} points",
            found.mean[least],
            found.band[least].low,
            found.band[least].high,
            sweep(&points[least].key),
            found.mean[most],
            sweep(&points[most].key),
            found.band.iter().filter(|b| b.low > 0.0).count(),
            points.len()
        ));
        finding.say_what_settles(&[0.0], "draws");
        finding
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_is_above_only_where_its_whole_band_is() {
        let band = |ends: &[(f64, f64)]| ends.iter().map(|(a, b)| Interval::new(*a, *b)).collect::<Vec<_>>();
        assert_eq!(verdict(&band(&[(1.0, 2.0), (0.5, 3.0)])), Verdict::Reproduced);
        assert_eq!(verdict(&band(&[(1.0, 2.0), (0.0, 0.0)])), Verdict::DirectionOnly);
        assert_eq!(verdict(&band(&[(-1.0, 2.0), (-1.0, 0.5)])), Verdict::Undecided);
        assert_eq!(verdict(&band(&[(1.0, 2.0), (-2.0, -1.0)])), Verdict::NotReproduced);
    }
}
