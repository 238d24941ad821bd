//! A paper's report as one HTML page that needs nothing else: claims, the paper's tables beside ours, figures, and
//! replays of stored trials.
//!
//! Text stands in the page as HTML, so that it reads and prints without a script. Figures and replays are packed, and a
//! script unpacks them when they come into view. Nothing is computed here: numbers are those of the analysis and of
//! stored trials, and frames of an arm are placed by its family.

mod body;
mod curves;
mod html;
mod interpretations;
mod packed;
mod replay;
mod replies;

use crate::analysis::across::Stored;
use crate::analysis::across::by_interpretation::by_interpretation;
use crate::analysis::evidence::Evidence;
use crate::analysis::tally::Counts;
use crate::analysis::verdict::Verdicts;
use crate::render::output::Output;
use crate::render::{RenderError, state};
use body::Body;
pub use html::escaped;
use packed::{Pack, Packed};
use rayon::prelude::*;
use study::{Inputs, StudyError};

/// The most that a page may take, in bytes.
pub const PAGE_BYTES: usize = 4_000_000;

/// The viewer, bundled from `viewer/` with three.js and uPlot by `bundle/build.sh`.
pub const VIEWER: &str = include_str!("bundle/viewer.js");
/// Its style, uPlot's at its head.
pub const STYLE: &str = include_str!("bundle/viewer.css");
/// The licences of what is bundled.
pub const LICENCES: &str = include_str!("bundle/LICENCES.txt");

/// Why a page could not be made.
#[derive(Debug, thiserror::Error)]
pub enum PageError {
    /// A table for which something is not stored.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// A family that cannot be built again.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// What did not fit could not be packed.
    #[error("replays that do not fit cannot be put into a zip: {0}")]
    Zip(#[from] zip::result::ZipError),
    /// What is shown could not be packed.
    #[error("what is shown cannot be packed: {0}")]
    Pack(#[from] std::io::Error),
}

/// A page, and what did not fit.
pub struct Page {
    /// The page.
    pub html: String,
    /// A zip archive of the replays that did not fit.
    pub rest: Option<Vec<u8>>,
}

/// The page of the paper of `evidence`. `stored` has the outcomes under its interpretations, `figures` has the SVG of
/// each figure by its name. `rest` is the name of the file for replays that do not fit. `has_index` says whether the
/// index of all papers lies beside the page.
///
/// # Errors
/// [`PageError`].
pub fn page(
    evidence: &Evidence<'_>,
    verdicts: &Verdicts,
    stored: &Stored,
    figures: &[Output],
    inputs: &Inputs,
    rest: &str,
    has_index: bool,
) -> Result<Page, PageError> {
    let explored = by_interpretation(evidence.paper, verdicts, stored);
    let replays = replay::all(evidence, verdicts, inputs)?;
    let curves = curves::all(evidence, verdicts)?;
    let named: Vec<&str> =
        replays.iter().flat_map(|replay| replay.trials.iter().map(String::as_str)).collect();
    let looked_at = explored.as_ref().map_or(0, |explored| explored.interpretations.len());
    let body = Body { evidence, verdicts, replayed: &named, explored: looked_at, has_index };
    let mut text = opening(&evidence.paper.id, &evidence.paper.source.title);
    text += &body.html(&state(evidence, verdicts), curves.is_empty())?;
    let mut packs = Vec::new();
    let mut pack = Pack::new(PAGE_BYTES, text.len() + VIEWER.len() + STYLE.len());
    if let Some(explored) = &explored {
        let bytes = serde_json::to_vec(explored).expect("texts and finite numbers");
        packs.push(pack.always(Packed::new("interpretations", "", &bytes)?));
    }
    for curve in &curves {
        let bytes = serde_json::to_vec(curve).expect("plain numbers");
        packs.push(pack.always(Packed::new("curves", &curve.title, &bytes)?));
    }
    for figure in figures {
        packs.push(pack.always(Packed::new("figure", &figure.name, &figure.bytes)?));
    }
    for made in in_order(&replays, |replay| {
        let bytes = replay.json();
        Ok((Packed::new("replay", &replay.title, &bytes)?, bytes))
    })? {
        packs.extend(pack.if_it_fits(made.0, made.1));
    }
    let (left, rest_bytes) = pack.rest()?;
    text += &closing(&packs, left, rest);
    Ok(Page { html: text, rest: rest_bytes })
}

/// What `of` makes of each of `all`, made at once on every core and given in their order; the first error in that order.
fn in_order<T: Sync, U: Send>(
    all: &[T],
    of: impl Fn(&T) -> Result<U, PageError> + Sync + Send,
) -> Result<Vec<U>, PageError> {
    let made: Vec<Result<U, PageError>> = all.par_iter().map(of).collect();
    made.into_iter().collect()
}

/// The page of a paper whose run cannot be shown, for the reason `why`.
pub fn unread(id: &str, title: &str, why: &str) -> String {
    let notice = format!("<p class=\"state\">Nothing is shown: {}.</p>", escaped(why.trim_end_matches('.')));
    format!("{}{notice}<main><h1>{}</h1></main></body></html>\n", opening(id, title), escaped(title))
}

/// A paper's line of the index.
pub struct IndexLine {
    /// Its name.
    pub id: String,
    /// Its title.
    pub title: String,
    /// What was found, in a sentence or two.
    pub finding: String,
    /// What its page begins with, where its run is not the study's own.
    pub state: String,
    /// How many sentences and rows have each verdict; `None` if they cannot be read.
    pub counts: Option<Counts>,
}

/// The index page, with a link to each of `papers`.
pub fn index(papers: &[IndexLine]) -> String {
    let row = |IndexLine { id, title, finding, state, counts }: &IndexLine| {
        let state = Some(escaped(state)).filter(|state| !state.is_empty());
        let last: Vec<String> = state.into_iter().chain(counts.as_ref().map(body::coloured)).collect();
        format!(
            "<tr><td><a href=\"{0}.html\">{0}</a></td><td>{1}</td><td>{2}</td><td>{3}</td></tr>\n",
            escaped(id),
            escaped(title),
            escaped(finding),
            last.join(" "),
        )
    };
    let rows: String = papers.iter().map(row).collect();
    let head = "<thead><tr><th>paper</th><th>title</th><th>what was found</th><th>sentences and rows</th></tr></thead>";
    format!(
        "{}<main><h1>What the papers claim and what we found</h1><div class=\"wide\"><table class=\"plain index\">{head}<tbody>\n{rows}</tbody></table></div></main></body></html>\n",
        opening("replan", "What the papers claim and what we found")
    )
}

fn opening(id: &str, title: &str) -> String {
    format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{}: {}</title>\n<style>{STYLE}</style></head>\n<body>\n",
        escaped(id),
        escaped(title)
    )
}

/// What is packed, what did not fit, and the viewer.
fn closing(packs: &[Packed], left: usize, rest: &str) -> String {
    let rest = escaped(rest);
    let beside = if left > 0 {
        format!(
            "{left} more replays did not fit: they are in <a href=\"{rest}\">{rest}</a>, which lies beside this page. Unpack it and \
             open one here"
        )
    } else {
        "Open a replay from a file".to_owned()
    };
    let mut text = String::new();
    if packs.iter().any(Packed::is_replay) {
        text += &format!(
            "<p class=\"rest\">{beside}: <input type=\"file\" id=\"more\" accept=\".json\" aria-label=\"a replay's file\"></p>\n"
        );
    }
    text.extend(packs.iter().map(Packed::html));
    // The bundle is ours and holds no closing tag: its test says so.
    text + &format!(
        "<script>{VIEWER}</script>\n<!--\n{}\n-->\n</body></html>\n",
        LICENCES.replace("--", "- -")
    )
}

#[cfg(test)]
mod tests;
