//! Files of our own: eight bytes that name what they are, the version of their format and the CRC-32 of what follows (four bytes
//! each, the lowest first), and the content.

/// Why a file is not what it should be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Broken {
    /// Something else altogether.
    Foreign,
    /// The same in another version of its format.
    Format(u32),
    /// Cut short or changed.
    Damaged,
}

const NUMBER: usize = 4;

/// `body` with its head.
pub fn seal(name: &[u8; 8], format: u32, body: &[u8]) -> Vec<u8> {
    [name.as_slice(), &format.to_le_bytes(), &crc32fast::hash(body).to_le_bytes(), body].concat()
}

/// What [`seal`] was given, if nothing has happened to it since.
pub fn unseal<'a>(name: &[u8; 8], format: u32, bytes: &'a [u8]) -> Result<&'a [u8], Broken> {
    let (head, rest) = bytes.split_at_checked(name.len()).ok_or(Broken::Foreign)?;
    if head != name {
        return Err(Broken::Foreign);
    }
    let (version, rest) = number(rest).ok_or(Broken::Damaged)?;
    if version != format {
        return Err(Broken::Format(version));
    }
    let (sum, body) = number(rest).ok_or(Broken::Damaged)?;
    if crc32fast::hash(body) == sum { Ok(body) } else { Err(Broken::Damaged) }
}

fn number(bytes: &[u8]) -> Option<(u32, &[u8])> {
    let (number, rest) = bytes.split_first_chunk::<NUMBER>()?;
    Some((u32::from_le_bytes(*number), rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_of_any_bit_and_a_cut_anywhere_are_seen() {
        let good = seal(b"SOMEFILE", 7, b"what it says");
        assert_eq!(unseal(b"SOMEFILE", 7, &good), Ok(&b"what it says"[..]));
        assert_eq!(unseal(b"SOMEFILE", 8, &good), Err(Broken::Format(7)));
        assert_eq!(unseal(b"ANOTHER.", 7, &good), Err(Broken::Foreign));
        for length in 0..good.len() {
            assert!(unseal(b"SOMEFILE", 7, &good[..length]).is_err(), "{length}");
        }
        for bit in 0..8 * good.len() {
            let mut flipped = good.clone();
            flipped[bit / 8] ^= 1 << (bit % 8);
            assert!(unseal(b"SOMEFILE", 7, &flipped).is_err(), "{bit}");
        }
    }
}
