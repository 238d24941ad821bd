//! A printed table as the `[[table]]` of a `paper.toml`: numbers as strings, rows and columns with ids.
//!
//! Nothing is bound to trials: `untestable` says so, and each number is a claim all the same. Whoever runs the paper puts `select` and
//! `check` in its place.

use super::meaning::Kind;
use super::table::Table;
use std::collections::BTreeSet;

/// The `[[table]]` of `table`, the table with this `number` in its text, and the row of the inventory that names its
/// claims.
pub fn toml(table: &Table, number: usize) -> String {
    let title = if table.name.is_empty() { format!("Table {number}") } else { table.name.clone() };
    let id = format!("table{number}");
    let is_number = |column: &usize| table.rows.iter().any(|row| row[*column].value.is_some());
    let columns: Vec<usize> = (0..table.columns.len()).filter(is_number).collect();
    let mut text = format!(
        "[[inventory]]\nitem = \"Table {number}\"\nsays = {}\nclaims = [\"{id}.*\"]\nfigures = [\"{id}\"]\n\n\
         [[table]]\nid = \"{id}\"\nat = \"Table {number}\"\ncaption = {}\n\
         # Put the trials (`select`) and a criterion (`check`) in the place of this line: docs/YOUR_OWN_PAPER.md\n\
         untestable = \"no study of ours runs this table yet\"\n",
        string(&title),
        string(&format!("{}: printed and ours.", title.trim_end_matches('.')))
    );
    let mut ids = BTreeSet::new();
    for column in &columns {
        let name = table.column_name(*column);
        let in_brackets = name.strip_suffix(')').and_then(|name| name.rsplit_once('('));
        let meaning = &table.columns[*column].meaning;
        let percent = matches!(meaning.kind, Kind::Share { whole: 100 }).then(|| "%".to_owned());
        let (label, unit) = match in_brackets {
            Some((label, unit)) => (label.trim().to_owned(), Some(unit.to_owned())),
            None => (name, meaning.unit.clone().or(percent)),
        };
        text += &format!(
            "\n[[table.column]]\nid = \"{}\"\nlabel = {}\n",
            fresh(&label, &mut ids),
            string(&label)
        );
        text += &unit.map_or_else(String::new, |unit| format!("unit = {}\n", string(&unit)));
    }
    let mut ids = BTreeSet::new();
    for (row, cells) in table.rows.iter().enumerate() {
        let name = table.row_name(row);
        let printed = columns.iter().map(|column| match cells[*column].value {
            Some(value) => string(&value.to_string()),
            None => "\"N/A\"".to_owned(),
        });
        text += &format!(
            "\n[[table.row]]\nid = \"{}\"\nlabel = {}\nprinted = [{}]\n",
            fresh(&name, &mut ids),
            string(&name),
            printed.collect::<Vec<_>>().join(", ")
        );
    }
    text
}

/// An id made of a label, with a number behind it if `ids` has it already.
fn fresh(label: &str, ids: &mut BTreeSet<String>) -> String {
    let spelled = label.to_lowercase().replace('*', "_star").replace('+', "_plus");
    let lined: String = spelled.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    let id = lined.split('_').filter(|part| !part.is_empty()).collect::<Vec<_>>().join("_");
    let id = if id.is_empty() { "unnamed".to_owned() } else { id };
    let numbered = (1..).map(|number| if number == 1 { id.clone() } else { format!("{id}_{number}") });
    let free = numbered.into_iter().find(|id| !ids.contains(id)).expect("numbers do not end");
    ids.insert(free.clone());
    free
}

fn string(text: &str) -> String {
    toml::Value::from(text).to_string()
}
