// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The thesis's tables of times [yaacoub2008] as HTML: each printed figure beside the one measured
// here. From what carpus bench hull and collision write with --json (docs/json.md).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

namespace carpus::cli {

/// Tables 4.1 and 4.2. Brute force, which no bone waits for, is bounded by the runs on parts of a
/// bone: the power that fits them, taken to the bone's count, and called so.
/// @throws InvalidInput where the JSON is not that of `bench hull`.
[[nodiscard]] std::string hull_table_html(const nlohmann::ordered_json& bench);

/// Table 5.1, the cold rows. @throws InvalidInput where the JSON is not that of `bench collision`.
[[nodiscard]] std::string collision_table_html(const nlohmann::ordered_json& bench);

/// seconds = factor * n^exponent.
struct PowerLaw {
  double factor = 0;  ///< s
  double exponent = 0;
};
/// The law that fits pairs of n and seconds (both positive) best, by least squares of their
/// logarithms; all 0 with fewer than two different n.
[[nodiscard]] PowerLaw fit_power(const std::vector<std::pair<double, double>>& n_and_seconds);

}  // namespace carpus::cli
