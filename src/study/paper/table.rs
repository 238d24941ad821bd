//! A paper's tables as its `paper.toml` writes them.

use serde::Deserialize;
use toml::Spanned;

/// One of the paper's tables, to be set beside ours.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TableSpec {
    /// Its file name.
    pub id: String,
    /// What it shows.
    pub caption: String,
    /// The heads of its columns.
    pub columns: Vec<String>,
    /// Its rows: claims, printed beside ours.
    #[serde(default, rename = "row")]
    pub rows: Vec<TableRow>,
    /// What is measured, where the printed numbers are lost: one line a problem group and contender.
    pub measured: Option<Measured>,
}

/// What fills a table of measurements; the columns are the share of trials solved and the metrics.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Measured {
    /// The study.
    pub study: Spanned<String>,
    /// Its problem groups.
    pub problems: Vec<String>,
    /// Its contenders.
    pub contenders: Vec<String>,
    /// The metrics, averaged over solved trials.
    pub metrics: Vec<String>,
}

/// A row of a table.
#[derive(Debug, Clone, Deserialize)]
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
}
