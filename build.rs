//! Gathers the commands that elements bring with them, so that the language of decks has them without knowing elements:
//! every `*.cards` file in a folder of `src/solver/elements`, in the order of their names.
//!
//! `URTO_WIDTHS=portable` compiles the kernels for the portable vectors only: the same bits and the same tests in a fraction of
//! the time to build, for work on the code; a program made so is slow.

use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    println!("cargo::rustc-check-cfg=cfg(one_width)");
    println!("cargo::rerun-if-env-changed=URTO_WIDTHS");
    if env::var("URTO_WIDTHS").is_ok_and(|widths| widths == "portable") {
        println!("cargo::rustc-cfg=one_width");
    }
    let folder = Path::new("src/solver/elements");
    println!("cargo::rerun-if-changed={}", folder.display());
    let mut files: Vec<PathBuf> = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            let inside = fs::read_dir(path)?.map(|entry| entry.map(|entry| entry.path()));
            files.extend(inside.collect::<io::Result<Vec<_>>>()?);
        }
    }
    files.retain(|file| file.extension().is_some_and(|extension| extension == "cards"));
    files.sort();
    let texts = files.iter().map(fs::read_to_string).collect::<io::Result<Vec<_>>>()?;
    let out = env::var_os("OUT_DIR").ok_or(io::ErrorKind::NotFound)?;
    fs::write(Path::new(&out).join("elements.cards"), texts.join("\n"))
}
