//! Many grains.
