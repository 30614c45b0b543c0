//! What several parts have in common and no crate has: sets, paths, large arrays, shared lists, numbers as text, vectors, words.

pub mod disjoint_sets;
pub mod files;
pub mod memory;
pub mod numbers;
pub mod shared;
pub mod vector;
pub mod vocabulary;
