//! Hunts for bytes that break `espalier_fuzz::section::read`.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    espalier_fuzz::section::read(bytes);
});
