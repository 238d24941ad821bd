//! Tables of our own results: rows of contenders, blocks of problems, cells of metrics.

use super::Paper;
use crate::checked::labels_of;
use base::settings::{Faults, Spanned, none_called};
use schemars::JsonSchema;
use serde::Deserialize;

/// A table of results.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ResultsSpec {
    /// Its file name.
    pub id: Spanned<String>,
    /// What it shows.
    pub caption: String,
    /// The study whose records it shows.
    pub study: Spanned<String>,
    /// One row each: labels of contenders, or of what else stands in their place.
    pub rows: Vec<String>,
    /// What each row shows of every block.
    pub cells: Vec<CellSpec>,
    /// Blocks of rows, one below the other.
    #[serde(rename = "block")]
    pub blocks: Vec<BlockSpec>,
}

/// A block: all rows on one group of problems.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BlockSpec {
    /// Its heading.
    pub title: String,
    /// The problem group.
    pub problems: Spanned<String>,
    /// Another problem group, shown by the cells that are `beside`.
    pub beside: Option<Spanned<String>>,
}

/// One column.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CellSpec {
    /// The metric, by its name in the registry or in an interpretation.
    pub metric: Spanned<String>,
    /// What is shown of it.
    pub show: Show,
    /// The row that a `ratio` is to.
    pub against: Option<Spanned<String>>,
    /// Its head, if the metric's own title does not say it.
    pub label: Option<String>,
    /// How many decimals it is shown with.
    #[schemars(range(max = 15))]
    pub decimals: usize,
    /// Whether it is of the block's other problem group.
    #[serde(default)]
    pub beside: bool,
}

/// What is shown of a metric over the trials of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Show {
    /// The median, failed trials counted as infinite.
    Median,
    /// The median and, with several trials, both quartiles, failed trials counted as infinite.
    Quartiles,
    /// The median in each stored session of the clock, in their order, failed trials counted as infinite.
    Sessions,
    /// The mean over solved trials, in percent: of a metric that is 0 or 1.
    Percent,
    /// The ratio of its mean to that of the row `against`, in percent, over the problems that both solve.
    Ratio,
    /// The share of trials that were solved, in percent.
    Solved,
    /// The share of trials whose path the verifier refused, in percent.
    Refused,
    /// The share of trials that ended without a path and had nothing left to try, in percent.
    NoPath,
    /// The share of trials that spent their budget, in percent.
    Spent,
    /// The median over trials that were not solved.
    Failed,
    /// The value of the first trial that has one, whatever its status.
    Value,
    /// The median over what the problems prepared before any query (a roadmap), counted once for all of its queries. Only for
    /// contenders that search it: those from outside do not.
    Preprocessing,
}

impl Paper {
    /// Every study and problem group that a table of results names exists.
    pub(super) fn check_results(&self, faults: &mut Faults) {
        for table in &self.results {
            let Some(study) = self.study(table.study.get_ref()) else {
                let known = self.studies.iter().map(|study| study.name.as_str());
                let message = none_called("study", table.study.get_ref(), known);
                faults.add(self.document.error(table.study.span(), message).about(table.study.get_ref()));
                continue;
            };
            for named in
                table.blocks.iter().flat_map(|block| std::iter::once(&block.problems).chain(&block.beside))
            {
                if !study.groups.iter().any(|group| group.label == *named.get_ref()) {
                    let known: Vec<&str> = study.groups.iter().map(|group| group.label.as_str()).collect();
                    let message = format!(
                        "study `{}` has no problem group `{}`; it has {}",
                        study.name,
                        named.get_ref(),
                        known.join(", ")
                    );
                    let fault = self.document.error(named.span(), message);
                    faults.add(fault.about(named.get_ref()).about(&labels_of(&study.name)));
                }
            }
            for cell in &table.cells {
                let is_ratio = cell.show == Show::Ratio;
                match &cell.against {
                    Some(base) if !is_ratio => {
                        let message = "only a `ratio` is to another row; take `against` away, or show a `ratio`";
                        faults.add(self.document.error(base.span(), message));
                    }
                    Some(base) if !study.labels().contains(base.get_ref()) => {
                        let labels = study.labels();
                        let message =
                            none_called("contender", base.get_ref(), labels.iter().map(String::as_str));
                        let fault = self.document.error(base.span(), message);
                        faults.add(fault.about(base.get_ref()).about(&labels_of(&study.name)));
                    }
                    None if is_ratio => {
                        let message = "a `ratio` is to another row; name it under `against`";
                        faults.add(self.document.error(cell.metric.span(), message));
                    }
                    _ => {}
                }
            }
        }
    }
}
