//! In Node, by `wasm-pack test --node`.

#![cfg(target_arch = "wasm32")]

use developable_in_wasm::smooth;
use wasm_bindgen_test::wasm_bindgen_test;

#[wasm_bindgen_test]
fn a_plane_is_fitted_by_itself() {
    let plane: Vec<f64> = (0..24 * 20)
        .map(|i| 0.3 * f64::from(i % 24) - 0.2 * f64::from(i / 24))
        .collect();
    let fitted = smooth(24, 20, plane.clone()).unwrap_or_else(|_| panic!("a plane can be fitted"));
    assert!(
        fitted
            .iter()
            .zip(&plane)
            .all(|(z, expected)| (z - expected).abs() < 1e-9)
    );
}
