//! What `benches/tank` imports of the program, without the program: built in half a minute, and what else is in it can't
//! change how the kernel is compiled.

pub use powder_kernel as kernel;
