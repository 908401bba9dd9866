// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/access_links.hpp"

#include <fcntl.h>
#include <openssl/crypto.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

#include "core/error.hpp"

namespace carpus::server {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kLetters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
constexpr std::string_view kFirstLine = "carpus links 1\n";
constexpr std::string_view kTrainee = "trainee ";
constexpr std::string_view kInstructor = "instructor ";

[[noreturn]] void fail(const fs::path& file, const std::string& why) {
  throw IoError(file.string() + ": " + why);
}

std::string reason() { return std::generic_category().message(errno); }

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int get() const noexcept { return number_; }

 private:
  int number_;
};

std::string text_of(const AccessLinks& links) {
  std::string text(kFirstLine);
  text.append(kTrainee).append(links.trainee).append("\n");
  text.append(kInstructor).append(links.instructor).append("\n");
  return text;
}

/// Takes "name token\n" off `rest`; empty where that is not there.
std::string take_token(std::string_view& rest, std::string_view name) {
  if (!rest.starts_with(name)) return {};
  const std::string token(rest.substr(name.size(), kTokenLength));
  rest.remove_prefix(std::min(name.size() + kTokenLength + 1, rest.size()));
  return is_token(token) ? token : std::string();
}

void refuse_what_others_read(const fs::path& file, int descriptor) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) fail(file, "cannot be looked at: " + reason());
  if (!S_ISREG(status.st_mode)) fail(file, "is no file; remove it, and new links are made");
  if (status.st_uid != ::geteuid() || (status.st_mode & (S_IRWXG | S_IRWXO)) != 0) {
    fail(file,
         "holds the secret links of this station, but others may read it or own it; "
         "remove it, and new links are made");
  }
}

AccessLinks read_links(const fs::path& file, int descriptor) {
  refuse_what_others_read(file, descriptor);
  std::array<char, 256> bytes{};
  const ssize_t size = ::read(descriptor, bytes.data(), bytes.size());
  if (size < 0) fail(file, "cannot be read: " + reason());
  const std::string_view text(bytes.data(), static_cast<std::size_t>(size));
  AccessLinks links;
  if (text.starts_with(kFirstLine)) {
    std::string_view rest = text.substr(kFirstLine.size());
    links.trainee = take_token(rest, kTrainee);
    links.instructor = take_token(rest, kInstructor);
  }
  if (text != text_of(links) || links.trainee.empty() || links.trainee == links.instructor) {
    fail(file, "does not hold links of a station; remove it, and new ones are made");
  }
  return links;
}

/// Whole or not at all: under another name first.
AccessLinks write_links(const fs::path& file) {
  const AccessLinks links = make_access_links();
  const fs::path temporary = file.string() + "." + make_token().substr(0, 8);
  const std::string text = text_of(links);
  {
    const Descriptor out(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
    if (out.get() < 0) fail(file, "the file for the links cannot be made: " + reason());
    const bool is_whole =
        ::write(out.get(), text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
        ::fsync(out.get()) == 0;
    if (!is_whole) {
      const std::string why = reason();
      ::unlink(temporary.c_str());
      fail(file, "the links cannot be written: " + why);
    }
  }
  if (::rename(temporary.c_str(), file.c_str()) != 0) {
    const std::string why = reason();
    ::unlink(temporary.c_str());
    fail(file, "the links cannot be written: " + why);
  }
  return links;
}

}  // namespace

std::string make_token() {
  std::array<unsigned char, kTokenLength / 4 * 3> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw IoError("the system gives no random numbers: " + reason());
  }
  std::string token;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const unsigned value = bytes[i] << 16U | bytes[i + 1] << 8U | bytes[i + 2];
    for (unsigned shift : {18U, 12U, 6U, 0U}) token += kLetters[(value >> shift) & 63U];
  }
  return token;
}

bool is_token(std::string_view text) noexcept {
  return text.size() == kTokenLength && text.find_first_not_of(kLetters) == std::string_view::npos;
}

bool same_secret(std::string_view one, std::string_view other) noexcept {
  return one.size() == other.size() && CRYPTO_memcmp(one.data(), other.data(), one.size()) == 0;
}

AccessLinks make_access_links() { return {make_token(), make_token()}; }

AccessLinks keep_access_links(const fs::path& file, bool anew) {
  if (anew) return write_links(file);
  const Descriptor in(::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (in.get() >= 0) return read_links(file, in.get());
  if (errno == ENOENT) return write_links(file);
  if (errno == ELOOP) fail(file, "is a symbolic link; remove it, and new links are made");
  fail(file, "the links of this station cannot be read: " + reason());
}

}  // namespace carpus::server
