#![no_main]

developable_fuzz::mesh!(Obj);
