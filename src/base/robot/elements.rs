//! Elements and attributes of XML files, each fault at its place: the XML library keeps the places of both.

use crate::ignored::{ignored_in, ignored_note, is_ignored};
use crate::settings::{Document, SettingsError, did_you_mean};
use crate::solid::Source;
use crate::text::brief;
use crate::yaml::unknown;
use roxmltree::{Error, Node};
use std::collections::{BTreeMap, BTreeSet};
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
            Error::DtdDetected => {
                let at = document.text().find("<!DOCTYPE").map_or(at, |found| found..found);
                source.fault(&at, "a document type, `<!DOCTYPE`, is given; XML without one is accepted")
            }
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

/// Elements that may stand in another more than once.
const MANY: [&str; 4] = ["link", "joint", "collision", "disable_collisions"];

/// A file of the format, held against the keys that are read, by element, and the table of ignored keys.
pub(super) struct Keys<'a> {
    pub(super) xml: Elements<'a>,
    pub(super) format: &'static str,
    pub(super) read: &'static [(&'static str, &'static [&'static str])],
}

/// What of a file is not read.
#[derive(Default)]
struct Unread {
    ignored: BTreeSet<String>,
    /// How often each key is there that is not known.
    unknown: BTreeMap<String, usize>,
    /// The first text between the elements of the root, and how many there are.
    texts: Option<(String, usize)>,
}

impl Keys<'_> {
    /// What below `root` is not read, a sentence each.
    ///
    /// # Errors
    /// A key that is not known, but for one of the root that is near to none that is read; an element that is there twice.
    pub(super) fn unread(&self, root: Node<'_, '_>) -> Result<Vec<String>, SettingsError> {
        let mut unread = Unread::default();
        self.element(root, &mut unread)?;
        let message = |(way, count): (String, usize)| {
            let times = if count == 1 { String::new() } else { format!(" ({count} times)") };
            format!("`{way}` is not known and not used{times}")
        };
        let texts = unread.texts.map(|(first, count)| {
            let others =
                if count == 1 { String::new() } else { format!(", nor are {} other texts", count - 1) };
            format!("the text `{first}` in `robot` is not used{others}")
        });
        let unknown = unread.unknown.into_iter().map(message);
        Ok(ignored_note(&unread.ignored).into_iter().chain(unknown).chain(texts).collect())
    }

    fn element(&self, node: Node<'_, '_>, unread: &mut Unread) -> Result<(), SettingsError> {
        let name = node.tag_name().name();
        let read = self.read.iter().find(|(element, _)| *element == name).map_or(&[][..], |(_, read)| read);
        let attributes = node.attributes().map(|at| (format!("@{}", at.name()), at.range(), None));
        let children = node.children().filter(Node::is_element);
        let children = children.map(|child| (name_in(node, child), child.range(), Some(child)));
        // The formats have no text of their own.
        let text = node
            .children()
            .filter(|part| part.is_text() && !part.text().unwrap_or_default().trim().is_empty());
        for part in text {
            let shown = brief(part.text().unwrap_or_default().trim()).replace('\n', " ");
            if name != "robot" {
                let message =
                    format!("the text `{shown}` stands in `{name}`; elements and attributes are accepted");
                return Err(self.xml.fault(&part.range(), message));
            }
            unread.texts.get_or_insert((shown, 0)).1 += 1;
        }
        let mut seen = BTreeSet::new();
        for (key, at, child) in attributes.chain(children) {
            let is_read = read.contains(&key.as_str()) && !means_nothing(node, &key);
            // A solid of another kind is refused where solids are read.
            let is_solid = name == "geometry" && child.is_some();
            let is_other = is_solid && !self.read.iter().any(|(element, _)| *element == key);
            if is_read || is_solid {
                let once = if is_solid { "solid" } else { &key };
                if child.is_some() && !MANY.contains(&once) && !seen.insert(once.to_owned()) {
                    return Err(self.xml.fault(&at, format!("a second {once} in `{name}`; one is accepted")));
                }
                child.filter(|_| !is_other).map_or(Ok(()), |child| self.element(child, unread))?;
            } else if is_ignored(self.format, &format!("{name}/{key}")) {
                unread.ignored.insert(format!("{name}/{key}"));
            } else if name != "robot" || !did_you_mean(&key, read.iter().copied()).is_empty() {
                let ignored = ignored_in(self.format, name).filter(|key| !read.contains(key));
                let accepted: Vec<&str> = read.iter().copied().chain(ignored).collect();
                return Err(self.xml.fault(&at, format!("`{name}`: {}", unknown(&key, &accepted))));
            } else {
                *unread.unknown.entry(format!("{name}/{key}")).or_default() += 1;
            }
        }
        Ok(())
    }
}

/// The name of an element in another, with its prefix where it is of another namespace.
fn name_in(element: Node<'_, '_>, child: Node<'_, '_>) -> String {
    let name = child.tag_name().name();
    if is_alike(element, child) {
        return name.to_owned();
    }
    let space = child.tag_name().namespace().unwrap_or_default();
    format!("{}:{name}", child.lookup_prefix(space).unwrap_or(space))
}

/// Whether both are of one namespace.
fn is_alike(element: Node<'_, '_>, child: Node<'_, '_>) -> bool {
    element.tag_name().namespace() == child.tag_name().namespace()
}

/// Whether a key that is read means nothing here: how a fixed joint would move, limits of one that turns without end.
fn means_nothing(element: Node<'_, '_>, key: &str) -> bool {
    let is =
        |joint: Option<Node<'_, '_>>, kind| joint.is_some_and(|node| node.attribute("type") == Some(kind));
    match element.tag_name().name() {
        "joint" => matches!(key, "axis" | "limit" | "mimic") && is(Some(element), "fixed"),
        "limit" => matches!(key, "@lower" | "@upper") && is(element.parent(), "continuous"),
        _ => false,
    }
}

impl Elements<'_> {
    pub(super) fn fault(self, at: &Range<usize>, message: impl Into<String>) -> SettingsError {
        self.0.fault(at, message)
    }

    pub(super) fn element<'n, 'input>(
        self,
        element: Node<'n, 'input>,
        name: &'static str,
    ) -> Result<Node<'n, 'input>, SettingsError> {
        child(element, name).ok_or_else(|| {
            let what = element.tag_name().name();
            let whose = element.attribute("name").unwrap_or_default();
            self.fault(&element.range(), format!("{what} `{whose}` has no `{name}`; one is accepted"))
        })
    }

    pub(super) fn text<'n>(self, element: Node<'n, '_>, key: &'static str) -> Result<&'n str, SettingsError> {
        element.attribute(key).ok_or_else(|| {
            let what = element.tag_name().name();
            self.fault(&element.range(), format!("the element `{what}` has no `{key}`; one is accepted"))
        })
    }

    /// `N` finite numbers in an attribute, if it is there.
    pub(super) fn numbers<const N: usize>(
        self,
        element: Node<'_, '_>,
        key: &'static str,
    ) -> Result<Option<[f64; N]>, SettingsError> {
        let Some(text) = element.attribute(key) else { return Ok(None) };
        let numbers: Option<Vec<f64>> = text.split_whitespace().map(|word| word.parse().ok()).collect();
        let numbers = numbers.and_then(|numbers| <[f64; N]>::try_from(numbers).ok());
        // As written: of `1e400` an infinity is read.
        let finite = if numbers.is_some() { "finite " } else { "" };
        let wrong = || {
            let many =
                if N == 1 { format!("a {finite}number is") } else { format!("{N} {finite}numbers are") };
            let text = brief(text);
            self.fault(&place(element, key), format!("{key} is `{text}`; {many} accepted"))
        };
        numbers.filter(|numbers| numbers.iter().all(|n| n.is_finite())).ok_or_else(wrong).map(Some)
    }

    /// A finite number in an attribute.
    pub(super) fn number(self, element: Node<'_, '_>, key: &'static str) -> Result<f64, SettingsError> {
        self.text(element, key)?;
        self.number_or(element, key, 0.0)
    }

    /// A finite number in an attribute, or what the format says where it is not there.
    pub(super) fn number_or(
        self,
        element: Node<'_, '_>,
        key: &'static str,
        default: f64,
    ) -> Result<f64, SettingsError> {
        Ok(self.numbers::<1>(element, key)?.map_or(default, |[number]| number))
    }
}

pub(super) fn elements<'a, 'input>(
    element: Node<'a, 'input>,
    name: &'static str,
) -> impl Iterator<Item = Node<'a, 'input>> {
    element.children().filter(move |node| node.tag_name().name() == name && is_alike(element, *node))
}

pub(super) fn child<'a, 'input>(element: Node<'a, 'input>, name: &'static str) -> Option<Node<'a, 'input>> {
    elements(element, name).next()
}

/// Where an attribute stands; its element if there is none.
pub(super) fn place(element: Node<'_, '_>, key: &str) -> Range<usize> {
    element.attribute_node(key).map_or(element.range(), |attribute| attribute.range())
}
