// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/plugin_device.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "devices/trusted_command.hpp"
#include "devices/trusted_state.hpp"

namespace carpus::devices {
namespace {

Vec3 vec3_of(const double (&v)[3]) noexcept { return {v[0], v[1], v[2]}; }

void put(const Vec3& from, double (&to)[3]) noexcept {
  for (std::size_t i = 0; i < 3; ++i) to[i] = from[i];
}

double positive(double value) noexcept { return std::isfinite(value) && value > 0 ? value : 0; }

Health health_of(std::uint32_t said) noexcept {
  constexpr Health kOf[] = {Health::Good,        Health::Starting, Health::Uncalibrated,
                            Health::HoldingBack, Health::Silent,   Health::Faulty,
                            Health::Gone};
  return said < std::size(kOf) ? kOf[said] : Health::Faulty;
}

Capabilities capabilities_of(const carpus_device_capabilities& said) noexcept {
  Capabilities able;
  able.position = (said.can & CARPUS_CAN_POSITION) != 0;
  able.rotation = (said.can & CARPUS_CAN_ROTATION) != 0;
  able.absolute = (said.can & CARPUS_CAN_ABSOLUTE) != 0;
  able.force = (said.can & CARPUS_CAN_FORCE) != 0;
  able.stop = (said.can & CARPUS_CAN_STOP) != 0;
  able.local_plane = (said.can & CARPUS_CAN_LOCAL_PLANE) != 0;
  able.vibration = (said.can & CARPUS_CAN_VIBRATION) != 0;
  able.torque = (said.can & CARPUS_CAN_TORQUE) != 0;
  able.rate_hz = positive(said.rate_hz);
  able.peak_force_n = positive(said.peak_force_n);
  able.lasting_force_n = positive(said.lasting_force_n);
  able.most_stiffness_n_per_mm = positive(said.most_stiffness_n_per_mm);
  const Vec3 low = vec3_of(said.workspace_low_mm);
  const Vec3 high = vec3_of(said.workspace_high_mm);
  if (is_finite(low) && is_finite(high)) able.workspace = {low, high};
  return able;
}

}  // namespace

PluginDevice::~PluginDevice() {
  close();
  if (handle_ != nullptr) ::dlclose(handle_);
}

void PluginDevice::open() {
  close();
  const std::string name = library_.string();
  if (handle_ == nullptr) {
    handle_ = ::dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle_ == nullptr) throw IoError(std::string(::dlerror()) + "; see docs/devices.md");
  }
  const auto function = reinterpret_cast<carpus_device_plugin_function>(
      ::dlsym(handle_, CARPUS_DEVICE_PLUGIN_FUNCTION));
  table_ = function != nullptr ? function() : nullptr;
  if (table_ == nullptr) throw IoError(name + ": is no plug-in of a device; see docs/devices.md");
  if (table_->abi != CARPUS_DEVICE_ABI) {
    throw IoError(name + ": was built for version " + std::to_string(table_->abi) +
                  " of the boundary, this program for " + std::to_string(CARPUS_DEVICE_ABI) +
                  "; build it again");
  }
  std::array<char, 256> problem{};
  device_ = table_->open(problem.data(), problem.size());
  problem.back() = '\0';
  if (device_ == nullptr) throw IoError(name + ": " + problem.data());
  carpus_device_capabilities said{};
  table_->capabilities(device_, &said);
  able_ = capabilities_of(said);
  state_ = {};
}

void PluginDevice::close() noexcept {
  if (device_ == nullptr) return;
  const carpus_device_command nothing{};
  table_->command(device_, 0, &nothing);
  table_->close(device_);
  device_ = nullptr;
}

void PluginDevice::poll(Nanoseconds now, DeviceState& state) noexcept {
  if (device_ == nullptr) {
    state_.health = Health::Closed;
    state = state_;
    return;
  }
  carpus_device_state said{};
  for (const int i : {0, 4, 8}) said.rotation[i] = 1;
  table_->poll(device_, now, &said);
  DeviceState read = state_;
  read.health = health_of(said.health);
  read.position_mm = vec3_of(said.position_mm);
  read.velocity_mm_s = vec3_of(said.velocity_mm_s);
  read.spin_rad_s = vec3_of(said.spin_rad_s);
  read.force_n = vec3_of(said.force_n);
  for (std::size_t row = 0; row < 3; ++row) {
    const double* r = said.rotation + 3 * row;
    read.rotation.rows[row] = {r[0], r[1], r[2]};
  }
  read.buttons = said.buttons;
  if (said.samples != state_.samples) read.heard_ns = now;
  read.samples = said.samples;
  if (is_sound(read)) {
    state_ = read;
  } else {
    state_.health = Health::Faulty;
    ++state_.refused;
  }
  state = state_;
}

void PluginDevice::command(Nanoseconds now, const DeviceCommand& command) noexcept {
  if (device_ == nullptr) return;
  carpus_device_command told{};
  const Vec3 force = able_.local_plane
                         ? command.force_n
                         : force_of(command, state_.position_mm, state_.velocity_mm_s);
  put(force, told.force_n);
  told.plane_count = std::min<std::uint32_t>(command.plane_count, kMostPlanes);
  for (std::size_t i = 0; i < told.plane_count; ++i) {
    const LocalPlane& plane = command.planes[i];
    put(plane.normal, told.planes[i].normal);
    told.planes[i].offset_mm = plane.offset_mm;
    told.planes[i].stiffness_n_per_mm = plane.stiffness_n_per_mm;
    told.planes[i].damping_n_s_per_mm = plane.damping_n_s_per_mm;
    told.planes[i].friction = plane.friction;
  }
  told.limit_n = command.limit_n;
  told.vibration_n = command.vibration_n;
  told.vibration_hz = command.vibration_hz;
  told.torque_n_mm = command.torque_n_mm;
  table_->command(device_, now, &told);
}

}  // namespace carpus::devices
