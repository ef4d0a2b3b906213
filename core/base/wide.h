// Functions compiled for wide vector units too.
#pragma once

/// Before a function: compiled once for any x86-64 and once for AVX2 (with its popcount); the processor picks when the
/// program is loaded. Both give the same bits, since the build forbids contraction to fused multiply-adds and
/// reordering. Sanitizers cannot watch the choosing, so they get one version.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define SHBAKE_WIDE [[gnu::target_clones("avx2", "default")]]
#else
#define SHBAKE_WIDE
#endif
