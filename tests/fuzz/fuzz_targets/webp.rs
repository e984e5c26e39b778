#![no_main]

developable_fuzz::image!(WebP);
