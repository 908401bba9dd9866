// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A line of bytes to a device that never waits: a serial port, a socket, or a test's two queues.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

namespace carpus::devices {

class ByteLink {
 public:
  ByteLink() = default;
  virtual ~ByteLink() = default;
  ByteLink(const ByteLink&) = delete;
  ByteLink& operator=(const ByteLink&) = delete;

  /// What has come, at most as much as there is room for. @return its length; 0: nothing now.
  [[nodiscard]] virtual std::size_t read(std::span<std::uint8_t> into) noexcept = 0;
  /// All of it or nothing. @return false where there is no room now.
  [[nodiscard]] virtual bool write(std::span<const std::uint8_t> bytes) noexcept = 0;
  /// The other end is gone for good.
  [[nodiscard]] virtual bool is_gone() const noexcept = 0;
};

/// Opens the line anew, each time that the device is plugged in. @throws IoError
using OpenLink = std::function<std::unique_ptr<ByteLink>()>;

/// A serial port, raw, with this baud rate and without the delay that USB adapters add. Nobody else
/// may open it meanwhile.
[[nodiscard]] std::unique_ptr<ByteLink> open_serial(const std::string& path, unsigned baud);
/// A socket of this machine that some service listens on.
[[nodiscard]] std::unique_ptr<ByteLink> open_unix_socket(const std::string& path);
/// What is said by a file such as /dev/input/event3; written to where it may be.
[[nodiscard]] std::unique_ptr<ByteLink> open_character_device(const std::string& path);

}  // namespace carpus::devices
