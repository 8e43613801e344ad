//! The game of the README.

include!("game.rs");
