//! Everything that is drawn for a paper: figures, tables, numbers, the report's chapter.

use super::figure::{self, Scene};
use super::report::{self, Chapter, Page, Undrawn};
use super::results;
use super::tables;
use super::vector::{Figure, Provenance};
use super::{RenderError, marks};
use crate::analysis::evidence::{Evidence, Run};
use crate::analysis::verdict::Verdicts;
use base::settings::did_you_mean;
use base::text::shown;
use rayon::prelude::*;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use study::StudyError;
use study::spec::FigureSpec;
use study::store::write_whole;

/// A file as it should be written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Output {
    /// Its name in the paper's folder of plots.
    pub name: String,
    /// Its content.
    pub bytes: Vec<u8>,
}

/// Every file of a paper, but for figures that could not be drawn.
#[derive(Debug, Default)]
pub struct Outputs {
    /// The files.
    pub files: Vec<Output>,
    /// What is missing among them.
    pub undrawn: Vec<Undrawn>,
}

/// Every file for the paper of `evidence`, or only those whose name without its ending is `only`; `stop` is looked at
/// before each figure.
///
/// # Errors
/// [`RenderError::Interrupted`] if `stop` is set; two numbers with one macro name. A figure that cannot be drawn from what is
/// stored, or whose labels collide, costs that figure alone.
pub fn outputs(
    evidence: &Evidence<'_>,
    verdicts: &Verdicts,
    only: Option<&str>,
    stop: &AtomicBool,
) -> Result<Outputs, RenderError> {
    let paper = evidence.paper;
    let is_wanted = |id: &str| only.is_none_or(|only| only == id);
    let marks = marks(paper, verdicts);
    let (mut outputs, undrawn) = figures(evidence, verdicts, is_wanted, stop)?;
    let mut write = |id: &str, text: String| {
        outputs.push(Output { name: format!("{id}.tex"), bytes: text.into_bytes() });
    };
    for table in paper.tables.iter().filter(|table| is_wanted(&table.id)) {
        write(&table.id, tables::table(evidence, table, verdicts)?);
    }
    for table in paper.results.iter().filter(|table| is_wanted(table.id.get_ref())) {
        write(table.id.get_ref(), results::latex(evidence, table, &marks)?);
    }
    if is_wanted("numbers") {
        write("numbers", tables::numbers(evidence, verdicts)?);
    }
    if outputs.is_empty() && undrawn.is_empty() {
        let ids: Vec<&str> = paper.figure_ids().chain(paper.table_ids()).chain(["numbers"]).collect();
        let wanted = only.unwrap_or_default();
        let hint = did_you_mean(wanted, ids.iter().copied());
        let ids = ids.join(", ");
        return Err(RenderError::NotStored {
            what: format!("a figure or table `{wanted}`{hint}; there are {ids}"),
        });
    }
    Ok(Outputs { files: outputs, undrawn })
}

/// The files of the figures that are wanted, and those that cannot be drawn.
fn figures(
    evidence: &Evidence<'_>,
    verdicts: &Verdicts,
    is_wanted: impl Fn(&str) -> bool,
    stop: &AtomicBool,
) -> Result<(Vec<Output>, Vec<Undrawn>), RenderError> {
    let mut outputs = Vec::new();
    let mut undrawn = Vec::new();
    let figures = evidence.runs().flat_map(|run| run.study.figures.iter().map(move |spec| (run, spec)));
    let figures: Vec<_> = figures.filter(|(_, spec)| is_wanted(spec.id.get_ref())).collect();
    let draw = |(run, spec): &(&Run<'_>, &FigureSpec)| {
        if stop.load(Ordering::Relaxed) {
            return Err(RenderError::Interrupted);
        }
        Ok(named_figure_outputs(&Scene { evidence, run, verdicts }, spec)
            .map_err(|error| Undrawn { id: spec.id.get_ref().clone(), why: error.to_string() }))
    };
    for drawn in figures.par_iter().map(draw).collect::<Result<Vec<_>, _>>()? {
        match drawn {
            Ok(drawn) => outputs.extend(drawn),
            Err(missing) => undrawn.push(missing),
        }
    }
    Ok((outputs, undrawn))
}

/// `drawn` unless labels of it overlap or leave the page.
fn fit_to_print(id: &str, drawn: Figure) -> Result<Figure, RenderError> {
    if drawn.flaws.is_empty() {
        return Ok(drawn);
    }
    Err(RenderError::Flawed { figure: id.to_owned(), flaws: drawn.flaws.join("; ") })
}

/// [`figure_outputs`], with the figure's name in errors.
fn named_figure_outputs(scene: &Scene<'_>, spec: &FigureSpec) -> Result<Vec<Output>, RenderError> {
    figure_outputs(scene, spec).map_err(|source| RenderError::Figure {
        figure: format!("{}:{}", scene.run.study.name, spec.id.get_ref()),
        source: Box::new(source),
    })
}

/// The files of one figure: SVG, PNG and, where it has one, its table.
fn figure_outputs(scene: &Scene<'_>, spec: &FigureSpec) -> Result<Vec<Output>, RenderError> {
    let paper = scene.evidence.paper;
    let run = scene.run;
    let id = spec.id.get_ref();
    let kind = figure::build(spec, run.study, paper)?;
    let sheet = kind.draw(scene)?;
    let notes: Vec<String> =
        paper.source.stand_ins.clone().into_iter().chain(marks(paper, scene.verdicts)).collect();
    let sheet = sheet.noted(notes.join(" "));
    let drawn = sheet.draw(&Provenance {
        command: format!("replan render {} --only {id}", paper.id),
        spec_hash: run.study.spec_hash(),
        title: spec.caption.clone(),
    })?;
    let drawn = fit_to_print(id, drawn)?;
    let mut outputs = vec![
        Output { name: format!("{id}.svg"), bytes: drawn.svg.into_bytes() },
        Output { name: format!("{id}.png"), bytes: drawn.png },
    ];
    let table_id = spec.table.as_deref().unwrap_or(id);
    if let Some(table) = kind.table(
        scene,
        &format!("{}:{table_id}", paper.id),
        spec.table_caption.as_ref().unwrap_or(&spec.caption),
    )? {
        let text = table.latex(&tables::made(paper, id, scene.verdicts))?;
        outputs.push(Output { name: format!("{table_id}.tex"), bytes: text.into_bytes() });
    }
    Ok(outputs)
}

/// Writes `outputs` into `folder`, and takes away the pictures of figures that could not be drawn: they would show something else.
///
/// # Errors
/// [`StudyError::Io`].
pub fn write(folder: &Path, outputs: &Outputs) -> Result<(), StudyError> {
    for name in pictures(outputs).filter(|name| folder.join(name).is_file()) {
        let path = folder.join(name);
        fs::remove_file(&path)
            .map_err(StudyError::io(&path, "removing a figure that cannot be drawn any more"))?;
    }
    outputs.files.iter().try_for_each(|output| write_whole(&folder.join(&output.name), &output.bytes))
}

/// The names of the pictures that are missing among `outputs`.
fn pictures(outputs: &Outputs) -> impl Iterator<Item = String> {
    outputs.undrawn.iter().flat_map(|undrawn| ["svg", "png"].map(|ending| format!("{}.{ending}", undrawn.id)))
}

/// The files among `outputs` that are missing in `folder` or hold something else.
pub fn stale(folder: &Path, outputs: &[Output]) -> Vec<PathBuf> {
    let is_stale =
        |output: &&Output| fs::read(folder.join(&output.name)).is_ok_and(|bytes| bytes == output.bytes);
    outputs.iter().filter(|output| !is_stale(output)).map(|output| folder.join(&output.name)).collect()
}

/// The files in `folder` that are not among `outputs`, and that neither the report at `path`, outside the chapter of `paper`, nor
/// a file that stands beside the chapter speaks of. They are what an earlier state of the paper left behind.
///
/// # Errors
/// Those of [`report::besides`].
pub fn left_over(
    folder: &Path,
    outputs: &[Output],
    path: &Path,
    paper: &str,
) -> Result<Vec<PathBuf>, StudyError> {
    let mut elsewhere = report::besides(path, paper)?;
    for file in beside(folder) {
        elsewhere += &format!("{paper}/{file}");
        let text = fs::read_to_string(folder.join(file)).unwrap_or_default();
        elsewhere += &text.replace("](", &format!("]({paper}/"));
    }
    let mut names: Vec<String> = fs::read_dir(folder)
        .into_iter()
        .flatten()
        .flatten()
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .filter(|name| outputs.iter().all(|output| output.name != *name))
        .filter(|name| !elsewhere.contains(&format!("{paper}/{name}")))
        .collect();
    names.sort();
    Ok(names.into_iter().map(|name| folder.join(name)).collect())
}

/// The file in a paper's folder of plots that says what an independent judge found.
pub const CROSSCHECK: &str = "crosscheck.md";

/// The files in `folder` that other commands write and to which the chapter leads.
fn beside(folder: &Path) -> Vec<&'static str> {
    if folder.join(CROSSCHECK).is_file() { vec![CROSSCHECK] } else { Vec::new() }
}

/// The paper's chapter of the report at `path`, and its details in `folder`.
///
/// # Errors
/// A table for which something is not stored.
pub fn chapter(
    path: &Path,
    evidence: &Evidence<'_>,
    verdicts: &Verdicts,
    folder: &Path,
    undrawn: &[Undrawn],
) -> Result<(Chapter, Output), RenderError> {
    let above = path.parent().unwrap_or(Path::new(""));
    let plots = folder.strip_prefix(above).unwrap_or(folder);
    let back =
        "../".repeat(plots.components().count()) + &path.file_name().unwrap_or_default().to_string_lossy();
    let plots =
        plots.components().map(|part| part.as_os_str().to_string_lossy()).collect::<Vec<_>>().join("/");
    let page = Page { evidence, verdicts, plots, undrawn, beside: beside(folder) };
    let details = shown(&page.details(&back)).into_owned();
    let details = Output { name: "details.md".to_owned(), bytes: details.into_bytes() };
    Ok((page.chapter()?, details))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::canvas::{Canvas, Type};
    use crate::render::style::{TextSize, Width};

    #[test]
    fn a_figure_whose_labels_collide_is_refused_by_name() {
        for (apart_pt, flawed) in [(30.0, false), (3.0, true)] {
            let mut canvas = Canvas::new(Width::Single, 40.0);
            for (text, x) in [("one", 10.0), ("two", 10.0 + apart_pt)] {
                canvas.text([x, 20.0], text, &Type::regular(TextSize::TICK));
            }
            let command = String::new();
            let spec_hash = String::new();
            let title = String::new();
            let drawn = canvas.finish(&Provenance { command, spec_hash, title }).unwrap();
            match fit_to_print("fig7", drawn) {
                Ok(_) => assert!(!flawed, "{apart_pt} pt apart"),
                Err(error) => {
                    let message = error.to_string();
                    assert!(flawed && message.contains("`fig7`") && message.contains("`two` overlaps `one`"));
                }
            }
        }
    }
}
