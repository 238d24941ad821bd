//! Planners from outside: programs in any language that speak lines of JSON on standard input and output.
//!
//! [`message`] is the protocol and [`world`] has the worlds as data; `docs/PLANNER_PROTOCOL.md` documents both.
//! [`describe`] turns the engine's worlds into data, and [`Space`] answers questions about them. [`Process`] is a
//! running program under limits. [`solve`] is one conversation: a query, questions, a result. Nothing here knows
//! studies or records; the clock is the caller's.

mod answer;
mod clear;
mod describe;
mod end;
mod interrupt;
mod launch;
#[cfg_attr(not(target_os = "linux"), path = "not_linux.rs")]
mod linux;
pub mod message;
mod process;
mod talk;
pub mod world;

pub use answer::{MOST_QUESTIONS, QuestionCounts, Space, Unanswered};
pub use describe::describe;
pub use end::{end_planners, is_living, name_survivors};
pub use interrupt::{interrupt, is_interrupted};
pub use linux::launcher;
pub use process::{Clock, Process, Program, Start, read_message};
pub use talk::{End, Query, Talk, greet, solve};
