//! Other programs.

use crate::fault::Fault;
use std::process::{Command, Stdio};

/// Whether a program of this name can be started.
pub fn exists(name: &str) -> bool {
    Command::new(name).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok()
}

/// Runs a program to its end; what it writes goes to the terminal.
pub fn run(command: &mut Command) -> Result<(), Fault> {
    let name = command.get_program().display().to_string();
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(Fault::failed(format!("{name} ended with {status}"))),
        Err(error) => {
            Err(Fault::missing(format!("the program `{name}` ({error})"), format!("put `{name}` on the PATH")))
        }
    }
}

/// What a program writes to its output; what it says beside it is lost.
pub fn output(command: &mut Command) -> Result<String, Fault> {
    listen(command.stderr(Stdio::null()))
}

/// What a program writes to its output; what it says beside it goes to the terminal.
pub fn output_of_loud(command: &mut Command) -> Result<String, Fault> {
    listen(command.stderr(Stdio::inherit()))
}

fn listen(command: &mut Command) -> Result<String, Fault> {
    let name = command.get_program().display().to_string();
    match command.output() {
        Ok(output) if output.status.success() => Ok(String::from_utf8_lossy(&output.stdout).trim().to_owned()),
        Ok(output) => Err(Fault::failed(format!("{name} ended with {}", output.status))),
        Err(error) => {
            Err(Fault::missing(format!("the program `{name}` ({error})"), format!("put `{name}` on the PATH")))
        }
    }
}
