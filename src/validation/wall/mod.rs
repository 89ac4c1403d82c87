//! Grains on rigid walls.
