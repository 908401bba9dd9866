// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which series a scan holds, from the process that read it to the one that asks a person: JSON,
// {"series": [{"uid", "description", "slices", "spacing_mm": [x, y, z]}]}. No date, nobody's name.
#pragma once

#include <string>
#include <vector>

#include "case_io/read_volume.hpp"
#include "server/new_case_desk.hpp"

namespace carpus::cli {

[[nodiscard]] std::string series_choice_text(const std::vector<case_io::SeriesSummary>& volumes);

/// @return empty where it is not such a list
[[nodiscard]] std::vector<server::SeriesOffer> parse_series_choice(const std::string& text);

}  // namespace carpus::cli
