// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A line of bytes between a driver and a test that plays the device, and a folder that vanishes.
#pragma once

#include <stdlib.h>

#include <cstring>
#include <deque>
#include <filesystem>
#include <memory>
#include <vector>

#include "core/error.hpp"
#include "devices/byte_link.hpp"

namespace carpus::devices {

/// Both ends; the test keeps it while links come and go.
struct FakeLine {
  std::deque<std::uint8_t> to_host;
  std::vector<std::uint8_t> to_device;
  bool is_plugged = true;
  bool is_full = false;
  int opened = 0;
};

class FakeLink final : public ByteLink {
 public:
  explicit FakeLink(std::shared_ptr<FakeLine> line) : line_(std::move(line)) {}
  [[nodiscard]] std::size_t read(std::span<std::uint8_t> into) noexcept override {
    std::size_t count = 0;
    while (count < into.size() && !line_->to_host.empty()) {
      into[count++] = line_->to_host.front();
      line_->to_host.pop_front();
    }
    return count;
  }
  [[nodiscard]] bool write(std::span<const std::uint8_t> bytes) noexcept override {
    if (line_->is_full || !line_->is_plugged) return false;
    line_->to_device.insert(line_->to_device.end(), bytes.begin(), bytes.end());
    return true;
  }
  [[nodiscard]] bool is_gone() const noexcept override { return !line_->is_plugged; }

 private:
  std::shared_ptr<FakeLine> line_;
};

inline OpenLink fake_opener(const std::shared_ptr<FakeLine>& line) {
  return [line]() -> std::unique_ptr<ByteLink> {
    if (!line->is_plugged) throw IoError("fake: not plugged in; plug it in");
    ++line->opened;
    return std::make_unique<FakeLink>(line);
  };
}

class TemporaryFolder {
 public:
  TemporaryFolder() {
    char name[] = "/tmp/carpus-devices-XXXXXX";
    path_ = ::mkdtemp(name);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace carpus::devices
