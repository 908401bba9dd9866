// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// trust.json, how sure the segmentation is of each bone and what to look at (docs/case_format.md).
// Written beside case.json by `carpus reconstruct`; cases of older programs have none.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace carpus::case_io {

inline constexpr const char* kTrustFile = "trust.json";
inline constexpr int kTrustSchemaVersion = 2;

struct TrustLine {
  std::string name;       ///< of the bone or part
  double confidence = 0;  ///< 0 to 1
  bool flagged = false;
  std::string why;  ///< what was seen and what to do; empty where nothing is wrong

  bool operator==(const TrustLine&) const = default;
};

struct Trust {
  std::vector<TrustLine> bones;
  /// What is to be known of the scan as a whole before it is used, in words; at most 16.
  std::vector<std::string> of_scan{};

  bool operator==(const Trust&) const = default;
};

/// @param made_by  program and version
[[nodiscard]] std::string trust_text(const Trust& trust, const std::string& made_by);

/// @throws InvalidInput naming `file` and field; SchemaError where a newer program wrote it.
[[nodiscard]] Trust parse_trust(const std::string& text, const std::string& file);

/// Of a case folder; nothing where it has none.
/// @throws as parse_trust; IoError where it cannot be read.
[[nodiscard]] std::optional<Trust> read_trust(const std::filesystem::path& folder);

}  // namespace carpus::case_io
