//! The source of the standard library, exactly this compiler's. The ready-made library that comes with a target knows no
//! threads, so it is built along with the game.

use crate::{fault::Fault, tool};
use std::{
    env, fs,
    path::{Path, PathBuf},
    process::{self, Command, Stdio},
};

/// Debian's suites that may have the source of a compiler, newest compilers first.
const SUITES: [&str; 4] = ["trixie-backports", "forky", "sid", "trixie"];

/// Sees to it that the source is where cargo looks for it.
pub fn require() -> Result<(), Fault> {
    let root = PathBuf::from(tool::output(Command::new("rustc").args(["--print", "sysroot"]))?);
    let place = root.join("lib/rustlib/src/rust");
    if present(&place) {
        return Ok(());
    }
    let release = release()?;
    eprintln!("getting the source of Rust's standard library {release}");
    if from_rustup() && present(&place) {
        return Ok(());
    }
    match from_debian(&release, &place) {
        Ok(()) if present(&place) => Ok(()),
        tried => Err(Fault::missing(
            format!("the source of Rust's standard library, version {release}"),
            format!(
                "either `rustup component add rust-src`\nor, from Debian's package rust-src {release} or the compiler's \
                 own source, put the folder `library` into {}{}",
                place.display(),
                tried.err().map_or_else(String::new, |fault| format!("\n(Debian's package: {fault})"))
            ),
        )),
    }
}

fn present(place: &Path) -> bool {
    place.join("library/std/Cargo.toml").is_file() && place.join("library/Cargo.lock").is_file()
}

/// The compiler's version, such as `1.95.0`.
fn release() -> Result<String, Fault> {
    let about = tool::output(Command::new("rustc").args(["--version", "--verbose"]))?;
    let release = about.lines().find_map(|line| line.strip_prefix("release: "));
    release.map(str::to_owned).ok_or_else(|| Fault::failed("rustc does not say which version it is"))
}

fn from_rustup() -> bool {
    let mut command = Command::new("rustup");
    command.args(["component", "add", "rust-src"]).stdout(Stdio::null()).stderr(Stdio::null());
    command.status().is_ok_and(|status| status.success())
}

/// Takes the package from the mirror that this machine uses, and leaves its own lists as they are.
fn from_debian(release: &str, place: &Path) -> Result<(), Fault> {
    if !tool::exists("apt-get") || !tool::exists("dpkg-deb") {
        return Err(Fault::failed("this is no Debian"));
    }
    let mirror = mirror().ok_or_else(|| Fault::failed("no Debian mirror is set up for apt"))?;
    let folder = env::temp_dir().join(format!("powder-master-rust-src-{}", process::id()));
    let got = SUITES.iter().find_map(|suite| download(release, &mirror, suite, &folder).ok());
    let done = got.ok_or_else(|| Fault::failed(format!("{mirror} has no rust-src {release}"))).and_then(|package| {
        let unpacked = folder.join("unpacked");
        tool::run(Command::new("dpkg-deb").arg("-x").arg(&package).arg(&unpacked))?;
        fs::create_dir_all(place).map_err(|error| Fault::file(place, error))?;
        let library = unpacked.join(format!("usr/src/rustc-{release}/library"));
        tool::run(Command::new("cp").arg("-a").arg(&library).arg(place))
    });
    // What is left in the folder of temporary files is the system's to clean.
    let _ = fs::remove_dir_all(&folder);
    done
}

/// The first mirror of Debian in apt's sources.
fn mirror() -> Option<String> {
    let parts = fs::read_dir("/etc/apt/sources.list.d").into_iter().flatten().flatten().map(|entry| entry.path());
    let files = parts.chain([PathBuf::from("/etc/apt/sources.list")]);
    let texts: Vec<String> = files.filter_map(|file| fs::read_to_string(file).ok()).collect();
    let lines = texts.iter().flat_map(|text| text.lines()).filter(|line| !line.trim_start().starts_with('#'));
    let mut words = lines.flat_map(str::split_whitespace).filter(|word| word.starts_with("http"));
    words.find(|word| word.trim_end_matches('/').ends_with("/debian")).map(str::to_owned)
}

/// Downloads the package from one suite.
fn download(release: &str, mirror: &str, suite: &str, folder: &Path) -> Result<PathBuf, Fault> {
    let write = |name: &str, text: &str| {
        let path = folder.join(name);
        fs::write(&path, text).map(|()| path.clone()).map_err(|error| Fault::file(&path, error))
    };
    for part in ["lists/partial", "cache/archives/partial"] {
        let part = folder.join(part);
        fs::create_dir_all(&part).map_err(|error| Fault::file(&part, error))?;
    }
    let keys = "/usr/share/keyrings/debian-archive-keyring.gpg";
    let sources = write("sources.list", &format!("deb [signed-by={keys}] {mirror} {suite} main\n"))?;
    let apt = |program: &str| {
        let mut command = Command::new(program);
        command.current_dir(folder);
        for (option, value) in [
            ("Dir::Etc::SourceList", sources.as_path()),
            ("Dir::Etc::SourceParts", Path::new("/dev/null")),
            ("Dir::State::Lists", &folder.join("lists")),
            ("Dir::Cache", &folder.join("cache")),
            ("APT::Sandbox::User", Path::new("root")),
        ] {
            command.arg("-o").arg(format!("{option}={}", value.display()));
        }
        command
    };
    tool::output(apt("apt-get").args(["--quiet", "update"]))?;
    let versions = tool::output(apt("apt-cache").args(["madison", "rust-src"]))?;
    let version = versions.lines().filter_map(|line| line.split('|').nth(1)).map(str::trim);
    let version = version
        .into_iter()
        .find(|version| version.strip_prefix(release).is_some_and(|rest| rest.starts_with(['+', '-'])));
    let version = version.ok_or_else(|| Fault::failed(format!("{suite} has no rust-src {release}")))?;
    tool::output(apt("apt-get").args(["--quiet", "download", &format!("rust-src={version}")]))?;
    let files = fs::read_dir(folder).map_err(|error| Fault::file(folder, error))?;
    let mut packages = files.flatten().map(|entry| entry.path());
    packages
        .find(|path| path.extension().is_some_and(|ending| ending == "deb"))
        .ok_or_else(|| Fault::failed("no package"))
}
