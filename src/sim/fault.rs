//! Where a panic came from. A caught panic brings its message along, but not its place: only the panic hook sees that.

use std::{
    any::Any,
    panic,
    sync::{Mutex, PoisonError},
};

/// The panic that was seen last: its place in the source and what it said, in one line.
static LAST: Mutex<Option<String>> = Mutex::new(None);

/// Notes panics from now on; `loud`: they are also told on stderr, as before.
pub fn watch(loud: bool) {
    let before = panic::take_hook();
    panic::set_hook(Box::new(move |info| {
        let text = message(info.payload());
        let line = match info.location() {
            Some(place) => format!("{text} ({}:{})", place.file(), place.line()),
            None => text,
        };
        *LAST.lock().unwrap_or_else(PoisonError::into_inner) = Some(line);
        if loud {
            before(info);
        }
    }));
}

/// What a panic said, in one line.
pub fn message(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| payload.downcast_ref::<&str>().copied()).unwrap_or("a panic without a message");
    text.lines().next().unwrap_or_default().to_owned()
}

/// What a caught panic said, with its place if it is the one that was noted last.
pub fn describe(payload: &(dyn Any + Send)) -> String {
    let said = message(payload);
    let noted = LAST.lock().unwrap_or_else(PoisonError::into_inner);
    noted.clone().filter(|line| line.starts_with(&said)).unwrap_or(said)
}
