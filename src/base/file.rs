//! Files that others wrote, read whole.
//!
//! A spec or a command line may name anything: a device never ends, and a pipe may never begin. So only regular files
//! are read, and none larger than [`MOST_BYTES`].

use crate::text;
use std::fs::File;
use std::io::{self, Error, Read};
use std::path::Path;

/// The most bytes of a file: a map of the largest accepted size, four bytes a cell, has room.
pub const MOST_BYTES: u64 = 1 << 29;

/// The bytes of the file at `path`.
///
/// # Errors
/// What the system refuses; something that is no regular file; one that is larger than [`MOST_BYTES`].
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    // Checked before it is opened: opening a pipe waits for who writes into it.
    let found = std::fs::metadata(path)?;
    if !found.is_file() && !found.is_dir() {
        return Err(Error::other("it is a device, a pipe or a socket; a regular file is accepted"));
    }
    read_all(&mut File::open(path)?)
}

/// How a message goes on that begins with the name of a file that is not there.
pub fn missing(path: &Path) -> &'static str {
    let mut at = path.to_owned();
    let mut follows = || std::fs::read_link(&at).map(|to| at = at.with_file_name("").join(to)).is_ok();
    // Systems follow 40 links or fewer.
    let followed = (0..40).take_while(|_| follows()).count();
    match followed {
        0 => "does not exist",
        40 => "is a link, and links go in a circle",
        _ => "is a link to a file that does not exist",
    }
}

/// As [`read`], as text: see [`text::decoded`].
///
/// # Errors
/// As [`read`]; another encoding than UTF-8.
pub fn read_text(path: &Path) -> io::Result<String> {
    text::decoded(read(path)?).map_err(Error::other)
}

/// All that `from` gives: a file, a pipe, standard input.
///
/// # Errors
/// What the system refuses; more than [`MOST_BYTES`].
pub fn read_all(from: &mut impl Read) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    from.take(MOST_BYTES + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MOST_BYTES {
        let most = MOST_BYTES >> 20;
        return Err(Error::other(format!("it holds more than {most} MiB; at most {most} MiB are accepted")));
    }
    Ok(bytes)
}

/// Refuses what stands at `path` in place of a file of our own: a link leads elsewhere, a pipe keeps who opens it waiting.
///
/// # Errors
/// Something else than a regular file, or nothing, stands there.
pub fn check_own(path: &Path) -> io::Result<()> {
    match std::fs::symlink_metadata(path) {
        Ok(found) if !found.is_file() => Err(Error::other(
            "a link, a pipe or a folder stands there; remove it: a regular file is accepted",
        )),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_regular_files_are_read() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a");
        std::fs::write(&file, "text").unwrap();
        assert_eq!(read_text(&file).unwrap(), "text");
        assert!(read(folder.path()).is_err(), "a folder");
        let message = read(Path::new("/dev/zero")).unwrap_err().to_string();
        assert_eq!(message, "it is a device, a pipe or a socket; a regular file is accepted");
    }

    #[test]
    fn links_that_lead_nowhere_are_no_missing_files() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        for (to, link) in
            [("itself", "itself"), ("there", "here"), ("here", "there"), ("gone", "last"), ("last", "first")]
        {
            std::os::unix::fs::symlink(to, at(link)).unwrap();
        }
        let found = ["itself", "here", "first", "gone"].map(|name| missing(&at(name)));
        let circle = "is a link, and links go in a circle";
        assert_eq!(found, [circle, circle, "is a link to a file that does not exist", "does not exist"]);
    }

    #[test]
    fn what_never_ends_is_refused_with_what_is_accepted() {
        let message = read_all(&mut io::repeat(0)).unwrap_err().to_string();
        assert_eq!(message, "it holds more than 512 MiB; at most 512 MiB are accepted");
    }
}
