//! Large arrays that every step walks over, in memory that is translated in large pages.

/// An array of so many equal numbers. Where it is large, the system is asked to back it with large pages (2 MB instead of 4 kB on
/// x86-64), before it is touched: a step walks over several pages of state for every microsecond, and with small ones a fifteenth of
/// its time can go into finding them (`docs/performance_history.md`).
pub fn repeated<T: Clone>(value: T, count: usize) -> Vec<T> {
    let mut numbers = reserved(count);
    numbers.resize(count, value);
    numbers
}

/// An empty array with room for so many numbers in such pages.
pub fn reserved<T>(count: usize) -> Vec<T> {
    let mut numbers = Vec::with_capacity(count);
    ask_for_large_pages(numbers.spare_capacity_mut());
    numbers
}

/// Lets the system have large arrays back as soon as they are gone. The C library else keeps what has been freed beside what has not,
/// the more of it the larger the arrays that it has seen freed, and most of what a run is set up with is gone when it begins: on two
/// ranks a crushed can took 1.3 times the memory (`docs/performance_history.md`). To be called before there are threads.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
pub fn give_back() {
    // SAFETY: a number of the C library's allocator is set, which says from what size on it asks the system for each piece of memory
    // apart. That must not happen while others set such numbers, and no other thread is there yet.
    unsafe { libc::mallopt(libc::M_MMAP_THRESHOLD, 1 << 20) };
}

#[cfg(not(all(target_os = "linux", target_env = "gnu")))]
pub fn give_back() {}

/// Below this size, bytes, an array fills too few large pages to gain by them.
#[cfg(target_os = "linux")]
const LARGE: usize = 8 << 20;

/// Asks for large pages; what the system makes of it changes nothing that the program sees.
#[cfg(target_os = "linux")]
fn ask_for_large_pages<T>(memory: &mut [std::mem::MaybeUninit<T>]) {
    const PAGE: usize = 4096;
    let range = memory.as_mut_ptr_range();
    let begin = (range.start as usize).next_multiple_of(PAGE);
    let end = range.end as usize / PAGE * PAGE;
    if size_of_val(memory) < LARGE {
        return;
    }
    // SAFETY: whole pages inside memory that is borrowed here. This advice changes neither their contents nor the right to use
    // them, and where a system does not know it (or has larger pages, to which the range is no fit) the call fails and does nothing.
    unsafe { libc::madvise(begin as *mut libc::c_void, end - begin, libc::MADV_HUGEPAGE) };
}

#[cfg(not(target_os = "linux"))]
fn ask_for_large_pages<T>(_: &mut [std::mem::MaybeUninit<T>]) {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrays_of_any_size_hold_what_they_should() {
        for count in [0, 1, 1000, 3_000_000] {
            let numbers = repeated(7.5f64, count);
            assert!(numbers.len() == count && numbers.iter().all(|&x| x == 7.5));
            assert!(reserved::<f64>(count).capacity() >= count);
        }
    }
}
