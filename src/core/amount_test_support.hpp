// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How much a test does: CARPUS_QUICK=1 asks for less (sanitizers), CARPUS_LONG=1 for all there is.
#pragma once

#include <cstdlib>
#include <string_view>

namespace carpus::test {

[[nodiscard]] inline bool is_set(const char* name) {
  const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe)
  return value != nullptr && std::string_view(value) == "1";
}

template <typename Count>
[[nodiscard]] Count amount(Count quick, Count usual, Count much) {
  return is_set("CARPUS_LONG") ? much : (is_set("CARPUS_QUICK") ? quick : usual);
}

}  // namespace carpus::test
