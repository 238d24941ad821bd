//! What follows from neighbourhoods alone: a search over more steps that returns a shortest path is never longer.

use base::settings::SettingsError;
use engine::planner::Planner;
use std::collections::BTreeSet;
use study::{Interpretation, Study};

/// What the sets of steps of two contenders say about their path lengths on one problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Inclusion {
    /// The first one's steps include the other's and it returns shortest paths: it is never longer.
    NeverLonger,
    /// The other's steps include the first one's and the other returns shortest paths: the first is never shorter.
    NeverShorter,
    /// Both: they are equally long.
    Equal,
    /// Neither: lengths may differ either way.
    Open,
}

impl Inclusion {
    /// What holds between `contender` and `other` of `study` under the interpretation `point`.
    ///
    /// # Errors
    /// A settings error of a planner.
    pub fn in_study(
        study: &Study,
        point: &Interpretation,
        contender: &str,
        other: &str,
    ) -> Result<Self, SettingsError> {
        let point = point.for_trials(&study.choices);
        let sweep = study.contender_points().swap_remove(0);
        let planner = |label: &str| -> Result<Option<Box<dyn Planner>>, SettingsError> {
            let found = study.contenders.iter().find(|contender| contender.label == label);
            let built = found.map(|contender| contender.pipeline(&point, &sweep));
            Ok(built.transpose()?.filter(|built| built.stages.is_empty()).map(|built| built.planner))
        };
        let (Some(one), Some(two)) = (planner(contender)?, planner(other)?) else { return Ok(Self::Open) };
        Ok(Self::between(one.as_ref(), two.as_ref()))
    }

    fn between(one: &dyn Planner, two: &dyn Planner) -> Self {
        let steps = |planner: &dyn Planner| planner.steps().map(|all| all.iter().copied().collect());
        let both: Option<(BTreeSet<[i32; 2]>, BTreeSet<[i32; 2]>)> = steps(one).zip(steps(two));
        let Some((first, second)) = both else { return Self::Open };
        let never_longer = one.is_optimal() && first.is_superset(&second);
        let never_shorter = two.is_optimal() && second.is_superset(&first);
        match (never_longer, never_shorter) {
            (true, true) => Self::Equal,
            (true, false) => Self::NeverLonger,
            (false, true) => Self::NeverShorter,
            (false, false) => Self::Open,
        }
    }

    /// Whether the lengths of the first and of the other keep to it, up to rounding.
    pub fn is_kept(self, one: &[f64], other: &[f64]) -> bool {
        let least = |values: &[f64]| values.iter().copied().fold(f64::INFINITY, f64::min);
        let is_at_most = |a: f64, b: f64| a <= b * (1.0 + 1e-9);
        let longer = one.iter().all(|value| is_at_most(*value, least(other)));
        let shorter = other.iter().all(|value| is_at_most(*value, least(one)));
        match self {
            Self::NeverLonger => longer,
            Self::NeverShorter => shorter,
            Self::Equal => longer && shorter,
            Self::Open => true,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use base::settings::Settings;
    use engine::planner::{self, Build};

    fn astar(shape: &str, radius: u8, open_node: &str) -> Box<dyn Planner> {
        let text = format!(
            "neighbourhood = {{ shape = '{shape}', radius_cells = {radius} }}\nopen_node = '{open_node}'\nties = 'fifo'"
        );
        let Build::Planner(build) = planner::find("lattice_astar").unwrap().build else { unreachable!() };
        build(&Settings::composed("a test", toml::from_str(&text).unwrap())).unwrap()
    }

    #[test]
    fn a_wider_search_is_never_longer_and_one_that_is_not_shortest_says_nothing() {
        for (one, two, expected) in [
            (("disc", 6), ("square", 4), Inclusion::NeverLonger),
            (("disc", 4), ("square", 3), Inclusion::Open),
            (("disc", 2), ("square", 2), Inclusion::NeverShorter),
            (("square", 2), ("square", 2), Inclusion::Equal),
        ] {
            let planners = [one, two].map(|(shape, radius)| astar(shape, radius, "lowered"));
            let found = Inclusion::between(planners[0].as_ref(), planners[1].as_ref());
            assert_eq!(found, expected, "{one:?} and {two:?}");
        }
        let wide = astar("disc", 6, "never");
        let never = astar("square", 4, "never");
        assert_eq!(Inclusion::between(wide.as_ref(), never.as_ref()), Inclusion::Open);
    }

    #[test]
    fn lengths_that_break_the_theorem_are_seen() {
        assert!(Inclusion::NeverLonger.is_kept(&[68.0], &[68.0, 70.0, f64::INFINITY]));
        assert!(!Inclusion::NeverLonger.is_kept(&[69.0], &[68.0, 70.0]));
        assert!(!Inclusion::NeverShorter.is_kept(&[67.0], &[68.0]));
        assert!(!Inclusion::Equal.is_kept(&[67.0], &[68.0]) && Inclusion::Open.is_kept(&[67.0], &[68.0]));
    }
}
