// Functions in two versions, of which the processor picks one when the program starts.
#pragma once

/// Before a function whose loops gain from vectors of four doubles. Both versions do the same operations in the same
/// order on each element (products and sums are never fused), so that results are the same to the bit. Sanitizers do
/// not get on with the choice at the start.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define SHBAKE_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define SHBAKE_VECTOR_CLONES
#endif
