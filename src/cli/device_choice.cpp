// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/device_choice.hpp"

#include <chrono>
#include <thread>

#include "core/error.hpp"

namespace carpus::cli {

std::string choose_device(const std::string& wished, const devices::DeviceSearch& search) {
  if (!wished.empty()) return wished;
  const std::vector<devices::FoundDevice> found = devices::find_devices(search);
  if (found.empty()) {
    throw InvalidInput(
        "no device is found: plug one in, or try without: 'carpus device simulate' in another "
        "terminal; docs/devices.md says what works with what");
  }
  if (found.size() == 1) return found.front().id;
  std::string names;
  for (const devices::FoundDevice& one : found) names += "\n  " + one.id;
  throw UsageError("there are several devices; choose one with --device:" + names);
}

bool wait_until(devices::HostLoop& loop,
                devices::LoopState& state,
                double seconds,
                const std::function<bool(const devices::LoopState&)>& is) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (std::chrono::steady_clock::now() < until) {
    if (loop.look(state) && is(state)) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

std::string health_in_words(const devices::HostLoop& loop, const devices::LoopState& state) {
  std::string words = devices::in_words(state.device.health);
  if (const std::string problem = loop.problem(); !problem.empty()) return words + ": " + problem;
  const std::string advice = devices::what_to_do(state.device.health);
  return advice.empty() ? words : words + ". " + advice;
}

}  // namespace carpus::cli
