// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/simulated_port.hpp"

#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <ctime>
#include <vector>

#include "core/error.hpp"
#include "core/units.hpp"
#include "devices/precise_clock.hpp"

namespace carpus::devices {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kLateMs = 50;
/// Below a device's loop (30), which it answers.
constexpr int kRealTimePriority = 25;

/// So long after the host has said its first word the arm still lies in its cradle, and so long
/// after its last it is laid back.
constexpr double kRestS = 0.6;

/// The hand's wish: a small circle once in eight seconds, and down and up in five.
virtual_arm::Intent intent_at(double s, const Vec3& centre) {
  if (!(s > 0)) return {centre, {}};
  const double turn = 2 * kPi * s / 8;
  const double dip = 2 * kPi * s / 5;
  const double soft = s < 1 ? s : 1;  // from where it lies
  virtual_arm::Intent intent;
  intent.place =
      centre +
      Vec3{8 * std::sin(turn), 8 * (1 - std::cos(turn)) / 2, -6 * (1 - std::cos(dip))} * soft;
  return intent;
}

/// A folder that is nobody else's: what stands in it is opened by name.
void make_own_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder.parent_path(), error);
  if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) {
    throw IoError(folder.string() + ": cannot be made: " + std::strerror(errno));
  }
  struct stat is {};
  if (::lstat(folder.c_str(), &is) != 0 || !S_ISDIR(is.st_mode) || is.st_uid != ::geteuid()) {
    throw IoError(folder.string() + ": is not yours; set XDG_RUNTIME_DIR to a folder of yours");
  }
}

}  // namespace

fs::path simulated_folder() {
  if (const char* runtime = ::getenv("XDG_RUNTIME_DIR"); runtime != nullptr && *runtime == '/') {
    return fs::path(runtime) / "carpus";
  }
  return fs::path("/tmp") / ("carpus-" + std::to_string(::geteuid()));
}

SimulatedPort::SimulatedPort(firmware::Drive drive, std::uint32_t unit, const fs::path& folder)
    : unit_(drive, unit), calibration_(unit_.calibration()), hand_(drive) {
  make_own_folder(folder);
  master_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (master_ < 0 || ::grantpt(master_) != 0 || ::unlockpt(master_) != 0) {
    throw IoError(std::string("no pseudo-terminal could be made: ") + std::strerror(errno));
  }
  termios settings{};
  ::tcgetattr(master_, &settings);
  ::cfmakeraw(&settings);
  ::tcsetattr(master_, TCSANOW, &settings);
  path_ = folder / fs::path(calibration_file_name(drive, unit)).stem();
  std::error_code error;
  fs::remove(path_, error);
  fs::create_symlink(::ptsname(master_), path_, error);
  if (error) throw IoError(path_.string() + ": cannot be made: " + error.message());
  thread_ = std::thread([this] { run(); });
}

SimulatedPort::~SimulatedPort() {
  stopping_.store(true, std::memory_order_relaxed);
  thread_.join();
  std::error_code ignored;
  fs::remove(path_, ignored);
}

void SimulatedPort::run() {
  // As a device of its own, which no program's work holds up; where that is not allowed it loses
  // time.
  sched_param parameters{};
  parameters.sched_priority = kRealTimePriority;
  (void)::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameters);
  virtual_arm::VirtualArm& arm = unit_.arm();
  std::vector<std::uint8_t> going;
  arm.on_byte = [&going](std::uint8_t byte, double) { going.push_back(byte); };
  const Vec3 centre = arm.size().centre;
  Nanoseconds began = monotonic_now() - static_cast<Nanoseconds>(arm.now_us() * 1000);
  std::uint8_t bytes[256];
  double first_heard_us = -1;
  double last_heard_us = 0;
  while (!stopping_.load(std::memory_order_relaxed)) {
    const double due_us = static_cast<double>(monotonic_now() - began) / 1000;
    if (due_us - arm.now_us() > 1000.0 * kLateMs) {
      // The machine was elsewhere: that time is lost, not hurried after.
      const double lost_us = due_us - arm.now_us();
      began += static_cast<Nanoseconds>(lost_us * 1000);
      lost_ms_.fetch_add(static_cast<long>(lost_us / 1000), std::memory_order_relaxed);
      continue;
    }
    const ssize_t count = ::read(master_, bytes, sizeof bytes);
    if (count > 0) {
      arm.send({bytes, static_cast<std::size_t>(count)});
      if (first_heard_us < 0) first_heard_us = due_us;
      last_heard_us = due_us;
    } else if (due_us - last_heard_us > kRestS * 1e6) {
      first_heard_us = -1;
    }
    const double moves_s = first_heard_us < 0 ? 0 : (due_us - first_heard_us) * 1e-6 - kRestS;
    const std::size_t guided = guided_.load(std::memory_order_relaxed);
    if (guided < hand_.step_count()) {
      hand_.act(guided, arm);
    } else {
      arm.plant().set_hand(virtual_arm::kHandModels[1]);
      arm.plant().set_intent(intent_at(moves_s, centre));
    }
    arm.run_to_us(due_us);
    if (!going.empty()) {
      // What nobody reads is lost, as on a line.
      if (::write(master_, going.data(), going.size()) < 0) errno = 0;
      going.clear();
    }
    constexpr timespec kStep{0, 100'000};
    ::clock_nanosleep(CLOCK_MONOTONIC, 0, &kStep, nullptr);
  }
  // At once, or it would be silent before it is unplugged.
  ::close(master_);
}

}  // namespace carpus::devices
