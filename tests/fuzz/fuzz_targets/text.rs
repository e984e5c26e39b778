#![no_main]

developable_fuzz::image!(Text);
