// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A file descriptor as a line of bytes.
#pragma once

#include "devices/byte_link.hpp"

namespace carpus::devices {

class DescriptorLink final : public ByteLink {
 public:
  /// Owns it; it must not block.
  explicit DescriptorLink(int descriptor) noexcept;
  ~DescriptorLink() override;
  [[nodiscard]] std::size_t read(std::span<std::uint8_t> into) noexcept override;
  [[nodiscard]] bool write(std::span<const std::uint8_t> bytes) noexcept override;
  [[nodiscard]] bool is_gone() const noexcept override { return is_gone_; }
  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }

 private:
  /// Bytes of a frame of which the line took a part: the rest goes first.
  static constexpr std::size_t kMostLeft = 64;

  [[nodiscard]] bool send_left() noexcept;
  /// To a socket without the signal that ends a program whose service is gone.
  [[nodiscard]] long put(const std::uint8_t* bytes, std::size_t count) const noexcept;

  int descriptor_;
  bool is_socket_ = false;
  bool is_gone_ = false;
  std::uint8_t left_[kMostLeft] = {};
  std::size_t left_count_ = 0;
};

}  // namespace carpus::devices
