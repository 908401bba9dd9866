// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cases/case_data.hpp"

namespace carpus::cases {

/// "volar and radial": where a vector of Patient, the wrist as scanned, points to, from its larger
/// part on; what is less than a third of that is not named.
[[nodiscard]] std::string direction_in_words(const CaseData& data, const Vec3& in_patient);

}  // namespace carpus::cases
