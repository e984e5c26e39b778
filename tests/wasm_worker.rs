//! In a browser's dedicated worker: the wasm build gives what the native one gave.

#![cfg(target_arch = "wasm32")]

#[path = "fixtures/case.rs"]
mod case;
#[path = "fixtures/check.rs"]
mod check;
#[path = "fixtures/errors.rs"]
mod errors;
#[path = "wasm/known.rs"]
mod known_everywhere;

wasm_bindgen_test::wasm_bindgen_test_configure!(run_in_dedicated_worker);

check::fixture_tests!(wasm_bindgen_test::wasm_bindgen_test, 1e-9);
errors::error_tests!(wasm_bindgen_test::wasm_bindgen_test);
known_everywhere::known_tests!(wasm_bindgen_test::wasm_bindgen_test);
