// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a figure was measured on and with; printed with every table.
#pragma once

#include <string>

namespace carpus::bench {

struct Provenance {
  std::string machine;  ///< processor and number of cores
  std::string compiler;
  std::string flags;
  std::string commit;  ///< of the tree when the build was configured
};

[[nodiscard]] Provenance provenance();

}  // namespace carpus::bench
