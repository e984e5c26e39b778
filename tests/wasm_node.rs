//! In Node.

#![cfg(target_arch = "wasm32")]

#[path = "wasm/everywhere.rs"]
mod everywhere;
