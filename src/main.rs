//! The `replan` command. All logic lives in the library.

fn main() {}
