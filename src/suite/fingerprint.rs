//! A number that tells texts apart.

/// FNV-1a (Fowler, Noll & Vo), 64 bits.
pub(super) fn fingerprint(bytes: &[u8]) -> u64 {
    let next = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, next)
}
