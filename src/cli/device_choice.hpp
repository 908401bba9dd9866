// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the verbs of `carpus device` share: which device is meant, and that it has come so far.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "devices/device_catalogue.hpp"
#include "devices/host_loop.hpp"

namespace carpus::cli {

/// The device that is meant: the one named, or the only one there is. @throws UsageError, or
/// InvalidInput saying what to do where nothing is found.
[[nodiscard]] std::string choose_device(const std::string& wished,
                                        const devices::DeviceSearch& search);

/// Waits until the loop's device is as wished, at most so long. @return whether it is.
bool wait_until(devices::HostLoop& loop,
                devices::LoopState& state,
                double seconds,
                const std::function<bool(const devices::LoopState&)>& is);

/// Boards that reset when their line is opened take two seconds to answer.
inline constexpr double kStartSeconds = 4.0;

/// "good", with what to do and why where it is not.
[[nodiscard]] std::string health_in_words(const devices::HostLoop& loop,
                                          const devices::LoopState& state);

}  // namespace carpus::cli
