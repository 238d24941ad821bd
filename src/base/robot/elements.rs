//! Elements and attributes of XML files, each fault at its place: the XML library keeps the places of both.

use crate::ignored::is_ignored;
use crate::settings::{Document, SettingsError};
use crate::solid::Source;
use roxmltree::{Error, Node, NodeType};
use std::collections::BTreeMap;
use std::ops::Range;

/// An XML file that is read.
#[derive(Clone, Copy)]
pub(super) struct Elements<'a>(pub(super) Source<'a>);

/// The parsed text of `document`, whose root must be `robot`; xacro is refused by its elements and its expressions.
pub(super) fn parsed(document: &Document) -> Result<roxmltree::Document<'_>, SettingsError> {
    let source = Source(document);
    let xacro = |at: &Range<usize>| source.fault(at, "this is xacro; what `xacro` makes of it is accepted");
    let parsed = roxmltree::Document::parse(document.text()).map_err(|error| {
        let at = parsed_to(document.text(), error.pos());
        match &error {
            Error::UnknownNamespace(prefix, _) if prefix == "xacro" => xacro(&at),
            _ => source.fault(&at, format!("this is no XML: {error}")),
        }
    })?;
    let root = parsed.root_element();
    if root.tag_name().name() != "robot" {
        let message = format!("found the element `{}`; `robot` is accepted", root.tag_name().name());
        return Err(source.fault(&root.range(), message));
    }
    for node in root.descendants().filter(Node::is_element) {
        if node.tag_name().namespace().is_some_and(|space| space.contains("xacro")) {
            return Err(xacro(&node.range()));
        }
        let is_expression = |text: &str| text.contains("${") || text.contains("$(");
        if let Some(attribute) = node.attributes().find(|attribute| is_expression(attribute.value())) {
            return Err(xacro(&attribute.range()));
        }
    }
    Ok(parsed)
}

/// The byte at a place that the XML library names by line and column.
fn parsed_to(text: &str, place: roxmltree::TextPos) -> Range<usize> {
    let line: usize = text.split_inclusive('\n').take(place.row as usize - 1).map(str::len).sum();
    let at = text[line..].char_indices().nth(place.col as usize - 1).map_or(text.len(), |(at, _)| line + at);
    at..at
}

/// What below `root` is neither in `read`, by element, nor in the table of ignored keys: a sentence for each kind.
pub(super) fn unread(root: Node<'_, '_>, format: &str, read: &[(&str, &[&str])]) -> Vec<String> {
    let mut found: BTreeMap<String, usize> = BTreeMap::new();
    let mut left = vec![root];
    while let Some(node) = left.pop() {
        let name = node.tag_name().name();
        let known = read.iter().find(|(element, _)| *element == name).map_or(&[][..], |(_, known)| known);
        let attributes = node.attributes().map(|attribute| (format!("@{}", attribute.name()), None));
        let children = node.children().filter(|child| child.node_type() == NodeType::Element);
        for (key, child) in
            attributes.chain(children.map(|child| (child.tag_name().name().to_owned(), Some(child))))
        {
            let way = format!("{name}/{key}");
            if known.contains(&key.as_str()) {
                left.extend(child);
            } else if !is_ignored(format, &way) {
                *found.entry(way).or_default() += 1;
            }
        }
    }
    let message = |(way, count): (String, usize)| {
        let times = if count == 1 { String::new() } else { format!(" ({count} times)") };
        format!("`{way}` is not known and not used{times}")
    };
    found.into_iter().map(message).collect()
}

impl Elements<'_> {
    pub(super) fn fault(self, at: &Range<usize>, message: impl Into<String>) -> SettingsError {
        self.0.fault(at, message)
    }

    pub(super) fn element<'n, 'input>(
        self,
        of: Node<'n, 'input>,
        name: &'static str,
    ) -> Result<Node<'n, 'input>, SettingsError> {
        child(of, name).ok_or_else(|| {
            let what = of.tag_name().name();
            let whose = of.attribute("name").unwrap_or_default();
            self.fault(&of.range(), format!("{what} `{whose}` has no `{name}`; one is accepted"))
        })
    }

    pub(super) fn text<'n>(self, of: Node<'n, '_>, key: &'static str) -> Result<&'n str, SettingsError> {
        of.attribute(key).ok_or_else(|| {
            let what = of.tag_name().name();
            self.fault(&of.range(), format!("the element `{what}` has no `{key}`; one is accepted"))
        })
    }

    /// `N` finite numbers in an attribute, if it is there.
    pub(super) fn numbers<const N: usize>(
        self,
        of: Node<'_, '_>,
        key: &'static str,
    ) -> Result<Option<[f64; N]>, SettingsError> {
        let Some(text) = of.attribute(key) else { return Ok(None) };
        let numbers: Option<Vec<f64>> = text.split_whitespace().map(|word| word.parse().ok()).collect();
        let numbers = numbers.and_then(|numbers| <[f64; N]>::try_from(numbers).ok());
        let wrong = || {
            let many = if N == 1 { "a number is".to_owned() } else { format!("{N} numbers are") };
            let text = crate::text::brief(text);
            self.fault(&place(of, key), format!("{key} is `{text}`; {many} accepted"))
        };
        Ok(Some(self.0.finite(&place(of, key), key, numbers.ok_or_else(wrong)?)?))
    }

    /// A finite number in an attribute.
    pub(super) fn number(self, of: Node<'_, '_>, key: &'static str) -> Result<f64, SettingsError> {
        self.text(of, key)?;
        self.number_or(of, key, 0.0)
    }

    /// A finite number in an attribute, or what the format says where it is not there.
    pub(super) fn number_or(
        self,
        of: Node<'_, '_>,
        key: &'static str,
        default: f64,
    ) -> Result<f64, SettingsError> {
        Ok(self.numbers::<1>(of, key)?.map_or(default, |[number]| number))
    }
}

pub(super) fn elements<'a, 'input>(
    of: Node<'a, 'input>,
    name: &'static str,
) -> impl Iterator<Item = Node<'a, 'input>> {
    of.children().filter(move |node| node.has_tag_name(name))
}

pub(super) fn child<'a, 'input>(of: Node<'a, 'input>, name: &'static str) -> Option<Node<'a, 'input>> {
    elements(of, name).next()
}

/// Where an attribute stands; its element if there is none.
pub(super) fn place(of: Node<'_, '_>, key: &str) -> Range<usize> {
    of.attribute_node(key).map_or(of.range(), |attribute| attribute.range())
}
