//! As much of wasm-bindgen's command as the build needs, from the library behind it. The command
//! itself brings a test runner with servers and takes three times as long to compile.

use std::error::Error;
use std::process::ExitCode;

use wasm_bindgen_cli_support::Bindgen;

const USAGE: &str =
    "wasm-bindgen --version | wasm-bindgen --target web --out-dir FOLDER --out-name NAME MODULE";

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    let done = match args[..] {
        ["--version"] => {
            println!("wasm-bindgen {}", env!("CARGO_PKG_VERSION"));
            Ok(())
        }
        [
            "--target",
            "web",
            "--out-dir",
            folder,
            "--out-name",
            name,
            module,
        ] => bind(module, folder, name),
        _ => Err(format!("usage: {USAGE}").into()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// Writes the module with its JavaScript and types, as the command does by default.
fn bind(module: &str, folder: &str, name: &str) -> Result<(), Box<dyn Error>> {
    let mut bindgen = Bindgen::new();
    bindgen
        .input_path(module)
        .out_name(name)
        .web(true)?
        .typescript(true)
        .omit_default_module_path(false);
    Ok(bindgen.generate(folder)?)
}
