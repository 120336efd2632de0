//! Bytes that a program holds.

use stats_alloc::StatsAlloc;

/// Bytes that were allocated and not given back. The allocator counts what grows or shrinks in place among the allocated and the freed.
pub fn held_bytes<A: std::alloc::GlobalAlloc>(allocator: &StatsAlloc<A>) -> usize {
    let stats = allocator.stats();
    stats.bytes_allocated - stats.bytes_deallocated
}
