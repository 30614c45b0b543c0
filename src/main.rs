//! The program: arguments in, exit code out.

use std::process::ExitCode;

fn main() -> ExitCode {
    urto::common::memory::give_back();
    urto::cli::main(std::env::args_os())
}
