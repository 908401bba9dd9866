// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The form by which a person rates an arthroscopy, as data (data/asset.json): its rows, what each
// step means, and when it passes [koehler2013asset][koehler2013passfail].
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace carpus::arthroscopy {

/// What a step of a row means; steps without words lie between.
struct AssetStep {
  int points = 0;
  std::string text;
};

/// A row of the form.
struct AssetDomain {
  std::string id;
  std::string title;
  int highest = 0;  ///< points go from 1 to this
  std::vector<AssetStep> steps;
};

/// What was chosen in a row.
struct AssetChoice {
  std::string domain;
  int points = 0;
  bool operator==(const AssetChoice&) const = default;
};

/// What a form comes to.
struct AssetResult {
  int total = 0;
  bool passes = false;
  bool operator==(const AssetResult&) const = default;
};

struct AssetTable {
  int passes_at = 0;  ///< in every domain
  std::vector<AssetDomain> domains;
  AssetDomain complexity;  ///< of the procedure: asked, not counted

  /// Why these are no answers to this form, in a sentence; nothing where they are. Rows may be
  /// missing.
  [[nodiscard]] std::optional<std::string> problem_of(std::span<const AssetChoice> answers) const;
  /// Nothing while a row is missing, the complexity among them. @param answers  without a problem
  [[nodiscard]] std::optional<AssetResult> result_of(std::span<const AssetChoice> answers) const;

  /// @throws InvalidInput naming the entry where the text is no such table.
  [[nodiscard]] static AssetTable parse(std::string_view json_text);
  /// The built-in table; parsed at the first call.
  [[nodiscard]] static const AssetTable& built_in();
};

}  // namespace carpus::arthroscopy
