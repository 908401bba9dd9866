// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Values of DICOM elements as text.
#pragma once

#include <cstdint>
#include <string>

namespace carpus::case_io {

/// A UID under 2.25 (UUID-derived, [dicom_ps3_5] B.2): a random UUID (version 4) as a decimal
/// number.
[[nodiscard]] std::string uid_from(std::uint64_t seed);

/// A decimal string (VR DS), which holds at most 16 characters.
[[nodiscard]] std::string decimal(double v);

}  // namespace carpus::case_io
