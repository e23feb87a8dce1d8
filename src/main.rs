//! Edgewise: the window without a subcommand, the command line with one.

use std::process::ExitCode;

use edgewise::cli::{self, Arguments};

fn main() -> ExitCode {
    let mut arguments = match cli::parse(std::env::args_os()) {
        Ok(arguments) => arguments,
        Err(code) => return code,
    };
    // Silent unless RUST_LOG asks: what people must know is said in sentences.
    env_logger::Builder::from_env(env_logger::Env::default().default_filter_or("off")).init();
    match (arguments.command.take(), &arguments.path) {
        (Some(command), _) => cli::run(command),
        (None, Some(path)) if !path.exists() => {
            cli::fail(&anyhow::anyhow!("{}: there is no such file", path.display()))
        }
        (None, _) => window(arguments),
    }
}

#[cfg(feature = "gui")]
fn window(arguments: Arguments) -> ExitCode {
    let renderer = arguments.renderer.parse().expect("the parser of arguments lets nothing else through");
    match edgewise::gui::run(edgewise::gui::Options { path: arguments.path, sample: arguments.sample, renderer }) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => cli::fail(&error.into()),
    }
}

#[cfg(not(feature = "gui"))]
fn window(_: Arguments) -> ExitCode {
    cli::fail(&anyhow::anyhow!("this build has no window; `edgewise --help` lists what it does without one"))
}
