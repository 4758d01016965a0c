//! The Bevy side of the kernel.
