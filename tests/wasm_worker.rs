//! In a browser's dedicated worker.

#![cfg(target_arch = "wasm32")]

#[path = "wasm/everywhere.rs"]
mod everywhere;

wasm_bindgen_test::wasm_bindgen_test_configure!(run_in_dedicated_worker);
