//! Hunts for bytes that break `espalier_fuzz::grammar::read`.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    espalier_fuzz::grammar::read(bytes);
});
