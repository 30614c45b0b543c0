//! FORTRAN unformatted sequential records: each with its length in bytes before and behind it.

/// What is wrong with a file of records.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Broken(pub String);

/// The records of a file, from first to last.
pub(super) struct Records<'b> {
    bytes: &'b [u8],
    at: usize,
    big_endian: bool,
    /// Bytes of the mark before and behind each record.
    mark: usize,
}

/// Bytes of the title, which is the first record.
const TITLE: usize = 80;

impl<'b> Records<'b> {
    /// Finds byte order and size of marks from the two around the title.
    ///
    /// # Errors
    ///
    /// The marks around the title fit no byte order and no size.
    pub fn new(bytes: &'b [u8]) -> Result<Records<'b>, Broken> {
        for (big_endian, mark) in [(false, 4), (true, 4), (false, 8), (true, 8)] {
            let file = Records { bytes, at: 0, big_endian, mark };
            if file.length_at(0) == Some(TITLE) && file.length_at(mark + TITLE) == Some(TITLE) {
                return Ok(file);
            }
        }
        Err(Broken("the file ends within its first record, or its marks do not fit".into()))
    }

    /// Whether nothing follows.
    pub fn is_at_end(&self) -> bool {
        self.at >= self.bytes.len()
    }

    /// The next record's bytes.
    fn next(&mut self, what: &str) -> Result<&'b [u8], Broken> {
        if self.is_at_end() {
            return Err(Broken(format!("the file ends before {what}")));
        }
        let length = self.length_at(self.at).ok_or_else(|| Broken(format!("the file is cut short before {what}")))?;
        let start = self.at + self.mark;
        let end = start.checked_add(length).ok_or_else(|| Broken(format!("the length of {what} makes no sense")))?;
        let record =
            self.bytes.get(start..end).ok_or_else(|| Broken(format!("the file is cut short within {what}")))?;
        match self.length_at(end) {
            None => Err(Broken(format!("the file is cut short within {what}"))),
            Some(again) if again != length => {
                Err(Broken(format!("{what}: the record says {length} bytes before and {again} behind")))
            }
            Some(_) => {
                self.at = end + self.mark;
                Ok(record)
            }
        }
    }

    /// A record that nobody needs; an empty array has one too.
    ///
    /// # Errors
    ///
    /// The file ends before the record or within it, or its marks disagree.
    pub fn skip(&mut self, what: &str) -> Result<(), Broken> {
        self.next(what).map(|_| ())
    }

    /// So many integers, of 4 or 8 bytes each.
    ///
    /// # Errors
    ///
    /// The record is broken, or is not as long as so many integers.
    pub fn integers(&mut self, count: usize, what: &str) -> Result<Vec<i64>, Broken> {
        self.all_integers(&[count], what)
    }

    /// All integers of a record, which has one of these counts of them.
    ///
    /// # Errors
    ///
    /// The record is broken, or is as long as none of these counts of integers.
    pub fn all_integers(&mut self, counts: &[usize], what: &str) -> Result<Vec<i64>, Broken> {
        let record = self.next(what)?;
        let width = width(record, counts, what)?;
        Ok(self
            .words(record, width)
            .map(|word| if width == 4 { i64::from(word as u32 as i32) } else { word as i64 })
            .collect())
    }

    /// So many reals, of 4 or 8 bytes each.
    ///
    /// # Errors
    ///
    /// The record is broken, or is not as long as so many reals.
    pub fn reals(&mut self, count: usize, what: &str) -> Result<Vec<f64>, Broken> {
        let record = self.next(what)?;
        let width = width(record, &[count], what)?;
        let real = |word: u64| if width == 4 { f64::from(f32::from_bits(word as u32)) } else { f64::from_bits(word) };
        Ok(self.words(record, width).map(real).collect())
    }

    /// One integer that counts what follows.
    ///
    /// # Errors
    ///
    /// The record is broken, or holds no count.
    pub fn count(&mut self, what: &str) -> Result<usize, Broken> {
        let values = self.integers(1, what)?;
        usize::try_from(values[0]).map_err(|_| Broken(format!("{what} is {}", values[0])))
    }

    /// A text of so many characters, without the blanks behind it.
    ///
    /// # Errors
    ///
    /// The record is broken, or has another length.
    pub fn text(&mut self, length: usize, what: &str) -> Result<String, Broken> {
        let record = self.next(what)?;
        if record.len() != length {
            return Err(Broken(format!("{what} has {} bytes where {length} belong", record.len())));
        }
        Ok(trimmed(record))
    }

    /// So many texts of eight characters.
    ///
    /// # Errors
    ///
    /// The record is broken, or has another length.
    pub fn texts(&mut self, count: usize, what: &str) -> Result<Vec<String>, Broken> {
        let record = self.next(what)?;
        if record.len() != 8 * count {
            return Err(Broken(format!("{what}: {} bytes where {} belong", record.len(), 8 * count)));
        }
        Ok(record.chunks_exact(8).map(trimmed).collect())
    }

    /// The length that the mark at a byte tells.
    fn length_at(&self, at: usize) -> Option<usize> {
        let bytes = self.bytes.get(at..at.checked_add(self.mark)?)?;
        usize::try_from(self.word(bytes)).ok()
    }

    fn words<'r>(&'r self, record: &'r [u8], width: usize) -> impl Iterator<Item = u64> + 'r {
        // An empty array still has a record, of one word that means nothing.
        let words = if width == 0 { &[][..] } else { record };
        words.chunks_exact(width.max(1)).map(|word| self.word(word))
    }

    fn word(&self, bytes: &[u8]) -> u64 {
        let join = |word, byte: &u8| word << 8 | u64::from(*byte);
        if self.big_endian { bytes.iter().fold(0, join) } else { bytes.iter().rev().fold(0, join) }
    }
}

/// Bytes of a word in a record that has one of these counts of words; 0 for an empty array.
fn width(record: &[u8], counts: &[usize], what: &str) -> Result<usize, Broken> {
    if counts == [0] {
        return Ok(0);
    }
    let fits = |width: &usize| counts.iter().any(|count| count.checked_mul(*width) == Some(record.len()));
    [4, 8].into_iter().find(fits).ok_or_else(|| {
        let counts: Vec<String> = counts.iter().map(usize::to_string).collect();
        Broken(format!("{what}: {} bytes, which are not {} numbers", record.len(), counts.join(" or ")))
    })
}

fn trimmed(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).trim_matches(['\0', ' ']).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_of_either_order_and_size_are_found() {
        for (big_endian, mark) in [(false, 4), (true, 4), (false, 8), (true, 8)] {
            let mut bytes = Vec::new();
            let mut put = |record: &[u8]| {
                let length = record.len() as u64;
                let length = if big_endian { length.to_be_bytes() } else { length.to_le_bytes() };
                let length = if big_endian { &length[8 - mark..] } else { &length[..mark] };
                bytes.extend([length, record, length].concat());
            };
            put(&[b' '; 80]);
            put(&if big_endian { (-7i32).to_be_bytes() } else { (-7i32).to_le_bytes() });
            put(&if big_endian { 0.5f64.to_be_bytes() } else { 0.5f64.to_le_bytes() });
            put(&[0; 4]);
            let mut file = Records::new(&bytes).expect("marks");
            assert_eq!(file.text(80, "title"), Ok(String::new()));
            assert_eq!(file.integers(1, "one"), Ok(vec![-7]));
            assert_eq!(file.reals(1, "one"), Ok(vec![0.5]));
            assert_eq!(file.integers(0, "none"), Ok(vec![]));
            assert!(file.is_at_end() && file.skip("more").is_err());
        }
    }
}
