//! Progress, and Ctrl-C.
//!
//! Progress goes to standard error, so that standard output holds results alone. Work that may take longer than a
//! second begins with a line that ends in an ellipsis, on a terminal or not. Work done in units has a bar on a
//! terminal. Elsewhere a line says how far it is, at most once in [`PRINTED_EVERY_S`].

use super::{Failure, counted};
use base::text::shown;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{IsTerminal as _, Write as _};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use study::runner::Progress;

/// Set by the first Ctrl-C: units at work, or the figure at work, are finished.
static STOP: AtomicBool = AtomicBool::new(false);

/// The flag that Ctrl-C sets; a second Ctrl-C ends the process at once.
pub fn stop_flag() -> &'static AtomicBool {
    let handler = || {
        if STOP.swap(true, Ordering::Relaxed) {
            end_at_once();
        }
        external::interrupt();
        note("stopping at the next safe point; press Ctrl-C again to stop at once");
        std::thread::spawn(|| {
            std::thread::sleep(PATIENCE);
            end_at_once();
        });
    };
    // Without a handler Ctrl-C still ends the process, and the journal keeps what was done.
    let _ = ctrlc::set_handler(handler);
    &STOP
}

/// How long work may take to end by itself after an interrupt.
const PATIENCE: Duration = Duration::from_secs(1);

/// Ends the process and every planner from outside. Files are whole, whenever that is.
fn end_at_once() -> ! {
    external::name_survivors(&external::end_planners());
    note("replan: interrupted: what was finished is kept; the same command goes on from there");
    std::process::exit(130);
}

/// Announces work that may take longer than a second.
pub fn doing(what: &str) {
    note(&format!("{} …", shown(what)));
}

/// Writes a line to standard error. A reader that closed the pipe early is no reason to fail.
pub fn note(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// How often it prints how far units are, where there is no terminal for a bar.
const PRINTED_EVERY_S: u64 = 10;

/// Ends the command here if Ctrl-C was pressed; `kept` says what is not lost.
pub fn safe_point(stop: &AtomicBool, kept: &str) -> Result<(), Failure> {
    if stop.load(Ordering::Relaxed) {
        let message = format!("interrupted: {kept}; the same command goes on from there");
        return Err(Failure::new(130, message));
    }
    Ok(())
}

/// A bar with the time left on a terminal; elsewhere a line at the beginning, at the end, and now and then between.
#[derive(Default)]
pub struct Bar {
    bar: Mutex<Option<Pass>>,
}

/// A pass through units that is at work.
struct Pass {
    what: String,
    bar: ProgressBar,
    /// When it last printed how far it is, in seconds since it began.
    printed_s: u64,
}

impl Pass {
    /// Says how far it is, if that is due.
    fn print(&mut self) {
        let now_s = self.bar.elapsed().as_secs();
        if self.bar.is_hidden() && now_s >= self.printed_s + PRINTED_EVERY_S {
            self.printed_s = now_s;
            let all = self.bar.length().unwrap_or_default();
            doing(&format!("{}: {} of {}", self.what, self.bar.position(), counted(all as usize, UNITS)));
        }
    }
}

/// What passes go through.
const UNITS: [&str; 2] = ["unit", "units"];

impl Progress for Bar {
    fn begin(&self, what: &str, total: usize) {
        let bar = ProgressBar::with_draw_target(Some(total as u64), ProgressDrawTarget::stderr_with_hz(10));
        let style = ProgressStyle::with_template("{msg} [{bar:30}] {pos}/{len} units, {eta} left");
        bar.set_style(style.expect("the template is well formed").progress_chars("=> "));
        bar.set_message(shown(what).into_owned());
        if bar.is_hidden() && total > 0 {
            doing(&format!("{what}: {}", counted(total, UNITS)));
        }
        let pass = Pass { what: what.to_owned(), bar, printed_s: 0 };
        *self.bar.lock().expect("no thread panics while it holds the bar") = Some(pass);
    }

    fn step(&self) {
        if let Some(pass) = &mut *self.bar.lock().expect("no thread panics while it holds the bar") {
            pass.bar.inc(1);
            pass.print();
        }
    }

    fn end(&self) {
        let Some(Pass { what, bar, .. }) =
            self.bar.lock().expect("no thread panics while it holds the bar").take()
        else {
            return;
        };
        let done = bar.position();
        let seconds = bar.elapsed().as_secs_f64();
        bar.finish_and_clear();
        if std::io::stderr().is_terminal() || done > 0 {
            note(&format!("{}: {} in {seconds:.1} s", shown(&what), counted(done as usize, UNITS)));
        }
    }
}
