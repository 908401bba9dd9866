// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How long work reports where it is. Called from the thread that does the work.
#pragma once

#include <functional>
#include <string_view>

namespace carpus {

/// `stage` names what is being done, `fraction` in [0, 1] how much of the whole is done.
using Progress = std::function<void(std::string_view stage, double fraction)>;

/// Reports to nobody.
inline void no_progress(std::string_view /*stage*/, double /*fraction*/) {}

}  // namespace carpus
