// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <asm/ioctls.h>
#include <fcntl.h>
#include <linux/serial.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.hpp"
#include "devices/byte_link.hpp"
#include "devices/descriptor_link.hpp"

namespace carpus::devices {
namespace {

std::string advice(int error) {
  if (error == EACCES) return "; add yourself to the group that owns it (dialout, input)";
  if (error == EBUSY) return "; another program uses it: close that first";
  if (error == ENOENT || error == ENODEV || error == ENXIO) return "; plug the device in";
  if (error == ECONNREFUSED) return "; start the service that it belongs to";
  return "";
}

[[noreturn]] void fail(const std::string& path, const char* what) {
  const int error = errno;
  throw IoError(path + ": " + what + ": " + std::strerror(error) + advice(error));
}

speed_t speed_of(unsigned baud) {
  switch (baud) {
    case 115200:
      return B115200;
    case 500000:
      return B500000;
    case 1000000:
      return B1000000;
    default:
      throw InvalidInput("a serial line runs at 115200, 500000 or 1000000 baud, not at " +
                         std::to_string(baud));
  }
}

/// USB adapters keep bytes back for 16 ms unless told; those that cannot be told are left alone.
void ask_for_low_latency(int descriptor) {
  serial_struct settings{};
  if (::ioctl(descriptor, TIOCGSERIAL, &settings) != 0) return;
  settings.flags |= ASYNC_LOW_LATENCY;
  (void)::ioctl(descriptor, TIOCSSERIAL, &settings);
}

}  // namespace

std::unique_ptr<ByteLink> open_serial(const std::string& path, unsigned baud) {
  const int descriptor = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) fail(path, "cannot be opened");
  auto link = std::make_unique<DescriptorLink>(descriptor);
  termios settings{};
  if (::tcgetattr(descriptor, &settings) != 0) fail(path, "is no serial port");
  ::cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~static_cast<tcflag_t>(CRTSCTS | HUPCL);
  settings.c_cc[VMIN] = 0;
  settings.c_cc[VTIME] = 0;
  ::cfsetispeed(&settings, speed_of(baud));
  ::cfsetospeed(&settings, speed_of(baud));
  if (::tcsetattr(descriptor, TCSANOW, &settings) != 0) fail(path, "does not take its settings");
  if (::ioctl(descriptor, TIOCEXCL) != 0) fail(path, "cannot be had alone");
  ask_for_low_latency(descriptor);
  ::tcflush(descriptor, TCIOFLUSH);
  return link;
}

std::unique_ptr<ByteLink> open_unix_socket(const std::string& path) {
  sockaddr_un address{};
  if (path.size() >= sizeof address.sun_path) {
    throw InvalidInput(path + ": too long for the name of a socket");
  }
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, path.data(), path.size());
  const int descriptor = ::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (descriptor < 0) fail(path, "no socket could be made");
  auto link = std::make_unique<DescriptorLink>(descriptor);
  if (::connect(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    fail(path, "nobody answers there");
  }
  return link;
}

std::unique_ptr<ByteLink> open_character_device(const std::string& path) {
  int descriptor = ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) fail(path, "cannot be opened");
  return std::make_unique<DescriptorLink>(descriptor);
}

}  // namespace carpus::devices
