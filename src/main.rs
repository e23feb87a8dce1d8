//! Edgewise: the window without a subcommand, the command line with one.

use std::process::ExitCode;

use edgewise::cli;

fn main() -> ExitCode {
    let arguments = match cli::parse(std::env::args_os()) {
        Ok(arguments) => arguments,
        Err(code) => return code,
    };
    match (arguments.command, arguments.path) {
        (Some(command), _) => cli::run(command),
        (None, Some(path)) if !path.exists() => {
            cli::fail(&anyhow::anyhow!("{}: there is no such file", path.display()))
        }
        (None, _) => {
            cli::fail(&anyhow::anyhow!("this build has no window; `edgewise --help` lists what it does without one"))
        }
    }
}
