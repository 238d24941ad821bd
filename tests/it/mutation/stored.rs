//! Damaged files of a stored run.
