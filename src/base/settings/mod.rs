//! TOML as it was written: documents that can say where in them a value stands, and what may stand there.
//!
//! Settings travel from a spec to the entry that understands them as the table they were written as; only that
//! entry's file knows the fields. Its type says what is accepted: the derived JSON Schema is what files are held
//! against ([`Document::read`]), what `replan list` prints ([`describe`]) and what editors are given. All faults of a table
//! are found at once, each with the file, line and column of its own key or value, also after the table was handed
//! through several floors.

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
