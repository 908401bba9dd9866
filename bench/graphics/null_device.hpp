// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A graphics processor that is not there: Mesa's driver compiles for it and draws nothing.
#pragma once

#include <vulkan/vulkan.h>

#include <stdexcept>
#include <string>

namespace carpus::bench {

/// @throws std::runtime_error  naming the call, unless it succeeded
inline void demand(VkResult result, const char* call) {
  if (result != VK_SUCCESS)
    throw std::runtime_error(std::string(call) + " failed with " + std::to_string(result));
}

/// The first device that Vulkan lists. Mesa's RADV lists one for each family named in
/// RADV_FORCE_FAMILY, and no other then.
class NullDevice {
 public:
  /// @throws std::runtime_error  where there is none, or it is real hardware, or tells no
  /// statistics
  NullDevice();
  ~NullDevice();
  NullDevice(const NullDevice&) = delete;
  NullDevice& operator=(const NullDevice&) = delete;

  [[nodiscard]] VkDevice handle() const { return device_; }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  std::string name_;
};

}  // namespace carpus::bench
