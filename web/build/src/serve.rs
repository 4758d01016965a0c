//! `dist/` on this machine, with the headers under which a page may share memory between threads.

use crate::fault::Fault;
use std::{
    fs::File,
    path::{Component, Path, PathBuf},
    thread,
};
use tiny_http::{Header, Request, Response, Server, StatusCode};

/// Requests that are answered at the same time.
const THREADS: usize = 4;
/// What makes a page cross-origin isolated, and its files fit for such a page.
const ISOLATION: [(&str, &str); 3] = [
    ("Cross-Origin-Opener-Policy", "same-origin"),
    ("Cross-Origin-Embedder-Policy", "require-corp"),
    ("Cross-Origin-Resource-Policy", "same-origin"),
];

/// Serves until it is stopped.
pub fn serve(dist: &Path, port: u16) -> Result<(), Fault> {
    if !dist.join("index.html").is_file() {
        return Err(Fault::missing(dist.display().to_string(), "build it: `cargo web --build`"));
    }
    let server = Server::http(("127.0.0.1", port))
        .map_err(|error| Fault::failed(format!("port {port}: {error}; `cargo web --port N` takes another")))?;
    println!("http://{}/", server.server_addr());
    thread::scope(|scope| {
        for _ in 0..THREADS {
            scope.spawn(|| {
                for request in server.incoming_requests() {
                    answer(request, dist);
                }
            });
        }
    });
    Ok(())
}

fn answer(request: Request, dist: &Path) {
    let accepts = |coding: &str| {
        let mut headers = request.headers().iter().filter(|header| header.field.equiv("Accept-Encoding"));
        headers.any(|header| header.value.as_str().contains(coding))
    };
    let found = file_of(request.url(), dist).and_then(|path| {
        [("br", ".br"), ("gzip", ".gz")]
            .into_iter()
            .filter(|(coding, _)| accepts(coding))
            .find_map(|(coding, ending)| Some((File::open(with(&path, ending)).ok()?, Some(coding))))
            .or_else(|| Some((File::open(&path).ok()?, None)))
            .map(|(file, coding)| (file, coding, kind_of(&path)))
    });
    // Whoever asked may be gone.
    let _ = match found {
        Some((file, coding, kind)) => {
            let mut response = Response::from_file(file);
            let headers = [("Content-Type", kind), ("Cache-Control", "no-cache"), ("Vary", "Accept-Encoding")];
            let coding = coding.map(|coding| ("Content-Encoding", coding));
            for (name, value) in headers.into_iter().chain(coding).chain(ISOLATION) {
                if let Ok(header) = Header::from_bytes(name, value) {
                    response.add_header(header);
                }
            }
            request.respond(response)
        }
        None => request.respond(Response::from_string("no such file\n").with_status_code(StatusCode(404))),
    };
}

fn with(path: &Path, ending: &str) -> PathBuf {
    let mut path = path.as_os_str().to_owned();
    path.push(ending);
    path.into()
}

/// The file that a URL means, if it is one in `dist`.
fn file_of(url: &str, dist: &Path) -> Option<PathBuf> {
    let path = url.split(['?', '#']).next()?.trim_start_matches('/');
    let path = Path::new(if path.is_empty() { "index.html" } else { path });
    let plain = path.components().all(|part| matches!(part, Component::Normal(_)));
    plain.then(|| dist.join(path)).filter(|path| path.is_file())
}

fn kind_of(path: &Path) -> &'static str {
    match path.extension().and_then(|ending| ending.to_str()) {
        Some("html") => "text/html; charset=utf-8",
        Some("js") => "text/javascript; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("wasm") => "application/wasm",
        Some("svg") => "image/svg+xml",
        Some("json") => "application/json",
        Some("webmanifest") => "application/manifest+json",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_files_of_the_page_are_served() {
        let here = Path::new(env!("CARGO_MANIFEST_DIR"));
        assert_eq!(file_of("/Cargo.toml?x=1", here), Some(here.join("Cargo.toml")));
        for url in ["/../Cargo.toml", "/src/../../../Cargo.toml", "//etc/passwd", "/src", "/nothing"] {
            assert_eq!(file_of(url, here), None, "{url}");
        }
    }
}
