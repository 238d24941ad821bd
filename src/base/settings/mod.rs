//! TOML as it was written: documents that know where each value stands, and the schema of what may stand there.
//!
//! Settings travel from a spec to their entry as the table that was written; only that entry's file knows the fields.
//! Its type says what is accepted. Files are checked against the derived JSON Schema ([`Document::read`]), `replan
//! list` prints it ([`describe`]), and editors receive it. All faults of a table are found at once, each with the file,
//! line and column of its own key or value, also after the table was handed through several floors.

mod accepted;
pub mod describe;
mod document;
mod error;
mod likeness;
mod nearest;
mod place;
mod reader;
mod renamed;
mod schema;
mod spanned;
mod table;
mod validate;

pub use accepted::{Accepted, NoSettings, generator, schema_of};
pub use document::Document;
pub use error::{Faults, SettingsError};
pub use nearest::{did_you_mean, none_called};
pub use place::Place;
pub use renamed::{first_word, in_first_words, renamed};
pub use spanned::{AnyTable, AnyValue, Spanned};
pub use table::{Part, Settings};

#[cfg(test)]
mod tests;
