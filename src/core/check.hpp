// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// CARPUS_CHECK guards invariants that are cheap to test and stays on in every build;
// CARPUS_ASSERT is for the inner loops and vanishes with NDEBUG. Both mean a bug in our code.
#pragma once

namespace carpus {

/// Prints the broken invariant and aborts.
[[noreturn]] void fail_check(const char* expression, const char* file, int line) noexcept;

}  // namespace carpus

#define CARPUS_CHECK(expression) \
  ((expression) ? static_cast<void>(0) : ::carpus::fail_check(#expression, __FILE__, __LINE__))

#ifdef NDEBUG
#define CARPUS_ASSERT(expression) static_cast<void>(0)
#else
#define CARPUS_ASSERT(expression) CARPUS_CHECK(expression)
#endif
