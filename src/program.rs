//! Which program this is, for whatever it writes.

/// Name, version and commit; the commit with `-dirty` where the sources differ from it.
pub const PROGRAM: &str =
    concat!("barrier-check ", env!("CARGO_PKG_VERSION"), ", commit ", env!("BARRIER_CHECK_COMMIT"));

/// The commit alone.
pub const COMMIT: &str = env!("BARRIER_CHECK_COMMIT");
