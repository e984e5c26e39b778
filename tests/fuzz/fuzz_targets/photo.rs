#![no_main]

developable_fuzz::fuzz_target!(|bytes: &[u8]| developable_fuzz::read_photo(bytes));
