// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/arm_calibration.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "arm/delta_arm.hpp"
#include "core/error.hpp"
#include "core/json_fields.hpp"
#include "records/atomic_file.hpp"

namespace carpus::devices {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr int kVersion = 1;
constexpr double kMostCounts = 4 * 1023;
constexpr std::array<std::string_view, 2> kDrives{"A", "B"};
constexpr std::array<std::string_view, 3> kWindings{"unknown", "along", "against"};
constexpr std::size_t kMostPoints = 64;
constexpr double kMostCoggingNMm = 100;

ordered_json json_of(const arm::LegCalibration& leg, const ServoFit& servo) {
  auto points = ordered_json::array();
  for (const arm::CalibrationPoint& point : leg.residuals) {
    points.push_back({{"counts", point.counts}, {"beside_line_rad", point.angle_rad}});
  }
  return {{"zero_counts", leg.zero_counts},
          {"rad_per_count", leg.rad_per_count},
          {"line_error_rad", leg.line_error_rad},
          {"points", std::move(points)},
          {"pulse_at_zero_us", servo.pulse_at_zero_us},
          {"pulse_per_half_turn_us", servo.pulse_per_half_turn_us},
          {"gap_rad", servo.gap_rad},
          {"least_pulse_us", servo.least_pulse_us},
          {"most_pulse_us", servo.most_pulse_us}};
}

arm::LegCalibration leg_of(JsonFields& fields) {
  arm::LegCalibration leg;
  leg.zero_counts = fields.number("zero_counts", -65535, 65535);
  leg.rad_per_count = fields.number("rad_per_count", -0.01, 0.01);
  if (std::abs(leg.rad_per_count) < 1e-5) fields.refuse("rad_per_count is next to nothing");
  leg.line_error_rad = fields.number("line_error_rad", 0, 1);
  std::vector<JsonFields> points = fields.objects("points");
  if (points.size() > kMostPoints) fields.refuse("more than 64 points");
  double last = -1;
  for (JsonFields& point : points) {
    arm::CalibrationPoint read;
    read.counts = point.number("counts", 0, kMostCounts);
    read.angle_rad = point.number("beside_line_rad", -1, 1);
    if (!(read.counts > last)) point.refuse("its counts are not above those before");
    last = read.counts;
    leg.residuals.push_back(read);
  }
  return leg;
}

ServoFit servo_of(JsonFields& fields) {
  ServoFit servo;
  servo.pulse_at_zero_us = fields.number("pulse_at_zero_us", 900, 2100);
  servo.pulse_per_half_turn_us = fields.number("pulse_per_half_turn_us", -8000, 8000);
  servo.gap_rad = fields.number("gap_rad", 0, 0.78);
  servo.least_pulse_us = fields.number("least_pulse_us", 900, 2100);
  servo.most_pulse_us = fields.number("most_pulse_us", 900, 2100);
  if (!(servo.least_pulse_us < servo.most_pulse_us)) fields.refuse("its pulses have no range");
  return servo;
}

firmware::WindingsOf windings_of(JsonFields& fields) {
  firmware::WindingsOf read;
  read.windings = static_cast<firmware::Windings>(fields.choice("turn", kWindings));
  if (read.windings == firmware::Windings::Unknown) fields.refuse("turn is not known");
  read.electrical_zero = static_cast<std::uint16_t>(fields.number("electrical_zero", 0, 65535));
  return read;
}

}  // namespace

double cradle_angle_rad() noexcept {
  const arm::DeltaArm arm;
  const auto angles = arm::inverse(arm, arm.centre);
  return angles ? (*angles)[0] : 0;
}

std::int32_t home_of(std::int32_t zero_in_turn, std::int32_t counts_at_rest) noexcept {
  const double at_rest = counts_at_rest - cradle_angle_rad() / kRadPerMotorCount;
  const double turns = std::round((at_rest - zero_in_turn) / kCountsOfTurn);
  return zero_in_turn + kCountsOfTurn * static_cast<std::int32_t>(turns);
}

fs::path calibration_folder() {
  if (const char* config = std::getenv("XDG_CONFIG_HOME"); config != nullptr && *config == '/') {
    return fs::path(config) / "carpus" / "devices";
  }
  const char* home = std::getenv("HOME");
  if (home == nullptr || *home != '/') {
    throw IoError("no folder for calibrations: set XDG_CONFIG_HOME to a folder of yours");
  }
  return fs::path(home) / ".config" / "carpus" / "devices";
}

std::string calibration_file_name(firmware::Drive drive, std::uint32_t unit) {
  return std::string(drive == firmware::Drive::Stop ? "arm_a_" : "arm_b_") + std::to_string(unit) +
         ".json";
}

void store(const ArmCalibration& calibration, const fs::path& folder) {
  ordered_json json{{"version", kVersion},
                    {"drive", kDrives[static_cast<std::size_t>(calibration.drive)]},
                    {"unit", calibration.unit},
                    {"made_at", calibration.made_at}};
  if (calibration.drive == firmware::Drive::Stop) {
    auto legs = ordered_json::array();
    for (std::size_t i = 0; i < kLegs; ++i) {
      legs.push_back(json_of(calibration.legs[i], calibration.servos[i]));
    }
    json["legs"] = std::move(legs);
  } else {
    json["zero_in_turn_counts"] = calibration.zero_in_turn;
    auto windings = ordered_json::array();
    for (const firmware::WindingsOf& one : calibration.windings) {
      windings.push_back({{"turn", kWindings[static_cast<std::size_t>(one.windings)]},
                          {"electrical_zero", one.electrical_zero}});
    }
    json["windings"] = std::move(windings);
    json["cogging_n_mm"] = calibration.cogging.amplitude_n_mm;
    json["cogging_phase_rad"] = calibration.cogging.phase_rad;
  }
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw IoError(folder.string() + ": cannot be made: " + error.message());
  records::write_file_atomically(
      folder / calibration_file_name(calibration.drive, calibration.unit), json.dump(2) + "\n");
}

ArmCalibration parse_calibration(std::string_view text, std::string_view file) {
  const nlohmann::json json = parse_json_text(text, file);
  JsonFields fields(json, std::string(file), "");
  if (fields.number("version", 0, 1e6) != kVersion) {
    fields.refuse("of another version; calibrate the device again");
  }
  ArmCalibration read;
  read.drive = static_cast<firmware::Drive>(fields.choice("drive", kDrives));
  const double unit = fields.number("unit", 0, 4294967295.0);
  if (unit != std::floor(unit)) fields.refuse("unit is no whole number");
  read.unit = static_cast<std::uint32_t>(unit);
  read.made_at = fields.text_or("made_at", "");
  if (read.drive == firmware::Drive::Stop) {
    std::vector<JsonFields> legs = fields.objects("legs");
    if (legs.size() != kLegs) fields.refuse("an arm has three legs");
    for (std::size_t i = 0; i < kLegs; ++i) {
      read.legs[i] = leg_of(legs[i]);
      read.servos[i] = servo_of(legs[i]);
      legs[i].refuse_unknown_fields();
    }
  } else {
    const std::vector<double> zeros =
        fields.numbers("zero_in_turn_counts", kLegs, 0, kCountsOfTurn - 1);
    for (std::size_t i = 0; i < kLegs; ++i) {
      read.zero_in_turn[i] = static_cast<std::int32_t>(zeros[i]);
    }
    if (!fields.has("windings")) {
      fields.refuse("says nothing of its motors' windings; calibrate the device again");
    }
    std::vector<JsonFields> windings = fields.objects("windings");
    if (windings.size() != kLegs) fields.refuse("an arm has three motors");
    for (std::size_t i = 0; i < kLegs; ++i) {
      read.windings[i] = windings_of(windings[i]);
      windings[i].refuse_unknown_fields();
    }
    if (fields.has("cogging_n_mm")) {  // files of before have none
      const std::vector<double> sizes = fields.numbers("cogging_n_mm", kLegs, 0, kMostCoggingNMm);
      const std::vector<double> phases = fields.numbers("cogging_phase_rad", kLegs, -10, 10);
      std::copy(sizes.begin(), sizes.end(), read.cogging.amplitude_n_mm.begin());
      std::copy(phases.begin(), phases.end(), read.cogging.phase_rad.begin());
    }
  }
  fields.refuse_unknown_fields();
  return read;
}

std::vector<ArmCalibration> load_calibrations(const fs::path& folder,
                                              std::vector<std::string>& problems) {
  std::vector<ArmCalibration> all;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() != ".json") continue;
    try {
      const std::vector<std::byte> bytes = records::read_file(entry.path());
      const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
      all.push_back(parse_calibration(text, entry.path().string()));
    } catch (const Error& problem) {
      problems.emplace_back(problem.what());
    }
  }
  return all;
}

}  // namespace carpus::devices
