// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/detail/memory_room.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <limits>

#include "core/error.hpp"

namespace carpus::case_io {
namespace {

constexpr std::uint64_t kMegabyte = 1000000;

/// MemAvailable: what can be used without swapping, caches included.
std::uint64_t free_on_machine() {
  std::ifstream in("/proc/meminfo");
  std::string key;
  std::uint64_t kilobytes = 0;
  for (std::string unit; in >> key >> kilobytes && std::getline(in, unit);) {
    if (key == "MemAvailable:") return kilobytes * 1024;
  }
  return std::numeric_limits<std::uint64_t>::max();  // not said: the allocation will tell
}

/// What a container may use beyond what it uses.
std::uint64_t free_in_group() {
  std::uint64_t most = 0;
  std::uint64_t used = 0;
  if (!(std::ifstream("/sys/fs/cgroup/memory.max") >> most)) {
    return std::numeric_limits<std::uint64_t>::max();
  }
  if (!(std::ifstream("/sys/fs/cgroup/memory.current") >> used)) used = 0;
  return most > used ? most - used : 0;
}

}  // namespace

std::uint64_t mapped_bytes() noexcept {
  // Plain calls: asked for in a process that was just forked, too.
  const int file = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  std::array<char, 64> text{};
  const ssize_t got = ::read(file, text.data(), text.size() - 1);
  ::close(file);
  if (got <= 0) return 0;
  return std::strtoull(text.data(), nullptr, 10) *
         static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

std::uint64_t memory_room() {
  std::uint64_t room = std::min(free_on_machine(), free_in_group());
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
    const std::uint64_t mapped = mapped_bytes();
    room = std::min<std::uint64_t>(room, limit.rlim_cur > mapped ? limit.rlim_cur - mapped : 0);
  }
  return room;
}

void require_memory(std::uint64_t bytes, const std::string& file) {
  const std::uint64_t room = memory_room();
  if (bytes <= room) return;
  throw IoError(file + ": needs " + std::to_string(bytes / kMegabyte) + " MB of memory, and " +
                std::to_string(room / kMegabyte) +
                " MB are free; close other programs or crop it to the wrist");
}

}  // namespace carpus::case_io
