//! How much a document looks like what a schema describes, for files that do not say what they are.

use super::Document;
use super::schema::Node;
use serde_json::Value;
use toml::Spanned;
use toml::de::DeValue;

impl Document {
    /// How many keys at its top hold what `schema` knows there: a table with a key that it knows, or a list of such tables or of
    /// plain values. A name or a note tells nothing of what a file is.
    pub fn likeness(&self, schema: &Value) -> usize {
        let node = Node::root(schema);
        let table = self.parsed().ok().and_then(|value| value.get_ref().as_table());
        let is_known = |name: &str, value| node.property(name).is_some_and(|part| is_like(part, value));
        table.into_iter().flatten().filter(|(key, value)| is_known(key.get_ref(), value)).count()
    }
}

/// Whether `value` is a table or list that `node` knows in part.
fn is_like(node: Node<'_>, value: &Spanned<DeValue<'_>>) -> bool {
    let branches = node.branches();
    if !branches.is_empty() {
        return branches.into_iter().any(|branch| is_like(branch, value));
    }
    match value.get_ref() {
        DeValue::Table(table) => {
            let other = node.part("additionalProperties").filter(|other| !other.refuses_all());
            let is_other = |inner| other.is_some_and(|other| is_like(other, inner));
            let is_own = |key: &str| key != "name" && node.property(key).is_some();
            table.iter().any(|(key, inner)| is_own(key.get_ref()) || is_other(inner))
        }
        DeValue::Array(elements) => {
            let item = node.part("items").or_else(|| node.list("prefixItems").next());
            let is_item = |item: Node<'_>, inner: &Spanned<DeValue<'_>>| match inner.get_ref() {
                DeValue::Table(_) | DeValue::Array(_) => is_like(item, inner),
                _ => !item.kinds().contains(&"object") && item.branches().is_empty(),
            };
            item.is_some_and(|item| elements.iter().any(|inner| is_item(item, inner)))
        }
        _ => false,
    }
}
