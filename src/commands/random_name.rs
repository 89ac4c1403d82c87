//! Names that nobody can guess: of a folder, of a page, of who may ask a server.

use std::io;

/// Two hexadecimal digits for each of `BYTES` random bytes of the operating system. Fails where the system gives none.
pub fn random_name<const BYTES: usize>() -> io::Result<String> {
    let mut bytes = [0; BYTES];
    getrandom::fill(&mut bytes)
        .map_err(|error| io::Error::other(format!("the system gives no random numbers: {error}")))?;
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}
