//! In a browser's main thread: the wasm build gives what the native one gave.

#![cfg(target_arch = "wasm32")]

#[path = "fixtures/case.rs"]
mod case;
#[path = "fixtures/check.rs"]
mod check;
#[path = "fixtures/errors.rs"]
mod errors;
#[path = "wasm/known.rs"]
mod known_everywhere;

wasm_bindgen_test::wasm_bindgen_test_configure!(run_in_browser);

check::fixture_tests!(wasm_bindgen_test::wasm_bindgen_test, 1e-9);
errors::error_tests!(wasm_bindgen_test::wasm_bindgen_test);
known_everywhere::known_tests!(wasm_bindgen_test::wasm_bindgen_test);
