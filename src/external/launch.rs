//! Starts planners: through a launcher where there is one, so that they end with this process, and directly elsewhere.

use super::linux::{close_control_group, launcher_command, limit_memory};
use std::io::{self, PipeReader, Read as _, pipe};
use std::os::fd::AsRawFd as _;
use std::process::{Child, Command};
use std::sync::mpsc::{Sender, channel};
use std::sync::{LazyLock, Mutex};
use std::thread;

/// Starts the planner `mark` and gives its process and its output; `complete` adds what a command has beside arguments and output.
///
/// # Errors
/// Those of the system; a missing program is one that was not found.
pub(super) fn launch(
    name: &str,
    arguments: &[String],
    mark: &str,
    memory_bytes: u64,
    complete: impl FnOnce(&mut Command),
) -> io::Result<(Child, PipeReader)> {
    let (output, out) = pipe()?;
    let Some(mut command) = launcher_command(mark, memory_bytes, out.as_raw_fd()) else {
        let mut command = Command::new(name);
        complete(command.args(arguments).stdout(out));
        let child = command.spawn()?;
        limit_memory(child.id(), memory_bytes);
        return Ok((child, output));
    };
    // The launcher's end is closed when it becomes the planner; before that it writes the number of an error, if there is one.
    let (mut begun, hears) = pipe()?;
    complete(command.arg(name).args(arguments).stdout(hears));
    let mut error = String::new();
    let started = spawn_for_good(command).and_then(|mut child| {
        begun.read_to_string(&mut error)?;
        match error.parse() {
            Ok(code) => child.wait().and(Err(io::Error::from_raw_os_error(code))),
            Err(_) => Ok(child),
        }
    });
    drop(out);
    if started.is_err() {
        close_control_group(mark);
    }
    Ok((started?, output))
}

/// Starts a process from a thread that never ends: a death signal is sent when the thread ends that started its process.
fn spawn_for_good(command: Command) -> io::Result<Child> {
    static STARTER: LazyLock<Mutex<Sender<(Command, Sender<io::Result<Child>>)>>> = LazyLock::new(|| {
        let (sender, orders) = channel::<(Command, Sender<io::Result<Child>>)>();
        thread::spawn(move || {
            for (mut command, reply) in orders {
                // Whoever ordered waits for it.
                let _ = reply.send(command.spawn());
            }
        });
        Mutex::new(sender)
    });
    let (reply, child) = channel();
    let starter = STARTER.lock().expect("no thread panics while it orders");
    starter.send((command, reply)).expect("the thread does not end");
    drop(starter);
    child.recv().expect("every order has a reply")
}
