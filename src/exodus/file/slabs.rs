//! Processes that read one file together: each reads a slab of every large array, and all tell each other.
//!
//! With many processes the file would otherwise be read as many times as there are processes.

use std::ops::Range;

use crate::exodus::file::arrays::Reason;

/// Arrays from this many bytes on are read in slabs; smaller ones are faster read by all.
const SMALLEST: usize = 1 << 18;

/// Processes that do the same at the same time.
pub trait Together {
    /// The number of this process, and how many there are.
    fn place(&self) -> (usize, usize);
    /// Hands the bytes of every process, in their order, to every process.
    fn all(&mut self, own: Vec<u8>, take: &mut dyn FnMut(&[u8]));

    /// Whether every process says the same number, and none says `None`.
    fn same(&mut self, own: Option<u64>) -> bool {
        let said = own.map_or(Vec::new(), |number| number.to_le_bytes().to_vec());
        let mut same = own.is_some();
        self.all(said.clone(), &mut |other| same &= other == said);
        same
    }
}

/// A number in the bytes that travel.
pub(in crate::exodus) trait Travels: Copy {
    fn pack(self) -> [u8; 8];
    fn unpack(bytes: [u8; 8]) -> Self;
}

impl Travels for i64 {
    fn pack(self) -> [u8; 8] {
        self.to_le_bytes()
    }
    fn unpack(bytes: [u8; 8]) -> Self {
        i64::from_le_bytes(bytes)
    }
}

impl Travels for f64 {
    fn pack(self) -> [u8; 8] {
        self.to_le_bytes()
    }
    fn unpack(bytes: [u8; 8]) -> Self {
        f64::from_le_bytes(bytes)
    }
}

/// The length of an array's first dimension, where it is worth reading in slabs.
pub(in crate::exodus) fn rows(shape: Option<Vec<usize>>) -> Option<usize> {
    let shape = shape?;
    let size = shape.iter().fold(8usize, |size, &length| size.saturating_mul(length));
    shape.first().copied().filter(|_| size >= SMALLEST)
}

/// An array of so many rows, of which each process reads its share.
///
/// # Errors
/// On every process that of the first which could not read.
pub(in crate::exodus) fn read<T: Travels>(
    together: &mut dyn Together,
    rows: usize,
    part: impl FnOnce(Range<usize>) -> Result<Vec<T>, Reason>,
) -> Result<Vec<T>, Reason> {
    let (place, count) = together.place();
    let start = |place: usize| (rows as u128 * place as u128 / count as u128) as usize;
    let own = match part(start(place)..start(place + 1)) {
        Ok(values) => [0].into_iter().chain(values.into_iter().flat_map(T::pack)).collect(),
        Err(reason) => [1].into_iter().chain(reason.into_bytes()).collect(),
    };
    let mut found: Result<Vec<T>, Reason> = Ok(Vec::new());
    together.all(own, &mut |bytes| match (&mut found, bytes.split_first()) {
        (Ok(values), Some((0, bytes))) => values.extend(bytes.as_chunks::<8>().0.iter().map(|&eight| T::unpack(eight))),
        (Ok(_), Some((_, words))) => found = Err(String::from_utf8_lossy(words).into_owned()),
        _ => {}
    });
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exodus::{read_mesh, read_mesh_together, write_mesh};
    use std::sync::{Arc, Barrier, Mutex};

    /// Threads that play processes.
    struct Threads {
        place: usize,
        said: Arc<Mutex<Vec<Vec<u8>>>>,
        meeting: Arc<Barrier>,
    }

    impl Together for Threads {
        fn place(&self) -> (usize, usize) {
            (self.place, self.said.lock().unwrap().len())
        }

        fn all(&mut self, own: Vec<u8>, take: &mut dyn FnMut(&[u8])) {
            self.said.lock().unwrap()[self.place] = own;
            self.meeting.wait();
            let said = self.said.lock().unwrap().clone();
            self.meeting.wait();
            said.iter().for_each(|bytes| take(bytes));
        }
    }

    fn together<T: Send>(count: usize, work: impl Fn(&mut Threads) -> T + Sync) -> Vec<T> {
        let (said, meeting) = (Arc::new(Mutex::new(vec![Vec::new(); count])), Arc::new(Barrier::new(count)));
        std::thread::scope(|scope| {
            let threads: Vec<_> = (0..count)
                .map(|place| {
                    let mut own = Threads { place, said: said.clone(), meeting: meeting.clone() };
                    scope.spawn({
                        let work = &work;
                        move || work(&mut own)
                    })
                })
                .collect();
            threads.into_iter().map(|thread| thread.join().unwrap()).collect()
        })
    }

    #[test]
    fn slabs_make_the_whole() {
        for (count, rows) in [(1, 10), (3, 10), (4, 3), (5, 0)] {
            let values = |range: Range<usize>| Ok(range.map(|i| i as i64 * 7 - 3).collect::<Vec<_>>());
            for found in together(count, |threads| read(threads, rows, values)) {
                assert_eq!(found, values(0..rows), "{count} processes, {rows} rows");
            }
        }
    }

    #[test]
    fn all_hear_of_the_one_that_cannot_read() {
        let found = together(3, |threads| {
            let place = threads.place;
            read(threads, 30, |_| if place == 1 { Err("a hole".into()) } else { Ok(vec![1.5]) })
        });
        assert!(found.iter().all(|found| *found == Err("a hole".to_string())));
    }

    #[test]
    fn numbers_are_compared() {
        let say = |numbers: [Option<u64>; 3]| together(3, |threads| threads.same(numbers[threads.place]));
        assert_eq!(say([Some(5); 3]), [true; 3]);
        assert_eq!(say([Some(5), Some(6), Some(5)]), [false; 3]);
        assert_eq!(say([Some(5), None, Some(5)]), [false; 3]);
    }

    /// Large enough for slabs of coordinates, connectivity and numbers.
    #[test]
    fn a_mesh_read_together_is_the_mesh() {
        let recipe = "TITLE\n box\nBOX, 1, 0., 0., 0., 1., 2., 3., 35, 35, 35\nNODE SET PLANE, 1, X, 0.\n\
                      SIDE SET FACE, 100, 1, TOP\n";
        let mesh = crate::mesher::make(recipe, "recipe", 1).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("box.g");
        write_mesh(&path, &mesh).unwrap();
        let whole = read_mesh(&path).unwrap();
        for found in together(3, |threads| read_mesh_together(&path, threads)) {
            assert!(found.unwrap() == whole);
        }
        // A file that not all have alike is read by each alone, and errors are everybody's own.
        let missing = folder.path().join("none.g");
        let found = together(3, |threads| {
            let path = if threads.place == 1 { &missing } else { &path };
            read_mesh_together(path, threads).map(|mesh| mesh == whole)
        });
        assert!(found[0] == Ok(true) && found[1].is_err() && found[2] == Ok(true));
    }
}
