//! What a run asks the system for at most, counted byte by byte, so that the figure is the same on every machine.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// The system's allocator, which notes what is held now and what was held at most.
struct Counting;

static HELD: AtomicUsize = AtomicUsize::new(0);
static MOST: AtomicUsize = AtomicUsize::new(0);

// SAFETY: all calls go on to the system's allocator as they came; the counters do not touch its memory.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        MOST.fetch_max(HELD.fetch_add(layout.size(), Relaxed) + layout.size(), Relaxed);
        // SAFETY: the caller's promises are the system's conditions.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        HELD.fetch_sub(layout.size(), Relaxed);
        // SAFETY: as above.
        unsafe { System.dealloc(memory, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Most bytes that a short run of the crushed can holds beyond what was held before, for each of its elements.
fn bytes_per_element(refine: usize, ranks: usize) -> f64 {
    let deck = include_str!("../decks/can_crush.i").replace("TERMINATION TIME, 4.3E-3", "TERMINATION TIME, 2.E-7");
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).display().to_string();
    std::fs::write(path("can.i"), deck).expect("a deck");
    std::fs::write(path("can.mesh"), include_str!("../meshes/can_crush.mesh")).expect("a recipe");
    let before = HELD.load(Relaxed);
    MOST.store(before, Relaxed);
    let (refined, ranks) = (refine.to_string(), ranks.to_string());
    let options = ["--refine", &refined, "--ranks", &ranks, "--quiet", "--output", &path("can")].map(str::to_string);
    let call = ["urto".to_string(), "run".to_string(), path("can.i")].into_iter().chain(options);
    urto::cli::main(call.map(Into::into));
    assert!(folder.path().join("can.e").is_file(), "the run has written its results");
    (MOST.load(Relaxed) - before) as f64 / (7152 * refine.pow(3)) as f64
}

/// A third of the nodes of this can are on the surface, where contact keeps most of a kilobyte for each. A second rank adds what is
/// at the border and its own numbers of the surface, which ranks share as far as it does not change.
#[test]
fn bytes_of_an_element_mesh_and_contact_included() {
    for (ranks, most) in [(1, 1000.0), (2, 1040.0)] {
        let bytes = bytes_per_element(2, ranks);
        println!("crushed can, 57,216 elements, {ranks} ranks: {bytes:.0} bytes an element at most");
        assert!(bytes < most, "{bytes}");
    }
}
