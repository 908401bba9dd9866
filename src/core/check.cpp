// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "core/check.hpp"

#include <cstdio>
#include <cstdlib>

namespace carpus {

void fail_check(const char* expression, const char* file, int line) noexcept {
  std::fprintf(stderr, "carpus: internal error: %s does not hold (%s:%d)\n", expression, file,
               line);
  std::abort();
}

}  // namespace carpus
