"""One table of what was renamed: data/renamed.toml, and the code that refuses old words by it."""
import os, re

LIST = '''# Words that were renamed: what was written up to revision 02acae0c, and what is written now. The program refuses the old words by this
# list, and a comparison with older records reads their names by it.

# Keys of specs. One word is the key's name now; a sentence says where it went.
[keys]
reading = "what the paper leaves open is a `[[choice]]` of paper.toml, written once for all studies; `leaves_out` names those that a study does not inherit"
choice = "choices are written in paper.toml, once for all studies"
explore = "`[explore]` is written in paper.toml, with `instances = { STUDY = N }` for each study that is explored"
replicates = "instances"
replicate = "instance"
draw = "a problem group's `draw` is `shared_instances`, a figure's is `instance`"
draws = "instances"
more_draws = "more_instances"
whole_draws = "whole_instances"
single_draws = "single_instances"
exhibit = "trace"
exhibits = "traces"
ledger = "inventory"

# Criteria, kinds of figure and metrics.
[names]
one_draw = "one_instance"
row_one_draw = "row_one_instance"
draws = "instances"
claims_by_axes = "claims_by_choices"
prepared_bytes = "preprocessing_bytes"

# What was typed, and what is typed now.
[command_line]
"--readings" = "--with"
"list readings" = "list choices"
"list prepared" = "list preprocessing"

# Columns of records; `reading_` begins the name of each choice's column.
[columns]
draw = "instance"
prepared_bytes = "preprocessing_bytes"
reading_ = "choice_"

# Files of records, by their parts: `STUDY.PART.parquet`.
[parts]
exhibits = "traces"
prepared = "preprocessing"

# Keys of manifests, stored verdicts, explorations and plans of shards.
[stored]
axes = "choices"
reading = "interpretation"
readings = "interpretations"
'''

CODE = '''//! Words that were renamed, as data/renamed.toml lists them.

use std::collections::BTreeMap;
use std::sync::OnceLock;

const LIST: &str = include_str!("../../../data/renamed.toml");

/// The old words in `section` of the list, each with what is written now.
///
/// # Panics
/// If there is no such section.
pub fn renamed(section: &str) -> &'static BTreeMap<String, String> {
    static READ: OnceLock<BTreeMap<String, BTreeMap<String, String>>> = OnceLock::new();
    &READ.get_or_init(|| toml::from_str(LIST).expect("the list is words in tables"))[section]
}

/// That `key` of a spec was renamed or moved, if it was.
pub(super) fn renamed_key(key: &str) -> Option<String> {
    let now = renamed("keys").get(key)?;
    let said = if now.contains(' ') { now.clone() } else { format!("it is `{now}` now") };
    Some(format!("`{key}` is no key here: {said}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_word_is_renamed_twice_but_where_a_key_moved() {
        for section in ["keys", "names", "command_line", "columns", "parts", "stored"] {
            let words = renamed(section);
            for (old, new) in words {
                assert!(!words.contains_key(new), "{section}: {old} is {new}, which is renamed too");
            }
        }
    }

    #[test]
    fn an_old_key_is_told_with_the_new_one() {
        let expected = "`replicates` is no key here: it is `instances` now";
        assert_eq!(renamed_key("replicates").as_deref(), Some(expected));
        assert!(renamed_key("ledger").unwrap().ends_with("`inventory` now"));
        assert_eq!(renamed_key("instances"), None);
    }
}
'''


def apply(tree):
    if not tree.has('src/study/*.rs', r'\bstruct Interpretation\b'): return
    new = f'{tree.root}/data/renamed.toml'
    code = f'{tree.root}/src/base/settings/renamed.rs'
    if os.path.exists(code): return
    open(new, 'w').write(LIST)
    open(code, 'w').write(CODE)
    tree.files += ['data/renamed.toml', 'src/base/settings/renamed.rs']
    f = 'src/base/settings/mod.rs'
    tree.write(f, tree.read(f).replace('mod reader;\n', 'mod reader;\nmod renamed;\n').replace('pub use place::Place;\n', 'pub use place::Place;\npub use renamed::renamed;\n'))
    f = 'src/base/settings/validate.rs'
    src = tree.read(f)
    src = re.sub(r'/// Keys that were renamed or moved, and what is written now\.\nconst RENAMED: .*?\n\];\n\n', '', src, flags=re.S)
    src, n = re.subn(r'    if let Some\(\(_, now\)\) = RENAMED\.iter\(\).*?\n    \}\n', '    if let Some(message) = renamed_key(name) {\n        return message;\n    }\n', src, flags=re.S)
    if not n:
        src = src.replace("fn unknown(node: Node<'_>, name: &str) -> String {\n", "fn unknown(node: Node<'_>, name: &str) -> String {\n    if let Some(message) = renamed_key(name) {\n        return message;\n    }\n")
    src = src.replace('use super::nearest::{did_you_mean, nearest};\n', 'use super::nearest::{did_you_mean, nearest};\nuse super::renamed::renamed_key;\n')
    tree.write(f, src)
    f = 'src/base/settings/nearest.rs'
    src = tree.read(f)
    src = src.replace("pub fn did_you_mean<'a>(written: &str, known: impl IntoIterator<Item = &'a str>) -> String {\n    nearest(written, known)\n",
        "///\n/// ` (it is X now)` if it was renamed to a known name.\npub fn did_you_mean<'a>(written: &str, known: impl IntoIterator<Item = &'a str>) -> String {\n    let known: Vec<&str> = known.into_iter().collect();\n    if let Some(now) = renamed(\"names\").get(written).filter(|now| known.contains(&now.as_str())) {\n        return format!(\" (it is `{now}` now)\");\n    }\n    nearest(written, known)\n")
    src = src.replace('\n/// ` (did you mean X?)`', '\nuse super::renamed::renamed;\n\n/// ` (did you mean X?)`', 1)
    tree.write(f, src)
    f = 'src/cli/mod.rs'
    src = tree.read(f)
    src = re.sub(r'/// Words of the command line that were renamed:[^\n]*\nconst RENAMED: [^\n]*\n\n', '', src)
    src = re.sub(r'    let is_typed = \|old: &\[&str\]\| .*?\n    Some\(format!\("`\{\}` is now `\{new\}`", old\.join\(" "\)\)\)\n',
        '    let is_typed = |old: &str| {\n        let old: Vec<&str> = old.split(\' \').collect();\n        words.windows(old.len()).any(|typed| typed == old)\n    };\n'
        '    let (old, new) = base::settings::renamed("command_line").iter().find(|(old, _)| is_typed(old))?;\n    Some(format!("`{old}` is now `{new}`"))\n', src, flags=re.S)
    tree.write(f, src)
