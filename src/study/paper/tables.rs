//! The paper's own tables, redrawn with ours beside them.

use super::Paper;
use crate::settings::SettingsError;
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
    /// What stands below it; the paper's notes if absent.
    pub notes: Option<Vec<String>>,
    /// With how many decimals our numbers are shown; two if absent.
    pub decimals: Option<usize>,
    /// Its rows.
    #[serde(rename = "row")]
    pub rows: Vec<TableRow>,
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

impl Paper {
    /// Every row has as many claims, or cells, as its table has columns.
    pub(super) fn check_tables(&self) -> Result<(), SettingsError> {
        for table in &self.tables {
            for row in &table.rows {
                let (claims, cells) = (row.claims.len(), row.cells.len());
                if claims.max(cells) != table.columns.len() || claims.min(cells) > 0 {
                    let message = format!(
                        "row `{}` of table `{}` has {claims} claims and {cells} cells; either are accepted, one for each of \
                         the {} columns",
                        row.label,
                        table.id,
                        table.columns.len()
                    );
                    let span = row.claims.first().map_or(0..0, Spanned::span);
                    return Err(self.document.error(span, message));
                }
            }
        }
        Ok(())
    }
}
