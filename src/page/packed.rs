//! Data that a script unpacks: gzip in base64, as long as the page stays within its limit. The rest goes into a zip.

use super::PageError;
use super::html::escaped;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::GzEncoder;
use std::io::{Cursor, Write as _};
use zip::write::SimpleFileOptions;

/// Something packed, ready to stand in a page.
pub struct Packed {
    kind: &'static str,
    name: String,
    base64: String,
}

impl Packed {
    /// `bytes`, packed.
    ///
    /// # Errors
    /// Packing that the system refused.
    pub fn new(kind: &'static str, name: &str, bytes: &[u8]) -> Result<Self, PageError> {
        let mut gzip = GzEncoder::new(Vec::new(), Compression::best());
        gzip.write_all(bytes)?;
        Ok(Self { kind, name: name.to_owned(), base64: STANDARD.encode(gzip.finish()?) })
    }

    /// Whether it is a replay.
    pub fn is_replay(&self) -> bool {
        self.kind == "replay"
    }

    /// It as an element of the page.
    pub fn html(&self) -> String {
        format!(
            "<script type=\"application/octet-stream\" data-kind=\"{}\" data-name=\"{}\">{}</script>\n",
            self.kind,
            escaped(&self.name),
            self.base64
        )
    }
}

/// Packs things until the page is full.
pub struct Pack {
    room: usize,
    rest: Vec<(String, Vec<u8>)>,
}

impl Pack {
    /// For a page of at most `limit` bytes, `taken` of them spoken for.
    pub fn new(limit: usize, taken: usize) -> Self {
        // What stands around the packed things takes a little as well.
        Self { room: limit.saturating_sub(taken + limit / 50), rest: Vec::new() }
    }

    /// Packs it even if there is no room left.
    pub fn always(&mut self, packed: Packed) -> Packed {
        self.room = self.room.saturating_sub(packed.html().len());
        packed
    }

    /// It if there is room; else the `bytes` that were packed go to the rest.
    pub fn if_it_fits(&mut self, packed: Packed, bytes: Vec<u8>) -> Option<Packed> {
        let size = packed.html().len();
        if size <= self.room {
            self.room -= size;
            return Some(packed);
        }
        self.rest.push((packed.name, bytes));
        None
    }

    /// How much did not fit, and a zip of it.
    ///
    /// # Errors
    /// Packing that the system refused.
    pub fn rest(self) -> Result<(usize, Option<Vec<u8>>), PageError> {
        if self.rest.is_empty() {
            return Ok((0, None));
        }
        let mut archive = zip::ZipWriter::new(Cursor::new(Vec::new()));
        // Without a time, so that equal runs give equal bytes.
        let options = SimpleFileOptions::default().last_modified_time(zip::DateTime::default());
        for (index, (name, bytes)) in self.rest.iter().enumerate() {
            let name: String =
                name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
            archive.start_file(format!("{index:04}-{name}.json"), options)?;
            archive.write_all(bytes)?;
        }
        Ok((self.rest.len(), Some(archive.finish()?.into_inner())))
    }
}
