// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// CARPUS_WIDEST_VECTORS before a function: it is compiled for the vectors that every 64-bit PC has
// and for wider ones, and the program takes at its start what the machine offers. For loops over
// long rows of numbers that run for a good part of a second. The same bits come out of each:
// without fused multiply-add and reassociation (cmake/carpus_compile_options.cmake) every number of
// a row is found by the same operations, however many of them at a time.
#pragma once

// Sanitizers come too late for what chooses at the start; clang is for checks alone.
#if defined(__x86_64__) && defined(__ELF__) && defined(__GNUC__) && !defined(__clang__) && \
    defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define CARPUS_WIDEST_VECTORS __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define CARPUS_WIDEST_VECTORS
#endif

// Before a loop whose turns do not depend on each other: what one writes no other reads.
#if defined(__GNUC__) && !defined(__clang__)
#define CARPUS_INDEPENDENT_TURNS _Pragma("GCC ivdep")
#else
#define CARPUS_INDEPENDENT_TURNS
#endif
