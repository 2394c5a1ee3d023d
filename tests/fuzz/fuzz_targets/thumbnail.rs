//! Hunts for bytes that break `espalier_fuzz::thumbnail::read`.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    espalier_fuzz::thumbnail::read(bytes);
});
