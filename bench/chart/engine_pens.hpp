// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One colour and dash an engine, by its name, so that it looks the same in every plot.
#pragma once

#include <string_view>

namespace carpus::bench {

struct Pen {
  const char* colour;
  const char* dash;  ///< an SVG attribute with a space before it, or empty
};

/// Of the known engines those that share a plot differ; another name gets a pen by its letters.
[[nodiscard]] Pen pen_of(std::string_view engine);

}  // namespace carpus::bench
