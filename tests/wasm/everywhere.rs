//! What is tested in wasm wherever it runs: that it gives what the native build gave, and what is known.

#[path = "../fixtures/case.rs"]
mod case;
#[path = "../fixtures/check.rs"]
mod check;
#[path = "../fixtures/errors.rs"]
mod errors;
#[path = "known.rs"]
mod known_everywhere;

check::fixture_tests!(wasm_bindgen_test::wasm_bindgen_test, 1e-9);
errors::error_tests!(wasm_bindgen_test::wasm_bindgen_test);
known_everywhere::known_tests!(wasm_bindgen_test::wasm_bindgen_test);
