#![no_main]

developable_fuzz::fuzz_target!(|bytes: &[u8]| developable_fuzz::look_with(bytes));
