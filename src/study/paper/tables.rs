//! The paper's own tables: what they print, and the claims that their cells are.
//!
//! Every number of a cell is a claim called `table.row.column`. A row with two such cells or more is one called `table.row`,
//! whose parts are its cells; a cell that is not testable is no part of it and counts by itself. Claims made here look like
//! written ones: nothing above this floor distinguishes them.

use super::claim::{Claim, Parts, TestRole, Written, check_printed, name_cells};
use super::columns::{NOT_PRINTED, columns, differences};
use super::ids::twice;
use super::table_spec::{CellSpec, ColumnSpec, RowSpec, TableSpec};
use base::settings::{Document, Faults, Part, Place, Settings, Spanned, none_called};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, LazyLock};
use toml::{Table, Value};

/// One of the paper's tables, as it is shown beside ours.
#[derive(Debug, Clone)]
pub struct PrintedTable {
    /// Its file name.
    pub id: String,
    /// What it shows.
    pub caption: String,
    /// Whether it shows differences of columns, which the paper does not print.
    pub compares: bool,
    /// What stands below it.
    pub notes: Vec<String>,
    /// With how many decimals our numbers are shown.
    pub decimals: usize,
    /// The heads of its columns.
    pub columns: Vec<String>,
    /// Its rows from the top.
    pub rows: Vec<PrintedRow>,
}

/// A row as it is shown.
#[derive(Debug, Clone)]
pub struct PrintedRow {
    /// Its head.
    pub label: String,
    /// Its cells, one a column.
    pub cells: Vec<PrintedCell>,
}

/// What stands in a cell.
#[derive(Debug, Clone)]
pub struct PrintedCell {
    /// What the paper prints there.
    pub printed: String,
    /// The claim that it is, if it is one.
    pub claim: Option<String>,
    /// Selects trials; the first of them is shown beside it. `None` shows what its claim found.
    pub beside: Option<Settings>,
}

impl PrintedTable {
    /// Its cells, row by row.
    pub fn cells(&self) -> impl Iterator<Item = &PrintedCell> {
        self.rows.iter().flat_map(|row| &row.cells)
    }

    /// Whether any of its cells is a claim.
    pub fn has_claims(&self) -> bool {
        self.cells().any(|cell| cell.claim.is_some())
    }
}

/// A cell with the table, row and column that give its settings.
struct Cell<'a> {
    document: &'a Arc<Document>,
    /// The table and its number, from 0.
    table: (&'a TableSpec, usize),
    /// The row and its number.
    row: (&'a RowSpec, usize),
    /// The column, the number of its entry, and its id.
    column: (&'a ColumnSpec, usize, &'a str),
    /// What stands there, and the number of the column.
    printed: (&'a Spanned<String>, usize),
}

/// Settings by the names of criteria or rules.
type Named = BTreeMap<String, Spanned<Table>>;

/// What one of the tables around a cell, or the cell itself, says of how it is judged.
struct Layer<'a> {
    steps: Vec<String>,
    select: &'a Table,
    check: &'a Named,
    rule: &'a Named,
    shows: &'a BTreeMap<String, Vec<Spanned<Table>>>,
}

/// A table that says nothing of how cells are judged.
static NOTHING: LazyLock<CellSpec> = LazyLock::new(CellSpec::default);

impl<'a> Layer<'a> {
    /// Its rules, or its criteria that decide.
    fn named(&self, kind: TestRole) -> &'a Named {
        if kind == TestRole::Rule { self.rule } else { self.check }
    }
}

macro_rules! layer {
    ($spec:expr, $steps:expr) => {
        Layer {
            steps: $steps.iter().map(ToString::to_string).collect(),
            select: &$spec.select,
            check: &$spec.check,
            rule: &$spec.rule,
            shows: &$spec.shows,
        }
    };
}

/// The names of all cells that are claims.
pub(super) fn cell_ids(tables: &[TableSpec]) -> Vec<String> {
    let mut ids = Vec::new();
    for table in tables {
        for row in &table.rows {
            for (printed, (column, _, id)) in row.printed.iter().zip(columns(table)) {
                if table.is_claim(row, (column, id), printed) {
                    ids.push(table.cell_id(row, id));
                }
            }
            let more = differences(table).filter(|(column, ..)| table.difference(row, column).is_some());
            ids.extend(more.map(|(.., id)| table.cell_id(row, id)));
        }
    }
    ids
}

/// The claims of all tables, each row before its cells, and the tables as they are shown. What is wrong goes to `faults`.
pub(super) fn printed(
    document: &Arc<Document>,
    specs: &[TableSpec],
    ids: &[String],
    faults: &mut Faults,
) -> (Vec<Claim>, Vec<PrintedTable>) {
    let mut claims = Vec::new();
    let mut tables = Vec::new();
    for (number, table) in specs.iter().enumerate() {
        table.check_columns(document, number, faults);
        let (mut shown, mut compared) = (Vec::new(), Vec::new());
        for (index, row) in table.rows.iter().enumerate() {
            table.check_row(document, (number, index), faults);
            let mut own = Vec::new();
            let mut cells = Vec::new();
            for (at, (printed, column)) in row.printed.iter().zip(columns(table)).enumerate() {
                let cell = Cell {
                    document,
                    table: (table, number),
                    row: (row, index),
                    column,
                    printed: (printed, at),
                };
                let is_claim = table.is_claim(row, (column.0, column.2), printed);
                let claim = is_claim.then(|| cell.claim(faults));
                let repeated = || cell.own().same_as.as_ref().map(|id| id.get_ref().clone());
                cells.push(PrintedCell {
                    printed: printed.get_ref().clone(),
                    claim: claim.as_ref().map(|claim| claim.id.clone()).or_else(repeated),
                    beside: claim.as_ref().and_then(|_| cell.beside()),
                });
                own.extend(claim);
            }
            let mut more = Vec::new();
            for column in differences(table) {
                let Some(found) = table.difference(row, column.0) else {
                    let printed = NOT_PRINTED.to_owned();
                    more.push(PrintedCell { printed, claim: None, beside: None });
                    continue;
                };
                let cell = Cell {
                    document,
                    table: (table, number),
                    row: (row, index),
                    column,
                    printed: (&found.printed, found.at),
                };
                let claim = Claim { difference: Some(found.between), ..cell.claim(faults) };
                more.push(PrintedCell {
                    printed: found.printed.get_ref().clone(),
                    claim: Some(claim.id.clone()),
                    beside: None,
                });
                own.push(claim);
            }
            claims.extend(table.whole(document, (number, index), (&own, ids), faults));
            claims.extend(own);
            let label = with_unit(row.label(), row.unit.as_ref());
            if more.iter().any(|cell| cell.claim.is_some()) {
                compared.push(PrintedRow { label: label.clone(), cells: more });
            }
            shown.push(PrintedRow { label, cells });
        }
        tables.push(table.shown(columns(table), shown));
        if !compared.is_empty() {
            let shown = table.shown(differences(table), compared);
            let caption = format!("{}; differences of columns", shown.caption.trim_end_matches('.'));
            let id = format!("{}_differences", table.id);
            tables.push(PrintedTable { id, caption, compares: true, ..shown });
        }
    }
    (claims, tables)
}

fn with_unit(label: &str, unit: Option<&String>) -> String {
    let unit = unit.filter(|unit| label.to_lowercase() != **unit);
    unit.map_or_else(|| label.to_owned(), |unit| format!("{label} ({unit})"))
}

impl RowSpec {
    fn label(&self) -> &str {
        self.label.as_ref().unwrap_or(&self.id)
    }
}

impl ColumnSpec {
    fn label(&self, id: &str) -> String {
        self.label.as_ref().map_or_else(|| id.to_owned(), |label| label.replace("{column}", id))
    }
}

impl TableSpec {
    /// No two columns have one id.
    fn check_columns(&self, document: &Document, number: usize, faults: &mut Faults) {
        let mut seen = BTreeSet::new();
        for (_, entry, id) in columns(self).chain(differences(self)) {
            if !seen.insert(id) {
                let message = format!("table `{}` has another column `{id}`", self.id);
                faults.add(document.error_at(&format!("table.{number}.column.{entry}.id"), message));
                faults.unread(twice(&format!("table.{number}")));
            }
        }
        self.check_differences(document, number, faults);
    }

    /// A row has a cell for each column, and says nothing of cells that there are not.
    fn check_row(&self, document: &Document, (number, index): (usize, usize), faults: &mut Faults) {
        let row = &self.rows[index];
        let place = format!("table.{number}.row.{index}");
        let ids: Vec<&str> = columns(self).map(|(.., id)| id).collect();
        if row.printed.len() != ids.len() {
            let message = format!(
                "row `{}` of table `{}` has {} cells for {} columns; one for each is accepted, `N/A` where the paper prints none",
                row.id,
                self.id,
                row.printed.len(),
                ids.len()
            );
            faults.add(document.error_at(&format!("{place}.printed"), message));
        }
        for id in row.cell.keys() {
            let cell = row.printed.iter().zip(columns(self)).find(|(_, (.., own))| own == id);
            let message = match cell {
                Some((printed, (column, ..)))
                    if row.cell[id].same_as.is_none() && !self.is_claim(row, (column, id), printed) =>
                {
                    format!("row `{}`, column `{id}`: the cell is no claim, so nothing is set for it", row.id)
                }
                None if !ids.contains(&id.as_str()) => none_called("column", id, ids.iter().copied()),
                _ => continue,
            };
            let steps = ["table", &number.to_string(), "row", &index.to_string(), "cell", id];
            faults.add(document.error_at_key(&steps, format!("table `{}`: {message}", self.id)));
        }
    }

    /// The claim that a row is as a whole, if it has two parts or more: cells that can be tested, and claims beside them.
    fn whole(
        &self,
        document: &Arc<Document>,
        (number, index): (usize, usize),
        (cells, ids): (&[Claim], &[String]),
        faults: &mut Faults,
    ) -> Option<Claim> {
        let row = &self.rows[index];
        let own = row.whole.as_ref().unwrap_or(&NOTHING);
        let parts = cells.iter().filter(|cell| cell.untestable.is_none()).map(|cell| cell.id.clone());
        let with = row.with.iter().map(|id| id.get_ref().clone());
        let parts: Vec<String> = parts.chain(with).collect();
        if parts.len() < 2 {
            if row.whole.is_some() {
                let message = format!(
                    "row `{}` of table `{}` is no claim by itself: fewer than two of its cells can be tested",
                    row.id, self.id
                );
                faults.add(document.error_at(&format!("table.{number}.row.{index}.whole"), message));
            }
            return None;
        }
        let steps = ["table".to_owned(), number.to_string(), "row".to_owned(), index.to_string()];
        let place = steps.join(".");
        let whole = [&steps[..], &["whole".to_owned()]].concat();
        let layers = [layer!(own, whole), Layer { select: &self.select, ..layer!(NOTHING, steps[..2]) }];
        let mut tests = tests_of(document, &layers, own.untestable.is_some());
        for (_, _, settings) in &mut tests {
            fill(settings, &[("{row}", &row.id)]);
            settings.change(|table| {
                name_cells(table, ids);
            });
        }
        Some(Claim {
            id: own.id.clone().unwrap_or_else(|| format!("{}.{}", self.prefix(), row.id)),
            at: own
                .at
                .clone()
                .or_else(|| row.at.clone())
                .unwrap_or_else(|| format!("{}, {}", self.at, row.label())),
            says: own.says.clone().or_else(|| Some(format!("the row of {}", row.label()))),
            short: own.short.clone(),
            quote: own.quote.clone(),
            printed: None,
            unit: None,
            digits: own.digits,
            headline: own.headline,
            untestable: own.untestable.clone(),
            theorem: None,
            difference: None,
            changed_after_run: own.changed_after_run.clone().or_else(|| self.changed_after_run.clone()),
            holds_when: own.holds_when.clone(),
            tests,
            parts: Parts::Cells(parts),
            written: Written {
                own: format!("{place}.whole"),
                id: format!("{place}.id"),
                printed: place.clone(),
                layers: vec![format!("{place}.whole")],
            },
        })
    }

    /// The table as it is shown, with these columns and rows.
    fn shown<'a>(
        &self,
        columns: impl Iterator<Item = (&'a ColumnSpec, usize, &'a str)>,
        rows: Vec<PrintedRow>,
    ) -> PrintedTable {
        let columns: Vec<String> =
            columns.map(|(column, _, id)| with_unit(&column.label(id), column.unit.as_ref())).collect();
        let (columns, rows) = if self.transposed { transposed(columns, rows) } else { (columns, rows) };
        PrintedTable {
            id: self.id.clone(),
            caption: self.caption.clone(),
            compares: false,
            notes: self.notes.clone(),
            decimals: self.decimals.unwrap_or(2),
            columns,
            rows,
        }
    }
}

/// Columns as rows and rows as columns.
fn transposed(columns: Vec<String>, rows: Vec<PrintedRow>) -> (Vec<String>, Vec<PrintedRow>) {
    let (heads, mut cells): (Vec<String>, Vec<_>) =
        rows.into_iter().map(|row| (row.label, row.cells.into_iter())).unzip();
    let rows = columns
        .into_iter()
        .map(|label| PrintedRow { label, cells: cells.iter_mut().filter_map(Iterator::next).collect() });
    let rows = rows.collect();
    (heads, rows)
}

impl Cell<'_> {
    fn id(&self) -> String {
        self.table.0.cell_id(self.row.0, self.column.2)
    }

    fn own(&self) -> &CellSpec {
        self.row.0.cell.get(self.column.2).unwrap_or(&NOTHING)
    }

    /// Where settings of its tests may stand, the nearest first.
    fn layers(&self) -> [Layer<'_>; 4] {
        let number = self.table.1.to_string();
        let index = self.row.1.to_string();
        let entry = self.column.1.to_string();
        [
            layer!(self.own(), ["table", &number, "row", &index, "cell", self.column.2]),
            layer!(self.row.0, ["table", &number, "row", &index]),
            layer!(self.column.0, ["table", &number, "column", &entry]),
            layer!(self.table.0, ["table", &number]),
        ]
    }

    /// The claim that it is.
    fn claim(&self, faults: &mut Faults) -> Claim {
        let table = self.table.0;
        let row = self.row.0;
        let column = self.column.0;
        let (printed, at) = self.printed;
        let id = self.id();
        let own = self.own();
        check_printed(self.document, &id, printed, faults);
        let untestable = own.untestable.as_ref().or(row.untestable.as_ref());
        let untestable = untestable.or(column.untestable.as_ref()).or(table.untestable.as_ref()).cloned();
        let layers = self.layers();
        let mut tests = tests_of(self.document, &layers, untestable.is_some());
        for (_, _, settings) in &mut tests {
            fill(settings, &[("{row}", &row.id), ("{column}", self.column.2)]);
        }
        if tests.is_empty() && untestable.is_none() {
            let message = format!(
                "column `{}` of table `{}`: its cells are printed, and nothing says how they are judged; `check`, `rule`, `untestable` \
                 with what the paper leaves out, or `none` with what else they are is needed",
                self.column.2, table.id
            );
            let place = format!("table.{}.column.{}.id", self.table.1, self.column.1);
            faults.add(self.document.error_at(&place, message));
        }
        let place = row.at.clone().unwrap_or_else(|| format!("{}, {}", table.at, row.label()));
        let unit = row.unit.as_ref().or(column.unit.as_ref()).or(table.unit.as_ref());
        let row_at = format!("table.{}.row.{}", self.table.1, self.row.1);
        let printed_at = format!("{row_at}.printed.{at}");
        Claim {
            at: own.at.clone().unwrap_or_else(|| format!("{place}, {}", column.label(self.column.2))),
            says: own.says.clone(),
            short: own.short.clone(),
            quote: own.quote.clone(),
            printed: Some(printed.get_ref().clone()),
            unit: unit.cloned(),
            digits: own.digits,
            headline: own.headline,
            untestable,
            theorem: None,
            difference: None,
            changed_after_run: own.changed_after_run.clone().or_else(|| table.changed_after_run.clone()),
            holds_when: own.holds_when.clone(),
            tests,
            parts: Parts::None,
            written: Written {
                own: format!("{row_at}.cell.{}", self.column.2),
                id: printed_at.clone(),
                printed: printed_at,
                layers: layers.iter().map(|layer| layer.steps.join(".")).collect(),
            },
            id,
        }
    }

    /// Selects trials; the first of them is shown beside it.
    fn beside(&self) -> Option<Settings> {
        let table = self.table.0;
        let row = self.row.0;
        if table.beside.is_empty() && row.beside.is_empty() {
            return None;
        }
        let layers = self.layers();
        let mut select = laid_under(&layers);
        let mut places = Vec::new();
        let [_, of_row, _, of_table] = &layers;
        for (over, layer) in [(&table.beside, of_table), (&row.beside, of_row)] {
            select.extend(over.clone());
            places.insert(0, part(self.document, &[&layer.steps[..], &["beside".to_owned()]].concat(), None));
        }
        places.extend(of_parts(self.document, &layers));
        let table = Table::from_iter([("select".to_owned(), Value::Table(select))]);
        let mut settings = Settings::layered(self.document, self.printed.0.span(), places, table);
        fill(&mut settings, &[("{row}", &row.id), ("{column}", self.column.2)]);
        Some(settings)
    }
}

/// A table in the document as a part of settings, or the one `key` of it.
fn part(document: &Arc<Document>, steps: &[String], key: Option<&'static str>) -> Part {
    let steps: Vec<&str> = steps.iter().map(String::as_str).collect();
    Part { place: Place::of_table(document, &steps), key }
}

/// What the layers say under `select`, the nearest winning.
fn laid_under(layers: &[Layer<'_>]) -> Table {
    layers.iter().rev().flat_map(|layer| layer.select.clone()).collect()
}

/// Where the layers say it.
fn of_parts(document: &Arc<Document>, layers: &[Layer<'_>]) -> Vec<Part> {
    let naming = layers.iter().filter(|layer| !layer.select.is_empty());
    naming.map(|layer| part(document, &layer.steps, Some("select"))).collect()
}

/// Rules and criteria with their settings: those of the nearest layer that names any. The other layers' settings lie under them.
/// A cell that is not testable has no criteria but those that it names itself.
fn tests_of(
    document: &Arc<Document>,
    layers: &[Layer<'_>],
    is_untestable: bool,
) -> Vec<(TestRole, String, Settings)> {
    let mut found = Vec::new();
    for kind in [TestRole::Rule, TestRole::Decides] {
        let Some(nearest) = layers.iter().position(|layer| !layer.named(kind).is_empty()) else { continue };
        if kind == TestRole::Decides && is_untestable && nearest > 0 {
            continue;
        }
        for name in layers[nearest].named(kind).keys() {
            let mut table = Table::new();
            let mut parts = Vec::new();
            for layer in layers.iter().rev() {
                if let Some(settings) = layer.named(kind).get(name) {
                    merge(&mut table, settings.get_ref());
                    let steps = [&layer.steps[..], &[kind.key().to_owned(), name.clone()]].concat();
                    parts.insert(0, part(document, &steps, None));
                }
            }
            let span = layers[nearest].named(kind)[name].span();
            if kind == TestRole::Decides {
                lay_under(&mut table, &laid_under(layers));
                parts.extend(of_parts(document, layers));
            }
            found.push((kind, name.clone(), Settings::layered(document, span, parts, table)));
        }
    }
    let shown = layers.iter().find(|layer| !layer.shows.is_empty());
    for (layer, (name, tables)) in
        shown.into_iter().flat_map(|layer| layer.shows.iter().map(move |one| (layer, one)))
    {
        for (index, settings) in tables.iter().enumerate() {
            let mut table = settings.get_ref().clone();
            lay_under(&mut table, &laid_under(layers));
            let own = ["shows".to_owned(), name.clone(), index.to_string()];
            let mut parts = vec![part(document, &[&layer.steps[..], &own].concat(), None)];
            parts.extend(of_parts(document, layers));
            found.push((
                TestRole::Shown,
                name.clone(),
                Settings::layered(document, settings.span(), parts, table),
            ));
        }
    }
    found
}

/// Lays `select` under the selection of a criterion's settings. A criterion that looks `in` several places names metric and contenders
/// beside these.
fn lay_under(settings: &mut Table, select: &Table) {
    if settings.contains_key("in") {
        for (from, to) in [("metric", "metric"), ("contender", "contenders"), ("against", "against")] {
            if let Some(value) = select.get(from) {
                settings.entry(to).or_insert(value.clone());
            }
        }
    } else if !select.is_empty() {
        let mut under = Table::from_iter([("select".to_owned(), Value::Table(select.clone()))]);
        merge(&mut under, settings);
        *settings = under;
    }
}

/// Puts `over` on top of `under`, tables into tables.
fn merge(under: &mut Table, over: &Table) {
    for (key, value) in over {
        match (under.get_mut(key), value) {
            (Some(Value::Table(under)), Value::Table(over)) => merge(under, over),
            _ => {
                under.insert(key.clone(), value.clone());
            }
        }
    }
}

/// Puts ids in the place of their names in all texts of `settings`.
fn fill(settings: &mut Settings, names: &[(&str, &str)]) {
    fn filled(value: &mut Value, names: &[(&str, &str)]) {
        match value {
            Value::String(text) => {
                *text = names.iter().fold(std::mem::take(text), |text, (name, id)| text.replace(name, id));
            }
            Value::Array(elements) => elements.iter_mut().for_each(|value| filled(value, names)),
            Value::Table(table) => table.iter_mut().for_each(|(_, value)| filled(value, names)),
            _ => {}
        }
    }
    settings.change(|table| table.iter_mut().for_each(|(_, value)| filled(value, names)));
}
