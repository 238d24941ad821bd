//! Questions, models and comparison without Python.
