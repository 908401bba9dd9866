// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A device behind a shared library of somebody else's (plugin_abi.h).
#pragma once

#include <filesystem>
#include <utility>

#include "devices/device.hpp"
#include "devices/plugin_abi.h"

namespace carpus::devices {

class PluginDevice final : public Device {
 public:
  explicit PluginDevice(std::filesystem::path library) : library_(std::move(library)) {}
  ~PluginDevice() override;

  /// Known once it is open.
  [[nodiscard]] Capabilities capabilities() const override { return able_; }
  void open() override;
  void close() noexcept override;
  void poll(Nanoseconds now, DeviceState& state) noexcept override;
  void command(Nanoseconds now, const DeviceCommand& command) noexcept override;

 private:
  std::filesystem::path library_;
  void* handle_ = nullptr;
  const carpus_device_plugin_table* table_ = nullptr;
  void* device_ = nullptr;
  Capabilities able_;
  DeviceState state_;
};

}  // namespace carpus::devices
