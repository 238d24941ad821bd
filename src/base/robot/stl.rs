//! STL meshes: where they are looked for, and their vertices, binary and text.

use crate::file;
use std::path::{Path, PathBuf};

/// Where a mesh is looked for: `package://name/rest` beside the file, and in the folders above it.
pub(super) fn places(urdf: &Path, given: &str) -> Vec<PathBuf> {
    let folder = urdf.parent().unwrap_or(Path::new(""));
    match given.strip_prefix("package://") {
        Some(below) => {
            let rest = below.split_once('/').map_or(below, |(_, rest)| rest);
            let up = folder.join("..");
            vec![folder.join(rest), folder.join(below), up.join(rest), up.join("..").join(below)]
        }
        None => vec![folder.join(given.strip_prefix("file://").unwrap_or(given))],
    }
}

/// The distinct vertices of the mesh in the file at `path`.
///
/// # Errors
/// What the system refuses; what is wrong with it.
pub(super) fn read(path: &Path) -> Result<Vec<[f64; 3]>, String> {
    vertices(&file::read(path).map_err(|error| error.to_string())?)
}

/// The distinct vertices of the mesh in `bytes`, in an order of their own.
///
/// # Errors
/// What is wrong with it.
fn vertices(bytes: &[u8]) -> Result<Vec<[f64; 3]>, String> {
    let facets = bytes.get(80..84).map(|count| u32::from_le_bytes([count[0], count[1], count[2], count[3]]));
    let is_binary = facets.is_some_and(|count| bytes.len() as u64 == 84 + 50 * u64::from(count));
    let mut found = if is_binary { binary(&bytes[84..]) } else { text(bytes)? };
    if let Some(vertex) = found.iter().find(|vertex| vertex.iter().any(|x| !x.is_finite())) {
        return Err(format!("it has the vertex {vertex:?}; finite numbers are accepted"));
    }
    found.sort_by(|a, b| {
        a.iter().zip(b).map(|(x, y)| x.total_cmp(y)).find(|o| o.is_ne()).unwrap_or(std::cmp::Ordering::Equal)
    });
    found.dedup();
    if found.len() < 4 {
        return Err(format!("it has {} distinct vertices; at least 4 are accepted", found.len()));
    }
    Ok(found)
}

fn binary(facets: &[u8]) -> Vec<[f64; 3]> {
    let number = |bytes: &[u8]| f64::from(f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]));
    let vertex = |bytes: &[u8]| [number(bytes), number(&bytes[4..]), number(&bytes[8..])];
    facets.chunks_exact(50).flat_map(|facet| [12, 24, 36].map(|at| vertex(&facet[at..]))).collect()
}

fn text(bytes: &[u8]) -> Result<Vec<[f64; 3]>, String> {
    let text = std::str::from_utf8(bytes).ok().filter(|text| text.trim_start().starts_with("solid"));
    let Some(text) = text else {
        return Err(format!(
            "its {} bytes are neither a binary STL file (84 bytes and 50 a facet) nor a text that begins with `solid`",
            bytes.len()
        ));
    };
    let mut found = Vec::new();
    for (line, text) in (1..).zip(text.lines()) {
        let mut words = text.split_whitespace();
        if words.next() != Some("vertex") {
            continue;
        }
        let numbers: Vec<f64> = words.map_while(|word| word.parse().ok()).collect();
        let vertex = <[f64; 3]>::try_from(numbers);
        found.push(
            vertex
                .map_err(|_| format!("line {line}: found `{}`; `vertex x y z` is accepted", text.trim()))?,
        );
    }
    Ok(found)
}
