#![no_main]

developable_fuzz::mesh!(Xyz);
