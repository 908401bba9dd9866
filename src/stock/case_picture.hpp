// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How a case looks in a list: its PA as the C-arm shows it, so that every case has one, whether it
// is of the stock or of somebody's scan.
#pragma once

#include <string>

#include "cases/case_data.hpp"

namespace carpus::stock {

/// A PNG of 8-bit grey, for case_io::kPreviewFile.
[[nodiscard]] std::string case_picture(const cases::CaseData& data);

}  // namespace carpus::stock
