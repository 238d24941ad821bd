//! The paper's own tables as they are written.

use super::Digits;
use base::settings::{AnyTable, Spanned};
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use toml::Table;

/// A part of a table that may say how cells are judged: its own keys, and those that all such parts have.
macro_rules! judged {
    ($(#[$about:meta])* $name:ident { $($own:tt)* }) => {
        $(#[$about])*
        pub(super) struct $name {
            $($own)*
            /// The trials that criteria look at: laid under their `select`.
            #[serde(default)]
            #[schemars(with = "AnyTable")]
            pub(super) select: Table,
            /// How cells are judged: the settings of each criterion, by the criterion's name.
            #[serde(default)]
            #[schemars(with = "BTreeMap<String, AnyTable>")]
            pub(super) check: BTreeMap<String, Spanned<Table>>,
            /// What arithmetic on printed numbers says of them: the settings of each rule, by the rule's name.
            #[serde(default)]
            #[schemars(with = "BTreeMap<String, AnyTable>")]
            pub(super) rule: BTreeMap<String, Spanned<Table>>,
            /// What is shown beside them and decides nothing: the settings of criteria, by the criterion's name.
            #[serde(default)]
            #[schemars(with = "BTreeMap<String, Vec<AnyTable>>")]
            pub(super) shows: BTreeMap<String, Vec<Spanned<Table>>>,
        }
    };
}

judged! {
    /// One of the paper's tables: numbers as they are printed, and how they are judged. Table, columns, rows and single cells may all
    /// say so; what stands nearer to the cell wins. In texts about how cells are judged `{row}` and `{column}` stand for their ids.
    #[derive(Debug, Deserialize, JsonSchema)]
    #[serde(deny_unknown_fields)]
    TableSpec {
        /// Its file name.
        pub(super) id: String,
        /// What the names of its claims begin with; its `id` if absent. A cell is the claim `table.row.column`, a row `table.row`.
        pub(super) claims: Option<String>,
        /// Where it stands in the paper.
        pub(super) at: String,
        /// What it shows.
        pub(super) caption: String,
        /// What stands below it.
        #[serde(default)]
        pub(super) notes: Vec<String>,
        /// With how many decimals our numbers are shown; two if absent.
        #[schemars(range(max = 15))]
        pub(super) decimals: Option<usize>,
        /// Whether its columns are shown as rows and its rows as columns.
        #[serde(default)]
        pub(super) transposed: bool,
        /// The unit of its numbers.
        pub(super) unit: Option<String>,
        /// What its cells are if they are no claims.
        pub(super) none: Option<String>,
        /// What the paper leaves out, if its cells cannot be tested without it.
        pub(super) untestable: Option<String>,
        /// What was changed in how its cells are judged after a run had been seen, and why.
        pub(super) changed_after_run: Option<String>,
        /// One problem of ours whose first trial stands beside the printed number, laid over `select`; each cell shows what its claim found if
        /// absent.
        #[serde(default)]
        #[schemars(with = "AnyTable")]
        pub(super) beside: Table,
        /// Its columns from the left, but for the rows' names.
        #[serde(rename = "column")]
        pub(super) columns: Vec<ColumnSpec>,
        /// Its rows from the top, each with the numbers that it prints.
        #[serde(rename = "row")]
        pub(super) rows: Vec<RowSpec>,
    }
}

/// One name, or several.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "a name, or a list of names, is accepted")]
pub(super) enum Names {
    /// One name.
    One(String),
    /// Several names.
    Several(Vec<String>),
}

impl Names {
    pub(super) fn listed(&self) -> &[String] {
        match self {
            Self::One(name) => std::slice::from_ref(name),
            Self::Several(names) => names,
        }
    }
}

judged! {
    /// A column, or several that differ in their ids alone.
    #[derive(Debug, Deserialize, JsonSchema)]
    #[serde(deny_unknown_fields)]
    ColumnSpec {
        /// Its part in the names of claims; several for as many columns.
        pub(super) id: Names,
        /// Its head without the unit; its `id` if absent, which `{column}` stands for.
        pub(super) label: Option<String>,
        /// The unit of its numbers.
        pub(super) unit: Option<String>,
        /// What its cells are if they are no claims.
        pub(super) none: Option<String>,
        /// Two columns: this one, which the paper does not print, is the first less the second. Rows have no cell for it, and a table
        /// of its own shows it.
        pub(super) difference: Option<[Spanned<String>; 2]>,
        /// What the paper leaves out, if its cells cannot be tested without it.
        pub(super) untestable: Option<String>,
    }
}

judged! {
    /// A row of a table.
    #[derive(Debug, Deserialize, JsonSchema)]
    #[serde(deny_unknown_fields)]
    RowSpec {
        /// Its part in the names of claims.
        pub(super) id: String,
        /// Its head; its `id` if absent.
        pub(super) label: Option<String>,
        /// Where it stands in the paper, if not where the table does.
        pub(super) at: Option<String>,
        /// The unit of its numbers, if not that of their columns.
        pub(super) unit: Option<String>,
        /// What is printed in each column, digits and all; `N/A` where no number is.
        pub(super) printed: Vec<Spanned<String>>,
        /// What the paper leaves out, if its cells cannot be tested without it.
        pub(super) untestable: Option<String>,
        /// What is laid over the table's `beside`.
        #[serde(default)]
        #[schemars(with = "AnyTable")]
        pub(super) beside: Table,
        /// What single cells say otherwise, by their columns.
        #[serde(default)]
        pub(super) cell: BTreeMap<String, CellSpec>,
        /// What holds for the row as a whole.
        pub(super) whole: Option<CellSpec>,
        /// Further claims that are parts of the row.
        #[serde(default)]
        pub(super) with: Vec<Spanned<String>>,
    }
}

judged! {
    /// What holds for a single cell, or for a row as a whole.
    #[derive(Debug, Default, Deserialize, JsonSchema)]
    #[serde(default, deny_unknown_fields)]
    CellSpec {
        /// The name of its claim, if not made of those of table, row and column.
        pub(super) id: Option<String>,
        /// The cell of another table that prints the same number of the same trials: its claim is shown here, and this cell is none.
        pub(super) same_as: Option<Spanned<String>>,
        /// Where it stands in the paper.
        pub(super) at: Option<String>,
        /// The sentence, where it is not a number alone.
        pub(super) says: Option<String>,
        /// The sentence in a few words, for the first screens.
        pub(super) short: Option<String>,
        /// The paper's own words, where they are given word for word.
        pub(super) quote: Option<String>,
        /// How the number's digits end, where it says so; otherwise the interpretation decides.
        pub(super) digits: Option<Digits>,
        /// Whether it is one of the few claims that say what the paper is about.
        pub(super) headline: bool,
        /// What the paper leaves out, if it cannot be tested without that.
        pub(super) untestable: Option<String>,
        /// What was changed in how it is judged after a run had been seen, and why.
        pub(super) changed_after_run: Option<String>,
        /// The interpretations under which alone it is meant, each with the options that count: a premise that the paper states.
        pub(super) holds_when: BTreeMap<String, Vec<String>>,
    }
}
