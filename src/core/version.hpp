// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The program's version, written into cases and recordings.
#pragma once

namespace carpus {

inline constexpr const char* kProgramVersion = "carpus 0.1.0";

}  // namespace carpus
