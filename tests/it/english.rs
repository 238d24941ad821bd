//! Plain English: the pages, the report and every `--help` keep to short sentences and to the field's words.
//!
//! Code blocks, headings and inline code are no prose. A sentence ends at a full stop, never at a semicolon. A text without a full stop,
//! as in a table or a list of names, counts against the limit of one sentence and not toward a page's mean.

use crate::paper::Bench;
use std::fs;
use std::path::{Path, PathBuf};

/// Words of one sentence at most.
const LONGEST: usize = 35;

/// Words of a sentence of a page on average, at most.
const MEAN: f64 = 18.0;

/// Phrases with a plainer way to say them.
const DROPPED: [&str; 9] =
    ["told", "said", "asked", "of which", "by what", "ledger", "exhibit", "untestable", "undecided"];

/// Stops that end no sentence.
const ABBREVIATIONS: [&str; 8] = ["al.", "Fig.", "No.", "Sec.", "cf.", "e.g.", "i.e.", "vs."];

/// A run of words, and whether it ends in a full stop and so counts toward the mean.
#[derive(Debug, PartialEq, Eq)]
struct Sentence {
    words: Vec<String>,
    is_whole: bool,
}

impl Sentence {
    fn count(&self) -> usize {
        self.words.iter().filter(|word| word.contains(char::is_alphanumeric)).count()
    }

    fn text(&self) -> String {
        self.words.join(" ")
    }

    /// The dropped phrases in it.
    fn dropped(&self) -> Vec<&'static str> {
        let spaced = spaced(&self.text());
        let mut found: Vec<&str> = dropped(&spaced).collect();
        if self.is_whole && self.words[0] == "What" && !self.text().ends_with('?') {
            found.push("What … is");
        }
        let purpose = spaced.split_once(" so that ").map(|(_, rest)| rest);
        if purpose.is_some_and(|rest| rest.contains(" alone ")) {
            found.push("so that … alone");
        }
        found
    }
}

/// The words of a text in small letters, one space around each.
fn spaced(text: &str) -> String {
    let lower = text.to_lowercase();
    let words: Vec<&str> =
        lower.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty()).collect();
    format!(" {} ", words.join(" "))
}

/// The dropped phrases among spaced words.
fn dropped(spaced: &str) -> impl Iterator<Item = &'static str> {
    DROPPED.into_iter().filter(move |phrase| spaced.contains(&format!(" {phrase} ")))
}

/// The text with one word for each stretch of inline code, and links and emphasis as they are read.
fn read_aloud(text: &str) -> String {
    let mut prose = String::new();
    for (index, part) in text.split('`').enumerate() {
        prose += if index % 2 == 0 { part } else { "code" };
    }
    while let Some((before, rest)) = prose.split_once("](") {
        let (_, after) = rest.split_once(')').unwrap_or((rest, ""));
        prose = format!("{before}{after}");
    }
    prose.replace(['*', '['], "")
}

/// Whether a sentence ends between two words.
fn ends(word: &str, next: Option<&String>) -> bool {
    let bare = word.trim_end_matches(['"', '”', ')']);
    let is_initial = bare.len() == 2 && bare.starts_with(|c: char| c.is_ascii_uppercase());
    bare.ends_with(['.', '?', '!'])
        && !is_initial
        && !ABBREVIATIONS.contains(&bare)
        && next.is_none_or(|next| {
            let bare = next.trim_start_matches(['"', '“', '(']);
            bare.starts_with(|c: char| c.is_uppercase() || c.is_ascii_digit()) || bare.starts_with("code")
        })
}

/// The sentences of a paragraph; in a table none is whole.
fn sentences(paragraph: &str, is_table: bool) -> Vec<Sentence> {
    let words: Vec<String> = read_aloud(paragraph).split_whitespace().map(str::to_owned).collect();
    let mut found = Vec::new();
    let mut begun = 0;
    for (index, word) in words.iter().enumerate() {
        let is_whole = ends(word, words.get(index + 1));
        if is_whole || index + 1 == words.len() {
            found.push(Sentence { words: words[begun..=index].to_vec(), is_whole: is_whole && !is_table });
            begun = index + 1;
        }
    }
    found
}

/// The sentences of a page in Markdown.
fn of_page(page: &str) -> Vec<Sentence> {
    let mut found = Vec::new();
    let mut paragraph = String::new();
    let mut is_code = false;
    for line in page.lines().chain([""]) {
        let text = line.trim();
        let is_fence = text.starts_with("```");
        is_code ^= is_fence;
        let is_item = text.starts_with("- ")
            || text.split_once(". ").is_some_and(|(number, _)| number.parse::<u32>().is_ok());
        let is_prose = !(is_code || is_fence || text.is_empty() || text.starts_with(['#', '<', '|', '!']));
        if !is_prose || is_item {
            found.extend(sentences(&paragraph, false));
            paragraph.clear();
        }
        if text.starts_with('|') && !is_code {
            found.extend(text.split('|').flat_map(|cell| sentences(cell, true)));
        }
        let is_indented_code = line.starts_with("    ") && paragraph.is_empty();
        if is_prose && !is_indented_code {
            paragraph = format!("{paragraph} {}", text.trim_start_matches("- "));
        }
    }
    found
}

/// The sentences of a help text, whose entries end without a full stop.
fn of_help(help: &str) -> Vec<Sentence> {
    let mut found = Vec::new();
    let mut paragraph = String::new();
    for line in help.lines().take_while(|line| line.trim() != "Examples:").chain([""]) {
        let text = line.trim();
        let is_name = text.starts_with(['-', '<', '[']) || line.find("  ").is_some_and(|at| at == 0);
        let (name, about) = text.split_once("  ").unwrap_or((text, ""));
        let begins = text.is_empty() || text.starts_with("Usage:") || text.ends_with(':');
        let is_entry = is_name && (!about.is_empty() || text.starts_with(['-', '<', '[']));
        if begins || is_entry {
            found.extend(sentences(&paragraph, false));
            paragraph.clear();
        }
        if is_entry {
            about.trim().clone_into(&mut paragraph);
        } else if !begins {
            paragraph = format!("{paragraph} {name} {}", about.trim());
        }
    }
    for sentence in &mut found {
        sentence.is_whole = true;
    }
    found
}

/// What keeps the sentences of `page` from being plain.
fn faults(page: &str, sentences: &[Sentence]) -> Vec<String> {
    let mut found = Vec::new();
    for sentence in sentences {
        if sentence.count() > LONGEST {
            found.push(format!("{page}: {} words: {}", sentence.count(), sentence.text()));
        }
        found.extend(
            sentence.dropped().iter().map(|phrase| format!("{page}: “{phrase}”: {}", sentence.text())),
        );
    }
    let whole: Vec<usize> =
        sentences.iter().filter(|sentence| sentence.is_whole).map(Sentence::count).collect();
    let mean = whole.iter().sum::<usize>() as f64 / whole.len().max(1) as f64;
    if mean > MEAN {
        found.push(format!("{page}: sentences have {mean:.1} words on average"));
    }
    found
}

#[test]
fn every_page_is_written_in_short_plain_sentences() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut pages = vec![root.join("README.md"), root.join("paper_repro.md")];
    pages.extend(fs::read_dir(root.join("docs")).unwrap().map(|entry| entry.unwrap().path()));
    pages.retain(|path| path.extension().is_some_and(|ending| ending == "md"));
    let mut found = Vec::new();
    let mut count = 0;
    for path in &pages {
        let sentences = of_page(&fs::read_to_string(path).unwrap());
        count += sentences.len();
        found.extend(faults(&path.strip_prefix(root).unwrap().display().to_string(), &sentences));
    }
    assert!(pages.len() > 10 && count > 500, "{} pages, {count} sentences", pages.len());
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn the_readme_is_short_and_the_numbers_of_its_sample_are_those_of_the_report() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let [readme, report] =
        ["README.md", "paper_repro.md"].map(|file| fs::read_to_string(root.join(file)).unwrap());
    let words = readme.split_whitespace().count();
    assert!((400..=900).contains(&words), "{words} words");
    let report = report.split_whitespace().collect::<Vec<_>>().join(" ");
    // A headline that is longer than a line goes on below it.
    let joined = readme.replace("\n                        ", " ");
    let sample: Vec<&str> =
        joined.lines().filter(|line| line.starts_with("    ") && line.contains("(n = ")).collect();
    for line in &sample {
        let (number, n) = line.split_once(" (n = ").unwrap();
        let (_, number) = number.rsplit_once(": ").unwrap();
        let ours = format!("{number} (n = {}", n.split_once(')').unwrap().0);
        assert!(report.contains(&ours), "the report does not say “{ours}”");
    }
    assert!(sample.len() > 1, "{sample:?}");
}

/// Words of a headline claim with its number and its verdict, two sentences, at most.
const HEADLINE: usize = 40;

#[test]
fn headline_claims_with_their_numbers_and_verdicts_are_short() {
    let report = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("paper_repro.md")).unwrap();
    let overview = report.split("<!-- replan end").next().unwrap();
    let text = overview.replace("\n  ", " ");
    let entries: Vec<&str> = text.lines().filter_map(|line| line.strip_prefix("- ")).collect();
    let words = |entry: &str| sentences(entry, true).iter().map(Sentence::count).sum::<usize>();
    let long: Vec<String> = entries
        .iter()
        .filter(|entry| words(entry) > HEADLINE)
        .map(|entry| format!("{} words: {entry}", words(entry)))
        .collect();
    assert!(entries.len() > 50, "{} claims", entries.len());
    assert!(long.is_empty(), "{}", long.join("\n"));
}

/// The comments of a file of Rust, each with the number of its first line.
fn comments(text: &str) -> Vec<(usize, String)> {
    let mut found: Vec<(usize, String)> = Vec::new();
    let mut goes_on = false;
    for (line, number) in text.lines().zip(1..) {
        let comment = line.trim_start().strip_prefix("//");
        let Some(words) = comment.map(|comment| comment.trim_start_matches(['/', '!'])) else {
            goes_on = false;
            continue;
        };
        let words = words.strip_prefix(' ').unwrap_or(words);
        match found.last_mut().filter(|_| goes_on) {
            Some((_, text)) => *text += &format!("\n{words}"),
            None => found.push((number, words.to_owned())),
        }
        goes_on = true;
    }
    found
}

#[test]
fn comments_keep_to_the_fields_words_and_to_short_sentences() {
    let mut open = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("src")];
    let mut found = Vec::new();
    let mut count = 0;
    while let Some(path) = open.pop() {
        if path.is_dir() {
            open.extend(fs::read_dir(&path).unwrap().map(|entry| entry.unwrap().path()));
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            let comments = comments(&fs::read_to_string(&path).unwrap());
            count += comments.len();
            for (line, text) in comments {
                let spaced = spaced(&read_aloud(&text));
                found.extend(dropped(&spaced).map(|phrase| format!("{}:{line}: “{phrase}”", path.display())));
                // Sources are cited in one sentence, whatever their length.
                let (prose, _) = text.split_once("# Source").unwrap_or((&text, ""));
                let long = of_page(prose).into_iter().filter(|sentence| sentence.count() > LONGEST);
                let place = |sentence: Sentence| {
                    format!("{}:{line}: {} words: {}", path.display(), sentence.count(), sentence.text())
                };
                found.extend(long.map(place));
            }
        }
    }
    assert!(count > 3_000, "{count} comments");
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// Words that say nothing as the name of a value, a type or an option of one.
const RIDDLES: [&str; 7] = ["told", "said", "asked", "Of", "That", "Other", "Asked"];

#[test]
fn names_in_code_say_what_a_thing_is() {
    let names = |code: &str| -> Vec<String> {
        let words = code.split(|c: char| !(c.is_alphanumeric() || c == '_'));
        let riddles = words.filter(|word| RIDDLES.contains(word)).map(str::to_owned);
        riddles.chain(code.contains("fn of(").then(|| "fn of".to_owned())).collect()
    };
    assert_eq!(names("let said = asked(); fn of(x: u8) {} is_asked"), ["said", "asked", "fn of"]);
    assert_eq!(names("enum Other { Of(u8), Others }"), ["Other", "Of"]);
    let found: Vec<(PathBuf, Vec<String>)> =
        crate::source::files().into_iter().map(|file| (file.path, names(&file.code))).collect();
    let riddles: Vec<_> = found.iter().filter(|(_, names)| !names.is_empty()).collect();
    assert!(found.len() > 700 && riddles.is_empty(), "{} files: {riddles:?}", found.len());
}

#[test]
fn comments_are_read_line_by_line_and_code_in_them_is_not() {
    let text = "/// A number,\n/// all of\n/// which `asked` holds.\nlet a = 1; // said\n//! It was told.\n";
    let found = comments(text);
    let numbers: Vec<usize> = found.iter().map(|(number, _)| *number).collect();
    assert_eq!(numbers, [1, 5]);
    let phrases = |at: usize| dropped(&spaced(&read_aloud(&found[at].1))).collect::<Vec<_>>();
    assert_eq!([phrases(0), phrases(1)], [["of which"], ["told"]]);
}

#[test]
fn every_help_is_written_in_short_plain_sentences() {
    let bench = Bench::empty();
    let mut open = vec![Vec::<String>::new()];
    let mut found = Vec::new();
    let mut seen = 0;
    while let Some(command) = open.pop() {
        let mut arguments: Vec<&str> = command.iter().map(String::as_str).collect();
        arguments.push("--help");
        let help = bench.done(&arguments);
        let sentences = of_help(&help);
        assert!(!sentences.is_empty(), "{help}");
        found.extend(faults(&format!("replan {}", arguments.join(" ")), &sentences));
        let listed = help.split("\nCommands:\n").nth(1).into_iter().flat_map(str::lines);
        let names = listed
            .take_while(|line| line.starts_with("  "))
            .filter_map(|line| line.strip_prefix("  ")?.split(' ').next())
            // `audit` is a program of its own.
            .filter(|name| !["", "help", "audit"].contains(name));
        open.extend(names.map(|name| [command.clone(), vec![name.to_owned()]].concat()));
        seen += 1;
    }
    assert!(seen > 15, "{seen} commands");
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// Keys of specs that hold sentences of ours, beside those that pages show.
const SENTENCES: [&str; 3] = ["why", "notes", "changed_after_run"];

/// The texts below `value` that stand under a key of [`SENTENCES`]; `is_one` says whether `value` does.
fn own_sentences(value: &toml::Value, is_one: bool, found: &mut Vec<String>) {
    match value {
        toml::Value::String(text) if is_one => found.push(text.clone()),
        toml::Value::Array(all) => all.iter().for_each(|one| own_sentences(one, is_one, found)),
        toml::Value::Table(table) => {
            for (key, value) in table {
                own_sentences(value, SENTENCES.contains(&key.as_str()), found);
            }
        }
        _ => {}
    }
}

#[test]
fn reasons_and_notes_of_specs_are_written_in_short_plain_sentences() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("experiments");
    let mut texts = 0;
    let mut found = Vec::new();
    for folder in fs::read_dir(root).unwrap().map(|entry| entry.unwrap().path()) {
        for path in fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()) {
            if path.extension().is_none_or(|ending| ending != "toml") {
                continue;
            }
            let spec: toml::Value = toml::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
            let mut own = Vec::new();
            own_sentences(&spec, false, &mut own);
            texts += own.len();
            for text in own {
                // A reason is no page: its few sentences have no mean.
                found.extend(faults(&path.display().to_string(), &sentences(&text, true)));
            }
        }
    }
    assert!(texts > 200, "{texts} texts");
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// The captions of a page in Markdown: the paragraphs that follow images, as they are read.
fn captions(page: &str) -> Vec<String> {
    let paragraphs: Vec<&str> = page.split("\n\n").collect();
    let pairs = paragraphs.windows(2).filter(|pair| pair[0].trim().starts_with("!["));
    pairs.map(|pair| read_aloud(pair[1])).collect()
}

/// The captions of tables in the specs of papers.
fn table_captions(root: &Path) -> Vec<String> {
    let papers = fs::read_dir(root.join("experiments")).unwrap().map(|entry| entry.unwrap().path());
    let files = papers.flat_map(|paper| fs::read_dir(paper).unwrap()).map(|entry| entry.unwrap().path());
    let specs = files.filter(|file| file.extension().is_some_and(|ending| ending == "toml"));
    let tables = specs.flat_map(|file| {
        let spec: toml::Table = fs::read_to_string(file).unwrap().parse().unwrap();
        spec.get("table").and_then(|tables| tables.as_array().cloned()).unwrap_or_default()
    });
    tables.filter_map(|table| Some(table.get("caption")?.as_str()?.to_owned())).collect()
}

#[test]
fn every_caption_has_at_most_sixty_words() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let plots = fs::read_dir(root.join("plots")).unwrap().map(|entry| entry.unwrap().path());
    let details = plots.map(|paper| paper.join("details.md")).filter(|path| path.is_file());
    let pages = details.chain([root.join("paper_repro.md")]);
    let mut captions: Vec<String> =
        pages.flat_map(|page| captions(&fs::read_to_string(page).unwrap())).collect();
    captions.extend(table_captions(root));
    let words = |caption: &str| {
        caption.split_whitespace().filter(|word| word.contains(char::is_alphanumeric)).count()
    };
    let long: Vec<String> = captions
        .iter()
        .filter(|caption| words(caption) > 60)
        .map(|caption| format!("{} words: {caption}", words(caption)))
        .collect();
    assert!(captions.len() > 60, "{} captions", captions.len());
    assert!(long.is_empty(), "{}", long.join("\n"));
}

#[test]
fn sentences_end_at_full_stops_and_dropped_words_are_found() {
    let page = "# A head\n\nOne `a.b` by Hart et al. is [short](x.md). It was told; then asked.\n\n    code said\n\n- a name\n";
    let found = of_page(page);
    let counts: Vec<(usize, bool)> = found.iter().map(|one| (one.count(), one.is_whole)).collect();
    assert_eq!(counts, [(8, true), (5, true), (2, false)], "{found:?}");
    assert_eq!(found[1].dropped(), ["told", "asked"]);
    let purpose = of_page("What is kept is a row. It waits so that the clock is alone.");
    assert_eq!([purpose[0].dropped(), purpose[1].dropped()], [["What … is"], ["so that … alone"]]);
    assert_eq!(faults("a", &of_page(&"word ".repeat(36))).len(), 1);
    assert_eq!(faults("a", &of_page(&format!("{}.", "word ".repeat(19).trim()))).len(), 1);
    let help = of_help(
        "Says it\n\nUsage: a\n\nOptions:\n      --quick\n          Few instances\n  -h, --help   Print help\n",
    );
    assert_eq!(help.iter().map(Sentence::count).collect::<Vec<_>>(), [2, 2, 2], "{help:?}");
}
