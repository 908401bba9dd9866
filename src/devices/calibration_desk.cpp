// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/calibration_desk.hpp"

#include "core/error.hpp"

namespace carpus::devices {
namespace {

constexpr std::chrono::milliseconds kMostTime{1500};

firmware::Drive drive_of(const LoopState& state) {
  if (!state.device.has_unit) {
    throw InvalidInput("This device is not calibrated here; only an arm that answers is.");
  }
  return state.able.stop ? firmware::Drive::Stop : firmware::Drive::Motor;
}

std::optional<ArmCalibration> known(const std::filesystem::path& folder,
                                    firmware::Drive drive,
                                    std::uint32_t unit) {
  std::vector<std::string> problems;
  for (ArmCalibration& one : load_calibrations(folder, problems)) {
    if (one.drive == drive && one.unit == unit) return std::move(one);
  }
  return std::nullopt;
}

}  // namespace

CalibrationDesk::CalibrationDesk(HostLoop& loop,
                                 const LoopState& state,
                                 std::filesystem::path folder)
    : loop_(loop),
      folder_(std::move(folder)),
      calibrator_(drive_of(state),
                  state.device.unit,
                  known(folder_, drive_of(state), state.device.unit)) {}

CalibrationDesk::~CalibrationDesk() {
  loop_.turn_servos(0);
  if (is_stored_) loop_.reopen();
}

std::string CalibrationDesk::instruction() const {
  return std::to_string(calibrator_.step() + 1) + " of " +
         std::to_string(calibrator_.step_count()) + ": " + calibrator_.instruction();
}

void CalibrationDesk::take() {
  if (is_measuring_) return;
  loop_.turn_servos(calibrator_.pulse_us());
  settles_ = std::chrono::milliseconds(calibrator_.settle_ms());
  while (loop_.next_raw()) {
  }
  samples_.clear();
  is_measuring_ = true;
  began_ = std::chrono::steady_clock::now();
  note_ = calibrator_.pulse_us() != 0                   ? "It turns by itself: follow it."
          : calibrator_.sample_count() > kSamplesOfStep ? "Measuring, go on."
                                                        : "Measuring, keep still.";
}

bool CalibrationDesk::look(const std::string& now_utc, const LoopState& state) {
  if (!is_measuring_) return false;
  const auto measured = std::chrono::steady_clock::now() - began_ - settles_;
  while (const auto sample = loop_.next_raw()) {
    if (measured >= std::chrono::milliseconds(0)) samples_.push_back(*sample);
  }
  const std::size_t wanted = calibrator_.sample_count();
  const bool is_late = measured > kMostTime + std::chrono::milliseconds(2 * wanted);
  if (!calibrator_.is_enough(samples_.size(), state.device.windings) && !is_late) return false;
  is_measuring_ = false;
  const bool was_turning = calibrator_.pulse_us() != 0;
  if (const auto problem = calibrator_.take(samples_, state.device.windings)) {
    note_ = *problem;
    if (was_turning && !calibrator_.is_by_itself()) loop_.turn_servos(0);
    return false;
  }
  note_ = "Measured.";
  if (calibrator_.is_by_itself()) take();
  if (!calibrator_.is_whole()) return false;
  loop_.turn_servos(0);
  const Result<ArmCalibration> made = calibrator_.finish(now_utc);
  if (!made) {
    note_ = made.error();
    return false;
  }
  store(*made, folder_);
  is_stored_ = true;
  if (calibrator_.is_complete()) return true;
  note_ = "Its place is stored. What follows evens out its motors, and may be left out.";
  return false;
}

}  // namespace carpus::devices
