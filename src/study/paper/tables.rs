//! The paper's own tables as they are asked for beside ours.

use base::settings::Spanned;
use schemars::JsonSchema;
use serde::Deserialize;

/// One of the paper's tables, to be set beside ours.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TableSpec {
    /// Its file name.
    pub id: String,
    /// What it shows.
    pub caption: String,
    /// The heads of its columns.
    pub columns: Vec<String>,
    /// What stands below it.
    #[serde(default)]
    pub notes: Vec<String>,
    /// With how many decimals our numbers are shown; two if absent.
    #[schemars(range(max = 15))]
    pub decimals: Option<usize>,
    /// Its rows.
    #[serde(rename = "row")]
    pub rows: Vec<TableRow>,
    /// Claims about several of its cells together, which are noted below it where they are impossible.
    #[serde(default)]
    pub jointly: Vec<JointlySpec>,
    /// One problem of ours whose trials stand beside the printed rows; without it, each cell takes its own claim's.
    pub ours: Option<OursSpec>,
}

/// A claim about several cells of a table together.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointlySpec {
    /// The claim.
    pub claim: Spanned<String>,
    /// The claims of the cells.
    pub cells: Vec<Spanned<String>>,
}

/// The problem that a table's own rows are from.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OursSpec {
    /// The study.
    pub study: Spanned<String>,
    /// The problem group; its first draw is shown.
    pub problems: String,
    /// The metric in each column, as readings name them.
    pub metrics: Vec<String>,
    /// What a reader must know about this problem.
    pub note: String,
}

/// A row of a table.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TableRow {
    /// Its head.
    pub label: String,
    /// The claim in each column.
    #[serde(default)]
    pub claims: Vec<Spanned<String>>,
    /// What stands in each column where the table holds no claims.
    #[serde(default)]
    pub cells: Vec<String>,
    /// The contender whose trial is shown.
    pub contender: Option<String>,
    /// The contender that its reduction in per cent is from, where the row prints reductions.
    pub reduced_from: Option<String>,
}
