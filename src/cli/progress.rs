//! Progress on the terminal, and Ctrl-C.

use super::{Failure, counted};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal as _;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use study::runner::Progress;

/// Set by the first Ctrl-C: units at work, or the figure at work, are finished.
static STOP: AtomicBool = AtomicBool::new(false);

/// The flag that Ctrl-C sets; a second Ctrl-C ends the process at once.
pub fn stop_flag() -> &'static AtomicBool {
    let handler = || {
        if STOP.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
        eprintln!("stopping at the next safe point; press Ctrl-C again to stop at once");
    };
    // Without a handler Ctrl-C still ends the process, and the journal keeps what was done.
    let _ = ctrlc::set_handler(handler);
    &STOP
}

/// Says on a terminal what is about to be done, as it may take longer than a second.
pub fn doing(what: &str) {
    if std::io::stderr().is_terminal() {
        eprintln!("{what} …");
    }
}

/// Ends the command here if Ctrl-C was pressed; `kept` says what is not lost.
pub fn safe_point(stop: &AtomicBool, kept: &str) -> Result<(), Failure> {
    if stop.load(Ordering::Relaxed) {
        let message = format!("interrupted: {kept}; the same command goes on from there");
        return Err(Failure::new(130, message));
    }
    Ok(())
}

/// A bar with the time left on a terminal, one line per pass elsewhere.
#[derive(Default)]
pub struct Bar {
    bar: Mutex<Option<(String, ProgressBar)>>,
}

impl Progress for Bar {
    fn begin(&self, what: &str, total: usize) {
        let bar = ProgressBar::with_draw_target(Some(total as u64), ProgressDrawTarget::stderr_with_hz(10));
        let style = ProgressStyle::with_template("{msg} [{bar:30}] {pos}/{len} units, {eta} left");
        bar.set_style(style.expect("the template is well formed").progress_chars("=> "));
        bar.set_message(what.to_owned());
        *self.bar.lock().expect("no thread panics while it holds the bar") = Some((what.to_owned(), bar));
    }

    fn step(&self) {
        if let Some((_, bar)) = &*self.bar.lock().expect("no thread panics while it holds the bar") {
            bar.inc(1);
        }
    }

    fn end(&self) {
        let Some((what, bar)) = self.bar.lock().expect("no thread panics while it holds the bar").take()
        else {
            return;
        };
        let (done, seconds) = (bar.position(), bar.elapsed().as_secs_f64());
        bar.finish_and_clear();
        if std::io::stderr().is_terminal() || done > 0 {
            eprintln!("{what}: {} in {seconds:.1} s", counted(done as usize, ["unit", "units"]));
        }
    }
}
