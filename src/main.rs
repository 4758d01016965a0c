//! The program: reads the command line and hands over.

use std::process::ExitCode;

#[cfg(not(target_arch = "wasm32"))]
fn main() -> ExitCode {
    powder_master::cli::main(std::env::args_os())
}

// In a page the library is the program.
#[cfg(target_arch = "wasm32")]
fn main() -> ExitCode {
    ExitCode::FAILURE
}
