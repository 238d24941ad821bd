use super::*;
use base::hash::sha256;
use std::fs;
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src/page")
}

#[test]
fn the_viewer_was_bundled_from_what_stands_beside_it() {
    let viewer = folder().join("viewer");
    let entries = fs::read_dir(&viewer).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<PathBuf> =
        entries.filter(|path| path.extension().is_some_and(|e| e == "js")).collect();
    files.sort();
    files.extend([viewer.join("style.css"), folder().join("bundle/package.json")]);
    let bytes: Vec<u8> = files.iter().flat_map(|file| fs::read(file).unwrap()).collect();
    let built_from = fs::read_to_string(folder().join("bundle/built-from.sha256")).unwrap();
    assert_eq!(sha256(&bytes), built_from.trim(), "run src/page/bundle/build.sh and commit what it writes");
}

#[test]
fn the_bundle_is_as_it_was_written() {
    let written = fs::read_to_string(folder().join("bundle/written.sha256")).unwrap();
    let listed: Vec<(&str, &str)> = written.lines().map(|line| line.split_once("  ").unwrap()).collect();
    assert_eq!(
        listed.iter().map(|(_, name)| *name).collect::<Vec<_>>(),
        ["viewer.js", "viewer.css", "LICENCES.txt"]
    );
    for (hash, name) in listed {
        let bytes = fs::read(folder().join("bundle").join(name)).unwrap();
        assert_eq!(sha256(&bytes), hash, "{name} was edited; src/page/bundle/build.sh writes it again");
    }
}

#[test]
fn nothing_in_the_viewer_ends_the_script_it_stands_in() {
    assert!(!VIEWER.contains("</script") && !STYLE.contains("</style"));
    assert!(LICENCES.contains("MIT") && LICENCES.contains("three") && LICENCES.contains("uplot"));
}

#[test]
fn a_run_that_cannot_be_shown_is_reported_in_the_first_line() {
    let page = unread("zhang", "A <script> & more", "data/runs/zhang: <no> verdicts");
    let body = page.split("<body>\n").nth(1).unwrap();
    assert!(
        body.starts_with("<p class=\"state\">Nothing is shown: data/runs/zhang: &lt;no&gt; verdicts.</p>"),
        "{body}"
    );
    assert!(!page.contains("A <script>"), "{page}");
}

#[test]
fn what_does_not_fit_goes_into_the_zip() {
    let mut pack = Pack::new(3_000, 0);
    let numbers: Vec<u8> = (0..4_000_u32).flat_map(|n| n.wrapping_mul(2_654_435_761).to_le_bytes()).collect();
    let mut fits = |name: &str, bytes: &[u8]| {
        pack.if_it_fits(Packed::new("replay", name, bytes).unwrap(), bytes.to_vec()).is_some()
    };
    assert!(fits("small", b"{}") && !fits("large/one", &numbers));
    let (left, rest) = pack.rest().unwrap();
    let mut archive = zip::ZipArchive::new(std::io::Cursor::new(rest.unwrap())).unwrap();
    assert_eq!((left, archive.len()), (1, 1));
    let mut found = Vec::new();
    std::io::Read::read_to_end(&mut archive.by_index(0).unwrap(), &mut found).unwrap();
    assert_eq!(found, numbers);
}
