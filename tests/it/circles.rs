//! No two files of a package import each other, directly or around a corner.
//!
//! An arrow goes from a file to the file in which a name that it uses is defined. Names are followed through the `use`
//! declarations of the modules on the way, so that a `mod.rs` which declares and re-exports is nothing by itself. Code for
//! tests is left out: a test may look at everything.

use crate::source::{File, PACKAGES, files};
use std::collections::{BTreeMap, BTreeSet};

/// A module's names on the way to it from its package's root.
type Module = Vec<String>;

/// The modules of one package.
struct Package<'a> {
    modules: BTreeMap<Module, Read<'a>>,
}

/// A file as far as its imports go.
struct Read<'a> {
    file: &'a File,
    /// Its code without tests and `use` declarations.
    body: String,
    /// What its `use` declarations bind: the name, the path, and whether others may use the binding.
    uses: Vec<Use>,
}

struct Use {
    name: String,
    path: Vec<String>,
    is_public: bool,
}

impl<'a> Read<'a> {
    fn new(file: &'a File) -> Self {
        let code = without_tests(&file.code);
        let mut body = String::new();
        let mut uses = Vec::new();
        let mut rest = code.as_str();
        while let Some((at, is_public)) = next_use(rest) {
            let (before, from) = rest.split_at(at);
            body += before;
            let end = from.find(';').map_or(from.len(), |end| end + 1);
            let tree = from[..end].split_once("use ").map_or("", |(_, tree)| tree);
            let tree: String = tree.trim_end_matches(';').split_whitespace().collect::<Vec<_>>().join(" ");
            leaves(&tree, &[], &mut |name, path| uses.push(Use { name, path, is_public }));
            rest = &from[end..];
        }
        body += rest;
        Self { file, body, uses }
    }

    /// Every path of two names or more in the body.
    fn paths(&self) -> Vec<Vec<String>> {
        let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
        let words = self.body.split(|c: char| !is_part(c)).filter(|word| word.contains("::"));
        let names = |word: &str| word.split("::").map(str::to_owned).collect::<Vec<_>>();
        words
            .map(names)
            .filter(|path| path.iter().all(|name| !name.is_empty() && !name.contains(':')))
            .collect()
    }

    fn mentions(&self, name: &str) -> bool {
        self.body.split(|c: char| !(c.is_alphanumeric() || c == '_')).any(|word| word == name)
    }
}

/// `code` without what is compiled for tests alone.
fn without_tests(code: &str) -> String {
    let mut kept = String::new();
    let mut lines = code.lines();
    while let Some(line) = lines.next() {
        if line.trim() != "#[cfg(test)]" {
            kept += line;
            kept.push('\n');
            continue;
        }
        let end = format!("{}}}", " ".repeat(line.len() - line.trim_start().len()));
        let is_over =
            |line: &str| line == end || line.ends_with(';') && line.trim_start().starts_with("mod ");
        let _ = lines.by_ref().find(|line| is_over(line));
    }
    kept
}

/// Where the next `use` declaration begins, and whether it is public.
fn next_use(code: &str) -> Option<(usize, bool)> {
    let mut at = 0;
    for line in code.split_inclusive('\n') {
        let text = line.trim_start();
        let is_public = text.starts_with("pub");
        let declared = if is_public { text.split_once(' ').map_or("", |(_, rest)| rest) } else { text };
        if declared.starts_with("use ") {
            return Some((at, is_public));
        }
        at += line.len();
    }
    None
}

/// Calls `bind` for every name that the tree of a `use` declaration binds.
fn leaves(tree: &str, prefix: &[String], bind: &mut impl FnMut(String, Vec<String>)) {
    let tree = tree.trim();
    if let Some(open) = tree.find('{') {
        let path: Vec<String> = prefix.iter().cloned().chain(names(&tree[..open])).collect();
        let inside = tree[open + 1..].rsplit_once('}').map_or("", |(inside, _)| inside);
        for part in parts(inside) {
            leaves(part, &path, bind);
        }
        return;
    }
    let (path, alias) = tree.split_once(" as ").map_or((tree, None), |(path, alias)| (path, Some(alias)));
    let mut path: Vec<String> = prefix.iter().cloned().chain(names(path)).collect();
    if path.len() > 1 && path.last().is_some_and(|last| last == "self") {
        path.pop();
    }
    let Some(last) = path.last().cloned() else { return };
    bind(alias.map_or(last, |alias| alias.trim().to_owned()), path);
}

fn names(path: &str) -> Vec<String> {
    path.split("::").map(|name| name.trim().to_owned()).filter(|name| !name.is_empty()).collect()
}

/// The parts of a braced list.
fn parts(list: &str) -> Vec<&str> {
    let mut depth = 0;
    let mut start = 0;
    let mut parts = Vec::new();
    for (at, c) in list.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(&list[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.push(&list[start..]);
    parts.into_iter().filter(|part| !part.trim().is_empty()).collect()
}

impl<'a> Package<'a> {
    fn new(files: &'a [File], package: &str) -> Self {
        let is_main = |file: &File| file.path.ends_with("main.rs");
        let own = files.iter().filter(|file| file.package() == package && !is_main(file) && !is_test(file));
        Self { modules: own.map(|file| (file.modules(), Read::new(file))).collect() }
    }

    /// The module in which `path`, as `module` writes it, is defined; nothing if it is a module itself or not of this package.
    fn place(&self, module: &[String], path: &[String], depth: usize) -> Option<Module> {
        let (first, rest) = path.split_first()?;
        match first.as_str() {
            "crate" => self.walk(Module::new(), rest, depth),
            "self" => self.walk(module.to_vec(), rest, depth),
            "super" => self.place_above(module, rest, depth),
            _ => self.walk_known(module, path, depth),
        }
    }

    fn place_above(&self, module: &[String], rest: &[String], depth: usize) -> Option<Module> {
        let above = module.split_last()?.1.to_vec();
        if rest.first().is_some_and(|next| next == "super") {
            return self.place_above(&above, &rest[1..], depth);
        }
        self.walk(above, rest, depth)
    }

    /// As [`walk`](Self::walk), but a first name that the module neither declares nor binds is a local one or a crate's.
    fn walk_known(&self, module: &[String], path: &[String], depth: usize) -> Option<Module> {
        let child = [module, &path[..1]].concat();
        let is_bound = self.modules[module].uses.iter().any(|used| used.name == path[0]);
        (self.modules.contains_key(&child) || is_bound).then(|| self.walk(module.to_vec(), path, depth))?
    }

    fn walk(&self, mut module: Module, path: &[String], depth: usize) -> Option<Module> {
        for (index, name) in path.iter().enumerate() {
            let child = [module.as_slice(), std::slice::from_ref(name)].concat();
            if self.modules.contains_key(&child) {
                module = child;
                continue;
            }
            let read = self.modules.get(&module)?;
            let bound = read.uses.iter().find(|used| used.name == *name);
            return match bound {
                Some(used) if depth < 20 && used.path.len() + path.len() > index + 1 => {
                    let full = [used.path.as_slice(), &path[index + 1..]].concat();
                    if full[0] == *name && full.len() == path.len() - index && !self.is_child(&module, name) {
                        return None;
                    }
                    self.place(&module, &full, depth + 1)
                }
                _ => Some(module),
            };
        }
        None
    }

    fn is_child(&self, module: &[String], name: &str) -> bool {
        self.modules.contains_key(&[module, &[name.to_owned()]].concat())
    }

    /// The files that each file takes names from.
    fn arrows(&self) -> BTreeMap<&Module, BTreeSet<Module>> {
        let of = |module: &Module, read: &Read<'_>| -> BTreeSet<Module> {
            let used = read.uses.iter().filter(|used| !used.is_public || read.mentions(&used.name));
            let paths = used.map(|used| used.path.clone()).chain(read.paths());
            let mut to: BTreeSet<Module> = paths.filter_map(|path| self.place(module, &path, 0)).collect();
            // A module and what lies in it are one thing to each other, as they are to the compiler's rules of privacy.
            to.retain(|other| !module.starts_with(other));
            to
        };
        self.modules.iter().map(|(module, read)| (module, of(module, read))).collect()
    }

    /// Every circle: files that reach each other, in the order of their paths.
    fn circles(&self) -> Vec<Vec<String>> {
        let arrows = self.arrows();
        let reached = |from: &Module| {
            let mut seen = BTreeSet::new();
            let mut next = vec![from];
            while let Some(module) = next.pop() {
                next.extend(arrows.get(module).into_iter().flatten().filter(|to| seen.insert((*to).clone())));
            }
            seen
        };
        let reach: BTreeMap<&Module, BTreeSet<Module>> =
            arrows.keys().map(|from| (*from, reached(from))).collect();
        let mut circles = BTreeSet::new();
        for (from, to) in &reach {
            let circle: Vec<&Module> = to.iter().filter(|other| reach[other].contains(*from)).collect();
            if !circle.is_empty() {
                circles.insert(
                    circle.iter().map(|module| self.message(module, &circle, &arrows)).collect::<Vec<_>>(),
                );
            }
        }
        circles.into_iter().collect()
    }

    /// A file of `circle` and those of it that it takes names from.
    fn message(
        &self,
        module: &Module,
        circle: &[&Module],
        arrows: &BTreeMap<&Module, BTreeSet<Module>>,
    ) -> String {
        let path = |module: &Module| self.modules[module].file.path.display().to_string();
        let to: Vec<String> = arrows[module].iter().filter(|to| circle.contains(to)).map(path).collect();
        format!("{} -> {}", path(module), to.join(", "))
    }
}

fn is_test(file: &File) -> bool {
    file.modules().iter().any(|name| name == "tests")
}

#[test]
fn no_files_of_a_package_import_each_other() {
    let files = files();
    let mut found = Vec::new();
    for package in PACKAGES.iter().chain(&["replan"]) {
        let package = Package::new(&files, package);
        found.extend(package.circles());
    }
    let text: Vec<String> = found.iter().map(|circle| circle.join("\n  ")).collect();
    assert!(found.is_empty(), "{} circles\n{}", found.len(), text.join("\n\n"));
}

#[test]
fn circles_are_noticed_in_a_tree_made_up_for_them() {
    let circles = |texts: &[(&str, &str)]| {
        let files: Vec<File> = texts.iter().map(|(path, text)| File::new(path, text)).collect();
        Package::new(&files, "replan").circles()
    };
    let lib = ("lib.rs", "pub mod page;");
    let house = "mod one;\npub mod two;\npub use one::First;";
    let of = |house: &str, one: &str, two: &str| {
        circles(&[lib, ("page/mod.rs", house), ("page/one.rs", one), ("page/two.rs", two)])
    };
    let found = "page/one.rs -> page/two.rs|page/two.rs -> page/one.rs";
    for (one, two) in [
        (
            "use super::two::Second;\npub struct First(Second);",
            "use super::one::First;\npub struct Second(First);",
        ),
        // A name that a folder passes on is the name of the file that has it.
        (
            "use crate::page::two::Second;\npub struct First(Second);",
            "use crate::page::First;\npub struct Second(First);",
        ),
        // So is a path in the code, and one that starts from an imported module.
        (
            "pub struct First(super::two::Second);",
            "use crate::page::{self};\npub struct Second(page::First);",
        ),
        (
            "use crate::{\n    page::{\n        two::{self as other},\n    },\n};\npub struct First(other::Second);",
            "use super::First as F;\npub struct Second(F);",
        ),
    ] {
        let circles = of(house, one, two);
        assert_eq!(
            circles.iter().map(|circle| circle.join("|")).collect::<Vec<_>>(),
            [found],
            "{one}\n{two}"
        );
    }
    for (house, one, two) in [
        (house, "pub struct First;", "use super::First;\npub struct Second(First);"),
        // Tests look at everything.
        (
            house,
            "pub struct First;\n#[cfg(test)]\nmod tests {\n    use crate::page::two::Second;\n}",
            "use super::First;\npub struct Second(First);",
        ),
        // A folder and what lies in it are one thing to each other.
        (
            "mod one;\nmod two;\npub struct Of(one::First);",
            "use super::Of;\npub struct First(Of);",
            "pub struct Second;",
        ),
        // Another crate's names, and local ones, are no files.
        (
            house,
            "use std::page::Second;\npub struct First;",
            "use super::First;\npub fn second() {\n    First::two::second()\n}",
        ),
    ] {
        assert_eq!(of(house, one, two), Vec::<Vec<String>>::new(), "{one}\n{two}");
    }
    let around = [
        lib,
        ("page/mod.rs", "mod a;\nmod b;\nmod c;"),
        ("page/a.rs", "use super::b::B;"),
        ("page/b.rs", "use super::c::C;"),
        ("page/c.rs", "use super::a::A;"),
    ];
    assert_eq!(circles(&around).concat().len(), 3);
}
