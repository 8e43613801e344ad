//! Code that the tests share.

#![allow(dead_code, reason = "each test crate uses its part")]

pub(crate) mod device;
pub(crate) mod expected;
pub(crate) mod objects;
pub(crate) mod patches;
