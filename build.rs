//! Gathers the commands that elements bring with them, so that the language of decks has them without knowing elements:
//! every `*.cards` file below `src/solver/elements`, in the order of their names.
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
    let mut files = Vec::new();
    gather(folder, &mut files)?;
    files.sort_by(|a, b| a.file_name().cmp(&b.file_name()));
    let texts = files.iter().map(fs::read_to_string).collect::<io::Result<Vec<_>>>()?;
    let out = env::var_os("OUT_DIR").ok_or(io::ErrorKind::NotFound)?;
    fs::write(Path::new(&out).join("elements.cards"), texts.join("\n"))
}

/// Adds every `*.cards` file in a folder and in those within it.
fn gather(folder: &Path, files: &mut Vec<PathBuf>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            gather(&path, files)?;
        } else if path.extension().is_some_and(|extension| extension == "cards") {
            files.push(path);
        }
    }
    Ok(())
}
