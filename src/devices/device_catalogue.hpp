// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which devices are there, by names under which they can be chosen: "arm:/dev/ttyACM0",
// "gamepad:/dev/input/event5", "spacemouse", "haply", "plugin:NAME", "falcon:/dev/ttyUSB0".
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "devices/device.hpp"

namespace carpus::devices {

/// Where is looked; the defaults are this machine's, a test's its own.
struct DeviceSearch {
  std::vector<std::filesystem::path> serial_folders;  ///< all of what is in them
  std::filesystem::path device_folder = "/dev";       ///< ttyACM*, ttyUSB*
  std::filesystem::path input_folder = "/dev/input";
  std::string spacenav_socket;
  std::filesystem::path plugin_folder;
  std::string haply_host = "127.0.0.1";
  std::uint16_t haply_port = 10001;
  std::filesystem::path calibrations;
};
[[nodiscard]] DeviceSearch search_here();

struct FoundDevice {
  std::string id;
  std::string name;  ///< for people
};

/// Nothing is opened but for a moment, and no serial port at all: that resets some boards.
[[nodiscard]] std::vector<FoundDevice> find_devices(const DeviceSearch& search);

/// @throws InvalidInput where the id names no kind of device.
[[nodiscard]] std::unique_ptr<Device> make_device(const std::string& id,
                                                  const DeviceSearch& search);

}  // namespace carpus::devices
