// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Every method behind the contract of convex/pair_query.hpp by name, so that a researcher can
// compare them.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "convex/convex_body.hpp"
#include "convex/pair_query.hpp"

namespace carpus::survey {

/// A method by its plain name, as tables and the command line call it.
struct Method {
  std::string_view name;    ///< `lp_growth`, `gjk`, `v_clip`, ...
  std::string_view source;  ///< key in docs/bibliography.bib
  bool gives_distance = false;
  bool gives_depth = false;
  /// Where it is known to fail or to be approximate; empty: nowhere.
  std::string_view limits;
  /// Both bodies must outlive the query.
  std::unique_ptr<convex::PairQuery> (*make)(const convex::ConvexBody& first,
                                             const convex::ConvexBody& second);
};

/// Every method, in the order of the tables.
[[nodiscard]] std::span<const Method> all_methods();
/// Null where there is no such method.
[[nodiscard]] const Method* find_method(std::string_view name);

}  // namespace carpus::survey
