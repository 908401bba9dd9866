// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/descriptor_link.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace carpus::devices {

DescriptorLink::DescriptorLink(int descriptor) noexcept : descriptor_(descriptor) {
  int type = 0;
  socklen_t size = sizeof type;
  is_socket_ = ::getsockopt(descriptor, SOL_SOCKET, SO_TYPE, &type, &size) == 0;
}

long DescriptorLink::put(const std::uint8_t* bytes, std::size_t count) const noexcept {
  return is_socket_ ? ::send(descriptor_, bytes, count, MSG_NOSIGNAL)
                    : ::write(descriptor_, bytes, count);
}

DescriptorLink::~DescriptorLink() { ::close(descriptor_); }

std::size_t DescriptorLink::read(std::span<std::uint8_t> into) noexcept {
  if (is_gone_ || into.empty()) return 0;
  const ssize_t count = ::read(descriptor_, into.data(), into.size());
  if (count > 0) return static_cast<std::size_t>(count);
  if (count < 0) {
    if (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) is_gone_ = true;
    return 0;
  }
  // A raw serial port says 0 for "nothing now" too; only a hang-up tells that it is gone.
  pollfd look{descriptor_, POLLIN, 0};
  if (::poll(&look, 1, 0) > 0 && (look.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0) {
    is_gone_ = true;
  }
  return 0;
}

bool DescriptorLink::send_left() noexcept {
  if (left_count_ == 0) return true;
  const ssize_t count = put(left_, left_count_);
  if (count < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) is_gone_ = true;
  if (count <= 0) return false;
  left_count_ -= static_cast<std::size_t>(count);
  std::memmove(left_, left_ + count, left_count_);
  return left_count_ == 0;
}

bool DescriptorLink::write(std::span<const std::uint8_t> bytes) noexcept {
  if (is_gone_ || !send_left()) return false;
  const ssize_t count = put(bytes.data(), bytes.size());
  if (count < 0) {
    if (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) is_gone_ = true;
    return false;
  }
  const std::size_t left = bytes.size() - static_cast<std::size_t>(count);
  if (left > kMostLeft) return false;
  // Half a frame would be garbage to the device, and the next one lost with it.
  std::memcpy(left_, bytes.data() + count, left);
  left_count_ = left;
  return true;
}

}  // namespace carpus::devices
