//! STL meshes: where they are looked for, and their vertices, binary and text.

use crate::file;
use std::path::{Path, PathBuf};

/// How many folders above a file its meshes are looked for in.
const ABOVE: usize = 4;

/// Where a mesh is looked for: `package://name/rest` and `model://name/rest` as `rest` and as `name/rest`, in the file's folder and in
/// those above it, nearest first; all else in the file's folder alone.
pub(super) fn places(urdf: &Path, given: &str) -> Vec<PathBuf> {
    let folder = urdf.parent().unwrap_or(Path::new(""));
    let Some(below) = ["package://", "model://"].iter().find_map(|scheme| given.strip_prefix(scheme)) else {
        return vec![folder.join(given.strip_prefix("file://").unwrap_or(given))];
    };
    let rest = below.split_once('/').map_or(below, |(_, rest)| rest);
    let above = std::iter::successors(Some(folder.to_owned()), |folder| Some(folder.join("..")));
    above.take(ABOVE + 1).flat_map(|folder| [folder.join(rest), folder.join(below)]).collect()
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
    let is_binary = facets(bytes).is_some_and(|count| bytes.len() as u64 == 84 + 50 * u64::from(count));
    let mut found = if is_binary { binary(&bytes[84..]) } else { text(bytes)? };
    if let Some(vertex) = found.iter().find(|vertex| vertex.iter().any(|x| !x.is_finite())) {
        let [x, y, z] = vertex;
        return Err(format!("it has the vertex {x} {y} {z}; finite numbers are accepted"));
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

/// How many facets the head of a binary file says there are.
fn facets(bytes: &[u8]) -> Option<u32> {
    bytes.get(80..84).map(|count| u32::from_le_bytes([count[0], count[1], count[2], count[3]]))
}

fn binary(facets: &[u8]) -> Vec<[f64; 3]> {
    let number = |bytes: &[u8]| f64::from(f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]));
    let vertex = |bytes: &[u8]| [number(bytes), number(&bytes[4..]), number(&bytes[8..])];
    facets.chunks_exact(50).flat_map(|facet| [12, 24, 36].map(|at| vertex(&facet[at..]))).collect()
}

fn text(bytes: &[u8]) -> Result<Vec<[f64; 3]>, String> {
    let text = std::str::from_utf8(bytes).ok().filter(|text| text.trim_start().starts_with("solid"));
    let Some(text) = text.filter(|text| facets(bytes).is_none() || text.contains("vertex")) else {
        let found = bytes.len();
        return Err(match facets(bytes) {
            Some(count) => {
                let wanted = 84 + 50 * u64::from(count);
                format!(
                    "its head says {count} facets, which take {wanted} bytes as a binary STL file; it has {found}"
                )
            }
            None => format!(
                "its {found} bytes are too few for a binary STL file, and its text does not begin with `solid`"
            ),
        });
    };
    let mut found = Vec::new();
    for (line, text) in (1..).zip(text.lines()) {
        let mut words = text.split_whitespace();
        if words.next() != Some("vertex") {
            continue;
        }
        let numbers: Vec<f64> = words.map_while(|word| word.parse().ok()).collect();
        let vertex = <[f64; 3]>::try_from(numbers);
        found.push(vertex.map_err(|_| {
            format!("line {line}: found `{}`; `vertex x y z` is accepted", crate::text::brief(text.trim()))
        })?);
    }
    Ok(found)
}
