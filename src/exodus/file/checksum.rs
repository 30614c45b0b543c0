//! A mark at the end of a file that shows whether any byte before it has changed since.
//!
//! The mark is the words [`WORDS`] and the CRC-64/XZ (ECMA-182, reflected) of all bytes before it, most significant byte
//! first. It stands behind what the header of a netCDF file promises, where readers do not look. A cyclic check finds
//! every change of up to 64 bits in a row, thus of any one byte, and misses other changes once in 2^64.

use std::fs::{File, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::Path;

/// What the mark begins with.
const WORDS: &[u8; 16] = b"urto CRC-64/XZ: ";
/// Bytes of the mark.
const MARK: u64 = WORDS.len() as u64 + 8;
/// The generator polynomial of ECMA-182, lowest power in the highest bit.
const POLYNOMIAL: u64 = 0xC96C_5795_D787_0F42;

/// What the end of a file says of the rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Seal {
    /// Every byte is as it was written.
    Sound,
    /// Something has changed.
    Broken,
    /// There is no mark.
    Missing,
}

/// Puts the mark at the end of a finished file.
///
/// # Errors
/// When the file cannot be read or written.
pub fn seal(path: &Path) -> io::Result<()> {
    let mut file = OpenOptions::new().read(true).write(true).open(path)?;
    let length = file.metadata()?.len();
    let sum = checksum(&mut file, length)?;
    file.seek(SeekFrom::Start(length))?;
    file.write_all(WORDS)?;
    file.write_all(&sum.to_be_bytes())
}

/// Holds a file against its mark.
///
/// # Errors
/// When the file cannot be read.
pub fn check(path: &Path) -> io::Result<Seal> {
    crate::common::files::regular(path)?;
    let mut file = File::open(path)?;
    let Some(length) = file.metadata()?.len().checked_sub(MARK) else { return Ok(Seal::Missing) };
    file.seek(SeekFrom::Start(length))?;
    let (mut words, mut sum) = ([0; WORDS.len()], [0; 8]);
    file.read_exact(&mut words)?;
    if words != *WORDS {
        return Ok(Seal::Missing);
    }
    file.read_exact(&mut sum)?;
    file.seek(SeekFrom::Start(0))?;
    let same = checksum(&mut file, length)? == u64::from_be_bytes(sum);
    Ok(if same { Seal::Sound } else { Seal::Broken })
}

/// The checksum of the first `length` bytes from where the file stands.
fn checksum(file: &mut File, length: u64) -> io::Result<u64> {
    let mut buffer = vec![0; 1 << 18];
    let mut sum = !0;
    let mut part = file.take(length);
    loop {
        match part.read(&mut buffer)? {
            0 => return Ok(!sum),
            count => sum = advance(sum, &buffer[..count]),
        }
    }
}

/// The register after more bytes: eight at a time, each with a table of what it does from its place.
fn advance(register: u64, bytes: &[u8]) -> u64 {
    let (words, rest) = bytes.as_chunks::<8>();
    let register = words.iter().fold(register, |register, word| {
        let mixed = (register ^ u64::from_le_bytes(*word)).to_le_bytes();
        (0..8).fold(0, |sum, place| sum ^ TABLES[7 - place][usize::from(mixed[place])])
    });
    rest.iter().fold(register, |register, byte| TABLES[0][usize::from(register as u8 ^ byte)] ^ (register >> 8))
}

/// `TABLES[n][b]`: the register that a byte b leaves when n zero bytes follow it.
static TABLES: [[u64; 256]; 8] = tables();

const fn tables() -> [[u64; 256]; 8] {
    let mut tables = [[0; 256]; 8];
    let mut byte = 0;
    while byte < 256 {
        let mut register = byte as u64;
        let mut bit = 0;
        while bit < 8 {
            register = if register & 1 == 1 { (register >> 1) ^ POLYNOMIAL } else { register >> 1 };
            bit += 1;
        }
        tables[0][byte] = register;
        byte += 1;
    }
    let mut entry = 256;
    while entry < 8 * 256 {
        let (table, byte) = (entry / 256, entry % 256);
        let before: u64 = tables[table - 1][byte];
        tables[table][byte] = (before >> 8) ^ tables[0][(before & 0xFF) as usize];
        entry += 1;
    }
    tables
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The check value of the catalogue of cyclic checks for CRC-64/XZ, and of lengths around the width of eight.
    #[test]
    fn the_checksum_is_that_of_the_standard() {
        let of = |bytes: &[u8]| !advance(!0, bytes);
        assert_eq!(of(b"123456789"), 0x995D_C9BB_DF19_39FA);
        assert_eq!(of(b""), 0);
        let text = b"The quick brown fox jumps over the lazy dog";
        let one_by_one = text.iter().fold(!0, |register, &byte| advance(register, &[byte]));
        assert_eq!(of(text), !one_by_one);
    }

    #[test]
    fn a_file_is_held_against_its_mark() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("file");
        std::fs::write(&path, b"some bytes").expect("a file");
        assert_eq!(check(&path).expect("readable"), Seal::Missing);
        seal(&path).expect("writable");
        assert_eq!(check(&path).expect("readable"), Seal::Sound);
        let good = std::fs::read(&path).expect("readable");
        for place in 0..good.len() {
            let mut bad = good.clone();
            bad[place] ^= 0x10;
            std::fs::write(&path, &bad).expect("writable");
            let expected = if (10..26).contains(&place) { Seal::Missing } else { Seal::Broken };
            assert_eq!(check(&path).expect("readable"), expected, "byte {place}");
        }
    }
}
