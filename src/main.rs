//! The program: reads the command line and hands over.

use std::process::ExitCode;

fn main() -> ExitCode {
    powder_master::cli::main(std::env::args_os())
}
