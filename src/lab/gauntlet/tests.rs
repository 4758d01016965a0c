//! The gauntlet, and that its judge can fail a case.
