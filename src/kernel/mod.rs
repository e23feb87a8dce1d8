//! Models over slices of f32, for speed.
