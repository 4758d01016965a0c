//! Short messages that come and go by themselves.

use bevy::prelude::Resource;

/// Time that a message stays, s.
const STAY: f32 = 3.2;
/// The same of a hint, which comes unasked, s.
const HINT: f32 = 8.0;
/// Messages shown at once.
const MOST: usize = 4;

/// A message.
#[derive(Clone, Debug)]
pub struct Toast {
    /// What it says.
    pub text: String,
    /// Whether something went wrong.
    pub warning: bool,
    /// How long it stays from now on, s.
    pub left: f32,
}

/// The messages that are shown.
#[derive(Resource, Clone, Debug, Default)]
pub struct Toasts(Vec<Toast>);

impl Toasts {
    /// Tells something.
    pub fn say(&mut self, text: impl Into<String>) {
        self.push(text.into(), false, STAY);
    }

    /// Tells that something went wrong.
    pub fn warn(&mut self, text: impl Into<String>) {
        self.push(text.into(), true, 2.0 * STAY);
    }

    /// Tells something that the player did not ask for.
    pub fn hint(&mut self, text: impl Into<String>) {
        self.push(text.into(), false, HINT);
    }

    /// Takes back what was told about something.
    pub fn take_back(&mut self, about: &str) {
        self.0.retain(|toast| !toast.text.contains(about));
    }

    /// Lets `seconds` pass.
    pub fn age(&mut self, seconds: f32) {
        self.0.iter_mut().for_each(|toast| toast.left -= seconds);
        self.0.retain(|toast| toast.left > 0.0);
    }

    /// The messages, the newest last.
    pub fn iter(&self) -> std::slice::Iter<'_, Toast> {
        self.0.iter()
    }

    /// Their texts, the newest last.
    pub fn texts(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|toast| toast.text.as_str())
    }

    /// The newest message.
    pub fn last(&self) -> Option<&str> {
        self.0.last().map(|toast| toast.text.as_str())
    }

    fn push(&mut self, text: String, warning: bool, stay: f32) {
        self.0.retain(|toast| toast.text != text);
        self.0.push(Toast { text, warning, left: stay });
        if self.0.len() > MOST {
            self.0.remove(0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_turns_out_wrong_is_taken_back() {
        let mut toasts = Toasts::default();
        toasts.say("Saved: worlds/a.pms");
        toasts.say("Undone");
        toasts.take_back("worlds/a.pms");
        assert_eq!(toasts.texts().collect::<Vec<_>>(), ["Undone"]);
    }
}
