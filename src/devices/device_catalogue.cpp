// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/device_catalogue.hpp"

#include <algorithm>
#include <cstdlib>

#include "core/error.hpp"
#include "devices/arm_device.hpp"
#include "devices/falcon_device.hpp"
#include "devices/gamepad_device.hpp"
#include "devices/haply_device.hpp"
#include "devices/plugin_device.hpp"
#include "devices/simulated_port.hpp"
#include "devices/spacemouse_device.hpp"
#include "firmware/core/wire.hpp"

namespace carpus::devices {
namespace {

namespace fs = std::filesystem;

/// A Falcon's serial chip; its own rate needs a bridge that takes this one.
constexpr unsigned kFalconBaud = 1000000;

std::vector<fs::path> sorted_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// The name behind "kind:", where the id is of this kind.
bool is_kind(const std::string& id, const std::string& kind, std::string& name) {
  if (!id.starts_with(kind + ":") || id.size() == kind.size() + 1) return false;
  name = id.substr(kind.size() + 1);
  return true;
}

/// Beside the program, or where an administrator puts them.
fs::path plugin_folder_here() {
  if (const char* folder = std::getenv("CARPUS_DEVICE_PLUGINS"); folder != nullptr) return folder;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  return program / ".." / "lib" / "carpus" / "devices";
}

}  // namespace

DeviceSearch search_here() {
  DeviceSearch search;
  search.serial_folders = {simulated_folder(), "/dev/serial/by-id"};
  search.spacenav_socket = kSpacenavSocket;
  search.plugin_folder = plugin_folder_here();
  search.calibrations = calibration_folder();
  return search;
}

std::vector<FoundDevice> find_devices(const DeviceSearch& search) {
  std::vector<FoundDevice> found;
  std::vector<fs::path> targets;
  const auto add_serial = [&](const fs::path& path) {
    std::error_code error;
    const fs::path target = fs::canonical(path, error);
    // A simulated arm that was killed leaves its link behind.
    if (error || std::find(targets.begin(), targets.end(), target) != targets.end()) return;
    if (fs::is_directory(target, error)) return;
    targets.push_back(target);
    const bool is_simulated = target.string().find("/pts/") != std::string::npos;
    found.push_back({"arm:" + path.string(),
                     (is_simulated ? "Simulated arm " : "Arm on ") + path.filename().string()});
  };
  for (const fs::path& folder : search.serial_folders) {
    for (const fs::path& path : sorted_files(folder)) add_serial(path);
  }
  for (const fs::path& path : sorted_files(search.device_folder)) {
    const std::string name = path.filename().string();
    if (name.starts_with("ttyACM") || name.starts_with("ttyUSB")) add_serial(path);
  }
  std::error_code error;
  if (!search.spacenav_socket.empty() && fs::is_socket(search.spacenav_socket, error)) {
    found.push_back({"spacemouse", "SpaceMouse"});
  }
  for (const fs::path& path : sorted_files(search.input_folder)) {
    std::string name;
    if (path.filename().string().starts_with("event") && is_gamepad(path.string(), name)) {
      found.push_back({"gamepad:" + path.string(), name.empty() ? "Gamepad" : name});
    }
  }
  for (const fs::path& path : sorted_files(search.plugin_folder)) {
    if (path.extension() != ".so") continue;
    found.push_back({"plugin:" + path.stem().string(), path.stem().string() + " (plug-in)"});
  }
  return found;
}

std::unique_ptr<Device> make_device(const std::string& id, const DeviceSearch& search) {
  std::string name;
  if (is_kind(id, "arm", name)) {
    return std::make_unique<ArmDevice>([name] { return open_serial(name, firmware::kBaud); },
                                       search.calibrations);
  }
  if (id == "spacemouse") {
    return std::make_unique<SpaceMouseDevice>(
        [path = search.spacenav_socket] { return open_unix_socket(path); });
  }
  if (is_kind(id, "gamepad", name)) {
    return std::make_unique<GamepadDevice>([name] { return open_gamepad(name); });
  }
  if (id == "haply") return std::make_unique<HaplyDevice>(search.haply_host, search.haply_port);
  if (is_kind(id, "falcon", name)) {
    return std::make_unique<FalconDevice>([name] { return open_serial(name, kFalconBaud); });
  }
  if (is_kind(id, "plugin", name) && name.find('/') == std::string::npos) {
    return std::make_unique<PluginDevice>(search.plugin_folder / (name + ".so"));
  }
  throw InvalidInput("there is no device '" + id + "'; 'carpus device list' shows what there is");
}

}  // namespace carpus::devices
